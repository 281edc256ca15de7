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
    /// Which specular reflection; the exponent is Phong's, Blinn's and Lafortune's.
    #[serde(default, skip_serializing_if = "ReflectionModel::is_phong")]
    pub model: ReflectionModel,
    /// m, any real ≥ 1.
    #[serde(default = "default_exponent")]
    pub exponent: f64,
}

/// A model of specular reflection.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ReflectionModel {
    /// (ω·r)ᵐ about the mirror direction.
    Phong {},
    /// (n·h)ᵐ of the half-vector.
    Blinn {},
    /// Microfacets: Beckmann's distribution, Cook and Torrance's shadowing, Schlick's Fresnel term.
    CookTorrance {
        /// Root mean square slope of the microfacets, 0…1.
        roughness: f64,
        /// Fresnel reflectance at normal incidence, 0…1.
        reflectance: f64,
    },
    /// A cosine lobe about a stretched mirror direction.
    Lafortune {
        /// C_x = C_y, the factor of the tangential part; −1 mirrors.
        tangential: f64,
        /// C_z, the factor of the normal part; 1 mirrors.
        normal: f64,
    },
}

impl ReflectionModel {
    fn is_phong(&self) -> bool {
        matches!(self, Self::Phong {})
    }

    /// The name of the model in files and on screen.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Phong {} => "phong",
            Self::Blinn {} => "blinn",
            Self::CookTorrance { .. } => "cook-torrance",
            Self::Lafortune { .. } => "lafortune",
        }
    }
}

impl Default for ReflectionModel {
    fn default() -> Self {
        Self::Phong {}
    }
}

fn default_exponent() -> f64 {
    32.0
}
