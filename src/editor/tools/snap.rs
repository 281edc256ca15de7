//! What drawing sticks to: corners of lights and surfaces, and directions.

use egui::Pos2;
use glam::{DVec2, DVec3};

use super::work_plane::{Frame, snapped_to};
use crate::editor::session::Item;
use crate::editor::viewport::pick;
use crate::editor::viewport::projection::Projection;
use crate::light::{Emitter, Light};
use crate::scene::Scene;
use crate::surface::{Shape, Surface};

/// The pointer sticks to a corner within this distance, points.
const REACH: f32 = 8.0;
/// On a plane seen flatly, what is further away on the plane than so many times the reach is not near.
const FLAT: f64 = 3.0;
/// Constrained directions are multiples of this, degrees.
const ANGLE_STEP_DEG: f64 = 15.0;
/// A disk has so many corners on its rim: where its axes end.
const QUARTERS: u32 = 4;

/// A corner that the pointer sticks to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Caught {
    /// The corner.
    pub corner: DVec3,
    /// The point of the work plane nearest to it, which is drawn at.
    pub at: DVec2,
}

/// Of all corners of lights and surfaces the one whose place on the work plane is nearest to the pointer and within
/// reach; the pointer is at `pos` on screen and over `free` on the plane.
pub fn corner(scene: &Scene, frame: &Frame, projection: &Projection, pos: Pos2, free: DVec2) -> Option<Caught> {
    let foot = |corner| frame.point(frame.coordinates(corner));
    let corner = nearest(&corners(scene, None), near_foot(foot, frame.point(free), projection), projection, pos)?;
    Some(Caught { corner, at: frame.coordinates(corner) })
}

/// The foot of a corner on a plane, where it is not far from the point `free` of that plane.
pub fn near_foot(
    foot: impl Fn(DVec3) -> DVec3,
    free: DVec3,
    projection: &Projection,
) -> impl Fn(DVec3) -> Option<DVec3> {
    let widest = FLAT * f64::from(REACH) * projection.metres_per_point(free);
    move |corner| Some(foot(corner)).filter(|at| at.distance(free) <= widest)
}

/// Corners of all lights and surfaces but one.
pub fn corners(scene: &Scene, without: Option<Item>) -> Vec<DVec3> {
    let lights = scene.lights.iter().enumerate().filter(|(i, _)| Some(Item::Light(*i)) != without);
    let surfaces = scene.surfaces.iter().enumerate().filter(|(i, _)| Some(Item::Surface(*i)) != without);
    let of_lights = lights.flat_map(|(_, light)| light_corners(light));
    of_lights.chain(surfaces.flat_map(|(_, surface)| surface_corners(surface))).collect()
}

/// Of `corners` the one whose place `at` is seen nearest to `pos` and within reach.
pub fn nearest(
    corners: &[DVec3],
    at: impl Fn(DVec3) -> Option<DVec3>,
    projection: &Projection,
    pos: Pos2,
) -> Option<DVec3> {
    let near = corners.iter().filter_map(|corner| {
        let distance = projection.project(at(*corner)?)?.distance(pos);
        (distance <= REACH).then_some((*corner, distance))
    });
    near.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(corner, _)| corner)
}

/// Corners of a light's outline, a line's ends, the centre of what is round.
fn light_corners(light: &Light) -> Vec<DVec3> {
    match light.emitter() {
        Emitter::Polygon(_) | Emitter::Textured(_) => pick::outline(light).unwrap_or_default(),
        Emitter::Line(line) => vec![line.a, line.b],
        Emitter::Disk(disk) => disk.rim(QUARTERS).chain([light.position]).collect(),
        Emitter::Sphere(_) | Emitter::Point(_) => vec![light.position],
        Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Directional(_) => Vec::new(),
    }
}

/// Corners of a box or square, the centre of what is round.
fn surface_corners(surface: &Surface) -> Vec<DVec3> {
    let half = match &surface.shape {
        Shape::Box { size } => 0.5 * *size,
        Shape::Square { size } => 0.5 * size.extend(0.0),
        Shape::Plane {}
        | Shape::Mesh(_)
        | Shape::Patch { .. }
        | Shape::Sphereflake { .. }
        | Shape::Tetrahedron { .. } => {
            return Vec::new();
        }
        _ => return vec![surface.position],
    };
    let place = surface.world_from_surface();
    let signs = [-1.0, 1.0];
    let corners = signs.into_iter().flat_map(|x| signs.into_iter().map(move |y| (x, y)));
    let corners = corners.flat_map(|(x, y)| signs.into_iter().map(move |z| DVec3::new(x, y, z)));
    corners.map(|signs| place.transform_point3(signs * half)).collect()
}

