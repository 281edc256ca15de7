//! What is painted over the picture: grid, lights, what is being drawn, the probe, the world's axes.

mod draft;
mod fit;
mod gnomon;
mod grid;
mod lights;
mod probe;

pub use draft::{Cursor, paint_draft};
pub use fit::paint_fit;
pub use gnomon::paint_gnomon;
pub use grid::{Grid, paint_work_plane};
pub use lights::{Marks, paint_lights, paint_outline};
pub use probe::{NORMAL as PROBE_NORMAL, paint_probe, paint_probe_at};

use egui::{Align2, Color32, FontId, Painter, Pos2, Rect, Stroke, Vec2, vec2};
use glam::DVec3;

use super::pick::Solids;
use super::projection::Projection;

/// A line that may not be, or a shape that is refused.
pub const REFUSED: Color32 = Color32::from_rgb(0xff, 0x45, 0x45);
/// Names and numbers.
pub const TEXT: Color32 = Color32::from_rgb(0xf0, 0xf2, 0xf4);

/// Behind small text and numbers.
pub const PLATE: Color32 = Color32::from_black_alpha(165);

/// A straight line of the world.
fn line(a: DVec3, b: DVec3, stroke: Stroke, projection: &Projection, painter: &Painter) {
    if let Some(segment) = projection.segment(a, b) {
        painter.line_segment(segment, stroke);
    }
}

/// The box of which these are the corners, counted in binary, faint where surfaces hide it.
pub fn paint_box(corners: &[DVec3], color: Color32, solids: &Solids, projection: &Projection, painter: &Painter) {
    let eye = projection.camera().eye;
    for (i, a) in corners.iter().enumerate() {
        for bit in [1, 2, 4] {
            let Some(b) = corners.get(i | bit).filter(|_| i & bit == 0) else { continue };
            let hidden = solids.hide(eye, a.midpoint(*b));
            let color = if hidden { color.gamma_multiply(0.25) } else { color.gamma_multiply(0.8) };
            line(*a, *b, Stroke::new(1.0, color), projection, painter);
        }
    }
}

/// Small text on a dark plate above `pos`, or beside or below it where that would cover one of `taken`, to which it is
/// added. Where there is no room at all it is left out.
fn label_beside(text: &str, pos: Pos2, color: Color32, taken: &mut Vec<Rect>, painter: &Painter) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.0), color);
    let places = [
        (vec2(0.0, -7.0), Align2::CENTER_BOTTOM),
        (vec2(12.0, -2.0), Align2::LEFT_CENTER),
        (vec2(-12.0, -2.0), Align2::RIGHT_CENTER),
        (vec2(0.0, 10.0), Align2::CENTER_TOP),
        (vec2(0.0, -25.0), Align2::CENTER_BOTTOM),
        (vec2(0.0, 28.0), Align2::CENTER_TOP),
    ];
    let rects = places.map(|(offset, anchor)| anchor.anchor_size(pos + offset, galley.size()).expand2(PADDING));
    let is_free = |rect: &Rect| {
        painter.clip_rect().contains_rect(*rect) && taken.iter().all(|other: &Rect| !other.intersects(*rect))
    };
    let Some(plate) = rects.into_iter().find(is_free) else { return };
    painter.rect_filled(plate, 3.0, Color32::from_black_alpha(150));
    painter.galley(plate.min + PADDING, galley, color);
    taken.push(plate);
}

/// Of a label's plate beside its text, points.
const PADDING: Vec2 = vec2(4.0, 1.5);

/// Small text on a dark plate, its `anchor` at `pos`.
pub fn label(text: &str, pos: Pos2, anchor: Align2, color: Color32, painter: &Painter) {
    let galley = painter.layout_no_wrap(text.to_owned(), FontId::proportional(11.0), color);
    let rect = anchor.anchor_size(pos, galley.size());
    let plate = rect.expand2(PADDING);
    painter.rect_filled(plate, 3.0, Color32::from_black_alpha(150));
    painter.galley(rect.min, galley, color);
}

/// A length for people: metres above 1 m, else centimetres.
pub fn length_text(metres: f64) -> String {
    // What would be rounded to 100.0 cm is a metre.
    if metres.abs() < 0.9995 { format!("{:.1} cm", 100.0 * metres) } else { format!("{metres:.2} m") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_below_a_metre_are_in_centimetres() {
        assert_eq!(length_text(0.253), "25.3 cm", "below");
        assert_eq!(length_text(2.5), "2.50 m", "above");
        assert_eq!((length_text(0.99999), length_text(0.9994)), ("1.00 m".to_owned(), "99.9 cm".to_owned()), "about");
    }
}
