//! Handles, aiming and placing, and the probe, as a designer uses them.

use egui::{Event, Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec3;
use softbox::editor::handles::frame::{Axes, Pivot};
use softbox::editor::handles::place::Place;
use softbox::editor::viewport::projection::Projection;
use softbox::editor::{Item, Tool};
use softbox::light::Light;

use super::viewport::{Pane, assert_near, pane, press, test_scene_from_above};
use super::window::Window;

/// Length of the handles, screen points.
const REACH: f64 = 70.0;

impl Window {
    /// Click with keys held.
    fn click_holding(&mut self, p: [f64; 3], modifiers: Modifiers) {
        let pos = self.at(p);
        self.harness.hover_at(pos);
        self.harness.event(Event::ModifiersChanged(modifiers));
        self.harness.step();
        press(&self.harness, pos, true, modifiers);
        self.harness.step();
        press(&self.harness, pos, false, modifiers);
        self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
        self.settle();
    }

    /// Take hold at `from` and move to `to`, a frame each; the button stays down.
    fn hold_and_move(&mut self, from: Pos2, to: Pos2) {
        self.harness.hover_at(from);
        self.harness.step();
        press(&self.harness, from, true, Modifiers::NONE);
        self.harness.step();
        for share in [0.3, 0.7, 1.0] {
            self.harness.hover_at(from.lerp(to, share));
            self.harness.step();
        }
    }

    fn let_go(&mut self, pos: Pos2) {
        press(&self.harness, pos, false, Modifiers::NONE);
        self.settle();
    }

    fn type_amount(&mut self, text: &str) {
        self.harness.event(Event::Text(text.to_owned()));
        self.harness.step();
    }

    /// So far from `p` along `direction` as a handle there reaches on screen.
    fn handle_at(&self, p: DVec3, direction: DVec3) -> Pos2 {
        let rect = self.get("Viewport").rect();
        let projection = Projection::new(&self.session().view.camera, rect);
        projection.project(p + REACH * projection.metres_per_point(p) * direction).expect("in sight")
    }

    fn status_line(&self) -> String {
        self.session().hint.clone()
    }
}

/// The direction in which a light shines.
fn shines(light: &Light) -> DVec3 {
    -light.world_from_light().matrix3.z_axis
}

#[test]
fn several_lights_are_moved_and_turned_together_in_one_step_each() {
    let mut window = Window::with_scene();
    let before = window.scene();
    let [strip, globe] = ["strip", "globe"].map(|name| window.light(name).position);
    window.click_at([-1.5, 0.6, 1.0]);
    window.click_holding([1.5, 0.35, 1.1], Modifiers::SHIFT);
    assert_eq!(window.session().selection.items(), [Item::Light(1), Item::Light(2)], "both are selected");

    // The number typed is the amount, whatever the mouse does.
    let up = window.handle_at(globe, DVec3::Z);
    window.hold_and_move(up, up - vec2(0.0, 33.0));
    assert!(window.status_line().contains("type a number"), "the status line says so: {}", window.status_line());
    window.type_amount("0.25");
    window.harness.key_press(Key::Enter);
    window.settle();
    window.let_go(up - vec2(0.0, 33.0));
    assert_eq!(window.light("globe").position, globe + DVec3::new(0.0, 0.0, 0.25), "moved");
    assert_eq!(window.light("strip").position, strip + DVec3::new(0.0, 0.0, 0.25), "and the other with it");

    // About the middle of both.
    window.key(Modifiers::NONE, Key::E);
    window.key(Modifiers::NONE, Key::Period);
    assert_eq!(window.session().transform.pivot, Pivot::Center, "the next pivot");
    let middle = window.light("globe").position.midpoint(window.light("strip").position);
    let front = window.handle_at(middle, 84.0 / REACH * DVec3::NEG_Y);
    window.hold_and_move(front, front + vec2(20.0, 0.0));
    window.type_amount("180");
    window.let_go(front + vec2(20.0, 0.0));
    assert_near(window.light("globe").position, (strip + DVec3::new(0.0, 0.0, 0.25)).to_array(), 1e-5);
    assert_eq!(window.steps_back(), ["Rotate", "Move"], "one step each");
    assert_eq!(window.scene(), before, "and back to the start");
}

#[test]
fn a_drag_snaps_with_ctrl_is_fine_with_shift_and_cancelled_byte_for_byte_by_escape() {
    let mut window = Window::with_scene();
    let before = window.scene();
    window.click_at([1.5, 0.35, 1.1]);
    let globe = window.light("globe").position;
    let tip = window.handle_at(globe, DVec3::X);
    window.hold_and_move(tip, tip + vec2(40.0, 0.0));
    let free = window.light("globe").position.x - globe.x;
    assert!(free > 0.1, "it follows: {free}");
    window.harness.event(Event::ModifiersChanged(Modifiers::COMMAND));
    window.harness.step();
    let snapped = window.light("globe").position.x * 10.0;
    assert!((snapped - snapped.round()).abs() < 1e-9, "on the grid: {snapped} tenths");
    window.harness.event(Event::ModifiersChanged(Modifiers::SHIFT));
    window.harness.hover_at(tip + vec2(80.0, 0.0));
    window.harness.step();
    let fine = window.light("globe").position.x - globe.x;
    assert!((fine / free - 1.1).abs() < 0.02, "a tenth as fast: {fine} after {free}");
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    window.harness.key_press(Key::Escape);
    window.harness.step();
    window.let_go(tip + vec2(80.0, 0.0));
    assert_eq!(window.scene(), before, "as it was");
    assert_eq!(window.session().history.undo_label(), None, "no step");
    assert_eq!(window.selected().map(|(item, _)| item), Some(Item::Light(2)), "still selected");
}

#[test]
fn axes_and_pivot_are_switched_by_key_and_in_the_toolbar() {
    let mut window = Window::with_scene();
    assert!(window.has("World axes"), "the toolbar shows the axes");
    window.key(Modifiers::NONE, Key::X);
    assert_eq!(window.session().transform.axes, Axes::Local, "by key");
    window.click("Local axes");
    assert_eq!(window.session().transform.axes, Axes::World, "by mouse");
    window.click("Pivot");
    window.click("Each its own");
    assert_eq!(window.session().transform.pivot, Pivot::Own, "from the menu");

    // The strip's own X is the world's Y.
    window.key(Modifiers::NONE, Key::X);
    window.click_at([-1.5, 0.6, 1.0]);
    let strip = window.light("strip").position;
    let tip = window.handle_at(strip, DVec3::NEG_X);
    let own_y = window.handle_at(strip, 1.2 * DVec3::NEG_X);
    window.hold_and_move(tip, own_y);
    window.type_amount("0.5");
    window.let_go(own_y);
    assert_near(window.light("strip").position, (strip - DVec3::new(0.5, 0.0, 0.0)).to_array(), 1e-5);
}

#[test]
fn a_light_is_aimed_at_a_point_and_follows_the_drag() {
    let mut window = Window::with_scene();
    window.key(Modifiers::SHIFT, Key::A);
    assert_eq!(window.session().tool, Tool::Aim, "the tool");
    window.click_at([0.3, -0.1, 2.5]);
    assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some("window"), "a click selects a light first");
    let before = window.light("window");
    let (from, to) = (window.at([-0.9, -1.0, 0.0]), window.at([0.9, -1.2, 0.0]));
    window.hold_and_move(from, to);
    let aimed = window.light("window");
    assert!(shines(&aimed).distance((DVec3::new(0.9, -1.2, 0.0) - aimed.position).normalize()) < 1e-3, "it follows");
    window.let_go(to);
    assert_eq!(aimed.position, before.position, "from where it is");
    assert_eq!(window.session().tool, Tool::Aim, "the tool stays in hand");
    window.hold_and_move(to, from);
    window.harness.key_press(Key::Escape);
    window.harness.step();
    assert_eq!(window.light("window"), aimed, "Esc takes a drag back");
    window.let_go(from);
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().tool, Tool::Move, "and then puts the tool away");
    assert_eq!(window.steps_back(), ["Aim"], "one step");
}

