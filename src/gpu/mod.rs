//! The live preview, in layers, so that work follows change.
//!
//! 1. *G-buffer*: what the camera sees, by casting rays at the surfaces (`gbuffer.rs`, `occluders.rs`).
//! 2. *Light layers*, one a light: its response at unit strength (`layers.rs`, `lights.rs`).
//! 3. *Shadow layers*, one a light: the share of it that is seen (`shadows.rs`).
//! 4. *Composite*: weights, materials, emitters, the tone curve, a running mean over samples (`composite.rs`).
//! 5. *Picture*: the mean as it is, two of them beside each other, or numbers in false colour (`display.rs`).
//!
//! The texts of the shaders and the data that they read need no device, and are there without the feature `gpu` too: `export`
//! makes shader functions of them.
//!
//! f32 is born here. Everything is placed about the eye, in f64, before it is rounded.

#![cfg_attr(not(feature = "gpu"), expect(dead_code, reason = "the preview has more shaders than lights do"))]

mod cells;
pub(crate) mod lights;
pub(crate) mod lobes;
pub(crate) mod shader;
pub(crate) mod table;
mod textured;
pub(crate) mod types;

#[cfg(feature = "gpu")]
mod composite;
#[cfg(feature = "gpu")]
mod context;
#[cfg(feature = "gpu")]
mod display;
#[cfg(feature = "gpu")]
mod gbuffer;
#[cfg(feature = "gpu")]
mod layers;
#[cfg(feature = "gpu")]
mod occluders;
#[cfg(feature = "gpu")]
mod pass;
#[cfg(feature = "gpu")]
mod passes;
#[cfg(feature = "gpu")]
mod points;
#[cfg(feature = "gpu")]
mod preview;
#[cfg(feature = "gpu")]
mod read_back;
#[cfg(feature = "gpu")]
mod sample;
#[cfg(feature = "gpu")]
mod shadows;
#[cfg(feature = "gpu")]
mod survey;
#[cfg(feature = "gpu")]
mod tables;
#[cfg(all(test, feature = "gpu"))]
mod tests;
#[cfg(feature = "gpu")]
pub mod twin;
#[cfg(feature = "gpu")]
mod view;

#[cfg(feature = "gpu")]
pub use context::{Context, GpuError, device_descriptor};
#[cfg(feature = "gpu")]
pub use passes::SharedPasses;
#[cfg(feature = "gpu")]
pub use points::layer_at;
#[cfg(feature = "gpu")]
pub use preview::{Preview, picture};
#[cfg(feature = "gpu")]
pub use read_back::{Pixels, ReadBackError};
#[cfg(feature = "gpu")]
pub use survey::{Survey, quantile};
#[cfg(feature = "gpu")]
pub use view::{Display, Stats, View};
