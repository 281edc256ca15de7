//! `softbox export`: what is written, what is said, and when nothing is.

use std::fs;

use serde_json::Value;

use super::{WINDOW, check_done, check_refused, folder, names, run, shown, text};

/// Lights of every kind, materials and surfaces.
const EVERYTHING: &str = "tests/data/everything.toml";

#[test]
fn json_says_what_the_scene_file_says() {
    let folder = folder();
    let output = folder.path().join("everything.json");
    let written = || {
        check_done(&run(&["export", EVERYTHING, "-o", shown(&output)]));
        fs::read_to_string(&output).expect("it is written")
    };
    let first = written();
    assert!(first == written(), "the second differs");
    let json: Value = serde_json::from_str(&first).expect("JSON");
    assert_eq!(json["generator"], concat!("Softbox ", env!("CARGO_PKG_VERSION")), "who wrote it");
    assert_eq!(json["file"], "everything.toml", "of what");
    let toml: toml::Table = fs::read_to_string(EVERYTHING).expect("the scene").parse().expect("TOML");
    let (lights, shines) = (&toml["light"], |light: &&toml::Value| light.get("muted") != Some(&true.into()));
    let lights: Vec<_> = lights.as_array().expect("lights").iter().filter(shines).collect();
    let found = json["scene"]["light"].as_array().expect("lights");
    assert_eq!(found.len(), lights.len(), "each light that shines");
    for (found, light) in found.iter().zip(lights) {
        assert_eq!(found["name"].as_str(), light["name"].as_str(), "in their order");
        assert_eq!(found["position"], serde_json::to_value(light.get("position")).expect("a position"), "{found}");
    }
    let schema: Value = serde_json::from_slice(&run(&["schema"]).stdout).expect("a schema");
    let known = schema["properties"].as_object().expect("keys");
    let unknown: Vec<_> = json["scene"].as_object().expect("keys").keys().filter(|k| !known.contains_key(*k)).collect();
    assert!(unknown.is_empty(), "the scene's schema does not know {unknown:?}");
}

#[test]
fn a_dry_run_says_what_an_export_says_and_writes_nothing() {
    let folder = folder();
    let output = folder.path().join("window.json");
    let dry = run(&["export", WINDOW, "-o", shown(&output), "--dry-run"]);
    check_done(&dry);
    assert!(names(folder.path()).is_empty(), "something is written");
    let wet = run(&["export", WINDOW, "-o", shown(&output)]);
    check_done(&wet);
    assert_eq!(text(&dry.stdout), text(&wet.stderr), "what is said");
    assert!(text(&dry.stdout).contains("kept     light \"window\""), "{}", text(&dry.stdout));
    check_done(&run(&["export", WINDOW, "--to", "json", "--dry-run"]));
}

#[test]
fn chosen_lights_go_alone_and_surfaces_may_stay() {
    let folder = folder();
    let output = folder.path().join("one.json");
    let arguments = ["export", EVERYTHING, "-o", shown(&output), "--no-surfaces", "--light", "moon", "--light", "tube"];
    check_done(&run(&arguments));
    let json: Value = serde_json::from_slice(&fs::read(&output).expect("it is written")).expect("JSON");
    let found: Vec<_> = json["scene"]["light"].as_array().expect("lights").iter().map(|light| &light["name"]).collect();
    assert_eq!(found.len(), 2, "{found:?}");
    assert!(json["scene"].get("surface").is_none(), "surfaces");
}

#[test]
fn what_is_not_there_or_cannot_be_written_is_one_line() {
    let folder = folder();
    let nowhere = folder.path().join("nowhere/a.json");
    let there = folder.path().join("a.json");
    check_refused(&["export", WINDOW, "-o", shown(&nowhere)], "cannot be written");
    check_refused(&["export", WINDOW, "-o", shown(folder.path()), "--to", "json"], "not a regular file");
    check_refused(&["export", WINDOW, "-o", shown(&there), "--light", "windw"], "did you mean `window`?");
    check_refused(&["export", WINDOW, "-o", "a.txt"], "without --to");
    check_refused(&["export", WINDOW, "-o", "a.txt", "--to", "pdf"], "`pdf` is not known");
    check_refused(&["export", WINDOW, "--to", "json"], "--output");
    check_refused(&["export", WINDOW, "--dry-run"], "--to");
    assert!(names(folder.path()).is_empty(), "something is written");
}
