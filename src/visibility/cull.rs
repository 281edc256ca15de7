//! Boxes against rays and light triangles: cheap tests that may keep too much and never lose anything.
//!
//! Boxes are padded before they are tested ([`padded`]) by far more than the rounding of any test here or of any
//! intersection with what is inside them.

use glam::DVec3;

use crate::surface::Bounds;

/// How far tests are widened, relative to the numbers involved.
pub(super) const SLACK: f64 = 1e-9;

/// A box, larger by [`SLACK`] of its greatest coordinate. None when it is not finite, so that nothing can be said.
pub(super) fn padded(bounds: &Bounds) -> Option<Bounds> {
    let pad = DVec3::splat(SLACK * bounds.min.abs().max(bounds.max.abs()).max_element());
    let (min, max) = (bounds.min - pad, bounds.max + pad);
    (min.is_finite() && max.is_finite()).then_some(Bounds { min, max })
}

/// A ray, prepared for boxes.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    origin: DVec3,
    inverse: DVec3,
}

impl Ray {
    pub(super) fn new(origin: DVec3, direction: DVec3) -> Self {
        Self { origin, inverse: direction.recip() }
    }

    /// Where the ray enters a box in front of its origin and no farther than `limit`, or a negative number when it
    /// starts inside.
    ///
    /// The three slabs, with exits moved out by [`SLACK`]: T. Ize, *Robust BVH ray traversal*, JCGT 2013.
    pub(super) fn enter(&self, bounds: &Bounds, limit: f64) -> Option<f64> {
        let (low, high) = ((bounds.min - self.origin) * self.inverse, (bounds.max - self.origin) * self.inverse);
        let enter = low.min(high).max_element();
        let exit = low.max(high).min_element();
        (exit >= 0.0 && enter <= exit.min(limit) * (1.0 + SLACK)).then_some(enter)
    }
}

/// A direction that may part a hull from a box, and the hull's extent along it.
#[derive(Clone, Copy)]
pub(super) struct Axis {
    along: DVec3,
    /// |along|, component by component.
    reach: DVec3,
    low: f64,
    high: f64,
}

/// The convex hull of a few points, prepared for boxes.
pub(super) struct Hull<A> {
    bounds: Bounds,
    axes: A,
}

impl Axis {
    fn new(along: DVec3, points: &[DVec3]) -> Self {
        let reach = along.abs();
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for &point in points {
            let (at, slack) = (along.dot(point), SLACK * reach.dot(point.abs()));
            low = low.min(at - slack);
            high = high.max(at + slack);
        }
        Self { along, reach, low, high }
    }

    fn parts(&self, center: DVec3, half: DVec3) -> bool {
        let (at, radius) = (self.along.dot(center), self.reach.dot(half));
        at + radius < self.low || at - radius > self.high
    }
}

impl Hull<[Axis; 10]> {
    /// A triangle: its normal, and its edges against those of boxes.
    pub(super) fn triangle(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        let edges = [b - a, c - b, a - c];
        let axis = |i: usize| match i {
            0 => edges[0].cross(edges[1]),
            _ => edges[(i - 1) / 3].cross(DVec3::AXES[(i - 1) % 3]),
        };
        Self { bounds: Bounds::about(&corners), axes: std::array::from_fn(|i| Axis::new(axis(i), &corners)) }
    }
}

impl Hull<Vec<Axis>> {
    /// The pyramid from `apex` over a polygon, or what is left of it when that is flat.
    pub(super) fn pyramid(apex: DVec3, base: &[DVec3]) -> Self {
        let points: Vec<DVec3> = base.iter().copied().chain([apex]).collect();
        let next = base.iter().cycle().skip(1);
        let around: Vec<DVec3> = base.iter().zip(next).map(|(a, b)| *b - *a).collect();
        let up: Vec<DVec3> = base.iter().map(|&corner| corner - apex).collect();
        // Newell's normal.
        let floor = around.iter().zip(&up).map(|(edge, up)| up.cross(*edge)).sum();
        let sides = up.iter().zip(&around).map(|(up, edge)| up.cross(*edge));
        let crossed = up.iter().chain(&around).flat_map(|edge| DVec3::AXES.map(|axis| edge.cross(axis)));
        let axes = std::iter::once(floor).chain(sides).chain(crossed);
        Self { bounds: Bounds::about(&points), axes: axes.map(|along| Axis::new(along, &points)).collect() }
    }
}

impl<A: AsRef<[Axis]>> Hull<A> {
    /// The box about it.
    pub(super) fn bounds(&self) -> &Bounds {
        &self.bounds
    }

    /// Whether the hull may touch a box: no axis parts them.
    pub(super) fn touches(&self, bounds: &Bounds) -> bool {
        if self.bounds.max.cmplt(bounds.min).any() || self.bounds.min.cmpgt(bounds.max).any() {
            return false;
        }
        let (center, half) = (bounds.center(), 0.5 * (bounds.max - bounds.min));
        !self.axes.as_ref().iter().any(|axis| axis.parts(center, half))
    }
}
