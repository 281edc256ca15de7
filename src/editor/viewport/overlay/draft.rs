//! What is being drawn, with its dimensions at the cursor.

use egui::{Align2, Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, vec2};
use glam::{DVec2, DVec3};

use super::{REFUSED, label, length_text, line};
use crate::editor::session::Tool;
use crate::editor::tools::outline::OutlineKind;
use crate::editor::tools::polygon::PolygonDraft;
use crate::editor::tools::{Draft, Pen};
use crate::editor::viewport::projection::Projection;

/// Length of the arrow that shows to which side a light would shine, points.
const ARROW: f64 = 34.0;
/// Room for the dimensions beside the pointer, points.
const TEXT_SIZE: Vec2 = vec2(200.0, 34.0);
/// Dots and gaps of a line to a corner that is stuck to, points.
const DOTTED: f32 = 5.0;

/// The pointer over the work plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cursor {
    /// On screen.
    pub pos: Pos2,
    /// On the work plane, where a click would draw.
    pub at: DVec2,
    /// Whether it is on a polygon's first vertex, so that a click closes.
    pub on_first: bool,
    /// The corner of a light or surface that it sticks to.
    pub corner: Option<DVec3>,
}

/// Where and with what to paint.
struct Brush<'a> {
    pen: &'a Pen,
    accent: Color32,
    projection: &'a Projection,
    painter: &'a Painter,
}

/// Draw the draft as a click at `cursor` would continue it, measured where `measured` says so.
pub fn paint_draft(
    draft: &Draft,
    pen: &Pen,
    cursor: Option<Cursor>,
    measured: bool,
    accent: Color32,
    projection: &Projection,
    painter: &Painter,
) {
    let brush = Brush { pen, accent, projection, painter };
    match draft {
        Draft::Nothing => {}
        Draft::Polygon(polygon) => brush.polygon(polygon, cursor),
        Draft::Span(from) => brush.span(*from, cursor),
    }
    let Some(cursor) = cursor else { return };
    if let Some(corner) = cursor.corner {
        brush.corner(corner, cursor.at);
    }
    brush.crosshair(cursor.at);
    if pen.tool != Tool::Line && pen.tool != Tool::Sphere {
        brush.lit_side(cursor.at);
    }
    if measured {
        let text = dimensions(draft, pen, &cursor);
        let (at, anchor) = beside(cursor.pos, projection.rect());
        label(&text, at, anchor, Color32::WHITE, painter);
    }
}

/// Where text stands beside the pointer so that a view that fills `rect` has room for it, and which corner of it.
fn beside(pos: Pos2, rect: Rect) -> (Pos2, Align2) {
    let left = pos.x + TEXT_SIZE.x <= rect.right();
    let below = pos.y + TEXT_SIZE.y <= rect.bottom();
    let anchor = match (left, below) {
        (true, true) => Align2::LEFT_TOP,
        (true, false) => Align2::LEFT_BOTTOM,
        (false, true) => Align2::RIGHT_TOP,
        (false, false) => Align2::RIGHT_BOTTOM,
    };
    let away = |to_right_or_below: bool, by: f32| if to_right_or_below { by } else { -by };
    (pos + vec2(away(left, 16.0), away(below, 14.0)), anchor)
}

/// What is measured, for people.
fn dimensions(draft: &Draft, pen: &Pen, cursor: &Cursor) -> String {
    match draft {
        Draft::Nothing => {
            let p = pen.canvas.frame.point(cursor.at);
            format!("{:.2}, {:.2}, {:.2} m", p.x, p.y, p.z)
        }
        Draft::Polygon(polygon) => {
            let Some(last) = polygon.vertices().last() else { return String::new() };
            let edge = heading_text(*last, cursor.at);
            let area = polygon.area_with(cursor.at);
            match polygon.vertices().len() {
                _ if cursor.on_first => format!("{edge}   {}   closes", area_text(area)),
                1 => edge,
                _ => format!("{edge}   {}", area_text(area)),
            }
        }
        Draft::Span(from) => {
            let size = (cursor.at - *from).abs();
            if pen.is_by_corners() {
                return format!("{} × {}   {}", length_text(size.x), length_text(size.y), area_text(size.x * size.y));
            }
            match (pen.tool, pen.outline.kind) {
                (Tool::Line, _) => heading_text(*from, cursor.at),
                (Tool::Outline, OutlineKind::Letter) => format!("{} high", length_text(2.0 * size.length())),
                (Tool::Outline, OutlineKind::Regular | OutlineKind::Star) => {
                    format!("r {}", heading_text(*from, cursor.at))
                }
                _ => format!("r {}", length_text(size.length())),
            }
        }
    }
}

