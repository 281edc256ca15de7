//! The world's axes in a corner.

use egui::{Align2, Color32, FontId, Painter, Pos2, Stroke, Vec2};
use glam::DVec3;

use crate::editor::handles::AXIS_COLORS;
use crate::editor::viewport::projection::Projection;

/// Length of an axis, points.
const SIZE: f32 = 26.0;

/// Draw the world's axes as the camera sees them about `center`, those that point away first.
pub fn paint_gnomon(projection: &Projection, center: Pos2, painter: &Painter) {
    let [right, up] = projection.right_up();
    let forward = projection.forward();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| DVec3::AXES[*b].dot(forward).total_cmp(&DVec3::AXES[*a].dot(forward)));
    painter.circle_filled(center, SIZE + 10.0, Color32::from_black_alpha(60));
    for axis in order {
        let direction = DVec3::AXES[axis];
        let tip = center + SIZE * screen_vec(direction.dot(right), -direction.dot(up));
        let color = AXIS_COLORS[axis];
        painter.line_segment([center, tip], Stroke::new(2.0, color));
        painter.circle_filled(tip, 6.5, color);
        let name = ["X", "Y", "Z"][axis];
        painter.text(tip, Align2::CENTER_CENTER, name, FontId::proportional(9.5), Color32::from_black_alpha(230));
    }
}

#[expect(clippy::cast_possible_truncation, reason = "egui's screen coordinates are f32")]
fn screen_vec(x: f64, y: f64) -> Vec2 {
    Vec2::new(x as f32, y as f32)
}
