//! Whatever a user does, nothing panics, and undo leads back to the start.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use softbox::editor::Item;
use softbox::editor::commands::{Category, Command};
use softbox::editor::viewport::projection::Projection;
use softbox::light::{Emitter, Light};
use softbox::scene;

use egui_kittest::kittest::Queryable;

use crate::window::Window;

/// How many things are done.
const GESTURES: usize = 300;
/// So many lights are enough; then all goes, and it begins anew.
const MOST_LIGHTS: usize = 8;

/// Keys of tools and edits; typed numbers come from the digits.
const KEYS: &[(Modifiers, Key)] = &[
    (Modifiers::NONE, Key::W),
    (Modifiers::NONE, Key::E),
    (Modifiers::NONE, Key::R),
    (Modifiers::NONE, Key::P),
    (Modifiers::NONE, Key::L),
    (Modifiers::NONE, Key::O),
    (Modifiers::NONE, Key::T),
    (Modifiers::NONE, Key::N),
    (Modifiers::NONE, Key::Q),
    (Modifiers::NONE, Key::F),
    (Modifiers::NONE, Key::A),
    (Modifiers::NONE, Key::X),
    (Modifiers::NONE, Key::Period),
    (Modifiers::NONE, Key::G),
    (Modifiers::NONE, Key::Enter),
    (Modifiers::NONE, Key::Backspace),
    (Modifiers::NONE, Key::Escape),
    (Modifiers::NONE, Key::Tab),
    (Modifiers::NONE, Key::Delete),
    (Modifiers::SHIFT, Key::A),
    (Modifiers::SHIFT, Key::H),
    (Modifiers::SHIFT, Key::R),
    (Modifiers::COMMAND, Key::D),
    (Modifiers::COMMAND, Key::A),
    (Modifiers::COMMAND, Key::M),
    (Modifiers::COMMAND, Key::Z),
    (Modifiers::COMMAND, Key::Z),
    (Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z),
];

/// A generator of numbers that are the same in each run: SplitMix64.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % count as u64).expect("below a usize")
    }

    /// From 0 to 1.
    fn share(&mut self) -> f32 {
        self.below(10_000) as f32 / 10_000.0
    }

    fn within(&mut self, rect: Rect) -> Pos2 {
        pos2(rect.left() + self.share() * rect.width(), rect.top() + self.share() * rect.height())
    }

    fn modifiers(&mut self) -> Modifiers {
        let some = [Modifiers::SHIFT, Modifiers::COMMAND, Modifiers::ALT];
        some.get(self.below(9)).copied().unwrap_or(Modifiers::NONE)
    }
}

/// Something that a user does.
fn gesture(window: &mut Window, dice: &mut Dice) {
    let canvas = window.harness.query_all_by_label("Viewport").next().map(|node| node.rect());
    let canvas = canvas.unwrap_or(Rect::from_min_size(pos2(300.0, 150.0), vec2(400.0, 250.0)));
    match dice.below(16) {
        0..=2 if window.scene().lights.len() < MOST_LIGHTS => draw(window, canvas, dice),
        0..=2 => press(window, &[(Modifiers::COMMAND, Key::A), (Modifiers::NONE, Key::Delete)]),
        3..=6 => pull(window, canvas, dice),
        7..=9 => number(window, dice),
        10 | 11 => command(window, dice),
        12 => {
            let key = KEYS[dice.below(KEYS.len())];
            press(window, &[key]);
        }
        13 => {
            let times = 1 + dice.below(2);
            click(window, dice.within(canvas), PointerButton::Primary, dice.modifiers(), times);
        }
        14 => {
            window.harness.hover_at(dice.within(canvas));
            let delta = vec2(0.0, 120.0 * dice.share() - 60.0);
            let (unit, phase) = (egui::MouseWheelUnit::Point, egui::TouchPhase::Move);
            let source = egui::MouseWheelSource::Wheel;
            window.harness.event(Event::MouseWheel { unit, delta, phase, source, modifiers: Modifiers::NONE });
            window.harness.step();
        }
        _ => {
            let pos = dice.within(canvas);
            click(window, pos, PointerButton::Secondary, Modifiers::NONE, 1);
            let chosen = pos + vec2(20.0 + 60.0 * dice.share(), 200.0 * dice.share());
            click(window, chosen, PointerButton::Primary, Modifiers::NONE, 1);
        }
    }
}

fn press(window: &mut Window, keys: &[(Modifiers, Key)]) {
    for (modifiers, key) in keys {
        window.harness.key_press_modifiers(*modifiers, *key);
        window.harness.step();
    }
}

/// A new light: a drawing tool, and a drag.
fn draw(window: &mut Window, canvas: Rect, dice: &mut Dice) {
    press(window, &[(Modifiers::NONE, [Key::L, Key::O, Key::T, Key::N][dice.below(4)])]);
    let (from, to) = (dice.within(canvas), dice.within(canvas));
    drag(window, from, to, dice);
}

