//! A rectangular light with a pattern.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DAffine3, DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::color::luminance_of;
use super::pattern::{Channel, Pattern};

/// A rectangle in the light's XY plane about its origin, Lambertian texel by texel: any outline, any distribution.
///
/// The image stands upright for somebody who looks at the lit side: row 0 at +Y, column 0 at +X.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Textured {
    /// Extent along X and Y, metres.
    #[schemars(with = "[f64; 2]")]
    pub size: DVec2,
    /// The image, named relative to the scene file: PNG, JPEG, EXR or HDR.
    pub pattern: Pattern,
    /// Emits to both sides.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub two_sided: bool,
}

/// One channel of a [`Textured`] light in the world, luminance 1 where a texel is 1.
#[derive(Clone, Debug, PartialEq)]
pub struct TexturedEmitter {
    /// The corner where the image's first texel is.
    pub corner: DVec3,
    /// From there along the first row to its end.
    pub row: DVec3,
    /// From there along the first column to its end.
    pub column: DVec3,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// Emits to both sides.
    pub two_sided: bool,
    /// The pattern.
    pub pattern: Arc<Channel>,
}

impl Textured {
    /// Area in m².
    pub fn area(&self) -> f64 {
        self.size.x * self.size.y
    }

    /// Φ/L = πA·(mean luminance of the texels) a side.
    pub fn flux_per_luminance(&self) -> f64 {
        let mean = match self.pattern.image.channels() {
            [red, green, blue] => luminance_of(DVec3::new(red.mean(), green.mean(), blue.mean())),
            grey => grey.first().map_or(0.0, |channel| channel.mean()),
        };
        PI * self.area() * mean * if self.two_sided { 2.0 } else { 1.0 }
    }

    /// The light of one of its channels in the world.
    pub fn place(&self, world_from_light: &DAffine3, channel: &Arc<Channel>) -> TexturedEmitter {
        let axes = world_from_light.matrix3;
        let (row, column) = (-self.size.x * axes.x_axis, -self.size.y * axes.y_axis);
        TexturedEmitter {
            corner: world_from_light.translation - 0.5 * (row + column),
            row,
            column,
            normal: -axes.z_axis,
            two_sided: self.two_sided,
            pattern: Arc::clone(channel),
        }
    }
}

impl TexturedEmitter {
    /// Area in m².
    pub fn area(&self) -> f64 {
        self.row.length() * self.column.length()
    }

    /// The point at shares u of a row and v of a column.
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.corner + u * self.row + v * self.column
    }

    /// The rectangle's corners: counter-clockwise for an eye on the lit side looking at it.
    pub fn corners(&self) -> [DVec3; 4] {
        [self.corner, self.corner + self.column, self.corner + self.row + self.column, self.corner + self.row]
    }
}
