//! Drawing lights: every tool from its first click to the saved file, and back again.

use egui::{Event, Key, Modifiers, Pos2, Rect, vec2};
use glam::{DVec2, DVec3};
use softbox::editor::Tool;
use softbox::light::{Emitter, Light, Shape};
use softbox::scene::{self, Scene};

use super::viewport::corners;
use super::window::{Window, options};

/// A box on nothing, seen from above, which takes no time to shade.
const ROOM: &str = r#"format = 1
[camera]
eye = [1.0, -7.0, 4.5]
target = [0.0, 0.0, 1.0]
fov_deg = 40.0
[[material]]
name = "plaster"
diffuse = [0.5, 0.5, 0.5]
specular = [0.2, 0.2, 0.2]
[[surface]]
name = "box"
material = "plaster"
position = [1.2, 0.6, 0.5]
shape = { box = { size = [1.0, 1.0, 1.0] } }
"#;

impl Window {
    /// Type while the pointer is over the viewport.
    fn type_text(&mut self, text: &str) {
        self.harness.event(Event::Text(text.to_owned()));
        self.settle();
    }

    /// Type a dimension while drawing, and take it.
    fn dimension(&mut self, text: &str) {
        self.type_text(text);
        assert!(self.has("Typed dimension"), "a field opens for {text}");
        self.key(Modifiers::NONE, Key::Enter);
    }

    fn hover(&mut self, pos: Pos2) {
        self.harness.hover_at(pos);
        self.settle();
    }

    fn hover_over(&mut self, p: [f64; 3]) {
        let pos = self.at(p);
        self.hover(pos);
    }

    /// Hold keys down while something is done.
    fn holding(&mut self, modifiers: Modifiers, act: impl FnOnce(&mut Self)) {
        self.harness.event(Event::ModifiersChanged(modifiers));
        act(self);
        self.harness.event(Event::ModifiersChanged(Modifiers::NONE));
        self.settle();
    }

    /// Compare the view with a stored picture; what other panes look like is no matter here.
    fn picture(&mut self, name: &str) {
        let rect = self.get("Viewport").rect();
        self.picture_of(rect, name);
    }

    /// Compare a part of the window with a stored picture.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole points of a small window")]
    fn picture_of(&mut self, rect: Rect, name: &str) {
        let whole = self.harness.render().expect("the window is drawn");
        let [x, y, width, height] =
            [rect.left(), rect.top(), rect.width(), rect.height()].map(|points| points.round() as u32);
        let part = image::imageops::crop_imm(&whole, x, y, width, height).to_image();
        egui_kittest::image_snapshot_options(&part, name, &options());
    }

    /// Save, and read the file.
    fn saved(&mut self) -> Scene {
        self.key(Modifiers::COMMAND, Key::S);
        assert!(!self.session().history.is_modified(), "saved");
        scene::load(self.path("scene.toml")).expect("the saved file is sound")
    }

    /// Undo everything: the document is the file's again, byte for byte.
    #[track_caller]
    fn check_all_undone(&mut self, labels: &[&str]) {
        assert_eq!(self.steps_back(), labels, "one step each");
        let first = scene::parse(ROOM, "room").expect("the scene is valid");
        assert_eq!(scene::to_toml(&self.scene()), scene::to_toml(&first), "as before, byte for byte");
    }
}

