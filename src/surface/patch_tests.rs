use glam::DVec3;
use proptest::prelude::*;

use super::intersect::LocalHit;
use super::{Patch, Placed, Shape, Surface, Triangle};

/// A sheet over the unit square, its control points lifted and shifted.
fn sheet(moves: &[f64]) -> Patch {
    Patch::new(std::array::from_fn(|k| {
        let place = |i: usize| f64::from(u32::try_from(i).unwrap()) / 3.0;
        DVec3::new(place(k % 4) + 0.15 * moves[3 * k], place(k / 4) + 0.15 * moves[3 * k + 1], moves[3 * k + 2])
    }))
}

/// An eighth of a sphere, nearly: one edge has shrunk to the pole.
fn eighth() -> Patch {
    const ARC: f64 = 0.552_284_749_830_793_4;
    let arc = [[1.0, 0.0], [1.0, ARC], [ARC, 1.0], [0.0, 1.0]];
    Patch::new(std::array::from_fn(|k| {
        let ([across, up], [x, y]) = (arc[k / 4], arc[k % 4]);
        DVec3::new(across * x, across * y, up)
    }))
}

fn nearest(triangles: &[Triangle], origin: DVec3, direction: DVec3) -> Option<f64> {
    let hits = triangles.iter().filter_map(|triangle| triangle.intersect(origin, direction));
    hits.map(|hit| hit.t).min_by(f64::total_cmp)
}

fn moves() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-1.0..1.0_f64, 48)
}

fn vector(reach: f64) -> impl Strategy<Value = DVec3> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(DVec3::from_array)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn the_nearest_hit_is_that_of_the_triangles(moves in moves(), origin in vector(3.0), u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        const N: u32 = 48;
        let patch = sheet(&moves);
        let (triangles, error) = (patch.triangles(N), patch.triangles_error(N));
        let aim = patch.at(u, v).p;
        let direction = (aim - origin).normalize_or(DVec3::Z);
        let hit = patch.hit(origin, direction);
        prop_assert!(hit.is_some(), "aimed at ({u}, {v})");
        let hit = hit.unwrap();
        prop_assert!((origin + hit.t * direction - hit.p).length() < 1e-12, "off the ray");
        prop_assert!(hit.t <= (aim - origin).length() + 1e-9, "beyond what was aimed at");
        // Where the ray comes in steeply, the sheets are as near to each other along it as their distance allows.
        let steep = hit.n.dot(direction).abs();
        if let Some(t) = nearest(&triangles, origin, direction) && steep > 0.5 {
            prop_assert!(t > hit.t - 4.0 * error, "triangles at {t}, patch at {}", hit.t);
        }
    }

    #[test]
    fn no_hit_lies_before_the_triangles_by_more_than_their_error(moves in moves(), origin in vector(3.0), aim in vector(1.0)) {
        const N: u32 = 48;
        let patch = sheet(&moves);
        let (triangles, error) = (patch.triangles(N), patch.triangles_error(N));
        let direction = (aim + 0.5 - origin).normalize_or(DVec3::Z);
        let by_triangles = triangles.iter().filter_map(|triangle| triangle.intersect(origin, direction));
        // A triangle crossed steeply in the midst of its neighbours has the patch nearby.
        let steep = by_triangles.filter(|hit| hit.n.dot(direction).abs() > 0.8);
        if let Some(t) = steep.map(|hit| hit.t).min_by(f64::total_cmp) {
            let hit = patch.hit(origin, direction).map(|hit| hit.t);
            let near_an_edge = patch.hit(origin, direction).is_none();
            prop_assert!(near_an_edge || hit.is_some_and(|hit| hit <= t + 4.0 * error), "{hit:?} against {t}");
        }
    }

    #[test]
    fn a_ray_that_leaves_the_patch_does_not_meet_it_at_once(
        moves in moves(), origin in vector(3.0), u in 0.0..1.0_f64, v in 0.0..1.0_f64, along in vector(1.0),
    ) {
        let patch = sheet(&moves);
        let direction = patch.at(u, v).p - origin;
        if let Some(LocalHit { p, .. }) = patch.hit(origin, direction)
            && let Some(again) = patch.hit(p, along)
        {
            prop_assert!((again.p - p).length() > 1e-6, "met again at {} of {p}", again.p);
        }
    }

    #[test]
    fn rays_aimed_at_the_pole_and_the_edges_do_not_slip_by(origin in vector(3.0), s in 0.0..1.0_f64) {
        let patch = eighth();
        for (u, v) in [(0.5, 1.0), (s, 1.0), (0.0, 0.0), (1.0, 0.0), (s, 0.5), (s, s)] {
            let aim = patch.at(u, v).p;
            let n = patch.normal(u, v).unwrap();
            if (aim - origin).dot(n).abs() > 1e-3 {
                // On the edge itself rounding decides; a little further in it must not.
                let inner = patch.at(0.5 + (u - 0.5) * (1.0 - 1e-9), 0.5 + (v - 0.5) * (1.0 - 1e-9)).p;
                let hit = patch.hit(origin, inner - origin);
                prop_assert!(hit.as_ref().is_some_and(|hit| hit.t <= 1.0 + 1e-7), "slips by at ({u}, {v})");
            }
        }
    }

    #[test]
    fn triangles_stay_within_their_error(moves in moves(), n in 1u32..12, u in 0.0..1.0_f64, v in 0.0..1.0_f64) {
        let patch = sheet(&moves);
        let p = patch.at(u, v).p;
        let distance = patch.triangles(n).iter().map(|triangle| distance(triangle, p)).fold(f64::INFINITY, f64::min);
        prop_assert!(distance <= patch.triangles_error(n), "{distance} off");
    }
}

