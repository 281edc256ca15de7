//! A planar polygonal light.

use std::f64::consts::PI;

use glam::{DAffine3, DVec2, DVec3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::math::triangulate::orientation;

/// A simple planar polygon in the light's XY plane, convex or not, Lambertian with constant luminance.
///
/// Vertices may run either way round; the lit side is −Z, and +Z too when two-sided.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Polygon {
    /// Corners in order, metres.
    #[schemars(with = "Vec<[f64; 2]>")]
    pub vertices: Vec<DVec2>,
    /// Emits to both sides.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub two_sided: bool,
}

/// A [`Polygon`] in the world, luminance 1.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonEmitter {
    /// Corners in order: counter-clockwise for an eye on the lit side looking at it.
    pub vertices: Vec<DVec3>,
    /// Unit normal of the lit side.
    pub normal: DVec3,
    /// Emits to both sides.
    pub two_sided: bool,
}

/// Why a list of vertices is no polygon.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum PolygonError {
    /// Fewer than three vertices.
    #[error("{0} vertices are too few; a polygon has at least 3")]
    TooFewVertices(usize),
    /// Two edges cross or touch; edge i starts at vertex i, from 0.
    #[error("edges {0} and {1} cross or touch; edges may meet only at the vertex between them")]
    Crossing(usize, usize),
    /// Two consecutive vertices coincide.
    #[error("vertices {0} and {1} coincide; leave one of them out")]
    RepeatedVertex(usize, usize),
    /// All vertices lie on a line.
    #[error("all vertices lie on one line; move one off it")]
    Flat,
}

impl Polygon {
    /// Whether the vertices are a simple polygon: its edges meet only at the vertices that they share, and enclose
    /// some area. Exact: see [`orientation`]. Vertices must be finite.
    pub fn check(&self) -> Result<(), PolygonError> {
        let v = &self.vertices;
        let count = v.len();
        if count < 3 {
            return Err(PolygonError::TooFewVertices(count));
        }
        let next = |i: usize| (i + 1) % count;
        if let Some(i) = (0..count).find(|&i| v[i] == v[next(i)]) {
            return Err(PolygonError::RepeatedVertex(i, next(i)));
        }
        if (1..count).all(|i| orientation(v[0], v[i], v[next(i)]) == 0.0) {
            return Err(PolygonError::Flat);
        }
        for i in 0..count {
            if folds_back(v[i], v[next(i)], v[next(next(i))]) {
                return Err(PolygonError::Crossing(i, next(i)));
            }
            // Edges that share no vertex with edge i; the last edge shares one with the first.
            for j in i + 2..count - usize::from(i == 0) {
                if segments_touch([v[i], v[next(i)]], [v[j], v[next(j)]]) {
                    return Err(PolygonError::Crossing(i, j));
                }
            }
        }
        Ok(())
    }

    /// Twice-signed half the cross sum: positive when the vertices run counter-clockwise seen from +Z.
    pub fn signed_area(&self) -> f64 {
        let Some(&origin) = self.vertices.first() else { return 0.0 };
        let twice: f64 = self.vertices.windows(2).map(|edge| (edge[0] - origin).perp_dot(edge[1] - origin)).sum();
        0.5 * twice
    }

    /// Area in m².
    pub fn area(&self) -> f64 {
        self.signed_area().abs()
    }

    /// Φ/L = πA a side.
    pub fn flux_per_luminance(&self) -> f64 {
        PI * self.area() * if self.two_sided { 2.0 } else { 1.0 }
    }

    /// The polygon in the world.
    pub fn place(&self, world_from_light: &DAffine3) -> PolygonEmitter {
        let place = |v: &DVec2| world_from_light.transform_point3(v.extend(0.0));
        // The lit side is −Z, so counter-clockwise for its viewer is clockwise seen from +Z.
        let vertices = if self.signed_area() > 0.0 {
            self.vertices.iter().rev().map(place).collect()
        } else {
            self.vertices.iter().map(place).collect()
        };
        PolygonEmitter { vertices, normal: -world_from_light.matrix3.z_axis, two_sided: self.two_sided }
    }
}

/// Whether the edge b→c runs back over the edge a→b.
fn folds_back(a: DVec2, b: DVec2, c: DVec2) -> bool {
    orientation(a, b, c) == 0.0 && (a - b).dot(c - b) > 0.0
}

/// Whether two closed segments have a point in common.
fn segments_touch([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let apart = a.max(b).cmplt(c.min(d)).any() || c.max(d).cmplt(a.min(b)).any();
    // Neither segment has both ends strictly on one side of the other. Collinear ones are left to the boxes.
    let one_side = |a, b, c, d| {
        let (left, right) = (orientation(a, b, c), orientation(a, b, d));
        left > 0.0 && right > 0.0 || left < 0.0 && right < 0.0
    };
    !apart && !one_side(a, b, c, d) && !one_side(c, d, a, b)
}

impl PolygonEmitter {
    /// Vector area: its length is the area, its direction the lit side's normal.
    pub fn vector_area(&self) -> DVec3 {
        let Some(&origin) = self.vertices.first() else { return DVec3::ZERO };
        0.5 * self.vertices.windows(2).map(|edge| (edge[0] - origin).cross(edge[1] - origin)).sum::<DVec3>()
    }

    /// Centre of area; the mean of the vertices when the area is zero.
    pub fn centroid(&self) -> DVec3 {
        let Some(&origin) = self.vertices.first() else { return DVec3::ZERO };
        let mut weighted = DVec3::ZERO;
        let mut area = 0.0;
        for edge in self.vertices.windows(2) {
            let (u, v) = (edge[0] - origin, edge[1] - origin);
            let twice = u.cross(v).dot(self.normal);
            weighted += twice * (u + v) / 3.0;
            area += twice;
        }
        if area.abs() > 0.0 {
            origin + weighted / area
        } else {
            self.vertices.iter().sum::<DVec3>() / self.vertices.len() as f64
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(vertices: &[[f64; 2]], expected: Result<(), PolygonError>) {
        let mut vertices: Vec<_> = vertices.iter().copied().map(DVec2::from).collect();
        let polygon = Polygon { vertices: vertices.clone(), two_sided: false };
        assert_eq!(polygon.check(), expected, "{vertices:?}");
        vertices.reverse();
        let reversed = Polygon { vertices, two_sided: false };
        assert_eq!(reversed.check().is_ok(), expected.is_ok(), "the other way round: {reversed:?}");
    }

    #[test]
    fn simple_polygons_pass_convex_or_not() {
        check(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Ok(()));
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.5], [0.0, 2.0]], Ok(()));
        // A vertex in the middle of a straight side is allowed.
        check(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]], Ok(()));
        // A sliver that only exact orientation tells from a line.
        check(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0 + 4.0 * f64::EPSILON]], Ok(()));
    }

    #[test]
    fn each_fault_is_named_with_its_place() {
        check(&[[0.0, 0.0], [1.0, 0.0]], Err(PolygonError::TooFewVertices(2)));
        check(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [3.0, 3.0]], Err(PolygonError::Flat));
        check(&[[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], Err(PolygonError::RepeatedVertex(1, 2)));
        check(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]], Err(PolygonError::RepeatedVertex(3, 0)));
        check(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], Err(PolygonError::Crossing(0, 2)));
        // A vertex that lies on an edge, and an edge that runs back over the one before.
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]], Err(PolygonError::Crossing(0, 2)));
        check(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]], Err(PolygonError::Crossing(0, 1)));
    }
}