/// A length and its direction.
fn heading_text(from: DVec2, to: DVec2) -> String {
    let along = to - from;
    let angle = along.y.atan2(along.x).to_degrees() + 0.0;
    format!("{}  at {angle:.1}°", length_text(along.length()))
}

/// An area for people: square metres above a tenth of one, else square centimetres.
fn area_text(area: f64) -> String {
    if area < 0.1 { format!("{:.0} cm²", 1e4 * area) } else { format!("{area:.2} m²") }
}

impl Brush<'_> {
    fn place(&self, p: DVec2) -> DVec3 {
        self.pen.canvas.frame.point(p)
    }

    fn line(&self, a: DVec2, b: DVec2, stroke: Stroke) {
        line(self.place(a), self.place(b), stroke, self.projection, self.painter);
    }

    fn dot(&self, p: DVec2, radius: f32) {
        if let Some(at) = self.projection.project(self.place(p)) {
            self.painter.circle(at, radius, self.accent, Stroke::new(1.5, Color32::from_black_alpha(190)));
        }
    }

    fn polygon(&self, polygon: &PolygonDraft, cursor: Option<Cursor>) {
        let vertices = polygon.vertices();
        for edge in vertices.windows(2) {
            self.line(edge[0], edge[1], Stroke::new(2.0, self.accent));
        }
        if let (Some(cursor), Some(last), Some(first)) = (cursor, vertices.last(), vertices.first()) {
            let fault = if cursor.on_first { polygon.closing_fault() } else { polygon.edge_fault(cursor.at) };
            let color = if fault.is_none() { self.accent } else { REFUSED };
            if fault.is_none() && !cursor.on_first && vertices.len() >= 2 {
                self.line(cursor.at, *first, Stroke::new(1.0, self.accent.gamma_multiply(0.4)));
            }
            self.line(*last, cursor.at, Stroke::new(2.0, color));
        }
        for (i, vertex) in vertices.iter().enumerate() {
            let closes = i == 0 && cursor.is_some_and(|cursor| cursor.on_first);
            self.dot(*vertex, if closes { 7.0 } else { 4.0 });
        }
    }

    fn span(&self, from: DVec2, cursor: Option<Cursor>) {
        if let Some(to) = cursor.map(|cursor| cursor.at) {
            match self.pen.tool {
                Tool::Line => self.line(from, to, Stroke::new(3.0, self.accent)),
                Tool::Sphere => self.sphere(from, to),
                Tool::Textured => self.rectangle(from, to),
                _ => self.outline(from, to),
            }
        }
        self.dot(from, 4.0);
    }

    fn sphere(&self, center: DVec2, to: DVec2) {
        let radius = center.distance(to);
        let frame = &self.pen.canvas.frame;
        let faint = Stroke::new(1.0, self.accent.gamma_multiply(0.5));
        self.circle(center, radius, [frame.u, frame.v], Stroke::new(2.0, self.accent));
        self.circle(center, radius, self.projection.right_up(), faint);
        self.line(center, to, faint);
    }

    fn circle(&self, center: DVec2, radius: f64, [u, v]: [DVec3; 2], stroke: Stroke) {
        const SEGMENTS: u32 = 64;
        let center = self.place(center);
        let at = |i: u32| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(SEGMENTS)).sin_cos();
            center + radius * (cos * u + sin * v)
        };
        let pieces = (0..SEGMENTS).filter_map(|i| self.projection.segment(at(i), at(i + 1)));
        self.painter.extend(pieces.map(|segment| Shape::line_segment(segment, stroke)));
    }

    fn rectangle(&self, from: DVec2, to: DVec2) {
        let corners = [from, DVec2::new(to.x, from.y), to, DVec2::new(from.x, to.y)];
        self.closed(&corners, Stroke::new(2.0, self.accent));
        let faint = Stroke::new(1.0, self.accent.gamma_multiply(0.35));
        self.line(from, to, faint);
        self.line(corners[1], corners[3], faint);
    }

    fn outline(&self, from: DVec2, to: DVec2) {
        if let Ok(vertices) = self.pen.outline.vertices(from, to) {
            self.closed(&vertices, Stroke::new(2.0, self.accent));
        }
        if !self.pen.is_by_corners() {
            self.line(from, to, Stroke::new(1.0, self.accent.gamma_multiply(0.35)));
        }
    }

    fn closed(&self, vertices: &[DVec2], stroke: Stroke) {
        for (a, b) in vertices.iter().zip(vertices.iter().cycle().skip(1)) {
            self.line(*a, *b, stroke);
        }
    }

    fn crosshair(&self, p: DVec2) {
        let Some(at) = self.projection.project(self.place(p)) else { return };
        for arm in [vec2(1.0, 0.0), vec2(0.0, 1.0)] {
            self.painter.line_segment([at - 5.0 * arm, at + 5.0 * arm], Stroke::new(1.0, self.accent));
        }
    }

    /// A mark on the corner that is stuck to, and a dotted line from there where the work plane is elsewhere.
    fn corner(&self, corner: DVec3, at: DVec2) {
        let (Some(corner), Some(at)) = (self.projection.project(corner), self.projection.project(self.place(at)))
        else {
            return;
        };
        let stroke = Stroke::new(1.5, self.accent);
        let mark = Rect::from_center_size(at, vec2(11.0, 11.0));
        self.painter.rect_stroke(mark, 0.0, stroke, egui::StrokeKind::Middle);
        self.painter.extend(Shape::dotted_line(&[corner, at], self.accent, DOTTED, 1.0));
    }

    /// A short arrow to the side to which a light drawn here would shine.
    fn lit_side(&self, at: DVec2) {
        let from = self.place(at);
        let reach = ARROW * self.projection.metres_per_point(from);
        let tip = from + reach * self.pen.canvas.lit();
        if let (Some(from), Some(tip)) = (self.projection.project(from), self.projection.project(tip)) {
            let stroke = Stroke::new(1.5, self.accent.gamma_multiply(0.8));
            self.painter.arrow(from, tip - from, stroke);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::outline::Outline;
    use glam::dvec2;

    fn text(tool: Tool, kind: OutlineKind, draft: &Draft, at: DVec2) -> String {
        let pen = Pen { tool, outline: Outline { kind, ..Outline::default() }, canvas: 2.0.into() };
        dimensions(draft, &pen, &Cursor { pos: Pos2::ZERO, at, on_first: false, corner: None })
    }

    #[test]
    fn every_tool_measures_what_it_makes() {
        let span = Draft::Span(dvec2(1.0, 1.0));
        let at = dvec2(1.3, 1.4);
        for (tool, kind, expected) in [
            (Tool::Line, OutlineKind::Rectangle, "50.0 cm  at 53.1°"),
            (Tool::Sphere, OutlineKind::Rectangle, "r 50.0 cm"),
            (Tool::Textured, OutlineKind::Star, "30.0 cm × 40.0 cm   0.12 m²"),
            (Tool::Outline, OutlineKind::Ell, "30.0 cm × 40.0 cm   0.12 m²"),
            (Tool::Outline, OutlineKind::Disk, "r 50.0 cm"),
            (Tool::Outline, OutlineKind::Star, "r 50.0 cm  at 53.1°"),
            (Tool::Outline, OutlineKind::Letter, "1.00 m high"),
        ] {
            assert_eq!(text(tool, kind, &span, at), expected, "{tool:?}, {kind:?}");
        }
    }

    #[test]
    fn dimensions_stand_within_the_view() {
        let rect = Rect::from_min_size(Pos2::ZERO, vec2(600.0, 400.0));
        for (pos, anchor) in [
            (Pos2::new(300.0, 200.0), Align2::LEFT_TOP),
            (Pos2::new(580.0, 200.0), Align2::RIGHT_TOP),
            (Pos2::new(300.0, 390.0), Align2::LEFT_BOTTOM),
            (Pos2::new(580.0, 390.0), Align2::RIGHT_BOTTOM),
        ] {
            let (at, found) = beside(pos, rect);
            assert_eq!(found, anchor, "at {pos:?}");
            assert!(rect.contains_rect(anchor.anchor_size(at, vec2(170.0, 16.0))), "at {pos:?}");
        }
    }

    #[test]
    fn a_polygon_shows_its_edge_and_from_the_third_corner_its_area() {
        let mut polygon = PolygonDraft::default();
        let nothing = text(Tool::Polygon, OutlineKind::default(), &Draft::Nothing, dvec2(0.5, -0.25));
        assert_eq!(nothing, "0.50, -0.25, 2.00 m", "where it begins");
        polygon.click(dvec2(0.0, 0.0), false);
        let draft = Draft::Polygon(polygon.clone());
        assert_eq!(text(Tool::Polygon, OutlineKind::default(), &draft, dvec2(2.0, 0.0)), "2.00 m  at 0.0°", "an edge");
        polygon.click(dvec2(2.0, 0.0), false);
        let draft = Draft::Polygon(polygon);
        let triangle = text(Tool::Polygon, OutlineKind::default(), &draft, dvec2(2.0, 0.5));
        assert_eq!(triangle, "50.0 cm  at 90.0°   0.50 m²", "with its area");
    }
}
