//! What must hold for every polygon, over random inputs and where formulae meet.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};
use softbox::light::{Emitter, PolygonEmitter};
use softbox::shading::polygon::{polygon_irradiance, polygon_phong};
use softbox::shading::reference::reference;
use softbox::shading::{Method, PhongLobe, ShadingPoint, respond};

use crate::polygon::{ceiling, solid_angle};
use crate::random::Random;

/// A star-shaped polygon, convex or not, and a point that looks at it.
fn random_view(random: &mut Random) -> (PolygonEmitter, ShadingPoint, PhongLobe) {
    let normal = random.direction();
    let (x, y) = normal.any_orthonormal_pair();
    let center = random.direction() * random.magnitude(1e-2, 100.0);
    let corners = 3.0 + random.within(0.0, 6.0).floor();
    let mut vertices = Vec::new();
    while (vertices.len() as f64) < corners {
        let angle = -2.0 * PI * vertices.len() as f64 / corners;
        vertices.push(center + random.magnitude(0.1, 1.0) * (angle.cos() * x + angle.sin() * y));
    }
    let (n, mut v) = (random.direction(), random.direction());
    if v.dot(n) < 0.0 {
        v -= 2.0 * v.dot(n) * n;
    }
    let m = random.magnitude(1.0, 1000.0);
    let lobe = PhongLobe::new(if random.within(0.0, 1.0) < 0.5 { m } else { m.round() });
    (PolygonEmitter { vertices, normal, two_sided: true }, ShadingPoint { p: DVec3::ZERO, n, v }, lobe)
}

#[test]
fn responses_are_finite_and_bounded_by_every_method() {
    let approximations = [Method::NearestPoint, Method::NearestPointPicott, Method::Point, Method::PointCluster(16)];
    let mut random = Random::new(31);
    for i in 0..cases_wanted() {
        let (light, at, lobe) = random_view(&mut random);
        let solid_angle = solid_angle(&light.vertices, at.p);
        let emitter = Emitter::Polygon(light);
        let exact = respond(&emitter, Method::Exact, &at, &lobe);
        let scale = (lobe.normalisation() * solid_angle).min(1.0);
        let bounded = exact.irradiance <= PI.min(solid_angle) * (1.0 + 1e-9) && exact.specular <= scale * (1.0 + 1e-9);
        assert!(bounded, "{exact:?} with {solid_angle} sr for {emitter:?} {at:?} {lobe:?}");
        assert!(exact.irradiance >= 0.0 && exact.specular >= 0.0, "{exact:?} for {emitter:?} {at:?} {lobe:?}");
        let method = approximations[i % approximations.len()];
        let x = respond(&emitter, method, &at, &lobe);
        let finite = x.irradiance.is_finite() && x.specular.is_finite();
        assert!(finite && x.irradiance >= 0.0 && x.specular >= 0.0, "{method}: {x:?} for {emitter:?} {at:?} {lobe:?}");
        let is_points = matches!(method, Method::Point | Method::PointCluster(_));
        assert!(is_points || x.specular <= 1.0 + 1e-9, "{method}: {x:?} for {emitter:?} {at:?} {lobe:?}");
    }
}

#[test]
fn exact_lies_in_the_band_of_the_reference() {
    let mut random = Random::new(32);
    // Quadrature costs some three hundred times as much.
    for _ in 0..cases_wanted() / 300 {
        let (light, at, lobe) = random_view(&mut random);
        let emitter = Emitter::Polygon(light);
        let exact = respond(&emitter, Method::Exact, &at, &lobe);
        let band = reference(&emitter, &at, &lobe);
        for (x, band) in [(exact.irradiance, band.irradiance), (exact.specular, band.specular)] {
            let off = (x - band.value).abs();
            assert!(
                off <= band.error + 1e-13 + 1e-10 * x,
                "{x:e} is {off:e} off {band:?} for {emitter:?} {at:?} {lobe:?}"
            );
        }
    }
}

/// How many random inputs to try: 100 000, or as `SOFTBOX_PROPERTY_CASES` says.
fn cases_wanted() -> usize {
    std::env::var("SOFTBOX_PROPERTY_CASES").ok().and_then(|count| count.parse().ok()).unwrap_or(100_000)
}

/// Irradiance and specular part, over vertices about p.
fn both_parts(vertices: &[DVec3], n: DVec3, r: DVec3, m: f64) -> [f64; 2] {
    [polygon_irradiance(vertices, DVec3::ZERO, n), polygon_phong(vertices, DVec3::ZERO, n, r, m)]
}

