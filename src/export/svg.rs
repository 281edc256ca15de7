//! Plots as SVG: a panel a plot, with the curves, their errors beneath, and what each method costs at their side.

mod chart;
mod frame;
mod legend;
mod polar;
mod scale;

use std::fmt::Write as _;

use super::Origin;
use crate::analysis::axis::Axis;
use crate::analysis::{Look, Sheet, Trace, abscissa, turns};
use frame::Frame;

pub use crate::analysis::axis::three_digits;
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

const INK: &str = "#22262b";
const WEAK: &str = "#5d6672";
const GRID: &str = "#e3e6ea";

/// A picture of plots, one above the other, on white.
///
/// Costs are measured, so they differ from run to run; all else is the same.
pub fn plots(sheets: &[Sheet], origin: Origin) -> String {
    let height = PANEL * sheets.len() as f64;
    let names: Vec<_> = sheets.iter().map(|sheet| escaped(&sheet.plot.name)).collect();
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{height}\" \
         viewBox=\"0 0 {WIDTH} {height}\" role=\"img\" font-family=\"Ubuntu, Helvetica, Arial, sans-serif\" \
         font-size=\"12\" fill=\"{INK}\">\n<title>{}</title>\n<desc>{}</desc>\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n",
        names.join("; "),
        escaped(&origin.line())
    );
    for (i, sheet) in sheets.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate(0 {})\">", PANEL * i as f64);
        panel(&mut svg, i, sheet);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// One plot.
fn panel(svg: &mut String, index: usize, sheet: &Sheet) {
    let Sheet { plot, curves, look, .. } = sheet;
    let _ = writeln!(svg, "<text x=\"{}\" y=\"32\" font-size=\"17\">{}</text>", SIDES[0], escaped(&plot.name));
    let traces = sheet.traces();
    let ends = [curves.x.first(), curves.x.last()].map(|end| end.copied().unwrap_or(0.0));
    let x = abscissa(plot.kind, curves.logarithmic_x, ends, SIDES);
    let clip = |part: &str| format!("{part}-{index}");
    if look.polar && turns(plot.kind) {
        polar::write(svg, *look, &traces, ends, &curves.y_label);
    } else {
        let (span, steps) = look.value_span(&traces);
        let values = Frame { x, y: Axis::widened(span, CURVES, steps, 6.0), clip: clip("curves") };
        values.grid(svg, false);
        values.label(svg, &curves.y_label);
        for trace in &traces {
            values.curve(svg, trace, trace.y, trace.band);
        }
        values.outline(svg);
    }
    let (span, steps) = look.error_span(&traces);
    let errors = Frame { x, y: Axis::widened(span, ERRORS, steps, 4.0), clip: clip("errors") };
    errors.grid(svg, true);
    errors.label(svg, &look.error_label(&curves.y_label));
    errors.label_x(svg, &curves.x_label);
    for trace in traces.iter().filter(|trace| trace.error.is_some()) {
        errors.curve(svg, trace, &look.errors(trace), error_band(*look, trace).as_deref());
    }
    errors.outline(svg);
    legend::write(svg, [LEGEND, CURVES[1]], sheet);
}

/// The reference's bound in the units of its error; magnitudes on a logarithmic axis have none.
fn error_band(look: Look, trace: &Trace<'_>) -> Option<Vec<f64>> {
    let (band, (exact, _)) = (trace.band?, trace.error?);
    let linear = Look { logarithmic_error: false, ..look };
    (!look.logarithmic_error).then(|| band.iter().zip(exact).map(|(band, exact)| linear.error(*band, *exact)).collect())
}

/// A number as XML: what follows `^` is raised, as few fonts have all the superscripts.
fn number(text: &str) -> String {
    match text.split_once('^') {
        Some((base, power)) => format!("{base}<tspan dy=\"-4\" font-size=\"9\">{power}</tspan>"),
        None => text.to_owned(),
    }
}

/// Text as XML; characters that XML does not have become blanks.
pub(super) fn escaped(text: &str) -> String {
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
