//! Measured intensities of a point light, and the photometric file that they come from.

mod distribution;
pub mod lm63;

pub use distribution::Distribution;

use std::sync::Arc;

use crate::contents::Contents;

/// A photometric file: its name as the scene file gives it, and the intensities in it. Copies share both.
#[derive(Clone, Debug, PartialEq)]
pub struct Photometry {
    /// Relative to the scene file, and below its folder.
    pub file: String,
    /// What the file holds.
    pub distribution: Arc<Distribution>,
    /// The file itself, to be saved beside another scene.
    pub contents: Contents,
}

impl Photometry {
    /// That of a file, isotropic until the file is read.
    pub fn unread(file: impl Into<String>) -> Self {
        let distribution = Arc::new(Distribution::isotropic());
        Self { file: file.into(), distribution, contents: Contents::default() }
    }
}

written_as_file!(Photometry);
