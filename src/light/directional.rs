//! A directional light.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parallel light that travels along the light's −Z.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Directional {}

/// A [`Directional`] light in the world, illuminance 1 on a surface that faces it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionalEmitter {
    /// Unit direction from any point to the light.
    pub to_light: DVec3,
}
