//! Turning lights to what they shall light.

use glam::{DMat3, DQuat, DVec3};

use super::drag::Change;
use super::pull::{ANGLE_STEP_DEG, Pull};
use super::subject::{Subject, tidied};
use super::{Handle, Outline, Spot};
use crate::editor::tools::work_plane::snapped_to;
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::ray::Ray;
use crate::light::{Emitter, Light, Point, Shape};
use crate::math::frame;

/// Distance of the handle that aims a light, where it lies beyond the arrows that move it, screen points.
const REACH: f64 = 112.0;
/// A target further than this, screen points, is out of hand: the handle is nearer then.
const FARTHEST: f64 = 400.0;
/// A light closer to straight up or down than this sine has no side that is up.
const LEAST_TILT: f64 = 0.02;

/// Whether a light shines differently after it has been turned.
pub fn can_aim(light: &Light) -> bool {
    !matches!(light.shape, Shape::Sphere(_) | Shape::Point(Point { ies: None }))
}

/// Whether a light fills directions and has no place.
pub fn is_far(light: &Light) -> bool {
    matches!(light.shape, Shape::Cap(_) | Shape::Sky(_) | Shape::Directional(_))
}

/// The middle of a light: a polygon's centre of area, else its origin.
pub fn center(light: &Light) -> DVec3 {
    match light.emitter() {
        Emitter::Polygon(polygon) => polygon.centroid(),
        _ => light.position,
    }
}

/// The same light turned, to a millionth of a degree, with its middle at `middle`, to a micrometre.
pub fn placed(light: &Light, rotation: DMat3, middle: DVec3) -> Light {
    let mut placed = light.clone();
    if can_aim(light) {
        placed.rotation_deg = tidied(frame::deg_from_rotation(rotation));
    }
    let from_origin = center(&placed) - placed.position;
    placed.position = tidied(middle - from_origin);
    placed
}

/// The light turned about its middle so that its lit side, −Z, faces `target`; `None` where that is its middle.
pub fn aimed(light: &Light, target: DVec3) -> Option<Light> {
    let middle = center(light);
    let direction = (target - middle).try_normalize()?;
    let rotation = facing(frame::rotation_from_deg(light.rotation_deg), direction);
    let aimed = placed(light, rotation, middle);
    // A light about its own middle stays where it is.
    Some(if middle == light.position { Light { position: light.position, ..aimed } } else { aimed })
}

/// The rotation whose −Z is `direction`, with the roll of `rotation`.
///
/// Roll is measured from upright: X level, Y not downward. What looks straight up or down has none; it keeps the quarter
/// turn that is nearest to turning it the shortest way.
pub fn facing(rotation: DMat3, direction: DVec3) -> DMat3 {
    let z = -direction;
    let shortest = DMat3::from_quat(DQuat::from_rotation_arc(rotation.z_axis, z)) * rotation;
    let Some(upright) = upright(z) else { return shortest };
    let roll = match self::upright(rotation.z_axis) {
        Some(from) => roll(from, rotation),
        None => {
            let quarter = std::f64::consts::FRAC_PI_2;
            (roll(upright, shortest) / quarter).round() * quarter
        }
    };
    upright * DMat3::from_rotation_z(roll)
}

/// The frame of that Z whose X is level and whose Y is not below; `None` near straight up or down.
fn upright(z: DVec3) -> Option<DMat3> {
    let level = DVec3::Z.cross(z);
    let x = (level.length() >= LEAST_TILT).then(|| level.normalize())?;
    Some(DMat3::from_cols(x, z.cross(x), z))
}

/// The angle about the common Z from one frame to another, radians.
fn roll(from: DMat3, to: DMat3) -> f64 {
    to.x_axis.dot(from.y_axis).atan2(to.x_axis.dot(from.x_axis))
}

