//! Cutting a planar convex polygon by half-spaces about p.

use glam::DVec3;

/// The points q with normal·(q − p) + offset ≤ 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct HalfSpace {
    pub(super) normal: DVec3,
    pub(super) offset: f64,
    /// What goes no deeper into it only touches it, and counts as outside.
    pub(super) slack: f64,
}

impl HalfSpace {
    /// Bounded by a plane.
    pub(super) fn new(normal: DVec3, offset: f64) -> Self {
        Self { normal, offset, slack: 0.0 }
    }

    /// Bounded by a plane through p.
    pub(super) fn through_p(normal: DVec3) -> Self {
        Self::new(normal, 0.0)
    }

    /// What lies beyond; its cuts are the same to the last bit.
    pub(super) fn complement(self) -> Self {
        Self { normal: -self.normal, offset: -self.offset, slack: self.slack }
    }

    fn excess(&self, from_p: DVec3) -> f64 {
        self.normal.dot(from_p) + self.offset
    }
}

/// A corner of a polygon, and the half-space whose boundary the edge after it runs along.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) at: DVec3,
    /// The half-space's index in the region that made the edge.
    cut: Option<usize>,
}

impl Corner {
    /// The corner of a polygon that nothing has cut yet.
    pub(super) fn uncut(at: DVec3) -> Self {
        Self { at, cut: None }
    }
}

/// Vector area of a polygon.
pub(super) fn vector_area(polygon: &[Corner]) -> DVec3 {
    let Some(origin) = polygon.first() else { return DVec3::ZERO };
    0.5 * polygon.windows(2).map(|edge| (edge[0].at - origin.at).cross(edge[1].at - origin.at)).sum::<DVec3>()
}

/// Cuts convex polygons as seen from one point, exactly to rounding, by Sutherland and Hodgman's algorithm.
#[derive(Clone, Debug)]
pub(super) struct Clipper {
    p: DVec3,
    /// Rounding of a coordinate, with some room.
    rounding: f64,
    spare: Vec<Corner>,
}

impl Clipper {
    /// For polygons as large as this one.
    pub(super) fn new(p: DVec3, polygon: &[DVec3]) -> Self {
        let reach = polygon.iter().fold(p.abs(), |reach, v| reach.max(v.abs())).max_element();
        Self { p, rounding: 16.0 * f64::EPSILON * reach, spare: Vec::new() }
    }

    /// Whether a polygon is empty, or no wider than rounding.
    pub(super) fn is_sliver(&self, polygon: &[Corner]) -> bool {
        let next = polygon.iter().cycle().skip(1);
        let perimeter: f64 = polygon.iter().zip(next).map(|(a, b)| a.at.distance(b.at)).sum();
        vector_area(polygon).length() <= self.rounding * perimeter
    }

    /// Leaves the part of a polygon inside a half-space.
    pub(super) fn cut(&mut self, polygon: &mut Vec<Corner>, half_space: &HalfSpace, index: usize) {
        let excess = |corner: &Corner| half_space.excess(corner.at - self.p);
        let (least, greatest) =
            polygon.iter().map(excess).fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), x| (lo.min(x), hi.max(x)));
        let touches = least >= -half_space.slack;
        if greatest <= 0.0 && !touches {
            return;
        }
        self.spare.clear();
        if !touches {
            let next = polygon.iter().cycle().skip(1);
            for (a, b) in polygon.iter().zip(next) {
                let (from, to) = (excess(a), excess(b));
                if from <= 0.0 {
                    self.spare.push(*a);
                }
                if (from <= 0.0) != (to <= 0.0) {
                    let at = a.at + from / (from - to) * (b.at - a.at);
                    let cut = if from <= 0.0 { Some(index) } else { a.cut };
                    self.spare.push(Corner { at, cut });
                }
            }
        }
        std::mem::swap(polygon, &mut self.spare);
    }

    /// Leaves the part of a polygon inside a convex region, and says whether that is anything.
    pub(super) fn intersect(&mut self, polygon: &mut Vec<Corner>, region: &[HalfSpace]) -> bool {
        for corner in polygon.iter_mut() {
            corner.cut = None;
        }
        for (i, half_space) in region.iter().enumerate() {
            self.cut(polygon, half_space, i);
            if polygon.is_empty() {
                return false;
            }
        }
        !self.is_sliver(polygon)
    }

    /// Appends what of a polygon lies outside a convex region to `pieces`: the polygon itself where they do not meet.
    ///
    /// Only the half-spaces that bound the common part cut, so that the fewest pieces arise; of a convex polygon the
    /// others cut off nothing.
    pub(super) fn subtract(&mut self, polygon: Vec<Corner>, region: &[HalfSpace], pieces: &mut Vec<Vec<Corner>>) {
        let mut common = polygon.clone();
        if !self.intersect(&mut common, region) {
            pieces.push(polygon);
            return;
        }
        let mut rest = polygon;
        for (i, half_space) in region.iter().enumerate().filter(|(i, _)| bounds(&common, *i)) {
            let mut outside = rest.clone();
            self.cut(&mut outside, &HalfSpace { slack: 0.0, ..half_space.complement() }, i);
            if !self.is_sliver(&outside) {
                pieces.push(outside);
            }
            self.cut(&mut rest, half_space, i);
        }
    }
}

/// Whether an edge of a polygon runs along a half-space of the region that made it.
pub(super) fn bounds(polygon: &[Corner], half_space: usize) -> bool {
    polygon.iter().any(|corner| corner.cut == Some(half_space))
}
