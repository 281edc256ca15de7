//! Curves about a pole: an angle as an angle, and values as distances.

use std::fmt::Write as _;

use super::frame::{color, path, stroke};
use super::{CURVES, GRID, SIDES, WEAK, escaped, number};
use crate::analysis::axis::Axis;
use crate::analysis::{DIAL_MARGIN, Dial, Look, Trace};

/// About how many rings there are.
const RINGS: f64 = 5.0;

/// The curves in the place of the plot's upper frame, for angles within `range`.
pub(super) fn write(svg: &mut String, look: Look, traces: &[Trace<'_>], range: [f64; 2], y_label: &str) {
    let (pole, radius, half) = Dial::fitted([SIDES[0], SIDES[1], CURVES[0], CURVES[1]], range);
    let (span, steps) = look.value_span(traces);
    let dial = Dial { pole, axis: Axis::widened(span, [0.0, radius], steps, RINGS), half };
    grid(svg, &dial);
    for trace in traces {
        if let Some(band) = trace.band {
            let edge = |sign: f64| trace.y.iter().zip(band).map(|(y, band)| y + sign * band).collect::<Vec<_>>();
            let [high, low] = [1.0, -1.0].map(|sign| dial.pieces(trace.x, &edge(sign)));
            for (high, low) in high.into_iter().zip(low) {
                let outline = high.into_iter().chain(low.into_iter().rev()).map(Some);
                let color = color(&trace.pen);
                let _ = writeln!(svg, "<path d=\"{}Z\" fill=\"{color}\" fill-opacity=\"0.3\"/>", path(outline));
            }
        }
        for piece in dial.pieces(trace.x, trace.y) {
            let _ = writeln!(svg, "<path d=\"{}\" {}/>", path(piece.into_iter().map(Some)), stroke(trace));
        }
    }
    let place = format!("x=\"{}\" y=\"{}\" font-size=\"13\"", SIDES[0], CURVES[1] + 12.0);
    let _ = writeln!(svg, "<text {place}>{}</text>", escaped(y_label));
}

/// Rings with their values, and rays with their angles.
fn grid(svg: &mut String, dial: &Dial) {
    let ([x, y], radius) = (dial.pole, dial.radius());
    let rings: Vec<_> =
        dial.axis.ticks(RINGS).into_iter().filter_map(|tick| Some((dial.axis.at(tick.value)?, tick))).collect();
    for (r, _) in rings.iter().filter(|(r, _)| *r > 0.0) {
        let ring = if dial.half {
            format!("M{} {y:.2}A{r:.2} {r:.2} 0 0 1 {} {y:.2}", x - r, x + r)
        } else {
            format!("M{} {y:.2}a{r:.2} {r:.2} 0 1 1 {d:.2} 0a{r:.2} {r:.2} 0 1 1 -{d:.2} 0", x - r, d = 2.0 * r)
        };
        let _ = writeln!(svg, "<path d=\"{ring}\" fill=\"none\" stroke=\"{GRID}\"/>");
    }
    for angle in dial.marks() {
        let [end, label] = [radius, radius + 0.6 * DIAL_MARGIN].map(|distance| dial.place(angle, distance));
        let _ = writeln!(svg, "<path d=\"M{x:.2} {y:.2}L{:.2} {:.2}\" stroke=\"{GRID}\"/>", end[0], end[1]);
        let (left, baseline) = (label[0], label[1] + 4.0);
        let text = format!("{angle}°").replace('-', "\u{2212}");
        let _ = writeln!(
            svg,
            "<text x=\"{left:.2}\" y=\"{baseline:.2}\" text-anchor=\"middle\" fill=\"{WEAK}\">{text}</text>"
        );
    }
    for (r, tick) in rings {
        let [left, baseline] = [x + 4.0, y - r + 12.0];
        let halo = "paint-order=\"stroke\" stroke=\"#ffffff\" stroke-width=\"3\"";
        let _ = writeln!(svg, "<text x=\"{left:.2}\" y=\"{baseline:.2}\" {halo}>{}</text>", number(&tick.label));
    }
}
