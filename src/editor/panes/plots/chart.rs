//! Curves and their errors on linked axes.

use std::collections::BTreeSet;
use std::ops::RangeInclusive;

use egui::{Id, Ui, Visuals};
use egui_plot::{FilledArea, GridInput, GridMark, HoverPosition, PlotPoints};

use super::curve::Curve;
use crate::analysis::{Curves, Series};
use crate::editor::theme;
use crate::scene::{Plot, PlotKind};
use crate::shading::Method;

/// Room for the numbers on the ordinates, so that both plots start at the same place, points.
const ORDINATE_WIDTH: f32 = 56.0;

/// Steps between round angles, degrees.
const DEGREES: [f64; 7] = [2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0];

/// What is drawn.
pub(super) struct Chart<'a> {
    pub(super) plot: &'a Plot,
    pub(super) curves: &'a Curves,
    /// Names of methods that are not drawn.
    pub(super) hidden: &'a BTreeSet<String>,
    /// Whether the ordinate is logarithmic.
    pub(super) logarithmic: bool,
}

impl Chart<'_> {
    /// Draw both plots, the errors in the lower `error_share` of the height.
    pub(super) fn show(&self, ui: &mut Ui, error_share: f32) {
        let height = ui.available_height() - ui.spacing().item_spacing.y;
        let name = &self.plot.name;
        let visuals = ui.visuals().clone();
        let values = self.axes(ui, "values", (1.0 - error_share) * height, self.logarithmic);
        // The abscissa is written once, under the errors.
        let values = values.show_axes([false, true]).y_axis_label(self.curves.y_label.clone());
        let response = values.show(ui, |plot| {
            for series in self.visible() {
                self.draw_values(plot, &visuals, series);
            }
        });
        response.response.accessible_name(format!("Curves of {name}"));
        let errors = self.axes(ui, "errors", error_share * height, false);
        let response = errors.y_axis_label("Error").x_axis_label(self.curves.x_label.clone()).show(ui, |plot| {
            for series in self.visible().filter(|series| series.method != Method::Exact) {
                plot.add(Curve::new(series.method, self.points(&series.error, false), 1.5, &visuals));
            }
        });
        response.response.accessible_name(format!("Errors of {name}"));
    }

    fn visible(&self) -> impl Iterator<Item = &Series> {
        // The exact curve last, so that it lies on top.
        let shown = self.curves.series.iter().filter(|series| !self.hidden.contains(&series.method.to_string()));
        let (exact, others): (Vec<_>, Vec<_>) = shown.partition(|series| series.method == Method::Exact);
        others.into_iter().chain(exact)
    }

    /// Axes with the abscissa in common.
    fn axes(&self, ui: &Ui, part: &str, height: f32, logarithmic_y: bool) -> egui_plot::Plot<'static> {
        let logarithmic_x = self.curves.logarithmic_x;
        let group = Id::unique(("plot abscissa", &self.plot.name));
        let plot = egui_plot::Plot::new((part, &self.plot.name, logarithmic_y, self.plot.kind))
            .height(height.max(40.0))
            .link_axis(group, [true, false])
            .link_cursor(group, [true, false])
            .allow_scroll(false)
            .y_axis_min_width(ORDINATE_WIDTH)
            .grid_color(ui.visuals().weak_text_color())
            .label_formatter(move |at| hover_text(at, logarithmic_x, logarithmic_y));
        let turns = matches!(self.plot.kind, PlotKind::Tilt | PlotKind::View);
        let plot = if logarithmic_x {
            plot.x_axis_formatter(power_of_ten).x_grid_spacer(decades)
        } else {
            plot.x_axis_formatter(|mark, _| short(mark.value)).x_grid_spacer(move |input| marks(input, 9.0, turns))
        };
        if logarithmic_y {
            plot.y_axis_formatter(power_of_ten).y_grid_spacer(decades)
        } else {
            plot.y_axis_formatter(|mark, _| short(mark.value))
                .include_y(0.0)
                .y_grid_spacer(|input| marks(input, 2.5, false))
        }
    }

    fn draw_values(&self, plot: &mut egui_plot::PlotUi<'_>, visuals: &Visuals, series: &Series) {
        if let Some(band) = &series.band {
            let edge = |sign: f64| -> Vec<f64> {
                series.y.iter().zip(band).map(|(y, band)| self.ordinate(y + sign * band, self.logarithmic)).collect()
            };
            let x: Vec<f64> = self.curves.x.iter().map(|x| self.abscissa(*x)).collect();
            let (low, high) = (edge(-1.0), edge(1.0));
            if low.iter().chain(&high).all(|y| y.is_finite()) {
                let (color, _) = theme::method_pen(series.method, visuals);
                let name = format!("bound of {}", series.method);
                plot.add(FilledArea::new(name, &x, &low, &high).fill_color(color.gamma_multiply(0.35)));
            }
        }
        let width = if series.method == Method::Exact { 2.0 } else { 1.7 };
        plot.add(Curve::new(series.method, self.points(&series.y, self.logarithmic), width, visuals));
    }

    /// A curve's points; those that have no place on a logarithmic axis are left out.
    fn points(&self, y: &[f64], logarithmic_y: bool) -> PlotPoints<'static> {
        let points = self.curves.x.iter().zip(y).map(|(x, y)| [self.abscissa(*x), self.ordinate(*y, logarithmic_y)]);
        points.filter(|point| point[1].is_finite()).collect()
    }

    fn abscissa(&self, x: f64) -> f64 {
        if self.curves.logarithmic_x { x.log10() } else { x }
    }

    #[expect(clippy::unused_self, reason = "reads like its sibling")]
    fn ordinate(&self, y: f64, logarithmic: bool) -> f64 {
        if logarithmic { y.log10() } else { y }
    }
}

