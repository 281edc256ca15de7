//! Outliner, inspector, plots and commands.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use softbox::editor::{Item, Tool};
use softbox::light::{QuantityKind, Shape};
use softbox::shading::Method;

use crate::window::Window;

#[test]
fn a_click_in_the_outliner_selects_and_the_inspector_shows_it() {
    let mut window = Window::with_scene();
    assert!(window.has("Scene name"), "at first the scene itself is shown");
    window.click("strip");
    assert_eq!(window.selected(), Some((Item::Light(1), "strip".to_owned())), "selected");
    assert!(window.has("Length") && window.has("Flux"), "a line's numbers are shown");
}

#[test]
fn a_number_is_changed_undone_and_done_again() {
    let mut window = Window::with_scene();
    window.click("globe");
    window.enter("Position X", "0.75");
    assert!((window.scene().lights[2].position.x - 0.75).abs() < 1e-12, "{:?}", window.scene().lights[2].position);
    window.key(Modifiers::COMMAND, Key::Z);
    assert!((window.scene().lights[2].position.x - 1.5).abs() < 1e-12, "undone");
    window.key(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    assert!((window.scene().lights[2].position.x - 0.75).abs() < 1e-12, "done again");
}

#[test]
fn keys_that_come_in_one_frame_all_count_in_their_order() {
    let mut window = Window::with_scene();
    window.click("globe");
    window.enter("Position X", "0.75");
    window.enter("Position X", "0.5");
    let z = |modifiers| {
        let (key, physical_key) = (Key::Z, None);
        egui::Event::Key { key, physical_key, pressed: true, repeat: false, modifiers }
    };
    let redo = Modifiers::COMMAND.plus(Modifiers::SHIFT);
    let events = [Modifiers::COMMAND, Modifiers::COMMAND, redo].map(z);
    window.harness.input_mut().events.extend(events);
    window.settle();
    let x = window.scene().lights[2].position.x;
    assert!((x - 0.75).abs() < 1e-12, "two steps back and one forth end at {x}");
}

#[test]
fn a_click_in_and_out_of_a_number_keeps_the_digits_that_it_does_not_show() {
    let mut window = Window::with_scene();
    window.click("globe");
    window.harness.state_mut().session.edit("Move", |scene| scene.lights[2].position.x = -12.345_678_912);
    window.settle();
    let before = window.scene();
    window.click("Position X");
    window.key(Modifiers::NONE, Key::Tab);
    assert_eq!(*before, *window.scene(), "looked at");
    let field = window.get("Position X").rect();
    assert!(field.width() < 72.5, "{field:?} is as wide as any other");
}

#[test]
fn dragging_a_number_is_one_step_back() {
    let mut window = Window::with_scene();
    window.click("globe");
    let start = window.get("Radius").rect().center();
    window.drag(&[10.0, 30.0, 60.0].map(|dx| start + vec2(dx, 0.0)));
    let Shape::Sphere(sphere) = &window.scene().lights[2].shape else { panic!("a sphere") };
    assert!(sphere.radius > 0.2, "dragging to the right makes it larger, not {}", sphere.radius);
    assert_eq!(window.steps_back(), ["Change radius"], "one gesture, one step");
}

#[test]
fn a_flux_can_be_typed_where_a_luminance_was_stated() {
    let mut window = Window::with_scene();
    window.click("window");
    window.enter("Flux", "5000");
    let quantity = window.scene().lights[0].quantity;
    assert_eq!(quantity.kind(), QuantityKind::Flux, "now stated so");
    assert!((quantity.value() - 5000.0).abs() < 1e-9, "{}", quantity.value());
}

#[test]
fn what_would_make_a_polygon_cross_itself_is_refused_with_the_reason() {
    let mut window = Window::with_scene();
    window.click("window");
    let before = window.scene();
    // The first corner, pulled far beyond the third, turns the rectangle into a bow tie.
    window.enter("Vertex 1 Y", "3.0");
    assert_eq!(window.scene(), before, "refused");
}

#[test]
fn lights_are_muted_and_soloed_in_the_outliner() {
    let mut window = Window::with_scene();
    window.click("Mute globe");
    assert!(window.scene().lights[2].muted, "muted");
    window.click("Unmute globe");
    assert!(!window.scene().lights[2].muted, "and not any more");
    window.click("Solo strip");
    let shown = window.harness.state_mut().session.shown();
    let muted: Vec<bool> = shown.lights.iter().map(|light| light.muted).collect();
    assert_eq!(muted, [true, false, true], "only the strip is shown");
    assert!(window.scene().lights.iter().all(|light| !light.muted), "the document is not changed by it");
}

#[test]
fn a_double_click_renames() {
    let mut window = Window::with_scene();
    window.get("globe").click();
    window.get("globe").click();
    window.settle();
    window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text("moon".to_owned()));
    window.settle();
    window.key(Modifiers::NONE, Key::Enter);
    assert_eq!(window.scene().lights[2].name, "moon", "renamed");
    assert_eq!(window.steps_back(), ["Rename"], "one step");
}

