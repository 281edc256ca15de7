//! Handles on the selected thing: where they are on screen, which one the pointer is on, and how they look.
//!
//! [`spots`] lays the handles out, the same list is hit-tested and painted, so that what is seen is what is grabbed.
//! A [`drag::Drag`] says what the thing becomes while one is dragged.

pub mod drag;
pub mod grip;
mod paint;
pub mod subject;
pub mod vertices;

pub use paint::{AXIS_COLORS, paint};

use egui::Pos2;
use glam::DVec3;

use self::subject::Subject;
use super::session::Tool;
use super::viewport::projection::Projection;
use super::viewport::symbol::Symbol;
use crate::light;
use crate::surface;

/// One handle. Axes are 0, 1, 2 for X, Y, Z: the world's to move, the thing's own to rotate and scale.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handle {
    /// Move along an axis.
    Axis(usize),
    /// Move in the plane whose normal is an axis.
    Plane(usize),
    /// Rotate about an axis.
    Ring(usize),
    /// Scale along an axis.
    Stretch(usize),
    /// Scale as a whole.
    Scale,
    /// Move a polygon's vertex in its plane.
    Vertex(usize),
    /// Move a polygon's edge along its normal; the index is that of its first vertex.
    Edge(usize),
    /// Move an end of a line: 0 or 1.
    End(usize),
    /// Move a rectangle's side or corner: which, by the signs of its coordinates.
    Frame([i8; 2]),
    /// Change a sphere's or a disk's radius.
    Radius,
    /// Change a cap's half-angle.
    HalfAngle,
    /// Turn a light infinitely far away to where it comes from.
    Aim,
    /// Move a probe over the surfaces.
    Probe,
}

/// Where a handle is on screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A round dot.
    Dot(Pos2),
    /// A small diamond.
    Diamond(Pos2),
    /// A dot at the end of a thin line; the dot alone is held.
    Pin([Pos2; 2]),
    /// From the centre to a tip.
    Arrow([Pos2; 2]),
    /// From the centre to a knob.
    Lever([Pos2; 2]),
    /// A small filled quadrilateral.
    Patch([Pos2; 4]),
    /// A closed curve, cut where it is out of sight.
    Ring(Vec<[Pos2; 2]>),
}

/// A handle and its place on screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// Which handle.
    pub handle: Handle,
    /// Where.
    pub outline: Outline,
}

/// Length of the move, rotate and scale handles, screen points.
const GIZMO: f64 = 84.0;
/// The plane squares reach from here to there along both axes, as shares of [`GIZMO`].
const PATCH: [f64; 2] = [0.26, 0.44];
/// Arrows shorter than this on screen point at the eye and are left out, points.
const LEAST_ARROW: f32 = 14.0;
/// Rings and squares seen at a smaller sine than this are left out.
const LEAST_FACING: f64 = 0.12;
/// The pointer is on a handle within this distance, points.
const REACH: f32 = 7.0;
/// Radius of a dot, points.
const DOT: f32 = 4.5;
/// What counts as the distance of the inside of a patch, points.
const INSIDE: f32 = 3.0;
/// Distance of the handle that aims a light, beyond the arrows that move it, screen points.
const AIM: f64 = 112.0;
/// Sides and corners of a rectangle.
const FRAME: [[i8; 2]; 8] = [[1, 1], [-1, 1], [-1, -1], [1, -1], [1, 0], [0, 1], [-1, 0], [0, -1]];
/// Segments of a ring.
const RING_SEGMENTS: u32 = 64;

/// The handles of `subject` under `tool`, those that win where they overlap first.
pub fn spots(subject: &Subject, tool: Tool, projection: &Projection) -> Vec<Spot> {
    let mut spots = Vec::new();
    let gizmo = Gizmo::new(subject, projection);
    match (tool, subject) {
        (_, Subject::Probe(plot)) => spots.extend(dot(Handle::Probe, plot.position, projection)),
        (Tool::Rotate, _) => spots.extend(turning_axes(subject).iter().filter_map(|axis| gizmo.ring(*axis))),
        (Tool::Scale, _) => gizmo.levers(subject, &mut spots),
        _ => {
            if let Subject::Light(light) = subject {
                shape_spots(light, projection, &mut spots);
            }
            spots.extend((0..3).filter_map(|axis| gizmo.arrow(axis)));
            spots.extend((0..3).filter_map(|axis| gizmo.patch(axis)));
        }
    }
    spots
}

