//! From where a scene is seen, and how it is shown.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A pinhole camera, Z up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Camera {
    /// Where the eye is, metres.
    #[schemars(with = "[f64; 3]")]
    pub eye: DVec3,
    /// What it looks at, metres.
    #[schemars(with = "[f64; 3]")]
    pub target: DVec3,
    /// Vertical field of view, degrees.
    #[serde(default = "default_fov")]
    pub fov_deg: f64,
}

fn default_fov() -> f64 {
    40.0
}

impl Default for Camera {
    fn default() -> Self {
        Self { eye: DVec3::new(0.0, -6.0, 2.5), target: DVec3::new(0.0, 0.0, 0.5), fov_deg: default_fov() }
    }
}

impl Camera {
    /// The camera's unit axes in the world: right, up, and back (away from the target).
    ///
    /// Looking straight up or down, world Y serves as up.
    pub fn axes(&self) -> [DVec3; 3] {
        let back = (self.eye - self.target).try_normalize().unwrap_or(DVec3::NEG_Y);
        let right = DVec3::Z.cross(back).try_normalize().unwrap_or(DVec3::X);
        [right, back.cross(right), back]
    }

    /// Unit direction through a point of a picture `width` × `height`, in pixels from its upper left corner.
    pub fn ray_direction(&self, x: f64, y: f64, width: f64, height: f64) -> DVec3 {
        let [right, up, back] = self.axes();
        let half = (0.5 * self.fov_deg.to_radians()).tan();
        let (sx, sy) = ((2.0 * x - width) / height * half, (1.0 - 2.0 * y / height) * half);
        (sx * right + sy * up - back).normalize()
    }
}

/// How radiance becomes a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Display {
    /// Exposure: at 0, 100 cd/m² is white; each step doubles the picture's brightness.
    #[serde(default)]
    pub exposure_ev: f64,
}
