//! Triangle meshes.

use std::fmt;
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::Triangle;
use crate::contents::Contents;

/// A mesh: a file's name as the scene file gives it, and the triangles in it. Copies share both.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Mesh {
    /// OBJ file, relative to the scene file and below its folder.
    pub file: String,
    /// In the surface's own frame; none until the file is read.
    #[serde(skip)]
    pub triangles: Arc<[Triangle]>,
    /// What the file holds.
    #[serde(skip)]
    pub contents: Contents,
}

impl Mesh {
    /// The mesh of that file, empty until it is read.
    pub fn unread(file: impl Into<String>) -> Self {
        Self { file: file.into(), triangles: Arc::default(), contents: Contents::default() }
    }
}

impl PartialEq for Mesh {
    /// Triangle by triangle, but for meshes that share them.
    fn eq(&self, other: &Self) -> bool {
        self.file == other.file
            && self.contents == other.contents
            && (Arc::ptr_eq(&self.triangles, &other.triangles) || self.triangles == other.triangles)
    }
}

impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Mesh({:?}, {} triangles)", self.file, self.triangles.len())
    }
}
