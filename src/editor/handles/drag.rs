//! What a thing becomes while one of its handles is dragged.

use egui::{Pos2, Vec2};
use glam::{DAffine3, DMat3, DQuat, DVec2, DVec3};

use super::subject::Subject;
use super::{Handle, aim_reach, vertices};
use crate::editor::tools::new_light::line_placement;
use crate::editor::tools::work_plane::{snapped, snapped_to};
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::ray::Ray;
use crate::editor::viewport::symbol::Symbol;
use crate::light::{Disk, Shape, Sphere};
use crate::math::frame;
use crate::surface::Hit;

/// How much slower a fine drag is.
const FINE: f32 = 0.1;
/// A rotation snaps to multiples of this, degrees.
const ANGLE_STEP_DEG: f64 = 15.0;
/// A half-angle snaps to multiples of this, degrees.
const HALF_ANGLE_STEP_DEG: f64 = 5.0;
/// A cap's half-angle stays within this, degrees.
const HALF_ANGLES_DEG: [f64; 2] = [0.1, 90.0];
/// A disk seen at a smaller cosine than this is measured in the plane that faces the eye.
const LEAST_FACING: f64 = 0.2;
/// A scale snaps to multiples of this.
const SCALE_STEP: f64 = 0.1;
/// Nothing is scaled to less than this, nor has a smaller radius in metres.
const LEAST: f64 = 0.01;
/// Dragging this far, screen points, doubles the size.
const DOUBLING: f64 = 100.0;
/// A drag that would send a thing further than this, metres, is past the horizon.
const HORIZON: f64 = 1e4;

/// A handle held by the pointer.
#[derive(Clone, Debug)]
pub struct Drag {
    handle: Handle,
    start: Subject,
    grabbed_at: Pos2,
    pointer: Pos2,
}

/// What a drag makes of its thing.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// The thing as it is to be.
    To(Subject),
    /// The thing as it would be, which may not be: a polygon that crosses itself.
    Refused(Subject),
}

impl Drag {
    /// `handle` of `subject`, taken hold of at `pos`.
    pub fn new(handle: Handle, subject: Subject, pos: Pos2) -> Self {
        Self { handle, start: subject, grabbed_at: pos, pointer: pos }
    }

    /// Which handle is held.
    pub fn handle(&self) -> Handle {
        self.handle
    }

    /// What an undo step made by this drag is called.
    pub fn label(&self) -> &'static str {
        match self.handle {
            Handle::Axis(_) | Handle::Plane(_) => "Move",
            Handle::Ring(_) => "Rotate",
            Handle::Stretch(_) | Handle::Scale => "Scale",
            Handle::Vertex(_) => "Move vertex",
            Handle::Edge(_) => "Move edge",
            Handle::End(_) => "Move end",
            Handle::Frame(_) => "Change size",
            Handle::Radius => "Change radius",
            Handle::HalfAngle => "Change half-angle",
            Handle::Aim => "Aim",
            Handle::Probe => "Move probe",
        }
    }

    /// The pointer has moved by `delta`; `fine` slows it down.
    pub fn pull(&mut self, delta: Vec2, fine: bool) {
        self.pointer += if fine { FINE * delta } else { delta };
    }

    /// The thing as the pointer has it now; `snap` is the spacing of the grid it sticks to, `under` the surface under a
    /// point of the screen. `None` where the pointer says nothing, as past the horizon.
    pub fn change(
        &self,
        projection: &Projection,
        snap: Option<f64>,
        under: impl FnOnce(&Ray) -> Option<Hit>,
    ) -> Option<Change> {
        let pull = Pull { rays: [projection.ray(self.grabbed_at), projection.ray(self.pointer)], snap };
        let start = &self.start;
        match self.handle {
            Handle::Axis(axis) => pull.along(start.position(), axis).map(|p| Change::To(start.clone().at(p))),
            Handle::Plane(normal) => pull.across(start.position(), normal).map(|p| Change::To(start.clone().at(p))),
            Handle::Ring(axis) => pull.turned(start, axis),
            Handle::Stretch(axis) => pull.stretched(start, axis),
            Handle::Scale => {
                let drag = self.pointer - self.grabbed_at;
                pull.scaled(start, 2.0_f64.powf(f64::from(drag.x - drag.y) / DOUBLING), [0, 1, 2].as_slice())
            }
            Handle::Vertex(i) => vertices::vertex(&pull, start, i),
            Handle::Edge(i) => vertices::edge(&pull, start, i),
            Handle::End(i) => pull.end(start, i, projection),
            Handle::Frame(signs) => pull.frame(start, signs),
            Handle::Radius => pull.radius(start, projection),
            Handle::HalfAngle => pull.half_angle(start, projection),
            Handle::Aim => pull.aimed(start, projection),
            Handle::Probe => pull.probe(start, under),
        }
    }
}

