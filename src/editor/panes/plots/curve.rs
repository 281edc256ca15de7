//! A method's curve in a plot, drawn by the method's pen.

use std::ops::RangeInclusive;

use egui::{Color32, Pos2, Shape, Stroke, Ui, Visuals};
use egui_plot::{ClosestElem, Line, PlotBounds, PlotGeometry, PlotItem, PlotItemBase, PlotPoints, PlotTransform};

use crate::editor::theme;
use crate::shading::Method;

/// A line with the dashes of any pen; `egui_plot` itself knows only dashes of one length.
pub(super) struct Curve<'a> {
    line: Line<'a>,
    dashes: &'static [f32],
    stroke: Stroke,
}

impl<'a> Curve<'a> {
    /// The curve of a method through `points`.
    pub(super) fn new(method: Method, points: PlotPoints<'a>, width: f32, visuals: &Visuals) -> Self {
        let (color, dashes) = theme::method_pen(method, visuals);
        let stroke = Stroke::new(width, color);
        let line = Line::new(method.to_string(), points).stroke(stroke).allow_band(dashes.is_empty());
        Self { line, dashes, stroke }
    }
}

/// Lines and dashes through points on screen.
pub(super) fn dashed(points: &[Pos2], dashes: &[f32], stroke: Stroke) -> Vec<Shape> {
    let (lengths, gaps): (Vec<f32>, Vec<f32>) = dashes.chunks_exact(2).map(|pair| (pair[0], pair[1])).unzip();
    if lengths.is_empty() {
        return vec![Shape::line(points.to_vec(), stroke)];
    }
    Shape::dashed_line_with_offset(points, stroke, &lengths, &gaps, 0.0)
}

impl PlotItem for Curve<'_> {
    fn shapes(&self, ui: &Ui, transform: &PlotTransform, shapes: &mut Vec<Shape>) {
        let mut whole = Vec::new();
        self.line.shapes(ui, transform, &mut whole);
        let width = if self.highlighted() { 2.0 * self.stroke.width } else { self.stroke.width };
        let stroke = Stroke::new(width, self.stroke.color);
        for shape in whole {
            match shape {
                Shape::Path(path) if !self.dashes.is_empty() => {
                    shapes.extend(dashed(&path.points, self.dashes, stroke));
                }
                Shape::LineSegment { points, .. } if !self.dashes.is_empty() => {
                    shapes.extend(dashed(&points, self.dashes, stroke));
                }
                other => shapes.push(other),
            }
        }
    }

    fn find_closest(&self, point: Pos2, transform: &PlotTransform) -> Option<ClosestElem> {
        self.line.find_closest(point, transform)
    }

    fn initialize(&mut self, x_range: RangeInclusive<f64>) {
        self.line.initialize(x_range);
    }

    fn color(&self) -> Color32 {
        self.stroke.color
    }

    fn base(&self) -> &PlotItemBase {
        self.line.base()
    }

    fn base_mut(&mut self) -> &mut PlotItemBase {
        self.line.base_mut()
    }

    fn geometry(&self) -> PlotGeometry<'_> {
        self.line.geometry()
    }

    fn bounds(&self) -> PlotBounds {
        self.line.bounds()
    }
}
