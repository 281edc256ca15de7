//! Handles that move, turn and scale all that is selected: arrows, squares, rings and levers of constant size on screen.

use egui::Pos2;
use glam::DVec3;

use super::frame::Frame;
use super::subject::Subject;
use super::{Handle, Outline, Spot, dot};
use crate::editor::session::{Item, Tool};
use crate::editor::viewport::projection::Projection;
use crate::light;
use crate::surface;

/// Length of the handles, screen points.
const SIZE: f64 = 84.0;
/// The plane squares reach from here to there along both axes, as shares of [`SIZE`].
const PATCH: [f64; 2] = [0.26, 0.44];
/// Radius of the ring that faces the eye, as a share of [`SIZE`].
const SCREEN_RING: f64 = 1.2;
/// Arrows shorter than this on screen point at the eye and are left out, points.
const LEAST_ARROW: f32 = 14.0;
/// Rings and squares seen at a smaller sine than this are left out.
const LEAST_FACING: f64 = 0.12;
/// Segments of a ring.
const SEGMENTS: u32 = 64;
/// Axes closer to each other than this sine are one.
const SAME: f64 = 1e-6;

/// The handles of `tool` on `subjects`, those that win where they overlap first.
pub(super) fn spots(frame: &Frame, subjects: &[(Item, Subject)], tool: Tool, projection: &Projection) -> Vec<Spot> {
    let gizmo = Gizmo { projection, frame, size: SIZE * projection.metres_per_point(frame.origin) };
    let any = |does: &dyn Fn(&Subject) -> bool| subjects.iter().any(|(_, subject)| does(subject));
    match tool {
        Tool::Rotate => {
            let turns = |axis: DVec3| any(&|subject| turns(subject, frame, axis));
            let rings = (0..3).filter(|axis| turns(frame.axes.col(*axis))).filter_map(|axis| gizmo.ring(axis));
            let rings: Vec<Spot> = rings.collect();
            let screen = (0..3).any(|axis| turns(frame.axes.col(axis))).then(|| gizmo.screen_ring()).flatten();
            rings.into_iter().chain(screen).collect()
        }
        Tool::Scale => {
            let stretches = |axis: &usize| any(&|subject| stretches(subject, frame, frame.axes.col(*axis)));
            let levers = (0..3).filter(stretches).filter_map(|axis| gizmo.lever(axis));
            let whole = any(&|subject| scales(subject, frame)).then(|| dot(Handle::Scale, frame.origin, projection));
            whole.flatten().into_iter().chain(levers).collect()
        }
        _ => {
            let arrows = (0..3).filter_map(|axis| gizmo.arrow(axis));
            let patches = (0..3).filter_map(|axis| gizmo.patch(axis));
            // A probe is dragged over surfaces by its middle.
            let is_probe = matches!(subjects.last(), Some((_, Subject::Probe(_))));
            gizmo.screen().filter(|_| !is_probe).into_iter().chain(arrows).chain(patches).collect()
        }
    }
}

/// Whether a thing changes when it is turned about an axis through the pivot.
fn turns(subject: &Subject, frame: &Frame, axis: DVec3) -> bool {
    let arm = frame.pivot.map_or(DVec3::ZERO, |pivot| subject.position() - pivot);
    if arm.cross(axis).length() > SAME * arm.length() && arm.length() > 0.0 {
        return true;
    }
    let own = subject.rotation();
    let round_about = match subject {
        Subject::Light(light) => match &light.shape {
            light::Shape::Sphere(_) | light::Shape::Point(light::Point { ies: None }) => return false,
            light::Shape::Point(light::Point { ies: Some(file) }) if file.distribution.planes().len() > 1 => {
                return true;
            }
            light::Shape::Line(_) => own.x_axis,
            light::Shape::Point(_)
            | light::Shape::Disk(_)
            | light::Shape::Cap(_)
            | light::Shape::Sky(_)
            | light::Shape::Directional(_) => own.z_axis,
            light::Shape::Polygon(_) | light::Shape::Textured(_) => return true,
        },
        Subject::Surface(surface) => match surface.shape {
            surface::Shape::Sphere { .. } if surface.scale == DVec3::ONE => return false,
            surface::Shape::Plane {} => own.z_axis,
            surface::Shape::Disk { .. } | surface::Shape::Cylinder { .. } | surface::Shape::Cone { .. }
                if surface.scale.x == surface.scale.y =>
            {
                own.z_axis
            }
            _ => return true,
        },
        Subject::Probe(_) => return true,
    };
    round_about.cross(axis).length() > SAME
}

/// Whether a thing changes when it is stretched along an axis from the pivot.
fn stretches(subject: &Subject, frame: &Frame, axis: DVec3) -> bool {
    let arm = frame.pivot.map_or(DVec3::ZERO, |pivot| subject.position() - pivot);
    let own_axes: &[usize] = match subject {
        Subject::Light(light) => match light.shape {
            light::Shape::Polygon(_) | light::Shape::Textured(_) => &[0, 1],
            light::Shape::Line(_) => &[0],
            _ => &[],
        },
        Subject::Surface(surface) => match surface.shape {
            surface::Shape::Plane {} => &[],
            surface::Shape::Square { .. } | surface::Shape::Disk { .. } => &[0, 1],
            _ => &[0, 1, 2],
        },
        Subject::Probe(_) => &[],
    };
    let own = subject.rotation();
    own_axes.iter().any(|i| own.col(*i).dot(axis).abs() > SAME) || arm.dot(axis).abs() > SAME
}

