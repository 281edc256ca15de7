//! The fractal objects of the Standard Procedural Databases.
//!
//! **Source:** E. Haines, *A proposal for standard graphics environments*, IEEE Computer Graphics and Applications
//! 7(11), 1987: `balls` and `tetra`.

use std::f64::consts::{FRAC_PI_3, FRAC_PI_4};

use glam::{DQuat, DVec3};

use super::Triangle;

/// A sphereflake of this depth has 66,430 spheres.
pub const MOST_FLAKE_DEPTH: u32 = 5;

/// A tetrahedron of this depth has 262,144 triangles.
pub const MOST_TETRAHEDRON_DEPTH: u32 = 8;

/// The radius of a flake's largest sphere, metres. All spheres together stay within twice that.
const LARGEST_RADIUS: f64 = 0.5;

/// A sphere's radius, in radii of the one that it sits on.
const SHRINKING: f64 = 1.0 / 3.0;

/// The spheres of a sphereflake: centres and radii, (9^(depth + 1) − 1)/8 of them.
///
/// On each sphere sit nine of a third of its radius: six about its equator and three above, each of these between two of
/// the six; its pole is where it grew away from its own sphere, and the largest one's is +Z.
pub(super) fn sphereflake(depth: u32) -> Vec<(DVec3, f64)> {
    let seats = seats();
    let mut spheres = vec![(DVec3::ZERO, LARGEST_RADIUS)];
    let mut youngest = vec![(DVec3::ZERO, DVec3::Z)];
    let mut radius = LARGEST_RADIUS;
    for _ in 0..depth.min(MOST_FLAKE_DEPTH) {
        let reach = radius * (1.0 + SHRINKING);
        radius *= SHRINKING;
        youngest = youngest.iter().flat_map(|&(center, pole)| on_sphere(center, pole, reach, &seats)).collect();
        spheres.extend(youngest.iter().map(|&(center, _)| (center, radius)));
    }
    spheres
}

/// The centres and poles of the spheres that sit on one.
fn on_sphere(center: DVec3, pole: DVec3, reach: f64, seats: &[DVec3; 9]) -> [(DVec3, DVec3); 9] {
    let turn = DQuat::from_rotation_arc(DVec3::Z, pole);
    seats.map(|seat| {
        let pole = (turn * seat).normalize_or(pole);
        (center + reach * pole, pole)
    })
}

/// The directions in which nine spheres sit about a pole +Z: every 60° about the equator, and every 120° at √⅔ above.
///
/// Each third is a regular triangle of directions 60° apart.
fn seats() -> [DVec3; 9] {
    let upper = (2.0_f64 / 3.0).sqrt();
    let beside = (1.0_f64 / 3.0).sqrt();
    std::array::from_fn(|i| {
        // A third of the circle has one seat above its middle, and two at 30° to either side on the equator.
        let third = FRAC_PI_4 + f64::from(u32::try_from(i / 3).unwrap_or_default()) * 2.0 * FRAC_PI_3;
        let at = |azimuth: f64, across: f64, z: f64| DVec3::new(across * azimuth.cos(), across * azimuth.sin(), z);
        match i % 3 {
            0 => at(third, beside, upper),
            1 => at(third - 0.5 * FRAC_PI_3, 1.0, 0.0),
            _ => at(third + 0.5 * FRAC_PI_3, 1.0, 0.0),
        }
    })
}

/// The triangles of a Sierpiński tetrahedron, 4^(depth + 1) of them, seen counterclockwise from outside.
///
/// A regular tetrahedron of edge 1, its centroid in the origin, one corner on +Z; it is then replaced, `depth` times, by
/// the four half as large in its corners.
pub(super) fn tetrahedron(depth: u32) -> Vec<Triangle> {
    let mut tetrahedra = vec![corners()];
    for _ in 0..depth.min(MOST_TETRAHEDRON_DEPTH) {
        tetrahedra = tetrahedra.iter().flat_map(|whole| whole.map(|kept| whole.map(|p| p.midpoint(kept)))).collect();
    }
    tetrahedra.iter().flat_map(faces).collect()
}

/// The corners of a regular tetrahedron of edge 1; the last on +Z.
fn corners() -> [DVec3; 4] {
    let below = -(1.0_f64 / 24.0).sqrt();
    let beside = (1.0_f64 / 3.0).sqrt();
    [
        DVec3::new(beside, 0.0, below),
        DVec3::new(-0.5 * beside, 0.5, below),
        DVec3::new(-0.5 * beside, -0.5, below),
        DVec3::new(0.0, 0.0, -3.0 * below),
    ]
}

fn faces(&[a, b, c, top]: &[DVec3; 4]) -> [Triangle; 4] {
    [[a, c, b], [a, b, top], [b, c, top], [c, a, top]].map(|corners| Triangle { corners, normals: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flake_has_nine_spheres_on_each_touching_it_and_staying_in_reach() {
        for (depth, count) in [(0, 1), (1, 10), (2, 91), (3, 820)] {
            let spheres = sphereflake(depth);
            assert_eq!(spheres.len(), count, "depth {depth}");
            for (i, (center, radius)) in spheres.iter().enumerate() {
                assert!(center.length() + radius <= 2.0 * LARGEST_RADIUS, "sphere {i} at {center}");
                let Some(parent) = i.checked_sub(1).map(|i| spheres[i / 9]) else { continue };
                let gap = center.distance(parent.0) - radius - parent.1;
                assert!(gap.abs() < 1e-15, "sphere {i} is {gap} off the one it sits on");
            }
        }
    }

    #[test]
    fn the_spheres_on_one_sphere_keep_apart() {
        let spheres = sphereflake(2);
        for (i, (a, r)) in spheres.iter().enumerate() {
            for (b, s) in &spheres[..i] {
                assert!(a.distance(*b) - r - s > -1e-15, "{a} and {b} overlap");
            }
        }
    }

    #[test]
    fn a_third_of_the_seats_is_a_regular_triangle() {
        let seats = seats();
        for third in seats.chunks(3) {
            for (a, b) in [(0, 1), (1, 2), (2, 0)] {
                assert!((third[a].dot(third[b]) - 0.5).abs() < 1e-15, "{third:?}");
            }
        }
    }

    #[test]
    fn a_tetrahedron_has_four_triangles_for_each_small_one_facing_outward() {
        for (depth, count) in [(0, 4), (1, 16), (5, 4096)] {
            let triangles = tetrahedron(depth);
            assert_eq!(triangles.len(), count, "depth {depth}");
            let edge = 0.5_f64.powi(depth.cast_signed());
            for small in triangles.chunks(4) {
                let corners = small.iter().flat_map(|face| face.corners);
                let middle = corners.sum::<DVec3>() / 12.0;
                for Triangle { corners: [a, b, c], .. } in small {
                    assert!((a.distance(*b) - edge).abs() < 1e-15, "edge {}", a.distance(*b));
                    let outward = (b - a).cross(c - a);
                    assert!(outward.dot(*a - middle) > 0.0, "{a} {b} {c}");
                }
            }
        }
    }

    #[test]
    fn a_depth_beyond_the_limit_is_the_limit() {
        assert_eq!(sphereflake(u32::MAX).len(), 66_430, "spheres");
        assert_eq!(tetrahedron(u32::MAX).len(), 262_144, "triangles");
    }
}
