//! What rays meet and what casts shadows.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::{Patch, Triangle};

/// A surface, or the part of one that is met as a whole. Solids are centred on the origin; axes of revolution are Z.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    /// The infinite plane z = 0.
    Plane,
    /// A sphere.
    Sphere {
        /// Radius in metres.
        radius: f64,
    },
    /// A box.
    Box {
        /// Edge lengths in metres.
        size: DVec3,
    },
    /// A rectangle in the plane z = 0.
    Square {
        /// Edge lengths in metres.
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
    /// A triangle of a mesh.
    Triangle(Triangle),
    /// A bicubic patch.
    Patch(Arc<Patch>),
}