/// The handle under the pointer: of those within reach the nearest, of those equally near the first in the list.
pub fn hit(spots: &[Spot], pos: Pos2) -> Option<Handle> {
    let near = spots.iter().map(|spot| (spot.handle, spot.outline.distance(pos)));
    let nearest = near.filter(|(_, distance)| *distance <= REACH).min_by(|(_, a), (_, b)| a.total_cmp(b));
    nearest.map(|(handle, _)| handle)
}

impl Outline {
    /// Distance on screen from `pos`. Inside of a patch it is `INSIDE`, so that an arrow before it can be had.
    pub fn distance(&self, pos: Pos2) -> f32 {
        match self {
            Self::Dot(at) | Self::Diamond(at) | Self::Pin([_, at]) => (at.distance(pos) - DOT).max(0.0),
            // The root of an arrow belongs to the squares and to what lies there.
            Self::Arrow([from, to]) | Self::Lever([from, to]) => segment_distance([from.lerp(*to, 0.25), *to], pos),
            Self::Patch(corners) => {
                if inside(corners, pos) {
                    INSIDE
                } else {
                    (0..4).map(|i| segment_distance([corners[i], corners[(i + 1) % 4]], pos)).fold(f32::MAX, f32::min)
                }
            }
            Self::Ring(pieces) => pieces.iter().map(|piece| segment_distance(*piece, pos)).fold(f32::MAX, f32::min),
        }
    }
}

