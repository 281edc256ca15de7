//! What is being drawn, with its dimensions at the cursor.

use egui::{Align2, Color32, Painter, Pos2, Shape, Stroke, vec2};
use glam::{DVec2, DVec3};

use super::{REFUSED, label, length_text, line};
use crate::editor::tools::Draft;
use crate::editor::viewport::projection::Projection;

/// The pointer over the work plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// On screen.
    pub pos: Pos2,
    /// On the work plane, on its grid where that is wanted.
    pub at: DVec2,
    /// Whether it is on a polygon's first vertex, so that a click closes.
    pub on_first: bool,
}

/// Draw the draft at `height` as a click at `cursor` would continue it.
pub fn paint_draft(
    draft: &Draft,
    cursor: Option<Cursor>,
    height: f64,
    accent: Color32,
    projection: &Projection,
    painter: &Painter,
) {
    let place = |p: DVec2| p.extend(height);
    let stroke = Stroke::new(2.0, accent);
    let dot = |p: DVec2, radius: f32, color: Color32| {
        if let Some(at) = projection.project(place(p)) {
            painter.circle(at, radius, color, Stroke::new(1.5, Color32::from_black_alpha(190)));
        }
    };
    let mut text = String::new();
    match draft {
        Draft::Nothing => {}
        Draft::Polygon(polygon) => {
            let vertices = polygon.vertices();
            for edge in vertices.windows(2) {
                line(place(edge[0]), place(edge[1]), stroke, projection, painter);
            }
            if let (Some(cursor), Some(last), Some(first)) = (cursor, vertices.last(), vertices.first()) {
                let to = if cursor.on_first { *first } else { cursor.at };
                let fine = if cursor.on_first { polygon.closes() } else { polygon.accepts(to) };
                let color = if fine { accent } else { REFUSED };
                if fine && !cursor.on_first && vertices.len() >= 2 {
                    let closing = Stroke::new(1.0, accent.gamma_multiply(0.4));
                    line(place(to), place(*first), closing, projection, painter);
                }
                line(place(*last), place(to), Stroke::new(2.0, color), projection, painter);
                text = polygon_text(*last, to, cursor.on_first && fine);
            }
            for (i, vertex) in vertices.iter().enumerate() {
                let closes = i == 0 && cursor.is_some_and(|cursor| cursor.on_first);
                dot(*vertex, if closes { 7.0 } else { 4.0 }, accent);
            }
        }
        Draft::Line(start) => {
            if let Some(cursor) = cursor {
                let width = Stroke::new(3.0, accent);
                line(place(*start), place(cursor.at), width, projection, painter);
                text = length_text(start.distance(cursor.at));
            }
            dot(*start, 4.0, accent);
        }
        Draft::Sphere(center, p) => {
            let radius = center.distance(*p);
            let [right, up] = projection.right_up();
            circle(place(*center), radius, [DVec3::X, DVec3::Y], stroke, projection, painter);
            let faint = Stroke::new(1.0, accent.gamma_multiply(0.5));
            circle(place(*center), radius, [right, up], faint, projection, painter);
            line(place(*center), place(*p), faint, projection, painter);
            dot(*center, 4.0, accent);
            text = format!("r {}", length_text(radius));
        }
    }
    let Some(cursor) = cursor else { return };
    if draft.is_empty() {
        text = format!("{:.2}, {:.2}, {height:.2} m", cursor.at.x, cursor.at.y);
    }
    if let Some(at) = projection.project(place(cursor.at)) {
        crosshair(at, accent, painter);
    }
    if !text.is_empty() {
        label(&text, cursor.pos + vec2(16.0, 14.0), Align2::LEFT_TOP, Color32::WHITE, painter);
    }
}

/// Length of the edge being drawn, and how far that is along X and Y.
fn polygon_text(from: DVec2, to: DVec2, closes: bool) -> String {
    let along = to - from;
    let length = length_text(along.length());
    if closes { format!("{length}  closes") } else { format!("{length}   Δ {:.2}, {:.2}", along.x, along.y) }
}

fn crosshair(at: Pos2, color: Color32, painter: &Painter) {
    for arm in [vec2(1.0, 0.0), vec2(0.0, 1.0)] {
        painter.line_segment([at - 5.0 * arm, at + 5.0 * arm], Stroke::new(1.0, color));
    }
}

fn circle(center: DVec3, radius: f64, [u, v]: [DVec3; 2], stroke: Stroke, projection: &Projection, painter: &Painter) {
    const SEGMENTS: u32 = 64;
    let at = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(SEGMENTS)).sin_cos();
        center + radius * (cos * u + sin * v)
    };
    painter.extend(
        (0..SEGMENTS)
            .filter_map(|i| projection.segment(at(i), at(i + 1)))
            .map(|segment| Shape::line_segment(segment, stroke)),
    );
}
