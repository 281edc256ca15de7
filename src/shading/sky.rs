//! Skies.

use std::f64::consts::{FRAC_PI_2, PI};

use super::point::direction_response;
use super::sphere::{Cap, cap_irradiance, cap_phong};
use super::{Method, PhongLobe, Response, ShadingPoint};
use crate::light::SkyEmitter;

/// Response to a sky of unit luminance by a method.
pub fn respond(light: &SkyEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    if method == Method::Point {
        return sky_point(light, at, lobe);
    }
    let cap = Cap::new(light.zenith, FRAC_PI_2);
    let mean = light.uniform + light.cosine * 2.0 / 3.0;
    Response {
        irradiance: mean * cap_irradiance(&cap, at.n),
        specular: mean * cap_phong(&cap, at.n, at.mirror(), lobe.exponent()),
    }
}

/// The sky as a directional light from its zenith, of the sky's illuminance π(u + 2c/3) on a surface that faces it.
pub fn sky_point(light: &SkyEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let illuminance = PI * (light.uniform + 2.0 / 3.0 * light.cosine);
    direction_response(light.zenith, illuminance, at.n, at.mirror(), lobe)
}
