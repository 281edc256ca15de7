//! The probe of a plot.

use egui::{Align2, Color32, Painter, Stroke, vec2};

use super::label;
use crate::analysis::probe;
use crate::editor::viewport::projection::Projection;
use crate::scene::{Plot, PlotKind};

/// Length of the normal's arrow, points.
pub const NORMAL: f64 = 40.0;

/// Colour of a probe that is not selected.
const COLOR: Color32 = Color32::from_rgb(0x5f, 0xd3, 0xc6);

/// Draw where a plot's probe is and its normal; when it is held or selected in `accent` and with its name.
pub fn paint_probe(plot: &Plot, chosen: bool, accent: Color32, projection: &Projection, painter: &Painter) {
    let Some(at) = projection.project(plot.position) else { return };
    let color = if chosen { accent } else { COLOR };
    let normal = plot.normal.normalize_or(glam::DVec3::Z);
    let stroke = Stroke::new(1.75, color);
    if let Some(tip) = projection.project(plot.position + NORMAL * projection.metres_per_point(plot.position) * normal)
        && tip.distance(at) > 6.0
    {
        let along = (tip - at).normalized();
        let across = 3.5 * along.rot90();
        painter.line_segment([at, tip - 6.0 * along], stroke);
        let head = vec![tip, tip - 9.0 * along + across, tip - 9.0 * along - across];
        painter.add(egui::Shape::convex_polygon(head, color, Stroke::NONE));
    }
    painter.circle(at, 5.0, Color32::from_black_alpha(140), stroke);
    painter.circle_filled(at, 1.75, color);
    if chosen {
        label(&plot.name, at + vec2(10.0, 8.0), Align2::LEFT_TOP, color, painter);
    }
}

/// Draw the probe of a plot as it is at the abscissa that is pointed at in its curves.
pub fn paint_probe_at(plot: &Plot, x: f64, color: Color32, projection: &Projection, painter: &Painter) {
    let at = probe(plot, x);
    let direction = if plot.kind == PlotKind::View { at.v } else { at.n };
    let tip = at.p + NORMAL * projection.metres_per_point(at.p) * direction;
    let (Some(foot), Some(end)) = (projection.project(at.p), projection.project(tip)) else { return };
    painter.line_segment([foot, end], Stroke::new(1.25, color));
    painter.circle_filled(end, 2.5, color);
    painter.circle_stroke(foot, 3.0, Stroke::new(1.25, color));
}
