//! Point and directional lights, and the point light that stands for any other light.

use std::ops::AddAssign;

use glam::DVec3;

use super::{PhongLobe, Response, ShadingPoint};
use crate::light::{DirectionalEmitter, PointEmitter};

/// Nearer to a light than this, in metres, a point touches it: the direction to the light is then undefined, and the
/// light adds nothing. It keeps every 1/r³ far inside the range of `f64`.
pub const CONTACT: f64 = 1e-60;

/// Response to a point light whose greatest intensity is 1.
pub fn respond(light: &PointEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    point_response(light.position - at.p, light.intensity(at.p - light.position), at, lobe)
}

/// Response to a directional light of illuminance 1.
pub fn respond_directional(light: &DirectionalEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    direction_response(light.to_light, 1.0, at.n, at.mirror(), lobe)
}

/// Response to a point light of `intensity` at `to_light` from the point.
///
/// E = I·max(0, n·w)/d², specular = (m+1)/(2π)·I·max(0, r·w)ᵐ/d² where n·w > 0.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §2.2. **Units:** cd, m → lx.
/// **Domain:** 0 within [`CONTACT`] of the light.
pub fn point_response(to_light: DVec3, intensity: f64, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    falloff_response(to_light, intensity, 2.0, at.n, at.mirror(), lobe)
}

/// [`point_response`] for light that falls off as 1/dⁿ, with n and r given.
pub fn falloff_response(
    to_light: DVec3,
    intensity: f64,
    falloff: f64,
    n: DVec3,
    r: DVec3,
    lobe: &PhongLobe,
) -> Response {
    let distance_squared = to_light.length_squared();
    if distance_squared < CONTACT * CONTACT {
        return Response::default();
    }
    let distance = distance_squared.sqrt();
    let attenuation = if falloff == 2.0 { distance_squared } else { distance.powf(falloff) };
    direction_response(to_light / distance, intensity / attenuation, n, r, lobe)
}

/// Response to parallel light of `illuminance` (on a surface that faces it) from the unit direction `w`.
pub fn direction_response(w: DVec3, illuminance: f64, n: DVec3, r: DVec3, lobe: &PhongLobe) -> Response {
    let cos_n = n.dot(w);
    if cos_n > 0.0 {
        Response { irradiance: illuminance * cos_n, specular: illuminance * lobe.density(n, r, w) }
    } else {
        Response::default()
    }
}

impl AddAssign for Response {
    fn add_assign(&mut self, other: Self) {
        self.irradiance += other.irradiance;
        self.specular += other.specular;
    }
}
