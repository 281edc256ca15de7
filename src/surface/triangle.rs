//! Triangles, and rays against them.

use glam::{DAffine3, DVec3};

use super::Hit;
use super::intersect::ON_SURFACE;

/// A triangle; its front is where its corners run counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// Corners.
    pub corners: [DVec3; 3],
    /// Unit normals at the corners; none for a flat look.
    pub normals: Option<[DVec3; 3]>,
}

/// Coordinates are known to this share of the distance from the world's origin: a few units in their last place.
const ROUNDING: f64 = 1e-15;

/// Least cosine between a normal and the direction from which its triangle is seen.
const GRAZING: f64 = 1e-6;

impl Triangle {
    /// In square metres.
    pub fn area(&self) -> f64 {
        let [a, b, c] = self.corners;
        0.5 * (b - a).cross(c - a).length()
    }

    /// The triangle in another frame, with the same front.
    pub fn transformed(&self, to: &DAffine3) -> Self {
        let to_normal = to.matrix3.inverse().transpose();
        let mut corners = self.corners.map(|p| to.transform_point3(p));
        let mut normals = self.normals.map(|normals| normals.map(|n| (to_normal * n).normalize_or_zero()));
        if to.matrix3.determinant() < 0.0 {
            corners.swap(1, 2);
            normals.iter_mut().for_each(|normals| normals.swap(1, 2));
        }
        Self { corners, normals }
    }

    /// The hit of a ray; none from a point in the triangle's plane.
    ///
    /// The ray passes the edge from b to c on the side that the sign of d·(b × c) tells, corners seen from its origin.
    /// Swapping b and c changes nothing but that sign, to the last bit, and zero is within: rays do not slip through
    /// between triangles that share an edge. The point is put together of the corners, so that it lies in their plane
    /// however far off the origin is.
    pub(super) fn intersect(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let [a, b, c] = self.corners.map(|corner| corner - origin);
        let u = direction.dot(b.cross(c));
        let v = direction.dot(c.cross(a));
        if u * v < 0.0 {
            return None;
        }
        let w = direction.dot(a.cross(b));
        let within = (u >= 0.0 && v >= 0.0 && w >= 0.0) || (u <= 0.0 && v <= 0.0 && w <= 0.0);
        let sum = u + v + w;
        if !within || sum == 0.0 {
            return None;
        }
        let normal = (b - a).cross(c - a);
        let height = a.dot(normal);
        let reach = a.length_squared().max(b.length_squared()).max(c.length_squared());
        let rounding = (ROUNDING / ON_SURFACE).powi(2) * origin.length_squared();
        if height * height <= ON_SURFACE * ON_SURFACE * normal.length_squared() * (reach + rounding) {
            return None;
        }
        let t = height / direction.dot(normal);
        if !(t > 0.0 && t.is_finite()) {
            return None;
        }
        let weights = [u / sum, v / sum, w / sum];
        let n = normal.try_normalize()?;
        let n = self.normals.map_or(n, |normals| smooth(weighted(normals, weights), n, direction));
        Some(Hit { t, p: weighted(self.corners, weights), n })
    }
}

fn weighted([a, b, c]: [DVec3; 3], [u, v, w]: [f64; 3]) -> DVec3 {
    u * a + v * b + w * c
}

