//! The list of lights, editing several of them together, and variants.

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::Queryable;
use softbox::editor::units::lux_at_metre;
use softbox::editor::{Item, Session};
use softbox::gpu::Stats;
use softbox::light::{Light, QuantityKind, Tint};
use softbox::scene;

use crate::window::Window;

fn session(window: &mut Window) -> &mut Session {
    &mut window.harness.state_mut().session
}

fn names(lights: &[Light]) -> Vec<String> {
    let name = |light: &Light| match &light.group {
        Some(group) => format!("{}:{group}", light.name),
        None => light.name.clone(),
    };
    lights.iter().map(name).collect()
}

#[track_caller]
fn check_list(window: &Window, expected: &[&str], why: &str) {
    assert_eq!(names(&window.scene().lights), expected, "{why}");
}

/// Click a row with a key held.
#[track_caller]
fn click_with(window: &mut Window, modifiers: Modifiers, label: &str) {
    window.get(label).click_modifiers(modifiers);
    window.settle();
}

#[track_caller]
fn double_click(window: &mut Window, label: &str) {
    // Long after the click before, which would count.
    (0..15).for_each(|_| window.harness.step());
    window.get(label).click();
    window.get(label).click();
    window.settle();
}

/// Type into the field that has the focus, in place of what is there.
fn type_name(window: &mut Window, name: &str) {
    window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.harness.event(egui::Event::Text(name.to_owned()));
    window.settle();
    window.key(Modifiers::NONE, Key::Enter);
}

#[track_caller]
fn drag_row(window: &mut Window, label: &str, to: Pos2) {
    let from = window.get(label).rect().center();
    window.drag(&[from, from + vec2(0.0, 8.0), to, to]);
}

#[test]
fn lights_are_grouped_moved_and_taken_apart_by_mouse_and_keys() {
    let mut window = Window::with_scene();
    window.click("strip");
    click_with(&mut window, Modifiers::COMMAND, "globe");
    window.key(Modifiers::COMMAND, Key::G);
    check_list(&window, &["window", "strip:Group 1", "globe:Group 1"], "grouped by key");
    double_click(&mut window, "Group 1");
    type_name(&mut window, "fill");
    check_list(&window, &["window", "strip:fill", "globe:fill"], "renamed by a double click");
    window.click("Mute fill");
    assert!(window.scene().lights[1..].iter().all(|light| light.muted), "the whole group is muted");
    window.click("Unmute fill");
    window.click("fill");
    assert_eq!(window.session().selection.items().len(), 2, "a click on the group selects its lights");

    let below = window.get("globe").rect().center() + vec2(0.0, 6.0);
    drag_row(&mut window, "window", below);
    check_list(&window, &["strip:fill", "globe:fill", "window:fill"], "dragged to the group's end");
    let above = window.get("fill").rect().center() - vec2(0.0, 6.0);
    drag_row(&mut window, "window", above);
    check_list(&window, &["window", "strip:fill", "globe:fill"], "and out at its top");
    window.click("window");
    window.key(Modifiers::ALT, Key::ArrowDown);
    check_list(&window, &["window:fill", "strip:fill", "globe:fill"], "down by key, into the group");
    window.key(Modifiers::COMMAND, Key::Z);
    window.snapshot("list_group");

    window.click("Close group fill");
    assert!(!window.has("strip") && window.has("fill"), "a closed group does not list its lights");
    window.key(Modifiers::ALT, Key::ArrowDown);
    check_list(&window, &["strip:fill", "globe:fill", "window"], "past a closed group at once");
    window.click("Open group fill");
    window.click("window");
    click_with(&mut window, Modifiers::SHIFT, "strip");
    assert_eq!(window.session().selection.items().len(), 3, "Shift selects a range");
    window.key(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::G);
    check_list(&window, &["strip", "globe", "window"], "taken apart");
    let steps = window.steps_back();
    assert_eq!(steps.len(), 8, "one step each: {steps:?}");
    check_list(&window, &["window", "strip", "globe"], "and all of it undone");
}

#[test]
fn several_lights_are_edited_together_in_one_step() {
    let mut window = Window::with_scene();
    window.click("window");
    click_with(&mut window, Modifiers::COMMAND, "globe");
    let before = window.scene();
    window.enter("Position Z", "3");
    let scene = window.scene();
    assert_eq!([0, 2].map(|i| scene.lights[i].position.z), [3.0, 3.0], "what is typed goes to both");
    assert_eq!(scene.lights[0].position.x, before.lights[0].position.x, "and nothing else does");

    let start = window.get("Position X").rect().center();
    window.drag(&[10.0, 30.0, 60.0].map(|dx| start + vec2(dx, 0.0)));
    let moved = [0, 2].map(|i| window.scene().lights[i].position.x - before.lights[i].position.x);
    assert!(moved[0] > 0.1 && (moved[0] - moved[1]).abs() < 1e-9, "a drag moves both as far: {moved:?}");

    let start = window.get("Brightness").rect().center();
    window.drag(&[10.0, 30.0, 60.0].map(|dx| start + vec2(dx, 0.0)));
    let factor = [0, 2].map(|i| window.scene().lights[i].quantity.value() / before.lights[i].quantity.value());
    assert!(factor[0] > 1.1 && (factor[0] / factor[1] - 1.0).abs() < 1e-9, "both by one factor: {factor:?}");
    let kinds = [0, 2].map(|i| window.scene().lights[i].quantity.kind());
    assert_eq!(kinds, [QuantityKind::Luminance, QuantityKind::Flux], "each in its own unit");

    let strengths = window.scene().lights.iter().map(Light::strength).collect::<Vec<_>>();
    window.snapshot("list_together");
    window.click("Keep flux");
    let scene = window.scene();
    assert!(scene.lights.iter().all(|light| light.quantity.kind() != QuantityKind::Luminance), "stated as flux");
    for (light, strength) in scene.lights.iter().zip(strengths) {
        assert!((light.strength() / strength - 1.0).abs() < 1e-12, "{} looks the same", light.name);
    }
    let steps = ["Change what resizing keeps", "Change brightness", "Change position", "Change position"];
    assert_eq!(window.steps_back(), steps, "one step each");
}

