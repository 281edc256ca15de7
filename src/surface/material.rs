//! The reflection of a surface.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Lambert and Phong reflection: L = k_d/π·E + k_s·(m+1)/(2π)·∫L(ω)(ω·r)ᵐ dω.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Unique among the materials of a scene.
    pub name: String,
    /// k_d, linear Rec. 709.
    #[schemars(with = "[f64; 3]")]
    pub diffuse: DVec3,
    /// k_s, linear Rec. 709.
    #[serde(default)]
    #[schemars(with = "[f64; 3]")]
    pub specular: DVec3,
    /// m, any real ≥ 1.
    #[serde(default = "default_exponent")]
    pub exponent: f64,
}

fn default_exponent() -> f64 {
    32.0
}