#[test]
fn a_light_is_placed_by_where_its_highlight_its_diffuse_peak_and_its_rim_shall_be() {
    let mut window = Window::with_scene();
    window.click_at([1.5, 0.35, 1.1]);
    let before = window.light("globe");
    let (center, eye) = (DVec3::new(0.0, 0.0, 0.5), window.session().view.camera.eye);
    let n = DVec3::new(0.4, -0.8, 0.45).normalize();
    let p = center + 0.5 * n;
    let distance = before.position.distance(p);
    let v = (eye - p).normalize();

    window.key(Modifiers::SHIFT, Key::H);
    assert!(window.says("highlight of “globe”"), "the status line says what a press does: {}", window.status_line());
    window.click_at(p.to_array());
    let mirror = 2.0 * n.dot(v) * n - v;
    assert_near(window.light("globe").position, (p + distance * mirror).to_array(), 0.01);

    window.key(Modifiers::SHIFT, Key::D);
    window.click_at(p.to_array());
    assert_near(window.light("globe").position, (p + distance * n).to_array(), 0.01);

    // Where the line of sight meets the ball at 15°, on the right.
    let out = (DVec3::X - DVec3::X.dot(v) * v).normalize();
    let (sin, cos) = 15.0_f64.to_radians().sin_cos();
    let edge = center + 0.5 * (sin * v + cos * out);
    window.key(Modifiers::SHIFT, Key::R);
    window.click_at(edge.to_array());
    let to_light = (window.light("globe").position - edge).normalize();
    assert!(to_light.dot(v) < -0.8 && to_light.dot(out) > 0.3, "from behind, beside the ball: {to_light}");

    // A distance typed while the button is down.
    window.key(Modifiers::SHIFT, Key::D);
    let pos = window.at(p.to_array());
    window.hold_and_move(pos, pos);
    window.type_amount("1.5");
    window.let_go(pos);
    assert!((window.light("globe").position.distance(p) - 1.5).abs() < 0.01, "at the distance typed");
    let steps = window.steps_back();
    assert_eq!(steps, ["Diffuse peak here", "Rim here", "Diffuse peak here", "Highlight here"], "one step each");
    assert_eq!(window.light("globe"), before, "back to the start");
}

