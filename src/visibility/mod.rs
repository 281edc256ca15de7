//! What comes between a point and a light.
//!
//! A surface is a shell: it hides what lies on its other side. So a solid hides what is inside it from a point outside,
//! and what is outside from a point within. The point's own surface, and what merely touches it or the light, hides
//! nothing on the side where both are.

mod cull;
mod grid;
mod hierarchy;
pub mod interval;
mod light_buffer;
pub mod line;
mod objects;
pub mod polygon;
mod structure;

pub use hierarchy::{Hierarchy, Node};
pub(crate) use objects::AT_END;
pub use objects::Objects;
pub use structure::{Structure, Structures, UnknownStructure};

#[cfg(test)]
mod tests;