/// `p` moved into the nearest direction from `from` that is a multiple of 15°; with a `step`, so far away that it is a
/// multiple of that.
pub fn constrained(from: DVec2, p: DVec2, step: Option<f64>) -> DVec2 {
    let along = p - from;
    let angle = snapped_to(along.y.atan2(along.x).to_degrees(), ANGLE_STEP_DEG);
    let direction = direction(angle);
    let length = along.dot(direction);
    from + step.map_or(length, |step| snapped_to(length, step)) * direction
}

/// The unit vector of an angle in degrees; exact along the axes.
pub fn direction(angle_deg: f64) -> DVec2 {
    let quarters = angle_deg / 90.0;
    if quarters.fract() == 0.0 {
        let turns = quarters.rem_euclid(4.0);
        return match turns {
            t if t < 0.5 => DVec2::X,
            t if t < 1.5 => DVec2::Y,
            t if t < 2.5 => DVec2::NEG_X,
            _ => DVec2::NEG_Y,
        };
    }
    DVec2::from_angle(angle_deg.to_radians())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::new_light;
    use crate::scene::Camera;
    use egui::{Rect, pos2, vec2};
    use glam::dvec2;

    #[test]
    fn a_corner_is_caught_where_its_foot_on_the_plane_is_seen() {
        let corners = [dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0)];
        let scene = Scene { lights: vec![new_light::polygon(&corners, 3.0)], ..Scene::default() };
        let camera = Camera { eye: DVec3::new(3.0, -6.0, 6.0), target: DVec3::Z, fov_deg: 40.0 };
        let projection = Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)));
        let frame = Frame::level(2.0);
        let foot = projection.project(DVec3::new(1.0, 1.0, 2.0)).expect("in sight");
        let at = |pos| {
            let free = frame.meet(&projection.ray(pos)).expect("on the plane");
            corner(&scene, &frame, &projection, pos, free)
        };
        let caught = at(foot + vec2(4.0, -5.0)).expect("within reach");
        assert!(caught.at.distance(dvec2(1.0, 1.0)) < 1e-9, "{caught:?}");
        assert!(caught.corner.distance(DVec3::new(1.0, 1.0, 3.0)) < 1e-9, "{caught:?}");
        assert_eq!(at(foot + vec2(9.0, 0.0)), None, "out of reach");
        let far = dvec2(0.2, 1.0);
        assert_eq!(corner(&scene, &frame, &projection, foot, far), None, "far away on a plane seen flatly");
    }

    #[test]
    fn a_box_has_eight_corners_where_it_stands() {
        let surface = Surface {
            name: "box".to_owned(),
            material: String::new(),
            position: DVec3::new(1.0, 2.0, 0.5),
            rotation_deg: DVec3::new(0.0, 0.0, 90.0),
            scale: DVec3::ONE,
            shape: Shape::Box { size: DVec3::new(2.0, 1.0, 1.0) },
        };
        let corners = surface_corners(&surface);
        assert_eq!(corners.len(), 8, "{corners:?}");
        let expected = DVec3::new(1.5, 3.0, 1.0);
        assert!(corners.iter().any(|corner| corner.distance(expected) < 1e-12), "{corners:?}");
    }

    #[test]
    fn directions_are_multiples_of_15_degrees_and_lengths_of_the_step() {
        let from = dvec2(1.0, 1.0);
        assert_eq!(constrained(from, dvec2(3.04, 1.1), Some(0.1)), dvec2(3.0, 1.0), "along the axis, on the grid");
        let p = constrained(from, dvec2(2.0, 2.1), None) - from;
        assert!((p.x - p.y).abs() < 1e-12 && (p.length() - 1.05 * 2.0_f64.sqrt()).abs() < 1e-12, "45°: {p}");
        let p = constrained(from, dvec2(0.0, 0.7), Some(0.25)) - from;
        assert!((p.length() - 1.0).abs() < 1e-12, "a whole number of steps at 195°: {p}");
    }
}
