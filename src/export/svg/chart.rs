//! Charts as SVG: panels side by side, with curves or maps.

use std::fmt::Write as _;

use super::frame::{Frame, pen_stroke};
use super::scale::{ColorScale, hex};
use super::{INK, escaped};
use crate::analysis::Pen;
use crate::analysis::axis::{Axis, Steps};
use crate::analysis::chart::{Body, Chart, Line, Map, Panel};
use crate::export::Origin;
use crate::render::false_colour::sequential;

/// Size of a panel.
const PANEL: [f64; 2] = [480.0, 340.0];

/// Space for the title.
const TITLE: f64 = 40.0;

/// Frame of a panel: left, right, bottom, top.
const FRAME: [f64; 4] = [78.0, 462.0, 284.0, 30.0];

/// How far a map's frame ends above that of curves, for its scale.
const SCALE: f64 = 58.0;

/// Height of a row of the legend.
const ROW: f64 = 17.0;

/// A chart on white.
pub fn chart(chart: &Chart, origin: Origin) -> String {
    let columns = chart.panels.len().clamp(1, 2);
    let rows = chart.panels.len().div_ceil(columns);
    let (width, height) = (PANEL[0] * columns as f64, TITLE + PANEL[1] * rows as f64);
    let title = escaped(&chart.title);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
         viewBox=\"0 0 {width} {height}\" role=\"img\" font-family=\"Ubuntu, Helvetica, Arial, sans-serif\" \
         font-size=\"12\" fill=\"{INK}\">\n<title>{title}</title>\n<desc>{}</desc>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#ffffff\"/>\n\
         <text x=\"{}\" y=\"26\" font-size=\"16\">{title}</text>\n",
        escaped(&origin.line()),
        FRAME[0]
    );
    for (i, panel) in chart.panels.iter().enumerate() {
        let (x, y) = (PANEL[0] * (i % columns) as f64, TITLE + PANEL[1] * (i / columns) as f64);
        let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">");
        draw(&mut svg, i, panel);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

fn draw(svg: &mut String, index: usize, panel: &Panel) {
    let [left, right, bottom, top] = FRAME;
    let _ = writeln!(svg, "<text x=\"{left}\" y=\"{}\" font-size=\"13\">{}</text>", top - 8.0, escaped(&panel.title));
    let clip = format!("panel-{index}");
    match &panel.body {
        Body::Lines(lines) => {
            let frame = Frame { x: abscissa(lines), y: ordinate(lines, [bottom, top]), clip };
            frame.grid(svg, true);
            for (i, line) in lines.iter().enumerate() {
                frame.polyline(svg, &line.x, &line.y, &stroke(i, line));
            }
            finish(svg, &frame, panel);
            legend(svg, [right, top], lines);
        }
        Body::Map(map) => {
            let y = Axis::new(map.y, [bottom - SCALE, top], Steps::Decimal);
            let frame = Frame { x: Axis::new(map.x, [left, right], Steps::Degrees), y, clip };
            frame.grid(svg, true);
            cells(svg, &frame, map);
            finish(svg, &frame, panel);
            let span = scale_span(map);
            let label = escaped(&map.label);
            let middle = f64::midpoint(left, right);
            let _ = writeln!(svg, "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\">{label}</text>", bottom + 2.0);
            ColorScale { span, color, label: "", note: "" }.bar(svg, [left, right], bottom + 9.0);
        }
    }
}

fn finish(svg: &mut String, frame: &Frame, panel: &Panel) {
    frame.outline(svg);
    frame.label(svg, &panel.y_label);
    frame.label_x(svg, &panel.x_label);
}

fn abscissa(lines: &[Line]) -> Axis {
    let all = || lines.iter().flat_map(|line| line.x.iter().copied());
    let span = [all().fold(f64::INFINITY, f64::min), all().fold(f64::NEG_INFINITY, f64::max)];
    Axis::new(if span[1] > span[0] { span } else { [0.0, 1.0] }, [FRAME[0], FRAME[1]], Steps::Degrees)
}

fn ordinate(lines: &[Line], sides: [f64; 2]) -> Axis {
    let all = lines.iter().flat_map(|line| line.y.iter().copied());
    let greatest = all.filter(|y| y.is_finite()).fold(0.0, f64::max);
    Axis::widened([0.0, if greatest > 0.0 { greatest } else { 1.0 }], sides, Steps::Decimal, 6.0)
}

/// The attributes of the line of that index.
fn stroke(index: usize, line: &Line) -> String {
    pen_stroke(&Pen::numbered(index, line.dashed), 1.8)
}

