//! The live preview, in layers, so that work follows change.
//!
//! 1. *G-buffer*: what the camera sees, by casting rays at the surfaces (`gbuffer.rs`, `occluders.rs`).
//! 2. *Light layers*, one a light: its response at unit strength (`layers.rs`, `lights.rs`).
//! 3. *Shadow layers*, one a light: the share of it that is seen (`shadows.rs`).
//! 4. *Composite*: weights, materials, emitters, the tone curve, a running mean over samples (`composite.rs`).
//! 5. *Picture*: the mean as it is, two of them beside each other, or numbers in false colour (`display.rs`).
//!
//! f32 is born here. Everything is placed about the eye, in f64, before it is rounded.

mod composite;
mod context;
mod display;
mod gbuffer;
mod layers;
mod lights;
mod lobes;
mod occluders;
mod pass;
mod preview;
mod read_back;
mod sample;
mod shader;
mod shadows;
mod survey;
mod table;
#[cfg(test)]
mod tests;
mod textured;
pub mod twin;
mod types;
mod view;

pub use context::{Context, GpuError, device_descriptor};
pub use preview::{Preview, picture};
pub use read_back::{Pixels, ReadBackError};
pub use survey::{Survey, quantile};
pub use view::{Display, Stats, View};
