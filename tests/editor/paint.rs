//! The pattern painter: strokes, fills and shapes with the mouse, seen in the light at once, undone, saved, opened again.

use std::path::Path;

use egui::{Key, Modifiers, Pos2, vec2};
use softbox::light::Shape;
use softbox::light::pattern::Pattern;
use softbox::scene::{self, Scene};

use crate::window::{Window, primary_button};

/// A floor, and nothing that shines yet.
const FLOOR: &str = r#"format = 1
[camera]
eye = [0.0, -4.0, 3.0]
target = [0.0, 0.0, 0.8]
[[material]]
name = "plaster"
diffuse = [0.5, 0.5, 0.5]
specular = [0.0, 0.0, 0.0]
exponent = 8.0
[[surface]]
name = "floor"
material = "plaster"
shape = { square = { size = [4.0, 4.0] } }
"#;

/// A window with a light that was made to be painted, before its canvas.
fn painter() -> Window {
    let mut window = Window::with(FLOOR);
    window.click("Painter");
    window.click("New light to paint");
    window
}

fn pattern(scene: &Scene) -> &Pattern {
    let Shape::Textured(textured) = &scene.lights[0].shape else { panic!("a textured light") };
    &textured.pattern
}

/// The mean of the light's pattern, red, green and blue.
fn mean(window: &Window) -> [f64; 3] {
    let scene = window.scene();
    let channels = pattern(&scene).image.channels();
    std::array::from_fn(|c| channels[c.min(channels.len() - 1)].mean())
}

/// The point of the window where a place of the canvas is, by shares of its width and height.
fn at(window: &Window, u: f32, v: f32) -> Pos2 {
    let pane = window.get("Pattern canvas").rect();
    let side = 0.92 * pane.width().min(pane.height());
    pane.center() + side * (vec2(u, v) - vec2(0.5, 0.5))
}

fn drag(window: &mut Window, places: &[(f32, f32)]) {
    let points: Vec<Pos2> = places.iter().map(|(u, v)| at(window, *u, *v)).collect();
    window.drag(&points);
}

#[test]
fn a_stroke_is_seen_in_the_light_while_it_is_painted_then_undone_saved_and_opened_again() {
    let mut window = painter();
    let start = pattern(&window.scene()).clone();
    assert_eq!(start.image.channels()[0].size(), [256, 256], "the new light's pattern");

    // Darken by a stroke of value 0; the light shows it before the button is released.
    window.enter("Paint value", "0");
    window.enter("Paint size", "60");
    let (press, to) = (at(&window, 0.25, 0.5), at(&window, 0.75, 0.5));
    window.harness.hover_at(press);
    window.harness.step();
    window.harness.event(primary_button(press, true));
    window.harness.step();
    window.harness.hover_at(to);
    window.harness.step();
    let shown = window.harness.state_mut().session.shown();
    let live = pattern(&shown).image.channels()[0].mean();
    assert!(live < 0.95 * mean(&window)[0], "the light dims with the brush: {live}");
    assert_eq!(pattern(&window.scene()), &start, "the document waits for the release");
    window.harness.event(primary_button(to, false));
    window.settle();
    let painted = mean(&window)[0];
    assert!((painted - live).abs() < 1e-4, "{painted} after {live}");
    assert_eq!(window.session().history.undo_label(), Some("Brush stroke"), "one step");

    window.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(pattern(&window.scene()), &start, "undone byte for byte");
    window.key(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert!((mean(&window)[0] - painted).abs() < 1e-15, "and done again");

    // A stroke that is cancelled leaves nothing.
    window.harness.hover_at(press);
    window.harness.event(primary_button(press, true));
    window.harness.step();
    window.harness.key_press(Key::Escape);
    window.harness.step();
    window.harness.event(primary_button(press, false));
    window.settle();
    assert!((mean(&window)[0] - painted).abs() < 1e-15, "cancelled");

    window.key(Modifiers::COMMAND, Key::S);
    let path = window.path("scene.toml");
    let saved = scene::load(&path).expect("the scene and its pattern are there");
    assert_eq!(saved, *window.scene(), "every texel");
    assert_eq!(pattern(&saved).file, "scene.patterns/pattern.png", "in the scene's own folder");
    assert!(!window.session().history.is_modified(), "nothing is left to save");
    window.snapshot("painter_stroke");
}

/// A slow machine sees the end of a stroke and a press on a menu in one frame: the stroke is kept all the same.
#[test]
fn a_stroke_is_kept_where_a_menu_is_opened_in_the_same_frame() {
    let mut window = painter();
    window.enter("Paint value", "0");
    let (from, to) = (at(&window, 0.25, 0.5), at(&window, 0.75, 0.5));
    let menu = window.get("Presets pattern").rect().center();
    window.harness.hover_at(from);
    window.harness.step();
    window.harness.event(primary_button(from, true));
    window.harness.step();
    window.harness.hover_at(to);
    window.harness.step();
    let at_once = [
        primary_button(to, false),
        egui::Event::PointerMoved(menu),
        primary_button(menu, true),
        primary_button(menu, false),
    ];
    window.harness.input_mut().events.extend(at_once);
    window.harness.step();
    window.settle();
    assert!(window.has("Use preset"), "the menu is open");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().history.undo_label(), Some("Brush stroke"), "kept");
}

