//! A sky: a hemisphere of light infinitely far away.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The hemisphere about the light's +Z, of luminance L·(uniform + cosine·cos θ), θ from that zenith: the hemispherical
/// sources of [`crate::refs::SNYDER_1996`], §2.1. 1/3 and 2/3 are the CIE's overcast sky.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sky {
    /// The part that is the same in all directions.
    pub uniform: f64,
    /// The part that falls with the cosine of the angle from the zenith.
    pub cosine: f64,
}

/// A [`Sky`] in the world, for L = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SkyEmitter {
    /// Unit direction to the zenith.
    pub zenith: DVec3,
    /// The part that is the same in all directions.
    pub uniform: f64,
    /// The part that falls with the cosine of the angle from the zenith.
    pub cosine: f64,
}

impl Sky {
    /// The CIE's overcast sky.
    pub const OVERCAST: Self = Self { uniform: 1.0 / 3.0, cosine: 2.0 / 3.0 };

    /// The sky in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> SkyEmitter {
        SkyEmitter { zenith: world_from_light.matrix3.z_axis, uniform: self.uniform, cosine: self.cosine }
    }
}

impl SkyEmitter {
    /// E = π(u + 2c/3) on a surface that faces the zenith, for L = 1.
    pub fn illuminance(&self) -> f64 {
        PI * (self.uniform + 2.0 / 3.0 * self.cosine)
    }

    /// Luminance in a unit direction; none comes from below the sky's own horizon.
    pub fn radiance(&self, direction: DVec3) -> f64 {
        let cosine = self.zenith.dot(direction);
        if cosine >= 0.0 { self.uniform + self.cosine * cosine } else { 0.0 }
    }
}
