//! What comes into the program from files that others wrote, as scenes and light presets.

pub mod usda;

use crate::scene::Scene;

/// What a file gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// Its lights.
    pub scene: Scene,
    /// What is not as it was there, or not there at all.
    pub remarks: Vec<Remark>,
}

/// Something that is not as it was in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Its line in the file, from 1.
    pub line: usize,
    /// What it is and what became of it.
    pub what: String,
}

impl std::fmt::Display for Remark {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.line, self.what)
    }
}
