//! Linear lights.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use softbox::light::{Emitter, LineEmitter};
use softbox::math::angle::angle_between;
use softbox::math::special::refined_panels;
use softbox::shading::line::{LineFrame, line_irradiance, line_phong, line_phong_lobe_only, respond};
use softbox::shading::reference::reference;
use softbox::shading::{Method, PhongLobe, ShadingPoint};

use super::cases::{Case, Worst, load};
use super::random::Random;

fn light(case: &Case, falloff: f64) -> LineEmitter {
    LineEmitter { a: case.vector("A"), b: case.vector("B"), falloff, tube: None }
}

/// |B−A|/dᶠ, d the least distance from p.
fn scale(case: &Case, falloff: f64) -> f64 {
    let (a, b) = (case.vector("A") - case.vector("p"), case.vector("B") - case.vector("p"));
    let along = b - a;
    let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    along.length() / (a + t * along).length().powf(falloff)
}

#[test]
fn line_irradiance_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("linear_diffuse") {
        let falloff = case.number("decay");
        let x = line_irradiance(&light(&case, falloff), case.vector("p"), case.direction("N"));
        worst.check(&case, x, case.value("expected"), scale(&case, falloff));
    }
    worst.finish("line irradiance", 2e-15, 5e-14);
}

#[test]
fn line_phong_matches_the_reference() {
    let [mut lobe_only, mut clipped] = [Worst::default(), Worst::default()];
    for case in load("linear_phong") {
        let (light, m, scale) = (light(&case, 2.0), case.number("n"), scale(&case, 2.0));
        let (p, n, r) = (case.vector("p"), case.direction("N"), case.direction("R"));
        lobe_only.check(&case, line_phong_lobe_only(&light, p, r, m), case.value("expected"), scale);
        clipped.check(&case, line_phong(&light, p, n, r, m), case.value("expected_nclip"), scale);
    }
    lobe_only.finish("line phong, lobe only", 1e-14, 2e-12);
    clipped.finish("line phong", 1e-14, 2e-12);
}

/// A line, and normal and mirror direction at the origin.
fn random_view(random: &mut Random) -> (LineEmitter, DVec3, DVec3) {
    let light = LineEmitter { a: random.point(2.0), b: random.point(2.0), falloff: 2.0, tube: None };
    (light, random.direction(), random.direction())
}

#[test]
fn nearest_point_is_never_behind_a_scan() {
    let mut random = Random::new(31);
    for _ in 0..2000 {
        let (light, _, r) = random_view(&mut random);
        let Some(line) = LineFrame::new(&light, DVec3::ZERO) else { continue };
        let cos = |x: DVec3| x.normalize().dot(r);
        let scanned = (0..=2000).map(|i| cos(light.a.lerp(light.b, f64::from(i) / 2000.0)));
        let best = scanned.fold(f64::NEG_INFINITY, f64::max);
        let nearest = cos(line.nearest(r));
        assert!(nearest >= best - 1e-6 * best.abs(), "{nearest} behind {best} for {light:?}, {r}");
    }
}

#[test]
fn chebyshev_is_within_the_papers_bound() {
    let mut random = Random::new(32);
    let mut worst = 0.0_f64;
    for _ in 0..5000 {
        let (light, n, r) = random_view(&mut random);
        let lobe = PhongLobe::new(random.magnitude(1.0, 1000.0));
        let v = 2.0 * n.dot(r) * n - r;
        let at = ShadingPoint { p: DVec3::ZERO, n, v };
        let [exact, fit] =
            [Method::Exact, Method::CHEBYSHEV].map(|method| respond(&light, method, &at, &lobe).specular);
        let (a, b) = (light.a, light.b);
        let seen = angle_between(a, b) * light.length() / a.cross(b).length();
        worst = worst.max((fit - exact).abs() / (lobe.normalisation() * seen));
    }
    println!("chebyshev: {worst:.5} of ∫ds/r²");
    assert!(worst <= 0.001, "{worst} of ∫ds/r²");
}

/// A tube 2 cm thick, near or far, short or long.
fn random_tube(random: &mut Random) -> LineEmitter {
    let middle = random.direction() * random.magnitude(0.05, 50.0);
    let half = 0.5 * random.direction() * random.magnitude(0.01, 20.0);
    LineEmitter { a: middle - half, b: middle + half, falloff: 2.0, tube: Some(0.01) }
}

