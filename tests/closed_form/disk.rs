//! Disk lights.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use softbox::light::DiskEmitter;
use softbox::math::quadrature::Estimate;
use softbox::shading::disk::{disk_irradiance, disk_phong, disk_phong_lobe_only, disk_solid_angle};
use softbox::shading::reference::{Kernel, disk_reference};

use super::cases::{Case, Worst, load};
use super::random::Random;

fn disk(case: &Case) -> DiskEmitter {
    DiskEmitter {
        center: case.vector("center"),
        normal: case.direction("light_normal"),
        radius: case.number("radius"),
        two_sided: true,
    }
}

#[test]
fn irradiance_of_a_disk_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("disk_diffuse") {
        let (light, p) = (disk(&case), case.vector("p"));
        let scale = disk_solid_angle(&light, p).min(PI);
        worst.check(&case, disk_irradiance(&light, p, case.direction("N")), case.value("expected"), scale);
    }
    worst.finish("disk_diffuse", 5e-14, 1e-13);
}

#[test]
fn phong_integral_of_a_disk_matches_the_reference() {
    let mut worst = Worst::default();
    for case in load("disk_phong") {
        let (light, p, m) = (disk(&case), case.vector("p"), case.number("n"));
        let normalisation = TAU / (m + 1.0);
        let scale = disk_solid_angle(&light, p).min(normalisation);
        let x = normalisation * disk_phong_lobe_only(&light, p, case.direction("R"), m);
        worst.check(&case, x, case.value("expected"), scale);
    }
    worst.finish("disk_phong", 5e-13, 2e-11);
}

/// A disk and a point near and far, in its plane's neighbourhood, above its rim and close to its axis.
fn random_view(random: &mut Random) -> (DiskEmitter, DVec3) {
    let normal = random.direction();
    let light = DiskEmitter { center: random.point(1.0), normal, radius: random.magnitude(0.01, 3.0), two_sided: true };
    let across = normal.any_orthonormal_vector();
    let height = random.magnitude(1e-4, 10.0) * light.radius;
    let aside = match random.within(0.0, 3.0) {
        kind if kind < 1.0 => random.within(0.0, 2.0),
        kind if kind < 2.0 => 1.0 + random.magnitude(1e-4, 1.0) * if kind < 1.5 { -0.99 } else { 1.0 },
        _ => random.magnitude(1e-3, 100.0),
    };
    (light, light.center + height * normal + aside * light.radius * across)
}

#[test]
fn disks_clipped_by_both_horizons_match_the_reference_quadrature() {
    let mut random = Random::new(41);
    let mut worst = [0.0_f64; 2];
    for case in 0..400 {
        let (light, p) = random_view(&mut random);
        let solid_angle = disk_solid_angle(&light, p);
        let (n, mut r) = (random.direction(), random.direction());
        if random.within(0.0, 1.0) < 0.5 {
            // A lobe that looks at the light.
            r = (light.center + light.radius * random.point(1.0) - p).normalize();
        }
        let m = if random.within(0.0, 1.0) < 0.5 {
            random.magnitude(1.0, 1000.0)
        } else {
            random.within(1.0, 50.0).floor()
        };
        let pairs = [
            (disk_irradiance(&light, p, n), disk_reference(&light, p, &Kernel::cosine(n)), solid_angle.min(PI)),
            (
                disk_phong(&light, p, n, r, m),
                disk_reference(&light, p, &Kernel::lobe(r, m, n)) * ((m + 1.0) / TAU),
                ((m + 1.0) / TAU * solid_angle).min(1.0),
            ),
        ];
        for (part, (x, Estimate { value, error }, scale)) in pairs.into_iter().enumerate() {
            let off = (x - value).abs();
            assert!(
                off <= error + 1e-12 * scale + 1e-10 * value,
                "{case}, part {part}: {x:e} for {value:e} ± {error:e}, off {off:e}, scale {scale:e}: {light:?} {p} {n} {r} {m}"
            );
            worst[part] = worst[part].max((off - error).max(0.0) / scale);
        }
    }
    println!("beyond the reference's bound, of the scale: {worst:?}");
}
