//! Polygons: Lambert's sum and the Phong contour integral.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::light::PolygonEmitter;
use softbox::math::spherical::triangle_solid_angle;
use softbox::shading::polygon::{
    polygon_irradiance, polygon_least_angle_cosine, polygon_phong, polygon_phong_lobe_only,
    polygon_projected_edge_cosine,
};

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

/// A square light of half-width `half` at height `height`, facing down.
pub(crate) fn ceiling(half: f64, height: f64) -> Vec<DVec3> {
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

/// Mean and worst of how many degrees more than the least angle the projected-edge rule gives.
#[derive(Debug, Default)]
struct Excess {
    count: f64,
    sum: f64,
    worst: f64,
}

impl Excess {
    fn add(&mut self, degrees: f64) {
        self.count += 1.0;
        self.sum += degrees;
        self.worst = self.worst.max(degrees);
    }
}

/// Picott's rule on random parallelograms, against the least angle: the figures that its documentation states.
#[test]
fn projected_edges_are_as_far_off_as_documented() {
    let mut random = Random::new(33);
    let (mut one, mut both) = (Excess::default(), Excess::default());
    let (mut misses, mut missed) = (0.0, 0.0);
    let mut hits = 0;
    while hits < 100_000 {
        hits += 1;
        let (corner, u, v) = (3.0 * random.direction(), random.point(2.0), random.point(2.0));
        let vertices = vec![corner, corner + u, corner + u + v, corner + v];
        let light = PolygonEmitter { vertices, normal: u.cross(v).normalize(), two_sided: true };
        let r = random.direction();
        let least = polygon_least_angle_cosine(&light, DVec3::ZERO, r, r);
        let Some(distance) = Some(corner.dot(light.normal) / r.dot(light.normal)).filter(|distance| *distance > 0.0)
        else {
            misses += 1.0;
            missed += f64::from(u8::from(least.is_some()));
            assert_eq!(polygon_projected_edge_cosine(&light, DVec3::ZERO, r, r), None, "no meeting point: {light:?}");
            continue;
        };
        let meeting = distance * r - corner;
        let scale = u.cross(v).length_squared();
        let s = meeting.cross(v).dot(u.cross(v)) / scale;
        let t = u.cross(meeting).dot(u.cross(v)) / scale;
        let out = [s, t].iter().filter(|x| !(0.0..=1.0).contains(*x)).count();
        let (Some(least), Some(picott)) = (least, polygon_projected_edge_cosine(&light, DVec3::ZERO, r, r)) else {
            continue;
        };
        assert!(picott <= least + 1e-9, "{picott} is better than the best, {least}, for {light:?}, {r}");
        let degrees = |cosine: f64| (1.0 - cosine * cosine).max(0.0).sqrt().atan2(cosine).to_degrees();
        match out {
            0 => assert!(picott == 1.0 && least == 1.0, "r meets the light: {picott}, {least} for {light:?}, {r}"),
            1 => one.add(degrees(picott) - degrees(least)),
            _ => both.add(degrees(picott) - degrees(least)),
        }
    }
    let mean = |excess: &Excess| excess.sum / excess.count;
    println!(
        "one out of range: mean {:.2}, worst {:.1}; both: mean {:.2}, worst {:.1}; none in front {:.3}, of these missed {:.3}",
        mean(&one),
        one.worst,
        mean(&both),
        both.worst,
        misses / 1e5,
        missed / misses
    );
    assert!((mean(&one) - 4.4).abs() < 0.1 && (70.0..80.0).contains(&one.worst), "one out of range: {one:?}");
    assert!((mean(&both) - 1.6).abs() < 0.1 && (45.0..55.0).contains(&both.worst), "both out of range: {both:?}");
    assert!((missed / misses - 0.49).abs() < 0.01, "{missed} of {misses} without a point in front have one");
}
