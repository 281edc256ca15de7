//! Curves and their errors: side by side where there is a pole, else one above the other on a common abscissa.

use egui::{Rect, Response, Role, Sense, Ui, WidgetInfo, pos2, vec2};

use super::axes::{Axes, Part};
use super::curve::Drawn;
use super::frame::{self, Frame, inner, labels, sides};
use super::polar;
use crate::analysis::{Dial, Look, Trace, turns};
use crate::scene::Plot;

/// The errors' share of the height.
const ERROR_SHARE: f32 = 0.38;
/// A polar plot's share of the width.
const POLAR_SHARE: f32 = 0.6;
/// What the mouse does.
const HINT: &str = "Drag pans, the wheel zooms, beside an axis only that one; a double-click shows all";

/// What is drawn.
pub(super) struct Chart<'a> {
    pub(super) plot: &'a Plot,
    /// In drawing order.
    pub(super) drawn: &'a [Drawn<'a>],
    pub(super) look: Look,
    pub(super) labels: [&'a str; 2],
    pub(super) logarithmic_x: bool,
    /// No more curves are to come.
    pub(super) complete: bool,
}

impl Chart<'_> {
    /// Draw it in the rest of `ui`; the abscissa under the pointer, and what the mouse would do.
    pub(super) fn show(&self, ui: &mut Ui, axes: &mut Axes) -> (Option<f64>, Option<&'static str>) {
        let whole = ui.available_rect_before_wrap();
        axes.follow(self.plot, self.look, self.labels);
        let is_polar = self.look.polar && turns(self.plot.kind);
        let (upper, lower) = if is_polar {
            whole.split_left_right_at_fraction(POLAR_SHARE)
        } else {
            whole.split_top_bottom_at_fraction(1.0 - ERROR_SHARE)
        };
        let [values, errors] = [(upper, "Curves"), (lower, "Errors")].map(|(rect, part)| self.sense(ui, rect, part));
        let settled = self.complete && !ui.input(|input| input.pointer.any_down());
        let error_axes = self.error_axes(axes, inner(lower, true), settled);
        let traces: Vec<Trace<'_>> = self.drawn.iter().map(|drawn| drawn.trace).collect();
        let wanted = self.look.value_span(&traces);
        let cursor = if is_polar {
            let range = self.plot.range;
            let edges = [upper.left(), upper.right(), upper.bottom(), upper.top()].map(f64::from);
            let (pole, radius, half) = Dial::fitted(edges, range);
            let axis = axes.y(Part::Values, wanted, [0.0, radius], polar::RINGS, settled);
            let dial = Dial { pole, axis, half };
            let cursor = self.angle_at(&values, &dial).or_else(|| self.abscissa_at(&errors, &error_axes));
            self.draw_polar(ui, upper, &dial, cursor);
            axes.steer_radius(ui, &values, &axis);
            cursor
        } else {
            let rect = inner(upper, false);
            let [x_sides, y_sides] = sides(rect);
            let x = axes.x(self.plot, self.logarithmic_x, x_sides);
            let y = axes.y(Part::Values, wanted, y_sides, labels(rect.height(), true), settled);
            let frame = Frame { rect, x, y };
            let cursor = self.abscissa_at(&values, &frame).or_else(|| self.abscissa_at(&errors, &error_axes));
            self.draw_values(ui, &frame, upper.left(), cursor);
            axes.steer(ui, &values, Part::Values, rect, &x, &y);
            cursor
        };
        self.draw_errors(ui, &error_axes, lower.left(), cursor);
        axes.steer(ui, &errors, Part::Errors, error_axes.rect, &error_axes.x, &error_axes.y);
        let hint = (values.hovered() || errors.hovered()).then_some(HINT);
        (cursor, hint)
    }

    /// A part of the pane that the mouse acts on.
    fn sense(&self, ui: &Ui, rect: Rect, part: &str) -> Response {
        let name = format!("{part} of {}", self.plot.name);
        let response = ui.interact(rect, ui.scope_id().with(part), Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Figure, true, &name));
        response
    }

    fn error_axes(&self, axes: &mut Axes, rect: Rect, settled: bool) -> Frame {
        let traces: Vec<Trace<'_>> = self.drawn.iter().map(|drawn| drawn.trace).collect();
        let [x_sides, y_sides] = sides(rect);
        let x = axes.x(self.plot, self.logarithmic_x, x_sides);
        let wanted = self.look.error_span(&traces);
        let y = axes.y(Part::Errors, wanted, y_sides, labels(rect.height(), true), settled);
        Frame { rect, x, y }
    }

    /// The abscissa under the pointer, within the plot's range.
    fn abscissa_at(&self, response: &Response, frame: &Frame) -> Option<f64> {
        let at = response.hover_pos().filter(|at| frame.rect.contains(*at))?;
        let x = frame.x.value_at(f64::from(at.x));
        Some(x).filter(|x| (self.plot.range[0]..=self.plot.range[1]).contains(x))
    }

    /// The angle under the pointer, within the plot's range.
    fn angle_at(&self, response: &Response, dial: &Dial) -> Option<f64> {
        let at = response.hover_pos()?;
        let angle = dial.angle_of([f64::from(at.x), f64::from(at.y)]);
        let turned = [angle, angle - 360.0, angle + 360.0];
        turned.into_iter().find(|angle| (self.plot.range[0]..=self.plot.range[1]).contains(angle))
    }

    fn draw_values(&self, ui: &mut Ui, frame: &Frame, left: f32, cursor: Option<f64>) {
        let visuals = ui.visuals().clone();
        frame.ground(ui.painter(), &visuals, false);
        frame.names(ui.painter(), &visuals, None, self.labels[1], left);
        frame.plot(ui, "values", cursor, |plot| {
            for drawn in self.drawn {
                frame.curve(drawn, drawn.trace.y, drawn.trace.band, &visuals, plot);
            }
        });
    }

    fn draw_errors(&self, ui: &mut Ui, frame: &Frame, left: f32, cursor: Option<f64>) {
        let visuals = ui.visuals().clone();
        frame.ground(ui.painter(), &visuals, true);
        let label = self.look.error_label(self.labels[1]);
        frame.names(ui.painter(), &visuals, Some(self.labels[0]), &label, left);
        frame.plot(ui, "errors", cursor, |plot| {
            for drawn in self.drawn.iter().filter(|drawn| drawn.trace.error.is_some()) {
                frame.curve(drawn, &self.look.errors(&drawn.trace), None, &visuals, plot);
            }
        });
    }

    fn draw_polar(&self, ui: &Ui, rect: Rect, dial: &Dial, cursor: Option<f64>) {
        polar::grid(dial, rect, ui.painter(), ui.visuals());
        let name = pos2(rect.left() + 6.0, rect.top() + 4.0);
        frame::text(self.labels[1], name, egui::Align2::LEFT_TOP, ui.visuals().text_color(), ui.painter());
        let below = rect.left_bottom() + vec2(6.0, -4.0);
        frame::text(self.labels[0], below, egui::Align2::LEFT_BOTTOM, ui.visuals().weak_text_color(), ui.painter());
        for drawn in self.drawn {
            polar::curve(dial, drawn, ui);
        }
        if let Some(angle) = cursor {
            polar::cursor(dial, angle, ui.painter(), ui.visuals());
        }
    }
}
