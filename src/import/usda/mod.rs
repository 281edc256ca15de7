//! UsdLux lights from OpenUSD's text files, `.usda`.
//!
//! A light is read as the schema of OpenUSD 25.05 means it: its luminance is intensity·2^exposure in nits, divided by its
//! area in the stage's units where `normalize` is on. Attributes without `inputs:`, from before 21.02, count, too. One
//! file is read: references, payloads and layers are told, not followed.

mod light;
mod mesh;
mod place;
mod prim;
mod sky;
mod stage;
mod text;
mod token;

use std::fs;
use std::io;
use std::path::Path;

use super::{Imported, Remark};
use crate::scene::{Scene, read_beside};
use stage::Reader;

/// What each file starts with.
const START: &str = "#usda";

/// Files larger than this are refused, bytes.
pub const MOST_BYTES: u64 = 256 << 20;

/// Why a file is not read at all.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UsdaError {
    /// Not text of this kind.
    #[error("is no .usda text: its first line must start with `#usda`; save it as .usda")]
    OtherFormat,
    /// Too large.
    #[error("is larger than {} MiB", MOST_BYTES >> 20)]
    TooLarge,
    /// It cannot be read.
    #[error("cannot be read: {0}")]
    Read(String),
    /// Something that is not understood in the text itself.
    #[error("{line}: {what}")]
    Syntax {
        /// From 1.
        line: usize,
        /// What stands there, and what should.
        what: String,
    },
    /// No light that Softbox could hold.
    #[error("has no lights that could be read{}", first(remarks))]
    NoLights {
        /// Why not those that it has.
        remarks: Vec<Remark>,
    },
}

fn first(remarks: &[Remark]) -> String {
    remarks.first().map_or_else(String::new, |remark| format!("; line {remark}"))
}

/// The lights of a file, with the pictures beside it.
///
/// # Errors
///
/// Where it cannot be read, and as [`read`].
pub fn read_file(path: &Path) -> Result<Imported, UsdaError> {
    let cannot = |cause: io::Error| UsdaError::Read(cause.to_string());
    if fs::metadata(path).map_err(cannot)?.len() > MOST_BYTES {
        return Err(UsdaError::TooLarge);
    }
    let bytes = fs::read(path).map_err(cannot)?;
    if !bytes.starts_with(START.as_bytes()) {
        return Err(UsdaError::OtherFormat);
    }
    let text = String::from_utf8(bytes).map_err(|_not_utf8| UsdaError::OtherFormat)?;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    read(&text, &name, &mut |name| read_beside(path, name))
}

/// The lights of a stage, in metres and Z up; `read` gives the bytes of the file of a name beside it.
///
/// # Errors
///
/// Where the text is not understood, or has no light that a scene could hold.
pub fn read(text: &str, name: &str, read: &mut dyn FnMut(&str) -> io::Result<Vec<u8>>) -> Result<Imported, UsdaError> {
    if !text.starts_with(START) {
        return Err(UsdaError::OtherFormat);
    }
    let layer = text::layer(text)?;
    let mut reader = Reader::new(&layer, read);
    reader.prims();
    let (lights, remarks) = reader.finished();
    if lights.is_empty() {
        return Err(UsdaError::NoLights { remarks });
    }
    Ok(Imported { scene: Scene { name: name.to_owned(), lights, ..Scene::default() }, remarks })
}