/// Distance from a point to a segment on screen.
pub fn segment_distance([a, b]: [Pos2; 2], pos: Pos2) -> f32 {
    let along = b - a;
    let length_sq = along.length_sq();
    let share = if length_sq > 0.0 { ((pos - a).dot(along) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    pos.distance(a + share * along)
}

/// Whether `pos` lies inside of a polygon on screen, by the even-odd rule.
fn inside(corners: &[Pos2], pos: Pos2) -> bool {
    let mut inside = false;
    let mut previous = corners.last();
    for corner in corners {
        if let Some(from) = previous
            && (corner.y > pos.y) != (from.y > pos.y)
            && pos.x < (from.x - corner.x) * (pos.y - corner.y) / (from.y - corner.y) + corner.x
        {
            inside = !inside;
        }
        previous = Some(corner);
    }
    inside
}

/// The axes about which turning the thing changes anything.
fn turning_axes(subject: &Subject) -> &'static [usize] {
    match subject {
        Subject::Light(light) => match light.shape {
            light::Shape::Polygon(_) | light::Shape::Textured(_) => &[0, 1, 2],
            light::Shape::Line(_) => &[1, 2],
            light::Shape::Disk(_) | light::Shape::Cap(_) | light::Shape::Sky(_) | light::Shape::Directional(_) => {
                &[0, 1]
            }
            light::Shape::Sphere(_) | light::Shape::Point(_) => &[],
        },
        Subject::Surface(surface) => match surface.shape {
            surface::Shape::Sphere { .. } if surface.scale == DVec3::ONE => &[],
            _ => &[0, 1, 2],
        },
        Subject::Probe(_) => &[],
    }
}

/// The axes along which the thing can be stretched, and whether it can be scaled as a whole.
fn stretching(subject: &Subject) -> (&'static [usize], bool) {
    match subject {
        Subject::Light(light) => match light.shape {
            light::Shape::Polygon(_) | light::Shape::Textured(_) => (&[0, 1], true),
            light::Shape::Line(_) => (&[0], true),
            light::Shape::Sphere(_) | light::Shape::Disk(_) => (&[], true),
            light::Shape::Cap(_) | light::Shape::Sky(_) | light::Shape::Point(_) | light::Shape::Directional(_) => {
                (&[], false)
            }
        },
        Subject::Surface(surface) => match surface.shape {
            surface::Shape::Plane {} => (&[], false),
            surface::Shape::Square { .. } | surface::Shape::Disk { .. } => (&[0, 1], true),
            _ => (&[0, 1, 2], true),
        },
        Subject::Probe(_) => (&[], false),
    }
}

/// Handles on a light's own shape.
fn shape_spots(light: &light::Light, projection: &Projection, spots: &mut Vec<Spot>) {
    let world_from_light = light.world_from_light();
    match &light.shape {
        light::Shape::Polygon(polygon) => vertices::spots(polygon, &world_from_light, projection, spots),
        light::Shape::Line(line) => {
            let half = 0.5 * line.length * DVec3::X;
            let ends = [-half, half].map(|p| world_from_light.transform_point3(p));
            spots.extend(ends.iter().enumerate().filter_map(|(i, p)| dot(Handle::End(i), *p, projection)));
        }
        light::Shape::Sphere(sphere) => {
            let [right, _] = projection.right_up();
            spots.extend(dot(Handle::Radius, light.position + sphere.radius * right, projection));
        }
        light::Shape::Disk(disk) => {
            let [right, up] = [world_from_light.matrix3.x_axis, world_from_light.matrix3.y_axis];
            spots.extend(dot(Handle::Radius, light.position + disk.radius * right, projection));
            let pieces = circle(light.position, disk.radius * right, disk.radius * up, projection);
            spots.push(Spot { handle: Handle::Radius, outline: Outline::Ring(pieces) });
        }
        light::Shape::Textured(textured) => {
            let half = [0.5 * textured.size.x, 0.5 * textured.size.y];
            let at = |[x, y]: [i8; 2]| DVec3::new(f64::from(x) * half[0], f64::from(y) * half[1], 0.0);
            spots.extend(FRAME.into_iter().filter_map(|signs| {
                let at = projection.project(world_from_light.transform_point3(at(signs)))?;
                let corner = !signs.contains(&0);
                let outline = if corner { Outline::Dot(at) } else { Outline::Diamond(at) };
                Some(Spot { handle: Handle::Frame(signs), outline })
            }));
        }
        light::Shape::Cap(cap) => {
            let rim = Symbol::new(light, projection).point(cap.half_angle_deg.to_radians(), 0.0);
            spots.extend(dot(Handle::HalfAngle, rim, projection));
            spots.extend(aim(light, projection));
        }
        light::Shape::Sky(_) | light::Shape::Directional(_) => spots.extend(aim(light, projection)),
        light::Shape::Point(_) => {}
    }
}

fn dot(handle: Handle, p: DVec3, projection: &Projection) -> Option<Spot> {
    projection.project(p).map(|at| Spot { handle, outline: Outline::Dot(at) })
}

/// The handle in the direction that a light comes from.
fn aim(light: &light::Light, projection: &Projection) -> Option<Spot> {
    let to_light = light.world_from_light().matrix3.z_axis;
    let tip = light.position + aim_reach(light.position, projection) * to_light;
    let ends = [projection.project(light.position)?, projection.project(tip)?];
    Some(Spot { handle: Handle::Aim, outline: Outline::Pin(ends) })
}

/// Distance from `center` to the handle that aims, metres.
fn aim_reach(center: DVec3, projection: &Projection) -> f64 {
    AIM * projection.metres_per_point(center)
}

/// The circle on screen of which `u` and `v` are radii.
fn circle(center: DVec3, u: DVec3, v: DVec3, projection: &Projection) -> Vec<[Pos2; 2]> {
    let at = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(RING_SEGMENTS)).sin_cos();
        center + cos * u + sin * v
    };
    (0..RING_SEGMENTS).filter_map(|i| projection.segment(at(i), at(i + 1))).collect()
}

/// Axes of constant size on screen, about a thing.
struct Gizmo<'a> {
    projection: &'a Projection,
    center: DVec3,
    center_on_screen: Option<Pos2>,
    size: f64,
    /// The thing's own axes.
    own: [DVec3; 3],
}

