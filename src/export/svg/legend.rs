//! The methods of a plot and its pinned curves: how each is drawn, how far off it is, and what it costs.

use std::fmt::Write as _;

use super::frame::stroke;
use super::{GRID, WEAK, escaped, number, three_digits};
use crate::analysis::{Curves, Series, Sheet, Trace, unit};
use crate::scene::{Plot, PlotKind};
use crate::shading::Method;

/// Height of a row.
const ROW: f64 = 22.0;

/// Left sides of line and name.
const LINE: f64 = 0.0;
const NAME: f64 = 40.0;

/// Right sides of the columns of figures.
const COLUMNS: [f64; 4] = [182.0, 244.0, 296.0, 336.0];

/// The table, with its upper left corner at `corner`, and how to read it.
pub(super) fn write(svg: &mut String, corner: [f64; 2], sheet: &Sheet) {
    let Sheet { plot, curves, pins, .. } = sheet;
    let _ = writeln!(svg, "<g transform=\"translate({} {})\">", corner[0], corner[1]);
    let unit = unit(&curves.y_label);
    let has_costs = curves.series.iter().any(|series| series.cost_ns.is_finite());
    let [cost, ratio, a_point] = if has_costs { ["Cost", "Ratio", "a point"] } else { [""; 3] };
    row(svg, 11.0, &format!("fill=\"{WEAK}\""), "Method", ["Max error", "RMS", cost, ratio]);
    row(svg, 25.0, &format!("fill=\"{WEAK}\""), "", [unit, unit, a_point, ""]);
    let _ = writeln!(svg, "<path d=\"M{LINE} 33H{}\" stroke=\"{GRID}\"/>", COLUMNS[3]);
    let cheapest = curves.series.iter().map(|series| series.cost_ns).fold(f64::INFINITY, f64::min);
    let mut y = 50.0;
    let mut line = |svg: &mut String, trace: &Trace<'_>, name: &str, figures: [String; 4]| {
        let middle = y - 4.0;
        let _ = writeln!(svg, "<path d=\"M{LINE} {middle}H{}\" {}/>", NAME - 8.0, stroke(trace));
        row(svg, y, "", name, figures.each_ref().map(String::as_str));
        y += ROW;
    };
    for series in &curves.series {
        let trace = Trace::of_series(series, &curves.x, &curves.exact);
        line(svg, &trace, &series.method.to_string(), figures(series, cheapest));
    }
    for (index, pin) in pins {
        let apart = pin.distance(curves).map_or_else(Default::default, |apart| apart.map(three_digits));
        let [max, rms]: [String; 2] = apart;
        line(svg, &Trace::of_pin(pin, *index), &pin.name, [max, rms, String::new(), String::new()]);
    }
    let top = y + 8.0;
    for (i, note) in notes(plot, curves, !pins.is_empty()).iter().enumerate() {
        let y = top + 15.0 * i as f64;
        let _ = writeln!(svg, "<text x=\"{LINE}\" y=\"{y}\" font-size=\"11\" fill=\"{WEAK}\">{}</text>", escaped(note));
    }
    svg.push_str("</g>\n");
}

fn row(svg: &mut String, y: f64, style: &str, name: &str, figures: [&str; 4]) {
    let _ = writeln!(svg, "<g {style}><text x=\"{NAME}\" y=\"{y}\">{}</text>", escaped(name));
    for (x, figure) in COLUMNS.iter().zip(figures) {
        let _ = writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\">{}</text>", number(figure));
    }
    svg.push_str("</g>\n");
}

/// Errors, and cost where it was measured; the exact curve is what the others are measured against.
fn figures(series: &Series, cheapest: f64) -> [String; 4] {
    let error = |error: f64| if series.method == Method::Exact { String::new() } else { three_digits(error) };
    [
        error(series.max_error),
        error(series.rms_error),
        if series.cost_ns.is_finite() { time(series.cost_ns) } else { String::new() },
        if cheapest > 0.0 && series.cost_ns.is_finite() {
            two_digits(series.cost_ns / cheapest)
        } else {
            String::new()
        },
    ]
}

/// A time with two digits that count.
fn time(ns: f64) -> String {
    let (scale, unit) = match ns {
        ns if ns < 999.5 => (1.0, "ns"),
        ns if ns < 999.5e3 => (1e3, "µs"),
        _ => (1e6, "ms"),
    };
    format!("{} {unit}", two_digits(ns / scale))
}

fn two_digits(value: f64) -> String {
    if value < 9.95 { format!("{value:.1}") } else { format!("{value:.0}") }
}

/// What the reader must know besides.
fn notes(plot: &Plot, curves: &Curves, pinned: bool) -> Vec<String> {
    let v = |v: glam::DVec3| format!("({}, {}, {})", v.x, v.y, v.z).replace('-', "\u{2212}");
    let moved = match plot.kind {
        PlotKind::Tilt => "normal turned about",
        PlotKind::View => "eye turned about",
        PlotKind::Line | PlotKind::Distance => "moved along",
    };
    let mut notes = vec![
        format!("Probe at {} m, normal {},", v(plot.position), v(plot.normal)),
        format!("{moved} {}.", v(plot.axis)),
        "Error: method − exact. No shadows.".to_owned(),
    ];
    if curves.series.iter().any(|series| series.cost_ns.is_finite()) {
        notes.push("Cost: measured, all lights; ratio to the cheapest.".to_owned());
    }
    if pinned {
        notes.push("Pinned curves: how far the exact one is from them now.".to_owned());
    }
    if curves.series.iter().any(|series| series.band.is_some()) {
        notes.push("Shaded: the reference with its error bound.".to_owned());
    }
    notes
}
