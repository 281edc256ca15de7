//! Polygons: Lambert's sum and the Phong contour integral.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::light::{Emitter, PolygonEmitter};
use softbox::math::spherical::triangle_solid_angle;
use softbox::shading::polygon::{polygon_irradiance, polygon_phong, polygon_phong_lobe_only};

use softbox::shading::reference::reference;
use softbox::shading::{Method, PhongLobe, ShadingPoint, respond};

use crate::cases::{self, Worst};
use crate::random::Random;

/// Solid angle of a planar polygon seen from p.
pub(crate) fn solid_angle(vertices: &[DVec3], p: DVec3) -> f64 {
    let fan = vertices.windows(2).map(|edge| triangle_solid_angle(vertices[0] - p, edge[0] - p, edge[1] - p));
    fan.sum::<f64>().abs()
}

/// The scale of a Phong case.
fn lobe_scale(vertices: &[DVec3], p: DVec3, m: f64) -> f64 {
    ((m + 1.0) / (2.0 * PI) * solid_angle(vertices, p)).min(1.0)
}

#[test]
fn polygon_irradiance_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_lambert") {
        let (p, vertices) = (case.vector("p"), case.vectors("vertices"));
        let value = polygon_irradiance(&vertices, p, case.direction("N")) / PI;
        worst.check(&case, value, case.value("expected"), (solid_angle(&vertices, p) / PI).min(1.0));
    }
    worst.finish("polygon_irradiance", 1e-13, 1e-12);
}

#[test]
fn polygon_phong_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_phong_nclip") {
        let (p, vertices, m) = (case.vector("p"), case.vectors("vertices"), case.number("n"));
        let value = polygon_phong(&vertices, p, case.direction("N"), case.direction("R"), m);
        worst.check(&case, value, case.value("expected"), lobe_scale(&vertices, p, m));
    }
    worst.finish("polygon_phong", 5e-12, 1e-10);
}

#[test]
fn polygon_phong_lobe_only_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_phong") {
        let (p, vertices, m) = (case.vector("p"), case.vectors("vertices"), case.number("n"));
        let value = polygon_phong_lobe_only(&vertices, p, case.direction("R"), m);
        worst.check(&case, value, case.value("expected"), lobe_scale(&vertices, p, m));
    }
    worst.finish("polygon_phong_lobe_only", 1e-13, 1e-10);
}

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
fn polygon_responses_are_finite_and_bounded_by_every_method() {
    let mut random = Random::new(31);
    for _ in 0..cases_wanted(20_000) {
        let (light, at, lobe) = random_view(&mut random);
        let emitter = Emitter::Polygon(light);
        for method in [Method::Exact, Method::NearestPoint, Method::Point, Method::PointCluster(16)] {
            let x = respond(&emitter, method, &at, &lobe);
            let finite = x.irradiance.is_finite() && x.specular.is_finite();
            assert!(
                finite && x.irradiance >= 0.0 && x.specular >= 0.0,
                "{method}: {x:?} for {emitter:?} {at:?} {lobe:?}"
            );
            let bounded = x.irradiance <= PI * (1.0 + 1e-12) && x.specular <= 1.0 + 1e-9;
            let is_points = matches!(method, Method::Point | Method::PointCluster(_));
            assert!(is_points || bounded, "{method}: {x:?} for {emitter:?} {at:?} {lobe:?}");
        }
    }
}

#[test]
fn polygon_exact_lies_in_the_band_of_the_reference() {
    let mut random = Random::new(32);
    for _ in 0..cases_wanted(300) {
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

/// How many random inputs to try: `usual`, or as `SOFTBOX_PROPERTY_CASES` says.
fn cases_wanted(usual: usize) -> usize {
    std::env::var("SOFTBOX_PROPERTY_CASES").ok().and_then(|count| count.parse().ok()).unwrap_or(usual)
}

/// A square light of half-width `half` at height `height`, facing down.
fn ceiling(half: f64, height: f64) -> Vec<DVec3> {
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| DVec3::new(half * x, half * y, height)).to_vec()
}

#[test]
fn an_endless_polygon_gives_pi_and_half_a_plane_gives_half() {
    let whole = polygon_irradiance(&ceiling(1e6, 1.0), DVec3::ZERO, DVec3::Z);
    assert!((whole - PI).abs() < 1e-11, "{whole}");
    let half = polygon_irradiance(&ceiling(1e6, 1.0), DVec3::ZERO, DVec3::X);
    assert!((half - 0.5 * PI).abs() < 1e-5, "{half}");
    let lobe = polygon_phong(&ceiling(1e6, 1.0), DVec3::ZERO, DVec3::Z, DVec3::Z, 33.5);
    assert!((lobe - 1.0).abs() < 1e-11, "{lobe}");
}

#[test]
fn a_far_polygon_is_a_point_light() {
    let n = DVec3::new(0.6, 0.0, 0.8);
    for height in [1e3, 1e5, 1e7] {
        let value = polygon_irradiance(&ceiling(0.5, height), DVec3::ZERO, n);
        let point = 0.8 / (height * height);
        assert!((value / point - 1.0).abs() < 2.0 / (height * height) + 1e-13, "{value:e} for {point:e} at {height:e}");
    }
}

#[test]
fn repeated_and_collinear_vertices_change_nothing() {
    let square = ceiling(1.0, 0.7);
    let (n, r) = (DVec3::new(0.8, 0.0, 0.6), DVec3::new(0.6, 0.64, 0.48));
    let mut more = square.clone();
    more.insert(1, square[0].midpoint(square[1]));
    more.insert(3, more[2]);
    let p = DVec3::new(0.3, -0.2, 0.1);
    let off = polygon_irradiance(&square, p, n) - polygon_irradiance(&more, p, n);
    assert!(off.abs() < 1e-15, "{off:e}");
    for m in [1.0, 7.0, 32.0, 50.5] {
        let off = polygon_phong(&square, p, n, r, m) - polygon_phong(&more, p, n, r, m);
        assert!(off.abs() < 1e-14, "{off:e} for m = {m}");
    }
}

#[test]
fn series_and_quadrature_agree_across_integer_exponents() {
    let p = DVec3::new(0.3, -0.2, 0.1);
    let (n, r) = (DVec3::new(0.8, 0.0, 0.6), DVec3::new(0.6, 0.64, 0.48));
    for m in [1.0, 2.0, 3.0, 8.0, 99.0, 200.0] {
        let at = |m| polygon_phong(&ceiling(1.0, 0.7), p, n, r, m);
        let between = 0.5 * (at(m - 1e-6_f64.min(m - 1.0)) + at(m + 1e-6_f64.min(m - 1.0)));
        assert!((at(m) - between).abs() < 1e-10, "{} for {between} at m = {m}", at(m));
    }
}
