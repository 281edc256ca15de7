//! Drawing, dragging, selecting and looking in the viewport.

use std::time::Duration;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use egui_kittest::kittest::Queryable;
use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
use egui_kittest::{Harness, HarnessBuilder};
use glam::DVec3;
use softbox::editor::session::Framing;
use softbox::editor::viewport::Viewport;
use softbox::editor::viewport::picture::{Haste, Picture};
use softbox::editor::viewport::projection::Projection;
use softbox::editor::{Item, Session, Tool, theme};
use softbox::gpu::{Display, SharedPasses, View};
use softbox::light::{Emitter, Light};
use softbox::scene::{Camera, Scene, parse};
use softbox::shading::Method;

use super::window::{SCENE, Window, options};

impl Window {
    /// Where a point of the world is in the window.
    #[track_caller]
    pub(crate) fn at(&self, p: [f64; 3]) -> Pos2 {
        let rect = self.get("Viewport").rect();
        let projection = Projection::new(&self.session().view.camera, rect);
        projection.project(DVec3::from(p)).expect("the point is in sight")
    }

    /// Click at a point of the world.
    #[track_caller]
    pub(crate) fn click_at(&mut self, p: [f64; 3]) {
        let pos = self.at(p);
        self.drag(&[pos]);
    }

    /// Drag from a point of the world to another.
    #[track_caller]
    pub(crate) fn drag_from_to(&mut self, from: [f64; 3], to: [f64; 3]) {
        let (from, to) = (self.at(from), self.at(to));
        self.drag(&[from, from.lerp(to, 0.3), from.lerp(to, 0.7), to]);
    }

    pub(crate) fn light(&self, name: &str) -> Light {
        self.scene().lights.iter().find(|light| light.name == name).expect("the light is there").clone()
    }
}

/// The corners of a polygon in the world.
pub(crate) fn corners(light: &Light) -> Vec<DVec3> {
    match light.emitter() {
        Emitter::Polygon(polygon) => polygon.vertices,
        other => panic!("{other:?} is no polygon"),
    }
}

#[track_caller]
pub(crate) fn assert_near(p: DVec3, expected: [f64; 3], within: f64) {
    assert!(p.distance(DVec3::from(expected)) <= within, "{p} is not {expected:?}");
}

/// Corners of a rectangle on the default work plane, in front of the test scene.
const DRAWN: [[f64; 3]; 4] = [[-0.8, -1.0, 2.0], [0.8, -1.0, 2.0], [0.8, 1.0, 2.0], [-0.8, 1.0, 2.0]];

#[test]
fn a_polygon_is_drawn_by_clicks_and_undone_in_one_step() {
    let mut window = Window::with_scene();
    let before = window.scene();
    window.key(Modifiers::NONE, Key::P);
    for corner in DRAWN {
        window.click_at(corner);
    }
    window.key(Modifiers::NONE, Key::Enter);

    let light = window.light("polygon");
    assert_near(light.position, [0.0, 0.0, 2.0], 1e-12);
    assert_eq!(light.strength(), 1000.0, "its luminance");
    let found = corners(&light);
    assert_eq!(found.len(), DRAWN.len(), "{found:?}");
    for corner in DRAWN {
        assert!(found.iter().any(|p| p.distance(DVec3::from(corner)) < 1e-9), "{corner:?} of {found:?}");
    }
    assert_eq!(window.session().tool, Tool::Move, "back to selecting");
    assert_eq!(window.selected(), Some((Item::Light(3), "polygon".to_owned())), "selected");
    window.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.scene(), before, "undone");
}

#[test]
fn a_click_on_the_first_corner_closes_and_selects_the_new_light() {
    let mut window = Window::new();
    window.key(Modifiers::NONE, Key::P);
    for corner in DRAWN {
        window.click_at(corner);
    }
    let count = window.scene().lights.len();
    window.click_at(DRAWN[0]);
    assert_eq!(window.scene().lights.len(), count + 1, "one more light");
    assert_eq!(window.selected().map(|(item, _)| item), Some(Item::Light(count)), "selected");
}

