//! Axes with a grid, and curves in them.

use std::fmt::Write as _;

use super::{GRID, WEAK, escaped, number};
use crate::analysis::axis::Axis;
use crate::analysis::{Pen, Trace};
use crate::shading::Method;

/// Distance of an ordinate's name from the axis.
const NAME_OFFSET: f64 = 60.0;

/// Curves are cut off this far outside the frame.
const MARGIN: f64 = 1.5;

/// A pair of axes.
pub(super) struct Frame {
    pub(super) x: Axis,
    pub(super) y: Axis,
    /// Name of the region that curves are cut off at, unique in the picture.
    pub(super) clip: String,
}

impl Frame {
    /// Grid lines and numbers; those of the abscissa are optional.
    pub(super) fn grid(&self, svg: &mut String, numbers_below: bool) {
        let ([left, right], [bottom, top]) = (self.x.sides, self.y.sides);
        let height = bottom - top;
        let clip = &self.clip;
        // A curve along the frame keeps its whole width.
        let corner = format!("x=\"{}\" y=\"{}\"", left - MARGIN, top - MARGIN);
        let size = format!("width=\"{}\" height=\"{}\"", right - left + 2.0 * MARGIN, height + 2.0 * MARGIN);
        let _ = writeln!(svg, "<clipPath id=\"{clip}\"><rect {corner} {size}/></clipPath>");
        for tick in self.x.ticks(8.0) {
            let Some(x) = self.x.at(tick.value) else { continue };
            let _ = writeln!(svg, "<path d=\"M{x:.2} {bottom}V{top}\" stroke=\"{GRID}\"/>");
            if numbers_below {
                let y = bottom + 16.0;
                let _ =
                    writeln!(svg, "<text x=\"{x:.2}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", number(&tick.label));
            }
        }
        for tick in self.y.ticks(if height > 200.0 { 6.0 } else { 4.0 }) {
            let Some(y) = self.y.at(tick.value) else { continue };
            let (x, baseline) = (left - 7.0, y + 4.0);
            let stroke = if tick.value.abs() > 0.0 { GRID } else { WEAK };
            let _ = writeln!(svg, "<path d=\"M{left} {y:.2}H{right}\" stroke=\"{stroke}\" stroke-width=\"0.8\"/>");
            let _ =
                writeln!(svg, "<text x=\"{x}\" y=\"{baseline:.2}\" text-anchor=\"end\">{}</text>", number(&tick.label));
        }
    }

    /// The frame itself, above the curves.
    pub(super) fn outline(&self, svg: &mut String) {
        let ([left, right], [bottom, top]) = (self.x.sides, self.y.sides);
        let path = format!("M{left} {top}H{right}V{bottom}H{left}Z");
        let _ = writeln!(svg, "<path d=\"{path}\" fill=\"none\" stroke=\"{WEAK}\" stroke-width=\"0.8\"/>");
    }

    /// The name of the ordinate, along it.
    pub(super) fn label(&self, svg: &mut String, text: &str) {
        let (x, y) = (self.x.sides[0] - NAME_OFFSET, f64::midpoint(self.y.sides[0], self.y.sides[1]));
        let place = format!("transform=\"translate({x} {y}) rotate(-90)\" text-anchor=\"middle\" font-size=\"13\"");
        let _ = writeln!(svg, "<text {place}>{}</text>", escaped(text));
    }

    /// The name of the abscissa, beneath it.
    pub(super) fn label_x(&self, svg: &mut String, text: &str) {
        let (x, y) = (f64::midpoint(self.x.sides[0], self.x.sides[1]), self.y.sides[0] + 36.0);
        let _ =
            writeln!(svg, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\" font-size=\"13\">{}</text>", escaped(text));
    }

    /// A curve through the values `y`, with the pen of `trace` and a band.
    pub(super) fn curve(&self, svg: &mut String, trace: &Trace<'_>, y: &[f64], band: Option<&[f64]>) {
        let x = trace.x;
        let clip = format!("clip-path=\"url(#{})\"", self.clip);
        if let Some(band) = band {
            let edge = |sign: f64| y.iter().zip(band).map(|(y, band)| y + sign * band).collect::<Vec<_>>();
            let (low, high) = (edge(-1.0), edge(1.0));
            let outline: Vec<_> = self.points(x, &high).chain(self.points(x, &low).rev()).flatten().collect();
            let color = color(&trace.pen);
            let _ = writeln!(
                svg,
                "<path d=\"{}Z\" fill=\"{color}\" fill-opacity=\"0.3\" {clip}/>",
                path(outline.into_iter().map(Some))
            );
        }
        self.polyline(svg, x, y, &stroke(trace));
    }

    /// A line through points, with the attributes of its stroke.
    pub(super) fn polyline(&self, svg: &mut String, x: &[f64], y: &[f64], stroke: &str) {
        let _ = writeln!(svg, "<path d=\"{}\" {stroke} clip-path=\"url(#{})\"/>", path(self.points(x, y)), self.clip);
    }

    /// Where the points of a curve lie, none for those without a place. Those far outside are brought near, since
    /// renderers do not cope with just any number.
    fn points<'a>(&'a self, x: &'a [f64], y: &'a [f64]) -> impl DoubleEndedIterator<Item = Option<[f64; 2]>> + 'a {
        let [bottom, top] = self.y.sides;
        let height = bottom - top;
        let near = move |y: f64| y.is_finite().then(|| y.clamp(top - 20.0 * height, bottom + 20.0 * height));
        x.iter().zip(y).map(move |(x, y)| Some([self.x.at(*x)?, near(self.y.at(*y)?)?]))
    }
}

/// A path through points, which begins anew after those that are missing.
pub(super) fn path(points: impl Iterator<Item = Option<[f64; 2]>>) -> String {
    let mut path = String::new();
    let mut drawing = false;
    for point in points {
        if let Some([x, y]) = point {
            let _ = write!(path, "{}{x:.2} {y:.2}", if drawing { "L" } else { "M" });
        }
        drawing = point.is_some();
    }
    path
}

/// The attributes of a curve's line.
pub(super) fn stroke(trace: &Trace<'_>) -> String {
    pen_stroke(&trace.pen, if trace.method == Some(Method::Exact) { 2.4 } else { 1.7 })
}

/// The attributes of a line by a pen.
pub(super) fn pen_stroke(pen: &Pen, width: f64) -> String {
    let color = color(pen);
    let mut stroke = format!("fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"");
    if !pen.dashes.is_empty() {
        let dashes: Vec<_> = pen.dashes.iter().map(f32::to_string).collect();
        let _ = write!(stroke, " stroke-dasharray=\"{}\"", dashes.join(" "));
    }
    stroke
}

/// A pen's colour on paper.
pub(super) fn color(pen: &Pen) -> String {
    let [r, g, b] = pen.on_light;
    format!("#{r:02x}{g:02x}{b:02x}")
}
