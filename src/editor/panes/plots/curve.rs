//! Curves on screen, by their pens.

use std::ops::RangeInclusive;

use egui::{Color32, Mesh, Painter, Pos2, Shape, Stroke, Ui, Visuals, pos2};
use egui_plot::{FilledArea, Line, PlotBounds, PlotGeometry, PlotItem, PlotItemBase, PlotTransform};

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

    /// A part of the curve through points of a plot.
    pub(super) fn curve(&self, points: Vec<[f64; 2]>, visuals: &Visuals) -> Curve {
        let stroke = self.stroke(visuals);
        let line = Line::new("curve", points).stroke(stroke).allow_band(false);
        Curve { line, dashes: self.trace.pen.dashes, stroke }
    }

    /// Its band between points of a plot.
    pub(super) fn area(&self, edges: &[[[f64; 2]; 2]], visuals: &Visuals) -> FilledArea {
        let column = |of: fn(&[[f64; 2]; 2]) -> f64| edges.iter().map(of).collect::<Vec<_>>();
        let [x, low, high] = [column(|[low, _]| low[0]), column(|[low, _]| low[1]), column(|[_, high]| high[1])];
        FilledArea::new("band", &x, &low, &high).fill_color(self.color(visuals).gamma_multiply(BAND))
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

/// A line with the dashes of any pen; `egui_plot` itself knows only dashes of one length.
pub(super) struct Curve {
    line: Line<'static>,
    dashes: &'static [f32],
    stroke: Stroke,
}

impl PlotItem for Curve {
    fn shapes(&self, ui: &Ui, transform: &PlotTransform, shapes: &mut Vec<Shape>) {
        let mut whole = Vec::new();
        self.line.shapes(ui, transform, &mut whole);
        for shape in whole {
            match shape {
                Shape::Path(path) => shapes.extend(dashed(&path.points, self.dashes, self.stroke)),
                other => shapes.push(other),
            }
        }
    }

    fn initialize(&mut self, x_range: RangeInclusive<f64>) {
        self.line.initialize(x_range);
    }

    fn color(&self) -> Color32 {
        self.stroke.color
    }

    fn geometry(&self) -> PlotGeometry<'_> {
        self.line.geometry()
    }

    fn bounds(&self) -> PlotBounds {
        self.line.bounds()
    }

    fn base(&self) -> &PlotItemBase {
        self.line.base()
    }

    fn base_mut(&mut self) -> &mut PlotItemBase {
        self.line.base_mut()
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