#[test]
fn a_crossing_corner_is_refused_and_backspace_takes_one_back() {
    let mut window = Window::with_scene();
    window.key(Modifiers::NONE, Key::P);
    for corner in &DRAWN[..3] {
        window.click_at(*corner);
    }
    window.click_at([0.0, -1.2, 2.0]);
    assert!(window.says("may not cross"), "the reason is given");
    window.key(Modifiers::NONE, Key::Backspace);
    window.click_at(DRAWN[3]);
    window.key(Modifiers::NONE, Key::Enter);
    let found = corners(&window.light("polygon"));
    assert_eq!(found.len(), 3, "two corners and the last one: {found:?}");
}

#[test]
fn escape_forgets_what_is_drawn_then_puts_the_tool_away() {
    let mut window = Window::with_scene();
    window.key(Modifiers::NONE, Key::P);
    window.click_at(DRAWN[0]);
    window.click_at(DRAWN[1]);
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().tool, Tool::Polygon, "still drawing");
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().tool, Tool::Move, "put away");
    assert_eq!(window.steps_back(), Vec::<String>::new(), "nothing was changed");
}

#[test]
fn a_line_takes_two_clicks_and_a_sphere_a_drag() {
    let mut window = Window::new();
    window.key(Modifiers::NONE, Key::L);
    window.click_at([-1.0, 0.5, 2.0]);
    window.click_at([0.5, 0.5, 2.0]);
    let Emitter::Line(line) = window.light("line").emitter() else { panic!("a line") };
    assert_near(line.a, [-1.0, 0.5, 2.0], 1e-9);
    assert_near(line.b, [0.5, 0.5, 2.0], 1e-9);

    window.key(Modifiers::NONE, Key::O);
    window.drag_from_to([0.0, -0.5, 2.0], [0.4, -0.5, 2.0]);
    let Emitter::Sphere(sphere) = window.light("sphere").emitter() else { panic!("a sphere") };
    assert_near(sphere.center, [0.0, -0.5, 2.0], 1e-9);
    assert!((sphere.radius - 0.4).abs() < 1e-9, "radius {}", sphere.radius);
    assert_eq!(window.steps_back(), ["Add sphere", "Add line"], "one step each");
}

#[test]
fn a_click_selects_what_is_seen_there_and_beside_everything_nothing() {
    let mut window = Window::with_scene();
    for (at, name) in [
        ([0.3, -0.1, 2.5], "window"),
        ([-1.5, 0.6, 1.0], "strip"),
        ([1.5, 0.35, 1.1], "globe"),
        ([0.1, -0.4, 0.6], "ball"),
        ([0.4, -1.9, 0.0], "floor"),
    ] {
        window.click_at(at);
        assert_eq!(window.selected().map(|(_, name)| name).as_deref(), Some(name), "at {at:?}");
    }
    window.click_at([18.0, 60.0, 3.0]);
    assert_eq!(window.selected(), None, "the sky");
}

#[test]
fn a_vertex_is_dragged_in_one_step_and_never_across_an_edge() {
    let mut window = Window::with_scene();
    // The test scene's own camera sees that light edge-on.
    window.harness.state_mut().session.view.camera.eye = DVec3::new(0.0, -5.0, 5.5);
    window.settle();
    window.click_at([0.0, -0.3, 2.5]);
    let before = window.light("window");
    window.drag_from_to([1.0, 0.5, 2.5], [1.3, 0.9, 2.5]);
    let after = corners(&window.light("window"));
    let nearest = after.iter().map(|p| p.distance(DVec3::new(1.3, 0.9, 2.5))).fold(f64::MAX, f64::min);
    assert!(nearest < 0.02, "the vertex follows the pointer: {after:?}");
    assert_eq!(window.session().history.undo_label(), Some("Move vertex"), "the step");
    window.key(Modifiers::COMMAND, Key::Z);
    assert_eq!(window.light("window"), before, "undone in one step");

    let (from, to) = (window.at([1.0, 0.5, 2.5]), window.at([-1.4, -0.1, 2.5]));
    window.drag(&[from, to, to]);
    assert_eq!(window.light("window"), before, "a crossing shape is refused");
    assert_eq!(window.session().history.undo_label(), None, "and is no step");
}

