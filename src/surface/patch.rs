//! Bicubic Bézier patches, and rays against them.
//!
//! A ray is the intersection of two planes; in coordinates across the ray, a hit is a root of two bicubic polynomials.
//! Pieces of the patch are halved until their control points show that they are missed (the convex hull property) or
//! that they hold at most one root, to which Newton's method then surely goes: see [`Piece::root`].

use glam::{DMat2, DVec2, DVec3};

use super::intersect::{LocalHit, ON_SURFACE};
use super::{Bounds, Triangle};

/// A bicubic Bézier patch S(u, v) = Σ Bᵢ(v) Bⱼ(u) P₄ᵢ₊ⱼ, 0 ≤ u, v ≤ 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Control points, in rows of four; u runs along a row.
    pub control_points: [DVec3; 16],
    /// Diagonal of the box about them.
    size: f64,
    root: Node,
}

/// A point of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchPoint {
    /// S(u, v).
    pub p: DVec3,
    /// ∂S/∂u.
    pub du: DVec3,
    /// ∂S/∂v.
    pub dv: DVec3,
}

/// Pieces of a patch that rays look into one after the other, halved beforehand in both directions.
#[derive(Clone, Debug, PartialEq)]
struct Node {
    bounds: Bounds,
    inner: Inner,
}

#[derive(Clone, Debug, PartialEq)]
enum Inner {
    Nodes(Box<[Node; 4]>),
    Piece(Box<Piece>),
}

/// How often a patch is halved beforehand, in each direction.
const PREPARED: u32 = 3;

/// A ray's search ends after this many halvings; only rays that run along within 1e-7 of a patch need so many.
const MOST_HALVINGS: u32 = 4000;

/// A piece smaller than this share of the patch is met if its hull is.
const SMALLEST: f64 = 1e-8;

/// A ray meets what it passes within this share of the patch's size and distance: what rounding leaves of them.
const SLACK: f64 = 1e-13;

impl Patch {
    /// The patch of these control points, in rows of four.
    pub fn new(control_points: [DVec3; 16]) -> Self {
        let whole = Piece { points: control_points, u: [0.0, 1.0], v: [0.0, 1.0] };
        let bounds = Bounds::about(&control_points);
        Self { control_points, size: bounds.min.distance(bounds.max), root: Node::new(whole, PREPARED) }
    }

    /// Point and derivatives at (u, v).
    pub fn at(&self, u: f64, v: f64) -> PatchPoint {
        at(&self.control_points, u, v)
    }

    /// Unit normal, ∂S/∂u × ∂S/∂v; none of a patch without area.
    ///
    /// Where that is less than 1e-9 of the size, as where an edge has shrunk to a point, it is taken 1e-6 further in,
    /// then 1e-3: as far from right, in radians, as the patch bends over that way.
    pub fn normal(&self, u: f64, v: f64) -> Option<DVec3> {
        [0.0, 1e-6, 1e-3].into_iter().find_map(|inward| {
            let inner = |x: f64| x + inward * (0.5 - x);
            let PatchPoint { du, dv, .. } = self.at(inner(u), inner(v));
            let n = du.cross(dv);
            if n.length() > 1e-9 * self.size * self.size { n.try_normalize() } else { None }
        })
    }

