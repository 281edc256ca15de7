//! Irradiance of a polygon, exactly.

use std::f64::consts::PI;

use glam::DVec3;

use super::area::{EdgeSum, area_integral};
use super::edges;
use crate::math::spherical::{Edge, HorizonClip};

/// Irradiance at p from a polygon of luminance 1 that may lie anywhere about the horizon of the unit normal n.
///
/// E = ½ |Σᵢ Θᵢ (Γᵢ · n)| over the edges above the horizon and along it, Θᵢ the angle an edge subtends and Γᵢ the unit
/// normal of its plane through p.
///
/// **Source:** [`SNYDER_1996`](crate::refs::SNYDER_1996), eq. 8; [`PICOTT_1992`](crate::refs::PICOTT_1992), eq. 8a.
/// **Deviation:** Θ by `atan2`; where the sum cancels, because the light is tiny or a sliver as seen from p, ω·n is
/// integrated over its area instead.
/// **Domain:** any planar simple polygon, either way round; two-sided; p in its plane or on its edge gives a limit.
/// **Units:** lx per cd·m⁻².
/// **Accuracy:** 3e-14 of π, relative 3e-13 on every reference case (`closed_form::polygon`).
/// **Twin:** `shaders/polygon.wgsl`.
pub fn polygon_irradiance(vertices: &[DVec3], p: DVec3, n: DVec3) -> f64 {
    let mut clip = HorizonClip::new(n);
    let clipped = edges(vertices, p).flat_map(move |edge| clip.clip(edge)).flatten();
    let sum: EdgeSum = clipped.clone().map(|edge| edge_term(edge, n)).collect();
    let irradiance = if sum.cancels(vertices, p, 2.0, 1.0) {
        area_integral(clipped, RESOLUTION, &|direction| direction.dot(n).max(0.0))
    } else {
        0.5 * sum.value
    };
    // In the light's own plane both are no more than a guess.
    irradiance.abs().min(PI)
}

/// Over less than this angle the area integral's rule is accurate to rounding.
const RESOLUTION: f64 = 0.3;

/// Θ (Γ · n) of an edge.
fn edge_term((a, b): Edge, n: DVec3) -> f64 {
    let cross = a.cross(b - a);
    let sine = cross.length();
    if sine > 0.0 { sine.atan2(a.dot(b)) * cross.dot(n) / sine } else { 0.0 }
}
