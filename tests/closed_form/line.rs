//! Linear lights.

use glam::DVec3;
use softbox::light::LineEmitter;
use softbox::math::angle::angle_between;
use softbox::shading::line::{LineFrame, line_irradiance, line_phong, line_phong_lobe_only, respond};
use softbox::shading::{Method, PhongLobe, ShadingPoint};

use super::cases::{Case, Worst, load};
use super::random::Random;

fn light(case: &Case, falloff: f64) -> LineEmitter {
    LineEmitter { a: case.vector("A"), b: case.vector("B"), falloff }
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
    let light = LineEmitter { a: random.point(2.0), b: random.point(2.0), falloff: 2.0 };
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
        assert!(nearest >= best - 1e-14, "{nearest} behind {best} for {light:?}, {r}");
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
            [Method::Exact, Method::Chebyshev].map(|method| respond(&light, method, &at, &lobe).specular);
        let (a, b) = (light.a, light.b);
        let seen = angle_between(a, b) * light.length() / a.cross(b).length();
        worst = worst.max((fit - exact).abs() / (lobe.normalisation() * seen));
    }
    println!("chebyshev: {worst:.5} of ∫ds/r²");
    assert!(worst <= 0.001, "{worst} of ∫ds/r²");
}
