//! Curved faces: those of balls, cylinders and cones.

use glam::DVec3;

use super::fan::{Fan, Range, within_cone};
use crate::surface::ON_SURFACE;

/// ‖N(x)‖ ≤ D(x), with N the part of x that counts and D falling along Z.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    /// 1 for each coordinate that N has.
    counts: DVec3,
    /// D at z = 0, and how fast it falls.
    reach: f64,
    slope: f64,
    pub(super) radius: f64,
}

/// Where a point is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Place {
    Inside,
    /// On a face with this outward normal, of any length.
    On(DVec3),
    Outside,
}

impl Round {
    /// A ball about the origin.
    pub(super) fn sphere(radius: f64) -> Self {
        Self { counts: DVec3::ONE, reach: radius, slope: 0.0, radius }
    }

    /// An infinite cylinder about Z.
    pub(super) fn tube(radius: f64) -> Self {
        Self { counts: DVec3::new(1.0, 1.0, 0.0), ..Self::sphere(radius) }
    }

    /// The lower nap of a cone about Z with its apex at height/2.
    pub(super) fn nap(radius: f64, height: f64) -> Self {
        Self { reach: 0.5 * radius, slope: radius / height, ..Self::tube(radius) }
    }

    fn reach(&self, x: DVec3) -> f64 {
        self.reach - self.slope * x.z
    }

    /// Where p is; within [`ON_SURFACE`] of the face it lies on it.
    pub(super) fn place(&self, p: DVec3) -> Place {
        let (n, reach) = (self.counts * p, self.reach(p));
        let distance = n.length();
        let away = (distance - reach.abs()) * (distance + reach.abs());
        if away.abs() <= ON_SURFACE * self.radius * self.radius && reach > -ON_SURFACE * self.radius {
            Place::On(n.normalize_or_zero() + self.slope * DVec3::Z)
        } else if away < 0.0 && reach > 0.0 {
            Place::Inside
        } else {
            Place::Outside
        }
    }

    /// The part of a segment that is inside.
    pub(super) fn chord(&self, [from, to]: [DVec3; 2]) -> Option<Range> {
        within_cone([self.counts * from, self.counts * to], [self.reach(from), self.reach(to)])
    }

    /// The directions between the planes through p, outside, that touch the face: none other meets it.
    ///
    /// The planes' normals m satisfy m·N(p) = D(p) ‖m‖. A ball is seen within a cone instead, of the opening r/‖p‖.
    pub(super) fn tangents(&self, fan: &Fan) -> Option<Range> {
        let (n, reach) = (self.counts * fan.p, self.reach(fan.p));
        let distance = n.length();
        let square = (distance - reach.abs()) * (distance + reach.abs());
        if square <= 0.0 {
            return Some(Range::ALL);
        }
        let depth = square.sqrt();
        if self.counts.z > 0.0 {
            let [a, b] = [fan.a, fan.b];
            return within_cone([depth * n.cross(a), depth * n.cross(b)], [-reach * n.dot(a), -reach * n.dot(b)]);
        }
        let along = reach * n + self.slope * distance * distance * DVec3::Z;
        let across = depth * DVec3::new(-n.y, n.x, 0.0);
        let [left, right] = [along + across, along - across];
        Range::ALL
            .where_not_negative(-left.dot(fan.a), -left.dot(fan.b))?
            .where_not_negative(-right.dot(fan.a), -right.dot(fan.b))
    }

    /// How far along a tangent from p it touches the face, in lengths of w.
    pub(super) fn touch(&self, p: DVec3, w: DVec3) -> f64 {
        let (n, n_w) = (self.counts * p, self.counts * w);
        let fall = -self.slope * w.z;
        let speed = n_w.length();
        -(n.dot(n_w) - self.reach(p) * fall) / ((speed - fall) * (speed + fall))
    }
}
