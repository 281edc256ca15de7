//! The library: looked through, searched, inserted from by key and by drag, and added to.

use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use softbox::scene;

use crate::window::Window;

/// A window with the library in front.
fn open() -> Window {
    let mut window = Window::with_scene();
    window.click("Library");
    window
}

fn search(window: &mut Window, text: &str) {
    window.click("Search library");
    window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text(text.to_owned()));
    window.settle();
}

#[test]
fn a_light_is_found_by_its_tags_and_inserted_by_a_double_click() {
    let mut window = open();
    window.snapshot("library");
    search(&mut window, "studio rim");
    assert!(window.has("Strip softbox") && !window.has("Octabox"), "what was looked for");
    window.double_click("Strip softbox");
    assert_eq!(window.scene().lights.len(), 4, "inserted");
    assert_eq!(window.session().history.undo_label(), Some("Insert Strip softbox"), "one step");
    search(&mut window, "no such light");
    assert!(window.says("Nothing matches"), "said so");
}

#[test]
fn a_light_dragged_into_the_view_stands_where_it_is_dropped() {
    let mut window = open();
    search(&mut window, "octabox");
    let from = window.get("Octabox").rect().center();
    let to = window.get("Viewport").rect().center() + vec2(150.0, 120.0);
    window.drag(&[from, from + vec2(0.0, -20.0), from.lerp(to, 0.5), to, to]);
    let scene = window.scene();
    let light = scene.lights.last().expect("a light");
    assert_eq!(light.name, "octabox", "inserted");
    assert!(light.position.x > 0.3, "to the right, at {}", light.position);
    assert!((light.position.z - 2.2).abs() < 1e-9, "as high over the floor as in the preset: {}", light.position);
    assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some("octabox"), "and selected");
}

#[test]
fn a_scene_is_opened_by_a_double_click() {
    let mut window = open();
    search(&mut window, "three spheres");
    window.click("Show scenes");
    window.double_click("Three spheres");
    assert_eq!(window.scene().name, "Three spheres of one flux", "opened");
}

#[test]
fn a_selection_is_kept_as_a_preset_and_found_again() {
    let mut window = open();
    window.click_role(Role::Button, "window");
    window.menu(&["Edit", "Save selection as preset…"]);
    window.click("Preset name");
    window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text("Big window".to_owned()));
    window.settle();
    window.click("Preset tags");
    window.harness.event(egui::Event::Text("mine north".to_owned()));
    window.settle();
    window.click("Save preset");
    let preset = scene::load(window.path("data/presets/big-window.toml")).expect("the preset opens");
    assert_eq!(preset.tags, ["mine", "north"], "tags");
    assert_eq!(preset.lights.len(), 1, "one light");
    assert!(window.has("Big window"), "it is in the library");
    window.double_click("Big window");
    assert_eq!(window.scene().lights.len(), 4, "and can be inserted");
}
