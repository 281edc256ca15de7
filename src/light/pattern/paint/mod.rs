//! Painting patterns: pictures, and what may be done to them texel by texel.
//!
//! A [`Canvas`] holds linear values. A [`Mask`] says how far each texel is covered by a stroke or a shape; brushes and
//! shapes make masks, [`Canvas::painted`] lays a colour through one. [`adjust`] has what changes a whole picture,
//! [`fill`] what depends on the picture itself, and [`Preset`] pictures to start from.

pub mod adjust;
mod brush;
mod canvas;
pub mod fill;
mod mask;
mod preset;
mod symmetry;

pub use brush::{Brush, Stroke};
pub use canvas::{Area, Canvas, Rgb};
pub use mask::{Mask, ellipse, rectangle};
pub use preset::{Parameter, Preset};
pub use symmetry::Symmetry;
