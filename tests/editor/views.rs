//! Several viewports, methods side by side, differences, illuminance, bands and exposure, as a user sees them.

use std::sync::atomic::AtomicBool;
use std::time::Duration;

use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, Vec2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT, Queryable};
use softbox::analysis::measure;
use softbox::editor::session::ViewMode;
use softbox::editor::viewport::projection::Projection;
use softbox::gpu::Stats;
use softbox::render::{MethodChoice, Shadows};
use softbox::shading::Method;

use super::viewport::{Pane, pane, press, test_scene, test_scene_from_above};
use super::window::Window;

impl Window {
    /// Choose what the viewport shows.
    #[track_caller]
    fn show(&mut self, label: &str) {
        self.click_role(Role::ComboBox, "View shows");
        self.click_role(Role::Button, label);
    }
}

/// Let a viewport run until nothing moves any more.
#[track_caller]
fn settle(harness: &mut Harness<'static, Pane>) {
    for _ in 0..2000 {
        let is_still = harness.run_ok().is_some();
        if is_still && !harness.state().viewport.is_busy() {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("the viewport is still busy");
}

/// Drag in a viewport, a frame a point.
fn drag(harness: &mut Harness<'static, Pane>, points: &[Pos2], modifiers: Modifiers) {
    harness.hover_at(points[0]);
    harness.event(egui::Event::ModifiersChanged(modifiers));
    harness.step();
    press(harness, points[0], true, modifiers);
    for point in points {
        harness.hover_at(*point);
        harness.step();
    }
    press(harness, points[points.len() - 1], false, modifiers);
    harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    harness.step();
}

fn stats(harness: &Harness<'static, Pane>) -> Vec<Stats> {
    (0..4).map(|index| harness.state().viewport.stats_of(index)).collect()
}

#[test]
fn keys_show_one_two_or_four_viewports_and_two_compare_methods_through_one_camera() {
    let mut window = Window::with_scene();
    window.key(Modifiers::ALT, Key::Num2);
    assert_eq!(window.session().views.count(), 2, "two");
    assert!(window.has("Method, view 1") && window.has("Method, view 2"), "each has its method");
    assert_eq!(window.session().view.method, Method::Exact, "the first");
    let right = window.get("Viewport 2").rect();
    let at = right.center() + vec2(0.0, 0.3 * right.height());
    window.drag(&[at]);
    assert_eq!((window.session().views.active(), window.session().view.method), (1, Method::Point), "the second");
    window.menu(&["View", "Shading method", "nearest-point"]);
    assert_eq!(window.session().view.method, Method::NearestPoint, "menus act on the active one");

    let start = window.session().view.camera;
    window.harness.event(egui::Event::ModifiersChanged(Modifiers::ALT));
    window.harness.event(egui::Event::PointerMoved(at));
    for (pos, pressed) in [(at, Some(true)), (at + vec2(40.0, 10.0), None), (at + vec2(40.0, 10.0), Some(false))] {
        window.harness.event(egui::Event::PointerMoved(pos));
        if let Some(pressed) = pressed {
            let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::ALT);
            window.harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        }
        window.harness.step();
    }
    window.harness.event(egui::Event::ModifiersChanged(Modifiers::NONE));
    window.settle();
    let turned = window.session().view.camera;
    assert!(turned.eye.distance(start.eye) > 0.1, "the second orbits");
    window.drag(&[window.get("Viewport 1").rect().center_bottom() - vec2(0.0, 20.0)]);
    assert_eq!((window.session().views.active(), window.session().view.camera), (0, turned), "the first follows");

    window.key(Modifiers::ALT, Key::Num4);
    let places: Vec<_> = (1..=4).map(|i| window.get(&format!("Viewport {i}")).rect()).collect();
    assert!(places.iter().all(|rect| rect.width() > 300.0), "four have room: {places:?}");
    assert!(!window.session().views.linked, "and look from four sides");
    window.key(Modifiers::ALT, Key::Num1);
    assert!(window.has("Viewport") && !window.session().history.is_modified(), "one again, the document untouched");
}

#[test]
fn a_split_is_dragged_and_shades_nothing_anew() {
    let mut harness = pane(test_scene(), vec2(640.0, 420.0));
    harness.run();
    harness.get_by_role_and_label(Role::ComboBox, "View shows").click();
    harness.run();
    harness.get_by_role_and_label(Role::Button, "Split").click();
    harness.run();
    let view = harness.state().session.view;
    assert_eq!((view.mode, view.method, view.against), (ViewMode::Split, Method::Exact, Method::Point), "two methods");
    let before = harness.state().viewport.stats();
    let grip = harness.get_by_label("Split").rect().center();
    drag(&mut harness, &[grip, grip - vec2(50.0, 0.0), grip - vec2(128.0, 0.0)], Modifiers::NONE);
    harness.run();
    let share = harness.state().session.view.split;
    assert!((share - 0.3).abs() < 0.01, "dragged to {share}");
    assert_eq!(harness.state().viewport.stats(), before, "neither shaded nor summed again");
    harness.remove_cursor();
    settle(&mut harness);
    harness.snapshot("views_split");
}

#[test]
fn a_difference_has_a_scale_that_follows_the_picture_until_it_is_typed() {
    let mut window = Window::with_scene();
    window.show("Difference");
    let view = window.session().view;
    assert_eq!((view.method, view.against), (Method::Point, Method::Exact), "an approximation less exact");
    let scale = |window: &Window| {
        let bar = window.harness.get_by_label_contains("Scale: ");
        bar.accesskit_node().label().expect("the bar says what it means")
    };
    let auto = scale(&window);
    assert!(auto.starts_with("Scale: point − exact, ±") && auto.ends_with("cd/m²"), "{auto}");
    window.click(&auto);
    window.click("Auto scale");
    window.enter("Scale end", "12.5");
    assert_eq!(window.session().view.difference_ends, [Some(12.5), None], "typed");
    assert_eq!(scale(&window), "Scale: point − exact, ±12.5 cd/m²", "shown");
    window.click("%");
    let relative = scale(&window);
    assert!(relative.ends_with(" %") && !relative.contains("12.5"), "shares have a scale of their own: {relative}");
    assert!(!window.session().history.is_modified(), "the document has no part in it");
}

#[test]
fn illuminance_is_measured_over_a_rectangle_that_is_dragged_and_typed() {
    let mut window = Window::with_scene();
    window.key(Modifiers::NONE, Key::M);
    let measured = |window: &Window| {
        let session = window.session();
        let rectangle = session.measure.rectangle;
        let choice = MethodChoice::Method(session.view.method);
        measure(session.scene(), &rectangle, choice, Shadows::default(), &AtomicBool::new(false))
            .expect("not cancelled")
    };
    let first = measured(&window);
    let uniformity =
        |found: softbox::analysis::Measured| format!("U0 {:.2}   Ud {:.2}", found.uniformity(), found.diversity());
    assert!(window.says(&uniformity(first)), "{first:?} is shown");

    let before = window.session().measure.rectangle;
    let grip = window.get("Measuring rectangle, corner 1").rect().center();
    window.drag(&[grip, grip + vec2(-8.0, 6.0), grip + vec2(-20.0, 14.0)]);
    let rectangle = window.session().measure.rectangle;
    assert_ne!(rectangle, before, "dragged");
    let opposite = |rectangle: softbox::analysis::Rectangle| rectangle.corners()[2];
    assert!(opposite(rectangle).distance(opposite(before)) < 1e-9, "about the opposite corner");
    window.click("Measuring rectangle");
    window.enter("Height", "0.75");
    window.enter("Width", "1.5");
    assert_eq!(window.session().measure.rectangle.center.z, 0.75, "height");
    assert_eq!(window.session().measure.rectangle.size.x, 1.5, "width");
    window.key(Modifiers::NONE, Key::Escape);
    let second = measured(&window);
    assert_ne!(first, second, "elsewhere");
    assert!(window.says(&uniformity(second)), "{second:?} is shown");
    window.click("Copy measurement");
    assert!(window.says("Copied the measurement"), "copied");
    assert!(!window.session().history.is_modified(), "the document has no part in it");
    window.key(Modifiers::NONE, Key::M);
    assert!(!window.says("U0 "), "put away");
}

#[test]
fn auto_exposure_is_one_step_and_makes_the_bright_part_nearly_white() {
    let mut window = Window::with_scene();
    window.harness.state_mut().session.edit("Dim", |scene| {
        for light in &mut scene.lights {
            light.quantity = softbox::light::Quantity::new(light.quantity.kind(), 0.05 * light.quantity.value());
        }
    });
    window.settle();
    window.menu(&["View", "Auto exposure"]);
    let exposure_ev = window.scene().display.exposure_ev;
    assert!((1.0..=8.0).contains(&exposure_ev), "brighter by {exposure_ev} EV");
    assert_eq!(window.session().history.undo_label(), Some("Auto exposure"), "the step");
    window.menu(&["View", "Auto exposure"]);
    assert_eq!(window.scene().display.exposure_ev, exposure_ev, "it is right already");
    let slider = window.harness.get_by_role_and_label(Role::Slider, "Exposure").rect();
    let middle = slider.left_center() + vec2(40.0, 0.0);
    window.drag(&[middle, middle - vec2(10.0, 0.0), middle - vec2(20.0, 0.0)]);
    assert!(window.scene().display.exposure_ev < 0.0, "darker: {} EV", window.scene().display.exposure_ev);
    assert_eq!(window.steps_back(), ["Change exposure", "Auto exposure", "Dim"], "one step each");
}

#[test]
fn in_300_points_all_controls_fit_and_the_menu_has_the_rest() {
    let mut harness = pane(test_scene(), vec2(300.0, 260.0));
    harness.state_mut().session.view.set_mode(ViewMode::Difference);
    settle(&mut harness);
    for label in ["View shows", "Method", "Show"] {
        let rect = harness.get_by_label(label).rect();
        assert!(rect.left() >= 0.0 && rect.right() <= 292.0, "{label} is at {rect:?}");
    }
    assert!(harness.query_by_label("Compared with").is_none(), "no room for the second method");
    harness.get_by_label("Show").click();
    harness.run();
    assert!(harness.query_by_role_and_label(Role::ComboBox, "Compared with").is_some(), "it is in the menu");
    assert!(harness.query_by_label("Auto exposure").is_some(), "and so is the exposure");
    harness.snapshot("views_narrow");
}

#[test]
fn four_viewports_rest_when_nothing_changes_and_a_drag_in_one_leaves_the_others() {
    let mut harness = pane(test_scene_from_above(), vec2(900.0, 600.0));
    harness.state_mut().session.set_view_count(4);
    settle(&mut harness);
    let still = stats(&harness);
    assert!(still.iter().all(|stats| stats.composites > 0), "all are drawn: {still:?}");
    harness.run_steps(5);
    assert_eq!(stats(&harness), still, "not a pass more");

    let from = harness.get_by_label("Viewport 3").rect().center() + vec2(60.0, 60.0);
    drag(&mut harness, &[from, from + vec2(10.0, 0.0), from + vec2(30.0, 10.0)], Modifiers::ALT);
    let moved = stats(&harness);
    assert!(moved[2].g_buffers > still[2].g_buffers, "the third orbits");
    assert_eq!([moved[0], moved[1], moved[3]], [still[0], still[1], still[3]], "the others have nothing to do");
    assert_eq!(harness.state().session.views.active(), 2, "it is the active one");
    settle(&mut harness);

    let before = stats(&harness);
    harness.state_mut().session.edit("Dim", |scene| {
        let light = &mut scene.lights[0];
        light.quantity = softbox::light::Quantity::new(light.quantity.kind(), 0.5 * light.quantity.value());
    });
    harness.state_mut().session.view.refines = false;
    harness.state_mut().session.views.for_all(|view| view.refines = false);
    harness.run();
    let after = stats(&harness);
    for (before, after) in before.iter().zip(&after) {
        assert_eq!((after.layers, after.shadows), (before.layers, before.shadows), "weights alone shade nothing");
        assert!(after.composites > before.composites, "but are seen");
    }
    harness.state_mut().session.views.for_all(|view| view.refines = true);
    harness.state_mut().session.view.refines = true;
    harness.remove_cursor();
    settle(&mut harness);
    harness.snapshot("views_four");
}

#[test]
fn false_colours_have_a_bar_that_says_what_they_mean() {
    let size: Vec2 = vec2(640.0, 420.0);
    let mut harness = pane(test_scene_from_above(), size);
    for (mode, name, told) in [
        (ViewMode::Illuminance, "views_illuminance", "Scale: to "),
        (ViewMode::Difference, "views_difference", "Scale: point − exact"),
        (ViewMode::Bands, "views_bands", "Scale: point within 1, 5, 10 % of exact"),
    ] {
        harness.state_mut().session.view.set_mode(mode);
        settle(&mut harness);
        assert!(harness.query_by_label_contains(told).is_some(), "{mode:?} is told");
        harness.snapshot(name);
    }
}

#[test]
fn the_measuring_rectangle_lies_where_the_camera_looks() {
    let mut harness = pane(test_scene_from_above(), vec2(640.0, 420.0));
    harness.state_mut().session.measure.shown = true;
    settle(&mut harness);
    let session = &harness.state().session;
    let projection = Projection::new(&session.view.camera, harness.get_by_label("Viewport").rect());
    let middle = projection.project(session.measure.rectangle.center).expect("in sight");
    let grip = harness.get_by_label("Measuring rectangle, middle").rect().center();
    assert!(grip.distance(middle) < 0.5, "its middle is at {grip:?}, not {middle:?}");
}