/// Whether a thing changes when it is scaled as a whole.
fn scales(subject: &Subject, frame: &Frame) -> bool {
    let apart = frame.pivot.is_some_and(|pivot| subject.position() != pivot);
    let has_size = match subject {
        Subject::Light(light) => !matches!(
            light.shape,
            light::Shape::Cap(_) | light::Shape::Sky(_) | light::Shape::Point(_) | light::Shape::Directional(_)
        ),
        Subject::Surface(surface) => !matches!(surface.shape, surface::Shape::Plane {}),
        Subject::Probe(_) => false,
    };
    apart || has_size
}

/// The circle on screen of which `u` and `v` are radii.
pub(super) fn circle(center: DVec3, u: DVec3, v: DVec3, projection: &Projection) -> Vec<[Pos2; 2]> {
    let at = |i: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(i) / f64::from(SEGMENTS)).sin_cos();
        center + cos * u + sin * v
    };
    (0..SEGMENTS).filter_map(|i| projection.segment(at(i), at(i + 1))).collect()
}

/// Axes of constant size on screen.
struct Gizmo<'a> {
    projection: &'a Projection,
    frame: &'a Frame,
    /// In metres.
    size: f64,
}

impl Gizmo<'_> {
    fn axis(&self, axis: usize) -> DVec3 {
        self.frame.axes.col(axis)
    }

    /// From the origin to the tip of an axis, where that can be seen well enough.
    fn shaft(&self, axis: usize) -> Option<[Pos2; 2]> {
        let from = self.projection.project(self.frame.origin)?;
        let to = self.projection.project(self.frame.origin + self.size * self.axis(axis))?;
        (from.distance(to) >= LEAST_ARROW).then_some([from, to])
    }

    fn to_eye(&self) -> DVec3 {
        (self.projection.camera().eye - self.frame.origin).normalize_or(DVec3::Z)
    }

    /// Cosine between the direction to the eye and an axis.
    fn facing(&self, axis: usize) -> f64 {
        self.to_eye().dot(self.axis(axis)).abs()
    }

    fn arrow(&self, axis: usize) -> Option<Spot> {
        self.shaft(axis).map(|shaft| Spot { handle: Handle::Axis(axis), outline: Outline::Arrow(shaft) })
    }

    fn lever(&self, axis: usize) -> Option<Spot> {
        self.shaft(axis).map(|shaft| Spot { handle: Handle::Stretch(axis), outline: Outline::Lever(shaft) })
    }

    fn patch(&self, normal: usize) -> Option<Spot> {
        if self.facing(normal) < LEAST_FACING {
            return None;
        }
        let [u, v] = [(normal + 1) % 3, (normal + 2) % 3].map(|axis| self.size * self.axis(axis));
        let [near, far] = PATCH;
        let corners = [(near, near), (far, near), (far, far), (near, far)]
            .map(|(a, b)| self.projection.project(self.frame.origin + a * u + b * v));
        let [Some(a), Some(b), Some(c), Some(d)] = corners else { return None };
        Some(Spot { handle: Handle::Plane(normal), outline: Outline::Patch([a, b, c, d]) })
    }

    /// The half of the ring about an axis that is nearer to the eye.
    fn ring(&self, axis: usize) -> Option<Spot> {
        if self.facing(axis) < LEAST_FACING || self.projection.project(self.frame.origin).is_none() {
            return None;
        }
        let normal = self.axis(axis);
        // To the left and toward the eye in the ring's plane; the half between them and the right is in front.
        let v = (self.to_eye() - self.to_eye().dot(normal) * normal).try_normalize();
        let v = v.unwrap_or_else(|| normal.any_orthonormal_vector());
        let u = v.cross(normal);
        let at = |i: u32| {
            let (sin, cos) = (std::f64::consts::PI * f64::from(i) / f64::from(SEGMENTS / 2)).sin_cos();
            self.frame.origin + self.size * (cos * u + sin * v)
        };
        let pieces = (0..SEGMENTS / 2).filter_map(|i| self.projection.segment(at(i), at(i + 1))).collect();
        Some(Spot { handle: Handle::Ring(axis), outline: Outline::Ring(pieces) })
    }

    fn screen_ring(&self) -> Option<Spot> {
        self.projection.project(self.frame.origin)?;
        let (u, v) = self.to_eye().any_orthonormal_pair();
        let radius = SCREEN_RING * self.size;
        let pieces = circle(self.frame.origin, radius * u, radius * v, self.projection);
        Some(Spot { handle: Handle::ScreenRing, outline: Outline::Ring(pieces) })
    }

    fn screen(&self) -> Option<Spot> {
        let at = self.projection.project(self.frame.origin)?;
        Some(Spot { handle: Handle::Screen, outline: Outline::Circle(at) })
    }
}
