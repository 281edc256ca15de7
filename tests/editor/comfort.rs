//! Finding one's way: palette, keys, menus under the pointer, interface size, what is dropped on the window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Key, Modifiers, PointerButton, Pos2, pos2};
use softbox::editor::Item;
use softbox::light::Shape;

use crate::window::Window;

/// Type into the field that has the focus.
fn type_text(window: &mut Window, text: &str) {
    window.harness.event(egui::Event::Text(text.to_owned()));
    window.settle();
}

/// Press and release the secondary button.
fn right_click(window: &mut Window, pos: Pos2) {
    window.harness.hover_at(pos);
    window.harness.step();
    for pressed in [true, false] {
        let (button, modifiers) = (PointerButton::Secondary, Modifiers::NONE);
        window.harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        window.harness.step();
    }
    window.settle();
}

/// A file dropped on the window.
#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_file(window: &mut Window, name: &str, bytes: &[u8]) {
    let path = window.path(name);
    std::fs::write(&path, bytes).expect("the file is written");
    window.harness.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    window.harness.step();
    window.settle();
}

#[test]
fn the_palette_finds_commands_presets_and_things() {
    let mut window = Window::with_scene();
    window.key(Modifiers::COMMAND, Key::P);
    window.snapshot("palette");
    type_text(&mut window, "ball");
    window.key(Modifiers::NONE, Key::Enter);
    assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some("ball"), "a thing of the scene");
    let lights = window.scene().lights.len();
    window.key(Modifiers::COMMAND, Key::P);
    type_text(&mut window, "insert octa");
    window.key(Modifiers::NONE, Key::Enter);
    assert_eq!(window.scene().lights.len(), lights + 1, "a preset");
    assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some("octabox"), "that one");
    assert!(window.says("Inserted Octabox"), "the user is told");
    window.key(Modifiers::COMMAND, Key::P);
    type_text(&mut window, "show gr");
    window.key(Modifiers::NONE, Key::Enter);
    assert!(!window.session().view.show_grid, "a command");
    window.key(Modifiers::COMMAND, Key::P);
    type_text(&mut window, "add light");
    window.key(Modifiers::NONE, Key::ArrowDown);
    window.key(Modifiers::NONE, Key::ArrowUp);
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.has("Command"), "Esc closes it");
    assert_eq!(window.scene().lights.len(), lights + 1, "and does nothing");
}

#[test]
fn all_keys_are_listed_and_can_be_searched() {
    let mut window = Window::with_scene();
    window.key(Modifiers::NONE, Key::F1);
    assert!(window.has_any("Save as…") && window.has_any("Orbit"), "commands and gestures");
    window.snapshot("keys");
    type_text(&mut window, "orbit");
    assert!(window.has_any("Orbit") && !window.has_any("Save as…"), "only what was looked for");
    window.click("Close");
    assert!(!window.has_any("Orbit"), "closed");
}

#[test]
fn a_right_click_offers_what_can_be_done_there() {
    let mut window = Window::with_scene();
    let canvas = window.get("Viewport").rect();
    // The ball stands in the middle of the view.
    right_click(&mut window, pos2(canvas.center().x - 10.0, canvas.center().y + 45.0));
    assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some("ball"), "what is under the pointer");
    assert!(window.has("Duplicate"), "what can be done with it");
    window.snapshot("context_menu");
    window.click("Duplicate");
    assert_eq!(window.scene().surfaces.len(), 3, "done");
    right_click(&mut window, canvas.center_top() + egui::vec2(250.0, 60.0));
    assert!(window.selected().is_none(), "nothing is there");
    window.menu(&["Show grid"]);
    assert!(!window.session().view.show_grid, "the view's own entries");
}

#[test]
fn the_interface_grows_and_shrinks() {
    let mut window = Window::with_scene();
    let zoom = |window: &Window| window.harness.ctx.zoom_factor();
    window.menu(&["View", "Larger interface"]);
    assert!((zoom(&window) - 1.1).abs() < 1e-6, "larger: {}", zoom(&window));
    window.key(Modifiers::COMMAND, Key::Minus);
    window.key(Modifiers::COMMAND, Key::Minus);
    assert!((zoom(&window) - 0.9).abs() < 1e-6, "smaller: {}", zoom(&window));
    window.key(Modifiers::COMMAND, Key::Num0);
    assert!((zoom(&window) - 1.0).abs() < 1e-6, "as usual: {}", zoom(&window));
}

#[test]
fn what_is_dropped_on_the_window_is_opened_inserted_or_refused() {
    let mut window = Window::with_scene();
    let before = window.scene();
    let preset = "format = 1\n\n[[light]]\nname = \"spot\"\nposition = [0.0, 0.0, 3.0]\nintensity = 100.0\nshape = { point = {} }\n";
    drop_file(&mut window, "spot.toml", preset.as_bytes());
    assert_eq!(window.scene().lights.len(), before.lights.len() + 1, "a preset is inserted");
    let picture = include_bytes!("../../presets/lights/textures/leaves.png");
    drop_file(&mut window, "leaves.png", picture);
    let scene = window.scene();
    assert!(matches!(scene.lights.last().map(|light| &light.shape), Some(Shape::Textured(_))), "a picture is a light");
    let candela = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 0\n0 90\n0\n700 0\n";
    drop_file(&mut window, "lamp.ies", candela.as_bytes());
    let scene = window.scene();
    let lamp = scene.lights.last().expect("lights");
    assert!(lamp.name == "lamp" && lamp.strength() == 700.0, "an IES file is a point light as bright as it says");
    drop_file(&mut window, "letter.pdf", b"%PDF");
    assert!(window.says("“letter.pdf” is nothing that Softbox opens"), "anything else is told");
    assert_eq!(window.scene(), scene, "and changes nothing");
}

#[test]
fn the_first_steps_are_shown_until_they_are_known() {
    let mut window = Window::new();
    assert!(!window.has("Got it"), "where nothing is kept between starts, they do not come by themselves");
    window.menu(&["Help", "First steps"]);
    window.snapshot("first_steps");
    window.click("Got it");
    assert!(!window.has("Got it"), "known");
}

#[test]
fn recent_files_that_are_gone_are_grey() {
    let mut window = Window::with_scene();
    let path = window.path("scene.toml");
    window.key(Modifiers::COMMAND, Key::N);
    std::fs::remove_file(&path).expect("the scene is deleted");
    window.menu(&["File", "Open recent", "scene.toml"]);
    assert_eq!(window.session().path, None, "it cannot be opened");
    assert_eq!(window.session().notices.len(), 0, "and nothing went wrong");
}

#[test]
fn mute_and_solo_of_the_selection_have_keys() {
    let mut window = Window::with_scene();
    window.click("strip");
    window.key(Modifiers::COMMAND, Key::M);
    assert!(window.scene().lights[1].muted, "muted");
    window.key(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::M);
    assert!(window.session().is_solo("strip"), "soloed");
    assert_eq!(window.session().selection.primary(), Some(Item::Light(1)), "still selected");
}
