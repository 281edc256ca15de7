//! Painted patterns: saved beside the scene in a folder of its own, loaded again, kept small in the history.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use glam::{DVec2, dvec2};
use softbox::light::pattern::code::nearest;
use softbox::light::pattern::paint::{Brush, Canvas, Stroke, Symmetry};
use softbox::light::pattern::{Image, Pattern};
use softbox::light::{Light, Shape, Textured};
use softbox::scene::{self, History, Scene};

/// A scene of lights with those patterns.
fn scene_of(patterns: impl IntoIterator<Item = Pattern>) -> Scene {
    let light = |(i, pattern)| {
        let shape = Shape::Textured(Textured { size: DVec2::ONE, pattern, two_sided: false });
        Light::new(format!("light {i}"), shape)
    };
    Scene { lights: patterns.into_iter().enumerate().map(light).collect(), ..Scene::default() }
}

fn pattern(scene: &Scene) -> &Pattern {
    let Shape::Textured(textured) = &scene.lights[0].shape else { panic!("a textured light") };
    &textured.pattern
}

/// Another image for the scene's light, painted in the scene whose file is that.
fn repaint(scene: &mut Scene, image: Image, path: Option<&Path>) {
    let painted = scene::painted_pattern(image, pattern(scene), path);
    let Shape::Textured(textured) = &mut scene.lights[0].shape else { panic!("a textured light") };
    textured.pattern = painted;
}

fn image(value: impl Fn(usize, usize) -> [f32; 3]) -> Image {
    Canvas::of_texels([40, 30], value).image().expect("it shines")
}

fn files_in(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let names = entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned());
    names.collect::<BTreeSet<_>>().into_iter().collect()
}

/// Saving and loading gives the same texels from a file of that extension.
#[track_caller]
fn check(image: Image, file: &str) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("lamp.toml");
    let mut before = scene_of([Pattern::unread("textures/leaf.png")]);
    repaint(&mut before, image, Some(&path));
    scene::save(&before, &path).expect("it is saved");
    let after = scene::load(&path).expect("it is loaded");
    assert_eq!(pattern(&after).file, file, "its name");
    assert_eq!(pattern(&after).image, pattern(&before).image, "every texel of {file}");
}

#[test]
fn painted_patterns_load_as_they_were_saved() {
    let code = |i: usize, most: f64| {
        let code = (i as f64 * 0.618).fract() * most;
        softbox::light::pattern::code::linear_from_srgb(code.round() / most)
    };
    let single = softbox::light::pattern::code::single;
    check(image(|x, y| [single(code(x + 40 * y, 255.0)); 3]), "lamp.patterns/leaf.png");
    check(image(|x, y| [single(code(x + 40 * y, 65535.0)); 3]), "lamp.patterns/leaf.png");
    check(image(|x, y| [x, y, x * y].map(|i| single(code(i, 255.0)))), "lamp.patterns/leaf.png");
    check(image(|x, y| [x, y, x * y].map(|i| single(code(i, 65535.0)))), "lamp.patterns/leaf.png");
    check(image(|x, y| [(x + 40 * y) as f32 / 77.0; 3]), "lamp.patterns/leaf.exr");
    check(image(|x, y| [x as f32 / 77.0, y as f32 * 0.1, 3.5]), "lamp.patterns/leaf.exr");
}

#[test]
fn a_painted_pattern_replaces_its_own_file_and_no_other() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [lamp, copy] = ["lamp.toml", "copy.toml"].map(|name| folder.path().join(name));
    let own = folder.path().join("lamp.patterns");
    let mut scene = scene_of([Pattern::unread("textures/leaf.png")]);
    repaint(&mut scene, image(|_, _| [nearest(0.5); 3]), Some(&lamp));
    scene::save(&scene, &lamp).expect("it is saved");
    let saved = scene::load(&lamp).expect("it is loaded");

    let mut scene = saved.clone();
    repaint(&mut scene, image(|x, _| [nearest(x as f32 / 39.0); 3]), Some(&lamp));
    repaint(&mut scene, image(|_, _| [1.0; 3]), Some(&lamp));
    scene::save_over(&scene, &lamp, &lamp, Some(&saved)).expect("it is saved again");
    assert_eq!(files_in(&own), ["leaf.png"], "in the same file");
    let saved = scene::load(&lamp).expect("it is loaded");
    assert_eq!(pattern(&saved).image, pattern(&scene).image, "the new picture");

    // Another program writes to it.
    fs::write(own.join("leaf.png"), "precious").expect("the folder is writable");
    repaint(&mut scene, image(|_, y| [nearest(y as f32 / 29.0), 1.0, 1.0]), Some(&lamp));
    scene::save_over(&scene, &lamp, &lamp, Some(&saved)).expect("it is saved under another name");
    assert_eq!(fs::read(own.join("leaf.png")).expect("it is there"), b"precious", "left alone");
    assert_eq!(files_in(&own).len(), 2, "{:?}", files_in(&own));

    // The same scene under another name has a folder of its own.
    scene::save_over(&scene, &copy, &lamp, None).expect("it is saved elsewhere");
    let copied = scene::load(&copy).expect("it is loaded");
    assert!(pattern(&copied).file.starts_with("copy.patterns/"), "{}", pattern(&copied).file);
    assert_eq!(pattern(&copied).image, pattern(&scene).image, "the same picture");
}