    /// Triangles with normals at n + 1 parameters in each direction; those without area are left out.
    pub fn triangles(&self, n: u32) -> Vec<Triangle> {
        let share = |i: u32| f64::from(i) / f64::from(n);
        let corner = |i: u32, j: u32| {
            let (u, v) = (share(j), share(i));
            (self.at(u, v).p, self.normal(u, v).unwrap_or(DVec3::Z))
        };
        let triangle = |corners: [(DVec3, DVec3); 3]| Triangle {
            corners: corners.map(|(p, _)| p),
            normals: Some(corners.map(|(_, normal)| normal)),
        };
        let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let halves = quads.flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i, j + 1), corner(i + 1, j + 1), corner(i + 1, j)];
            [triangle([a, b, c]), triangle([a, c, d])]
        });
        halves.filter(|triangle| triangle.area() > 0.0).collect()
    }

    /// The least number with which [`Self::triangles`] stay within `share` of the patch's size, up to 256.
    pub fn fineness(&self, share: f64) -> u32 {
        (1..256).find(|n| self.triangles_error(*n) <= share * self.size).unwrap_or(256)
    }

    /// A bound of the distance between the patch and its [`Self::triangles`].
    ///
    /// (M_uu + 2 M_uv + M_vv)/(8n²) of the greatest second derivatives, which their control points bound.
    ///
    /// **Source:** D. Filip, R. Magedson, R. Markot, *Surface algorithms using bounds on derivatives*, Computer Aided
    /// Geometric Design 3(4), 1986.
    pub fn triangles_error(&self, n: u32) -> f64 {
        let p = |i: usize, j: usize| self.control_points[4 * i + j];
        let greatest = |rows: usize, columns: usize, difference: &dyn Fn(usize, usize) -> DVec3| {
            let places = (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
            places.map(|(i, j)| difference(i, j).length()).fold(0.0, f64::max)
        };
        let uu = 6.0 * greatest(4, 2, &|i, j| p(i, j) - 2.0 * p(i, j + 1) + p(i, j + 2));
        let vv = 6.0 * greatest(2, 4, &|i, j| p(i, j) - 2.0 * p(i + 1, j) + p(i + 2, j));
        let uv = 9.0 * greatest(3, 3, &|i, j| p(i, j) - p(i, j + 1) - p(i + 1, j) + p(i + 1, j + 1));
        (uu + 2.0 * uv + vv) / (8.0 * f64::from(n) * f64::from(n))
    }

    /// The nearest hit of a ray.
    ///
    /// A hit whose tangent plane holds the origin, within 1e-10 of the size, is none: rays that leave the patch do not
    /// meet it where they start. The normal is that of [`Self::normal`].
    ///
    /// **Accuracy:** a hit lies on the patch to rounding, and off the ray by no more than 1e-13 of size and distance;
    /// where the ray is tangent, or an edge has shrunk to a point, by no more than 1e-8.
    pub(super) fn hit(&self, origin: DVec3, direction: DVec3) -> Option<LocalHit> {
        let length = direction.length();
        let along = direction.try_normalize()?;
        let (right, up) = along.any_orthonormal_pair();
        let reach = self.size + origin.distance(self.root.bounds.center());
        let mut search =
            Search { patch: self, origin, axes: [right, up, along], slack: SLACK * reach, halvings: 0, best: None };
        search.node(&self.root);
        let best = search.best?;
        Some(LocalHit { t: best.depth / length, p: best.p, n: best.n })
    }
}

/// A ray's search for its nearest hit.
struct Search<'p> {
    patch: &'p Patch,
    origin: DVec3,
    /// Two across the ray, and its direction.
    axes: [DVec3; 3],
    slack: f64,
    halvings: u32,
    best: Option<Found>,
}

struct Found {
    depth: f64,
    p: DVec3,
    n: DVec3,
}

