//! Integrals over a polygon's area, for polygons so small or thin that sums along their edges cancel.

use std::sync::LazyLock;

use glam::DVec3;

use crate::math::angle::angle_between;
use crate::math::quadrature::GaussLegendre;
use crate::math::spherical::{Edge, triangle_solid_angle};

/// Nodes a direction: 10 integrate a lobe over its own width, or 1/r³ over 0.3 rad, to rounding.
static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(10));

/// No triangle is halved more often than this: 2⁻⁴⁰ of a light is seen under a small angle from anywhere but itself.
const MAX_DEPTH: u32 = 40;

/// ∫ f(ω) dω over the inside of closed loops of edges about p, signed by their sense.
///
/// A fan of triangles from the first corner, each halved until it is seen under less than `resolution` radians, with a
/// product rule on each: dω = det(u, v, w)/|x|³ dA in the own coordinates of the triangle of the unit directions u, v,
/// w. All terms of a triangle have one sign and its determinant is computed once, from differences, so that thin
/// triangles lose no digits.
pub(super) fn area_integral(loops: impl Iterator<Item = Edge>, resolution: f64, f: &impl Fn(DVec3) -> f64) -> f64 {
    let mut apex = None;
    loops
        .map(|(a, b)| {
            let apex = *apex.get_or_insert(a);
            let lengths = apex.length() * a.length() * b.length();
            let weight = determinant(apex, a, b) / lengths;
            let corners = [apex, a, b].map(DVec3::normalize_or_zero);
            if weight.abs() > 0.0 { triangle(corners, weight, resolution, MAX_DEPTH, f) } else { 0.0 }
        })
        .sum()
}

/// det(u, v, w) from the position of one corner and the two shortest sides.
fn determinant(u: DVec3, v: DVec3, w: DVec3) -> f64 {
    let sides = [(v - u).length_squared(), (w - v).length_squared(), (u - w).length_squared()];
    if sides[0] >= sides[1].max(sides[2]) {
        w.dot((u - w).cross(v - w))
    } else if sides[1] >= sides[2] {
        u.dot((v - u).cross(w - u))
    } else {
        v.dot((w - v).cross(u - v))
    }
}

/// ∫ f(ω) dω over the triangle of three unit directions with the determinant `weight`.
///
/// The middle of a side is scaled back to the unit sphere, so that 1/|x|³ stays smooth when the side passes close by p.
fn triangle(corners: [DVec3; 3], weight: f64, resolution: f64, depth: u32, f: &impl Fn(DVec3) -> f64) -> f64 {
    let [u, v, w] = corners;
    let angles = [angle_between(u, v), angle_between(v, w), angle_between(w, u)];
    let longest = if angles[0] >= angles[1].max(angles[2]) { 0 } else { 1 + usize::from(angles[2] > angles[1]) };
    let (a, b, c) = (corners[longest], corners[(longest + 1) % 3], corners[(longest + 2) % 3]);
    let middle = a.midpoint(b);
    let length = middle.length();
    if depth == 0 || angles[longest] <= resolution || length <= 0.0 {
        return weight * product_rule(corners, f);
    }
    let (middle, half) = (middle / length, 0.5 * weight / length);
    triangle([a, middle, c], half, resolution, depth - 1, f) + triangle([middle, b, c], half, resolution, depth - 1, f)
}

/// ∫∫ f(x/|x|)/|x|³ over a triangle's own coordinates: Gauss–Legendre on it as a collapsed square.
fn product_rule([u, v, w]: [DVec3; 3], f: &impl Fn(DVec3) -> f64) -> f64 {
    RULE.integrate(0.0, 1.0, |t| {
        let (start, side) = (u.lerp(w, t), (1.0 - t) * (v - u));
        (1.0 - t)
            * RULE.integrate(0.0, 1.0, |s| {
                let x = start + s * side;
                let length = x.length();
                if length > 0.0 { f(x / length) / (length * length * length) } else { 0.0 }
            })
    })
}

/// A sum along edges, and how much may have been lost by cancellation in it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct EdgeSum {
    /// The sum.
    pub(super) value: f64,
    /// The sum of the terms' sizes.
    size: f64,
}

impl FromIterator<f64> for EdgeSum {
    fn from_iter<I: IntoIterator<Item = f64>>(terms: I) -> Self {
        terms
            .into_iter()
            .fold(Self::default(), |sum, term| Self { value: sum.value + term, size: sum.size + term.abs() })
    }
}

impl EdgeSum {
    /// Whether rounding matters both beside the value and beside `solid_angle_weight` times the light's solid angle.
    ///
    /// The area integral is worth its price from `accuracy` on: 1 where it is accurate to rounding.
    pub(super) fn cancels(&self, vertices: &[DVec3], p: DVec3, solid_angle_weight: f64, accuracy: f64) -> bool {
        let noise = 16.0 * f64::EPSILON * self.size;
        noise > 4e-12 * accuracy * self.value.abs()
            && noise > 1e-14 * accuracy * solid_angle_weight * solid_angle(vertices, p)
    }
}

/// The solid angle of a polygon, by a fan of triangles.
fn solid_angle(vertices: &[DVec3], p: DVec3) -> f64 {
    let Some(apex) = vertices.first() else { return 0.0 };
    let fan = vertices.windows(2).map(|edge| triangle_solid_angle(apex - p, edge[0] - p, edge[1] - p));
    fan.sum::<f64>().abs()
}
