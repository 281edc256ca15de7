//! The fan of directions from a point to a linear light, and parts of it.

use glam::{DAffine3, DVec3};

use crate::visibility::objects::AT_END;

/// From p along W(t) = A + t(B − A) to the light at the distance 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fan {
    pub(super) p: DVec3,
    /// From p to one end of the light.
    pub(super) a: DVec3,
    /// To the other.
    pub(super) b: DVec3,
}

impl Fan {
    /// W(t).
    #[inline]
    pub(super) fn at(&self, t: f64) -> DVec3 {
        (1.0 - t) * self.a + t * self.b
    }

    /// A part of it, as a fan.
    #[inline]
    pub(super) fn between(&self, part: Range) -> Self {
        Self { a: self.at(part.from), b: self.at(part.to), ..*self }
    }

    /// The same that ends before the light, so that what touches the light is not met.
    #[inline]
    pub(super) fn short_of_the_light(&self) -> Self {
        Self { a: (1.0 - AT_END) * self.a, b: (1.0 - AT_END) * self.b, ..*self }
    }

    /// The same in another frame; none in that of a flattened object, which is never hit.
    #[inline]
    pub(super) fn seen_from(&self, local_from_world: &DAffine3) -> Option<Self> {
        let local = Self {
            p: local_from_world.transform_point3(self.p),
            a: local_from_world.transform_vector3(self.a),
            b: local_from_world.transform_vector3(self.b),
        };
        (local.p + local.a + local.b).is_finite().then_some(local)
    }
}

/// An interval of [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Range {
    pub(super) const ALL: Self = Self { from: 0.0, to: 1.0 };

    /// The part of positive length where a linear function is ≥ 0 that has these values at 0 and at 1.
    #[inline]
    pub(super) fn where_not_negative(self, at_0: f64, at_1: f64) -> Option<Self> {
        let part = match (at_0 >= 0.0, at_1 >= 0.0) {
            (true, true) => self,
            (true, false) => Self { to: self.to.min(at_0 / (at_0 - at_1)), ..self },
            (false, true) => Self { from: self.from.max(at_0 / (at_0 - at_1)), ..self },
            (false, false) => return None,
        };
        (part.from < part.to).then_some(part)
    }

    /// The same where it is > 0: nothing of a function that is 0 all along.
    #[inline]
    pub(super) fn where_positive(self, at_0: f64, at_1: f64) -> Option<Self> {
        if at_0 > 0.0 || at_1 > 0.0 { self.where_not_negative(at_0, at_1) } else { None }
    }

    /// What is common to two; none when that has no length.
    pub(super) fn and(self, other: Self) -> Option<Self> {
        let common = Self { from: self.from.max(other.from), to: self.to.min(other.to) };
        (common.from < common.to).then_some(common)
    }
}

/// The interval of [0, 1] where ‖N(t)‖ ≤ D(t) for a linear vector N and a linear number D, given at 0 and at 1.
///
/// Balls, round cylinders, naps of cones, and disks seen in perspective are all of this form. With x = 1 − t, y = t it is
/// c₀x² + 2cxy + c₁y² ≤ 0 and D ≥ 0, whose discriminant c² − c₀c₁ = ‖D₀N₁ − D₁N₀‖² − ‖N₀ × N₁‖² by Lagrange's identity;
/// all differences of squares are taken as products, and each root is had from the sum that does not cancel.
pub(super) fn within_cone([n_0, n_1]: [DVec3; 2], [d_0, d_1]: [f64; 2]) -> Option<Range> {
    let (length_0, length_1) = (n_0.length(), n_1.length());
    let inside = (length_0 <= d_0, length_1 <= d_1);
    if inside == (true, true) {
        return Some(Range::ALL);
    }
    let c_0 = (length_0 - d_0) * (length_0 + d_0);
    let c_1 = (length_1 - d_1) * (length_1 + d_1);
    let c = n_0.dot(n_1) - d_0 * d_1;
    let (along, across) = ((d_0 * n_1 - d_1 * n_0).length(), n_0.cross(n_1).length());
    let discriminant = (along - across) * (along + across);
    let root = discriminant.max(0.0).sqrt();
    let range = match inside {
        (true, _) => Range { from: 0.0, to: leave(c_0, c, c_1, root) },
        (_, true) => Range { from: 1.0 - leave(c_1, c, c_0, root), to: 1.0 },
        _ if discriminant > 0.0 && c < 0.0 && c_0 > 0.0 && c_1 > 0.0 => {
            let q = root - c;
            let (from, to) = (c_0 / (c_0 + q), q / (q + c_1));
            let middle = from.midpoint(to);
            if (1.0 - middle) * d_0 + middle * d_1 < 0.0 {
                return None;
            }
            Range { from, to }
        }
        _ => return None,
    };
    (range.from < range.to).then_some(range)
}

/// Where the quadratic of [`within_cone`] becomes positive that is not so at 0.
fn leave(c_0: f64, c: f64, c_1: f64, root: f64) -> f64 {
    let t = if c >= 0.0 {
        -c_0 / (c + root - c_0)
    } else {
        let q = root - c;
        q / (q + c_1)
    };
    if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) }
}

/// The least interval that holds all t added to it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Span {
    from: f64,
    to: f64,
}

impl Span {
    pub(super) const EMPTY: Self = Self { from: f64::INFINITY, to: f64::NEG_INFINITY };

    /// Takes t in, if it is a number.
    pub(super) fn add(&mut self, t: f64) {
        let t = t.clamp(0.0, 1.0);
        self.from = self.from.min(t);
        self.to = self.to.max(t);
    }

    /// The interval; none when it has no length.
    pub(super) fn range(self) -> Option<Range> {
        (self.from < self.to).then_some(Range { from: self.from, to: self.to })
    }
}
