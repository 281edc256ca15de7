//! A pair of axes on screen, and curves in them.

use std::sync::Arc;

use egui::epaint::TextShape;
use egui::text::{LayoutJob, TextFormat};
use egui::{Align, Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Stroke, Ui, Visuals, pos2, vec2};

use super::curve::{Drawn, place};
use crate::analysis::axis::Axis;

/// Room for the ordinate's numbers and name, points.
const LEFT: f32 = 58.0;
/// Room beside the last number of the abscissa, points.
const RIGHT: f32 = 14.0;
/// Room above, for half a number, points.
const TOP: f32 = 5.0;
/// Room for the abscissa's numbers and name, points.
const BELOW: f32 = 32.0;
/// Size of numbers and names, points.
const TEXT: f32 = 11.0;
/// Size of what is raised, points.
const RAISED: f32 = 8.0;
/// Points between labels of the abscissa and of the ordinate, at least.
const APART: [f32; 2] = [62.0, 26.0];

/// A pair of axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Where curves are.
    pub(super) rect: Rect,
    pub(super) x: Axis,
    pub(super) y: Axis,
}

/// Where the curves are within `whole`, beside the numbers; those of the abscissa are optional.
pub(super) fn inner(whole: Rect, numbers_below: bool) -> Rect {
    let below = if numbers_below { BELOW } else { TOP };
    let corner = (whole.right_bottom() - vec2(RIGHT, below)).max(whole.min + vec2(LEFT + 20.0, TOP + 12.0));
    Rect::from_min_max(whole.min + vec2(LEFT, TOP), corner)
}

/// The sides of a frame in the order of an abscissa's and of an ordinate's axis.
pub(super) fn sides(rect: Rect) -> [[f64; 2]; 2] {
    [[rect.left(), rect.right()], [rect.bottom(), rect.top()]].map(|sides| sides.map(f64::from))
}

/// About how many labels there is room for along an axis of that length, the abscissa's or the ordinate's.
pub(super) fn labels(length: f32, ordinate: bool) -> f64 {
    f64::from(length / APART[usize::from(ordinate)]).clamp(2.0, 10.0)
}

impl Frame {
    /// Ground, grid lines and numbers.
    pub(super) fn grid(&self, painter: &Painter, visuals: &Visuals, numbers_below: bool) {
        let (rect, line) = (self.rect, Stroke::new(1.0, grid_color(visuals)));
        painter.rect_filled(rect, 2.0, visuals.extreme_bg_color);
        let color = visuals.weak_text_color();
        for tick in self.x.ticks(labels(rect.width(), false)) {
            let Some(x) = self.x.at(tick.value).map(|x| place([x, 0.0]).x) else { continue };
            painter.line_segment([pos2(x, rect.top()), pos2(x, rect.bottom())], line);
            if numbers_below {
                text(&tick.label, pos2(x, rect.bottom() + 3.0), Align2::CENTER_TOP, color, painter);
            }
        }
        for tick in self.y.ticks(labels(rect.height(), true)) {
            let Some(y) = self.y.at(tick.value).map(|y| place([0.0, y]).y) else { continue };
            let zero = if tick.value.abs() > 0.0 { line } else { Stroke::new(1.0, visuals.weak_text_color()) };
            painter.line_segment([pos2(rect.left(), y), pos2(rect.right(), y)], zero);
            text(&tick.label, pos2(rect.left() - 5.0, y), Align2::RIGHT_CENTER, color, painter);
        }
    }

    /// The names of the axes.
    pub(super) fn names(&self, painter: &Painter, visuals: &Visuals, below: Option<&str>, beside: &str, left: f32) {
        let galley = painter.layout_no_wrap(beside.to_owned(), FontId::proportional(TEXT), visuals.text_color());
        let at = pos2(left, self.rect.center().y + 0.5 * galley.size().x);
        let turned = TextShape::new(at, galley, visuals.text_color()).with_angle(-std::f32::consts::FRAC_PI_2);
        painter.add(turned);
        if let Some(below) = below {
            let at = pos2(self.rect.center().x, self.rect.bottom() + 17.0);
            text(below, at, Align2::CENTER_TOP, visuals.text_color(), painter);
        }
    }

    /// A curve through the values `y`, with its band where that is of these.
    pub(super) fn curve(&self, drawn: &Drawn<'_>, y: &[f64], band: Option<&[f64]>, ui: &Ui) {
        let painter = ui.painter().with_clip_rect(self.rect.expand(1.0).intersect(ui.clip_rect()));
        let x = drawn.trace.x;
        if let Some(band) = band {
            let edges = x
                .iter()
                .zip(y)
                .zip(band)
                .filter_map(|((x, y), band)| Some([self.place(*x, y - band)?, self.place(*x, y + band)?]));
            drawn.band(&edges.collect::<Vec<_>>(), &painter, ui.visuals());
        }
        let mut piece: Vec<Pos2> = Vec::new();
        let places = x.iter().zip(y).map(|(x, y)| self.place(*x, *y));
        for at in places.chain([None]) {
            match at {
                Some(at) => piece.push(at),
                None if piece.len() > 1 => drawn.line(&std::mem::take(&mut piece), &painter, ui.visuals()),
                None => piece.clear(),
            }
        }
    }

    /// Where a point of a curve lies; what is far outside is brought near.
    fn place(&self, x: f64, y: f64) -> Option<Pos2> {
        let near = f64::from(4.0 * self.rect.height());
        let at = self.y.at(y).filter(|y| y.is_finite())?;
        let y = at.clamp(f64::from(self.rect.top()) - near, f64::from(self.rect.bottom()) + near);
        Some(place([self.x.at(x)?, y]))
    }

    /// A line through the abscissa under the pointer.
    pub(super) fn cursor(&self, x: f64, painter: &Painter, visuals: &Visuals) {
        let Some(x) = self.x.at(x).map(|x| place([x, 0.0]).x) else { return };
        let ends = [pos2(x, self.rect.top()), pos2(x, self.rect.bottom())];
        painter.line_segment(ends, Stroke::new(1.0, visuals.text_color()));
    }
}

/// The colour of grid lines.
pub(super) fn grid_color(visuals: &Visuals) -> Color32 {
    visuals.weak_text_color().gamma_multiply(0.3)
}

/// Small text, its `anchor` at `pos`; what follows `^` is raised.
pub(super) fn text(text: &str, pos: Pos2, anchor: Align2, color: Color32, painter: &Painter) {
    let galley = raised(text, color, painter);
    let rect = anchor.anchor_size(pos, galley.size());
    painter.galley(rect.min, galley, color);
}

fn raised(text: &str, color: Color32, painter: &Painter) -> Arc<Galley> {
    let (base, power) = text.split_once('^').unwrap_or((text, ""));
    let mut job = LayoutJob::default();
    job.append(base, 0.0, TextFormat::simple(FontId::proportional(TEXT), color));
    if !power.is_empty() {
        let format = TextFormat { valign: Align::TOP, ..TextFormat::simple(FontId::proportional(RAISED), color) };
        job.append(power, 0.0, format);
    }
    painter.layout_job(job)
}