#[test]
fn a_light_is_moved_by_its_arrow_and_escape_takes_it_back() {
    let mut window = Window::with_scene();
    window.click_at([1.5, 0.35, 1.1]);
    let before = window.light("globe");
    // The arrows are as long as 84 points at the light's depth.
    let reach = {
        let rect = window.get("Viewport").rect();
        60.0 * Projection::new(&window.session().view.camera, rect).metres_per_point(before.position)
    };
    let up = |by: f64| (before.position + DVec3::new(0.0, 0.0, by)).to_array();
    window.drag_from_to(up(reach), up(reach + 0.5));
    let moved = window.light("globe").position - before.position;
    assert_near(moved, [0.0, 0.0, 0.5], 0.02);
    assert_eq!((moved.x, moved.y), (0.0, 0.0), "along Z only");
    window.key(Modifiers::COMMAND, Key::Z);

    let (from, to) = (window.at(up(reach)), window.at(up(reach + 0.5)));
    window.harness.hover_at(from);
    window.harness.step();
    press(&window.harness, from, true, Modifiers::NONE);
    window.harness.step();
    window.harness.hover_at(to);
    window.harness.step();
    assert_ne!(window.light("globe"), before, "it follows");
    window.harness.key_press(Key::Escape);
    window.harness.step();
    assert_eq!(window.light("globe"), before, "aborted");
    window.harness.hover_at(from);
    window.harness.step();
    press(&window.harness, from, false, Modifiers::NONE);
    window.settle();
    assert_eq!(window.light("globe"), before, "and it stays so until the button is released");
    assert_eq!(window.session().history.undo_label(), None, "no step");
}

#[test]
fn the_probe_of_the_plot_in_front_is_dragged_over_the_surfaces() {
    let mut window = Window::with_scene();
    window.drag_from_to([0.5, 0.0, 0.0], [0.0, -0.5, 0.5]);
    let plot = window.scene().plots[0].clone();
    assert!((plot.position.distance(DVec3::new(0.0, 0.0, 0.5)) - 0.5).abs() < 1e-6, "on the ball: {}", plot.position);
    assert!(plot.normal.dot(DVec3::NEG_Y) > 0.99, "with the ball's normal: {}", plot.normal);
    assert_eq!(window.steps_back(), ["Move probe"], "one step");
}

#[test]
fn the_method_is_chosen_in_the_viewports_corner() {
    let mut window = Window::with_scene();
    window.click_role(Role::ComboBox, "Method");
    window.click("point");
    assert_eq!(window.session().view.method, Method::Point, "the viewport's method");
    assert!(!window.session().history.is_modified(), "the document has no part in it");
}

