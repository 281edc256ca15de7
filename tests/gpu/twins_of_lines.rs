//! The WGSL of linear lights against `shading::line`.

use glam::DVec3;
use softbox::gpu::twin::cases::{Case, line_irradiance_case, line_phong_case, line_scale};
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
        let light = LineEmitter { a, b, falloff: rounded_number(falloff) };
        Self { light, n: rounded(case.direction("N")), r: rounded(case.direction(r)), m: rounded_number(m) }
    }

    /// Short and long, near and far.
    fn random(random: &mut Random, falloffs: &[f64]) -> Self {
        let a = random.point(2.0) * random.magnitude(1e-2, 10.0);
        let b = a + random.direction() * random.magnitude(1e-3, 10.0);
        let falloff = falloffs[usize::try_from(random.bits() % falloffs.len() as u64).expect("a short list")];
        let light = LineEmitter { a: rounded(a), b: rounded(b), falloff };
        Self { light, n: random.direction(), r: random.direction(), m: random.exponent() }
    }

    /// Not seen end on, where rounding decides which end is nearer to r and in which plane the lobe is fitted; nor
    /// longer than 1000 times its distance, which f32 knows to 1e-4 only.
    fn is_plain(&self) -> bool {
        let LineEmitter { a, b, .. } = self.light;
        let distance = a.cross(b).length() / a.distance(b);
        distance > 1e-5 * a.length().min(b.length()) && distance > 1e-3 * a.distance(b)
    }

    fn row(&self) -> Row {
        Row::default().vector(self.light.a).vector(self.light.b).vector(self.n)
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

    fn chebyshev(&self) -> Case {
        let lobe = PhongLobe::new(self.m);
        let expected = self.specular(Method::Chebyshev, &lobe) / lobe.normalisation();
        Case {
            row: self.row().vector(self.r).number(self.light.falloff).lobe(lobe),
            expected,
            scale: line_scale(&self.light),
        }
    }

    fn nearest_point(&self) -> Case {
        let lobe = PhongLobe::new(self.m);
        Case {
            row: self.row().vector(self.r).number(self.m).number(self.light.falloff),
            expected: self.specular(Method::NearestPoint, &lobe),
            scale: line_scale(&self.light) * lobe.normalisation(),
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
    check(&twin::LINE_IRRADIANCE, ("/ ends.r_a +", "/ ends.r_b +"), &cases);
}

#[test]
fn phong_integral_of_a_line_matches() {
    let cases: Vec<_> = phong_inputs(12).iter().map(Inputs::phong).collect();
    check(&twin::LINE_PHONG, ("sqrt(32.0 / m)", "sqrt(8.0 / m)"), &cases);
}

#[test]
fn chebyshev_fit_along_a_line_matches() {
    let cases: Vec<_> = phong_inputs(13).iter().filter(|inputs| inputs.is_plain()).map(Inputs::chebyshev).collect();
    check(&twin::LINE_CHEBYSHEV, ("0.65214515486254614263", "0.6531"), &cases);
}

#[test]
fn nearest_point_of_a_line_matches() {
    let cases: Vec<_> = phong_inputs(14).iter().filter(|inputs| inputs.is_plain()).map(Inputs::nearest_point).collect();
    check(&twin::LINE_NEAREST_POINT, ("if base > 0.0", "if base < 0.0"), &cases);
}
