//! A light infinitely far away that fills a cap of directions.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The directions within an angle of the light's +Z, of constant luminance: the sub-hemispherical source of
/// [`crate::refs::SNYDER_1996`], §2.2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cap {
    /// Half-angle σ, degrees, at most 90.
    pub half_angle_deg: f64,
}

/// A [`Cap`] in the world, luminance 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CapEmitter {
    /// Unit direction from any point to the middle of the cap.
    pub to_center: DVec3,
    /// Half-angle σ, radians.
    pub half_angle: f64,
}

impl Cap {
    /// E/L = π sin²σ on a surface that faces the cap.
    pub fn illuminance_per_luminance(&self) -> f64 {
        PI * self.half_angle_deg.to_radians().sin().powi(2)
    }

    /// The cap in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> CapEmitter {
        CapEmitter { to_center: world_from_light.matrix3.z_axis, half_angle: self.half_angle_deg.to_radians() }
    }
}

impl CapEmitter {
    /// E = π sin²σ on a surface that faces the cap, for luminance 1.
    pub fn illuminance(&self) -> f64 {
        PI * self.half_angle.sin().powi(2)
    }
}