#[test]
fn turned_scaled_reversed_or_relabelled_polygons_are_the_same() {
    let mut random = Random::new(34);
    for _ in 0..cases_wanted() / 4 {
        let (light, at, lobe) = random_view(&mut random);
        let (n, r, m) = (at.n, at.mirror(), lobe.exponent());
        let before = both_parts(&light.vertices, n, r, m);
        let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, 2.0 * PI));
        let scale = random.magnitude(1e-3, 1e3);
        let mut vertices: Vec<_> = light.vertices.iter().map(|vertex| turn * (scale * *vertex)).collect();
        vertices.rotate_left(1);
        vertices.reverse();
        let after = both_parts(&vertices, turn * n, turn * r, m);
        // A turn rounds directions, which a narrow light or a steep lobe makes more of.
        let solid_angle = solid_angle(&light.vertices, at.p);
        let scales = [PI.min(solid_angle), (lobe.normalisation() * solid_angle).min(1.0)];
        for ((x, y), scale) in before.iter().zip(after).zip(scales) {
            let off = (x - y).abs();
            assert!(off <= 1e-9 * x + 1e-10 * scale + 1e-14, "{before:?} is {after:?} for {light:?} {at:?} {lobe:?}");
        }
    }
}

/// Where a formula changes or a horizon meets the light: n, r and m there.
fn boundaries(vertices: &[DVec3], random: &mut Random) -> Vec<(DVec3, DVec3, f64)> {
    let (corner, next) = (vertices[0].normalize(), vertices[1].normalize());
    let (n, r) = (random.direction(), random.direction());
    let m = random.magnitude(1.0, 60.0);
    let on_edge = corner.lerp(next, random.within(0.1, 0.9)).normalize();
    // A unit vector perpendicular to v, next to n.
    let across = |v: DVec3| (n - n.dot(v) * v).normalize();
    let edge = corner.cross(next).normalize();
    vec![
        (across(corner), r, m),
        (across(on_edge), r, m),
        (edge, r, m),
        (n, across(corner), m),
        (n, edge, m),
        (n, corner, m),
        (n, on_edge, m),
        (corner, corner, m),
        (n, n, m),
        (n, -corner, m),
        (n, -on_edge, m),
        (n, r, m.round()),
        (n, r, 500.0),
    ]
}

#[test]
fn nothing_jumps_where_horizons_corners_edges_and_formulae_meet() {
    let mut random = Random::new(35);
    let mut steepest: f64 = 0.0;
    for _ in 0..cases_wanted() / 100 {
        let (light, _, _) = random_view(&mut random);
        let nearest = light.vertices.iter().map(|vertex| vertex.length()).fold(f64::INFINITY, f64::min);
        let height = light.normal.dot(light.vertices[0]).abs();
        for (n, r, m) in boundaries(&light.vertices, &mut random) {
            for step in [1e-9, 1e-7] {
                let [dn, dr, dp] = [(); 3].map(|()| step * random.direction());
                let moved: Vec<_> = light.vertices.iter().map(|vertex| vertex + nearest * dp).collect();
                let before =
                    both_parts(&light.vertices, (n - dn).normalize(), (r - dr).normalize(), (m - step).max(1.0));
                let after = both_parts(&moved, (n + dn).normalize(), (r + dr).normalize(), m + step);
                for (x, y) in before.iter().zip(after) {
                    let change = ((x - y).abs() - 1e-12).max(0.0);
                    let slope = change / (step * (m + 1.0)) * (height / nearest).min(1.0);
                    steepest = steepest.max(slope);
                    assert!(slope < 10.0, "from {before:?} to {after:?} in {step:e} at {n}, {r}, {m} for {light:?}");
                }
            }
        }
    }
    println!("steepest {steepest:.2} of (m + 1) nearest/height");
}

#[test]
fn degenerate_polygons_and_places_give_finite_numbers() {
    let square = ceiling(1.0, 0.0);
    let comb = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 0), (3, 0), (3, 1), (4, 1), (4, 0), (5, 0), (5, 2), (0, 2)];
    let comb = comb.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0)).to_vec();
    let needle = vec![-DVec3::X, DVec3::X, DVec3::X + 1e-12 * DVec3::Y, 1e-12 * DVec3::Y - DVec3::X];
    let line = vec![-DVec3::X, DVec3::ZERO, DVec3::X];
    let point = vec![DVec3::X; 3];
    let twice = vec![square[0], square[0], square[1], square[1], square[2], square[3]];
    let lights = [square.clone(), comb, needle, line, point, twice, Vec::new(), square[..2].to_vec()];
    let offsets = [0.0, 1e-300, 1e-18, 1e-12, 1e-6, 1.0, 1e6];
    let places = [DVec3::ZERO, square[0], square[0].midpoint(square[1]), DVec3::new(1.5, 0.5, 0.0), 3.0 * square[0]];
    let directions = [DVec3::X, -DVec3::Y, DVec3::Z, -DVec3::Z, DVec3::new(0.6, 0.0, 0.8)];
    for vertices in &lights {
        for (place, offset) in places.iter().flat_map(|place| offsets.map(|offset| (place, offset))) {
            for (n, r) in directions.iter().flat_map(|n| directions.map(|r| (n, r))) {
                let p = *place + offset * DVec3::Z;
                for m in [1.0, 1.04, 2.0, 31.0, 31.5, 1000.0] {
                    let (e, s) = (polygon_irradiance(vertices, p, *n), polygon_phong(vertices, p, *n, r, m));
                    let fine = (0.0..=PI + 1e-9).contains(&e) && (0.0..=1.0 + 1e-9).contains(&s);
                    assert!(fine, "{e}, {s} for {vertices:?} at {p} with {n}, {r}, {m}");
                }
            }
        }
    }
}
