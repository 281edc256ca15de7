//! What flat shapes hide of a linear light.
//!
//! A fan of directions above a plane, at the height h, falls by F(t) on its way to the light and crosses the plane where
//! F > h, at the point p + (h/F)W: inside a shape's edge where a function of F and W is positive, and W is linear in t.

use glam::{DVec2, DVec3};

use super::fan::{Fan, Range, within_cone};
use crate::surface::ON_SURFACE;

/// A fan above the plane across an axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fall {
    /// Place over the plane.
    p: DVec2,
    height: f64,
    /// W along the plane at t = 0 and t = 1.
    along: [DVec2; 2],
    /// F there.
    fall: [f64; 2],
}

impl Fall {
    /// On the plane where the coordinate of that axis has the value `at`.
    #[inline]
    pub(super) fn new(fan: &Fan, axis: usize, at: f64) -> Self {
        let along = |v: DVec3| DVec2::new(v[(axis + 1) % 3], v[(axis + 2) % 3]);
        let height = fan.p[axis] - at;
        Self {
            p: along(fan.p),
            height: height.abs(),
            along: [along(fan.a), along(fan.b)],
            fall: [fan.a, fan.b].map(|w| -w[axis] * height.signum()),
        }
    }

    /// Where the light lies behind the plane.
    #[inline]
    fn behind(&self) -> Option<Range> {
        let [fall_a, fall_b] = self.fall;
        Range::ALL.where_positive(fall_a - self.height, fall_b - self.height)
    }

    /// Where the plane is crossed inside a rectangle of these half edges.
    pub(super) fn through_rectangle(&self, half: DVec2) -> Option<Range> {
        let [[fall_a, fall_b], [a, b]] = [self.fall.map(DVec2::splat), self.along.map(|w| self.height * w)];
        let (below, above) = (half + self.p, half - self.p);
        let [low_a, low_b] = [below * fall_a + a, below * fall_b + b];
        let [high_a, high_b] = [above * fall_a - a, above * fall_b - b];
        self.behind()?
            .where_not_negative(low_a.x, low_b.x)?
            .where_not_negative(high_a.x, high_b.x)?
            .where_not_negative(low_a.y, low_b.y)?
            .where_not_negative(high_a.y, high_b.y)
    }

    fn through_disk(&self, radius: f64) -> Option<Range> {
        let behind = self.behind()?;
        let [a, b] = self.along;
        let place = |fall: f64, w: DVec2| (fall * self.p + self.height * w).extend(0.0);
        let [fall_a, fall_b] = self.fall;
        behind.and(within_cone([place(fall_a, a), place(fall_b, b)], [radius * fall_a, radius * fall_b])?)
    }
}

/// On the plane z = 0; none where p lies in it.
fn on_ground(fan: &Fan) -> Option<Fall> {
    (fan.p.z.abs() > ON_SURFACE * fan.p.length()).then(|| Fall::new(fan, 2, 0.0))
}

/// What the plane z = 0 hides.
pub(super) fn plane(fan: &Fan) -> Option<Range> {
    on_ground(fan)?.behind()
}

/// What a rectangle in the plane z = 0 hides.
pub(super) fn rectangle(half: DVec2, fan: &Fan) -> Option<Range> {
    on_ground(fan)?.through_rectangle(half)
}

/// What a disk in the plane z = 0 hides.
pub(super) fn disk(radius: f64, fan: &Fan) -> Option<Range> {
    on_ground(fan)?.through_disk(radius)
}

/// What a triangle hides. Two that share an edge leave no gap: its plane's normal is the same to the last bit.
pub(super) fn triangle(corners: &[DVec3; 3], fan: &Fan) -> Option<Range> {
    let [a, b, c] = corners.map(|corner| corner - fan.p);
    if beside(&[a, b, c], fan) {
        return None;
    }
    let n = (b - a).cross(c - a);
    let height = a.dot(n);
    if height.abs() <= ON_SURFACE * n.length() * a.length().max(b.length()).max(c.length()) {
        return None;
    }
    let facing = height.signum();
    let mut hidden =
        Range::ALL.where_positive(facing * fan.a.dot(n) - height.abs(), facing * fan.b.dot(n) - height.abs())?;
    for edge in [b.cross(c), c.cross(a), a.cross(b)] {
        hidden = hidden.where_not_negative(facing * fan.a.dot(edge), facing * fan.b.dot(edge))?;
    }
    Some(hidden)
}

/// Whether points, seen from p, lie on one side of the plane of the fan, by more than the rounding of its normal, which
/// may be all there is of it where p lies on the light's own line.
fn beside(points: &[DVec3; 3], fan: &Fan) -> bool {
    let across = fan.a.cross(fan.b);
    let noise = 1e-14 * fan.a.length() * fan.b.length();
    let sides = points.map(|point| [across.dot(point), noise * point.abs().element_sum()]);
    sides.iter().all(|[side, noise]| side > noise) || sides.iter().all(|[side, noise]| -side > *noise)
}
