//! What is said at the cursor while something is dragged.

use glam::DVec3;

use super::Handle;
use super::amount::Amount;
use super::frame::Frame;
use super::shapes::{extent, rim};
use super::subject::Subject;
use crate::editor::viewport::overlay::length_text;
use crate::editor::viewport::projection::Projection;
use crate::light::Shape;

/// Names of the axes.
pub const AXES: [&str; 3] = ["X", "Y", "Z"];

/// By how much things are moved, turned or scaled by `handle`.
pub(super) fn of_amount(handle: Handle, amount: &Amount, frame: &Frame) -> String {
    match *amount {
        Amount::Move(by) => {
            let by = if frame.is_world { by } else { frame.axes.transpose() * by };
            let shown = |axis: usize| match handle {
                Handle::Axis(along) => axis == along,
                Handle::Plane(normal) => axis != normal,
                _ => true,
            };
            let parts = (0..3).filter(|axis| shown(*axis)).map(|axis| format!("{} {}", AXES[axis], signed(by[axis])));
            format!("Δ {} m", parts.collect::<Vec<_>>().join("  "))
        }
        Amount::Turn { angle, .. } => match handle {
            Handle::Ring(axis) => format!("{} {}°", AXES[axis], short(angle.to_degrees(), 1)),
            _ => format!("{}°", short(angle.to_degrees(), 1)),
        },
        Amount::Scale { factors, .. } => match handle {
            Handle::Stretch(axis) => format!("{} × {}", AXES[axis], short(factors[axis], 3)),
            _ => format!("× {}", short(factors.x, 3)),
        },
    }
}

/// What `now` is, of what `handle` changes of it.
pub(super) fn of_shape(handle: Handle, now: &Subject, projection: &Projection) -> String {
    match (handle, now) {
        (Handle::Radius, _) => {
            let radius = rim(now, projection).map(|[center, point]| center.distance(point));
            radius.map_or_else(String::new, |radius| format!("r {}", length_text(radius)))
        }
        (Handle::End(_), Subject::Light(light)) => match &light.shape {
            Shape::Line(line) => length_text(line.length),
            _ => String::new(),
        },
        (Handle::HalfAngle, Subject::Light(light)) => match &light.shape {
            Shape::Cap(cap) => format!("half-angle {}°", short(cap.half_angle_deg, 1)),
            _ => String::new(),
        },
        (Handle::Side(signs), _) => sizes(now, signs),
        (Handle::Aim | Handle::Target, _) => direction_text(-now.rotation().z_axis),
        (Handle::Normal, Subject::Probe(plot)) => direction_text(plot.normal),
        (Handle::Probe, Subject::Probe(plot)) => point_text(plot.position),
        (Handle::Control(_), _) | (_, _) => String::new(),
    }
}

/// Both sizes of a flat thing; of a solid that which is changed.
fn sizes(subject: &Subject, signs: [i8; 3]) -> String {
    let Some((size, world_from_own)) = extent(subject) else { return String::new() };
    let metres = |axis: usize| length_text(size[axis] * world_from_own.matrix3.col(axis).length());
    if size.z == 0.0 {
        return format!("{} × {}", metres(0), metres(1));
    }
    signs.iter().position(|sign| *sign != 0).map(metres).unwrap_or_default()
}

/// A point in metres.
pub fn point_text(p: DVec3) -> String {
    let [x, y, z] = p.to_array().map(|coordinate| short(coordinate, 3));
    format!("{x}, {y}, {z} m")
}

/// A direction by its angle above the horizon and its azimuth from +X.
pub fn direction_text(direction: DVec3) -> String {
    let across = direction.x.hypot(direction.y);
    let elevation = short(direction.z.atan2(across).to_degrees(), 1);
    let azimuth = short(direction.y.atan2(direction.x).to_degrees(), 1);
    format!("elevation {elevation}°  azimuth {azimuth}°")
}

/// With a sign, and millimetres.
fn signed(value: f64) -> String {
    let text = short(value, 3);
    if text.starts_with('-') || text == "0.000" { text } else { format!("+{text}") }
}

/// With so many decimals, and no minus before zero.
fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| matches!(c, '0' | '.')) => rest.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    fn frame(is_world: bool) -> Frame {
        let axes = if is_world { DMat3::IDENTITY } else { DMat3::from_rotation_z(std::f64::consts::FRAC_PI_2) };
        Frame { origin: DVec3::ZERO, axes, is_world, pivot: None }
    }

    #[test]
    fn amounts_are_told_in_metres_degrees_and_factors() {
        let by = Amount::Move(DVec3::new(0.5, -0.25, 0.0));
        assert_eq!(of_amount(Handle::Axis(0), &by, &frame(true)), "Δ X +0.500 m", "along an axis");
        assert_eq!(of_amount(Handle::Plane(2), &by, &frame(true)), "Δ X +0.500  Y -0.250 m", "in a plane");
        assert_eq!(of_amount(Handle::Plane(2), &by, &frame(false)), "Δ X -0.250  Y -0.500 m", "in its own axes");
        let turn = Amount::Turn { axis: DVec3::Z, angle: -0.5 };
        assert_eq!(of_amount(Handle::Ring(2), &turn, &frame(true)), "Z -28.6°", "turned");
        let scale = Amount::Scale { axes: DMat3::IDENTITY, factors: DVec3::new(1.0, 1.5, 1.0) };
        assert_eq!(of_amount(Handle::Stretch(1), &scale, &frame(true)), "Y × 1.500", "stretched");
    }

    #[test]
    fn nothing_is_told_as_minus_zero() {
        assert_eq!(signed(-0.000_1), "0.000", "less than shown");
        assert_eq!(direction_text(DVec3::NEG_Z), "elevation -90.0°  azimuth 0.0°", "straight down");
    }
}