/// What is under the pointer.
fn hover_text(at: &HoverPosition<'_>, logarithmic_x: bool, logarithmic_y: bool) -> Option<String> {
    let HoverPosition::NearDataPoint { plot_name, position, .. } = at else { return None };
    let linear = |value: f64, logarithmic: bool| if logarithmic { 10_f64.powf(value) } else { value };
    let (x, y) = (linear(position.x, logarithmic_x), linear(position.y, logarithmic_y));
    Some(format!("{plot_name}\n{} at {}", short(y), short(x)))
}

/// The number that a mark on a logarithmic axis stands for; only powers of ten and their doubles and fives are named.
fn power_of_ten(mark: GridMark, _shown: &RangeInclusive<f64>) -> String {
    short(10_f64.powf(mark.value))
}

/// Marks at multiples of a round step, at least `least` times as far apart as grid lines may be, so that numbers fit
/// between them. Angles have round steps of their own.
fn marks(input: GridInput, least: f64, angles: bool) -> Vec<GridMark> {
    let step = round_step(least * input.base_step_size, angles);
    let (low, high) = input.bounds;
    let mut marks = Vec::new();
    let mut index = (low / step).ceil();
    while index * step <= high && marks.len() < 100 {
        marks.push(GridMark { value: index * step, step_size: step });
        index += 1.0;
    }
    marks
}

/// The least round step that is not below `room`.
fn round_step(room: f64, angles: bool) -> f64 {
    let degrees = DEGREES.into_iter().find(|step| angles && room > 1.0 && *step >= room);
    degrees.unwrap_or_else(|| {
        let scale = 10_f64.powf(room.log10().floor());
        [1.0, 2.0, 5.0].into_iter().find(|step| step * scale >= room).unwrap_or(10.0) * scale
    })
}

/// Marks at 1, 2, 5 times the powers of ten that are in sight; at the powers alone when there are many.
fn decades(input: GridInput) -> Vec<GridMark> {
    let (low, high) = input.bounds;
    let factors: &[f64] = if high - low > 3.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
    let mut marks = Vec::new();
    let mut decade = low.floor();
    while decade <= high && marks.len() < 200 {
        for factor in factors {
            let value = decade + factor.log10();
            let step_size = if *factor > 1.0 { 0.3 } else { 1.0 };
            if (low..=high).contains(&value) {
                marks.push(GridMark { value, step_size });
            }
        }
        decade += 1.0;
    }
    marks
}

/// A number in as few characters as three or four digits take.
pub(super) fn short(value: f64) -> String {
    let size = value.abs();
    if size < f64::MIN_POSITIVE {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&size) {
        // Four significant digits, without the zeros at the end.
        let decimals = if size < 1e-2 {
            5
        } else if size < 0.1 {
            4
        } else if size < 10.0 {
            3
        } else if size < 100.0 {
            2
        } else if size < 1000.0 {
            1
        } else {
            0
        };
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        format!("{value:.1e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_right() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.5, "-0.5"),
            (123.45, "123.5"),
            (99_999.0, "99999"),
            (0.001_23, "0.00123"),
            (1.5e-9, "1.5e-9"),
            (2.0e7, "2.0e7"),
        ] {
            assert_eq!(short(value), text, "{value}");
        }
    }

    #[test]
    fn marks_are_round_and_leave_room_for_their_numbers() {
        let values = |angles: bool, low: f64, high: f64| -> Vec<f64> {
            let input = GridInput { bounds: (low, high), base_step_size: (high - low) / 50.0 };
            marks(input, 5.0, angles).iter().map(|mark| mark.value).collect()
        };
        assert_eq!(values(true, -90.0, 90.0), [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0], "angles");
        assert_eq!(values(false, 0.0, 400.0), [0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0], "lux");
        let small = values(false, -0.003, 0.003);
        assert!(small.len() >= 5 && small.len() <= 11, "{small:?}");
    }

    #[test]
    fn decades_are_marked_within_sight_only() {
        let marks = decades(GridInput { bounds: (-1.0, 1.0), base_step_size: 0.1 });
        let values: Vec<f64> = marks.iter().map(|mark| 10_f64.powf(mark.value)).collect();
        let expected = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0];
        assert_eq!(values.len(), expected.len(), "{values:?}");
        for (value, expected) in values.iter().zip(expected) {
            assert!((value / expected - 1.0).abs() < 1e-12, "{value} is not {expected}");
        }
    }
}
