//! Simple polygons in triangles and in convex parts.
//!
//! Both decide by the sign of an exact determinant, with the corners seen along the axis that the polygon's normal
//! (Newell's) is nearest to: dropping a coordinate rounds nothing.

use glam::{DVec2, DVec3};
use robust::{Coord, orient2d};

/// Above 0 when a, b, c turn counter-clockwise, below when clockwise, 0 when they lie on a line; the sign is exact.
pub fn orientation(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let [a, b, c] = [a, b, c].map(|p| Coord { x: p.x, y: p.y });
    orient2d(a, b, c)
}

/// The triangles of a simple planar polygon, convex or not, in its own sense: ears are cut off until three corners are
/// left.
///
/// Of a polygon that crosses itself, corners are cut off in turn.
pub fn ears(points: &[DVec3]) -> Vec<[usize; 3]> {
    ears_of(&flattened(points))
}

/// A simple planar polygon in convex parts of its own sense, at most four times as many as must be: the polygon itself
/// where it is convex.
///
/// Ears are merged along their diagonals while the result is convex (S. Hertel and K. Mehlhorn, *Fast Triangulation of
/// Simple Polygons*, FCT 1983). A corner that turns inwards by no more than its coordinates' rounding lies on a straight
/// side. Parts of a polygon that crosses itself need not be convex.
pub fn convex_parts(points: &[DVec3]) -> Vec<Vec<DVec3>> {
    let flat = flattened(points);
    let reach = points.iter().fold(DVec3::ZERO, |reach, p| reach.max(p.abs())).max_element();
    let rounding = 16.0 * f64::EPSILON * reach;
    let is_convex_at = |part: &[usize], i: usize| {
        let count = part.len();
        let [a, b, c] = [i + count - 1, i, i + 1].map(|i| flat[part[i % count]]);
        orientation(a, b, c) >= -rounding * a.distance(c)
    };
    let whole: Vec<usize> = (0..points.len()).collect();
    if (0..whole.len()).all(|i| is_convex_at(&whole, i)) {
        return vec![points.to_vec()];
    }
    let ears = ears_of(&flat);
    let mut parts: Vec<Vec<usize>> = ears.iter().map(|ear| ear.to_vec()).collect();
    for [a, _, c] in ears {
        let [Some((i, one)), Some((k, other))] = [[c, a], [a, c]].map(|edge| opened(&parts, edge)) else { continue };
        let merged = [&one[..], &other[1..other.len() - 1]].concat();
        if is_convex_at(&merged, 0) && is_convex_at(&merged, one.len() - 1) {
            parts[i] = merged;
            parts.swap_remove(k);
        }
    }
    parts.iter().map(|part| part.iter().map(|&corner| points[corner]).collect()).collect()
}

/// The part that an edge is of, and its corners from that edge's end on round to its start.
fn opened(parts: &[Vec<usize>], [from, to]: [usize; 2]) -> Option<(usize, Vec<usize>)> {
    parts.iter().enumerate().find_map(|(which, part)| {
        let end = part.iter().position(|&corner| corner == to)?;
        let before = part[(end + part.len() - 1) % part.len()];
        (before == from).then(|| (which, [&part[end..], &part[..end]].concat()))
    })
}

/// The triangles of a polygon that runs counter-clockwise.
fn ears_of(flat: &[DVec2]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..flat.len()).collect();
    let mut ears = Vec::with_capacity(flat.len().saturating_sub(2));
    while left.len() > 3 {
        let count = left.len();
        let around = |i: usize| [left[(i + count - 1) % count], left[i], left[(i + 1) % count]];
        let ear = (0..count).find(|i| is_ear(flat, around(*i), &left)).unwrap_or(0);
        ears.push(around(ear));
        left.remove(ear);
    }
    if let [a, b, c] = left[..] {
        ears.push([a, b, c]);
    }
    ears
}

/// The polygon counter-clockwise in a plane.
fn flattened(points: &[DVec3]) -> Vec<DVec2> {
    let origin = points.first().copied().unwrap_or_default();
    let next = points.iter().cycle().skip(1);
    let normal: DVec3 = points.iter().zip(next).map(|(a, b)| (a - origin).cross(b - origin)).sum();
    let size = normal.abs();
    let flat = |p: &DVec3| match size {
        DVec3 { x, y, z } if x >= y && x >= z => DVec2::new(p.y * normal.x.signum(), p.z),
        DVec3 { y, z, .. } if y >= z => DVec2::new(p.z * normal.y.signum(), p.x),
        _ => DVec2::new(p.x * normal.z.signum(), p.y),
    };
    points.iter().map(flat).collect()
}

