//! A pair of axes on screen, and curves in them.

use std::sync::Arc;

use egui::epaint::TextShape;
use egui::text::{LayoutJob, TextFormat};
use egui::{
    Align, Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Sense, Ui, UiBuilder, Vec2, Visuals, pos2, vec2,
};
use egui_plot::{GridMark, HLine, Plot, PlotBounds, PlotUi, VLine};

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
/// How far curves reach over the frame, so that those along its sides are as wide as others, points.
const OVERLAP: f32 = 1.0;
/// Curves are followed that many times the height above and below the frame.
const NEAR: f64 = 4.0;

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
    /// Ground and numbers.
    pub(super) fn ground(&self, painter: &Painter, visuals: &Visuals, numbers_below: bool) {
        let rect = self.rect;
        painter.rect_filled(rect, 2.0, visuals.extreme_bg_color);
        let color = visuals.weak_text_color();
        for tick in self.x.ticks(labels(rect.width(), false)).into_iter().filter(|_| numbers_below) {
            let Some(x) = self.x.at(tick.value).map(|x| place([x, 0.0]).x) else { continue };
            text(&tick.label, pos2(x, rect.bottom() + 3.0), Align2::CENTER_TOP, color, painter);
        }
        for tick in self.y.ticks(labels(rect.height(), true)) {
            let Some(y) = self.y.at(tick.value).map(|y| place([0.0, y]).y) else { continue };
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

    /// Grid lines, what `draw` adds, and a line through the abscissa under the pointer. Its coordinates are the axes'
    /// [own](Axis::coordinate), and it is still: these are steered elsewhere. `id` is unique within `ui`.
    pub(super) fn plot<'a>(&self, ui: &mut Ui, id: &str, cursor: Option<f64>, draw: impl FnOnce(&mut PlotUi<'a>) + 'a) {
        let Self { rect, x, y } = *self;
        let [grid, zero, line] = [grid_color(ui.visuals()), ui.visuals().weak_text_color(), ui.visuals().text_color()];
        let [columns, rows] = [labels(rect.width(), false), labels(rect.height(), true)];
        let [[left, right], [bottom, top]] = [ends(&x, rect.width()), ends(&y, rect.height())];
        let mut inside = ui.new_child(UiBuilder::new().max_rect(rect.expand(OVERLAP)));
        let plot =
            Plot::new(id).min_size(Vec2::ZERO).show_background(false).show_axes(false).show_x(false).show_y(false);
        let still = plot.sense(Sense::hover()).allow_drag(false).allow_zoom(false).allow_scroll(false);
        let still = still.allow_axis_zoom_drag(false).allow_boxed_zoom(false).allow_double_click_reset(false);
        let ruled = still.grid_color(grid).grid_fade(0.0);
        let ruled = ruled.x_grid_spacer(move |_| marks(&x, columns)).y_grid_spacer(move |_| marks(&y, rows));
        ruled.show(&mut inside, move |plot| {
            plot.set_plot_bounds(PlotBounds::from_min_max([left, bottom], [right, top]));
            if y.at(0.0).is_some() {
                plot.hline(HLine::new("zero", 0.0).color(zero));
            }
            draw(plot);
            if let Some(at) = cursor {
                plot.vline(VLine::new("cursor", x.coordinate(at)).color(line));
            }
        });
    }

    /// A curve through the values `y`, with its band where that is of these.
    pub(super) fn curve(
        &self,
        drawn: &Drawn<'_>,
        y: &[f64],
        band: Option<&[f64]>,
        visuals: &Visuals,
        plot: &mut PlotUi<'_>,
    ) {
        let x = drawn.trace.x;
        if let Some(band) = band {
            let edges = x
                .iter()
                .zip(y)
                .zip(band)
                .filter_map(|((x, y), band)| Some([self.point(*x, y - band)?, self.point(*x, y + band)?]));
            plot.add(drawn.area(&edges.collect::<Vec<_>>(), visuals));
        }
        let mut piece: Vec<[f64; 2]> = Vec::new();
        let points = x.iter().zip(y).map(|(x, y)| self.point(*x, *y));
        for point in points.chain([None]) {
            match point {
                Some(point) => piece.push(point),
                None if piece.len() > 1 => plot.add(drawn.curve(std::mem::take(&mut piece), visuals)),
                None => piece.clear(),
            }
        }
    }

    /// The coordinates of a point of a curve; what is far outside is brought near.
    fn point(&self, x: f64, y: f64) -> Option<[f64; 2]> {
        let [low, high] = self.y.span.map(|end| self.y.coordinate(end));
        let near = NEAR * (high - low);
        let [x, y] = [self.x.coordinate(x), self.y.coordinate(y)];
        (x.is_finite() && y.is_finite()).then(|| [x, y.clamp(low - near, high + near)])
    }
}

/// The coordinates at the ends of an axis of that length, with the overlap.
fn ends(axis: &Axis, length: f32) -> [f64; 2] {
    let [low, high] = axis.span.map(|end| axis.coordinate(end));
    let overlap = (high - low) * f64::from(OVERLAP / length);
    [low - overlap, high + overlap]
}

/// Grid lines, all alike, at about `count` labels.
fn marks(axis: &Axis, count: f64) -> Vec<GridMark> {
    let marks = axis.ticks(count).into_iter().map(|tick| axis.coordinate(tick.value));
    marks.map(|value| GridMark { value, step_size: f64::INFINITY }).collect()
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
