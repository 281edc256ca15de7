//! Which part of a plot is in sight: all of it, by axes that do not jump while it changes, until the user zooms.

use egui::{PointerButton, Rect, Response, Ui};

use crate::analysis::axis::{Axis, Steps};
use crate::analysis::{Look, abscissa};
use crate::scene::Plot;

/// While what is shown changes, an axis only grows, as long as at least this share of it is filled.
const FULL_ENOUGH: f64 = 0.2;
/// Zoom for each point of the wheel.
const ZOOM_PER_POINT: f32 = 0.004;
/// The closest and the farthest that can be zoomed to, as shares of the whole axis.
const ZOOM_RANGE: [f64; 2] = [1e-3, 20.0];

/// Values or errors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Values,
    Errors,
}

/// See the [module](self).
#[derive(Debug, Default)]
pub(super) struct Axes {
    /// What they were made for: anything else starts anew.
    of: Option<Subject>,
    /// The spans of values and errors that are shown by themselves.
    kept: [Option<([f64; 2], Steps)>; 2],
    /// The spans of values and errors that the user has chosen.
    chosen: [Option<[f64; 2]>; 2],
    chosen_x: Option<[f64; 2]>,
}

/// What one set of axes is for.
#[derive(Clone, Debug, PartialEq)]
struct Subject {
    plot: String,
    look: Look,
    labels: [String; 2],
    range: [f64; 2],
}

impl Axes {
    /// Show that plot.
    pub(super) fn follow(&mut self, plot: &Plot, look: Look, labels: [&str; 2]) {
        let subject = Subject { plot: plot.name.clone(), look, labels: labels.map(str::to_owned), range: plot.range };
        if self.of.as_ref() != Some(&subject) {
            *self = Self { of: Some(subject), ..Self::default() };
        }
    }

    /// The abscissa.
    pub(super) fn x(&self, plot: &Plot, logarithmic: bool, sides: [f64; 2]) -> Axis {
        abscissa(plot.kind, logarithmic, self.chosen_x.unwrap_or(plot.range), sides)
    }

    /// The ordinate over `wanted`, with about `count` labels: of that alone when it is `settled`; until then it changes
    /// as little as it can.
    pub(super) fn y(
        &mut self,
        part: Part,
        wanted: ([f64; 2], Steps),
        sides: [f64; 2],
        count: f64,
        settled: bool,
    ) -> Axis {
        let (span, steps) = wanted;
        if let Some(chosen) = self.chosen[part as usize].filter(|[low, _]| steps != Steps::Decades || *low > 0.0) {
            return Axis::new(chosen, sides, steps);
        }
        let fitted = Axis::widened(span, sides, steps, count);
        let kept = self.kept[part as usize].filter(|(_, of)| *of == steps && !settled).map(|(kept, _)| kept);
        let both = kept.map(|kept| [kept[0].min(fitted.span[0]), kept[1].max(fitted.span[1])]);
        let shown = match both.filter(|both| share(fitted.span, *both, steps) >= FULL_ENOUGH) {
            Some(both) => Axis::widened(both, sides, steps, count),
            None => fitted,
        };
        self.kept[part as usize] = Some((shown.span, steps));
        shown
    }

    /// Pan by dragging, zoom by the wheel: along both axes, or beside the frame along the axis that is there; a
    /// double-click shows all again.
    pub(super) fn steer(&mut self, ui: &Ui, response: &Response, part: Part, frame: Rect, x: &Axis, y: &Axis) {
        if response.double_clicked() {
            let of = self.of.take();
            *self = Self { of, ..Self::default() };
            return;
        }
        let whole = self.of.as_ref().map(|of| of.range);
        let kept = self.kept[part as usize].map(|(span, _)| span);
        if response.dragged_by(PointerButton::Primary) && response.drag_delta() != egui::Vec2::ZERO {
            let by = response.drag_delta();
            self.chosen_x = Some(x.sides.map(|side| x.value_at(side - f64::from(by.x))));
            self.chosen[part as usize] = Some(y.sides.map(|side| y.value_at(side - f64::from(by.y))));
        }
        let Some(at) = response.hover_pos() else { return };
        let (scroll, pinch) = ui.input(|input| (input.smooth_scroll_delta().y, input.zoom_delta()));
        let factor = f64::from((ZOOM_PER_POINT * scroll).exp() * pinch);
        if (factor - 1.0).abs() < 1e-6 {
            return;
        }
        let zoomed = |axis: &Axis, at: f32, whole: Option<[f64; 2]>| {
            let span = axis.sides.map(|side| axis.value_at(f64::from(at) + (side - f64::from(at)) / factor));
            let share = whole.map_or(1.0, |[low, high]| (span[1] - span[0]) / (high - low));
            (ZOOM_RANGE[0]..=ZOOM_RANGE[1]).contains(&share).then_some(span)
        };
        if at.x >= frame.left() {
            self.chosen_x = zoomed(x, at.x, whole).or(self.chosen_x);
        }
        if at.y <= frame.bottom() {
            self.chosen[part as usize] = zoomed(y, at.y, kept).or(self.chosen[part as usize]);
        }
    }

    /// Zoom the distances from a pole by the wheel.
    pub(super) fn steer_radius(&mut self, ui: &Ui, response: &Response, axis: &Axis) {
        if response.double_clicked() {
            self.chosen[Part::Values as usize] = None;
        }
        let scroll = ui.input(|input| input.smooth_scroll_delta().y);
        if response.hovered() && scroll.abs() > 0.0 {
            let factor = f64::from((ZOOM_PER_POINT * scroll).exp());
            let [low, high] = [axis.span[0], axis.value_at(axis.sides[1] / factor)];
            self.chosen[Part::Values as usize] = Some([low, high]);
        }
    }
}

/// What share of an axis over `whole` is over `span`.
fn share(span: [f64; 2], whole: [f64; 2], steps: Steps) -> f64 {
    let [span, whole] = [span, whole].map(|ends| if steps == Steps::Decades { ends.map(f64::log10) } else { ends });
    (span[1] - span[0]) / (whole[1] - whole[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(spans: &[([f64; 2], bool)], expected: &[f64]) {
        let mut axes = Axes::default();
        let tops = spans
            .iter()
            .map(|(span, settled)| axes.y(Part::Values, (*span, Steps::Decimal), [100.0, 0.0], 5.0, *settled).span[1]);
        assert_eq!(tops.collect::<Vec<_>>(), expected, "{spans:?}");
    }

    #[test]
    fn what_is_settled_has_the_same_axis_whatever_was_there_before() {
        check(&[([0.0, 70.0], true)], &[80.0]);
        check(&[([0.0, 140.0], false), ([0.0, 90.0], true), ([0.0, 70.0], true)], &[150.0, 100.0, 80.0]);
    }

    #[test]
    fn while_it_changes_an_axis_only_grows_until_little_is_left_to_see() {
        let growing = [([0.0, 90.0], false), ([0.0, 30.0], false), ([0.0, 140.0], false), ([0.0, 30.0], true)];
        check(&growing, &[100.0, 100.0, 150.0, 30.0]);
        check(&[([0.0, 90.0], false), ([0.0, 9.0], false)], &[100.0, 10.0]);
    }
}
