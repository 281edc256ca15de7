//! The presets that come with the program.

use std::fs;
use std::path::Path;

use softbox::render::{MethodChoice, Progress, Settings, Shadows, render};
use softbox::scene::{self, Scene};
use softbox::shading::Method;

use super::names;

/// The presets in a folder: file name, text and scene.
fn presets(folder: &str) -> Vec<(String, String, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets").join(folder);
    let open = |name: String| {
        let text = fs::read_to_string(folder.join(&name)).expect("a preset is text");
        let scene = scene::load(folder.join(&name)).unwrap_or_else(|error| panic!("{error}"));
        (name, text, scene)
    };
    names(&folder).into_iter().filter(|name| name.ends_with(".toml")).map(open).collect()
}

/// The presets of every kind.
fn all() -> Vec<(String, String, Scene)> {
    ["scenes", "lights", "figures"].into_iter().flat_map(presets).collect()
}

#[test]
fn every_preset_opens_and_is_saved_byte_for_byte() {
    for (name, text, scene) in all() {
        assert_eq!(scene::to_toml(&scene), text, "{name} is as Softbox writes it");
        assert!(!scene.name.is_empty(), "{name} has a title");
    }
}

#[test]
fn there_are_enough_presets_of_each_kind() {
    let (scenes, lights) = (presets("scenes"), presets("lights"));
    assert!(scenes.len() >= 16 && lights.len() >= 24, "{} scenes, {} lights", scenes.len(), lights.len());
    for (name, _, scene) in scenes.iter().chain(&lights) {
        assert!(scene.tags.len() >= 2, "{name} is found by its tags {:?}", scene.tags);
    }
    for (name, _, scene) in &scenes {
        assert!(!scene.lights.is_empty() && !scene.plots.is_empty(), "{name} has lights and plots");
    }
    for (name, _, scene) in &lights {
        let only_lights = Scene {
            name: scene.name.clone(),
            tags: scene.tags.clone(),
            lights: scene.lights.clone(),
            ..Scene::default()
        };
        assert!(!scene.lights.is_empty(), "{name} has a light");
        assert_eq!(*scene, only_lights, "{name} has nothing else");
    }
}

#[test]
fn preset_scenes_show_all_that_the_schema_knows() {
    let all: String = presets("scenes").into_iter().map(|(_, text, _)| text).collect();
    for (definition, pattern) in [("Shape", "{ NAME = "), ("Shape2", "{ NAME = "), ("PlotKind", "kind = \"NAME\"")] {
        let schema = scene::schema();
        let variants = schema["$defs"][definition]["oneOf"].as_array().expect("an enum of the format");
        for variant in variants {
            let name = variant["const"].as_str().or(variant["required"][0].as_str()).expect("a name");
            assert!(all.contains(&pattern.replace("NAME", name)), "no scene has {name}");
        }
    }
}

#[test]
fn every_preset_renders_finite_and_lit() {
    let settings = Settings {
        size: [24, 14],
        choice: MethodChoice::Method(Method::Exact),
        samples: 1,
        shadows: Shadows::default(),
    };
    let floor = scene::first_light();
    for (name, _, mut preset) in all() {
        if preset.surfaces.is_empty() {
            // A light alone is shown over a floor.
            preset.surfaces = floor.surfaces.clone();
            preset.materials = floor.materials.clone();
        }
        let film = render(&preset, &settings, &Progress::default()).expect("not cancelled");
        assert!(film.radiance().iter().all(|pixel| pixel.is_finite()), "{name} is finite");
        assert!(film.radiance().iter().any(|pixel| pixel.max_element() > 0.0), "{name} is lit");
    }
}
