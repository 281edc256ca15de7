//! A spherical light.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A Lambertian sphere about the light's origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Radius in metres.
    pub radius: f64,
}

/// A [`Sphere`] in the world, luminance 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphereEmitter {
    /// Centre.
    pub center: DVec3,
    /// Radius in metres.
    pub radius: f64,
}

impl Sphere {
    /// Φ/L = 4π²r².
    pub fn flux_per_luminance(&self) -> f64 {
        4.0 * PI * PI * self.radius * self.radius
    }

    /// The sphere in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> SphereEmitter {
        SphereEmitter { center: world_from_light.translation, radius: self.radius }
    }
}
