//! Plots as SVG: a panel a plot, with the curves, their errors beneath, and what each method costs at their side.

mod axis;
mod chart;
mod frame;
mod legend;
mod scale;

use std::fmt::Write as _;

use crate::analysis::{Curves, Series};
use crate::scene::{Plot, PlotKind};
use crate::shading::Method;
use axis::{Axis, Steps};
use frame::Frame;

pub use axis::three_digits;
pub use chart::chart;
pub use scale::ColorScale;

/// Width of a picture.
const WIDTH: f64 = 1000.0;

/// Height of a panel.
const PANEL: f64 = 510.0;

/// Left and right side of the frames.
const SIDES: [f64; 2] = [78.0, 632.0];

/// Bottom and top of the curves' frame.
const CURVES: [f64; 2] = [330.0, 46.0];

/// Bottom and top of the errors' frame.
const ERRORS: [f64; 2] = [452.0, 346.0];

/// Left side of the legend.
const LEGEND: f64 = 656.0;

/// How far a linear plot shows curves above the greatest exact value, as a multiple of it: a point light close by
/// would else press all others flat.
const HEADROOM: f64 = 1.6;

/// How many decades a logarithmic plot shows below its greatest value.
const DECADES: f64 = 1e-8;

/// The greatest relative error that a plot of them shows, %.
const MOST_PERCENT: f64 = 100.0;

const INK: &str = "#22262b";
const WEAK: &str = "#5d6672";
const GRID: &str = "#e3e6ea";

/// A picture of plots, one above the other, on white.
///
/// Costs are measured, so they differ from run to run; all else is the same.
pub fn plots(plots: &[(&Plot, Curves)]) -> String {
    let height = PANEL * plots.len() as f64;
    let names: Vec<_> = plots.iter().map(|(plot, _)| escaped(&plot.name)).collect();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" font-family=\"Ubuntu, Helvetica, Arial, sans-serif\" \
         font-size=\"12\" fill=\"{INK}\">\n<title>{}</title>\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        names.join("; ")
    );
    for (i, (plot, curves)) in plots.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate(0 {})\">", PANEL * i as f64);
        panel(&mut svg, i, plot, curves);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// One plot.
fn panel(svg: &mut String, index: usize, plot: &Plot, curves: &Curves) {
    let _ = writeln!(svg, "<text x=\"{}\" y=\"32\" font-size=\"17\">{}</text>", SIDES[0], escaped(&plot.name));
    let x = abscissa(plot.kind, curves);
    let y = ordinate(curves);
    let relative = curves.logarithmic_x;
    let clip = |part: &str| format!("{part}-{index}");
    let values = Frame { x, y, clip: clip("curves") };
    let errors = Frame { x, y: error_axis(curves, relative), clip: clip("errors") };
    values.grid(svg, false);
    errors.grid(svg, true);
    values.label(svg, &curves.y_label);
    errors.label(svg, &if relative { "Error (%)".to_owned() } else { labelled("Error", unit(&curves.y_label)) });
    errors.label_x(svg, &curves.x_label);
    for series in in_drawing_order(&curves.series) {
        values.curve(svg, series.method, &curves.x, &series.y, series.band.as_deref());
        if series.method != Method::Exact {
            let [error, band] = [Some(&series.error), series.band.as_ref()].map(|values| {
                values.map(|values| if relative { percent(values, &curves.exact) } else { values.clone() })
            });
            errors.curve(svg, series.method, &curves.x, &error.unwrap_or_default(), band.as_deref());
        }
    }
    values.outline(svg);
    errors.outline(svg);
    legend::write(svg, [LEGEND, CURVES[1]], plot, curves);
}

/// The reference beneath the exact curve, and the approximations above it, the crudest last.
fn in_drawing_order(series: &[Series]) -> Vec<&Series> {
    let mut series: Vec<_> = series.iter().collect();
    series.sort_by_key(|series| match series.method {
        Method::Reference => 0,
        Method::Exact => 1,
        _ => 2,
    });
    series
}

fn abscissa(kind: PlotKind, curves: &Curves) -> Axis {
    let steps = match kind {
        _ if curves.logarithmic_x => Steps::Decades,
        PlotKind::Tilt | PlotKind::View => Steps::Degrees,
        PlotKind::Line | PlotKind::Distance => Steps::Decimal,
    };
    let ends = [curves.x.first(), curves.x.last()].map(|end| end.copied().unwrap_or(0.0));
    Axis::new(ends, SIDES, steps)
}

/// From zero, or from the least value, to the greatest; logarithmic where the abscissa is and there is anything to show.
fn ordinate(curves: &Curves) -> Axis {
    let all = || curves.series.iter().flat_map(|series| series.y.iter().copied()).filter(|y| y.is_finite());
    let greatest_exact = greatest_exact(curves);
    let greatest = all().fold(0.0, f64::max);
    let least = all().filter(|y| *y > 0.0).fold(greatest, f64::min);
    if curves.logarithmic_x && greatest > 0.0 {
        let span = [least.max(greatest * DECADES), greatest];
        return Axis::widened(span, CURVES, Steps::Decades, 6.0);
    }
    let top = if greatest_exact > 0.0 { greatest.min(HEADROOM * greatest_exact) } else { greatest };
    let bottom = all().fold(0.0, f64::min).max(-top);
    Axis::widened(not_empty([bottom, top]), CURVES, Steps::Decimal, 6.0)
}

/// As far as the errors reach, below and above zero.
fn error_axis(curves: &Curves, relative: bool) -> Axis {
    let greatest_exact = greatest_exact(curves);
    let most = if relative { MOST_PERCENT } else { (HEADROOM - 1.0) * greatest_exact };
    let mut span = [0.0_f64; 2];
    for series in &curves.series {
        let errors = if relative { percent(&series.error, &curves.exact) } else { series.error.clone() };
        for error in errors.into_iter().filter(|error| error.is_finite()) {
            span = [span[0].min(error.max(-most)), span[1].max(error.min(most))];
        }
    }
    Axis::widened(not_empty(span), ERRORS, Steps::Decimal, 4.0)
}

/// The greatest finite exact value, 0 if there is none above.
fn greatest_exact(curves: &Curves) -> f64 {
    curves.exact.iter().copied().filter(|y| y.is_finite()).fold(0.0, f64::max)
}

/// A span that an axis can show.
fn not_empty([low, high]: [f64; 2]) -> [f64; 2] {
    if high > low { [low, high] } else { [-1.0, 1.0] }
}

/// Errors in % of the exact values; not finite where these are zero.
fn percent(errors: &[f64], exact: &[f64]) -> Vec<f64> {
    errors.iter().zip(exact).map(|(error, exact)| 100.0 * error / exact).collect()
}

/// The unit that an axis' label ends in, in parentheses; empty where there is none.
fn unit(label: &str) -> &str {
    label.rsplit_once('(').and_then(|(_, rest)| rest.strip_suffix(')')).unwrap_or_default()
}

fn labelled(name: &str, unit: &str) -> String {
    if unit.is_empty() { name.to_owned() } else { format!("{name} ({unit})") }
}

/// A number as XML: what follows `^` is raised, as few fonts have all the superscripts.
fn number(text: &str) -> String {
    match text.split_once('^') {
        Some((base, power)) => format!("{base}<tspan dy=\"-4\" font-size=\"9\">{power}</tspan>"),
        None => text.to_owned(),
    }
}

/// Text as XML; characters that XML does not have become blanks.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests;
