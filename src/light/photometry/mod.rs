//! Measured intensities of a point light, and the photometric file that they come from.

mod distribution;
pub mod lm63;

pub use distribution::Distribution;

use std::borrow::Cow;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

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

impl Serialize for Photometry {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.file.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Photometry {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Self::unread)
    }
}

impl JsonSchema for Photometry {
    fn schema_name() -> Cow<'static, str> {
        String::schema_name()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        String::json_schema(generator)
    }
}
