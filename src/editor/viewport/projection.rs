//! Between the world and the screen.

use egui::{Pos2, Rect};
use glam::{DVec2, DVec3};

use super::ray::Ray;
use crate::scene::Camera;

/// A camera that fills a rectangle of the screen: [`Camera::ray_direction`] and its inverse, in egui's points.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    camera: Camera,
    rect: Rect,
    /// Right, up, back.
    axes: [DVec3; 3],
    /// Screen points per unit of the tangent of the view angle.
    points_per_tangent: f64,
    near: f64,
}

/// Lines are cut this far outside the pane, in points, so that their ends stay out of sight.
const MARGIN: f64 = 64.0;

impl Projection {
    /// `camera` filling `rect`; a rectangle without area projects nothing.
    pub fn new(camera: &Camera, rect: Rect) -> Self {
        let half = (0.5 * camera.fov_deg.to_radians()).tan();
        Self {
            camera: *camera,
            rect,
            axes: camera.axes(),
            points_per_tangent: 0.5 * f64::from(rect.height()) / half,
            near: 1e-3 * camera.eye.distance(camera.target).max(1e-3),
        }
    }

    /// Whether there is anything to see.
    pub fn is_empty(&self) -> bool {
        !self.rect.is_positive() || !self.points_per_tangent.is_finite() || self.points_per_tangent <= 0.0
    }

    /// The camera.
    pub fn camera(&self) -> &Camera {
        &self.camera
    }

    /// The rectangle on screen.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// The camera's right and up, unit.
    pub fn right_up(&self) -> [DVec3; 2] {
        [self.axes[0], self.axes[1]]
    }

    /// The unit direction in which the camera looks.
    pub fn forward(&self) -> DVec3 {
        -self.axes[2]
    }

    /// The half-line from the eye through a point of the screen.
    pub fn ray(&self, pos: Pos2) -> Ray {
        let at = pos - self.rect.min;
        let direction = self.camera.ray_direction(
            f64::from(at.x),
            f64::from(at.y),
            f64::from(self.rect.width()),
            f64::from(self.rect.height()),
        );
        Ray { origin: self.camera.eye, direction }
    }

    /// Distance in front of the eye, along the view direction.
    pub fn depth(&self, p: DVec3) -> f64 {
        (p - self.camera.eye).dot(self.forward())
    }

    /// Where a point of the world appears; `None` behind the near plane.
    pub fn project(&self, p: DVec3) -> Option<Pos2> {
        (self.depth(p) >= self.near).then(|| to_pos(self.perspective(p)))
    }

    /// The part of the segment `a` `b` in front of the near plane and within or just around the pane.
    pub fn segment(&self, a: DVec3, b: DVec3) -> Option<[Pos2; 2]> {
        let [a, b] = clip_near([a, b], [self.depth(a) - self.near, self.depth(b) - self.near])?;
        let min = DVec2::new(f64::from(self.rect.min.x), f64::from(self.rect.min.y)) - MARGIN;
        let max = DVec2::new(f64::from(self.rect.max.x), f64::from(self.rect.max.y)) + MARGIN;
        let [a, b] = clip_rect([self.perspective(a), self.perspective(b)], min, max)?;
        Some([to_pos(a), to_pos(b)])
    }

    /// Length in the world of one screen point at the depth of `p`.
    pub fn metres_per_point(&self, p: DVec3) -> f64 {
        self.depth(p).max(self.near) / self.points_per_tangent
    }

    /// Perspective division, for points in front of the eye.
    fn perspective(&self, p: DVec3) -> DVec2 {
        let from_eye = p - self.camera.eye;
        let scale = self.points_per_tangent / self.depth(p);
        let center = self.rect.center();
        DVec2::new(
            f64::from(center.x) + from_eye.dot(self.axes[0]) * scale,
            f64::from(center.y) - from_eye.dot(self.axes[1]) * scale,
        )
    }
}

