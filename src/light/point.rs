//! A point light.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::photometry::{Distribution, Photometry};

/// A point at the light's origin: isotropic, or with the intensities of a photometric file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// Its intensities: an IES file (LM-63), named relative to the scene file. Nadir is −Z, its half-plane C = 0
    /// on the side of +X. The light's `intensity` is then the greatest of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "String")]
    pub ies: Option<Photometry>,
}

/// A [`Point`] in the world, its greatest intensity 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PointEmitter {
    /// Where it is.
    pub position: DVec3,
    /// Its intensities; the same in all directions where there are none.
    pub web: Option<Web>,
}

/// Intensities about a point in the world.
#[derive(Clone, Debug, PartialEq)]
pub struct Web {
    /// Rotation from the world to the light's own frame.
    pub light_from_world: DMat3,
    /// The intensities, shared with the light.
    pub distribution: Arc<Distribution>,
}

impl Point {
    /// Φ/I, I the greatest intensity: 4π where it is isotropic.
    pub fn flux_per_intensity(&self) -> f64 {
        self.ies.as_ref().map_or(4.0 * PI, |photometry| photometry.distribution.flux_per_peak())
    }

    /// The light in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> PointEmitter {
        let web = self.ies.as_ref().map(|photometry| Web {
            light_from_world: world_from_light.matrix3.transpose(),
            distribution: Arc::clone(&photometry.distribution),
        });
        PointEmitter { position: world_from_light.translation, web }
    }
}

impl PointEmitter {
    /// Intensity in a direction away from the light, of any length, in the world.
    pub fn intensity(&self, direction: DVec3) -> f64 {
        self.web.as_ref().map_or(1.0, |web| web.distribution.share(web.light_from_world * direction))
    }
}
