//! How the curves of a plot are drawn, on screen and on paper alike: which axes, from where to where.

use super::axis::{Axis, Steps};
use super::{Curves, Pen, Series};
use crate::scene::{Plot, PlotKind};
use crate::shading::Method;

/// How far a linear plot shows curves above the greatest exact value, as a multiple of it: a point light close by
/// would else press all others flat.
const HEADROOM: f64 = 1.6;

/// How much of its greatest value a logarithmic plot shows at least: eight decades.
const LEAST_SHARE: f64 = 1e-8;

/// As [`LEAST_SHARE`], of errors.
const LEAST_ERROR_SHARE: f64 = 1e-6;

/// The greatest relative error that a plot of them shows, %.
const MOST_PERCENT: f64 = 100.0;

/// The choices that a reader has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Look {
    /// An angle as an angle, and values as distances from a pole. Only where [`turns`].
    pub polar: bool,
    /// Values on a logarithmic axis.
    pub logarithmic: bool,
    /// Errors in % of the exact values, not in the values' unit.
    pub relative_error: bool,
    /// The magnitude of errors, on a logarithmic axis.
    pub logarithmic_error: bool,
}

/// A curve among those that share axes.
#[derive(Clone, Copy, Debug)]
pub struct Trace<'a> {
    /// The method; none for a pinned curve.
    pub method: Option<Method>,
    /// How it is drawn.
    pub pen: Pen,
    /// Abscissae.
    pub x: &'a [f64],
    /// Values.
    pub y: &'a [f64],
    /// ± around the values.
    pub band: Option<&'a [f64]>,
    /// Exact values at the same abscissae, and how far off `y` is; none for the exact curve and pinned ones.
    pub error: Option<(&'a [f64], &'a [f64])>,
}

/// A curve kept to compare others with.
#[derive(Clone, Debug, PartialEq)]
pub struct Pin {
    /// What it is called.
    pub name: String,
    /// What abscissa and ordinate are; only plots of the same show it.
    pub labels: [String; 2],
    /// Abscissae.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

/// A plot as it is shown: all that an export of it needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Sheet {
    /// The plot.
    pub plot: Plot,
    /// Its curves.
    pub curves: Curves,
    /// Pinned curves, each with its place in the order of pens.
    pub pins: Vec<(usize, Pin)>,
    /// How they are drawn.
    pub look: Look,
}

/// Whether a plot's abscissa is an angle.
pub fn turns(kind: PlotKind) -> bool {
    matches!(kind, PlotKind::Tilt | PlotKind::View)
}

impl Look {
    /// How a plot is drawn where nobody says otherwise: distances with logarithmic axes and relative errors.
    pub fn of(kind: PlotKind) -> Self {
        let far = kind == PlotKind::Distance;
        Self { logarithmic: far, relative_error: far, ..Self::default() }
    }