/// Distance from a triangle, from above by sampling it.
fn distance(triangle: &Triangle, p: DVec3) -> f64 {
    let [a, b, c] = triangle.corners;
    let n = (b - a).cross(c - a).normalize_or_zero();
    let foot = p - (p - a).dot(n) * n;
    let inside = [(a, b), (b, c), (c, a)].iter().all(|(from, to)| n.dot((to - from).cross(foot - from)) >= 0.0);
    let to_edge = |from: DVec3, to: DVec3| {
        let along = (p - from).dot(to - from) / from.distance_squared(to);
        p.distance(from.lerp(to, along.clamp(0.0, 1.0)))
    };
    if inside { p.distance(foot) } else { to_edge(a, b).min(to_edge(b, c)).min(to_edge(c, a)) }
}

#[test]
fn the_normal_at_a_pole_is_that_of_the_neighbourhood() {
    let patch = eighth();
    for u in [0.0, 0.3, 1.0] {
        let n = patch.normal(u, 1.0).unwrap();
        assert!((n.z.abs() - 1.0).abs() < 1e-9, "{n} at {u}");
    }
    assert!((patch.normal(0.0, 0.0).unwrap().x.abs() - 1.0).abs() < 1e-9, "at the equator");
}

#[test]
fn a_flat_patch_is_met_as_a_square_is() {
    let patch = sheet(&[0.0; 48]);
    let hit = patch.hit(DVec3::new(0.3, 0.6, 2.0), DVec3::NEG_Z).unwrap();
    assert!((hit.t - 2.0).abs() < 1e-15 && hit.n.z.abs() == 1.0, "straight at it");
    for (origin, direction) in [
        (DVec3::new(-1.0, 0.5, 0.0), DVec3::X),
        (DVec3::new(0.5, 0.5, 0.0), DVec3::X),
        (DVec3::new(0.5, 0.5, 0.0), DVec3::Z),
        (DVec3::new(1.1, 0.5, 1.0), DVec3::NEG_Z),
    ] {
        assert!(patch.hit(origin, direction).is_none(), "{origin} along {direction}");
    }
}

#[test]
fn a_patch_without_area_or_a_ray_without_direction_gives_nothing() {
    let point = Patch::new([DVec3::ONE; 16]);
    assert!(point.hit(DVec3::ZERO, DVec3::X).is_none(), "a point");
    assert!(point.triangles(4).is_empty(), "no triangles");
    assert!(sheet(&[0.0; 48]).hit(DVec3::Z, DVec3::ZERO).is_none(), "no direction");
}

#[test]
fn a_placed_patch_falls_into_triangles_as_fine_as_asked_for() {
    let shape = Shape::Patch { control_points: Box::new(eighth().control_points) };
    let surface = Surface {
        name: "eighth".to_owned(),
        material: "clay".to_owned(),
        position: DVec3::X,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::splat(2.0),
        shape,
    };
    for share in [1e-2, 1e-4] {
        let parts = Placed::parts(&surface).remove(0).in_triangles(share);
        let n = eighth().fineness(share);
        assert!(eighth().triangles_error(n) <= 3.0_f64.sqrt() * share, "{n} for {share}");
        assert_eq!(parts.len(), (2 * n * n - n) as usize, "those at the pole are single");
        let middle = DVec3::X + 2.0 * eighth().at(0.4, 0.6).p;
        let hit = parts.iter().find_map(|part| part.intersect(DVec3::X, middle - DVec3::X));
        assert!(hit.is_some_and(|hit| (hit.t - 1.0).abs() < 2.0 * share), "{hit:?} within {share}");
    }
}

#[test]
fn neighbours_leave_no_gap() {
    let [left, right] = [0.0, 1.0].map(|shift| {
        Patch::new(std::array::from_fn(|k| {
            let (i, j) = (f64::from(u32::try_from(k / 4).unwrap()), f64::from(u32::try_from(k % 4).unwrap()));
            DVec3::new(shift + j / 3.0, i / 3.0, 0.3 * (i * 1.7).sin())
        }))
    });
    for i in 0..1000 {
        let y = 0.001 * f64::from(i) + 0.0005;
        let aim = left.at(1.0, y).p;
        let origin = DVec3::new(0.7, -0.4, 3.0);
        let met = [&left, &right].iter().any(|patch| patch.hit(origin, aim - origin).is_some());
        assert!(met, "a ray slips between the patches at {aim}");
    }
}
