//! The format as a JSON Schema, draft 2020-12.

use super::file::File;

/// The JSON Schema of scene files and light presets. The loader checks a file's structure against it.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(File).to_value()
}
