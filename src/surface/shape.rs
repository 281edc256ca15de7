//! The primitives.

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Mesh;

/// The shape of a surface in its own frame. Solids are centred on the origin; axes of revolution are Z.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Shape {
    /// The infinite plane z = 0.
    Plane {},
    /// A sphere.
    Sphere {
        /// Radius in metres.
        radius: f64,
    },
    /// A box.
    Box {
        /// Edge lengths in metres.
        #[schemars(with = "[f64; 3]")]
        size: DVec3,
    },
    /// A rectangle in the plane z = 0.
    Square {
        /// Edge lengths in metres.
        #[schemars(with = "[f64; 2]")]
        size: DVec2,
    },
    /// A disk in the plane z = 0.
    Disk {
        /// Radius in metres.
        radius: f64,
    },
    /// A closed cylinder about Z, from −height/2 to height/2.
    Cylinder {
        /// Radius in metres.
        radius: f64,
        /// Height in metres.
        height: f64,
    },
    /// A closed cone about Z, base at −height/2, apex at height/2.
    Cone {
        /// Radius of the base in metres.
        radius: f64,
        /// Height in metres.
        height: f64,
    },
    /// A ball with nine of a third of its radius on it, and so on; the first has a radius of 0.5 m.
    Sphereflake {
        /// How often balls are put on balls: 2 gives 91 of them.
        depth: u32,
    },
    /// A regular tetrahedron with an edge of 1 m and one corner on +Z, of smaller ones in its corners, and so on.
    Tetrahedron {
        /// How often it is divided: 5 gives 4096 triangles.
        depth: u32,
    },
    /// A bicubic Bézier patch.
    Patch {
        /// In rows of four, metres.
        #[schemars(with = "[[f64; 3]; 16]")]
        control_points: Box<[DVec3; 16]>,
    },
    /// A triangle mesh in a file.
    Mesh(Mesh),
}

impl Shape {
    /// The name of the shape in files and on screen.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Plane {} => "plane",
            Self::Sphere { .. } => "sphere",
            Self::Box { .. } => "box",
            Self::Square { .. } => "square",
            Self::Disk { .. } => "disk",
            Self::Cylinder { .. } => "cylinder",
            Self::Cone { .. } => "cone",
            Self::Sphereflake { .. } => "sphereflake",
            Self::Tetrahedron { .. } => "tetrahedron",
            Self::Patch { .. } => "patch",
            Self::Mesh(_) => "mesh",
        }
    }
}
