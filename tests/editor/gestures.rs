//! Whatever a user does, nothing panics, and undo leads back to the start.

use std::sync::Arc;

use egui::{Event, Key, Modifiers, PointerButton, Pos2, Rect, pos2, vec2};
use softbox::editor::commands::{Category, Command};
use softbox::scene;

use egui_kittest::kittest::Queryable;

use crate::window::Window;

/// How many things are done.
const GESTURES: usize = 300;

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
    match dice.below(12) {
        0..=2 => click(window, dice.within(canvas), PointerButton::Primary, dice.modifiers(), 1),
        3 => click(window, dice.within(canvas), PointerButton::Primary, Modifiers::NONE, 2),
        4..=6 => drag(window, canvas, dice),
        7 => {
            let (modifiers, key) = KEYS[dice.below(KEYS.len())];
            window.harness.key_press_modifiers(modifiers, key);
            window.harness.step();
        }
        8 => command(window, dice),
        9 => {
            let pos = dice.within(canvas);
            window.harness.hover_at(pos);
            let delta = vec2(0.0, 120.0 * dice.share() - 60.0);
            let (unit, phase) = (egui::MouseWheelUnit::Point, egui::TouchPhase::Move);
            window.harness.event(Event::MouseWheel {
                unit,
                delta,
                phase,
                source: egui::MouseWheelSource::Wheel,
                modifiers: Modifiers::NONE,
            });
            window.harness.step();
        }
        10 => number(window, dice),
        _ => {
            let pos = dice.within(canvas);
            click(window, pos, PointerButton::Secondary, Modifiers::NONE, 1);
            let chosen = pos + vec2(20.0 + 60.0 * dice.share(), 200.0 * dice.share());
            click(window, chosen, PointerButton::Primary, Modifiers::NONE, 1);
        }
    }
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

/// A drag within `canvas`, some taken back by Esc.
fn drag(window: &mut Window, canvas: Rect, dice: &mut Dice) {
    let modifiers = dice.modifiers();
    let from = dice.within(canvas);
    let to = dice.within(canvas);
    window.harness.event(Event::ModifiersChanged(modifiers));
    window.harness.hover_at(from);
    window.harness.step();
    button(window, from, PointerButton::Primary, true, modifiers);
    for step in 1..=4_u8 {
        window.harness.hover_at(from.lerp(to, f32::from(step) / 4.0));
        window.harness.step();
    }
    if dice.below(5) == 0 {
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
        .collect();
    let chosen = commands[dice.below(commands.len())].clone();
    let ctx = window.harness.ctx.clone();
    chosen.run(window.harness.state_mut(), &ctx);
    window.harness.step();
}

/// Click somewhere among the numbers, and type one.
fn number(window: &mut Window, dice: &mut Dice) {
    let pos = dice.within(Rect::from_min_max(pos2(1080.0, 90.0), pos2(1268.0, 640.0)));
    click(window, pos, PointerButton::Primary, Modifiers::NONE, 1);
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
    assert!(changes > GESTURES / 12, "only {changes} gestures changed anything");
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
