//! Skies.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::light::SkyEmitter;
use softbox::math::quadrature::Estimate;
use softbox::shading::reference::{Kernel, sky_reference};
use softbox::shading::sky::{sky_irradiance, sky_phong, sky_phong_lobe_only};
use softbox::shading::sphere::{Cap, cap_phong};

use super::cases::{Case, Worst, load};
use super::random::Random;

fn sky(case: &Case) -> SkyEmitter {
    let (uniform, cosine) = match case.text("kind") {
        "const" => (1.0, 0.0),
        "cos" => (0.0, 1.0),
        "cie" => (1.0 / 3.0, 2.0 / 3.0),
        kind => panic!("no sky is `{kind}`"),
    };
    SkyEmitter { zenith: case.direction("L"), uniform, cosine }
}

#[test]
fn irradiance_of_a_sky_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("hemi_lambert") {
        let x = sky_irradiance(&sky(&case), case.direction("N")) / PI;
        worst.check(&case, x, case.value("expected"), 1.0);
    }
    worst.finish("hemi_lambert", 1e-15, 1e-10);
}

#[test]
fn phong_integral_of_a_sky_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("hemi_phong") {
        let x = sky_phong_lobe_only(&sky(&case), case.direction("R"), case.number("n"));
        worst.check(&case, x, case.value("expected"), 1.0);
    }
    worst.finish("hemi_phong", 1e-14, 1e-10);
}

fn random_sky(random: &mut Random) -> SkyEmitter {
    SkyEmitter { zenith: random.direction(), uniform: random.within(0.0, 1.0), cosine: random.within(0.0, 1.0) }
}

#[test]
fn skies_clipped_by_all_three_horizons_match_the_reference_quadrature() {
    let mut random = Random::new(51);
    let mut worst = 0.0_f64;
    for case in 0..400 {
        let (light, n, r) = (random_sky(&mut random), random.direction(), random.direction());
        let m = if case % 2 == 0 { random.magnitude(1.0, 1000.0) } else { random.within(1.0, 50.0).floor() };
        let Estimate { value, error } = sky_reference(&light, &Kernel::lobe(r, m, n)) * ((m + 1.0) / (2.0 * PI));
        let x = sky_phong(&light, n, r, m);
        let off = (x - value).abs();
        assert!(off <= error + 1e-13 + 1e-10 * value, "{case}: {x:e} for {value:e} ± {error:e}: {light:?} {n} {r} {m}");
        worst = worst.max(off - error);
        let Estimate { value, error } = sky_reference(&light, &Kernel::cosine(n));
        let x = sky_irradiance(&light, n);
        assert!((x - value).abs() <= error + 1e-14, "{case}: {x:e} for {value:e} ± {error:e}: {light:?} {n}");
    }
    println!("sky_phong beyond the reference's bound: {worst:e}");
}

#[test]
fn horizons_that_are_one_or_nearly_one_make_no_jump() {
    let mut random = Random::new(52);
    for _ in 0..2000 {
        let (light, r) = (random_sky(&mut random), random.direction());
        let m = random.magnitude(1.0, 1000.0);
        let tilt = random.magnitude(1e-18, 1e-9);
        for axis in [light.zenith, r] {
            let n = (axis + tilt * random.direction()).normalize();
            let [x, exact] = [n, axis].map(|n| sky_phong(&light, n, r, m));
            let slack = 1e-13 + 4.0 * m.sqrt() * tilt;
            assert!((x - exact).abs() <= slack, "{x} beside {exact}: {light:?} {n} {r} {m}");
        }
        let below = -light.zenith + tilt * random.direction();
        let x = sky_phong(&light, below.normalize(), r, m);
        assert!(x <= 1e-13 + m * tilt, "{x} from a surface that faces down");
    }
}

#[test]
fn a_uniform_sky_is_a_cap_of_a_right_angle() {
    let mut random = Random::new(53);
    for _ in 0..2000 {
        let light = SkyEmitter { uniform: 1.0, cosine: 0.0, ..random_sky(&mut random) };
        let (n, r, m) = (random.direction(), random.direction(), random.magnitude(1.0, 1000.0));
        let cap = cap_phong(&Cap::new(light.zenith, 0.5 * PI), n, r, m);
        let x = sky_phong(&light, n, r, m);
        assert!((x - cap).abs() <= 1e-12, "{x} for {cap}: {light:?} {n} {r} {m}");
    }
}

#[test]
fn a_lobe_at_the_zenith_sees_what_the_paper_says() {
    // [SNYDER_1996], eq. (14) and (15) at ω = 0: 1 and (m+1)/(m+2).
    for m in [1.0, 2.0, 7.5, 100.0, 1000.0] {
        let light = SkyEmitter { zenith: DVec3::Z, uniform: 0.25, cosine: 0.5 };
        let expected = 0.25 + 0.5 * (m + 1.0) / (m + 2.0);
        for x in [sky_phong_lobe_only(&light, DVec3::Z, m), sky_phong(&light, DVec3::Z, DVec3::Z, m)] {
            assert!((x - expected).abs() <= 1e-14, "m = {m}: {x} for {expected}");
        }
    }
}
