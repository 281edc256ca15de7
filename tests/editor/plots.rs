//! Curves: read, pinned, exported, and worked out aside.

use std::path::Path;

use egui::{Key, Modifiers, MouseWheelSource, MouseWheelUnit, PointerButton, Pos2, TouchPhase, vec2};
use egui_kittest::kittest::Queryable;
use softbox::editor::app::App;

use crate::window::Window;

/// A light of a pattern so fine that its reference curve takes minutes, and nothing that is lit.
const SLOW: &str = "format = 1\n[[material]]\nname = \"plaster\"\ndiffuse = [0.5, 0.5, 0.5]\nspecular = [0.2, 0.2, 0.2]\n\
                    [[light]]\nname = \"leaves\"\nposition = [0.0, 0.0, 1.0]\nluminance = 1000.0\n\
                    shape = { textured = { size = [1.0, 1.0], pattern = \"noise.png\" } }\n";

/// The curves of the plot in front.
const CURVES: &str = "Curves of tilt under the window";

fn hover(window: &mut Window, at: Pos2) {
    window.harness.hover_at(at);
    window.settle();
}

/// The abscissa that is read at a share of the width of the plot in front.
fn read(window: &mut Window, share: f32) -> Option<f64> {
    let rect = window.get(CURVES).rect();
    hover(window, rect.left_top() + rect.size() * vec2(share, 0.5));
    window.session().plots.cursor
}

#[test]
fn values_are_read_at_the_pointer_and_the_wheel_zooms_until_a_double_click() {
    let mut window = Window::with_scene();
    assert_eq!(window.session().plots.cursor, None, "nothing is pointed at");
    let whole = read(&mut window, 0.5).expect("an abscissa");
    assert!(whole.abs() < 20.0, "{whole} is near the middle of ±90°");
    assert!(window.says("At ") && window.says("°") && window.says("value (lx)"), "place and values are told");
    let before = read(&mut window, 0.8).expect("an abscissa");
    let at = window.get(CURVES).rect().center();
    hover(&mut window, at);
    window.harness.event(egui::Event::MouseWheel {
        unit: MouseWheelUnit::Point,
        delta: vec2(0.0, 200.0),
        source: MouseWheelSource::Wheel,
        phase: TouchPhase::Move,
        modifiers: Modifiers::NONE,
    });
    window.settle();
    let zoomed = read(&mut window, 0.8).expect("an abscissa");
    assert!(zoomed < 0.8 * before, "{zoomed} is nearer to the middle than {before}");
    let rect = window.get(CURVES).rect();
    for _ in 0..2 {
        for pressed in [true, false] {
            let (pos, button, modifiers) = (rect.center(), PointerButton::Primary, Modifiers::NONE);
            window.harness.event(egui::Event::PointerButton { pos, button, pressed, modifiers });
        }
    }
    window.settle();
    let reset = read(&mut window, 0.8).expect("an abscissa");
    assert!((reset - before).abs() < 0.5, "{reset} is {before} again");
}

/// Pin, change the scene, pin another, rename, compare, write files, and take the pins away.
#[test]
fn a_pinned_curve_stays_while_the_scene_changes_and_leaves_with_the_export() {
    let mut window = Window::with_scene();
    window.click("window");
    window.click("Pin");
    let pinned = window.session().plots.pins.clone();
    assert_eq!(pinned.len(), 1, "pinned");
    assert_eq!(pinned[0].pin.name, "before: window 2×1 m", "called after what is selected");
    window.enter("Flux", "9000");
    assert_eq!(window.session().plots.pins, pinned, "it stays as it was");
    window.click("Pin one-shot");
    assert!(window.session().plots.pins[1].pin.name.ends_with("(one-shot)"), "a method's curve");
    window.enter("Name of pin 2", "one-shot, more flux");
    assert_eq!(window.session().plots.pins[1].pin.name, "one-shot, more flux", "renamed");
    window.click("Show chebyshev");
    let at = window.get(CURVES).rect().center() - vec2(60.0, 0.0);
    hover(&mut window, at);
    assert!(window.says("\u{2212} exact"), "values are read");
    window.harness.snapshot("plots_pinned");

    for (format, start) in [("CSV…", &b"# Softbox"[..]), ("SVG…", b"<svg"), ("PNG…", b"\x89PNG")] {
        let path = window.path(&format!("plot {}", &format[..3]));
        window.choose(Some(&path));
        window.click("Export plot");
        window.click(format);
        let path = path.with_extension(format[..3].to_lowercase());
        let bytes = std::fs::read(&path).expect("the plot is written");
        assert!(bytes.starts_with(start), "{format}");
        let text = String::from_utf8_lossy(&bytes);
        if format != "PNG…" {
            assert!(text.contains("before: window") && text.contains("one-shot, more flux"), "{format} has the pins");
            assert!(text.contains("nearest-point") && !text.contains("chebyshev"), "{format} has what is shown");
        }
        assert!(window.says(&format!("Exported {}", path.display())), "told so");
    }
    window.click("Remove pin 1");
    let left: Vec<_> = window.session().plots.pins.iter().map(|pinned| pinned.pin.name.as_str()).collect();
    assert_eq!(left, ["one-shot, more flux"], "the other is left");
    window.click("Show pin 1");
    assert!(window.session().plots.pins[0].hidden, "hidden");
    assert_eq!(window.steps_back(), ["Change flux"], "pins are no part of the document");
}

