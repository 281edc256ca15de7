//! A disk light.

use std::f64::consts::{PI, TAU};

use glam::{DAffine3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A flat disk in the light's XY plane about its origin, Lambertian with constant luminance.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Disk {
    /// Radius in metres.
    pub radius: f64,
    /// Emits to both sides.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub two_sided: bool,
}

/// A [`Disk`] in the world, luminance 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiskEmitter {
    /// Centre.
    pub center: DVec3,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// Radius in metres.
    pub radius: f64,
    /// Emits to both sides.
    pub two_sided: bool,
}

impl Disk {
    /// Φ/L = π·πr² a side.
    pub fn flux_per_luminance(&self) -> f64 {
        PI * PI * self.radius * self.radius * if self.two_sided { 2.0 } else { 1.0 }
    }

    /// The disk in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> DiskEmitter {
        DiskEmitter {
            center: world_from_light.translation,
            normal: -world_from_light.matrix3.z_axis,
            radius: self.radius,
            two_sided: self.two_sided,
        }
    }
}

impl DiskEmitter {
    /// Points on the rim at equal distances, counter-clockwise for an eye on the lit side.
    pub fn rim(&self, points: u32) -> impl Iterator<Item = DVec3> {
        let Self { center, normal, radius, .. } = *self;
        let (u, v) = normal.any_orthonormal_pair();
        (0..points).map(move |i| {
            let (sin, cos) = (TAU * f64::from(i) / f64::from(points)).sin_cos();
            center + radius * (cos * u + sin * v)
        })
    }

    /// Area in m².
    pub fn area(&self) -> f64 {
        PI * self.radius * self.radius
    }
}
