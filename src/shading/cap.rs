//! Caps infinitely far away; the integrals are those of what a point sees of a sphere.

use super::point::direction_response;
use super::sphere::{Cap, cap_irradiance, cap_irradiance_hermite_1, cap_irradiance_hermite_2, cap_phong};
use super::{Method, PhongLobe, Response, ShadingPoint, cluster};
use crate::light::CapEmitter;

/// Response to a cap of luminance 1 by a method.
pub fn respond(light: &CapEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let cap = Cap::new(light.to_center, light.half_angle);
    let irradiance = match method {
        Method::Point | Method::PointCluster(0 | 1) => return cap_point(light, at, lobe),
        Method::PointCluster(points) => return cluster::cap_cluster(&cap, points, at, lobe),
        Method::Hermite1 => cap_irradiance_hermite_1(&cap, at.n),
        Method::Hermite2 => cap_irradiance_hermite_2(&cap, at.n),
        _ => cap_irradiance(&cap, at.n),
    };
    Response { irradiance, specular: cap_phong(&cap, at.n, at.mirror(), lobe.exponent()) }
}

/// The cap as a directional light from its middle, of the cap's illuminance π sin²σ on a surface that faces it.
pub fn cap_point(light: &CapEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    direction_response(light.to_center, light.illuminance(), at.n, at.mirror(), lobe)
}
