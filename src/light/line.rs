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
    /// Of a tube, in metres: much less than the distances at which it is seen. Isotropic lines have none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<f64>,
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
    /// As a thin Lambertian cylinder of radius r and luminance L: intensity per metre 2·r·L·sin ψ, ψ from the axis.
    Tube,
}

/// A [`Line`] in the world, of intensity per metre 1, or luminance 1 if it is a tube.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineEmitter {
    /// One end.
    pub a: DVec3,
    /// The other end.
    pub b: DVec3,
    /// Exponent of the distance.
    pub falloff: f64,
    /// Radius of a tube; none for a line that emits the same in all directions.
    pub tube: Option<f64>,
}

fn physical_falloff() -> f64 {
    2.0
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_physical(falloff: &f64) -> bool {
    *falloff == physical_falloff()
}

impl Line {
    /// Radius of a fluorescent tube (T8), which a line gets that becomes one.
    pub const EVERYDAY_RADIUS: f64 = 0.013;

    /// A line that emits the same in all directions.
    pub fn isotropic(length: f64) -> Self {
        Self { length, emission: LineEmission::Isotropic, radius: None, falloff: physical_falloff() }
    }

    /// A thin Lambertian cylinder.
    pub fn tube(length: f64, radius: f64) -> Self {
        Self { emission: LineEmission::Tube, radius: Some(radius), ..Self::isotropic(length) }
    }

    /// The radius of a tube; none for other lines.
    pub fn tube_radius(&self) -> Option<f64> {
        match self.emission {
            LineEmission::Isotropic => None,
            LineEmission::Tube => Some(self.radius.unwrap_or(0.0)),
        }
    }

    /// Φ/I′ = 4π·length of an isotropic line, Φ/L = π·2πr·length of a tube.
    pub fn flux_per_strength(&self) -> f64 {
        let per_metre = self.tube_radius().map_or(4.0 * PI, |radius| 2.0 * PI * PI * radius);
        per_metre * self.length
    }

    /// The line in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> LineEmitter {
        let half = 0.5 * self.length * DVec3::X;
        LineEmitter {
            a: world_from_light.transform_point3(-half),
            b: world_from_light.transform_point3(half),
            falloff: self.falloff,
            tube: self.tube_radius(),
        }
    }
}

impl LineEmission {
    /// The name in files and on screen.
    pub fn name(self) -> &'static str {
        match self {
            Self::Isotropic => "isotropic",
            Self::Tube => "tube",
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

    /// Intensity per metre in a direction of any length: 1, or 2·r·sin ψ of a tube.
    pub fn intensity_along(&self, direction: DVec3) -> f64 {
        let Some(radius) = self.tube else { return 1.0 };
        let axis = (self.b - self.a).normalize_or_zero();
        2.0 * radius * axis.cross(direction.normalize_or_zero()).length()
    }
}