/// Where the pointer took hold and where it is, as rays.
pub(super) struct Pull {
    rays: [Ray; 2],
    snap: Option<f64>,
}

impl Pull {
    fn snapped(&self, value: f64) -> f64 {
        self.snap.map_or(value, |step| snapped_to(value, step))
    }

    /// How far apart the two rays meet a plane.
    fn shift(&self, point: DVec3, normal: DVec3) -> Option<DVec3> {
        let [from, to] = self.rays.map(|ray| ray.drag_on_plane(point, normal));
        let shift = to? - from?;
        (shift.length() < HORIZON).then_some(shift)
    }

    /// Where the rays come closest to an axis.
    fn stations(&self, point: DVec3, axis: DVec3) -> Option<[f64; 2]> {
        let [from, to] = self.rays.map(|ray| ray.closest_on_axis(point, axis));
        let stations = [from?, to?];
        stations.iter().all(|s| s.abs() < HORIZON).then_some(stations)
    }

    /// `position` moved along a world axis.
    fn along(&self, position: DVec3, axis: usize) -> Option<DVec3> {
        let [from, to] = self.stations(position, DVec3::AXES[axis])?;
        let mut moved = position;
        moved[axis] = self.snapped(position[axis] + to - from);
        Some(moved)
    }

    /// `position` moved in the plane whose normal is a world axis.
    fn across(&self, position: DVec3, normal: usize) -> Option<DVec3> {
        let shift = self.shift(position, DVec3::AXES[normal])?;
        let mut moved = position;
        for axis in [(normal + 1) % 3, (normal + 2) % 3] {
            moved[axis] = self.snapped(position[axis] + shift[axis]);
        }
        Some(moved)
    }

    /// Turned about the thing's own axis, by the angle between the points held in the ring's plane.
    fn turned(&self, start: &Subject, axis: usize) -> Option<Change> {
        let rotation = start.rotation();
        let normal = rotation.col(axis);
        let [from, to] = self.rays.map(|ray| ray.drag_on_plane(start.position(), normal));
        let [from, to] = [from? - start.position(), to? - start.position()];
        let mut angle = from.cross(to).dot(normal).atan2(from.dot(to));
        if self.snap.is_some() {
            angle = snapped_to(angle.to_degrees(), ANGLE_STEP_DEG).to_radians();
        }
        let turn = DMat3::from_axis_angle(normal, angle);
        Some(Change::To(start.clone().turned(turn * rotation)))
    }

    /// Scaled along one of the thing's own axes, in the ratio of the points held.
    fn stretched(&self, start: &Subject, axis: usize) -> Option<Change> {
        let [from, to] = self.stations(start.position(), start.rotation().col(axis))?;
        if from.abs() < 1e-9 {
            return None;
        }
        self.scaled(start, to / from, &[axis])
    }

    /// Scaled by `factor` along some of the thing's own axes.
    fn scaled(&self, start: &Subject, factor: f64, axes: &[usize]) -> Option<Change> {
        let factor = if self.snap.is_some() { snapped_to(factor, SCALE_STEP) } else { factor };
        if !factor.is_finite() {
            return None;
        }
        let factor = factor.max(LEAST);
        let mut factors = DVec3::ONE;
        for axis in axes {
            factors[*axis] = factor;
        }
        let mut scaled = start.clone();
        match &mut scaled {
            Subject::Light(light) => match &mut light.shape {
                Shape::Polygon(polygon) => polygon.vertices.iter_mut().for_each(|v| *v *= factors.truncate()),
                Shape::Line(line) => line.length *= factors.x,
                Shape::Sphere(sphere) => sphere.radius *= factor,
                Shape::Disk(disk) => disk.radius *= factor,
                Shape::Textured(textured) => textured.size *= factors.truncate(),
                Shape::Cap(_) | Shape::Sky(_) | Shape::Point(_) | Shape::Directional(_) => {}
            },
            Subject::Surface(surface) => surface.scale *= factors,
            Subject::Probe(_) => {}
        }
        Some(Change::To(scaled))
    }