#[test]
fn the_probe_and_its_normal_are_dragged_in_one_step_each() {
    let mut window = Window::with_scene();
    let start = DVec3::new(0.5, 0.0, 0.0);
    // Its normal's arrow is 40 points long.
    let tip = window.handle_at(start, 40.0 / REACH * DVec3::Z);
    window.hold_and_move(tip, tip + vec2(25.0, 8.0));
    window.let_go(tip + vec2(25.0, 8.0));
    let normal = window.scene().plots[0].normal;
    assert!(normal.x > 0.3 && (normal.length() - 1.0).abs() < 1e-5, "it follows: {normal}");
    assert_eq!(window.scene().plots[0].position, start, "the probe stays");

    let (from, to) = (window.at(start.to_array()), window.at([0.0, -0.5, 0.5]));
    window.harness.event(Event::ModifiersChanged(Modifiers::COMMAND));
    window.hold_and_move(from, to);
    let kept = window.scene().plots[0].clone();
    assert!((kept.position.distance(DVec3::new(0.0, 0.0, 0.5)) - 0.5).abs() < 1e-5, "on the ball: {}", kept.position);
    assert_eq!(kept.normal, normal, "Ctrl keeps its normal");
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
    window.harness.step();
    window.let_go(to);
    let moved = window.scene().plots[0].normal;
    assert!(moved.dot(DVec3::NEG_Y) > 0.99, "else it takes that of the ball: {moved}");
    assert_eq!(window.steps_back(), ["Move probe", "Turn probe"], "one step each");
}

/// What is held down while the picture is taken.
fn held(harness: &mut Harness<'_, Pane>, from: Pos2, to: Pos2) {
    harness.hover_at(from);
    harness.step();
    press(harness, from, true, Modifiers::NONE);
    harness.step();
    harness.hover_at(from.lerp(to, 0.5));
    harness.step();
    harness.hover_at(to);
    harness.run();
}

fn on_screen(harness: &Harness<'_, Pane>, p: DVec3) -> Pos2 {
    let camera = harness.state().session.view.camera;
    Projection::new(&camera, harness.get_by_label("Viewport").rect()).project(p).expect("in sight")
}

#[test]
fn a_placed_highlight_shows_where_it_is_and_how_far_the_light() {
    let mut harness = pane(test_scene_from_above(), vec2(640.0, 420.0));
    harness.state_mut().session.selection.set([Item::Light(2)]);
    harness.state_mut().session.tool = Tool::Place(Place::Highlight);
    harness.run();
    let to = on_screen(&harness, DVec3::new(0.1, -0.3, 0.9));
    held(&mut harness, to - vec2(20.0, 0.0), to);
    harness.snapshot("handles_place");
}