#[test]
fn the_selected_light_is_duplicated_and_deleted_by_keys() {
    let mut window = Window::with_scene();
    window.click("strip");
    window.key(Modifiers::COMMAND, Key::D);
    assert_eq!(window.selected(), Some((Item::Light(3), "strip 2".to_owned())), "the copy is selected");
    window.key(Modifiers::NONE, Key::Delete);
    assert_eq!(window.scene().lights.len(), 3, "deleted");
    assert_eq!(window.steps_back(), ["Delete", "Duplicate"], "two steps");
}

#[test]
fn plain_keys_take_tools_but_not_while_text_is_typed() {
    let mut window = Window::with_scene();
    window.key(Modifiers::NONE, Key::P);
    assert_eq!(window.session().tool, Tool::Polygon, "by key");
    window.click("Move");
    assert_eq!(window.session().tool, Tool::Move, "by button");
    window.click("Scene name");
    window.key(Modifiers::NONE, Key::L);
    assert_eq!(window.session().tool, Tool::Move, "the key belongs to the text");
}

#[test]
fn lights_are_added_from_the_menu() {
    let mut window = Window::new();
    for kind in ["Polygon", "Line", "Sphere", "Point", "Directional"] {
        window.menu(&["Add", "Light", kind]);
        let light = window.scene().lights.last().cloned().expect("a light");
        assert_eq!(light.shape.name(), kind.to_lowercase(), "{kind}");
        let last = Item::Light(window.scene().lights.len() - 1);
        assert_eq!(window.selected().map(|(item, _)| item), Some(last), "{kind} is selected");
    }
}

#[test]
fn the_method_of_the_view_is_chosen_from_the_menu() {
    let mut window = Window::with_scene();
    window.menu(&["View", "Shading method", "nearest-point"]);
    assert_eq!(window.session().view.method, Method::NearestPoint, "chosen");
}

#[test]
fn plots_show_a_curve_a_method_and_their_errors() {
    let mut window = Window::with_scene();
    assert!(window.has("Curves of tilt under the window"), "the first plot is in front");
    for method in ["exact", "nearest-point", "chebyshev", "hermite-1", "point", "reference"] {
        assert!(window.has(&format!("Show {method}")), "{method} is in the legend");
    }
    assert!(!window.has_any("…"), "all figures have come");
    window.click("Show one-shot");
    assert!(window.session().plots.hidden.contains("one-shot"), "switched off");
    window.click_role(Role::Button, "New plot");
    window.menu(&["line"]);
    assert_eq!(window.scene().plots.len(), 3, "a plot more");
    assert!(window.has("Curves of line"), "and in front");
}

#[test]
fn keys_are_listed_by_f1() {
    let mut window = Window::new();
    window.key(Modifiers::NONE, Key::F1);
    assert!(window.says("Draw polygon") && window.says("Ctrl+Shift+Z"), "names and keys");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.says("Ctrl+Shift+Z"), "closed");
}

#[test]
fn an_idle_window_asks_for_no_frames() {
    let mut window = Window::with_scene();
    window.settle();
    window.harness.step();
    let delay = window.harness.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    assert_eq!(delay, Duration::MAX, "repaint causes: {:?}", window.harness.ctx.repaint_causes());
}

#[test]
fn a_preset_is_inserted_from_the_menu_and_selected() {
    let mut window = Window::with_scene();
    window.menu(&["File", "Insert preset", "Octabox"]);
    assert!(window.scene().lights.len() > 3, "its lights are there");
    assert_eq!(window.selected().map(|(item, _)| item), Some(Item::Light(3)), "and selected");
    assert_eq!(window.steps_back(), ["Insert Octabox"], "one step");
}

#[test]
fn an_example_is_opened_from_the_menu() {
    let mut window = Window::with_scene();
    window.menu(&["File", "Open example", "Portrait"]);
    assert_eq!(window.session().path, None, "it has no file of its own");
    assert!(!window.scene().lights.is_empty(), "and lights");
}

/// The README's picture. Figures in the legend that are measured times differ from run to run.
#[test]
fn the_window_looks_as_it_did() {
    let mut window = Window::with_scene();
    window.click("window");
    window.snapshot("editor");
}

#[test]
fn the_light_theme_looks_as_it_did() {
    let mut window = Window::with_scene();
    window.menu(&["View", "Switch dark/light theme"]);
    window.click("ball");
    window.snapshot("editor_light");
}