impl Search<'_> {
    fn farthest(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |best| best.depth)
    }

    fn node(&mut self, node: &Node) {
        match &node.inner {
            Inner::Piece(piece) => {
                let points = piece.points.map(|p| {
                    let p = p - self.origin;
                    DVec3::from_array(self.axes.map(|axis| axis.dot(p)))
                });
                self.piece(&Piece { points, ..**piece });
            }
            Inner::Nodes(nodes) => {
                let mut met = nodes.each_ref().map(|node| (self.depth(&node.bounds), node));
                met.sort_by(|(a, _), (b, _)| a.total_cmp(b));
                for (depth, node) in met {
                    if depth < self.farthest() {
                        self.node(node);
                    }
                }
            }
        }
    }

    /// The depth at which the ray enters a box; infinite if it does not.
    fn depth(&self, bounds: &Bounds) -> f64 {
        let inverse = self.axes[2].recip();
        let slack = DVec3::splat(self.slack);
        let at = |corner: DVec3| (corner - self.origin) * inverse;
        let (a, b) = (at(bounds.min - slack), at(bounds.max + slack));
        let (enter, exit) = (a.min(b).max_element().max(0.0), a.max(b).min_element());
        if enter <= exit { enter } else { f64::INFINITY }
    }

    /// Look into a piece whose points are in the ray's coordinates.
    fn piece(&mut self, piece: &Piece) {
        let Bounds { min, max } = Bounds::about(&piece.points);
        let slack = DVec2::splat(self.slack);
        let is_met = min.truncate().cmple(slack).all() && max.truncate().cmpge(-slack).all();
        if !is_met || max.z < 0.0 || min.z >= self.farthest() {
            return;
        }
        if let Some(found) = piece.root(self.slack) {
            if let Some([u, v]) = found {
                self.offer(u, v);
            }
            return;
        }
        if min.distance(max) <= SMALLEST * self.patch.size || self.halvings >= MOST_HALVINGS {
            let middle = |[from, to]: [f64; 2]| 0.5 * (from + to);
            self.offer(middle(piece.u), middle(piece.v));
            return;
        }
        self.halvings += 1;
        let mut halves = piece.halves();
        let nearest = |piece: &Piece| piece.points.iter().fold(f64::INFINITY, |least, p| least.min(p.z));
        if nearest(&halves[1]) < nearest(&halves[0]) {
            halves.swap(0, 1);
        }
        halves.iter().for_each(|half| self.piece(half));
    }

    /// Take the point at (u, v) if it is the nearest so far.
    fn offer(&mut self, u: f64, v: f64) {
        let p = self.patch.at(u, v).p;
        let to_p = p - self.origin;
        let depth = self.axes[2].dot(to_p);
        let n = self.patch.normal(u, v).unwrap_or(-self.axes[2]);
        let own = ON_SURFACE * self.patch.size.max(to_p.length());
        if depth > 0.0 && depth < self.farthest() && to_p.dot(n).abs() > own {
            self.best = Some(Found { depth, p, n });
        }
    }
}

impl Node {
    fn new(piece: Piece, halvings: u32) -> Self {
        let bounds = Bounds::about(&piece.points);
        let inner = if halvings == 0 {
            Inner::Piece(Box::new(piece))
        } else {
            let [left, right] = piece.halves_along_u();
            let ([a, b], [c, d]) = (left.halves_along_v(), right.halves_along_v());
            Inner::Nodes(Box::new([a, b, c, d].map(|quarter| Self::new(quarter, halvings - 1))))
        };
        Self { bounds, inner }
    }
}

/// A rectangle of a patch's parameters, and its control points.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    points: [DVec3; 16],
    u: [f64; 2],
    v: [f64; 2],
}

impl Piece {
    /// The only parameters of the patch at which the piece meets the z axis within `slack`, or that there are none; `None` where
    /// that cannot be told.
    ///
    /// With A the inverse of the mean Jacobian J and q a bound of |I − A J|∞ over the piece, from the control points of
    /// its derivatives, q < 1 leaves at most one root, and Newton's method kept within the piece comes nearer to it by
    /// 2q/(1 − q) a step, as the mean of J on the way is within those bounds, too. q ≤ 1/4 is asked for.
    fn root(&self, slack: f64) -> Option<Option<[f64; 2]>> {
        const STEPS: u32 = 60;
        self.has_one_root_at_most().then(|| {
            let mut at = DVec2::splat(0.5);
            for _ in 0..STEPS {
                let PatchPoint { p, du, dv } = at_of(&self.points, at);
                let step = DMat2::from_cols(du.truncate(), dv.truncate()).inverse() * p.truncate();
                let next = (at - step).clamp(DVec2::ZERO, DVec2::ONE);
                let moved = (next - at).abs().max_element();
                at = next;
                if moved <= 1e-15 {
                    break;
                }
            }
            let across = at_of(&self.points, at).p.truncate();
            let within = |[from, to]: [f64; 2], share: f64| from + share * (to - from);
            (across.length() <= slack).then(|| [within(self.u, at.x), within(self.v, at.y)])
        })
    }

