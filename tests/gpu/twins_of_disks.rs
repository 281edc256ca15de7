//! The WGSL of disks against `shading::disk`.

use glam::DVec3;
use softbox::gpu::twin;
use softbox::gpu::twin::cases::{disk_irradiance_case, disk_phong_case};
use softbox::light::DiskEmitter;

use crate::cases;
use crate::twins::{Random, check};

fn reference(model: &str, axis: &str) -> Vec<(DiskEmitter, DVec3, DVec3, f64)> {
    let view = |case: &cases::Case| {
        let light = DiskEmitter {
            center: case.vector("center"),
            normal: case.direction("light_normal"),
            radius: case.number("radius"),
            two_sided: true,
        };
        let m = if axis == "R" { case.number("n") } else { 1.0 };
        (light, case.vector("p"), case.direction(axis), m)
    };
    cases::load(model).iter().map(view).collect()
}

/// Above and beside, large and small; a horizon's place on a disk is known to the rounding of f32 over its angular radius,
/// so that slivers of smaller ones promise less.
fn random_disk(random: &mut Random) -> DiskEmitter {
    let (center, normal) = (random.point(3.0), random.direction());
    let light = DiskEmitter { center, normal, radius: random.magnitude(0.1, 5.0), two_sided: true };
    // In the plane, and on the rim in it, f32 cannot tell the sides.
    let height = center.dot(normal).abs();
    let aside = (center - center.dot(normal) * normal).length();
    let plain = height > 1e-3 * light.radius.max(aside) && (aside - light.radius).hypot(height) > 1e-3 * light.radius;
    if plain { light } else { random_disk(random) }
}

#[test]
fn irradiance_of_a_disk_matches() {
    let mut random = Random(51);
    let reference = reference("disk_diffuse", "N");
    let reference = reference.iter().map(|(light, p, n, _)| disk_irradiance_case(light, *p, *n));
    let random = (0..4000).map(|_| disk_irradiance_case(&random_disk(&mut random), DVec3::ZERO, random.direction()));
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::DISK_IRRADIANCE, ("swept + excess", "swept + 1.01 * excess"), &cases);
    check(&twin::DISK_IRRADIANCE, ("let rest = sin_a", "let rest = 1.001 * sin_a"), &cases);
}

#[test]
fn phong_integral_of_a_disk_matches() {
    let mut random = Random(52);
    let reference = reference("disk_phong", "R");
    let reference = reference.iter().map(|(light, p, r, m)| disk_phong_case(light, *p, *r, *r, *m));
    let random = (0..4000).map(|i| {
        let light = random_disk(&mut random);
        let n = random.direction();
        // Half of the lobes look at the light.
        let r = if i % 2 == 0 {
            random.direction()
        } else {
            (light.center + light.radius * random.direction()).normalize()
        };
        disk_phong_case(&light, DVec3::ZERO, n, r, random.exponent())
    });
    let cases: Vec<_> = reference.chain(random).collect();
    check(&twin::DISK_PHONG, ("0.5 * b.power", "0.501 * b.power"), &cases);
    check(&twin::DISK_PHONG, ("cos_t / z),", "cos_t / z * 1.001),"), &cases);
}