#[test]
fn every_tool_leaves_what_it_says() {
    let mut window = painter();
    let tool = |window: &mut Window, name: &str| window.click(name);

    // An even start.
    window.menu(&["New pattern"]);
    window.enter("New pattern value", "0.25");
    window.click("64");
    window.click("New 64 × 64");
    assert_eq!(pattern(&window.scene()).image.channels()[0].size(), [64, 64], "resolution");
    assert!((mean(&window)[0] - 0.25).abs() < 1e-5, "even: {:?}", mean(&window));

    tool(&mut window, "Paint rectangle");
    drag(&mut window, &[(0.25, 0.25), (0.5, 0.6), (0.75, 0.75)]);
    let expected = 0.25 + 0.75 * 0.25;
    assert!((mean(&window)[0] - expected).abs() < 5e-3, "a quarter at 1: {:?}", mean(&window));

    tool(&mut window, "Paint fill");
    window.enter("Paint value", "0.5");
    drag(&mut window, &[(0.5, 0.5)]);
    let expected = 0.25 + 0.25 * 0.25;
    assert!((mean(&window)[0] - expected).abs() < 8e-3, "the rectangle filled at ½: {:?}", mean(&window));

    tool(&mut window, "Paint ellipse");
    window.enter("Paint value", "1");
    let before = mean(&window)[0];
    drag(&mut window, &[(0.3, 0.3), (0.7, 0.7)]);
    let area = std::f64::consts::PI * 0.04;
    assert!((mean(&window)[0] - before - 0.5 * area).abs() < 6e-3, "an ellipse: {:?}", mean(&window));

    tool(&mut window, "Paint line");
    window.enter("Paint size", "4");
    let before = mean(&window)[0];
    drag(&mut window, &[(0.05, 0.1), (0.95, 0.1)]);
    assert!(mean(&window)[0] > before + 0.03, "a line: {:?}", mean(&window));

    tool(&mut window, "Paint eraser");
    let before = mean(&window)[0];
    drag(&mut window, &[(0.05, 0.1), (0.95, 0.1)]);
    assert!(mean(&window)[0] < before - 0.04, "erased: {:?}", mean(&window));

    tool(&mut window, "Paint gradient");
    drag(&mut window, &[(0.0, 0.5), (0.4, 0.5), (1.0, 0.5)]);
    assert!((mean(&window)[0] - 0.5).abs() < 5e-3, "from 1 to 0: {:?}", mean(&window));

    // What was erased comes back with one colour more by the keys, while the pointer is over the canvas.
    tool(&mut window, "Pick from pattern");
    drag(&mut window, &[(0.5, 0.5)]);
    window.harness.hover_at(at(&window, 0.5, 0.9));
    window.key(Modifiers::NONE, Key::B);
    window.key(Modifiers::NONE, Key::CloseBracket);
    assert_eq!(window.session().tool, softbox::editor::Tool::Move, "the view's tool stays");
    drag(&mut window, &[(0.9, 0.2), (0.9, 0.8)]);
    let [r, g, b] = mean(&window);
    assert!(r > 0.5 && r == g && g == b, "picked ½ over black: {r}");

    let steps = window.steps_back();
    let expected = [
        "Brush stroke",
        "Paint gradient",
        "Erase",
        "Paint line",
        "Paint ellipse",
        "Fill",
        "Paint rectangle",
        "New pattern",
        "Add pattern",
    ];
    assert_eq!(steps, expected, "one step each");
}