    fn has_one_root_at_most(&self) -> bool {
        const MOST: f64 = 0.25;
        let du = self.differences(1, 3, 4).map(DVec3::truncate);
        let dv = self.differences(4, 4, 3).map(DVec3::truncate);
        let mean = |all: &[DVec2; 12]| all.iter().sum::<DVec2>() / 12.0;
        let jacobian = DMat2::from_cols(mean(&du), mean(&dv));
        if jacobian.determinant() == 0.0 {
            return false;
        }
        let a = jacobian.inverse();
        let most =
            |all: &[DVec2; 12], from: DVec2| all.iter().map(|d| (from - a * *d).abs()).fold(DVec2::ZERO, DVec2::max);
        (most(&du, DVec2::X) + most(&dv, DVec2::Y)).max_element() <= MOST
    }

    /// Control points of a derivative: between points `stride` apart, in `columns` × `rows` places.
    fn differences(&self, stride: usize, columns: usize, rows: usize) -> [DVec3; 12] {
        std::array::from_fn(|k| {
            let at = 4 * (k / columns % rows) + k % columns;
            3.0 * (self.points[at + stride] - self.points[at])
        })
    }

    /// Both halves, across the direction in which the piece is longer.
    fn halves(&self) -> [Self; 2] {
        let length = |stride: usize, columns: usize, rows: usize| {
            self.differences(stride, columns, rows).iter().map(|d| d.length_squared()).fold(0.0, f64::max)
        };
        if length(1, 3, 4) >= length(4, 4, 3) { self.halves_along_u() } else { self.halves_along_v() }
    }

    fn halves_along_u(&self) -> [Self; 2] {
        let [from, to] = self.u;
        let middle = 0.5 * (from + to);
        let [left, right] = halved(&self.points, 1, 4);
        [Self { points: left, u: [from, middle], ..*self }, Self { points: right, u: [middle, to], ..*self }]
    }

    fn halves_along_v(&self) -> [Self; 2] {
        let [from, to] = self.v;
        let middle = 0.5 * (from + to);
        let [lower, upper] = halved(&self.points, 4, 1);
        [Self { points: lower, v: [from, middle], ..*self }, Self { points: upper, v: [middle, to], ..*self }]
    }
}

/// Halves by de Casteljau's scheme: of each of the four curves that start `between` apart, with points `stride` apart.
fn halved(points: &[DVec3; 16], stride: usize, between: usize) -> [[DVec3; 16]; 2] {
    let mut halves = [*points; 2];
    for curve in 0..4 {
        let at = |k: usize| curve * between + k * stride;
        let [a, b, c, d] = std::array::from_fn(|k| points[at(k)]);
        let (ab, bc, cd) = (a.midpoint(b), b.midpoint(c), c.midpoint(d));
        let (abc, bcd) = (ab.midpoint(bc), bc.midpoint(cd));
        let middle = abc.midpoint(bcd);
        for (k, (first, second)) in [(a, middle), (ab, bcd), (abc, cd), (middle, d)].into_iter().enumerate() {
            halves[0][at(k)] = first;
            halves[1][at(k)] = second;
        }
    }
    halves
}

fn at_of(points: &[DVec3; 16], at_uv: DVec2) -> PatchPoint {
    at(points, at_uv.x, at_uv.y)
}

/// Point and derivatives of the patch of these control points.
fn at(points: &[DVec3; 16], u: f64, v: f64) -> PatchPoint {
    let rows: [[DVec3; 2]; 4] = std::array::from_fn(|i| cubic([0, 1, 2, 3].map(|j| points[4 * i + j]), u));
    let [p, dv] = cubic(rows.map(|[p, _]| p), v);
    let [du, _] = cubic(rows.map(|[_, du]| du), v);
    PatchPoint { p, du, dv }
}

/// Point and derivative of a cubic Bézier curve.
fn cubic([a, b, c, d]: [DVec3; 4], t: f64) -> [DVec3; 2] {
    let (ab, bc, cd) = (a.lerp(b, t), b.lerp(c, t), c.lerp(d, t));
    let (abc, bcd) = (ab.lerp(bc, t), bc.lerp(cd, t));
    [abc.lerp(bcd, t), 3.0 * (bcd - abc)]
}