#[track_caller]
fn find<'a>(scene: &'a Scene, name: &str) -> &'a Light {
    scene.lights.iter().find(|light| light.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// Each expected corner is one of the light's, and there are no others.
#[track_caller]
fn check_corners(light: &Light, expected: &[[f64; 3]], within: f64) {
    let found = corners(light);
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for corner in expected {
        let near = found.iter().any(|p| p.distance(DVec3::from(*corner)) <= within);
        assert!(near, "{corner:?} in {found:?}");
    }
}

#[test]
fn every_tool_makes_its_light_and_the_saved_file_has_it() {
    let mut window = Window::with(ROOM);
    window.key(Modifiers::NONE, Key::P);
    let polygon = [[-1.0, -0.5, 2.0], [0.2, -0.5, 2.0], [0.2, 0.3, 2.0], [-0.4, -0.1, 2.0], [-1.0, 0.3, 2.0]];
    for corner in polygon {
        window.click_at(corner);
    }
    window.click_at(polygon[0]);
    window.key(Modifiers::NONE, Key::L);
    window.click_at([-1.0, 0.8, 2.0]);
    window.click_at([0.5, 0.8, 2.0]);
    window.key(Modifiers::NONE, Key::O);
    window.drag_from_to([0.8, -0.5, 2.0], [1.1, -0.1, 2.0]);
    window.key(Modifiers::NONE, Key::T);
    window.drag_from_to([-0.8, -1.2, 2.0], [0.4, -0.8, 2.0]);
    window.menu(&["Add", "Outline", "Star"]);
    window.drag_from_to([0.8, 0.3, 2.0], [0.8, 0.8, 2.0]);
    window.menu(&["Add", "Outline", "Disk"]);
    // A click, and another one, do as well as a drag.
    window.click_at([-1.2, -1.0, 2.0]);
    window.click_at([-1.2, -0.8, 2.0]);

    // A file that is not the scene's has the name of the pattern already.
    std::fs::create_dir(window.path("scene.patterns")).expect("a folder");
    std::fs::write(window.path("scene.patterns/softbox-falloff.png"), "of somebody else").expect("a file");
    let saved = window.saved();
    assert_eq!(saved, *window.scene(), "the file holds the document");
    check_corners(find(&saved, "polygon"), &polygon, 1e-9);
    let Emitter::Line(line) = find(&saved, "line").emitter() else { panic!("a line") };
    assert!(line.a.distance(DVec3::new(-1.0, 0.8, 2.0)) < 1e-9 && (line.b.x - 0.5).abs() < 1e-9, "{line:?}");
    let Emitter::Sphere(sphere) = find(&saved, "sphere").emitter() else { panic!("a sphere") };
    assert!((sphere.radius - 0.5).abs() < 1e-9, "radius {}", sphere.radius);
    let textured = find(&saved, "textured");
    let Shape::Textured(rectangle) = &textured.shape else { panic!("a textured light") };
    assert!(rectangle.size.distance(DVec2::new(1.2, 0.4)) < 1e-9, "{}", rectangle.size);
    assert!(textured.position.distance(DVec3::new(-0.2, -1.0, 2.0)) < 1e-9, "{}", textured.position);
    assert_eq!(rectangle.pattern.file, "scene.patterns/softbox-falloff-2.png", "the next free name");
    let [width, height] = rectangle.pattern.image.channels()[0].size();
    assert!(width > 8 && height > 8, "its pattern has {width} x {height} texels");
    let star = corners(find(&saved, "star"));
    assert_eq!(star.len(), 10, "five points: {star:?}");
    assert!(star.iter().any(|p| p.distance(DVec3::new(0.8, 0.8, 2.0)) < 1e-6), "one where it was dragged to");
    let Shape::Disk(disk) = &find(&saved, "disk").shape else { panic!("a disk") };
    assert!((disk.radius - 0.2).abs() < 1e-9, "radius {}", disk.radius);
    window.check_all_undone(&["Add disk", "Add star", "Add textured", "Add sphere", "Add line", "Add polygon"]);
}

#[test]
fn dimensions_are_typed_while_drawing() {
    let mut window = Window::with(ROOM);
    window.key(Modifiers::NONE, Key::P);
    window.click_at([-1.0, -0.5, 2.0]);
    window.hover_over([0.3, -0.5, 2.0]);
    window.dimension("1.5");
    window.dimension("80 cm<90");
    window.type_text("9");
    window.key(Modifiers::NONE, Key::Escape);
    assert!(!window.has("Typed dimension"), "Esc drops what was typed");
    window.type_text("wide");
    assert!(!window.has("Typed dimension"), "no letter begins a dimension");
    window.dimension("1,5<180");
    window.key(Modifiers::NONE, Key::Enter);
    let expected = [[-1.0, -0.5, 2.0], [0.5, -0.5, 2.0], [0.5, 0.3, 2.0], [-1.0, 0.3, 2.0]];
    check_corners(&window.light("polygon"), &expected, 1e-9);

    window.key(Modifiers::NONE, Key::T);
    window.click_at([0.0, 0.0, 2.0]);
    window.hover_over([-0.4, 0.7, 2.0]);
    window.type_text("1.2y");
    window.key(Modifiers::NONE, Key::Enter);
    assert!(window.says("no dimension"), "what cannot be read is told, and can be mended");
    window.key(Modifiers::NONE, Key::Backspace);
    window.dimension("x0.8");
    let light = window.light("textured");
    let Shape::Textured(rectangle) = &light.shape else { panic!("a textured light") };
    assert!(rectangle.size.distance(DVec2::new(1.2, 0.8)) < 1e-9, "{}", rectangle.size);
    assert!(light.position.distance(DVec3::new(-0.6, 0.4, 2.0)) < 1e-9, "where is pointed to: {}", light.position);

    window.key(Modifiers::NONE, Key::O);
    window.click_at([0.4, 0.2, 2.0]);
    window.dimension(".35");
    let Shape::Sphere(sphere) = window.light("sphere").shape else { panic!("a sphere") };
    assert!((sphere.radius - 0.35).abs() < 1e-12, "radius {}", sphere.radius);
    assert_eq!(window.saved(), *window.scene(), "the file holds the document");
    window.check_all_undone(&["Add sphere", "Add textured", "Add polygon"]);
}

#[test]
fn lights_are_drawn_on_upright_planes_and_on_surfaces() {
    let mut window = Window::with(ROOM);
    window.key(Modifiers::NONE, Key::N);
    window.key(Modifiers::NONE, Key::Q);
    window.enter("Work plane Y", "1.5");
    window.drag_from_to([-1.0, 1.5, 0.5], [0.0, 1.5, 1.7]);
    let upright = window.light("rectangle");
    let expected = [[-1.0, 1.5, 0.5], [0.0, 1.5, 0.5], [0.0, 1.5, 1.7], [-1.0, 1.5, 1.7]];
    check_corners(&upright, &expected, 1e-9);
    let Emitter::Polygon(polygon) = upright.emitter() else { panic!("a polygon") };
    assert!(polygon.normal.distance(DVec3::NEG_Y) < 1e-9, "shines at the scene: {}", polygon.normal);

    window.key(Modifiers::NONE, Key::N);
    for _ in 0..3 {
        window.key(Modifiers::NONE, Key::Q);
    }
    window.click("Flip lit side");
    window.hover(Pos2::new(640.0, 130.0));
    assert!(window.says("Point at a surface"), "beside the box there is nothing to draw on");
    // The front of the box, 1 cm off which lights are put.
    window.drag_from_to([0.9, 0.1, 0.3], [1.5, 0.1, 0.7]);
    let on_box = window.light("rectangle 2");
    let Emitter::Polygon(polygon) = on_box.emitter() else { panic!("a polygon") };
    assert!(polygon.normal.distance(DVec3::Y) < 1e-9, "flipped, it shines into the box: {}", polygon.normal);
    for p in &polygon.vertices {
        assert!((p.y - 0.09).abs() < 1e-9, "off the front: {p}");
    }
    assert_eq!(window.saved(), *window.scene(), "the file holds the document");
    window.check_all_undone(&["Add rectangle", "Add rectangle"]);
}

#[test]
fn drawing_sticks_to_corners_the_grid_and_directions() {
    let mut window = Window::with(ROOM);
    window.key(Modifiers::NONE, Key::L);
    window.enter("Work plane height", "1");
    // A corner of the box's top is on that plane, and not on a grid of 7 cm.
    window.enter("Grid spacing", "0.07");
    let corner = window.at([0.7, 0.1, 1.0]) + vec2(4.0, -3.0);
    window.drag(&[corner]);
    window.holding(Modifiers::SHIFT, |window| window.click_at([-0.52, -1.08, 1.0]));
    let Emitter::Line(line) = window.light("line").emitter() else { panic!("a line") };
    assert!(line.a.distance(DVec3::new(0.7, 0.1, 1.0)) < 1e-9, "from the corner: {}", line.a);
    let along = line.b - line.a;
    assert!((along.x - along.y).abs() < 1e-9, "at 45°: {along}");
    let steps = along.length() / 0.07;
    assert!((steps - steps.round()).abs() < 1e-9, "{steps} grid steps long");

    window.key(Modifiers::NONE, Key::O);
    window.click_at([-0.99, -0.5, 1.0]);
    window.dimension("0.2");
    let on_grid = window.light("sphere").position;
    assert!(on_grid.distance(DVec3::new(-0.98, -0.49, 1.0)) < 1e-9, "on the grid: {on_grid}");
    window.key(Modifiers::NONE, Key::O);
    window.holding(Modifiers::COMMAND, |window| window.click_at([-0.3, 0.33, 1.0]));
    window.dimension("0.2");
    let free = window.light("sphere 2").position;
    assert!(free.distance(DVec3::new(-0.3, 0.33, 1.0)) < 5e-3, "Ctrl lets go of the grid: {free}");
    window.check_all_undone(&["Add sphere", "Add sphere", "Add line"]);
}

#[test]
fn a_letter_with_a_hole_is_one_light() {
    let mut window = Window::with(ROOM);
    window.menu(&["Add", "Outline", "Letter"]);
    window.key(Modifiers::NONE, Key::Q);
    window.click("Letter");
    window.type_text("r");
    window.drag_from_to([-0.5, 0.0, 1.0], [-0.5, 0.0, 1.6]);
    let light = find(&window.saved(), "letter R").clone();
    let Shape::Polygon(polygon) = &light.shape else { panic!("a polygon") };
    assert_eq!(polygon.check(), Ok(()), "a simple outline");
    let heights = corners(&light).into_iter().map(|p| p.z);
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)));
    assert!((low - 0.4).abs() < 2e-4 && (high - 1.6).abs() < 2e-4, "from {low} to {high}");
    window.check_all_undone(&["Add letter R"]);
}