#[test]
fn the_view_is_orbited_panned_and_zoomed_without_touching_the_document() {
    let mut window = Window::with_scene();
    let camera = |window: &Window| window.session().view.camera;
    let from = window.at([-0.9, -1.0, 0.0]);
    let start = camera(&window);

    drag_with(&mut window, from, vec2(60.0, 20.0), PointerButton::Primary, Modifiers::ALT);
    let orbited = camera(&window);
    assert_eq!(orbited.target, start.target, "an orbit keeps the target");
    assert!(orbited.eye.distance(start.eye) > 0.5, "and moves the eye");

    drag_with(&mut window, from, vec2(60.0, 20.0), PointerButton::Middle, Modifiers::SHIFT);
    let panned = camera(&window);
    let (eye, target) = (panned.eye - orbited.eye, panned.target - orbited.target);
    assert!(eye.distance(target) < 1e-9 && eye.length() > 0.1, "a pan moves both alike: {eye} {target}");

    window.harness.hover_at(from);
    window.harness.event(Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, 3.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    window.settle();
    let zoomed = camera(&window);
    let ratio = zoomed.eye.distance(zoomed.target) / panned.eye.distance(panned.target);
    assert!(ratio < 0.95, "the wheel zooms in: {ratio}");
    assert!(!window.session().history.is_modified(), "the document is as it was");
}

pub(crate) fn press<S>(harness: &Harness<'_, S>, pos: Pos2, pressed: bool, modifiers: Modifiers) {
    harness.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
}

fn drag_with(window: &mut Window, from: Pos2, by: Vec2, button: PointerButton, modifiers: Modifiers) {
    let harness = &mut window.harness;
    let click = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    harness.hover_at(from);
    harness.event(Event::ModifiersChanged(modifiers));
    harness.event(click(from, true));
    harness.event(Event::PointerMoved(from + 0.5 * by));
    harness.event(Event::PointerMoved(from + by));
    harness.event(click(from + by, false));
    harness.event(Event::ModifiersChanged(Modifiers::NONE));
    // A frame an event.
    harness.step();
    window.settle();
}

/// A viewport alone in a window.
pub(crate) struct Pane {
    pub(crate) viewport: Viewport,
    pub(crate) session: Session,
}

pub(crate) fn pane(scene: Scene, size: Vec2) -> Harness<'static, Pane> {
    let render_state = create_render_state(default_wgpu_setup(), egui_wgpu_options());
    let mut viewport = Viewport::new(&render_state);
    viewport.set_frame_budget(Duration::MAX);
    let renderer = WgpuTestRenderer::from_render_state(render_state);
    let builder: HarnessBuilder<Pane> =
        Harness::builder().with_size(size).with_options(options()).with_max_steps(1024).renderer(renderer);
    builder.build_ui_state(
        |ui, pane: &mut Pane| {
            theme::install(ui.ctx());
            pane.viewport.show(ui, &mut pane.session);
        },
        Pane { viewport, session: Session::new(scene, None) },
    )
}

fn egui_wgpu_options() -> eframe::egui_wgpu::RendererOptions {
    eframe::egui_wgpu::RendererOptions::PREDICTABLE
}

pub(crate) fn test_scene() -> Scene {
    parse(SCENE, "test scene").expect("the scene is valid")
}

/// The test scene from further up, so that its lights are seen from above.
pub(crate) fn test_scene_from_above() -> Scene {
    let camera = Camera { eye: DVec3::new(3.5, -6.0, 5.5), target: DVec3::new(0.0, 0.0, 1.2), fov_deg: 40.0 };
    Scene { camera, ..test_scene() }
}

#[test]
fn while_a_light_is_dragged_only_its_layer_is_redone() {
    let mut harness = pane(test_scene(), vec2(400.0, 300.0));
    harness.state_mut().session.selection.set([Item::Light(2)]);
    harness.run();
    let globe = harness.state().session.scene().lights[2].position;
    let camera = harness.state().session.view.camera;
    let projection = Projection::new(&camera, harness.get_by_label("Viewport").rect());
    let up = |points: f64| {
        let by = points * projection.metres_per_point(globe);
        projection.project(globe + DVec3::new(0.0, 0.0, by)).expect("in sight")
    };
    harness.hover_at(up(60.0));
    harness.step();
    press(&harness, up(60.0), true, Modifiers::NONE);
    harness.step();
    harness.hover_at(up(75.0));
    harness.step();
    let before = harness.state().viewport.stats();
    for points in [80.0, 85.0, 90.0] {
        harness.hover_at(up(points));
        harness.step();
    }
    let after = harness.state().viewport.stats();
    assert_eq!(after.g_buffers - before.g_buffers, 0, "what the camera sees is the same");
    assert_eq!(after.layers - before.layers, 3, "one layer a frame, of three lights");
    assert_eq!(after.composites - before.composites, 3, "one sum a frame");
}

