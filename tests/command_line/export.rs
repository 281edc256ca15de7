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
    check_refused(&["export", WINDOW, "-o", "a.txt", "--to", "pdf"], "possible values: usda, ");
    check_refused(&["export", WINDOW, "--to", "json"], "--output");
    check_refused(&["export", WINDOW, "--dry-run"], "--to");
    assert!(names(folder.path()).is_empty(), "something is written");
}

#[test]
fn nothing_is_written_while_something_would_be_lost() {
    let folder = folder();
    let output = folder.path().join("everything.usda");
    let arguments = ["export", EVERYTHING, "-o", shown(&output)];
    let refused = run(&arguments);
    assert_eq!(refused.status.code(), Some(2), "{}", text(&refused.stderr));
    assert!(text(&refused.stderr).contains("lost     light \"slow tube\""), "{}", text(&refused.stderr));
    assert!(text(&refused.stderr).lines().last().is_some_and(|line| line.contains("--allow-loss")), "what to do");
    assert!(names(folder.path()).is_empty(), "something is written");
    check_done(&run(&[&arguments[..], &["--allow-loss"]].concat()));
    let stage = fs::read_to_string(&output).expect("it is written");
    let header = concat!("# Softbox ", env!("CARGO_PKG_VERSION"), ", scene everything.toml\n");
    assert!(stage.starts_with("#usda 1.0\n") && stage.contains(header), "it names its maker and the scene");
    assert!(stage.contains("# lost     light \"slow tube\""), "and what is lost");
    assert!(!stage.contains("\"slow_tube\""), "and has it not");
}

#[test]
fn all_files_are_written_or_none() {
    let folder = folder();
    let output = folder.path().join("leaves.usda");
    let picture = folder.path().join("leaves-leaves.exr");
    fs::create_dir(&picture).expect("a folder in the picture's place");
    check_refused_at_its_end(&["export", "presets/lights/leaf-gobo.toml", "-o", shown(&output)], "leaves-leaves.exr");
    assert!(names(folder.path()).iter().eq([&picture]), "something is written");
    fs::remove_dir(&picture).expect("it is empty");
    check_done(&run(&["export", "presets/lights/leaf-gobo.toml", "-o", shown(&output)]));
    assert!(picture.is_file() && output.is_file(), "both are written");
}

/// Status 2, and a last line that says `expected`.
#[track_caller]
fn check_refused_at_its_end(arguments: &[&str], expected: &str) {
    let output = run(arguments);
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?} said: {said}");
    assert!(
        said.lines().last().is_some_and(|line| line.contains(expected)),
        "{arguments:?} should end with `{expected}`: {said}"
    );
}

#[test]
fn a_stage_comes_back_as_a_preset_with_its_pictures() {
    let folder = folder();
    let (stage, preset) = (folder.path().join("leaves.usda"), folder.path().join("back/leaves.toml"));
    fs::create_dir(folder.path().join("back")).expect("a folder");
    check_done(&run(&["export", "presets/lights/leaf-gobo.toml", "-o", shown(&stage)]));
    check_done(&run(&["import", shown(&stage), "-o", shown(&preset)]));
    let (back, source) = (softbox::scene::load(&preset), softbox::scene::load("presets/lights/leaf-gobo.toml"));
    let (back, source) = (back.expect("it loads"), source.expect("it loads"));
    assert_eq!(back.lights.len(), source.lights.len(), "its lights");
    let flux = |scene: &softbox::scene::Scene| scene.lights[0].in_quantity(softbox::light::QuantityKind::Flux);
    let (found, expected) = (flux(&back).expect("a flux"), flux(&source).expect("a flux"));
    assert!((found / expected - 1.0).abs() < 1e-6, "{found} lm, not {expected}");
    check_refused(&["import", WINDOW, "-o", shown(&preset)], "is no .usda text");
    check_refused(&["import", "tests/data/usda/studio.usda", "-o", "a.json"], ".toml");
}

#[test]
fn a_sheet_shows_every_file_of_a_folder() {
    let folder = folder();
    let scenes = folder.path().join("scenes");
    fs::create_dir_all(scenes.join("more")).expect("folders");
    for name in ["a.toml", "b.toml", "more/c.toml"] {
        fs::copy(WINDOW, scenes.join(name)).expect("it is copied");
    }
    let output = folder.path().join("sheet.png");
    check_done(&run(&["sheet", shown(&scenes), WINDOW, "-o", shown(&output), "--size", "40x24", "--columns", "3"]));
    let sheet = image::open(&output).expect("a picture").into_rgb8();
    assert_eq!([sheet.width(), sheet.height()], [12 + 3 * 52, 12 + 2 * 58], "two rows");
    let picture =
        |column: u32, row: u32| image::imageops::crop_imm(&sheet, 12 + 52 * column, 12 + 58 * row, 40, 24).to_image();
    assert!(picture(0, 0).pixels().any(|pixel| pixel.0[0] > 100), "a picture of something");
    assert_eq!(picture(0, 0), picture(0, 1), "the fourth is the same scene");
    check_refused(&["sheet", shown(folder.path()), "-o", "sheet.svg"], ".png");
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    check_refused(&["sheet", shown(&folder.path().join("empty")), "-o", shown(&output)], "has no scene files");
}

#[test]
fn pictures_and_plots_name_their_maker_and_are_the_same_twice() {
    const PLOTTED: &str = "presets/scenes/first-light.toml";
    let folder = folder();
    let maker = concat!("Softbox ", env!("CARGO_PKG_VERSION"));
    let check_named = |name: &str, bytes: &[u8]| {
        let held = String::from_utf8_lossy(bytes);
        assert!(
            held.contains(maker) && held.contains("first-light.toml"),
            "{name} does not say who made it, and of what"
        );
    };
    let written = |name: &str, more: &[&str]| {
        let output = folder.path().join(name);
        check_done(&run(&[&["export", PLOTTED, "-o", shown(&output)], more].concat()));
        fs::read(&output).expect("it is written")
    };
    let small = ["--size", "40x24"];
    for (name, more) in [("a.png", &small[..]), ("a.exr", &small), ("a.svg", &[]), ("a.csv", &[])] {
        let first = written(name, more);
        assert!(first == written(name, more), "{name} differs from run to run");
        check_named(name, &first);
    }
    for (command, name, more) in [
        ("render", "b.png", &small[..]),
        ("render", "b.exr", &small),
        ("difference", "c.png", &small),
        ("difference", "c.exr", &small),
        ("plot", "d.svg", &[]),
        ("plot", "d.png", &[]),
        ("sheet", "e.png", &small),
    ] {
        let output = folder.path().join(name);
        check_done(&run(&[&[command, PLOTTED, "-o", shown(&output)], more].concat()));
        check_named(name, &fs::read(&output).expect("it is written"));
    }
    check_refused(&["export", "presets/lights/bulb.toml", "-o", "a.svg"], "has no plots");
}