#[test]
fn an_edge_that_would_cross_is_red_and_says_why() {
    let mut window = Window::with(ROOM);
    window.key(Modifiers::NONE, Key::P);
    for corner in [[-1.0, -0.5, 2.0], [0.4, -0.5, 2.0], [0.4, 0.6, 2.0]] {
        window.click_at(corner);
    }
    window.hover_over([-0.3, -1.0, 2.0]);
    assert!(window.says("would meet edge 1"), "before the click");
    window.picture("draw_crossing");
    window.click_at([-0.3, -1.0, 2.0]);
    assert!(window.says("would meet edge 1"), "and after");
    window.key(Modifiers::NONE, Key::Backspace);
    window.key(Modifiers::NONE, Key::Escape);
    assert_eq!(window.session().tool, Tool::Polygon, "cancelled, and ready for another");
    window.check_all_undone(&[]);
}

#[test]
fn the_bar_of_a_tool_shows_its_plane_and_what_it_makes() {
    let mut window = Window::with(ROOM);
    window.menu(&["Add", "Outline", "Star"]);
    window.key(Modifiers::NONE, Key::Q);
    window.click_at([0.0, 0.0, 1.2]);
    window.hover_over([0.5, 0.0, 1.6]);
    window.picture("draw_star");
    let bar = window.get("Work plane").rect();
    let bar = Rect::from_min_max(bar.min - vec2(8.0, 6.0), Pos2::new(1280.0, bar.bottom() + 6.0));
    window.picture_of(bar, "draw_bar");
    window.type_text("0.75<120");
    window.picture("draw_typed");
    window.key(Modifiers::NONE, Key::Enter);
    assert_eq!(corners(&window.light("star")).len(), 10, "five points");

    window.key(Modifiers::NONE, Key::T);
    for _ in 0..3 {
        window.key(Modifiers::NONE, Key::Q);
    }
    window.click_at([0.9, 0.1, 0.3]);
    window.hover_over([1.5, 0.1, 0.8]);
    window.picture("draw_on_surface");
    assert_eq!(window.session().tool, Tool::Textured, "still drawing");

    window.key(Modifiers::NONE, Key::Escape);
    window.menu(&["Add", "Outline", "Star"]);
    window.harness.set_size(vec2(900.0, 700.0));
    window.settle();
    for name in ["Work plane", "Flip lit side", "Outline", "Points of the star", "Grid spacing", "Snap to corners"] {
        let rect = window.get(name).rect();
        assert!(rect.right() <= 900.0, "{name} is cut off at {}", rect.right());
    }
}