    /// How far the pointer has moved in a light's own XY plane, held at `at`.
    pub(super) fn shift_in_plane(&self, world_from_light: &DAffine3, at: DVec2) -> Option<DVec2> {
        let p = world_from_light.transform_point3(at.extend(0.0));
        let shift = self.shift(p, world_from_light.matrix3.z_axis)?;
        Some((world_from_light.matrix3.transpose() * shift).truncate())
    }

    /// A point of a light's own XY plane on the grid: the world's where the plane is level, else the plane's own.
    pub(super) fn snapped_in_plane(&self, world_from_light: &DAffine3, at: DVec2) -> DVec2 {
        let Some(step) = self.snap else { return at };
        let level = world_from_light.matrix3.z_axis.truncate().length() < 1e-9;
        if !level {
            return snapped(at, step);
        }
        let p = world_from_light.transform_point3(at.extend(0.0));
        let on_grid = snapped(p.truncate(), step).extend(p.z);
        world_from_light.inverse().transform_point3(on_grid).truncate()
    }

    /// A line's end moved: on its level where that is seen well, else in the plane that faces the eye.
    fn end(&self, start: &Subject, index: usize, projection: &Projection) -> Option<Change> {
        let Subject::Light(light) = start else { return None };
        let mut light = light.clone();
        let Shape::Line(line) = &mut light.shape else { return None };
        let half = 0.5 * line.length * frame::rotation_from_deg(light.rotation_deg).x_axis;
        let mut ends = [light.position - half, light.position + half];
        let end = ends.get_mut(index)?;
        let seen_from_above = (projection.camera().eye - *end).normalize_or(DVec3::Z).z.abs() > 0.25;
        let normal = if seen_from_above { DVec3::Z } else { projection.forward() };
        *end += self.shift(*end, normal)?;
        if let Some(step) = self.snap {
            let fixed_z = end.z;
            *end = DVec3::new(snapped_to(end.x, step), snapped_to(end.y, step), snapped_to(end.z, step));
            if seen_from_above {
                end.z = fixed_z;
            }
        }
        let (position, rotation_deg, length) = line_placement(ends[0], ends[1])?;
        line.length = length;
        light.position = position;
        light.rotation_deg = rotation_deg;
        Some(Change::To(Subject::Light(light)))
    }

    /// A rectangle with one side or corner moved in its plane, the opposite one where it was.
    fn frame(&self, start: &Subject, signs: [i8; 2]) -> Option<Change> {
        let Subject::Light(light) = start else { return None };
        let mut light = light.clone();
        let world_from_light = light.world_from_light();
        let Shape::Textured(textured) = &mut light.shape else { return None };
        let signs = DVec2::from_array(signs.map(f64::from));
        let held = 0.5 * signs * textured.size;
        let moved = self.snapped_in_plane(&world_from_light, held + self.shift_in_plane(&world_from_light, held)?);
        let extent = (signs * (moved + held)).max(DVec2::splat(LEAST));
        textured.size = DVec2::select(signs.cmpeq(DVec2::ZERO), textured.size, extent);
        let center = 0.5 * signs * textured.size - held;
        light.position = world_from_light.transform_point3(center.extend(0.0));
        Some(Change::To(Subject::Light(light)))
    }