#[test]
fn several_surfaces_and_their_materials_are_edited_together_in_one_step() {
    let mut window = Window::with_scene();
    window.click("ball");
    // The surface stands before the material of that name.
    window.harness.get_all_by_label("floor").next().expect("its row").click_modifiers(Modifiers::COMMAND);
    window.settle();
    assert!(window.says("edits 2 surfaces together") && window.says("2 materials"), "surfaces and materials");
    assert!(!window.has("Radius"), "a plane has none");
    window.enter("Position X", "0.25");
    let scene = window.scene();
    assert!(scene.surfaces.iter().all(|surface| surface.position.x == 0.25), "what is typed goes to both");
    window.enter("Exponent m", "20");
    window.click("Pick diffuse k_d");
    let bar = window.get("Value").rect();
    window.drag(&[bar.left_center() + vec2(0.25 * bar.width(), 0.0)]);
    let scene = window.scene();
    let [floor, terracotta] = &scene.materials[..] else { panic!("two materials") };
    assert_eq!([floor.exponent, terracotta.exponent], [20.0, 20.0], "of both materials");
    assert_eq!(floor.diffuse, terracotta.diffuse, "one colour");
    assert!((floor.diffuse.max_element() - 0.5).abs() > 1e-3, "another one: {}", floor.diffuse);
    let steps = ["Change diffuse k_d", "Change exponent m", "Change position"];
    assert_eq!(window.steps_back(), steps, "one step each");
}

#[test]
fn quantity_unit_and_colour_are_changed_in_the_list() {
    let mut window = Window::with_scene();
    let start = window.get("Luminance of window").rect().center();
    window.drag(&[10.0, 30.0].map(|dx| start + vec2(dx, 0.0)));
    assert!(window.scene().lights[0].quantity.value() > 1000.0, "dragged up");
    window.enter("Flux of globe", "1500");
    assert_eq!(window.scene().lights[2].quantity.value(), 1500.0, "typed");
    window.enter("Flux of globe", "1.2 klm");
    assert_eq!(window.scene().lights[2].quantity.value(), 1200.0, "typed in thousands");
    window.enter("Luminance of window", "300 lx at 1 m");
    let lux = lux_at_metre(&window.scene().lights[0]).expect("the window has some");
    assert!((lux - 300.0).abs() < 1e-9, "typed in another unit: {lux} lx");
    let strength = window.scene().lights[2].strength();
    window.click("Unit of globe");
    window.click("Luminance (cd/m²)");
    let light = window.scene().lights[2].clone();
    assert_eq!(light.quantity.kind(), QuantityKind::Luminance, "another unit");
    assert!((light.strength() / strength - 1.0).abs() < 1e-12, "the same light");

    window.click("Tint of globe");
    window.click("Tint by temperature");
    assert_eq!(window.scene().lights[2].tint, Tint::TemperatureK(6500.0), "by temperature now");
    window.enter("Temperature", "2700");
    assert_eq!(window.scene().lights[2].tint, Tint::TemperatureK(2700.0), "typed");
    window.snapshot("list_tint");
    window.key(Modifiers::NONE, Key::Escape);
    let steps = ["Change temperature", "Change tint", "Change unit"];
    assert_eq!(window.steps_back(), [&steps[..], &["Change emission"; 4]].concat(), "one step each");
}

#[test]
fn a_light_is_linked_to_surfaces_and_the_link_follows_them() {
    let mut window = Window::with_scene();
    let only = |window: &Window| window.scene().lights[0].only.clone();
    window.click("window");
    window.click("Surfaces that are lit");
    window.click_role(Role::CheckBox, "floor");
    assert_eq!(only(&window), Some(vec!["ball".to_owned()]), "all but the floor");
    window.snapshot("list_links");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(window.has("Links of window"), "its row says so");
    double_click(&mut window, "ball");
    type_name(&mut window, "vase");
    assert_eq!(only(&window), Some(vec!["vase".to_owned()]), "renamed with the surface");
    window.click("vase");
    window.key(Modifiers::NONE, Key::Delete);
    assert_eq!(only(&window), Some(Vec::new()), "gone with it");
    window.click("Links of window");
    window.click_role(Role::CheckBox, "All surfaces");
    assert_eq!(only(&window), None, "all again");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.steps_back(), ["Link lights", "Delete", "Rename", "Link lights"], "one step each");
}

