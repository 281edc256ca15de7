//! Scene files: loading, refusing, saving, merging, and the presets.

mod exports;
mod merging;
mod painted;
mod patterns;
mod photometry;
mod presets;
mod random;
mod refusals;
mod saving;
mod surfaces;
mod usda;
mod variants;

use std::fs;
use std::path::Path;

use softbox::scene::{self, Scene};

/// A scene that is right; the tests below make it wrong.
const WINDOW: &str = include_str!("../data/window.toml");

/// Its light's shape.
const SHAPE: &str = "polygon = { vertices = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]] }";

/// All vertices of its light but the first.
const VERTICES: &str = "[1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]";

/// What loading `text` says is wrong with it, one problem a line.
#[track_caller]
fn refusal(text: &str) -> String {
    match scene::parse(text, "window.toml") {
        Ok(_) => panic!("this loads, but should not:\n{text}"),
        Err(error) => error.to_string(),
    }
}

/// The scene with one passage replaced.
#[track_caller]
fn with(passage: &str, replacement: &str) -> String {
    assert_eq!(WINDOW.matches(passage).count(), 1, "`{passage}` must stand in the scene once");
    WINDOW.replace(passage, replacement)
}

#[track_caller]
fn check(passage: &str, replacement: &str, expected: &str) {
    assert_eq!(refusal(&with(passage, replacement)), expected, "`{passage}` replaced by `{replacement}`");
}

fn window() -> Scene {
    scene::parse(WINDOW, "window.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// The names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).expect("the folder is there").map(|entry| entry.expect("an entry").file_name()).collect();
    names.sort();
    names.into_iter().map(|name| name.into_string().expect("a name in Unicode")).collect()
}