#[test]
fn a_pattern_that_comes_back_from_elsewhere_does_not_replace_a_file_of_its_name() {
    let [home, elsewhere] = [0, 1].map(|_| tempfile::tempdir().expect("a temporary folder"));
    let [lamp, copy] = [&home, &elsewhere].map(|folder| folder.path().join("lamp.toml"));
    let mut scene = scene_of([Pattern::unread("textures/leaf.png")]);
    repaint(&mut scene, image(|_, _| [1.0; 3]), Some(&lamp));
    scene::save(&scene, &lamp).expect("it is saved");
    repaint(&mut scene, image(|x, _| [nearest(x as f32 / 39.0); 3]), Some(&lamp));
    scene::save(&scene, &copy).expect("it is saved elsewhere");
    let recovered = scene::load(&copy).expect("it is loaded from there");
    assert_eq!(pattern(&recovered).file, "lamp.patterns/leaf.png", "of the same name");
    scene::save_over(&recovered, &lamp, &lamp, Some(&recovered)).expect("it is saved in the place of the first");
    assert_eq!(files_in(&home.path().join("lamp.patterns")), ["leaf-2.png", "leaf.png"], "both pictures");
    let saved = scene::load(&lamp).expect("it is loaded");
    assert_eq!(pattern(&saved).image, pattern(&recovered).image, "the recovered one is the scene's");
}

#[test]
fn different_pictures_painted_under_one_name_get_files_of_their_own() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("lamp.toml");
    let [a, b] = [0.25, 0.75].map(|value| image(move |_, _| [value; 3]));
    let scene = scene_of([&a, &b, &a].map(|image| Pattern::of_image("untitled.patterns/leaf.png", image.clone())));
    scene::save(&scene, &path).expect("it is saved");
    assert_eq!(files_in(&folder.path().join("lamp.patterns")), ["leaf-2.exr", "leaf.exr"], "each once");
    let loaded = scene::load(&path).expect("it is loaded");
    let means = loaded.lights.iter().map(|light| {
        let Shape::Textured(textured) = &light.shape else { panic!("a textured light") };
        textured.pattern.image.channels()[0].mean()
    });
    assert_eq!(means.collect::<Vec<_>>(), [0.25, 0.75, 0.25], "each its own");
}

/// A stroke across a canvas, as the editor keeps it.
fn stroked(image: &Image, number: u32) -> Image {
    let before = Canvas::of_image(image);
    let size = before.size();
    let mut stroke = Stroke::new(Brush::new(40.0, 0.5), Symmetry::Off, size);
    let start = dvec2(f64::from(number * 397 % 900), f64::from(number * 641 % 900));
    for step in 0..8 {
        stroke.to(start + 40.0 * f64::from(step) * DVec2::from_angle(f64::from(number)));
    }
    let color = [0.2, 0.5, 0.9].map(|share: f32| (share * number as f32).fract());
    let mut after = before.painted(stroke.mask(), 0.8, |_, _| color);
    after.settle(&before);
    after.image().expect("it shines")
}

/// A thousand strokes within 200 MB; the last of a few tells what each takes.
#[test]
fn strokes_on_a_large_coloured_pattern_cost_little_and_are_undone_to_the_last_bit() {
    const STROKES: u32 = 12;
    let mut start = Canvas::of_texels([1024, 1024], |x, y| [x as f32 / 1023.0, y as f32 / 1023.0, 0.5]);
    start.settle(&Canvas::filled([1, 1], [0.0; 3]));
    let first = start.image().expect("it shines");
    let mut history = History::new(scene_of([Pattern::of_image("leaf.png", first.clone())]));
    let mut versions = vec![first];
    for number in 1..=STROKES {
        let image = stroked(&pattern(history.scene()).image, number);
        versions.push(image.clone());
        history.edit("Brush stroke", |scene| repaint(scene, image, None));
    }
    let (steps, bytes) = history.depth();
    let per_stroke = bytes / steps;
    assert!(per_stroke < 120_000, "a stroke takes {per_stroke} bytes: a thousand of them more than 120 MB");
    for version in versions.iter().rev() {
        let texels = |image: &Image| -> Vec<u32> {
            image.channels().iter().flat_map(|channel| channel.texels()).map(|texel| texel.to_bits()).collect()
        };
        assert!(texels(&pattern(history.scene()).image) == texels(version), "a version is not what it was");
        history.undo();
    }
}
