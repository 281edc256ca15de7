//! What dragging a handle on a shape makes of it.

use glam::DVec3;

use super::amount::LEAST;
use super::drag::Change;
use super::pull::Pull;
use super::shapes::{extent, rim, vector};
use super::subject::{Subject, tidied};
use crate::editor::tools::new_light::line_placement;
use crate::editor::tools::work_plane::snapped_to;
use crate::editor::viewport::symbol::Symbol;
use crate::light;
use crate::math::frame;
use crate::surface;

/// A half-angle snaps to multiples of this, degrees.
const HALF_ANGLE_STEP_DEG: f64 = 5.0;
/// A cap's half-angle stays within this, degrees.
const HALF_ANGLES_DEG: [f64; 2] = [0.1, 90.0];
/// A disk seen at a smaller cosine than this is measured along its radius instead of in its plane.
const LEAST_FACING: f64 = 0.2;
/// A line's end is moved on its level where the eye is higher than this sine above it.
const LEAST_ABOVE: f64 = 0.25;

/// A line's end moved: on its level where that is seen well, else in the plane that faces the eye. A number typed is the
/// line's length.
pub(super) fn end(pull: &Pull<'_>, start: &Subject, index: usize) -> Option<Change> {
    let Subject::Light(light) = start else { return None };
    let mut light = light.clone();
    let light::Shape::Line(line) = &mut light.shape else { return None };
    let half = 0.5 * line.length * frame::rotation_from_deg(light.rotation_deg).x_axis;
    let mut ends = [light.position - half, light.position + half];
    let other = *ends.get(1 - index.min(1))?;
    let end = ends.get_mut(index)?;
    let seen_from_above = (pull.projection.camera().eye - *end).normalize_or(DVec3::Z).z.abs() > LEAST_ABOVE;
    let normal = if seen_from_above { DVec3::Z } else { pull.projection.forward() };
    *end += pull.shift(*end, normal)?;
    if let Some(length) = pull.typed.first() {
        *end = other + length.max(LEAST) * (*end - other).normalize_or(DVec3::X);
    } else if let Some(corner) = pull.caught(Some, *end) {
        *end = corner;
    } else if let Some(step) = pull.snap {
        let level = end.z;
        *end = DVec3::new(snapped_to(end.x, step), snapped_to(end.y, step), snapped_to(end.z, step));
        if seen_from_above {
            end.z = level;
        }
    }
    let (position, rotation_deg, length) = line_placement(ends[0], ends[1])?;
    line.length = tidied(DVec3::splat(length)).x;
    light.position = tidied(position);
    light.rotation_deg = tidied(rotation_deg);
    Some(Change::To(Subject::Light(light)))
}

/// A side, a corner or a face moved, the opposite one where it was. Numbers typed are the sizes.
pub(super) fn side(pull: &Pull<'_>, start: &Subject, signs: [i8; 3]) -> Option<Change> {
    let (size, world_from_own) = extent(start)?;
    let held = world_from_own.transform_point3(0.5 * vector(signs) * size);
    let moving: Vec<usize> = (0..3).filter(|axis| signs[*axis] != 0).collect();
    let axis = |axis: usize| world_from_own.matrix3.col(axis);
    let along = |i: usize| {
        let direction = axis(i).try_normalize()?;
        let [from, to] = pull.stations(held, direction)?;
        Some((to - from) * direction)
    };
    // What is flat is pulled in its plane, wherever on it the pointer is.
    let in_plane = || pull.shift(held, axis(0).cross(axis(1)).try_normalize()?);
    let shift = match *moving.as_slice() {
        [one] if size.z == 0.0 => in_plane().or_else(|| along(one))?,
        [one] => along(one)?,
        _ => in_plane()?,
    };
    let mut resized = size;
    for (nth, i) in moving.into_iter().enumerate() {
        let metres = axis(i).length();
        let by = f64::from(signs[i]) * shift.dot(axis(i)) / metres;
        resized[i] = tidied(DVec3::splat(pull.size(nth, size[i] * metres + by, LEAST) / metres)).x;
    }
    let center = 0.5 * vector(signs) * (resized - size);
    Some(Change::To(with_extent(start.clone(), resized).at(world_from_own.transform_point3(center))))
}