/// The names of the lines, in the upper right corner.
fn legend(svg: &mut String, [right, top]: [f64; 2], lines: &[Line]) {
    let longest = lines.iter().map(|line| line.label.chars().count()).max().unwrap_or(0);
    let left = right - 48.0 - 6.5 * longest as f64;
    let (width, height) = (right - left, ROW * lines.len() as f64 + 6.0);
    let ground = "fill=\"#ffffff\" fill-opacity=\"0.85\"";
    let _ = writeln!(
        svg,
        "<rect x=\"{}\" y=\"{}\" width=\"{width}\" height=\"{height}\" {ground}/>",
        left - 4.0,
        top + 4.0
    );
    for (i, line) in lines.iter().enumerate() {
        let y = top + 6.0 + ROW * (i as f64 + 0.5);
        let _ = writeln!(svg, "<path d=\"M{left} {y}H{}\" {}/>", left + 30.0, stroke(i, line));
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\">{}</text>", left + 37.0, y + 4.0, escaped(&line.label));
    }
}

/// The cells of a map, each reaching under its neighbours so that none shows the ground between.
fn cells(svg: &mut String, frame: &Frame, map: &Map) {
    let span = scale_span(map);
    let ([left, right], [bottom, top]) = (frame.x.sides, frame.y.sides);
    let (width, height) = ((right - left) / map.columns as f64, (bottom - top) / map.rows() as f64);
    let _ = writeln!(svg, "<g clip-path=\"url(#{})\">", frame.clip);
    for (i, value) in map.values.iter().enumerate() {
        let x = left + width * (i % map.columns) as f64;
        let y = bottom - height * (i / map.columns + 1) as f64;
        let fill = hex(color(*value, span));
        let (wide, high) = (width + 0.6, height + 0.6);
        let _ = writeln!(
            svg,
            "<rect x=\"{x:.2}\" y=\"{:.2}\" width=\"{wide:.2}\" height=\"{high:.2}\" fill=\"{fill}\"/>",
            y - 0.6
        );
    }
    svg.push_str("</g>\n");
}

/// The values at the ends of a map's scale.
fn scale_span(map: &Map) -> [f64; 2] {
    match map.span() {
        Some([low, high]) if high > low => [low, high],
        Some([only, _]) => [only, only + 1.0],
        None => [0.0, 1.0],
    }
}

fn color(value: f64, [low, high]: [f64; 2]) -> [u8; 3] {
    sequential((value - low) / (high - low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(panels: Vec<Panel>) -> String {
        let origin = Origin { scene: "c" };
        let svg = chart(&Chart { title: "a < b".to_owned(), panels }, origin);
        if let Err(error) = crate::export::png::from_svg(&svg, 0.25, origin) {
            panic!("{error}:\n{svg}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf") && svg.contains("a &lt; b"), "{svg}");
        svg
    }

    fn panel(body: Body) -> Panel {
        let [title, x_label, y_label] = ["t", "x", "y"].map(String::from);
        Panel { title, x_label, y_label, body }
    }

    #[test]
    fn curves_are_drawn_and_named() {
        let line = Line::of("σ & τ", [0.0, 90.0], 10, |x| x);
        let svg = check(vec![panel(Body::Lines(vec![line.clone(), line.dashed()])); 3]);
        assert_eq!(svg.matches("σ &amp; τ").count(), 6, "names");
        assert_eq!(svg.matches("stroke-dasharray").count(), 6, "dashed, in the frame and in the legend");
    }

    #[test]
    fn a_map_has_a_cell_a_value_and_a_scale() {
        let map = Map { x: [0.0, 90.0], y: [0.0, 5.0], columns: 3, values: vec![1.0; 12], label: "α".to_owned() };
        check(vec![panel(Body::Map(map.clone()))]);
        let values = vec![0.0, 0.5, 1.0, f64::NAN, 0.2, 0.1];
        let svg = check(vec![panel(Body::Map(Map { values, ..map }))]);
        for shown in [hex(sequential(0.0)), hex(sequential(1.0)), hex(crate::render::false_colour::NOTHING)] {
            assert!(svg.contains(&shown), "no {shown}");
        }
    }

    #[test]
    fn odd_values_still_draw() {
        for y in [f64::NAN, f64::INFINITY, 0.0] {
            check(vec![panel(Body::Lines(vec![Line::of("odd", [0.0, 1.0], 3, |_| y)]))]);
            let map = Map { x: [0.0, 1.0], y: [0.0, 1.0], columns: 1, values: vec![y], label: String::new() };
            check(vec![panel(Body::Map(map))]);
        }
    }
}
