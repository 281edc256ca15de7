//! Where the pointer took hold and where it is now, and what that means in the world.

use egui::Vec2;
use glam::{DAffine3, DVec2, DVec3};

use super::amount::Amount;
use super::frame::Frame;
use crate::editor::tools::snap;
use crate::editor::tools::work_plane::{snapped, snapped_to};
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::ray::Ray;

/// A rotation snaps to multiples of this, degrees.
pub const ANGLE_STEP_DEG: f64 = 15.0;
/// A scale snaps to multiples of this.
const SCALE_STEP: f64 = 0.1;
/// Dragging this far, screen points, doubles the size.
const DOUBLING: f64 = 100.0;
/// A drag that would send a thing further than this, metres, is past the horizon.
const HORIZON: f64 = 1e4;

/// See the [module](self).
pub struct Pull<'a> {
    /// Through where the pointer took hold, and where it is.
    pub rays: [Ray; 2],
    /// How far apart those are on screen, points.
    pub drag: Vec2,
    /// Spacing of the grid that it sticks to.
    pub snap: Option<f64>,
    /// Corners that it sticks to before that.
    pub corners: &'a [DVec3],
    /// What was typed meanwhile.
    pub typed: &'a [f64],
    /// The view.
    pub projection: &'a Projection,
}