    /// From where to where values are shown; and the steps of their axis, decimal where a logarithmic one has nothing
    /// to show.
    pub fn value_span(self, traces: &[Trace<'_>]) -> ([f64; 2], Steps) {
        let greatest_of =
            |traces: &mut dyn Iterator<Item = &Trace<'_>>| traces.flat_map(|trace| finite(trace.y)).fold(0.0, f64::max);
        // Pinned curves and the exact one are what is compared with: all of these is shown.
        let mut sure = traces.iter().filter(|trace| matches!(trace.method, None | Some(Method::Exact)));
        let greatest_sure = greatest_of(&mut sure);
        let greatest = greatest_of(&mut traces.iter());
        if self.logarithmic && greatest > 0.0 {
            let positive = traces.iter().flat_map(|trace| finite(trace.y)).filter(|y| *y > 0.0);
            let least = positive.fold(greatest, f64::min);
            return ([least.max(greatest * LEAST_SHARE), greatest], Steps::Decades);
        }
        let top = if greatest_sure > 0.0 { greatest.min(HEADROOM * greatest_sure) } else { greatest };
        let bottom = traces.iter().flat_map(|trace| finite(trace.y)).fold(0.0, f64::min).max(-top);
        (not_empty([bottom, top]), Steps::Decimal)
    }

    /// From where to where errors are shown, and the steps of their axis.
    pub fn error_span(self, traces: &[Trace<'_>]) -> ([f64; 2], Steps) {
        let exact = traces.iter().filter_map(|trace| trace.error).flat_map(|(exact, _)| finite(exact));
        let most = if self.relative_error { MOST_PERCENT } else { (HEADROOM - 1.0) * exact.fold(0.0, f64::max) };
        let shown = traces.iter().flat_map(|trace| self.errors(trace)).filter(|error| error.is_finite());
        let [low, high] = shown.fold([0.0_f64; 2], |[low, high], error| {
            let error = error.clamp(-most, most);
            [low.min(error), high.max(error)]
        });
        if self.logarithmic_error && high > 0.0 {
            let positive = traces.iter().flat_map(|trace| self.errors(trace)).filter(|error| *error > 0.0);
            let least = positive.fold(high, f64::min);
            return ([least.max(high * LEAST_ERROR_SHARE), high], Steps::Decades);
        }
        (not_empty([low, high]), Steps::Decimal)
    }

    /// A curve's errors as they are drawn: in % where they are relative, their magnitude where they are logarithmic. Not
    /// finite where the exact value is zero. Empty for what has none.
    pub fn errors(self, trace: &Trace<'_>) -> Vec<f64> {
        let Some((exact, error)) = trace.error else { return Vec::new() };
        error.iter().zip(exact).map(|(error, exact)| self.error(*error, *exact)).collect()
    }

    /// One error as it is drawn.
    pub fn error(self, error: f64, exact: f64) -> f64 {
        let error = if self.relative_error { 100.0 * error / exact } else { error };
        if self.logarithmic_error { error.abs() } else { error }
    }

    /// What errors are, with their unit; `y_label` is what values are.
    pub fn error_label(self, y_label: &str) -> String {
        let name = if self.logarithmic_error { "|Error|" } else { "Error" };
        match if self.relative_error { "%" } else { unit(y_label) } {
            "" => name.to_owned(),
            unit => format!("{name} ({unit})"),
        }
    }
}

impl<'a> Trace<'a> {
    /// The curve of a method, at the abscissae of the exact values `exact`.
    pub fn of_series(series: &'a Series, x: &'a [f64], exact: &'a [f64]) -> Self {
        Self {
            method: Some(series.method),
            pen: Pen::of(series.method),
            x,
            y: &series.y,
            band: series.band.as_deref(),
            error: (series.method != Method::Exact).then_some((exact, &series.error)),
        }
    }

    /// A pinned curve, by the pen of that index.
    pub fn of_pin(pin: &'a Pin, index: usize) -> Self {
        Self { method: None, pen: Pen::pinned(index), x: &pin.x, y: &pin.y, band: None, error: None }
    }

    /// Its order among others: the reference beneath the exact curve, and the approximations above it.
    pub fn layer(&self) -> u8 {
        match self.method {
            Some(Method::Reference) => 0,
            Some(Method::Exact) => 1,
            None => 2,
            Some(_) => 3,
        }
    }

    /// The value at an abscissa, between the nearest samples; none beyond them.
    pub fn value_at(&self, x: f64) -> Option<f64> {
        interpolated(self.x, self.y, x)
    }
}

impl Pin {
    /// Greatest and RMS distance of `curves`' exact values from it, where it has a value.
    pub fn distance(&self, curves: &Curves) -> Option<[f64; 2]> {
        let apart = |(x, exact): (&f64, &f64)| Some(exact - interpolated(&self.x, &self.y, *x)?);
        let apart: Vec<f64> = curves.x.iter().zip(&curves.exact).filter_map(apart).collect();
        let squares: f64 = apart.iter().map(|error| error * error).sum();
        let greatest = apart.iter().fold(0.0, |greatest: f64, error| greatest.max(error.abs()));
        (!apart.is_empty()).then(|| [greatest, (squares / apart.len() as f64).sqrt()])
    }

    /// Whether curves with these labels can be compared with it.
    pub fn fits(&self, curves: &Curves) -> bool {
        self.labels[0] == curves.x_label && self.labels[1] == curves.y_label
    }
}

impl Sheet {
    /// A plot's curves as the command line draws them.
    pub fn new(plot: &Plot, curves: Curves) -> Self {
        Self { plot: plot.clone(), curves, pins: Vec::new(), look: Look::of(plot.kind) }
    }

    /// All its curves, in the order in which they are drawn.
    pub fn traces(&self) -> Vec<Trace<'_>> {
        let Self { curves: Curves { x, exact, series, .. }, pins, .. } = self;
        let series = series.iter().map(|series| Trace::of_series(series, x, exact));
        let mut traces: Vec<_> = series.chain(pins.iter().map(|(index, pin)| Trace::of_pin(pin, *index))).collect();
        traces.sort_by_key(Trace::layer);
        traces
    }
}

/// The abscissa's axis between two sides of a frame.
pub fn abscissa(kind: PlotKind, logarithmic: bool, span: [f64; 2], sides: [f64; 2]) -> Axis {
    let steps = match kind {
        _ if logarithmic => Steps::Decades,
        PlotKind::Tilt | PlotKind::View => Steps::Degrees,
        PlotKind::Line | PlotKind::Distance => Steps::Decimal,
    };
    Axis::new(span, sides, steps)
}

/// The unit that an axis' label ends in, in parentheses; empty where there is none.
pub fn unit(label: &str) -> &str {
    label.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap_or_default()
}

/// The value at `at` of a curve through points whose abscissae rise; none beyond its ends.
pub fn interpolated(x: &[f64], y: &[f64], at: f64) -> Option<f64> {
    let above = x.partition_point(|x| *x < at);
    let (Some(high), Some(y_high)) = (x.get(above), y.get(above)) else { return None };
    if *high <= at {
        return Some(*y_high);
    }
    let below = above.checked_sub(1)?;
    let share = (at - x[below]) / (high - x[below]);
    Some(y[below] + share * (y_high - y[below]))
}

fn finite(values: &[f64]) -> impl Iterator<Item = f64> {
    values.iter().copied().filter(|value| value.is_finite())
}

/// A span that an axis can show.
fn not_empty([low, high]: [f64; 2]) -> [f64; 2] {
    if high > low { [low, high] } else { [-1.0, 1.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: &[f64] = &[0.0, 1.0, 2.0];

    fn trace<'a>(method: Option<Method>, y: &'a [f64], error: Option<(&'a [f64], &'a [f64])>) -> Trace<'a> {
        Trace { method, pen: Pen::pinned(0), x: X, y, band: None, error }
    }

    #[test]
    fn a_point_light_close_by_does_not_press_the_others_flat_but_a_pin_is_shown_whole() {
        let exact = trace(Some(Method::Exact), &[1.0, 2.0, 1.0], None);
        let point = trace(Some(Method::Point), &[1.0, 50.0, 1.0], None);
        let pin = trace(None, &[5.0, 5.0, 5.0], None);
        let look = Look::default();
        assert_eq!(look.value_span(&[exact, point]), ([0.0, 3.2], Steps::Decimal), "headroom");
        assert_eq!(look.value_span(&[exact, point, pin]).0, [0.0, 8.0], "with a pin");
    }

    #[test]
    fn a_logarithmic_axis_needs_something_above_zero() {
        let look = Look { logarithmic: true, ..Look::default() };
        let dark = trace(Some(Method::Exact), &[0.0; 3], None);
        assert_eq!(look.value_span(&[dark]).1, Steps::Decimal, "nothing to show");
        let lit = trace(Some(Method::Exact), &[0.0, 1e-12, 10.0], None);
        assert_eq!(look.value_span(&[lit]), ([1e-7, 10.0], Steps::Decades), "eight decades");
    }

    #[test]
    fn errors_are_drawn_in_the_unit_and_on_the_axis_that_was_chosen() {
        let point = trace(Some(Method::Point), &[1.0, 3.0, 0.0], Some((&[2.0, 2.0, 0.0], &[-1.0, 1.0, 0.0])));
        let absolute = Look::default();
        assert_eq!(absolute.errors(&point), [-1.0, 1.0, 0.0], "absolute");
        let percent = Look { relative_error: true, ..absolute };
        assert_eq!(percent.errors(&point)[..2], [-50.0, 50.0], "%");
        assert!(percent.errors(&point)[2].is_nan(), "of nothing");
        let magnitude = Look { logarithmic_error: true, ..percent };
        assert_eq!(magnitude.errors(&point)[..2], [50.0, 50.0], "magnitude");
        assert_eq!(magnitude.error_span(&[point]), ([50.0, 50.0], Steps::Decades), "span");
        let labels = [absolute, percent, magnitude].map(|look| look.error_label("Illuminance (lx)"));
        assert_eq!(labels, ["Error (lx)", "Error (%)", "|Error| (%)"], "labels");
    }

    #[test]
    fn values_are_read_between_samples_and_not_beyond_them() {
        let y = [1.0, 3.0, 2.0];
        let curve = trace(None, &y, None);
        let read = [-0.1, 0.0, 0.5, 1.0, 1.75, 2.0, 2.1].map(|x| curve.value_at(x));
        assert_eq!(read, [None, Some(1.0), Some(2.0), Some(3.0), Some(2.25), Some(2.0), None], "values");
    }
}