/// A rectangular light seen well from above.
const PANEL: &str = r#"format = 1
[camera]
eye = [1.0, -5.0, 8.0]
target = [0.0, 0.0, 2.0]
fov_deg = 36.0
[[light]]
name = "panel"
position = [0.0, 0.0, 2.0]
luminance = 1000.0
shape = { polygon = { vertices = [[-1.0, -0.8], [1.0, -0.8], [1.0, 0.8], [-1.0, 0.8]] } }
"#;

#[test]
fn corners_and_edges_are_added_moved_and_deleted_afterwards() {
    let mut window = Window::with(PANEL);
    let first = window.scene();
    window.click_at([-0.4, -0.3, 2.0]);
    window.click_at([0.0, -0.8, 2.0]);
    assert_eq!(corners(&window.light("panel")).len(), 5, "a click in the middle of an edge adds a corner");
    window.drag_from_to([0.0, -0.8, 2.0], [0.0, -1.2, 2.0]);
    window.drag_from_to([-1.0, 0.0, 2.0], [-1.4, 0.0, 2.0]);
    window.holding(Modifiers::ALT, |window| window.click_at([-1.4, 0.4, 2.0]));
    assert_eq!(corners(&window.light("panel")).len(), 6, "and so does Alt+click anywhere on one");
    window.key(Modifiers::NONE, Key::Delete);
    window.click_at([1.0, 0.8, 2.0]);
    window.picture("draw_corner_chosen");
    window.key(Modifiers::NONE, Key::Backspace);
    assert!(!window.scene().lights.is_empty(), "keys delete the chosen corner, not the light");
    let expected = [[-1.4, -0.8, 2.0], [0.0, -1.2, 2.0], [1.0, -0.8, 2.0], [-1.4, 0.8, 2.0]];
    check_corners(&window.light("panel"), &expected, 0.02);

    // Over the far edge and beyond: the shape would cross itself.
    let before = window.scene();
    let (from, to) = (window.at([0.0, -1.2, 2.0]), window.at([0.4, 0.9, 2.0]));
    let button = |pos, pressed| {
        let (button, modifiers) = (egui::PointerButton::Primary, Modifiers::NONE);
        Event::PointerButton { pos, button, pressed, modifiers }
    };
    window.hover(from);
    window.harness.event(button(from, true));
    window.harness.step();
    window.hover(to);
    assert!(window.says("may not cross"), "it says so");
    window.picture("draw_corner_refused");
    window.harness.event(button(to, false));
    window.settle();
    assert_eq!(corners(&window.light("panel")).len(), 4, "refused");
    assert_eq!(window.scene(), before, "nothing came of what was refused");
    assert_eq!(window.saved(), *before, "the file holds the document");

    let steps = ["Delete vertex", "Delete vertex", "Add vertex", "Move edge", "Move vertex", "Add vertex"];
    assert_eq!(window.steps_back(), steps, "one step each");
    assert_eq!(scene::to_toml(&window.scene()), scene::to_toml(&first), "as before, byte for byte");
}
