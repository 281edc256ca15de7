//! What comes between a point and a light.
//!
//! A surface is a shell: it hides what lies on its other side. So a solid hides what is inside it from a point outside,
//! and what is outside from a point within. The point's own surface, and what merely touches it or the light, hides
//! nothing on the side where both are.

mod cull;
mod hierarchy;
pub mod interval;
pub mod line;
mod objects;
pub mod polygon;

pub use hierarchy::{Hierarchy, Node};
pub use objects::{Objects, Structure, UnknownStructure};
