//! Curves on screen, by their pens.

use egui::{Color32, Mesh, Painter, Pos2, Shape, Stroke, Visuals, pos2};

use crate::analysis::Trace;
use crate::editor::theme;
use crate::shading::Method;

/// Width of the exact curve and of others, points.
const WIDTHS: [f32; 2] = [2.0, 1.6];
/// How much of its colour a curve keeps that is out of date, or beside one that is pointed at.
const FAINT: f32 = 0.35;
/// The same of a band.
const BAND: f32 = 0.3;

/// A curve, and how much it stands out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn<'a> {
    pub(super) trace: Trace<'a>,
    /// It is of an earlier state of the scene.
    pub(super) stale: bool,
    /// It is pointed at in the legend.
    pub(super) raised: bool,
    /// Another one is.
    pub(super) lowered: bool,
}

impl Drawn<'_> {
    fn color(&self, visuals: &Visuals) -> Color32 {
        let color = theme::pen_color(&self.trace.pen, visuals);
        if self.stale || self.lowered { color.gamma_multiply(FAINT) } else { color }
    }

    fn stroke(&self, visuals: &Visuals) -> Stroke {
        let [exact, other] = WIDTHS;
        let width = if self.trace.method == Some(Method::Exact) { exact } else { other };
        Stroke::new(if self.raised { 1.8 * width } else { width }, self.color(visuals))
    }

    /// A part of the curve through places on screen.
    pub(super) fn line(&self, places: &[Pos2], painter: &Painter, visuals: &Visuals) {
        painter.extend(dashed(places, self.trace.pen.dashes, self.stroke(visuals)));
    }

    /// A part of its band between places on screen.
    pub(super) fn band(&self, edges: &[[Pos2; 2]], painter: &Painter, visuals: &Visuals) {
        let color = self.color(visuals).gamma_multiply(BAND);
        let mut mesh = Mesh::default();
        for (i, [low, high]) in (0_u32..).zip(edges) {
            mesh.colored_vertex(*low, color);
            mesh.colored_vertex(*high, color);
            if let Some(before) = i.checked_sub(1) {
                let [a, b, c, d] = [2 * before, 2 * before + 1, 2 * i, 2 * i + 1];
                mesh.add_triangle(a, b, c);
                mesh.add_triangle(b, c, d);
            }
        }
        painter.add(mesh);
    }
}

/// Lines and dashes through points on screen.
pub(super) fn dashed(points: &[Pos2], dashes: &[f32], stroke: Stroke) -> Vec<Shape> {
    let (lengths, gaps): (Vec<f32>, Vec<f32>) = dashes.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
    if lengths.is_empty() || points.len() < 2 {
        return vec![Shape::line(points.to_vec(), stroke)];
    }
    Shape::dashed_line_with_offset(points, stroke, &lengths, &gaps, 0.0)
}

/// A place of the picture on screen.
#[expect(clippy::cast_possible_truncation, reason = "a place on screen")]
pub(super) fn place([x, y]: [f64; 2]) -> Pos2 {
    pos2(x as f32, y as f32)
}
