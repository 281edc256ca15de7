//! Handles on what is selected: where they are on screen, which one the pointer is on, what dragging them does, and how
//! they look.
//!
//! [`spots`] lays the handles out; the same list is hit-tested and painted, so that what is seen is what is grabbed. Those
//! that move, turn and scale (`gizmo`) act on all that is selected, in a [`frame::Frame`] of axes and pivot; those on a
//! shape (`shapes`, `vertices`, `probe`) on one thing. A [`drag::Drag`] says what things become while one is dragged: an
//! [`amount::Amount`], or what `reshape` makes of the shape. [`grip`] joins all that to the mouse. [`aim`] and [`place`] turn
//! and place lights by a point of the scene, and [`click`] joins them to the mouse.

pub mod aim;
pub mod amount;
pub mod click;
pub mod corners;
pub mod drag;
pub mod frame;
pub mod grip;
pub mod place;
pub mod pull;
pub mod readout;
pub mod subject;
pub mod toolbar;
pub mod typed;
pub mod vertices;

mod gizmo;
mod hints;
mod paint;
mod probe;
mod reshape;
mod shapes;

pub use paint::{AXIS_COLORS, paint};

use egui::Pos2;
use glam::DVec3;

use self::frame::Frame;
use self::gizmo::circle;
use self::subject::Subject;
use super::session::{Item, Tool};
use super::viewport::pick::Solids;
use super::viewport::projection::Projection;

/// One handle. Axes are 0, 1, 2 for X, Y, Z of the handles' frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Handle {
    /// Move along an axis.
    Axis(usize),
    /// Move in the plane whose normal is an axis.
    Plane(usize),
    /// Move in the plane that faces the eye.
    Screen,
    /// Rotate about an axis.
    Ring(usize),
    /// Rotate about the line of sight.
    ScreenRing,
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
    /// Move a side, a corner or a face: which, by the signs of its coordinates in the thing's own frame.
    Side([i8; 3]),
    /// Change a radius.
    Radius,
    /// Change a cap's half-angle.
    HalfAngle,
    /// Move a control point of a patch.
    Control(usize),
    /// Turn a light infinitely far away to where it comes from.
    Aim,
    /// Turn a light to what it shall light.
    Target,
    /// Move a probe over the surfaces.
    Probe,
    /// Turn a probe's normal.
    Normal,
}

/// Where a handle is on screen.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// A round dot.
    Dot(Pos2),
    /// A small diamond.
    Diamond(Pos2),
    /// A small circle.
    Circle(Pos2),
    /// A dot at the end of a thin line; the dot alone is held.
    Pin([Pos2; 2]),
    /// From the centre to a tip.
    Arrow([Pos2; 2]),
    /// From the centre to a knob.
    Lever([Pos2; 2]),
    /// A small filled quadrilateral.
    Patch([Pos2; 4]),
    /// A curve, cut where it is out of sight.
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

/// The pointer is on a handle within this distance, points.
const REACH: f32 = 7.0;
/// Radius of a dot, points.
const DOT: f32 = 4.5;
/// Radius of a circle, points.
const CIRCLE: f32 = 8.0;
/// What counts as the distance of the inside of a patch, points.
const INSIDE: f32 = 3.0;

impl Handle {
    /// Whether it acts on all that is selected.
    pub fn is_transform(self) -> bool {
        matches!(
            self,
            Self::Axis(_)
                | Self::Plane(_)
                | Self::Screen
                | Self::Ring(_)
                | Self::ScreenRing
                | Self::Stretch(_)
                | Self::Scale
        )
    }
}

/// The handles of `tool` on what is selected, which the last of `subjects` was last; those that win where they overlap
/// first.
pub fn spots(
    frame: &Frame,
    subjects: &[(Item, Subject)],
    tool: Tool,
    projection: &Projection,
    solids: &Solids,
) -> Vec<Spot> {
    let mut spots = Vec::new();
    if tool == Tool::Move
        && let Some((_, primary)) = subjects.last()
    {
        spots.extend(shapes::spots(primary, projection, solids));
    }
    spots.extend(gizmo::spots(frame, subjects, tool, projection));
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
            Self::Circle(at) => (at.distance(pos) - CIRCLE).max(0.0),
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

fn dot(handle: Handle, p: DVec3, projection: &Projection) -> Option<Spot> {
    projection.project(p).map(|at| Spot { handle, outline: Outline::Dot(at) })
}

#[cfg(test)]
#[path = "mod_tests.rs"]
mod tests;
