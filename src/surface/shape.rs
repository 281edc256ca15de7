//! The primitives.

use glam::{DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
        }
    }
}