/// The handle that aims: of a light infinitely far away in the direction it comes from; of one that has a lit side
/// where that faces a surface, or as far before it as the handles that move it reach.
pub(super) fn spot(light: &Light, projection: &Projection, solids: &Solids) -> Option<Spot> {
    if !can_aim(light) || matches!(light.shape, Shape::Line(_)) {
        return None;
    }
    let (handle, from, to) = if is_far(light) {
        (Handle::Aim, light.position, tip(light, projection))
    } else {
        (Handle::Target, center(light), target(light, projection, solids))
    };
    let ends = [projection.project(from)?, projection.project(to)?];
    Some(Spot { handle, outline: Outline::Pin(ends) })
}

/// Where the handle in the direction that a light comes from is.
fn tip(light: &Light, projection: &Projection) -> DVec3 {
    light.position + reach(light.position, projection) * light.world_from_light().matrix3.z_axis
}

/// Distance from `center` to the handle that aims, metres.
pub(super) fn reach(center: DVec3, projection: &Projection) -> f64 {
    REACH * projection.metres_per_point(center)
}

/// What a light's middle faces: a surface where there is one near enough, else a point before it.
pub(super) fn target(light: &Light, projection: &Projection, solids: &Solids) -> DVec3 {
    let ray = Ray { origin: center(light), direction: -light.world_from_light().matrix3.z_axis };
    let [least, most] = [REACH, FARTHEST].map(|points| points * projection.metres_per_point(ray.origin));
    let distance = solids.nearest(&ray).map(|(_, hit)| hit.t).filter(|t| *t < most);
    ray.at(distance.unwrap_or(least))
}

/// A light turned to the surface under the pointer, or to where the pointer is at the distance of its handle.
pub(super) fn to_target(pull: &Pull<'_>, start: &Subject, solids: &Solids) -> Option<Change> {
    let Subject::Light(light) = start else { return None };
    let under = solids.nearest(&pull.rays[1]).map(|(_, hit)| hit.p);
    let held = target(light, pull.projection, solids);
    let mut to = match under {
        Some(p) => p,
        None => held + pull.shift(held, pull.projection.forward())?,
    };
    if under.is_none() {
        to = DVec3::from_array(to.to_array().map(|coordinate| pull.snapped(coordinate)));
    } else if pull.snap.is_some() {
        (to.x, to.y) = (pull.snapped(to.x), pull.snapped(to.y));
    }
    aimed(light, to).map(|light| Change::To(Subject::Light(light)))
}

/// A light whose +Z follows the pointer over a sphere about it.
pub(super) fn comes_from(pull: &Pull<'_>, start: &Subject) -> Option<Change> {
    let Subject::Light(light) = start else { return None };
    let axis = start.rotation().z_axis;
    let [from, to] = pull.directions(light.position, reach(light.position, pull.projection), axis);
    let direction = stepped(DQuat::from_rotation_arc(from, to) * axis, pull.snap.is_some());
    let rotation = facing(start.rotation(), -direction);
    Some(Change::To(start.clone().turned(rotation)))
}

