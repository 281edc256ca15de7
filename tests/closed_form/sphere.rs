//! Spherical lights and caps.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;
use softbox::light::SphereEmitter;
use softbox::math::angle::angle_between;
use softbox::math::special::{cosine_power_integral, refined_panels};
use softbox::shading::sphere::{
    Cap, cap_irradiance, cap_irradiance_hermite_1, cap_irradiance_hermite_2, cap_phong, cap_phong_lobe_only,
    sphere_phong,
};

use super::cases::{Case, Worst, load};
use super::random::Random;

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

/// ∫ zᵐ(m+1)/(2π)·(azimuths in the cap and above n's horizon) dz, z = cos θ, halved until it stands.
fn cap_phong_by_azimuths(direction: DVec3, sigma: f64, n: DVec3, r: DVec3, m: f64) -> f64 {
    let omega = angle_between(direction, r);
    let azimuth = |v: DVec3| {
        let x_axis = (direction - direction.dot(r) * r).normalize();
        v.dot(r.cross(x_axis)).atan2(v.dot(x_axis))
    };
    let half_width = |cos: f64| cos.clamp(-1.0, 1.0).acos();
    let (low, high) = ((omega - sigma).max(0.0), (omega + sigma).min(FRAC_PI_2));
    if low >= high {
        return 0.0;
    }
    let (n_azimuth, n_across) = (azimuth(n), n.cross(r).length());
    refined_panels(low, high, 0.02, 1e-12, |theta| {
        let (rho, z) = theta.sin_cos();
        let cap = half_width((sigma.cos() - z * omega.cos()) / (rho * omega.sin()));
        let above = half_width(-z * n.dot(r) / (rho * n_across));
        let overlap = |turn: f64| ((n_azimuth + turn + above).min(cap) - (n_azimuth + turn - above).max(-cap)).max(0.0);
        (m + 1.0) / TAU
            * z.powf(m)
            * rho
            * (overlap(-TAU) + overlap(0.0) + overlap(TAU)).min(2.0 * cap).min(2.0 * above)
    })
}

#[test]
fn phong_integral_clipped_by_both_horizons_matches_quadrature() {
    let mut random = Random::new(3);
    for case in 0..400 {
        let (direction, n, r) = (random.direction(), random.direction(), random.direction());
        let (sigma, m) = (random.within(0.05, FRAC_PI_2), random.magnitude(1.0, 1000.0));
        let expected = cap_phong_by_azimuths(direction, sigma, n, r, m);
        let x = cap_phong(&Cap::new(direction, sigma), n, r, m);
        assert!((x - expected).abs() <= 1e-9, "{case}: {x} for {expected}: {direction} {sigma} {n} {r} {m}");
    }
}

#[test]
fn phong_integral_of_low_real_exponents_matches_the_recurrence_of_whole_ones() {
    // Exponents 1e-9 beside whole ones take the form for real exponents; I changes by no more than 1e-9 with them.
    let mut random = Random::new(4);
    for _ in 0..300 {
        let (direction, n, r) = (random.direction(), random.direction(), random.direction());
        let cap = Cap::new(direction, random.within(0.01, FRAC_PI_2));
        let m = random.within(1.0, 24.0).floor();
        let (whole, real) = (cap_phong(&cap, n, r, m), cap_phong(&cap, n, r, m + 1e-12));
        assert!((whole - real).abs() <= 2e-12, "{whole} and {real} at m = {m} for {cap:?} {n} {r}");
    }
}

#[test]
fn light_all_around_gives_the_whole_lobe() {
    let light = SphereEmitter { center: DVec3::ZERO, radius: 3.0 };
    for p in [DVec3::ZERO, DVec3::new(1.0, -2.0, 0.5), DVec3::new(0.0, 0.0, 3.0)] {
        let cap = Cap::of_sphere(&light, p, DVec3::X);
        assert!((cap_irradiance(&cap, DVec3::X) - PI).abs() < 1e-14, "irradiance inside at {p}");
        assert!((cap_phong(&cap, DVec3::X, DVec3::X, 12.5) - 1.0).abs() < 1e-14, "specular inside at {p}");
    }
    // Whatever the lobe, all of it that is above the surface: a hemisphere of light, [SNYDER_1996] eq. 14.
    let mut random = Random::new(5);
    for _ in 0..500 {
        let (n, r, m) = (random.direction(), random.direction(), random.magnitude(1.0, 1000.0).floor());
        let omega = angle_between(n, r);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number")]
        let tail = |omega: f64| {
            cosine_power_integral(m as u32, FRAC_PI_2 - omega) / cosine_power_integral(m as u32, FRAC_PI_2)
        };
        let expected = 0.5 + 0.5 * tail(omega);
        let x = sphere_phong(&light, DVec3::ZERO, n, r, m);
        assert!((x - expected).abs() <= 1e-13, "inside: {x} for {expected} at {n} {r} {m}");
    }
}

#[test]
fn hermite_fits_are_as_far_off_as_the_paper_shows() {
    type Fit = fn(&Cap, DVec3) -> f64;
    let fits: [(Fit, [f64; 5]); 2] = [
        (cap_irradiance_hermite_1, [0.0076, 0.0215, 0.034, 0.043, 0.0105]),
        (cap_irradiance_hermite_2, [0.0008, 0.0023, 0.0038, 0.0056, 0.0056]),
    ];
    for (fit, bounds) in fits {
        for (sigma, bound) in [PI / 16.0, PI / 6.0, PI / 4.0, PI / 3.0, FRAC_PI_2].into_iter().zip(bounds) {
            let cap = Cap::new(DVec3::Z, sigma);
            let mut worst = 0.0_f64;
            for i in 0..=2000 {
                let (sin, cos) = (PI * f64::from(i) / 2000.0).sin_cos();
                let n = DVec3::new(sin, 0.0, cos);
                worst = worst.max((fit(&cap, n) - cap_irradiance(&cap, n)).abs() / (PI * sigma.sin().powi(2)));
            }
            println!("σ = {sigma:.3}: {worst:.4}");
            assert!(worst <= bound && worst >= 0.2 * bound, "σ = {sigma}: {worst} of π sin²σ");
        }
    }
}