/// Take hold of something in the scene and drag it: of the middle or a corner of a light, or of a surface.
fn pull(window: &mut Window, canvas: Rect, dice: &mut Dice) {
    let tool = [Key::W, Key::W, Key::E, Key::R][dice.below(4)];
    press(window, &[(Modifiers::NONE, Key::Escape), (Modifiers::NONE, tool)]);
    let scene = window.scene();
    let projection = Projection::new(&window.session().view.camera, canvas);
    let things = scene.lights.len() + scene.surfaces.len();
    if things == 0 {
        return;
    }
    let which = dice.below(things);
    let (item, place) = match scene.lights.get(which) {
        Some(light) => (Item::Light(which), light.position),
        None => {
            let index = which - scene.lights.len();
            (Item::Surface(index), scene.surfaces[index].position)
        }
    };
    // As a click in the list would do.
    window.harness.state_mut().session.selection.set([item]);
    window.harness.step();
    let grip = match scene.lights.get(which).map(Light::emitter) {
        Some(Emitter::Polygon(polygon)) if dice.below(2) == 0 => polygon.vertices[dice.below(polygon.vertices.len())],
        Some(Emitter::Line(line)) if dice.below(2) == 0 => line.b,
        _ => place,
    };
    let from = projection.project(grip).filter(|pos| canvas.contains(*pos));
    let (from, to) = (from.unwrap_or_else(|| dice.within(canvas)), dice.within(canvas));
    drag(window, from, to, dice);
}

fn button(window: &mut Window, pos: Pos2, button: PointerButton, pressed: bool, modifiers: Modifiers) {
    window.harness.event(Event::PointerButton { pos, button, pressed, modifiers });
    window.harness.step();
}

fn click(window: &mut Window, pos: Pos2, which: PointerButton, modifiers: Modifiers, times: usize) {
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.hover_at(pos);
    window.harness.step();
    for _ in 0..times {
        button(window, pos, which, true, modifiers);
        button(window, pos, which, false, modifiers);
    }
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
}

/// A drag, some taken back by Esc.
fn drag(window: &mut Window, from: Pos2, to: Pos2, dice: &mut Dice) {
    let modifiers = dice.modifiers();
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.hover_at(from);
    window.harness.step();
    button(window, from, PointerButton::Primary, true, modifiers);
    for step in 1..=2_u8 {
        window.harness.hover_at(from.lerp(to, f32::from(step) / 2.0));
        window.harness.step();
    }
    if dice.below(8) == 0 {
        window.harness.key_press(Key::Escape);
        window.harness.step();
    }
    button(window, to, PointerButton::Primary, false, modifiers);
    window.harness.event(Event::ModifiersChanged(Modifiers::NONE));
}

/// Any command that does not leave the document.
fn command(window: &mut Window, dice: &mut Dice) {
    let commands: Vec<Command> = Command::all(window.session())
        .into_iter()
        .filter(|command| command.category() != Category::File && command.enabled(window.session()))
        .filter(|command| !matches!(command, Command::Library | Command::Palette | Command::Keys | Command::FirstSteps))
        .filter(|command| command.category() != Category::View || dice.below(4) == 0)
        .collect();
    let chosen = commands[dice.below(commands.len())].clone();
    let ctx = window.harness.ctx.clone();
    chosen.run(window.harness.state_mut(), &ctx);
    window.harness.step();
}

/// Type a number into a field: one of the list or of the inspector.
fn number(window: &mut Window, dice: &mut Dice) {
    let is_there = |rect: &Rect| (rect.left() < 290.0 || rect.left() > 990.0) && rect.top() > 90.0;
    let fields = window.harness.query_all_by_role(Role::SpinButton).map(|node| node.rect());
    let fields: Vec<Rect> = fields.filter(|rect| is_there(rect) && rect.bottom() < 770.0).collect();
    let Some(field) = fields.get(dice.below(fields.len().max(1))) else { return };
    click(window, field.center(), PointerButton::Primary, Modifiers::NONE, 1);
    window.harness.key_press_modifiers(Modifiers::COMMAND, Key::A);
    let text = ["0", "1", "-0.5", "2.75", "90", "1e3", "nonsense", ""][dice.below(8)];
    window.harness.event(Event::Text(text.to_owned()));
    window.harness.step();
    window.harness.key_press(Key::Enter);
    window.harness.step();
}

#[test]
fn three_hundred_random_gestures_never_panic_and_undo_to_the_start_byte_for_byte() {
    let mut window = Window::with_scene();
    window.harness.state_mut().session.view.show_shadows = false;
    let start = scene::to_toml(&window.scene());
    let mut dice = Dice(2);
    let mut changes = 0;
    for _ in 0..GESTURES {
        let before = window.scene();
        gesture(&mut window, &mut dice);
        changes += usize::from(!Arc::ptr_eq(&before, &window.scene()));
    }
    // Whatever is under way comes to an end.
    for _ in 0..3 {
        window.harness.key_press(Key::Escape);
        window.harness.step();
    }
    let session = &mut window.harness.state_mut().session;
    session.commit();
    let end = scene::to_toml(session.scene());
    println!("{changes} of {GESTURES} gestures changed something");
    assert!(changes > GESTURES / 4, "only {changes} gestures changed anything");
    while session.history.undo_label().is_some() {
        session.undo();
    }
    assert_eq!(scene::to_toml(session.scene()), start, "back to the start");
    while session.history.redo_label().is_some() {
        session.redo();
    }
    assert_eq!(scene::to_toml(session.scene()), end, "and forth to the end");
    window.harness.step();
}
