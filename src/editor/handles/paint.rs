//! How handles look.

use egui::{Color32, Painter, Pos2, Shape, Stroke, Vec2};

use super::{CIRCLE, DOT, Handle, Outline, Spot};

/// Colours of the axes X, Y, Z.
pub const AXIS_COLORS: [Color32; 3] =
    [Color32::from_rgb(0xf0, 0x5a, 0x5a), Color32::from_rgb(0x7c, 0xc9, 0x4f), Color32::from_rgb(0x4f, 0x94, 0xf0)];
/// What the pointer is on or holds.
const HOT: Color32 = Color32::from_rgb(0xff, 0xf0, 0xa8);
/// Handles on a light's own shape.
const PLAIN: Color32 = Color32::from_rgb(0xff, 0xff, 0xff);
/// Around handles, so that they are seen on any background.
const RIM: Color32 = Color32::from_black_alpha(190);

/// Draw the handles, `hot` highlighted.
pub fn paint(spots: &[Spot], hot: Option<Handle>, painter: &Painter) {
    // What wins when hit is drawn last.
    for spot in spots.iter().rev() {
        let is_hot = hot == Some(spot.handle);
        let color = if is_hot { HOT } else { color(spot.handle) };
        match &spot.outline {
            Outline::Dot(at) => {
                painter.circle(*at, if is_hot { 6.0 } else { DOT }, color, Stroke::new(1.5, RIM));
            }
            Outline::Pin([from, to]) => {
                underlined([*from, *to], color.gamma_multiply(0.7), 1.0, painter);
                painter.circle(*to, if is_hot { 6.0 } else { DOT }, color, Stroke::new(1.5, RIM));
            }
            Outline::Circle(at) => {
                let width = width(is_hot);
                painter.circle_stroke(*at, CIRCLE, Stroke::new(width + 2.0, RIM));
                painter.circle_stroke(*at, CIRCLE, Stroke::new(width, color));
            }
            Outline::Diamond(at) => diamond(*at, if is_hot { 6.0 } else { DOT }, color, painter),
            Outline::Arrow(shaft) => arrow(*shaft, color, is_hot, painter),
            Outline::Lever([from, to]) => {
                underlined([*from, *to], color, width(is_hot), painter);
                let knob = egui::Rect::from_center_size(*to, Vec2::splat(if is_hot { 11.0 } else { 9.0 }));
                painter.rect(knob, 1.5, color, Stroke::new(1.0, RIM), egui::StrokeKind::Outside);
            }
            Outline::Patch(corners) => {
                let fill = color.gamma_multiply(if is_hot { 0.8 } else { 0.4 });
                painter.add(Shape::convex_polygon(corners.to_vec(), fill, Stroke::new(1.0, color)));
            }
            Outline::Ring(pieces) => {
                let lined = |width: f32, color: Color32| {
                    painter.extend(pieces.iter().map(|piece| Shape::line_segment(*piece, Stroke::new(width, color))));
                };
                lined(width(is_hot) + 1.5, RIM.gamma_multiply(0.5));
                lined(width(is_hot), color);
            }
        }
    }
}

fn width(hot: bool) -> f32 {
    if hot { 3.0 } else { 2.0 }
}

fn color(handle: Handle) -> Color32 {
    match handle {
        Handle::Axis(axis) | Handle::Plane(axis) | Handle::Ring(axis) | Handle::Stretch(axis) => AXIS_COLORS[axis],
        _ => PLAIN,
    }
}

/// A shaft with a slender head, thinly rimmed.
fn arrow([from, to]: [Pos2; 2], color: Color32, hot: bool, painter: &Painter) {
    let along = (to - from).normalized();
    let across = along.rot90();
    let (length, half) = if hot { (15.0, 6.0) } else { (13.0, 5.0) };
    let root = to - length * along;
    underlined([from + 8.0 * along, root], color, width(hot), painter);
    let head = vec![to, root + half * across, root - half * across];
    painter.add(Shape::convex_polygon(head, color, Stroke::new(1.0, RIM)));
}

/// A line with a dark rim.
fn underlined(segment: [Pos2; 2], color: Color32, width: f32, painter: &Painter) {
    painter.line_segment(segment, Stroke::new(width + 1.5, RIM.gamma_multiply(0.5)));
    painter.line_segment(segment, Stroke::new(width, color));
}

fn diamond(at: Pos2, half: f32, color: Color32, painter: &Painter) {
    let corners = [Vec2::X, Vec2::Y, -Vec2::X, -Vec2::Y].map(|corner| at + half * corner);
    painter.add(Shape::convex_polygon(corners.to_vec(), color, Stroke::new(1.5, RIM)));
}