/// Whether the middle one of three neighbours can be cut off: it is convex, and none of the others is in the triangle.
fn is_ear(flat: &[DVec2], [a, b, c]: [usize; 3], left: &[usize]) -> bool {
    let [a, b, c] = [flat[a], flat[b], flat[c]];
    if orientation(a, b, c) <= 0.0 {
        return false;
    }
    let is_outside = |p| orientation(a, b, p) < 0.0 || orientation(b, c, p) < 0.0 || orientation(c, a, p) < 0.0;
    left.iter().map(|i| flat[*i]).filter(|p| *p != a && *p != b && *p != c).all(is_outside)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use glam::DMat3;
    use proptest::prelude::*;

    use super::*;

    /// Twice the area of a polygon, below 0 where it runs clockwise about a normal.
    fn doubled_area(points: &[DVec3], normal: DVec3) -> f64 {
        let edges = points.windows(2).map(|edge| (edge[0] - points[0]).cross(edge[1] - points[0]).dot(normal));
        edges.sum()
    }

    /// Checks that a flat polygon, counter-clockwise, falls into at most so many convex parts, turned too and either way
    /// round. With r corners that turn inwards, 2r + 1 is Hertel and Mehlhorn's bound.
    #[track_caller]
    fn check(corners: &[[f64; 2]], most: usize) {
        let turned = DMat3::from_rotation_x(0.7) * DMat3::from_rotation_y(-2.1);
        for frame in [DMat3::IDENTITY, turned] {
            let mut polygon: Vec<_> = corners.iter().map(|&corner| frame * DVec2::from(corner).extend(3.0)).collect();
            for normal in [frame.z_axis, -frame.z_axis] {
                let parts = convex_parts(&polygon);
                assert!(parts.len() <= most, "{parts:?}");
                check_parts(&polygon, normal, &parts);
                polygon.reverse();
            }
        }
    }

    /// Checks that parts are convex, run as the polygon does about its normal, and have its area together.
    #[track_caller]
    fn check_parts(polygon: &[DVec3], normal: DVec3, parts: &[Vec<DVec3>]) {
        for part in parts {
            let corner = |i: usize| part[i % part.len()];
            for i in 0..part.len() {
                let turn = doubled_area(&[corner(i), corner(i + 1), corner(i + 2)], normal);
                assert!(turn > -1e-13, "{turn:e} at corner {i} of {part:?}");
            }
            assert!(doubled_area(part, normal) > -1e-15, "{part:?}");
        }
        let areas: f64 = parts.iter().map(|part| doubled_area(part, normal)).sum();
        let area = doubled_area(polygon, normal);
        assert!((areas - area).abs() < 1e-13 * area, "{areas} of {area}");
    }

    #[test]
    fn few_parts_make_the_plain_shapes() {
        check(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], 1);
        check(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 1);
        check(&[[1.0, 0.0], [-1.0, 0.8], [0.2, 0.0], [-1.0, -0.8]], 2);
        check(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]], 3);
        check(&[[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]], 5);
    }

    #[test]
    fn corners_on_straight_sides_make_no_parts() {
        check(&[[0.0, 0.0], [0.3, 0.0], [1.0, 0.0], [1.0, 0.7], [1.0, 1.0], [0.1, 1.0], [0.0, 1.0], [0.0, 0.6]], 1);
        let l_shape = [
            [0.0, 0.0],
            [0.7, 0.0],
            [2.0, 0.0],
            [2.0, 1.0],
            [1.3, 1.0],
            [1.0, 1.0],
            [1.0, 1.9],
            [1.0, 2.0],
            [0.0, 2.0],
        ];
        check(&l_shape, 3);
    }

    #[test]
    fn a_convex_polygon_is_its_only_part_to_the_last_bit() {
        let polygon: Vec<_> = (0..9).map(|i| DVec2::from_angle(TAU * f64::from(i) / 9.0).extend(0.3)).collect();
        assert_eq!(convex_parts(&polygon), std::slice::from_ref(&polygon), "in its own order");
    }

    proptest! {
        #[test]
        fn a_star_falls_into_triangles_and_parts_of_its_own_sense_and_area(
            radii in proptest::collection::vec(0.1..1.0_f64, 3..40), turn in -3.0..3.0_f64, tilt in -3.0..3.0_f64,
            flip in any::<bool>(),
        ) {
            let step = TAU / radii.len() as f64;
            let turned = DMat3::from_rotation_x(tilt) * DMat3::from_rotation_y(turn);
            let mut star: Vec<DVec3> = radii.iter().enumerate()
                .map(|(i, r)| turned * (*r * DVec2::from_angle(step * i as f64)).extend(0.3)).collect();
            if flip {
                star.reverse();
            }
            let normal = turned * DVec3::Z * if flip { -1.0 } else { 1.0 };
            let ears = ears(&star);
            prop_assert_eq!(ears.len(), star.len() - 2);
            let triangles: Vec<_> = ears.iter().map(|ear| ear.map(|i| star[i]).to_vec()).collect();
            check_parts(&star, normal, &triangles);
            let parts = convex_parts(&star);
            check_parts(&star, normal, &parts);
            // r inward corners part a polygon at least in r/2 + 1, and each is met by at most two diagonals.
            let corner = |i: usize| star[i % star.len()];
            let inward = (0..star.len()).filter(|&i| doubled_area(&[corner(i), corner(i + 1), corner(i + 2)], normal) < 0.0);
            prop_assert!(parts.len() <= 2 * inward.count() + 1, "{} parts", parts.len());
        }
    }
}
