//! The WGSL of linear lights against `shading::line`.

use glam::DVec3;
use softbox::gpu::twin::cases::{Case, line_irradiance_case, line_phong_case, line_row, line_scale};
use softbox::gpu::twin::{self, Row, rounded, rounded_number};
use softbox::light::LineEmitter;
use softbox::shading::line::respond;
use softbox::shading::{Method, PhongLobe, ShadingPoint};

use crate::cases;
use crate::twins::{Random, check};

/// A line about p, and what looks at it; rounded to f32.
struct Inputs {
    light: LineEmitter,
    n: DVec3,
    r: DVec3,
    m: f64,
}

impl Inputs {
    fn of_reference(case: &cases::Case, falloff: f64, r: &str, m: f64) -> Self {
        let [a, b] = ["A", "B"].map(|end| rounded(case.vector(end) - case.vector("p")));
        let light = LineEmitter { a, b, falloff: rounded_number(falloff), tube: None };
        Self { light, n: rounded(case.direction("N")), r: rounded(case.direction(r)), m: rounded_number(m) }
    }

    /// Short and long, near and far.
    fn random(random: &mut Random, falloffs: &[f64]) -> Self {
        let a = random.point(2.0) * random.magnitude(1e-2, 10.0);
        let b = a + random.direction() * random.magnitude(1e-3, 10.0);
        let falloff = falloffs[usize::try_from(random.bits() % falloffs.len() as u64).expect("a short list")];
        let tube = (random.bits().is_multiple_of(3)).then(|| random.magnitude(1e-3, 1e-1));
        let light = LineEmitter { a: rounded(a), b: rounded(b), falloff, tube };
        Self { light, n: random.direction(), r: random.direction(), m: random.exponent() }
    }

    fn row(&self) -> Row {
        line_row(&self.light, self.n)
    }

    fn irradiance(&self) -> Case {
        line_irradiance_case(&self.light, DVec3::ZERO, self.n)
    }

    fn phong(&self) -> Case {
        line_phong_case(&self.light, DVec3::ZERO, self.n, self.r, self.m)
    }

    /// The specular response by a method.
    fn specular(&self, method: Method, lobe: &PhongLobe) -> f64 {
        // The eye whose mirror direction is r, though n is only nearly unit.
        let (n, r) = (self.n, self.r);
        let v = 2.0 * n.dot(r) / (2.0 * n.length_squared() - 1.0) * n - r;
        respond(&self.light, method, &ShadingPoint { p: DVec3::ZERO, n, v }, lobe).specular
    }

    fn chebyshev(&self, method: Method) -> Case {
        let lobe = PhongLobe::new(self.m);
        let expected = self.specular(method, &lobe) / lobe.normalisation();
        Case { row: self.row().vector(self.r).lobe(lobe).method(method), expected, scale: line_scale(&self.light) }
    }

    fn nearest_point(&self) -> Case {
        let lobe = PhongLobe::new(self.m);
        Case {
            expected: self.specular(Method::NearestPoint, &lobe),
            scale: line_scale(&self.light) * lobe.normalisation(),
            row: self.row().vector(self.r).lobe(lobe),
        }
    }
}

const FALLOFFS: &[f64] = &[2.0, 2.0, 0.0, 1.0, 3.0, 1.5];

fn phong_inputs(seed: u64) -> Vec<Inputs> {
    let mut random = Random(seed);
    let reference = cases::load("linear_phong");
    let reference = reference.iter().map(|case| Inputs::of_reference(case, 2.0, "R", case.number("n")));
    reference.chain((0..2000).map(|_| Inputs::random(&mut random, FALLOFFS))).collect()
}

#[test]
fn irradiance_of_a_line_matches() {
    let mut random = Random(11);
    let reference = cases::load("linear_diffuse");
    let reference = reference.iter().map(|case| Inputs::of_reference(case, case.number("decay"), "N", 1.0));
    let inputs = reference.chain((0..4000).map(|_| Inputs::random(&mut random, FALLOFFS)));
    let cases: Vec<_> = inputs.map(|inputs| inputs.irradiance()).collect();
    check(&twin::LINE_IRRADIANCE, ("0.0) * r_b", "0.0) * r_a"), &cases);
}

#[test]
fn phong_integral_of_a_line_matches() {
    let cases: Vec<_> = phong_inputs(12).iter().map(Inputs::phong).collect();
    check(&twin::LINE_PHONG, ("c.z + x * c.w", "c.z + 1.3 * x * c.w"), &cases);
}

#[test]
fn chebyshev_fits_along_a_line_match() {
    let fits = [(6, 256), (6, 256), (3, 64), (7, 1024), (12, 65536)];
    let fits = fits.map(|(degree, levels)| Method::Chebyshev { degree, levels });
    let inputs = phong_inputs(13);
    let cases: Vec<_> = inputs.iter().zip(fits.iter().cycle()).map(|(inputs, fit)| inputs.chebyshev(*fit)).collect();
    check(&twin::LINE_CHEBYSHEV, ("2.0 * min(abs(t), 1.0)", "2.001 * min(abs(t), 1.0)"), &cases);
}

#[test]
fn nearest_point_of_a_line_matches() {
    let cases: Vec<_> = phong_inputs(14).iter().map(Inputs::nearest_point).collect();
    check(&twin::LINE_NEAREST_POINT, ("base > 0.0 && line.a", "base < 0.0 && line.a"), &cases);
}