/// Screen coordinates are single precision.
#[expect(clippy::cast_possible_truncation, reason = "egui's screen coordinates are f32")]
pub fn to_pos(at: DVec2) -> Pos2 {
    Pos2::new(at.x as f32, at.y as f32)
}

/// The part of a segment whose signed distances to a plane are positive.
fn clip_near([a, b]: [DVec3; 2], [da, db]: [f64; 2]) -> Option<[DVec3; 2]> {
    match (da >= 0.0, db >= 0.0) {
        (true, true) => Some([a, b]),
        (false, false) => None,
        (true, false) => Some([a, a.lerp(b, da / (da - db))]),
        (false, true) => Some([b.lerp(a, db / (db - da)), b]),
    }
}

/// Liang and Barsky's clipping of a segment to a rectangle.
fn clip_rect([a, b]: [DVec2; 2], min: DVec2, max: DVec2) -> Option<[DVec2; 2]> {
    let along = b - a;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-along.x, a.x - min.x), (along.x, max.x - a.x), (-along.y, a.y - min.y), (along.y, max.y - a.y)] {
        if p < 0.0 {
            first = first.max(q / p);
        } else if p > 0.0 {
            last = last.min(q / p);
        } else if q < 0.0 {
            return None;
        }
    }
    (first <= last).then(|| [a + first * along, a + last * along])
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::pos2;

    fn projection() -> Projection {
        let camera = Camera { eye: DVec3::new(3.0, -6.0, 2.5), target: DVec3::new(0.1, 0.2, 0.5), fov_deg: 40.0 };
        Projection::new(&camera, Rect::from_min_max(pos2(100.0, 50.0), pos2(900.0, 650.0)))
    }

    #[test]
    fn a_point_on_the_ray_through_a_pixel_projects_to_that_pixel() {
        let projection = projection();
        for pos in [pos2(100.0, 50.0), pos2(500.0, 350.0), pos2(731.0, 612.5), pos2(899.0, 51.0)] {
            let p = projection.ray(pos).at(4.2);
            let back = projection.project(p).expect("in front of the eye");
            assert!(back.distance(pos) < 1e-3, "{pos:?} came back as {back:?}");
        }
    }

    #[test]
    fn a_point_behind_the_eye_is_not_on_screen() {
        let projection = projection();
        assert_eq!(projection.project(projection.ray(pos2(500.0, 350.0)).at(-1.0)), None, "behind");
    }

    #[test]
    fn a_segment_through_the_eye_plane_is_cut_and_stays_near_the_pane() {
        let projection = projection();
        let ahead = projection.ray(pos2(300.0, 200.0)).at(5.0);
        let behind = projection.camera().eye - 3.0 * projection.forward() + DVec3::X;
        let [a, b] = projection.segment(behind, ahead).expect("partly visible");
        assert!(b.distance(pos2(300.0, 200.0)) < 1e-3, "the visible end is unmoved: {b:?}");
        assert!(projection.rect().expand(65.0).contains(a), "the cut end is just outside: {a:?}");
    }

    #[test]
    fn a_segment_beside_the_pane_is_dropped() {
        let projection = projection();
        let far_left = projection.ray(pos2(-900.0, 100.0)).at(4.0);
        let further = projection.ray(pos2(-900.0, 500.0)).at(4.0);
        assert_eq!(projection.segment(far_left, further), None, "out of sight");
    }

    #[test]
    fn metres_per_point_is_the_size_of_a_point() {
        let projection = projection();
        let p = projection.ray(pos2(500.0, 350.0)).at(7.0);
        let [right, _] = projection.right_up();
        let shifted = projection.project(p + 10.0 * projection.metres_per_point(p) * right).expect("visible");
        assert!((shifted.x - 510.0).abs() < 1e-3, "10 points to the right, not {shifted:?}");
    }

    #[test]
    fn a_pane_without_area_is_empty() {
        let nothing = Projection::new(&Camera::default(), Rect::from_min_max(pos2(5.0, 5.0), pos2(5.0, 5.0)));
        assert!(nothing.is_empty(), "no area");
    }
}
