//! A linear light.

use std::f64::consts::PI;

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A straight line along the light's X axis, centred on its origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Length in metres.
    pub length: f64,
    /// How each point of the line emits.
    #[serde(default)]
    pub emission: LineEmission,
    /// Exponent n of the distance in 1/rⁿ, 0…3; 2 is physical ([`crate::refs::PICOTT_1992`], eq. 1).
    #[serde(default = "physical_falloff", skip_serializing_if = "is_physical")]
    pub falloff: f64,
}

/// How the points of a line emit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum LineEmission {
    /// The same in all directions.
    #[default]
    Isotropic,
}

/// A [`Line`] in the world, intensity per metre 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineEmitter {
    /// One end.
    pub a: DVec3,
    /// The other end.
    pub b: DVec3,
    /// Exponent of the distance.
    pub falloff: f64,
}

fn physical_falloff() -> f64 {
    2.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_physical(falloff: &f64) -> bool {
    *falloff == physical_falloff()
}

impl Line {
    /// Φ/I′ = 4π·length for an isotropic line.
    pub fn flux_per_intensity_per_metre(&self) -> f64 {
        4.0 * PI * self.length
    }

    /// The line in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> LineEmitter {
        let half = 0.5 * self.length * DVec3::X;
        LineEmitter {
            a: world_from_light.transform_point3(-half),
            b: world_from_light.transform_point3(half),
            falloff: self.falloff,
        }
    }
}

impl LineEmitter {
    /// The middle of the line.
    pub fn middle(&self) -> DVec3 {
        self.a.midpoint(self.b)
    }

    /// Length in metres.
    pub fn length(&self) -> f64 {
        self.a.distance(self.b)
    }
}
