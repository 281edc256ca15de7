//! The WGSL of spherical lights against `shading::sphere`.

use glam::DVec3;
use softbox::gpu::twin::cases::{Case, lobe_scale, sphere_irradiance_case, sphere_phong_case, sphere_solid_angle};
use softbox::gpu::twin::{self, Row, rounded, rounded_number};
use softbox::light::SphereEmitter;
use softbox::shading::cluster::sphere_cluster;
use softbox::shading::sphere::{Cap, cap_irradiance_hermite_1, cap_irradiance_hermite_2};
use softbox::shading::{PhongLobe, ShadingPoint};

use crate::cases;
use crate::twins::{Random, check};

/// A sphere about p, and what looks at it; rounded to f32.
struct Inputs {
    light: SphereEmitter,
    n: DVec3,
    r: DVec3,
    m: f64,
}

impl Inputs {
    fn of_reference(case: &cases::Case, axis: &str, m: f64) -> Self {
        let light = SphereEmitter {
            center: rounded(case.vector("center") - case.vector("p")),
            radius: rounded_number(case.number("radius")),
        };
        let axis = rounded(case.direction(axis));
        Self { light, n: axis, r: axis, m: rounded_number(m) }
    }

    /// Near and far, large and small, about p too.
    fn random(random: &mut Random) -> Self {
        let center = rounded(random.point(3.0));
        let light = SphereEmitter { center, radius: random.magnitude(1e-3, 5.0) };
        let inputs = Self { light, n: random.direction(), r: random.direction(), m: random.exponent() };
        if inputs.is_plain() { inputs } else { Self::random(random) }
    }

    /// p is in or out of the sphere as far as f32 knows; there is a step.
    fn is_plain(&self) -> bool {
        (self.light.center.length() / self.light.radius - 1.0).abs() > 1e-6
    }

    fn cap(&self) -> Cap {
        Cap::of_sphere(&self.light, DVec3::ZERO, self.n())
    }

    /// As the shader sees it: of length 1.
    fn n(&self) -> DVec3 {
        self.n.normalize()
    }

    fn r(&self) -> DVec3 {
        self.r.normalize()
    }

    fn row(&self) -> Row {
        Row::default().vector(self.light.center).number(self.light.radius)
    }

    fn irradiance(&self) -> Case {
        sphere_irradiance_case(&self.light, DVec3::ZERO, self.n)
    }

    fn phong(&self) -> Case {
        sphere_phong_case(&self.light, DVec3::ZERO, self.n, self.r, self.m)
    }

    /// A fit on the inputs of the irradiance.
    fn fit(&self, fit: impl Fn(&Cap, DVec3) -> f64) -> Case {
        Case { expected: fit(&self.cap(), self.n()), ..self.irradiance() }
    }

    fn cluster(&self, count: u32) -> Case {
        let (n, r) = (self.n(), self.r());
        let at = ShadingPoint { p: DVec3::ZERO, n, v: 2.0 * n.dot(r) * n - r };
        let lobe = PhongLobe::new(self.m);
        let expected = sphere_cluster(&self.light, count, &at, &lobe).specular;
        let row = self.row().number(count.into()).vector(self.n).vector(self.r).lobe(lobe);
        Case { row, expected, scale: lobe_scale(sphere_solid_angle(&self.light), self.m) }
    }
}

fn irradiance_inputs(seed: u64) -> Vec<Inputs> {
    let mut random = Random(seed);
    let reference = cases::load("sphere_lambert");
    let reference = reference.iter().map(|case| Inputs::of_reference(case, "N", 1.0));
    reference.chain((0..4000).map(|_| Inputs::random(&mut random))).collect()
}

#[test]
fn irradiance_of_a_sphere_matches() {
    let cases: Vec<_> = irradiance_inputs(21).iter().map(Inputs::irradiance).collect();
    check(&twin::SPHERE_IRRADIANCE, ("square * beta", "square * beta * 1.001"), &cases);
}

#[test]
fn hermite_fits_match() {
    let one = |inputs: &Inputs| inputs.fit(cap_irradiance_hermite_1);
    let cases: Vec<_> = irradiance_inputs(22).iter().map(one).collect();
    check(&twin::SPHERE_IRRADIANCE_HERMITE_1, ("3.0 * rise", "3.01 * rise"), &cases);
    let two = |inputs: &Inputs| inputs.fit(cap_irradiance_hermite_2);
    let cases: Vec<_> = irradiance_inputs(23).iter().map(two).collect();
    check(&twin::SPHERE_IRRADIANCE_HERMITE_2, ("3.0 * rise", "3.01 * rise"), &cases);
}

#[test]
fn phong_integral_of_a_sphere_matches() {
    let mut random = Random(24);
    let reference = cases::load("sphere_phong");
    let reference = reference.iter().map(|case| Inputs::of_reference(case, "R", case.number("n")));
    let inputs = reference.chain((0..4000).map(|_| Inputs::random(&mut random)));
    let cases: Vec<_> = inputs.map(|inputs| inputs.phong()).collect();
    check(&twin::SPHERE_PHONG, ("0.5 * b.power", "0.501 * b.power"), &cases);
}

#[test]
fn cluster_of_a_sphere_matches() {
    let mut random = Random(25);
    let cases: Vec<_> = (0..2000).map(|i| Inputs::random(&mut random).cluster(2 + i % 64)).collect();
    check(&twin::SPHERE_CLUSTER, ("f32(i) + 0.5", "f32(i) + 0.51"), &cases);
}
