//! What is wrong with the scene, and the way there.

use egui::accesskit::Role;
use egui_kittest::kittest::{NodeT, Queryable};
use softbox::editor::{Item, Session};

use crate::window::{SCENE, Window};

/// The usual scene, its globe underground and its terracotta too bright.
fn troubled() -> String {
    let sunk = SCENE.replace("position = [1.5, 0.5, 1.0]", "position = [1.5, 0.5, -1.0]");
    sunk.replace("diffuse = [0.6, 0.2, 0.1]", "diffuse = [0.9, 0.2, 0.1]")
}

fn camera_target(session: &Session) -> glam::DVec3 {
    session.view.camera.target
}

#[test]
fn a_problem_is_counted_leads_to_its_field_and_goes_when_it_is_solved() {
    let mut window = Window::with(&troubled());
    window.click("Problems (2)");
    assert!(window.says("“globe” is below “floor”"), "the light underground");
    assert!(window.says("“terracotta” reflects more than it receives"), "the material that gains energy");
    let before = camera_target(window.session());
    let row = |window: &Window, text: &str| {
        let mut rows = window.harness.query_all_by_label_contains(text);
        rows.next().expect("a row").accesskit_node().label().expect("a label")
    };
    let globe = row(&window, "“globe” is below");
    window.click_role(Role::Button, &globe);
    assert_eq!(window.selected(), Some((Item::Light(2), "globe".to_owned())), "selected");
    assert_ne!(camera_target(window.session()), before, "and brought into view");
    window.snapshot("problems");
    window.enter("Position Z", "1.0");
    assert!(window.has("Problems (1)") && !window.says("is below"), "solved");
    let terracotta = row(&window, "“terracotta” reflects");
    window.click_role(Role::Button, &terracotta);
    assert_eq!(window.selected().map(|(item, _)| item), Some(Item::Material(1)), "selected");
    window.enter("Diffuse k_d red", "0.5");
    assert!(window.has_any("Problems") && window.says("No problems."), "none is left");
}
