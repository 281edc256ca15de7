//! Holds the order of the code: each folder of `src/` uses only what it may.

use std::fs;
use std::path::{Path, PathBuf};

/// What each folder may use besides itself and `refs`.
const MAY_USE: &[(&str, &[&str])] = &[
    ("math", &[]),
    ("light", &["math"]),
    ("shading", &["math", "light"]),
    ("surface", &["math"]),
    ("visibility", &["math", "light", "surface"]),
    ("scene", &["math", "light", "surface"]),
    ("import", &["math", "light", "surface", "scene"]),
    ("render", &["math", "light", "shading", "surface", "visibility", "scene"]),
    ("analysis", &["math", "light", "shading", "surface", "visibility", "scene", "render"]),
    ("gpu", &["math", "light", "shading", "surface", "visibility", "scene", "render"]),
    ("export", &["math", "light", "shading", "surface", "visibility", "scene", "render", "analysis", "gpu"]),
    ("cli", BENEATH_THE_USER),
    ("editor", BENEATH_THE_USER),
];

/// What a user meets stands on all the others.
const BENEATH_THE_USER: &[&str] =
    &["math", "light", "shading", "surface", "visibility", "scene", "render", "analysis", "gpu", "export", "import"];

/// Folders that compute and do nothing else.
const PURE: &[&str] = &["math", "light", "shading", "surface", "visibility"];

/// What a pure folder must not mention: input and output, logging, and the GPU's number type.
const NOT_IN_PURE: &[&str] =
    &["std::fs", "std::io", "std::net", "std::process", "log::", "println!", "eprintln!", "dbg!", "f32"];

/// Image data, which images give in single precision, may stay so in these files.
const IMAGE_DATA: &[&str] = &["light/pattern", "scene/pattern", "scene/history"];

/// Where single precision may be born.
const SINGLE_PRECISION: &[&str] = &["gpu", "editor", "export", "render", "cli", "analysis"];

/// What is wrong with one line of a file in `folder`.
fn faults(folder: &str, line: &str) -> Vec<String> {
    let code = line.split("//").next().unwrap_or_default();
    let allowed = MAY_USE.iter().find(|(name, _)| *name == folder).map_or(&[][..], |(_, uses)| *uses);
    let mut faults = Vec::new();
    for (at, _) in code.match_indices("crate::") {
        let name: String =
            code[at + "crate::".len()..].chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        let is_folder = MAY_USE.iter().any(|(known, _)| *known == name);
        if is_folder && name != folder && !allowed.contains(&name.as_str()) {
            faults.push(format!("`{folder}` must not use `{name}`"));
        }
    }
    if PURE.contains(&folder) {
        faults.extend(
            NOT_IN_PURE.iter().filter(|word| code.contains(**word)).map(|word| format!("`{word}` in pure `{folder}`")),
        );
    } else if code.contains("f32") && !SINGLE_PRECISION.contains(&folder) {
        faults.push(format!("f32 in `{folder}`"));
    }
    faults
}

fn files_of(folder: &Path, kind: &str, files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).expect("src is readable");
    for entry in entries {
        let path = entry.expect("src is readable").path();
        if path.is_dir() {
            files_of(&path, kind, files);
        } else if path.extension().is_some_and(|extension| extension == kind) {
            files.push(path);
        }
    }
}

fn source_folders() -> Vec<String> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut names: Vec<String> = fs::read_dir(src)
        .expect("src is readable")
        .map(|entry| entry.expect("src is readable").path())
        .filter(|path| path.is_dir())
        .map(|path| path.file_name().expect("a folder has a name").to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn every_folder_uses_only_what_lies_before_it() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut found = Vec::new();
    let mut lines = 0;
    for folder in source_folders() {
        let mut files = Vec::new();
        files_of(&src.join(&folder), "rs", &mut files);
        for file in files {
            let text = fs::read_to_string(&file).expect("a source file is readable");
            for (number, line) in text.lines().enumerate() {
                lines += 1;
                if line.contains("f32") && IMAGE_DATA.iter().any(|name| file.to_string_lossy().contains(name)) {
                    continue;
                }
                found.extend(
                    faults(&folder, line).iter().map(|fault| format!("{}:{}: {fault}", file.display(), number + 1)),
                );
            }
        }
    }
    assert!(lines > 100, "only {lines} lines were read: the test looks in the wrong place");
    assert!(found.is_empty(), "layering is broken:\n{}", found.join("\n"));
}

#[test]
fn every_folder_has_its_place_in_the_order() {
    let known: Vec<&str> = MAY_USE.iter().map(|(name, _)| *name).collect();
    for folder in source_folders() {
        assert!(known.contains(&folder.as_str()), "src/{folder} has no place in MAY_USE");
    }
}

#[test]
fn shaders_cite_only_what_is_in_the_bibliography() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let refs = fs::read_to_string(src.join("refs.rs")).expect("the bibliography is readable");
    let mut files = Vec::new();
    files_of(&src.join("gpu/shaders"), "wgsl", &mut files);
    let mut cited = 0;
    for file in files {
        let text = fs::read_to_string(&file).expect("a shader is readable");
        let names = text.split('[').skip(1).filter_map(|rest| rest.split_once(']')).map(|(name, _)| name);
        let is_citation =
            |name: &&str| name.contains('_') && name.chars().all(|c| matches!(c, 'A'..='Z' | '0'..='9' | '_'));
        for name in names.filter(is_citation) {
            cited += 1;
            assert!(refs.contains(&format!("pub const {name}:")), "{}: {name} is not in refs.rs", file.display());
        }
    }
    assert!(cited > 5, "only {cited} citations were found: the test looks for the wrong thing");
}

#[test]
fn a_planted_fault_is_found() {
    for (folder, line) in [
        ("math", "use crate::light::Light;"),
        ("shading", "let s = crate::scene::Scene::default();"),
        ("light", "std::fs::read(path)"),
        ("surface", "let x: f32 = 0.0;"),
        ("scene", "use crate::render::Film;"),
        ("render", "use crate::editor::Session;"),
    ] {
        assert!(!faults(folder, line).is_empty(), "`{line}` in `{folder}` passed");
    }
    assert!(faults("render", "use crate::scene::Scene; // crate::editor").is_empty(), "a sound line was refused");
}