#[test]
fn the_whole_pattern_is_adjusted_generated_and_painted_symmetrically() {
    let mut window = painter();
    let before = mean(&window)[0];
    window.menu(&["Adjust pattern", "Invert"]);
    assert!((mean(&window)[0] - (1.0 - before)).abs() < 1e-4, "inverted: {:?}", mean(&window));
    window.click("Blur");
    assert!((mean(&window)[0] - (1.0 - before)).abs() < 1e-4, "blurred: {:?}", mean(&window));
    window.click("Brightness");
    assert!((mean(&window)[0] - 0.5 * (1.0 - before)).abs() < 1e-4, "halved: {:?}", mean(&window));
    window.click("Mirror left–right");
    window.click("Rotate 90°");
    window.key(Modifiers::NONE, Key::Escape);
    // Its own mirror image was no change, and so no step; nor was a quarter turn.
    assert_eq!(window.session().history.undo_label(), Some("Change pattern brightness"), "the last step");

    // A preset is proposed, given up, and used.
    let adjusted = pattern(&window.scene()).clone();
    window.menu(&["Presets pattern", "Ring"]);
    let shown = window.harness.state_mut().session.shown();
    assert_ne!(pattern(&shown).image, adjusted.image, "the light shows it");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(*pattern(&window.scene()), adjusted, "given up");
    window.menu(&["Presets pattern", "Checker"]);
    window.enter("Preset columns", "2");
    window.enter("Preset rows", "2");
    window.click("Use preset");
    assert!((mean(&window)[0] - 0.5).abs() < 1e-3, "checks: {:?}", mean(&window));
    assert_eq!(window.session().history.undo_label(), Some("Checker pattern"), "one step");

    // A stroke in a corner, four times.
    window.menu(&["Paint symmetry", "both"]);
    window.click("Paint brush");
    drag(&mut window, &[(0.1, 0.1), (0.2, 0.15), (0.3, 0.4)]);
    let scene = window.scene();
    let channel = &pattern(&scene).image.channels()[0];
    let value = |u: f64, v: f64| channel.value(u, v);
    for (u, v) in [(0.2, 0.15), (0.3, 0.4), (0.55, 0.1)] {
        let four = [value(u, v), value(1.0 - u, v), value(u, 1.0 - v), value(1.0 - u, 1.0 - v)];
        let painted = (u, v) != (0.55, 0.1);
        assert_eq!(four.iter().all(|value| *value > 0.99), painted, "at {u}, {v}: {four:?}");
    }
    window.snapshot("painter_symmetry");
}

#[test]
fn a_black_canvas_waits_for_something_that_shines() {
    let mut window = painter();
    let start = pattern(&window.scene()).clone();
    window.menu(&["New pattern"]);
    window.click("128");
    window.click("New 128 × 128");
    assert_eq!(*pattern(&window.scene()), start, "no light is black all over");
    drag(&mut window, &[(0.5, 0.5), (0.6, 0.5)]);
    let scene = window.scene();
    let image = &pattern(&scene).image;
    assert_eq!(image.channels()[0].size(), [128, 128], "the new canvas");
    assert!(image.channels()[0].mean() < 0.2, "a stroke on black: {}", image.channels()[0].mean());
    assert_eq!(window.steps_back(), ["Brush stroke", "Add pattern"], "one step");
}

#[test]
fn the_painter_opens_from_the_inspector_and_says_what_to_select() {
    let mut window = painter();
    window.click("Library");
    window.click("Edit pattern");
    assert!(window.has("Pattern canvas"), "by the inspector's button");
    window.menu(&["Edit", "Select none"]);
    assert!(window.says("Select a textured light"), "nothing is selected");
}

#[test]
fn colours_are_picked_from_a_loaded_picture_and_painted_around_its_middle() {
    let mut window = painter();
    window.enter("Width", "0.6");
    let picture = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/lights/textures/stained-glass.png");
    window.choose(Some(&picture));
    window.click("Load pattern picture");
    let loaded = pattern(&window.scene()).clone();
    assert_eq!(loaded.image.channels()[0].size(), [96, 160], "the picture's texels");

    window.click("Pick from pattern");
    window.drag(&[window.get("Pattern canvas").rect().center()]);
    let middle: Vec<f64> = loaded.image.channels().iter().map(|channel| channel.value(0.5, 0.5)).collect();
    window.menu(&["Paint symmetry", "radial"]);
    window.click("Paint brush");
    window.enter("Paint size", "8");
    let center = window.get("Pattern canvas").rect().center();
    window.drag(&[vec2(12.0, -10.0), vec2(30.0, -40.0), vec2(40.0, -60.0)].map(|by| center + by));
    let painted = pattern(&window.scene()).clone();
    let texels = |c: usize| painted.image.channels()[c].texels().iter().zip(loaded.image.channels()[c].texels());
    let changed = texels(0).filter(|(a, b)| a != b).count();
    assert!(changed > 6 * 50, "six strokes: {changed} texels");
    let all = |c: usize| texels(c).filter(|(a, _)| (f64::from(**a) - middle[c]).abs() < 1e-3).count();
    assert!((0..3).all(|c| all(c) > 6 * 50), "of the colour in the middle, {middle:?}");
    assert_eq!(window.steps_back()[..2], ["Brush stroke", "Replace pattern"], "two steps");
}
