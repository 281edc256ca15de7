//! The photometric files of a scene's point lights: read and refused.

use std::io;
use std::path::Path;
use std::sync::Arc;

use super::beside::{self, Imported};
use super::{Problem, Scene};
use crate::contents::Contents;
use crate::light::photometry::{Photometry, lm63};

/// Read the photometric files of a scene, each once; `read` gives the bytes of the file of a name. What is wrong with
/// them is returned.
pub(super) fn read_all(scene: &mut Scene, mut read: impl FnMut(&str) -> io::Result<Vec<u8>>) -> Vec<Problem> {
    let photometries = beside::photometries_mut(scene).into_iter();
    beside::read_each(photometries, |photometry| &photometry.file, |name| read_photometry(name, &mut read))
}

fn read_photometry(name: &str, read: &mut impl FnMut(&str) -> io::Result<Vec<u8>>) -> Result<Photometry, String> {
    let bytes = read(name).map_err(|cause| {
        format!("`{name}` cannot be read: {cause}; write the name of an IES file in the scene's folder")
    })?;
    photometry_of_bytes(name, bytes)
}

/// The photometry of that name that the bytes of an IES file hold. What is wrong with them is one line.
pub fn photometry_of_bytes(file: &str, bytes: Vec<u8>) -> Result<Photometry, String> {
    let distribution = lm63::read(&bytes).map_err(|wrong| format!("`{file}`{wrong}"))?;
    Ok(Photometry { file: file.to_owned(), distribution: Arc::new(distribution), contents: Contents(bytes.into()) })
}

/// Read an IES file from anywhere for the scene whose file is `scene`, if it has one.
///
/// A file below the scene's folder keeps its place; any other is called `photometry/` and its own name, numbered where
/// the folder has another file of that name, and is put there when the scene is saved. What is wrong with it is one line.
pub fn import_photometry(path: &Path, scene: Option<&Path>) -> Result<Photometry, String> {
    let imported = Imported::read(path)?;
    let photometry = photometry_of_bytes(&imported.own_name, imported.bytes.clone())?;
    Ok(Photometry { file: imported.name(path, scene, "photometry"), ..photometry })
}
