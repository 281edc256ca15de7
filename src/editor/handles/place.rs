//! Placing a light by where its light shall fall.
//!
//! At the chosen point p, with its normal n towards the eye and v the direction to the eye, a light is put in a direction
//! ω at the distance it has from p now, its lit side towards p:
//! - its *highlight* is at p where ω is the mirror direction, ω = r = 2(n·v)n − v;
//! - its irradiance has its *peak* at p where it stands over p, ω = n;
//! - a *rim* is a highlight at grazing incidence from behind. With t the part of n across the line of sight, that is the
//!   way out of the silhouette on screen, and γ the angle between surface and line of sight,
//!   n = sin γ·v + cos γ·t and so r = sin 2γ·t − cos 2γ·v: straight from behind at the silhouette itself, where the thing
//!   itself would hide it, and rising by 2γ off it. ω is that direction for the γ of p, kept within 3° and 30°: from
//!   3° on the light clears the edge, and up to 30° it is well behind the thing. A point between has the rim exactly;
//!   for one beyond it is where, in that direction on screen, the surface is at 3° or 30°.
//!
//! A light's own falloff pulls its highlight towards it: for m = 2000 by 11 mm at most for a line 3 m away, less for all
//! others; the irradiance of symmetric lights has its peak at p itself (`place_tests.rs`).
//!
//! A light infinitely far away is turned instead, so that it comes from ω.

use glam::DVec3;

use super::aim::{self, facing};
use crate::light::Light;
use crate::math::frame;
use crate::shading::ShadingPoint;

/// What shall fall on the chosen point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Place {
    /// The light's reflection.
    Highlight,
    /// The most of its light.
    Diffuse,
    /// Its reflection at grazing incidence from behind.
    Rim,
}

/// Angles between surface and line of sight at which a rim is placed, degrees.
const GRAZING_DEG: [f64; 2] = [3.0, 30.0];
/// No light is placed nearer to a point than this, metres.
const LEAST_DISTANCE: f64 = 0.01;

impl Place {
    /// All of them, in toolbar order.
    pub const ALL: [Self; 3] = [Self::Highlight, Self::Diffuse, Self::Rim];

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Highlight => "Highlight here",
            Self::Diffuse => "Diffuse peak here",
            Self::Rim => "Rim here",
        }
    }

    /// What it does.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Highlight => "Press on a surface: the selected light is mirrored there",
            Self::Diffuse => "Press on a surface: the selected light shines brightest there",
            Self::Rim => "Press near an edge: the selected light rims it from behind",
        }
    }

    /// The direction from a point in which its light shall be.
    pub fn direction(self, at: &ShadingPoint) -> DVec3 {
        match self {
            Self::Highlight => at.mirror(),
            Self::Diffuse => at.n,
            Self::Rim => rim(at),
        }
    }
}

/// r = sin 2γ·t − cos 2γ·v: see the [module](self).
fn rim(at: &ShadingPoint) -> DVec3 {
    let sin = at.n.dot(at.v);
    let across = at.n - sin * at.v;
    let cos = across.length();
    // What faces the eye has no side that is out: any will do.
    let out = across.try_normalize().unwrap_or_else(|| at.v.any_orthonormal_vector());
    let [least, most] = GRAZING_DEG.map(f64::to_radians);
    let (sin_2, cos_2) = (2.0 * sin.atan2(cos).clamp(least, most)).sin_cos();
    sin_2 * out - cos_2 * at.v
}

/// `light` where `place` has it for a point: at its present distance from the point, or at `distance`.
pub fn placed(light: &Light, place: Place, at: &ShadingPoint, distance: Option<f64>) -> Light {
    let to_light = place.direction(at);
    let rotation = facing(frame::rotation_from_deg(light.rotation_deg), -to_light);
    if aim::is_far(light) {
        return Light { position: light.position, ..aim::placed(light, rotation, aim::center(light)) };
    }
    let distance = distance.unwrap_or_else(|| aim::center(light).distance(at.p)).max(LEAST_DISTANCE);
    aim::placed(light, rotation, at.p + distance * to_light)
}

#[cfg(test)]
#[path = "place_tests.rs"]
mod tests;
