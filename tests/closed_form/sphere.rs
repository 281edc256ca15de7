//! Spherical lights and caps.

use std::f64::consts::{PI, TAU};

use softbox::light::SphereEmitter;
use softbox::shading::sphere::{Cap, cap_irradiance, cap_phong_lobe_only};

use super::cases::{Case, Worst, load};

fn sphere_cap(case: &Case) -> Cap {
    let light = SphereEmitter { center: case.vector("center"), radius: case.number("radius") };
    Cap::of_sphere(&light, case.vector("p"), case.vector("p"))
}

fn cap(case: &Case) -> Cap {
    Cap::new(case.direction("L"), case.number("sigma"))
}

#[track_caller]
fn check_irradiance(model: &str, of_scale: f64, cap_of: impl Fn(&Case) -> Cap) {
    let mut worst = Worst::default();
    for case in load(model) {
        let cap = cap_of(&case);
        let scale = (cap.solid_angle() / PI).min(1.0);
        worst.check(&case, cap_irradiance(&cap, case.direction("N")) / PI, case.value("expected"), scale);
    }
    worst.finish(model, of_scale, 2e-11);
}

#[track_caller]
fn check_phong(model: &str, cap_of: impl Fn(&Case) -> Cap) {
    let mut worst = Worst::default();
    for case in load(model) {
        let cap = cap_of(&case);
        let m = case.number("n");
        let scale = ((m + 1.0) / TAU * cap.solid_angle()).min(1.0);
        worst.check(&case, cap_phong_lobe_only(&cap, case.direction("R"), m), case.value("expected"), scale);
    }
    worst.finish(model, 5e-14, 1e-10);
}

#[test]
fn irradiance_of_a_sphere_matches_the_reference() {
    check_irradiance("sphere_lambert", 1e-13, sphere_cap);
}

#[test]
fn irradiance_of_a_cap_matches_the_reference() {
    check_irradiance("subhemi_lambert", 1e-15, cap);
}

#[test]
fn phong_integral_of_a_sphere_matches_the_reference() {
    check_phong("sphere_phong", sphere_cap);
}

#[test]
fn phong_integral_of_a_cap_matches_the_reference() {
    check_phong("subhemi_phong", cap);
}
