//! How the canvas lies in the pane: zoom, pan, and what is drawn around and over it.

use egui::{Color32, Painter, Pos2, Rect, Shape, Stroke, Vec2, pos2, vec2};
use glam::DVec2;

/// Share of the pane that a canvas takes that fits.
const FIT: f32 = 0.92;
/// Zoom, as multiples of fitting.
const ZOOM: std::ops::RangeInclusive<f32> = 0.25..=200.0;
/// Texels this large have a grid around them, points.
const GRID_FROM: f32 = 8.0;
/// Stays in sight of the canvas when it is panned, points.
const LEAST_IN_SIGHT: f32 = 24.0;

/// Zoom and pan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct View {
    zoom: f32,
    /// From the pane's middle to the canvas's, points.
    pan: Vec2,
}

impl Default for View {
    fn default() -> Self {
        Self { zoom: 1.0, pan: Vec2::ZERO }
    }
}

/// Where the canvas is on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placed {
    /// The canvas.
    pub(super) rect: Rect,
    /// Columns and rows.
    size: Vec2,
}

impl View {
    /// A canvas of that many texels on a light of those sides in metres, in a pane.
    pub(super) fn place(&self, pane: Rect, size: [usize; 2], sides: DVec2) -> Placed {
        let sides = vec2(single(sides.x), single(sides.y));
        let scale = FIT * (pane.size() / sides).min_elem() * self.zoom;
        let rect = Rect::from_center_size(pane.center() + self.pan, sides * scale);
        Placed { rect, size: vec2(size[0] as f32, size[1] as f32) }
    }

    /// Zoom about a point of the pane.
    pub(super) fn zoom_at(&mut self, pane: Rect, at: Pos2, factor: f32) {
        let zoom = (self.zoom * factor).clamp(*ZOOM.start(), *ZOOM.end());
        let from_middle = at - pane.center();
        self.pan = from_middle + (self.pan - from_middle) * (zoom / self.zoom);
        self.zoom = zoom;
    }

    /// Move the canvas, which stays in sight.
    pub(super) fn pan_by(&mut self, by: Vec2, pane: Rect, placed: &Placed) {
        let reach = 0.5 * (pane.size() + placed.rect.size()) - Vec2::splat(LEAST_IN_SIGHT);
        self.pan = (self.pan + by).clamp(-reach.max(Vec2::ZERO), reach.max(Vec2::ZERO));
    }

    /// Zoom in percent of fitting.
    pub(super) fn percent(&self) -> f32 {
        100.0 * self.zoom
    }
}

impl Placed {
    /// Points a texel is wide and high.
    pub(super) fn texel(&self) -> Vec2 {
        self.rect.size() / self.size
    }

    /// The place on the canvas of a point on the screen, in texels.
    pub(super) fn texels(&self, at: Pos2) -> DVec2 {
        let place = (at - self.rect.min) / self.texel();
        DVec2::new(f64::from(place.x), f64::from(place.y))
    }

    /// The point on the screen of a place on the canvas.
    pub(super) fn screen(&self, place: DVec2) -> Pos2 {
        self.rect.min + vec2(single(place.x), single(place.y)) * self.texel()
    }

    /// Lines between texels, where these are large enough.
    pub(super) fn paint_grid(&self, painter: &Painter) {
        let texel = self.texel();
        if texel.min_elem() < GRID_FROM {
            return;
        }
        let stroke = Stroke::new(1.0, Color32::from_white_alpha(28));
        let seen = painter.clip_rect().intersect(self.rect);
        let lines = |from: f32, to: f32, step: f32, count: f32| {
            let first = (from / step).ceil().max(1.0);
            let last = (to / step).floor().min(count - 1.0);
            std::iter::successors(Some(first), |i| Some(i + 1.0)).take_while(move |i| *i <= last)
        };
        let offset = seen.translate(-self.rect.min.to_vec2());
        for i in lines(offset.min.x, offset.max.x, texel.x, self.size.x) {
            painter.vline(self.rect.min.x + i * texel.x, seen.y_range(), stroke);
        }
        for i in lines(offset.min.y, offset.max.y, texel.y, self.size.y) {
            painter.hline(seen.x_range(), self.rect.min.y + i * texel.y, stroke);
        }
    }

    /// The brush's rim around a place, dark and bright so that it is seen on anything.
    pub(super) fn paint_ring(&self, at: DVec2, size: f64, strength: u8, painter: &Painter) {
        let radius = (0.5 * single(size) * self.texel()).max(Vec2::splat(2.0));
        let center = self.screen(at);
        let dark = Stroke::new(2.5, Color32::from_black_alpha(strength));
        let bright = Stroke::new(1.0, Color32::from_white_alpha(strength));
        painter.add(Shape::ellipse_stroke(center, radius, dark));
        painter.add(Shape::ellipse_stroke(center, radius, bright));
    }
}

/// What may be seen through the canvas's surroundings: a dark ground and a line around the canvas.
pub(super) fn paint_ground(pane: Rect, canvas: Rect, ground: Color32, line: Color32, painter: &Painter) {
    painter.rect_filled(pane, 0.0, ground);
    painter.rect_stroke(canvas.expand(1.0), 0.0, Stroke::new(1.0, line), egui::StrokeKind::Outside);
}

/// The whole of a texture.
pub(super) fn whole() -> Rect {
    Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0))
}

#[expect(clippy::cast_possible_truncation, reason = "points on the screen")]
fn single(value: f64) -> f32 {
    value as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANE: Rect = Rect { min: pos2(100.0, 50.0), max: pos2(500.0, 250.0) };

    #[test]
    fn the_canvas_fits_with_the_lights_proportions_and_points_go_there_and_back() {
        let placed = View::default().place(PANE, [64, 64], DVec2::new(2.0, 1.0));
        assert!((placed.rect.width() / placed.rect.height() - 2.0).abs() < 1e-5, "{:?}", placed.rect);
        assert!(PANE.contains_rect(placed.rect) && placed.rect.center() == PANE.center(), "{:?}", placed.rect);
        let place = DVec2::new(12.5, 40.25);
        assert!(
            placed.texels(placed.screen(place)).abs_diff_eq(place, 1e-4),
            "{}",
            placed.texels(placed.screen(place))
        );
    }

    #[test]
    fn zooming_keeps_what_is_under_the_pointer() {
        let mut view = View::default();
        let at = pos2(180.0, 90.0);
        let before = view.place(PANE, [64, 32], DVec2::new(2.0, 1.0)).texels(at);
        view.zoom_at(PANE, at, 5.0);
        view.zoom_at(PANE, at, 1.7);
        let after = view.place(PANE, [64, 32], DVec2::new(2.0, 1.0)).texels(at);
        assert!(before.abs_diff_eq(after, 1e-3), "{before} became {after}");
        view.pan_by(vec2(1e6, -1e6), PANE, &view.place(PANE, [64, 32], DVec2::new(2.0, 1.0)));
        let placed = view.place(PANE, [64, 32], DVec2::new(2.0, 1.0));
        assert!(placed.rect.intersects(PANE), "in sight: {:?}", placed.rect);
    }
}
