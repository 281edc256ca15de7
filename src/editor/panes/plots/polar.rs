//! Curves about a pole on screen.

use egui::{Align2, Painter, Pos2, Rect, Stroke, Ui, Visuals, vec2};

use super::curve::{Drawn, place};
use super::frame::{grid_color, text};
use crate::analysis::{DIAL_MARGIN, Dial};

/// Room around the rings' numbers, so that grid lines do not cross them, points.
const PLATE: f32 = 1.5;
/// About how many rings there are.
pub(super) const RINGS: f64 = 5.0;

/// Ground, rings with their values, and rays with their angles.
pub(super) fn grid(dial: &Dial, rect: Rect, painter: &Painter, visuals: &Visuals) {
    painter.rect_filled(rect, 2.0, visuals.extreme_bg_color);
    let line = Stroke::new(1.0, grid_color(visuals));
    let rings: Vec<_> =
        dial.axis.ticks(RINGS).into_iter().filter_map(|tick| Some((dial.axis.at(tick.value)?, tick.label))).collect();
    for (radius, _) in rings.iter().filter(|(radius, _)| *radius > 0.0) {
        let (first, last) = if dial.half { (-90, 90) } else { (-180, 180) };
        let arc = (first..=last).step_by(3).map(|angle| place(dial.place(f64::from(angle), *radius))).collect();
        painter.line(arc, line);
    }
    for angle in dial.marks() {
        let [end, label] = [dial.radius(), dial.radius() + 0.6 * DIAL_MARGIN].map(|at| place(dial.place(angle, at)));
        painter.line_segment([place(dial.pole), end], line);
        let number = format!("{angle}°").replace('-', "\u{2212}");
        text(&number, label, Align2::CENTER_CENTER, visuals.weak_text_color(), painter);
    }
    for (radius, label) in rings.iter().filter(|(radius, _)| *radius > 0.0) {
        let at = place(dial.place(0.0, *radius)) + vec2(4.0, 1.0);
        let plate = Rect::from_min_size(at, vec2(6.0 * label.chars().count() as f32, 12.0)).expand(PLATE);
        painter.rect_filled(plate, 2.0, visuals.extreme_bg_color.gamma_multiply(0.8));
        text(label, at, Align2::LEFT_TOP, visuals.weak_text_color(), painter);
    }
}

/// A curve and its band.
pub(super) fn curve(dial: &Dial, drawn: &Drawn<'_>, ui: &Ui) {
    let trace = &drawn.trace;
    if let Some(band) = trace.band {
        let edge = |sign: f64| trace.y.iter().zip(band).map(|(y, band)| y + sign * band).collect::<Vec<_>>();
        let [high, low] = [1.0, -1.0].map(|sign| dial.pieces(trace.x, &edge(sign)));
        for (high, low) in high.into_iter().zip(low) {
            let edges: Vec<_> = low.into_iter().zip(high).map(|(low, high)| [low, high].map(place)).collect();
            drawn.band(&edges, ui.painter(), ui.visuals());
        }
    }
    for piece in dial.pieces(trace.x, trace.y) {
        let places: Vec<Pos2> = piece.into_iter().map(place).collect();
        drawn.line(&places, ui.painter(), ui.visuals());
    }
}

/// A ray at the angle under the pointer.
pub(super) fn cursor(dial: &Dial, angle: f64, painter: &Painter, visuals: &Visuals) {
    let ends = [dial.pole, dial.place(angle, dial.radius())].map(place);
    painter.line_segment(ends, Stroke::new(1.0, visuals.text_color()));
}