/// What was redone in the picture by a change.
fn cost(window: &mut Window, change: impl FnOnce(&mut Window)) -> Stats {
    let stats = |window: &Window| window.harness.state().picture_stats().expect("there is a picture");
    window.settle();
    let before = stats(window);
    change(window);
    window.settle();
    let after = stats(window);
    Stats {
        g_buffers: after.g_buffers - before.g_buffers,
        layers: after.layers - before.layers,
        shadows: after.shadows - before.shadows,
        composites: after.composites - before.composites,
    }
}

#[test]
fn intensity_tint_mute_solo_links_and_variants_of_them_shade_nothing() {
    let mut window = Window::with_scene();
    window.click("strip");
    click_with(&mut window, Modifiers::COMMAND, "globe");
    window.key(Modifiers::COMMAND, Key::G);
    window.click("Store lights as a variant");
    let mut check = |what: &str, change: &dyn Fn(&mut Window)| {
        let Stats { g_buffers, layers, shadows, composites } = cost(&mut window, change);
        assert_eq!((g_buffers, layers, shadows), (0, 0, 0), "{what} shades nothing");
        assert!(composites > 0, "{what} is seen");
    };
    check("a quantity", &|window| window.enter("Flux of globe", "500"));
    check("a unit's quantity", &|window| window.enter("Luminance of window", "700"));
    check("a temperature", &|window| {
        session(window).edit("Tint", |scene| scene.lights[0].tint = Tint::TemperatureK(2500.0))
    });
    check("mute", &|window| window.click("Mute globe"));
    check("unmute", &|window| window.click("Unmute globe"));
    check("solo", &|window| window.click("Solo globe"));
    check("no solo", &|window| window.click("Solo globe"));
    check("muting a group", &|window| window.click("Mute Group 1"));
    check("a link", &|window| session(window).link_lights(&[0], Some(&["ball".to_owned()])));
    check("another variant", &|window| window.key(Modifiers::NONE, Key::F5));
    check("undoing that", &|window| window.key(Modifiers::COMMAND, Key::Z));
    let moved = cost(&mut window, |window| session(window).edit("Move", |scene| scene.lights[0].position.z = 1.5));
    assert_eq!(moved.layers, 1, "a light that moves is shaded");
}

#[test]
fn variants_are_stored_switched_by_keys_and_saved() {
    let mut window = Window::with_scene();
    window.click("Store lights as a variant");
    assert_eq!(window.scene().variants.len(), 1, "stored");
    double_click(&mut window, "Switch to Variant 1");
    type_name(&mut window, "day");
    window.click("Mute window");
    assert!(window.scene().differs_from_variant(), "the lights are not as they were stored");
    window.click("Store lights as a variant");
    double_click(&mut window, "Switch to Variant 1");
    type_name(&mut window, "evening");
    let order = |window: &Window| -> Vec<String> { window.scene().variants.iter().map(|v| v.name.clone()).collect() };
    let above = window.get("Switch to day").rect().center_top();
    drag_row(&mut window, "Switch to evening", above);
    assert_eq!(order(&window), ["evening", "day"], "dragged above");
    let below = window.get("Switch to day").rect().center_bottom();
    drag_row(&mut window, "Switch to evening", below);
    assert_eq!(order(&window), ["day", "evening"], "dragged below");
    let muted = |window: &Window| window.scene().lights[0].muted;
    window.key(Modifiers::NONE, Key::F5);
    assert!(!muted(&window), "day, by its key");
    window.key(Modifiers::NONE, Key::PageDown);
    assert!(muted(&window), "the next one");
    window.key(Modifiers::NONE, Key::PageUp);
    assert!(!muted(&window), "the one before");
    window.click("Show in this view evening");
    let session = session(&mut window);
    let view = session.view;
    assert!(session.shown_for(&view).lights[0].muted && !session.scene().lights[0].muted, "shown, not switched to");
    window.settle();
    window.snapshot("variants");
    window.click("Show the scene’s lights");

    window.click("Compare with evening");
    window.snapshot("variants_split");
    window.click("Compare by difference");
    window.snapshot("variants_difference");
    window.click("Stop comparing with evening");

    window.enter("Luminance of window", "400");
    window.click("Revert to the variant");
    assert_eq!(window.scene().lights[0].quantity.value(), 1000.0, "as it was stored");
    window.enter("Luminance of window", "400");
    window.click("Store the lights in day");
    assert!(!window.scene().differs_from_variant(), "updated");
    window.key(Modifiers::COMMAND, Key::S);
    let saved = scene::load(window.path("scene.toml")).expect("it was saved");
    assert_eq!(saved, *window.scene(), "all of it");
    assert_eq!(saved.active_variant.as_deref(), Some("day"), "and which is active");
    assert_eq!(window.session().selection.items(), [] as [Item; 0], "nothing was selected by it");
}