/// A direction whose angles from the zenith and about it are multiples of 15° where it snaps.
pub(super) fn stepped(direction: DVec3, snaps: bool) -> DVec3 {
    if !snaps {
        return direction;
    }
    let step = |angle: f64| snapped_to(angle.to_degrees(), ANGLE_STEP_DEG).to_radians();
    let (sin_theta, cos_theta) = step(direction.x.hypot(direction.y).atan2(direction.z)).sin_cos();
    let (sin_phi, cos_phi) = step(direction.y.atan2(direction.x)).sin_cos();
    DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Polygon, Sphere};
    use glam::dvec2;

    fn panel(position: DVec3, rotation_deg: DVec3) -> Light {
        let vertices = vec![dvec2(-1.0, -0.5), dvec2(1.0, -0.5), dvec2(1.0, 0.5), dvec2(-1.0, 0.5)];
        let shape = Shape::Polygon(Polygon { vertices, two_sided: false });
        Light { position, rotation_deg, ..Light::new("panel", shape) }
    }

    fn axes(light: &Light) -> DMat3 {
        frame::rotation_from_deg(light.rotation_deg)
    }

    #[test]
    fn an_aimed_light_faces_its_target_from_where_it_was() {
        for target in [DVec3::ZERO, DVec3::new(4.0, -1.0, 0.3), DVec3::new(1.0, 2.0, 9.0), DVec3::new(1.0, 2.0, 0.0)] {
            let before = panel(DVec3::new(1.0, 2.0, 3.0), DVec3::new(10.0, 20.0, 30.0));
            let light = aimed(&before, target).expect("a target apart");
            let to_target = (target - light.position).normalize();
            assert!((-axes(&light).z_axis).distance(to_target) < 1e-7, "{target}: {}", -axes(&light).z_axis);
            assert_eq!(light.position, before.position, "{target}: it stays");
        }
        let before = panel(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO);
        assert_eq!(aimed(&before, before.position), None, "at itself");
    }

    #[test]
    fn a_light_off_its_origin_is_turned_about_its_middle() {
        let mut light = panel(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO);
        let Shape::Polygon(polygon) = &mut light.shape else { panic!("a polygon") };
        polygon.vertices.iter_mut().for_each(|v| *v += dvec2(5.0, 0.0));
        let target = DVec3::new(9.0, 1.0, 0.0);
        let turned = aimed(&light, target).expect("a target apart");
        assert!(center(&turned).distance(center(&light)) < 2e-6, "{} was {}", center(&turned), center(&light));
        let to_target = (target - center(&turned)).normalize();
        assert!((-axes(&turned).z_axis).distance(to_target) < 1e-6, "it faces the target from its middle");
    }

    #[test]
    fn a_level_light_stays_level_wherever_it_is_aimed() {
        let mut light = panel(DVec3::new(0.0, -3.0, 2.0), DVec3::new(60.0, 0.0, 0.0));
        for target in [DVec3::X, DVec3::new(-4.0, 2.0, 5.0), DVec3::new(3.0, -9.0, 0.0), DVec3::NEG_X] {
            light = aimed(&light, target).expect("a target apart");
            let axes = axes(&light);
            assert!(axes.x_axis.z.abs() < 1e-7, "{target}: X is level: {}", axes.x_axis);
            assert!(axes.y_axis.z > 0.0, "{target}: Y is up: {}", axes.y_axis);
        }
    }

    #[test]
    fn a_rolled_light_keeps_its_roll() {
        let start = facing(DMat3::IDENTITY, DVec3::new(0.0, 1.0, -0.5).normalize()) * DMat3::from_rotation_z(0.3);
        let turned = facing(start, DVec3::new(-1.0, 0.2, 0.4).normalize());
        let upright = upright(turned.z_axis).expect("not vertical");
        assert!((roll(upright, turned) - 0.3).abs() < 1e-12, "roll {}", roll(upright, turned));
    }

    #[test]
    fn a_light_that_looked_down_is_tilted_the_short_way_and_ends_level() {
        for (target, level) in [(DVec3::new(0.5, 0.1, 0.0), 1), (DVec3::new(0.1, 0.5, 0.0), 0)] {
            let light = aimed(&panel(DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO), target).expect("a target apart");
            let axes = axes(&light);
            assert!(axes.col(level).z.abs() < 1e-7, "{target}: axis {level} is level: {axes}");
            assert!(axes.col(level).dot(DVec3::AXES[level]) > 0.9, "{target}: and near to where it was: {axes}");
        }
    }

    #[test]
    fn a_sphere_is_not_turned() {
        let sphere = Light::new("globe", Shape::Sphere(Sphere { radius: 0.2 }));
        assert_eq!(aimed(&sphere, DVec3::X), Some(sphere), "it shines alike to all sides");
    }

    #[test]
    fn a_stepped_direction_has_angles_of_whole_steps() {
        let direction = stepped(DVec3::new(0.3, 0.35, 0.8).normalize(), true);
        let theta = direction.truncate().length().atan2(direction.z).to_degrees();
        let phi = direction.y.atan2(direction.x).to_degrees();
        assert!((theta - 30.0).abs() < 1e-9 && (phi - 45.0).abs() < 1e-9, "{theta} {phi}");
    }
}
