//! Every shape of light and every model of reflection: added from the menu, edited number by number, taken back.

use std::path::{Path, PathBuf};

use egui::{Key, Modifiers};
use softbox::light::{Point, Shape};
use softbox::scene;

use crate::window::Window;

/// A scene without surfaces, which takes no time to shade, and without plots.
const EMPTY: &str =
    "format = 1\n[[material]]\nname = \"plaster\"\ndiffuse = [0.5, 0.5, 0.5]\nspecular = [0.2, 0.2, 0.2]\n";

/// A light of `kind` is added, each field is given a number, and all of it is taken back again. The file then has
/// `passage` in it.
#[track_caller]
fn check(window: &mut Window, kind: &str, fields: &[(&str, &str)], passage: &str) {
    let before = window.scene();
    window.menu(&["Add", "Light", kind]);
    let added = window.scene().lights.last().cloned().expect("a light");
    assert_eq!(added.shape.name(), kind.to_lowercase(), "{kind}");
    for (field, number) in fields {
        window.enter(field, number);
    }
    let text = scene::to_toml(&window.scene());
    assert!(text.contains(passage), "`{passage}` in\n{text}");
    let steps = window.steps_back();
    assert_eq!(steps.len(), 1 + fields.len(), "one step a field: {steps:?}");
    assert_eq!(window.scene(), before, "{kind} is gone");
}

#[test]
fn every_number_of_a_new_light_is_edited_and_taken_back() {
    let mut window = Window::with(EMPTY);
    let window = &mut window;
    check(window, "Disk", &[("Radius", "0.75"), ("Flux", "900")], "flux = 900.0\nshape = { disk = { radius = 0.75 } }");
    check(window, "Line", &[("Length", "2.5"), ("Falloff n", "1.5")], "length = 2.5");
    check(window, "Sphere", &[("Radius", "0.25")], "sphere = { radius = 0.25 }");
    check(
        window,
        "Cap",
        &[("Half-angle", "25"), ("Illuminance", "800")],
        "illuminance = 800.0\nshape = { cap = { half_angle_deg = 25.0 } }",
    );
    check(
        window,
        "Sky",
        &[("Uniform", "0.5"), ("Cosine", "0.25"), ("Luminance", "300")],
        "luminance = 300.0\nshape = { sky = { uniform = 0.5, cosine = 0.25 } }",
    );
    check(window, "Point", &[("Intensity", "250")], "intensity = 250.0\nshape = { point = {} }");
    check(window, "Directional", &[("Rotation X", "30")], "rotation_deg = [30.0, 0.0, 0.0]");
}

#[test]
fn a_sky_is_made_one_that_people_know() {
    let mut window = Window::with(EMPTY);
    window.menu(&["Add", "Light", "Sky"]);
    for (kind, shares) in [("uniform", "uniform = 1.0, cosine = 0.0"), ("cosine", "uniform = 0.0, cosine = 1.0")] {
        window.menu(&["Kind", kind]);
        assert!(scene::to_toml(&window.scene()).contains(shares), "{kind}");
    }
    window.enter("Uniform", "0.5");
    assert!(scene::to_toml(&window.scene()).contains("uniform = 0.5, cosine = 1.0"), "and then one of no name");
}

#[test]
fn a_black_sky_is_refused() {
    let mut window = Window::with(EMPTY);
    window.menu(&["Add", "Light", "Sky"]);
    window.menu(&["Kind", "uniform"]);
    let before = window.scene();
    window.enter("Uniform", "0");
    assert_eq!(window.scene(), before, "refused");
}

#[test]
fn a_material_is_given_every_model_and_its_numbers() {
    let mut window = Window::with(EMPTY);
    window.click("plaster");
    let before = window.scene();
    for (model, fields, passage) in [
        ("blinn", &[("Exponent m", "200")][..], "model = { blinn = {} }\nexponent = 200.0"),
        (
            "cook-torrance",
            &[("Roughness", "0.25"), ("Reflectance", "0.5")],
            "model = { cook-torrance = { roughness = 0.25, reflectance = 0.5 } }",
        ),
        (
            "lafortune",
            &[("Tangential", "-0.8"), ("Normal", "0.9"), ("Exponent m", "40")],
            "model = { lafortune = { tangential = -0.8, normal = 0.9 } }\nexponent = 40.0",
        ),
    ] {
        window.menu(&["Reflection", model]);
        for (field, number) in fields {
            window.enter(field, number);
        }
        let text = scene::to_toml(&window.scene());
        assert!(text.contains(passage), "`{passage}` in\n{text}");
        let steps = window.steps_back();
        assert_eq!(steps.len(), 1 + fields.len(), "one step a field: {steps:?}");
        assert_eq!(window.scene(), before, "{model} is gone");
    }
}

/// A pattern's file that comes with the program.
fn texture(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/lights/textures").join(name)
}

#[test]
fn a_textured_light_is_made_of_a_picture_that_goes_along_when_the_scene_is_saved() {
    let mut window = Window::with(EMPTY);
    window.choose(Some(&texture("stained-glass.png")));
    window.menu(&["Add", "Light", "Textured…"]);
    let passage = "shape = { textured = { size = [0.6, 1.0], pattern = \"textures/stained-glass.png\" } }";
    assert!(scene::to_toml(&window.scene()).contains(passage), "the picture's own proportions");
    assert!(window.has("Pattern") && window.says("96 × 160, colour"), "the inspector shows it");
    window.enter("Width", "0.9");
    window.choose(Some(&texture("leaves.png")));
    window.click("Replace pattern");
    let Shape::Textured(textured) = &window.scene().lights[0].shape else { panic!("a textured light") };
    assert_eq!((textured.pattern.file.as_str(), textured.size.x), ("textures/leaves.png", 0.9), "another picture");
    window.key(Modifiers::COMMAND, Key::S);
    let saved = scene::load(window.path("scene.toml")).expect("the scene and its pattern are there");
    assert_eq!(saved, *window.scene(), "what was saved");
    assert_eq!(window.steps_back(), ["Replace pattern", "Change width", "Add stained-glass"], "three steps");
}