#[test]
fn tubes_match_quadrature_of_their_definition() {
    let mut random = Random::new(33);
    let mut worst = [0.0_f64; 2];
    for _ in 0..2000 {
        let light = random_tube(&mut random);
        let (n, r, m) = (random.direction(), random.direction(), random.magnitude(1.0, 1000.0));
        let (length, axis) = (light.length(), (light.b - light.a).normalize());
        let foot = light.a - light.a.dot(axis) * axis;
        let (d, from) = (foot.length(), light.a.dot(axis));
        let least = (foot + 0.0_f64.clamp(from, from + length) * axis).length();
        if least < 1e-2 {
            continue;
        }
        let scale = 2.0 * 0.01 * length / (least * least);
        // Along the line by s = d sinh u, where the distance is d cosh u, from horizon to horizon.
        let crossing = |v: DVec3| (-v.dot(foot) / (v.dot(axis) * d)).asinh();
        let (first, last) = ((from / d).asinh(), ((from + length) / d).asinh());
        let mut breaks = [first, last, crossing(n).clamp(first, last), crossing(r).clamp(first, last)];
        breaks.sort_by(f64::total_cmp);
        let integrate = |f: &dyn Fn(DVec3) -> f64| {
            let place = |u: f64| foot + d * u.sinh() * axis;
            let g = |u: f64| 2.0 * 0.01 * f(place(u).normalize()) / (d * u.cosh().powi(2));
            breaks.windows(2).map(|ends| refined_panels(ends[0], ends[1], 0.1, 1e-16 * scale, g)).sum::<f64>()
        };
        let irradiance = integrate(&|w| n.dot(w).max(0.0));
        let specular = integrate(&|w| if n.dot(w) > 0.0 { r.dot(w).max(0.0).powf(m) } else { 0.0 });
        let x = [line_irradiance(&light, DVec3::ZERO, n), line_phong(&light, DVec3::ZERO, n, r, m)];
        for (worst, (x, y)) in worst.iter_mut().zip(x.into_iter().zip([irradiance, specular])) {
            *worst = worst.max((x - y).abs() / scale);
        }
    }
    println!("tubes: irradiance {:.1e}, specular {:.1e} of 2ϱ|B−A|/d²", worst[0], worst[1]);
    assert!(worst[0] <= 3e-13 && worst[1] <= 3e-13, "{worst:?} of 2ϱ|B−A|/d²");
}

#[test]
fn tubes_lie_in_the_band_of_the_reference() {
    let mut random = Random::new(34);
    for _ in 0..300 {
        let (light, lobe) = (random_tube(&mut random), PhongLobe::new(random.magnitude(1.0, 1000.0)));
        let at = ShadingPoint { p: DVec3::ZERO, n: random.direction(), v: random.direction() };
        let exact = respond(&light, Method::Exact, &at, &lobe);
        let band = reference(&Emitter::Line(light), &at, &lobe);
        for (x, band) in [(exact.irradiance, band.irradiance), (exact.specular, band.specular)] {
            let off = (x - band.value).abs();
            assert!(off <= band.error + 1e-10 * x + 1e-16, "{x:e} is {off:e} off {band:?} for {light:?} {at:?}");
        }
    }
}

#[test]
fn a_tube_sends_out_its_flux_and_an_endless_one_gives_pi_radius_over_distance() {
    let tube = |half: f64| LineEmitter { a: -half * DVec3::X, b: half * DVec3::X, falloff: 2.0, tube: Some(0.01) };
    // Over a sphere about it, by the middles of latitudes about its axis.
    let (radius, rings) = (50.0, 4000);
    let ring = |i: i32| {
        let (sin, cos) = (PI * (f64::from(i) + 0.5) / f64::from(rings)).sin_cos();
        let n = DVec3::new(cos, sin, 0.0);
        line_irradiance(&tube(1.0), radius * n, -n) * sin
    };
    let flux = TAU * radius * radius * PI / f64::from(rings) * (0..rings).map(ring).sum::<f64>();
    let expected = PI * TAU * 0.01 * 2.0;
    assert!((flux / expected - 1.0).abs() < 1e-6, "{flux} of {expected} lm");
    let endless = line_irradiance(&tube(1e6), DVec3::new(0.0, 0.0, -0.5), DVec3::Z);
    assert!((endless / (PI * 0.01 / 0.5) - 1.0).abs() < 1e-12, "{endless}");
}

#[test]
fn a_tube_seen_end_on_is_dark() {
    let light = LineEmitter { a: DVec3::X, b: 2.0 * DVec3::X, falloff: 2.0, tube: Some(0.01) };
    for method in [Method::Exact, Method::CHEBYSHEV, Method::NearestPoint, Method::Point, Method::PointCluster(16)] {
        let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::X, v: DVec3::X };
        let response = respond(&light, method, &at, &PhongLobe::new(20.5));
        assert_eq!((response.irradiance, response.specular), (0.0, 0.0), "{method}");
    }
}
