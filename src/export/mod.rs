//! What leaves the program: one file a format. Every writer gives bytes; putting them in a file is up to the caller.
//!
//! [`export()`] writes a scene, or some of its lights, for a [`Target`], and says what becomes of each thing. The other
//! modules encode single results: a picture, a plot, a map of errors.

mod blender;
pub mod csv;
mod emission;
pub mod error_map;
pub mod exr;
mod facets;
mod gloss;
mod glsl;
mod gltf;
mod ies;
mod intensities;
mod job;
mod json;
mod mitsuba;
mod origin;
mod picture;
pub mod plot;
mod plots;
pub mod png;
pub mod preflight;
mod radiance;
mod shader;
pub mod sheet;
pub mod svg;
mod target;
mod texture;
mod usda;
mod wgsl;

pub use job::{ExportError, Exported, File, Job, Options};
pub use origin::Origin;
pub use preflight::{Fate, Remark};
pub use target::{Target, UnknownTarget};

use crate::render::Progress;

/// The files of a job and what becomes of each thing in it. The same job gives the same files.
///
/// # Errors
///
/// Where a light is not in the scene, the target can hold nothing of it, or the work is cancelled.
pub fn export(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    match job.target {
        Target::Gltf => gltf::write(job, progress),
        Target::Mitsuba => mitsuba::write(job, progress),
        Target::Radiance => radiance::write(job, progress),
        Target::Blender => blender::write(job, progress),
        Target::Usda => usda::write(job, progress),
        Target::Ies => ies::write(job, progress),
        Target::Json => json::write(job, progress),
        Target::Csv | Target::Svg => plots::write(job, progress),
        Target::Png | Target::Exr => picture::write(job, progress),
        Target::Wgsl => wgsl::write(job, progress),
        Target::Glsl => glsl::write(job, progress),
    }
}