#[test]
fn surfaces_of_many_parts_are_added_edited_and_taken_back() {
    let mut window = Window::with(EMPTY);
    let before = window.scene();
    for (kind, field, number, passage) in [
        ("Sphereflake", "Depth", "1", "position = [0.0, 0.0, 0.5]\nshape = { sphereflake = { depth = 1 } }"),
        ("Tetrahedron", "Depth", "0", "shape = { tetrahedron = { depth = 0 } }"),
        ("Patch", "Point 2 3 Z", "0.75", "[0.2, -0.2, 0.75]"),
    ] {
        window.menu(&["Add", "Surface", kind]);
        window.enter(field, number);
        let text = scene::to_toml(&window.scene());
        assert!(text.contains(passage), "`{passage}` in\n{text}");
        let steps = window.steps_back();
        assert_eq!(steps.len(), 2, "one step a field: {steps:?}");
        assert_eq!(window.scene(), before, "{kind} is gone");
    }
}

#[test]
fn a_mesh_is_added_from_a_file_and_replaced_and_goes_along_when_the_scene_is_saved() {
    const TRIANGLE: &str = "v 0 0 -1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let mut window = Window::with(EMPTY);
    let elsewhere = tempfile::tempdir().expect("a temporary folder");
    let [stool, chair] = ["stool.obj", "chair.obj"].map(|name| elsewhere.path().join(name));
    std::fs::write(&stool, TRIANGLE).expect("the folder is writable");
    std::fs::write(&chair, format!("{TRIANGLE}f 1 3 2\n")).expect("the folder is writable");
    window.choose(Some(&stool));
    window.menu(&["Add", "Surface", "Mesh…"]);
    let text = scene::to_toml(&window.scene());
    let passage = "position = [0.0, 0.0, 1.0]\nshape = { mesh = { file = \"meshes/stool.obj\" } }";
    assert!(text.contains("name = \"stool\"") && text.contains(passage), "on the ground:\n{text}");
    assert!(window.says("1 triangles, flat"), "the inspector shows it");
    window.choose(Some(&chair));
    window.click("Replace mesh");
    assert!(window.says("2 triangles, flat"), "another mesh");
    window.key(Modifiers::COMMAND, Key::S);
    let saved = scene::load(window.path("scene.toml")).expect("the scene and its mesh are there");
    assert_eq!(saved, *window.scene(), "what was saved");
    assert_eq!(window.steps_back(), ["Replace mesh", "Add mesh"], "two steps");
}

#[test]
fn what_is_no_picture_is_refused_in_one_line() {
    let mut window = Window::with(EMPTY);
    let path = window.path("scene.toml");
    window.choose(Some(&path));
    window.menu(&["Add", "Light", "Textured…"]);
    assert!(window.says("is no PNG, JPEG, EXR or HDR picture"), "the reason");
    assert!(window.scene().lights.is_empty(), "no light");
}

/// 500 cd straight down, twice as much towards +X as towards −X.
const SPOT: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 7 3 1 2 0 0 0\n1 1 0\n0 15 30 45 60 75 90\n0 90 180\n\
                    500 480 460 400 200 60 0\n500 470 380 240 100 20 0\n500 450 300 180 60 10 0\n";

#[test]
fn a_point_light_takes_the_candela_of_an_ies_file() {
    let mut window = Window::with(EMPTY);
    let elsewhere = tempfile::tempdir().expect("a temporary folder");
    let path = elsewhere.path().join("spot.ies");
    std::fs::write(&path, SPOT).expect("the folder is writable");
    window.choose(Some(&path));
    window.menu(&["Add", "Light", "Point from IES…"]);
    let measured = |window: &Window| {
        let scene = window.scene();
        let Shape::Point(point) = &scene.lights[0].shape else { panic!("a point light") };
        let photometry = point.ies.clone().expect("a photometric file");
        (photometry.file.clone(), photometry.distribution.peak(), scene.lights[0].strength())
    };
    assert_eq!(measured(&window), ("photometry/spot.ies".to_owned(), 500.0, 500.0), "as bright as the file says");
    assert!(window.has("Polar diagram of the intensities"), "the inspector shows it");
    assert!(window.says("photometry/spot.ies"), "and its file");
    window.enter("Rotation Y", "30");
    assert_eq!(window.scene().lights[0].rotation_deg.y, 30.0, "it can be turned");
    window.snapshot("point_from_ies");

    std::fs::write(&path, SPOT.replace("500 480", "800 480")).expect("the folder is writable");
    window.choose(Some(&path));
    window.click("Replace IES file");
    assert_eq!(measured(&window).1, 800.0, "another file");
    std::fs::write(&path, "no candela").expect("the folder is writable");
    window.choose(Some(&path));
    window.click("Replace IES file");
    assert!(window.says("`spot.ies` has no line TILT="), "a bad file is told");
    window.click("Remove IES file");
    let lamp = &window.scene().lights[0];
    assert!(matches!(lamp.shape, Shape::Point(Point { ies: None })), "the same all around");
    assert!(lamp.strength() == 800.0 && !window.has("Remove IES file"), "as bright as before");
    let steps = ["Remove IES file", "Replace IES file", "Change rotation", "Add spot"];
    assert_eq!(window.steps_back(), steps, "one step each");
}
