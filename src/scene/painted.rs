//! The files of patterns that were painted: in a folder of the scene's own, `lamp.patterns/` beside `lamp.toml`.

use std::io;
use std::path::Path;
use std::sync::Arc;

use image::ImageResult;

use super::Scene;
use super::beside::{self, folder_of, pattern_mut, pattern_of, read_file};
use super::pattern::encode;
use crate::contents::Contents;
use crate::light::pattern::{Image, Pattern};

/// What the own folders of scenes end with.
const FOLDER: &str = ".patterns";
/// What scenes are called that have no file yet.
const UNTITLED: &str = "untitled";

/// The folder of the patterns painted in the scene whose file is that.
fn own_folder(scene: Option<&Path>) -> String {
    let stem = scene.and_then(Path::file_stem).map_or(UNTITLED.into(), |stem| stem.to_string_lossy());
    format!("{}{FOLDER}", stem.replace(char::is_control, " "))
}

/// Whether a file is in the own folder of that scene, which no other scene writes to.
pub(super) fn is_own(file: &str, scene: &Path) -> bool {
    Path::new(file).parent() == Some(Path::new(&own_folder(Some(scene))))
}

/// A pattern that was painted over `old` in the scene whose file is `scene`, if it has one; no file holds it yet. Its
/// file is called as before, but in the scene's own folder.
pub fn painted_pattern(image: Image, old: &Pattern, scene: Option<&Path>) -> Pattern {
    let stem = Path::new(&old.file).file_stem().unwrap_or_default().to_string_lossy();
    Pattern::of_image(format!("{}/{stem}.png", own_folder(scene)), image)
}

/// What a pattern's file holds, and its extension: what it was read from, or exactly the texels of one that no file holds
/// yet.
///
/// # Errors
///
/// Where the memory for a file is not to be had.
pub fn pattern_file(pattern: &Pattern) -> ImageResult<(Contents, String)> {
    if pattern.contents.0.is_empty() {
        let (bytes, extension) = encode(&pattern.image)?;
        return Ok((Contents(Arc::from(bytes)), extension.to_owned()));
    }
    let extension = Path::new(&pattern.file).extension().unwrap_or_default().to_string_lossy();
    Ok((pattern.contents.clone(), extension.into_owned()))
}

/// The scene with a file for each of its painted patterns, to be saved as `path`; `None` where all have one.
///
/// Each is named in the scene's own folder, numbered where a file of that name is not known from `saved`, the scene as
/// it was last loaded from or saved to `path`: so nothing is replaced but what this scene itself has put there.
///
/// # Errors
///
/// Where the memory for a file is not to be had.
pub fn with_painted_files(scene: &Scene, path: &Path, saved: Option<&Scene>) -> ImageResult<Option<Scene>> {
    let mut painted: Vec<Pattern> = Vec::new();
    for pattern in scene.all_lights().filter_map(pattern_of) {
        let Pattern { file, contents, .. } = pattern;
        let displaced = || is_of_a_scene(file) && !may_be_put(file, contents, path, saved);
        if (contents.0.is_empty() || displaced()) && !painted.contains(pattern) {
            painted.push(pattern.clone());
        }
    }
    if painted.is_empty() {
        return Ok(None);
    }
    let mut scene = scene.clone();
    for old in painted {
        let file = Path::new(&old.file);
        let stem = file.file_stem().unwrap_or_default().to_string_lossy();
        let (contents, extension) = pattern_file(&old)?;
        let wanted = format!("{}/{stem}.{extension}", own_folder(Some(path)));
        let is_taken = |name: &str| {
            let mut others = scene.all_lights().filter_map(pattern_of);
            others.any(|other| other.file == name && other.image != old.image)
                || !may_be_put(name, &contents, path, saved)
        };
        let file = beside::free_name(&wanted, is_taken);
        for pattern in scene.all_lights_mut().filter_map(pattern_mut).filter(|pattern| **pattern == old) {
            (pattern.file, pattern.contents) = (file.clone(), contents.clone());
        }
    }
    Ok(Some(scene))
}

/// Whether a file is in the own folder of some scene, and so was painted.
fn is_of_a_scene(file: &str) -> bool {
    Path::new(file).parent().is_some_and(|folder| folder.to_string_lossy().ends_with(FOLDER))
}

/// Whether a file may stand beside the scene under that name: it does, or there is none, or one of the scene's own.
fn may_be_put(name: &str, contents: &Contents, path: &Path, saved: Option<&Scene>) -> bool {
    match read_file(folder_of(path), name) {
        Ok(there) => there == *contents.0 || (is_own(name, path) && is_known(name, &there, saved)),
        Err(error) => error.kind() == io::ErrorKind::NotFound,
    }
}

/// Whether the scene, as it was saved, has a pattern of that name with those bytes.
pub(super) fn is_known(name: &str, bytes: &[u8], saved: Option<&Scene>) -> bool {
    let mut patterns = saved.into_iter().flat_map(Scene::all_lights).filter_map(pattern_of);
    patterns.any(|pattern| pattern.file == name && *pattern.contents.0 == *bytes)
}
