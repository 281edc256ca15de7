//! Moving the camera: orbit, pan, zoom, focus.

use egui::{Pos2, Vec2};
use glam::DVec3;

use super::bounds::Ball;
use super::projection::Projection;
use crate::scene::Camera;

/// Radians of orbit for each screen point dragged.
const RADIANS_PER_POINT: f64 = 0.008;
/// The camera stays this far from looking straight up or down, radians, so that up remains up.
const POLE_MARGIN: f64 = 0.01;
/// The eye stays at least and at most this far from its target, metres.
const DISTANCE: [f64; 2] = [0.01, 1e4];
/// Share of the pane that focused things fill.
const FOCUS_FILL: f64 = 0.8;

/// The camera turned about its target by a drag of `drag` screen points.
pub fn orbited(camera: &Camera, drag: Vec2) -> Camera {
    let from_target = camera.eye - camera.target;
    let distance = from_target.length();
    let flat = from_target.x.hypot(from_target.y);
    // Looking straight down, the camera's right is +X, as if it stood to the south.
    let azimuth =
        if flat > 1e-9 * distance { from_target.y.atan2(from_target.x) } else { -std::f64::consts::FRAC_PI_2 };
    let limit = std::f64::consts::FRAC_PI_2 - POLE_MARGIN;
    let elevation = (from_target.z.atan2(flat) + RADIANS_PER_POINT * f64::from(drag.y)).clamp(-limit, limit);
    let azimuth = azimuth - RADIANS_PER_POINT * f64::from(drag.x);
    let direction = DVec3::new(elevation.cos() * azimuth.cos(), elevation.cos() * azimuth.sin(), elevation.sin());
    Camera { eye: camera.target + distance * direction, ..*camera }
}

/// The camera moved sideways so that what lies at its target follows the pointer.
pub fn panned(projection: &Projection, drag: Vec2) -> Camera {
    let camera = projection.camera();
    let metres = projection.metres_per_point(camera.target);
    let [right, up] = projection.right_up();
    let shift = metres * (f64::from(drag.y) * up - f64::from(drag.x) * right);
    Camera { eye: camera.eye + shift, target: camera.target + shift, ..*camera }
}

/// The camera `factor` times as far from its target, with what lies under the pointer, at the target's depth, unmoved.
pub fn zoomed(projection: &Projection, pointer: Pos2, factor: f64) -> Camera {
    let camera = projection.camera();
    let distance = camera.eye.distance(camera.target);
    let factor = (factor * distance).clamp(DISTANCE[0], DISTANCE[1]) / distance;
    let anchor = projection.ray(pointer).on_plane(camera.target, projection.forward()).unwrap_or(camera.target);
    let about_anchor = |p: DVec3| anchor + factor * (p - anchor);
    Camera { eye: about_anchor(camera.eye), target: about_anchor(camera.target), ..*camera }
}

/// The camera looking at `ball` from where it looks now, so near that the ball fills most of the pane.
pub fn focused(projection: &Projection, ball: &Ball) -> Camera {
    let camera = projection.camera();
    let aspect = f64::from(projection.rect().width()) / f64::from(projection.rect().height());
    let half = (0.5 * camera.fov_deg.to_radians()).tan() * aspect.min(1.0);
    let distance = (ball.radius / (FOCUS_FILL * half.atan().sin())).clamp(DISTANCE[0], DISTANCE[1]);
    Camera { eye: ball.center - distance * projection.forward(), target: ball.center, ..*camera }
}

#[cfg(test)]
mod tests {
    use super::*;
    use egui::{Rect, pos2, vec2};

    fn projection() -> Projection {
        Projection::new(&Camera::default(), Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)))
    }

    #[test]
    fn an_orbit_keeps_target_and_distance() {
        let camera = Camera::default();
        let turned = orbited(&camera, vec2(120.0, -35.0));
        assert_eq!(turned.target, camera.target, "target");
        let (before, after) = (camera.eye.distance(camera.target), turned.eye.distance(turned.target));
        assert!((before - after).abs() < 1e-12, "distance {before} became {after}");
        assert!(turned.eye.distance(camera.eye) > 1.0, "it did turn");
    }

    #[test]
    fn an_orbit_over_the_pole_stops_there() {
        let turned = orbited(&Camera::default(), vec2(0.0, 1e5));
        let [right, up, back] = turned.axes();
        assert!(back.z > 0.99 && up.is_finite() && right.is_finite(), "looks down: {back}");
        assert!(right.x > 0.99, "right stays right: {right}");
    }

    #[test]
    fn a_pan_moves_the_target_with_the_pointer() {
        let projection = projection();
        let panned = Projection::new(&panned(&projection, vec2(40.0, 25.0)), projection.rect());
        let was = panned.project(Camera::default().target).expect("visible");
        assert!(was.distance(pos2(440.0, 325.0)) < 1e-2, "the old target is at {was:?}");
    }

    #[test]
    fn a_zoom_leaves_what_is_under_the_pointer() {
        let projection = projection();
        let pointer = pos2(650.0, 130.0);
        let p = projection.ray(pointer).on_plane(Camera::default().target, projection.forward()).expect("ahead");
        let zoomed = zoomed(&projection, pointer, 0.5);
        let after = Projection::new(&zoomed, projection.rect()).project(p).expect("visible");
        assert!(after.distance(pointer) < 1e-2, "moved to {after:?}");
        let ratio = zoomed.eye.distance(zoomed.target) / Camera::default().eye.distance(Camera::default().target);
        assert!((ratio - 0.5).abs() < 1e-12, "half as far: {ratio}");
    }

    #[test]
    fn zooming_in_for_ever_never_reaches_the_target() {
        let mut camera = Camera::default();
        for _ in 0..200 {
            let projection = Projection::new(&camera, projection().rect());
            camera = zoomed(&projection, pos2(10.0, 10.0), 0.5);
        }
        assert!(camera.eye.distance(camera.target) > 0.009, "{camera:?}");
    }

    #[test]
    fn a_focused_ball_lies_within_the_pane() {
        let ball = Ball { center: DVec3::new(4.0, 1.0, 2.0), radius: 0.7 };
        let projection = Projection::new(&focused(&projection(), &ball), projection().rect());
        let center = projection.project(ball.center).expect("visible");
        assert!(center.distance(projection.rect().center()) < 1e-2, "centred");
        let [_, up] = projection.right_up();
        let top = projection.project(ball.center + ball.radius * up).expect("visible");
        let share = f64::from(center.y - top.y) / 300.0;
        assert!((0.6..0.9).contains(&share), "fills {share} of the half height");
    }
}
