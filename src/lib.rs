//! Softbox: design area lights, and see how exact, approximate and point-light shading differ.
//!
//! # Map of the code
//!
//! Each folder may use those above it and none below; `tests/layering.rs` holds that order.
//!
//! | folder | is for |
//! |---|---|
//! | [`math`] | angles, frames, spherical clipping, quadrature, special functions, Chebyshev fits |
//! | [`light`] | what a light is: one file a shape, and its photometric quantities |
//! | [`shading`] | what a light does at a point: [`shading::Method`], then one file a light shape |
//! | [`surface`] | primitives, materials, rays |
//! | [`visibility`] | what comes between a point and a light |
//! | [`contents`] | the bytes of a file that a scene names |
//! | [`scene`] | the document: load, save, validate, edit, history |
//! | [`render`] | CPU pictures |
//! | [`analysis`] | curves, errors, cost |
//! | [`gpu`] | shaders, and with the feature `gpu` the live preview, in layers |
//! | [`import`] | what others wrote, read as scenes and light presets |
//! | [`export`] | what leaves the program |
//! | [`cli`] | one file a subcommand |
//! | `editor` (feature `gui`) | the window |
//!
//! # Invariants
//!
//! - `math`, `light`, `shading`, `surface`, `visibility` do no I/O, log nothing and do not panic on data.
//! - The core is `f64`; `f32` is born in `gpu` only.
//! - Light emits along its local −Z; Z is up; lengths are metres; angles are radians but where a name ends in `_deg`.
//! - An [`light::Emitter`] is a light placed in the world at unit strength. Strength and tint are factors that come
//!   after shading, so that changing them never re-shades.

pub mod analysis;
pub mod cli;
pub mod contents;
pub mod export;
pub mod gpu;
pub mod import;
pub mod light;
pub mod math;
pub mod refs;
pub mod render;
pub mod scene;
pub mod shading;
pub mod surface;
pub mod visibility;

#[cfg(feature = "gui")]
pub mod editor;