    /// A cap whose rim is as far from its middle as the pointer is further out than where it took hold.
    fn half_angle(&self, start: &Subject, projection: &Projection) -> Option<Change> {
        let Subject::Light(light) = start else { return None };
        let mut light = light.clone();
        let axis = light.world_from_light().matrix3.z_axis;
        let reach = Symbol::new(&light, projection).tip().distance(light.position);
        let Shape::Cap(cap) = &mut light.shape else { return None };
        let [from, to] = self.directions(light.position, reach, axis, projection).map(|direction| {
            let angle = axis.cross(direction).length().atan2(axis.dot(direction));
            angle.to_degrees()
        });
        let angle = cap.half_angle_deg + to - from;
        let angle = if self.snap.is_some() { snapped_to(angle, HALF_ANGLE_STEP_DEG) } else { angle };
        cap.half_angle_deg = angle.clamp(HALF_ANGLES_DEG[0], HALF_ANGLES_DEG[1]);
        Some(Change::To(Subject::Light(light)))
    }

    /// A light whose +Z follows the pointer over a sphere about it.
    fn aimed(&self, start: &Subject, projection: &Projection) -> Option<Change> {
        let rotation = start.rotation();
        let axis = rotation.z_axis;
        let center = start.position();
        let [from, to] = self.directions(center, aim_reach(center, projection), axis, projection);
        let mut aim = DQuat::from_rotation_arc(from, to) * axis;
        if self.snap.is_some() {
            let step = |angle: f64| snapped_to(angle.to_degrees(), ANGLE_STEP_DEG).to_radians();
            let theta = step(aim.x.hypot(aim.y).atan2(aim.z));
            let phi = step(aim.y.atan2(aim.x));
            aim = DVec3::new(theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos());
        }
        let turn = DMat3::from_quat(DQuat::from_rotation_arc(axis, aim));
        Some(Change::To(start.clone().turned(turn * rotation)))
    }

    /// Directions from `center` to where the rays meet a sphere about it: on its far side where `axis` is, which is
    /// held, and at the edge where they pass it by.
    fn directions(&self, center: DVec3, radius: f64, axis: DVec3, projection: &Projection) -> [DVec3; 2] {
        let far = axis.dot(projection.camera().eye - center) < 0.0;
        self.rays.map(|ray| {
            let along = (center - ray.origin).dot(ray.direction);
            let nearest = ray.at(along);
            let half_chord = (radius * radius - nearest.distance_squared(center)).max(0.0).sqrt();
            let t = if far { along + half_chord } else { along - half_chord };
            (ray.at(t) - center).normalize_or(axis)
        })
    }

    /// A sphere's or disk's radius changed by how much further from the centre the pointer is than where it took hold.
    fn radius(&self, start: &Subject, projection: &Projection) -> Option<Change> {
        let Subject::Light(light) = start else { return None };
        let mut light = light.clone();
        let axis = light.world_from_light().matrix3.z_axis;
        let (radius, normal) = match &mut light.shape {
            Shape::Sphere(Sphere { radius }) => (radius, projection.forward()),
            Shape::Disk(Disk { radius, .. }) if self.rays[0].direction.dot(axis).abs() >= LEAST_FACING => {
                (radius, axis)
            }
            Shape::Disk(Disk { radius, .. }) => (radius, projection.forward()),
            _ => return None,
        };
        let [from, to] = self.rays.map(|ray| ray.on_plane(light.position, normal).map(|p| p.distance(light.position)));
        let least = self.snap.unwrap_or(LEAST);
        *radius = self.snapped(*radius + to? - from?).max(least);
        Some(Change::To(Subject::Light(light)))
    }

    /// A probe moved to the surface under the pointer, with that surface's normal, or on its own level beside them.
    fn probe(&self, start: &Subject, under: impl FnOnce(&Ray) -> Option<Hit>) -> Option<Change> {
        let Subject::Probe(plot) = start else { return None };
        let mut plot = plot.clone();
        let ray = &self.rays[1];
        if let Some(hit) = under(ray) {
            plot.position = hit.p;
            plot.normal = if hit.n.dot(ray.direction) > 0.0 { -hit.n } else { hit.n };
        } else {
            plot.position += self.shift(plot.position, DVec3::Z)?;
        }
        if self.snap.is_some() && plot.normal.z > 1.0 - 1e-9 {
            plot.position.x = self.snapped(plot.position.x);
            plot.position.y = self.snapped(plot.position.y);
        }
        Some(Change::To(Subject::Probe(plot)))
    }
}

#[cfg(test)]
#[path = "drag_tests.rs"]
mod tests;