impl<'a> Gizmo<'a> {
    fn new(subject: &Subject, projection: &'a Projection) -> Self {
        let center = subject.position();
        let rotation = subject.rotation();
        Self {
            projection,
            center,
            center_on_screen: projection.project(center),
            size: GIZMO * projection.metres_per_point(center),
            own: [rotation.x_axis, rotation.y_axis, rotation.z_axis],
        }
    }

    /// From the centre to the tip of an axis, where that can be seen well enough.
    fn shaft(&self, axis: DVec3) -> Option<[Pos2; 2]> {
        let from = self.center_on_screen?;
        let to = self.projection.project(self.center + self.size * axis)?;
        (from.distance(to) >= LEAST_ARROW).then_some([from, to])
    }

    /// Cosine between the direction to the eye and an axis.
    fn facing(&self, axis: DVec3) -> f64 {
        (self.projection.camera().eye - self.center).normalize_or(DVec3::Z).dot(axis).abs()
    }

    fn arrow(&self, axis: usize) -> Option<Spot> {
        self.shaft(DVec3::AXES[axis]).map(|shaft| Spot { handle: Handle::Axis(axis), outline: Outline::Arrow(shaft) })
    }

    fn patch(&self, normal: usize) -> Option<Spot> {
        if self.facing(DVec3::AXES[normal]) < LEAST_FACING {
            return None;
        }
        let [u, v] = [DVec3::AXES[(normal + 1) % 3], DVec3::AXES[(normal + 2) % 3]].map(|axis| self.size * axis);
        let [near, far] = PATCH;
        let corners = [(near, near), (far, near), (far, far), (near, far)]
            .map(|(a, b)| self.projection.project(self.center + a * u + b * v));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else { return None };
        Some(Spot { handle: Handle::Plane(normal), outline: Outline::Patch([a, b, c, d]) })
    }

    fn ring(&self, axis: usize) -> Option<Spot> {
        self.center_on_screen?;
        if self.facing(self.own[axis]) < LEAST_FACING {
            return None;
        }
        let [u, v] = [self.own[(axis + 1) % 3], self.own[(axis + 2) % 3]].map(|own| self.size * own);
        let pieces = circle(self.center, u, v, self.projection);
        Some(Spot { handle: Handle::Ring(axis), outline: Outline::Ring(pieces) })
    }

