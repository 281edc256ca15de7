//! A point light.

use std::f64::consts::PI;

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An isotropic point at the light's origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Point {}

/// A [`Point`] in the world, intensity 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointEmitter {
    /// Where it is.
    pub position: DVec3,
}

impl Point {
    /// Φ/I = 4π.
    pub const FLUX_PER_INTENSITY: f64 = 4.0 * PI;
}