impl Pull<'_> {
    /// A length on the grid.
    pub fn snapped(&self, value: f64) -> f64 {
        self.snap.map_or(value, |step| snapped_to(value, step))
    }

    /// A size: as typed, `nth` of the numbers, else on the grid; no less than `least`, nor than one step of the grid.
    pub fn size(&self, nth: usize, value: f64, least: f64) -> f64 {
        match self.typed.get(nth) {
            Some(typed) => typed.max(least),
            None => self.snapped(value).max(self.snap.unwrap_or(least)),
        }
    }

    /// An angle in degrees: as typed, else a multiple of `step` where it snaps.
    pub fn degrees(&self, value: f64, step: f64) -> f64 {
        let snapped = || self.snap.map_or(value, |_| snapped_to(value, step));
        self.typed.first().copied().unwrap_or_else(snapped)
    }

    /// How far apart the two rays meet a plane.
    pub fn shift(&self, point: DVec3, normal: DVec3) -> Option<DVec3> {
        let [from, to] = self.rays.map(|ray| ray.drag_on_plane(point, normal));
        let shift = to? - from?;
        (shift.length() < HORIZON).then_some(shift)
    }

    /// Where the rays come closest to an axis.
    pub fn stations(&self, point: DVec3, axis: DVec3) -> Option<[f64; 2]> {
        let [from, to] = self.rays.map(|ray| ray.closest_on_axis(point, axis));
        let stations = [from?, to?];
        stations.iter().all(|s| s.abs() < HORIZON).then_some(stations)
    }

    /// By what ratio the pointer has moved away from a point, in a plane through it.
    pub fn ratio(&self, center: DVec3, normal: DVec3) -> Option<f64> {
        let [from, to] = self.rays.map(|ray| ray.drag_on_plane(center, normal).map(|p| p.distance(center)));
        let (from, to) = (from?, to?);
        (from > 0.0 && to < HORIZON).then(|| to / from)
    }

    /// Directions from `center` to where the rays meet a sphere about it: on its far side where `axis` is, which is
    /// held, and at the edge where they pass it by.
    pub fn directions(&self, center: DVec3, radius: f64, axis: DVec3) -> [DVec3; 2] {
        let far = axis.dot(self.projection.camera().eye - center) < 0.0;
        self.rays.map(|ray| {
            let along = (center - ray.origin).dot(ray.direction);
            let nearest = ray.at(along);
            let half_chord = (radius * radius - nearest.distance_squared(center)).max(0.0).sqrt();
            let t = if far { along + half_chord } else { along - half_chord };
            (ray.at(t) - center).normalize_or(axis)
        })
    }

    /// How far the pointer has moved in a light's own XY plane, held at `at`.
    pub fn shift_in_plane(&self, world_from_light: &DAffine3, at: DVec2) -> Option<DVec2> {
        let p = world_from_light.transform_point3(at.extend(0.0));
        let shift = self.shift(p, world_from_light.matrix3.z_axis)?;
        Some((world_from_light.matrix3.transpose() * shift).truncate())
    }

    /// A point of a light's own XY plane on the grid: the world's where the plane is level, else the plane's own.
    pub fn snapped_in_plane(&self, world_from_light: &DAffine3, at: DVec2) -> DVec2 {
        let Some(step) = self.snap else { return at };
        let level = world_from_light.matrix3.z_axis.truncate().length() < 1e-9;
        if !level {
            return snapped(at, step);
        }
        let p = world_from_light.transform_point3(at.extend(0.0));
        let on_grid = snapped(p.truncate(), step).extend(p.z);
        world_from_light.inverse().transform_point3(on_grid).truncate()
    }

    /// A point of a light's own XY plane under the corner that it is seen near to, else on the grid.
    pub fn caught_in_plane(&self, world_from_light: &DAffine3, at: DVec2) -> DVec2 {
        let light_from_world = world_from_light.inverse();
        let own = |p: DVec3| light_from_world.transform_point3(p).truncate();
        let place = |at: DVec2| world_from_light.transform_point3(at.extend(0.0));
        let foot = snap::near_foot(|corner| place(own(corner)), place(at), self.projection);
        match self.caught(foot, place(at)) {
            Some(corner) => own(corner),
            None => self.snapped_in_plane(world_from_light, at),
        }
    }

    /// The corner whose place `by` is seen near to a point.
    pub fn caught(&self, by: impl Fn(DVec3) -> Option<DVec3>, at: DVec3) -> Option<DVec3> {
        snap::nearest(self.corners, by, self.projection, self.projection.project(at)?)
    }

    /// Moved along one axis of a frame.
    pub fn along(&self, frame: &Frame, axis: usize) -> Option<Amount> {
        let direction = frame.axes.col(axis);
        let by = match self.typed.first() {
            Some(typed) => *typed,
            None => {
                let [from, to] = self.stations(frame.origin, direction)?;
                self.step(frame, axis, to - from)
            }
        };
        Some(Amount::Move(by * direction))
    }

    /// Moved in the plane of a frame whose normal is one of its axes. One number typed is the distance, two are those
    /// along the other axes.
    pub fn across(&self, frame: &Frame, normal: usize) -> Option<Amount> {
        let axes = [(normal + 1) % 3, (normal + 2) % 3];
        let [u, v] = axes.map(|axis| frame.axes.col(axis));
        let by = match *self.typed {
            [along_u, along_v, ..] => along_u * u + along_v * v,
            _ => {
                let shift = self.shift(frame.origin, frame.axes.col(normal))?;
                match self.typed.first() {
                    Some(distance) => *distance * shift.normalize_or(u),
                    None => axes
                        .map(|axis| self.step(frame, axis, shift.dot(frame.axes.col(axis))) * frame.axes.col(axis))
                        .into_iter()
                        .sum(),
                }
            }
        };
        Some(Amount::Move(by))
    }

    /// Moved in the plane that faces the eye. One number typed is the distance, three are those along the world's axes.
    pub fn facing(&self, frame: &Frame) -> Option<Amount> {
        if let [x, y, z, ..] = *self.typed {
            return Some(Amount::Move(DVec3::new(x, y, z)));
        }
        let shift = self.shift(frame.origin, self.projection.forward())?;
        Some(Amount::Move(match self.typed.first() {
            Some(distance) => *distance * shift.normalize_or(self.projection.right_up()[0]),
            None => DVec3::from_array([0, 1, 2].map(|axis| {
                self.snap
                    .map_or(shift[axis], |step| snapped_to(frame.origin[axis] + shift[axis], step) - frame.origin[axis])
            })),
        }))
    }

    /// A move along one of a frame's axes that ends on the grid: the world's, else one that starts at the frame.
    fn step(&self, frame: &Frame, axis: usize, by: f64) -> f64 {
        let from = if frame.is_world { frame.origin[axis] } else { 0.0 };
        self.snap.map_or(by, |step| snapped_to(from + by, step) - from)
    }

    /// Turned about an axis through a frame's origin by the angle between the points held.
    pub fn turned(&self, frame: &Frame, axis: DVec3) -> Option<Amount> {
        let dragged = || {
            let [from, to] = self.rays.map(|ray| ray.drag_on_plane(frame.origin, axis));
            let [from, to] = [from? - frame.origin, to? - frame.origin];
            Some(from.cross(to).dot(axis).atan2(from.dot(to)).to_degrees())
        };
        let angle = self.degrees(if self.typed.is_empty() { dragged()? } else { 0.0 }, ANGLE_STEP_DEG);
        Some(Amount::Turn { axis, angle: angle.to_radians() })
    }

    /// Scaled along one of a frame's axes, in the ratio of the points held.
    pub fn stretched(&self, frame: &Frame, axis: usize) -> Option<Amount> {
        let [from, to] = self.stations(frame.origin, frame.axes.col(axis))?;
        if from.abs() < 1e-9 {
            return None;
        }
        let mut factors = DVec3::ONE;
        factors[axis] = self.factor(to / from);
        Some(Amount::Scale { axes: frame.axes, factors })
    }

    /// Scaled as a whole: right and up make it larger.
    pub fn scaled(&self, frame: &Frame) -> Amount {
        let factor = 2.0_f64.powf(f64::from(self.drag.x - self.drag.y) / DOUBLING);
        Amount::Scale { axes: frame.axes, factors: DVec3::splat(self.factor(factor)) }
    }

    /// A factor: as typed, else a multiple of the step where it snaps.
    fn factor(&self, factor: f64) -> f64 {
        let snapped = || self.snap.map_or(factor, |_| snapped_to(factor, SCALE_STEP));
        self.typed.first().copied().unwrap_or_else(snapped)
    }
}
