//! Primitives, their materials, and rays against them.

mod fractal;
mod intersect;
mod material;
mod mesh;
mod patch;
#[cfg(test)]
mod patch_tests;
mod primitive;
mod ray;
mod shape;
mod support;
mod triangle;

pub use fractal::{MOST_FLAKE_DEPTH, MOST_TETRAHEDRON_DEPTH};
pub(crate) use intersect::ON_SURFACE;
pub use material::{Material, ReflectionModel};
pub use mesh::Mesh;
pub use patch::{Patch, PatchPoint};
pub use primitive::Primitive;
pub use ray::{Bounds, Hit, Placed};
pub use shape::Shape;
pub use triangle::Triangle;

use glam::{DAffine3, DMat3, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::frame;

/// A surface as a scene file states it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Unique among the surfaces of a scene.
    pub name: String,
    /// Name of its material.
    pub material: String,
    /// Origin of its own frame, metres.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(with = "[f64; 3]")]
    pub position: DVec3,
    /// Rotation of its own frame, R = Rz·Ry·Rx, degrees.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(with = "[f64; 3]")]
    pub rotation_deg: DVec3,
    /// Scale along its own axes, before rotation.
    #[serde(default = "one", skip_serializing_if = "is_one")]
    #[schemars(with = "[f64; 3]")]
    pub scale: DVec3,
    /// Shape, in its own frame.
    pub shape: Shape,
}

impl Surface {
    /// The transform from the surface's own frame to the world.
    pub fn world_from_surface(&self) -> DAffine3 {
        DAffine3::from_mat3_translation(
            frame::rotation_from_deg(self.rotation_deg) * DMat3::from_diagonal(self.scale),
            self.position,
        )
    }
}

fn is_zero(v: &DVec3) -> bool {
    *v == DVec3::ZERO
}

fn one() -> DVec3 {
    DVec3::ONE
}

fn is_one(v: &DVec3) -> bool {
    *v == DVec3::ONE
}