    fn levers(&self, subject: &Subject, spots: &mut Vec<Spot>) {
        let (axes, whole) = stretching(subject);
        spots.extend(axes.iter().filter_map(|axis| {
            let shaft = self.shaft(self.own[*axis])?;
            Some(Spot { handle: Handle::Stretch(*axis), outline: Outline::Lever(shaft) })
        }));
        if whole {
            spots.extend(dot(Handle::Scale, self.center, self.projection));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::tools::new_light;
    use crate::scene::Camera;
    use egui::{Rect, pos2};
    use glam::dvec2;

    fn projection(eye: DVec3) -> Projection {
        let camera = Camera { eye, target: DVec3::new(0.0, 0.0, 2.0), fov_deg: 40.0 };
        Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)))
    }

    fn square() -> Subject {
        let corners = [dvec2(-1.0, -1.0), dvec2(1.0, -1.0), dvec2(1.0, 1.0), dvec2(-1.0, 1.0)];
        Subject::Light(new_light::polygon(&corners, 2.0))
    }

    fn of_shape(shape: light::Shape) -> Subject {
        let light = light::Light::new("light", shape);
        Subject::Light(light::Light { position: DVec3::new(0.0, 0.0, 2.0), ..light })
    }

    fn textured() -> light::Shape {
        let pattern = light::pattern::Pattern::unread("leaf.png");
        light::Shape::Textured(light::Textured { size: dvec2(2.0, 1.0), pattern, two_sided: false })
    }

    fn handles(spots: &[Spot]) -> Vec<Handle> {
        spots.iter().map(|spot| spot.handle).collect()
    }

    #[test]
    fn every_handle_is_hit_where_it_is_drawn() {
        let projection = projection(DVec3::new(4.0, -5.0, 6.5));
        let moves = 3 + 3;
        for (subject, own) in [
            (square(), 4 + 4),
            (of_shape(light::Shape::Disk(light::Disk { radius: 1.0, two_sided: false })), 2),
            (of_shape(textured()), 8),
            (of_shape(light::Shape::Cap(light::Cap { half_angle_deg: 20.0 })), 2),
            (of_shape(light::Shape::Sky(light::Sky::OVERCAST)), 1),
            (of_shape(light::Shape::Directional(light::Directional {})), 1),
            (of_shape(light::Shape::Point(light::Point {})), 0),
        ] {
            let spots = spots(&subject, Tool::Move, &projection);
            assert_eq!(spots.len(), own + moves, "{:?}", handles(&spots));
            check_hits(&spots);
        }
    }

    #[track_caller]
    fn check_hits(spots: &[Spot]) {
        for spot in spots {
            let at = match &spot.outline {
                Outline::Dot(at) | Outline::Diamond(at) | Outline::Pin([_, at]) => *at,
                Outline::Arrow([_, tip]) | Outline::Lever([_, tip]) => *tip,
                Outline::Patch([_, _, corner, _]) => *corner,
                Outline::Ring(pieces) => pieces[0][0],
            };
            assert_eq!(hit(spots, at), Some(spot.handle), "at {at:?}");
        }
        assert_eq!(hit(spots, pos2(5.0, 5.0)), None, "in the corner");
    }

    #[test]
    fn handles_keep_their_size_on_screen() {
        let length = |distance: f64| {
            let projection = projection(DVec3::new(0.0, -distance, 2.0));
            let spots = spots(&square(), Tool::Move, &projection);
            let up = spots.iter().find(|spot| spot.handle == Handle::Axis(2)).expect("the Z arrow");
            let Outline::Arrow([from, to]) = up.outline else { panic!("an arrow") };
            from.distance(to)
        };
        assert!((length(3.0) - length(30.0)).abs() < 0.01, "{} and {}", length(3.0), length(30.0));
    }

    #[test]
    fn an_axis_that_points_at_the_eye_has_no_arrow_and_a_plane_seen_edge_on_no_square() {
        let spots = spots(&square(), Tool::Move, &projection(DVec3::new(0.0, -6.0, 2.0)));
        let handles = handles(&spots);
        assert!(!handles.contains(&Handle::Axis(1)), "Y points at the eye: {handles:?}");
        assert!(!handles.contains(&Handle::Plane(2)), "XY is edge-on: {handles:?}");
        assert!(handles.contains(&Handle::Axis(0)) && handles.contains(&Handle::Plane(1)), "{handles:?}");
    }

    #[test]
    fn a_line_can_not_be_turned_about_itself_nor_a_sphere_at_all() {
        let projection = projection(DVec3::new(3.0, -6.0, 5.0));
        let line = new_light::line([dvec2(0.0, 0.0), dvec2(1.0, 0.0)], 2.0).expect("a line");
        assert_eq!(
            handles(&spots(&Subject::Light(line), Tool::Rotate, &projection)),
            [Handle::Ring(1), Handle::Ring(2)],
            "a line"
        );
        let sphere = new_light::sphere(dvec2(0.0, 0.0), 2.0, 0.3).expect("a sphere");
        assert_eq!(handles(&spots(&Subject::Light(sphere.clone()), Tool::Rotate, &projection)), [], "a sphere");
        assert_eq!(handles(&spots(&Subject::Light(sphere), Tool::Scale, &projection)), [Handle::Scale], "scaled");
    }

    #[test]
    fn the_inside_of_a_screen_polygon_is_even_odd() {
        let l_shape = [pos2(0.0, 0.0), pos2(4.0, 0.0), pos2(4.0, 1.0), pos2(1.0, 1.0), pos2(1.0, 4.0), pos2(0.0, 4.0)];
        assert!(inside(&l_shape, pos2(0.5, 3.0)) && inside(&l_shape, pos2(3.0, 0.5)), "both arms");
        assert!(!inside(&l_shape, pos2(2.0, 2.0)), "the notch");
    }
}
