//! Spherical lights.

use std::f64::consts::PI;

use super::{Method, PhongLobe, Response, ShadingPoint, point};
use crate::light::SphereEmitter;

/// Response to a sphere of luminance 1 by a method.
pub fn respond(light: &SphereEmitter, _method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    sphere_point(light, at, lobe)
}

/// The sphere as one point light at its centre, I = πr²·L.
pub fn sphere_point(light: &SphereEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    point::point_response(light.center - at.p, PI * light.radius * light.radius, at, lobe)
}