#[test]
fn a_plot_of_angles_can_be_polar_and_errors_logarithmic() {
    let mut window = Window::with_scene();
    window.click("polar");
    window.click("log");
    window.click("Axes");
    window.click("Errors in %");
    window.click("Logarithmic errors");
    let plot = window.scene().plots[0].clone();
    let look = window.session().plots.look(&plot);
    assert!(look.polar && look.logarithmic && look.relative_error && look.logarithmic_error, "{look:?}");
    window.key(Modifiers::NONE, Key::Escape);
    window.click("log");
    // To the right of the pole, and above it.
    let rect = window.get(CURVES).rect();
    hover(&mut window, rect.center() + vec2(30.0, 0.0));
    let angle = window.session().plots.cursor.expect("an angle");
    assert!(angle > 5.0 && angle < 80.0, "{angle} is to the right of the zenith");
    window.harness.snapshot("plots_polar");
    window.click("Axes");
    window.click("Normalise");
    assert_eq!(window.steps_back(), ["Change plot"], "only what belongs to the plot is a step");
    window.harness.get_all_by_label("distance").last().expect("the tab").click();
    window.settle();
    assert!(!window.session().plots.look(&window.scene().plots[1]).polar, "a distance is no angle");
}

/// Write a picture of noise.
fn noise(path: &Path, side: u32) {
    let mut state = 1_u32;
    let texels = (0..side * side).map(|_| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        state.to_be_bytes()[0]
    });
    let picture = image::GrayImage::from_raw(side, side, texels.collect()).expect("all texels");
    picture.save(path).expect("the pattern is written");
}

fn finished(app: &App) -> (u64, u64) {
    let work = app.plot_work();
    (work.asked, work.finished)
}

/// A hundred frames are shown while one curve is at work: none waits for it. The next request does not wait either.
#[test]
fn a_slow_curve_holds_no_frame_and_is_given_up_when_it_is_not_wanted_any_more() {
    let mut window = Window::new();
    noise(&window.path("noise.png"), 512);
    let path = window.path("slow.toml");
    std::fs::write(&path, SLOW).expect("the scene is written");
    window.choose(Some(&path));
    window.key(Modifiers::COMMAND, Key::O);
    let before = finished(window.harness.state());
    window.harness.get_by_label("New plot").click();
    window.harness.run_steps(3);
    window.harness.query_all_by_label("tilt").last().expect("the menu").click();
    window.harness.run_steps(100);
    let app = window.harness.state();
    assert!(
        app.busy_with().is_some() && finished(app) == (before.0 + 1, before.1),
        "the reference is not done: {before:?}"
    );
    assert!(
        window.has("Curves of tilt") && window.has_any("…"),
        "what is done is shown, and what is not is waited for"
    );
    for flux in ["100", "200", "300"] {
        window.harness.state_mut().session.edit("Change flux", |scene| {
            let value = flux.parse().expect("a number");
            scene.lights[0].quantity = softbox::light::Quantity::new(softbox::light::QuantityKind::Flux, value);
        });
        window.harness.run_steps(2);
    }
    assert_eq!(finished(window.harness.state()), (before.0 + 4, before.1), "each overtakes the one before");
    window.harness.state_mut().session.edit("Mute", |scene| scene.lights[0].muted = true);
    window.harness.run_steps(1);
    window.settle();
    assert_eq!(finished(window.harness.state()), (before.0 + 5, before.1 + 1), "only the last is finished");
    assert!(!window.has_any("…"), "all of it");
}