#[test]
fn where_a_picture_takes_long_a_rough_one_is_there_at_once_and_goes_when_the_other_is_done() {
    let render_state = create_render_state(default_wgpu_setup(), egui_wgpu_options());
    let mut picture = Picture::new(&render_state, &SharedPasses::new(&render_state.device));
    let scene = test_scene();
    let view = View {
        camera: scene.camera,
        size: [400, 300],
        method: Method::Exact,
        exposure_ev: 0.0,
        show_emitters: true,
        shadows: true,
        refine: false,
        display: Display::Picture,
    };
    let mut draw = |budget, is_new| {
        picture.set_frame_budget(budget);
        picture.render([&scene, &scene], &view, Haste::Acting, is_new);
        (picture.texture().map(|(_, size)| size), picture.is_rough(), picture.is_behind(), picture.stats())
    };
    let (size, is_rough, is_behind, stats) = draw(Duration::from_micros(1), true);
    assert_eq!((size, is_rough, is_behind), (Some([400, 300]), true, true), "a rough picture at once");
    assert_eq!((stats.layers, stats.shadows, stats.composites), (3, 3, 1), "with soft shadows, and nothing else done");
    let (_, is_rough, is_behind, after) = draw(Duration::MAX, false);
    assert_eq!((is_rough, is_behind), (false, false), "all pixels when there is time");
    assert_eq!(after.composites, 2, "the rough picture is not drawn again");
}

#[test]
fn nothing_is_drawn_when_nothing_changes() {
    let mut harness = pane(test_scene(), vec2(400.0, 300.0));
    harness.run();
    let still = harness.state().viewport.stats();
    harness.run_steps(5);
    assert_eq!(harness.state().viewport.stats(), still, "not a pass more");
    harness.state_mut().session.view.method = Method::Point;
    harness.run();
    assert_ne!(harness.state().viewport.stats(), still, "until something does");
}

#[test]
fn an_empty_scene_and_a_pane_without_room_are_shown_too() {
    for size in [vec2(400.0, 300.0), vec2(3.0, 300.0), vec2(20.0, 20.0)] {
        let mut harness = pane(Scene::default(), size);
        for tool in Tool::ALL {
            harness.state_mut().session.tool = tool;
            harness.state_mut().session.framing = Some(Framing::All);
            let middle = (0.5 * size).to_pos2();
            harness.hover_at(middle);
            press(&harness, middle, true, Modifiers::NONE);
            press(&harness, middle, false, Modifiers::NONE);
            harness.run();
        }
        assert!(!harness.state().session.history.is_modified(), "{size}");
    }
}

#[test]
fn a_selected_light_has_its_outline_handles_and_direction() {
    let mut harness = pane(test_scene_from_above(), vec2(640.0, 420.0));
    harness.state_mut().session.selection.set([Item::Light(0)]);
    harness.run();
    harness.snapshot("viewport_selected");
}

#[test]
fn a_selected_light_shows_the_spots_of_its_fit() {
    let mut harness = pane(test_scene(), vec2(420.0, 300.0));
    harness.state_mut().session.selection.set([Item::Light(0)]);
    harness.state_mut().session.view.method = Method::Fit(8);
    harness.run();
    harness.snapshot("viewport_fit");
}

#[test]
fn a_polygon_in_the_making_shows_its_grid_and_dimensions() {
    let mut harness = pane(test_scene_from_above(), vec2(640.0, 420.0));
    harness.state_mut().session.tool = Tool::Polygon;
    harness.run();
    let projection = Projection::new(&harness.state().session.view.camera, harness.get_by_label("Viewport").rect());
    let at = |p: [f64; 3]| projection.project(DVec3::from(p)).expect("in sight");
    for corner in &DRAWN[..3] {
        harness.hover_at(at(*corner));
        harness.step();
        press(&harness, at(*corner), true, Modifiers::NONE);
        harness.step();
        press(&harness, at(*corner), false, Modifiers::NONE);
        harness.step();
    }
    harness.hover_at(at([-0.6, 0.6, 2.0]));
    harness.run();
    harness.snapshot("viewport_drawing");
}
