//! The WGSL of skies and caps against `shading::sky` and `shading::sphere`.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;
use softbox::gpu::twin;
use softbox::gpu::twin::cases::{cap_irradiance_case, cap_phong_case, sky_irradiance_case, sky_phong_case};
use softbox::light::{CapEmitter, SkyEmitter};

use crate::cases;
use crate::twins::{Random, check};

fn sky(case: &cases::Case) -> SkyEmitter {
    let (uniform, cosine) = match case.text("kind") {
        "const" => (1.0, 0.0),
        "cos" => (0.0, 1.0),
        _ => (1.0 / 3.0, 2.0 / 3.0),
    };
    SkyEmitter { zenith: case.direction("L"), uniform, cosine }
}

fn random_sky(random: &mut Random) -> SkyEmitter {
    SkyEmitter { zenith: random.direction(), uniform: random.within(0.0, 1.0), cosine: random.within(0.0, 1.0) }
}

fn cap(case: &cases::Case) -> CapEmitter {
    CapEmitter { to_center: case.direction("L"), half_angle: case.number("sigma") }
}

fn random_cap(random: &mut Random) -> CapEmitter {
    CapEmitter { to_center: random.direction(), half_angle: random.magnitude(1e-3, FRAC_PI_2) }
}

/// An axis, or one that is hardly another.
fn beside(axis: DVec3, random: &mut Random) -> DVec3 {
    match random.bits() % 4 {
        0 => (axis + random.magnitude(1e-9, 1e-3) * random.direction()).normalize(),
        1 => axis,
        _ => random.direction(),
    }
}

#[test]
fn irradiance_of_a_sky_matches() {
    let mut random = Random(71);
    let reference = cases::load("hemi_lambert");
    let reference = reference.iter().map(|case| sky_irradiance_case(&sky(case), case.direction("N")));
    let random = (0..2000).map(|_| sky_irradiance_case(&random_sky(&mut random), random.direction()));
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::SKY_IRRADIANCE, ("sky.y * falling", "1.001 * sky.y * falling"), &cases);
}

#[test]
fn phong_integral_of_a_sky_matches() {
    let mut random = Random(72);
    let reference = cases::load("hemi_phong");
    let reference = reference.iter().map(|case| {
        let r = case.direction("R");
        sky_phong_case(&sky(case), r, r, case.number("n"))
    });
    let random = (0..4000).map(|_| {
        let (light, n) = (random_sky(&mut random), random.direction());
        let n = if random.bits().is_multiple_of(2) { n } else { beside(light.zenith, &mut random) };
        let r = beside(n, &mut random);
        sky_phong_case(&light, n, r, random.exponent())
    });
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::SKY_PHONG, ("(m + 1.0) / (m + 2.0)", "(m + 1.01) / (m + 2.0)"), &cases);
    check(&twin::SKY_PHONG, ("gamma * missing", "1.001 * gamma * missing"), &cases);
}

#[test]
fn irradiance_of_a_cap_matches() {
    let mut random = Random(73);
    let reference = cases::load("subhemi_lambert");
    let reference = reference.iter().map(|case| cap_irradiance_case(&cap(case), case.direction("N")));
    let random = (0..2000).map(|_| cap_irradiance_case(&random_cap(&mut random), random.direction()));
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::CAP_IRRADIANCE, ("square * beta", "square * beta * 1.001"), &cases);
}

#[test]
fn phong_integral_of_a_cap_matches() {
    let mut random = Random(74);
    let reference = cases::load("subhemi_phong");
    let reference = reference.iter().map(|case| {
        let r = case.direction("R");
        cap_phong_case(&cap(case), r, r, case.number("n"))
    });
    let random = (0..4000).map(|_| {
        let (light, n) = (random_cap(&mut random), random.direction());
        cap_phong_case(&light, n, random.direction(), random.exponent())
    });
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::CAP_PHONG, ("0.5 * b.power", "0.501 * b.power"), &cases);
}