/// The same thing of another width, depth and height.
fn with_extent(mut subject: Subject, extent: DVec3) -> Subject {
    match &mut subject {
        Subject::Light(light) => {
            if let light::Shape::Textured(textured) = &mut light.shape {
                textured.size = extent.truncate();
            }
        }
        Subject::Surface(surface) => match &mut surface.shape {
            surface::Shape::Square { size } => *size = extent.truncate(),
            surface::Shape::Box { size } => *size = extent,
            surface::Shape::Cylinder { radius, height } | surface::Shape::Cone { radius, height } => {
                *radius = 0.5 * extent.x;
                *height = extent.z;
            }
            _ => {}
        },
        Subject::Probe(_) => {}
    }
    subject
}

/// A radius in the ratio in which the pointer has moved away from the middle.
pub(super) fn radius(pull: &Pull<'_>, start: &Subject) -> Option<Change> {
    let [center, point] = rim(start, pull.projection)?;
    let metres = center.distance(point);
    let along = (point - center).try_normalize()?;
    let own_z = start.rotation().z_axis;
    let on_ring = matches!(start, Subject::Light(light) if matches!(light.shape, light::Shape::Disk(_)))
        && pull.rays[0].direction.dot(own_z).abs() >= LEAST_FACING;
    let ratio = if on_ring {
        pull.ratio(center, own_z)?
    } else {
        let [from, to] = pull.stations(center, along)?;
        (from > 0.0).then(|| to / from)?
    };
    let factor = pull.size(0, metres * ratio, LEAST) / metres;
    let mut changed = start.clone();
    let radius = match &mut changed {
        Subject::Light(light) => match &mut light.shape {
            light::Shape::Sphere(sphere) => &mut sphere.radius,
            light::Shape::Disk(disk) => &mut disk.radius,
            light::Shape::Line(line) => line.radius.as_mut()?,
            _ => return None,
        },
        Subject::Surface(surface) => match &mut surface.shape {
            surface::Shape::Sphere { radius }
            | surface::Shape::Disk { radius }
            | surface::Shape::Cylinder { radius, .. }
            | surface::Shape::Cone { radius, .. } => radius,
            _ => return None,
        },
        Subject::Probe(_) => return None,
    };
    *radius = tidied(DVec3::splat(*radius * factor)).x;
    Some(Change::To(changed))
}

/// A cap whose rim is as far from its middle as the pointer is further out than where it took hold.
pub(super) fn half_angle(pull: &Pull<'_>, start: &Subject) -> Option<Change> {
    let Subject::Light(light) = start else { return None };
    let mut light = light.clone();
    let axis = light.world_from_light().matrix3.z_axis;
    let reach = Symbol::new(&light, pull.projection).tip().distance(light.position);
    let light::Shape::Cap(cap) = &mut light.shape else { return None };
    let [from, to] = pull
        .directions(light.position, reach, axis)
        .map(|direction| axis.cross(direction).length().atan2(axis.dot(direction)).to_degrees());
    let angle = pull.degrees(cap.half_angle_deg + to - from, HALF_ANGLE_STEP_DEG);
    cap.half_angle_deg = tidied(DVec3::splat(angle)).x.clamp(HALF_ANGLES_DEG[0], HALF_ANGLES_DEG[1]);
    Some(Change::To(Subject::Light(light)))
}

/// A control point of a patch moved in the plane that faces the eye.
pub(super) fn control(pull: &Pull<'_>, start: &Subject, index: usize) -> Option<Change> {
    let Subject::Surface(surface) = start else { return None };
    let mut surface = surface.clone();
    let world_from_surface = surface.world_from_surface();
    let surface::Shape::Patch { control_points } = &mut surface.shape else { return None };
    let point = control_points.get_mut(index)?;
    let mut p = world_from_surface.transform_point3(*point);
    let shift = pull.shift(p, pull.projection.forward())?;
    p = match pull.typed.first() {
        Some(distance) => p + *distance * shift.normalize_or_zero(),
        None => DVec3::from_array((p + shift).to_array().map(|coordinate| pull.snapped(coordinate))),
    };
    let own = tidied(world_from_surface.inverse().transform_point3(p));
    *point = own.is_finite().then_some(own)?;
    Some(Change::To(Subject::Surface(surface)))
}