/// An interpolated normal as a unit normal on the front's side, and bent so far that it is seen from the side from which
/// the triangle is; `flat` is the triangle's own.
fn smooth(interpolated: DVec3, flat: DVec3, direction: DVec3) -> DVec3 {
    let (Some(n), Some(d)) = (interpolated.try_normalize(), direction.try_normalize()) else { return flat };
    let n = if n.dot(flat) < 0.0 { -n } else { n };
    let to_front = d * flat.dot(d).signum();
    let bent = n + (GRAZING - n.dot(to_front)).max(0.0) * to_front;
    bent.try_normalize().unwrap_or(flat)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn vector(reach: f64) -> impl Strategy<Value = DVec3> {
        [-reach..reach, -reach..reach, -reach..reach].prop_map(DVec3::from_array)
    }

    fn flat(corners: [DVec3; 3]) -> Triangle {
        Triangle { corners, normals: None }
    }

    /// A closed fan about a corner: the faces of an octahedron, moved.
    fn octahedron(center: DVec3, half: DVec3) -> Vec<Triangle> {
        let tip = |axis: usize, sign: f64| center + sign * half[axis] * DVec3::AXES[axis];
        let signs = [1.0, -1.0];
        let eighths = signs.into_iter().flat_map(|x| signs.map(|y| (x, y))).flat_map(|(x, y)| signs.map(|z| (x, y, z)));
        eighths.map(|(x, y, z)| flat([tip(0, x), tip(1, y), tip(2, z)])).collect()
    }

    proptest! {
        #[test]
        fn a_hit_lies_on_the_ray_and_in_the_triangle(
            a in vector(2.0), b in vector(2.0), c in vector(2.0), origin in vector(4.0),
            u in 0.01..0.98_f64, v in 0.01..0.98_f64, direction in vector(1.0),
        ) {
            let triangle = flat([a, b, c]);
            prop_assume!(triangle.area() > 1e-3);
            let (v, n) = (v * (1.0 - u), (b - a).cross(c - a).normalize());
            let inside = a + u * (b - a) + v * (c - a);
            prop_assume!((inside - origin).dot(n).abs() > 1e-3);
            let hit = triangle.intersect(origin, inside - origin);
            prop_assert!(hit.is_some_and(|hit| (hit.t - 1.0).abs() < 1e-11 && (hit.p - inside).length() < 1e-11
                && (hit.n - n).length() < 1e-13), "{hit:?}");
            prop_assert!(triangle.intersect(origin, origin - inside).is_none(), "behind");
            if let Some(hit) = triangle.intersect(origin, direction) {
                prop_assert!((origin + hit.t * direction - hit.p).length() < 1e-9 * hit.t.max(1.0), "{hit:?}");
                prop_assert!((hit.p - a).dot(n).abs() < 1e-14, "{hit:?}");
            }
        }

        #[test]
        fn nothing_slips_through_between_triangles(
            center in vector(3.0), half in vector(1.0), origin in vector(5.0), along in -1.0..1.0_f64,
            face in 0usize..8, edge in 0usize..3,
        ) {
            let half = half.abs() + 0.1;
            let faces = octahedron(center, half);
            let aimed = faces[face].corners;
            let (a, b) = (aimed[edge], aimed[(edge + 1) % 3]);
            // Corners and edges, as near as rounding lets one aim at them.
            for target in [a, a.lerp(b, along.abs())] {
                let inward = target.lerp(center, 1e-12);
                let count = faces.iter().filter(|face| face.intersect(origin, inward - origin).is_some()).count();
                let outside = ((origin - center) / half).abs().element_sum() > 1.01;
                prop_assert!(count >= if outside { 2 } else { 1 }, "{count} hits towards {target}");
            }
        }

        #[test]
        fn a_triangle_does_not_hit_itself(
            a in vector(2.0), b in vector(2.0), c in vector(2.0), origin in vector(4.0), direction in vector(1.0),
            offset in vector(1e3),
        ) {
            let triangle = flat([a + offset, b + offset, c + offset]);
            prop_assume!(triangle.area() > 1e-6);
            let middle = (a + b + c) / 3.0 + offset;
            if let Some(hit) = triangle.intersect(origin + offset, middle - origin - offset) {
                let again = triangle.intersect(hit.p, direction);
                prop_assert!(again.is_none(), "{again:?} from {hit:?}");
            }
        }

        #[test]
        fn a_smooth_normal_is_seen_from_where_its_triangle_is(
            normals in [vector(1.0), vector(1.0), vector(1.0)], origin in vector(4.0), u in 0.01..0.98_f64, v in 0.01..0.98_f64,
        ) {
            let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
            let triangle = Triangle { corners, normals: Some(normals.map(|n| n.normalize_or(DVec3::Z))) };
            let target = DVec3::new(u, v * (1.0 - u), 0.0);
            prop_assume!(origin.z.abs() > 1e-3);
            let hit = triangle.intersect(origin, target - origin);
            prop_assert!(hit.is_some_and(|hit| (hit.n.length() - 1.0).abs() < 1e-14
                && hit.n.dot(origin - target) * origin.z > 0.0), "{hit:?}");
        }
    }

    #[test]
    fn normals_are_interpolated() {
        let normals = [DVec3::new(-0.6, 0.0, 0.8), DVec3::new(0.6, 0.0, 0.8), DVec3::Z];
        let triangle = Triangle { corners: [DVec3::ZERO, DVec3::X, DVec3::Y], normals: Some(normals) };
        let hit = triangle.intersect(DVec3::new(0.5, 0.0, 1.0), DVec3::NEG_Z).unwrap();
        assert!((hit.n - DVec3::Z).length() < 1e-15, "{hit:?}");
        let hit = triangle.intersect(DVec3::new(0.75, 0.0, 1.0), DVec3::NEG_Z).unwrap();
        assert!((hit.n - DVec3::new(0.3, 0.0, 0.8).normalize()).length() < 1e-15, "{hit:?}");
    }

    #[test]
    fn a_mirrored_triangle_keeps_its_front() {
        let triangle = Triangle { corners: [DVec3::ZERO, DVec3::X, DVec3::Y], normals: Some([DVec3::Z; 3]) };
        let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let hit = triangle.transformed(&mirror).intersect(DVec3::new(-0.25, 0.25, 1.0), DVec3::NEG_Z).unwrap();
        assert!(hit.n == DVec3::Z, "{hit:?}");
    }
}
