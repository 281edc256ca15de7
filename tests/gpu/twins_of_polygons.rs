//! The WGSL of polygonal lights against `shading::polygon`.

use std::f64::consts::{PI, TAU};

use glam::DVec3;
use softbox::gpu::twin::{self, Row, rounded, rounded_number};
use softbox::light::PolygonEmitter;
use softbox::math::angle::angle_between;
use softbox::math::spherical::triangle_solid_angle;
use softbox::shading::polygon::{polygon_irradiance, polygon_least_angle_cosine, polygon_phong};

use crate::cases;
use crate::twins::{Case, Random, check};

/// A polygon about p, and what looks at it; rounded to f32.
struct Inputs {
    light: PolygonEmitter,
    n: DVec3,
    r: DVec3,
    m: f64,
}

impl Inputs {
    fn of_reference(case: &cases::Case, r: &str, m: f64) -> Self {
        let p = case.vector("p");
        let vertices: Vec<_> = case.vectors("vertices").iter().map(|vertex| rounded(*vertex - p)).collect();
        Self::new(vertices, rounded(case.direction("N")), rounded(case.direction(r)), rounded_number(m))
    }

    fn new(vertices: Vec<DVec3>, n: DVec3, r: DVec3, m: f64) -> Self {
        let mut light = PolygonEmitter { vertices, normal: DVec3::ZERO, two_sided: true };
        light.normal = rounded(light.vector_area().normalize_or_zero());
        Self { light, n, r, m }
    }

    /// Convex and not, small and large, near and far.
    fn random(random: &mut Random) -> Self {
        let size = random.magnitude(0.02, 3.0);
        let (x, y) = random.direction().any_orthonormal_pair();
        let center = random.point(2.0);
        let corners = 3 + random.bits() % 6;
        let mut corner = |i| {
            let angle = TAU * (i as f64 + random.within(0.1, 0.9)) / corners as f64;
            rounded(center + size * random.within(0.3, 1.0) * (angle.cos() * x + angle.sin() * y))
        };
        let vertices = (0..corners).map(&mut corner).collect();
        Self::new(vertices, random.direction(), random.direction(), random.exponent())
    }

    fn solid_angle(&self) -> f64 {
        let vertices = &self.light.vertices;
        vertices.windows(2).map(|edge| triangle_solid_angle(vertices[0], edge[0], edge[1])).sum::<f64>().abs()
    }

    /// The solid angle of a square as wide as the light is long, at most a hemisphere: slivers, and lights seen edge on,
    /// are less than f32 resolves in a sum over their edges.
    fn scale(&self) -> f64 {
        let vertices = &self.light.vertices;
        let angles = vertices.iter().flat_map(|a| vertices.iter().map(|b| angle_between(*a, *b)));
        angles.fold(0.0, f64::max).powi(2).max(self.solid_angle()).min(TAU)
    }

    fn irradiance(&self) -> Case {
        let expected = polygon_irradiance(&self.light.vertices, DVec3::ZERO, self.n);
        let row = Row::default().vertices(&self.light.vertices).vector(self.n);
        Case { row, expected, scale: self.scale().min(PI) }
    }

    fn phong(&self) -> Case {
        let expected = polygon_phong(&self.light.vertices, DVec3::ZERO, self.n, self.r, self.m);
        let row = Row::default().vertices(&self.light.vertices).vector(self.n).vector(self.r).number(self.m);
        Case { row, expected, scale: ((self.m + 1.0) / TAU * self.scale()).min(1.0) }
    }

    fn nearest_point(&self) -> Case {
        let cosine = polygon_least_angle_cosine(&self.light, DVec3::ZERO, self.n, self.r);
        let vectors = Row::default().vector(self.light.normal).vector(self.n).vector(self.r);
        Case {
            row: vectors.number(self.m).vertices(&self.light.vertices),
            expected: cosine.map_or(0.0, |cosine| cosine.powf(self.m)),
            scale: 1.0,
        }
    }
}

fn inputs(seed: u64, model: &str) -> Vec<Inputs> {
    let mut random = Random(seed);
    let reference = cases::load(model);
    let lambert = model == "polygon_lambert";
    let reference = reference.iter().map(|case| {
        if lambert { Inputs::of_reference(case, "N", 1.0) } else { Inputs::of_reference(case, "R", case.number("n")) }
    });
    // Not 1e5 times wider than its distance.
    let reference = reference.filter(|inputs| inputs.light.vertices.iter().all(|vertex| vertex.length() < 1e4));
    reference.chain((0..2000).map(|_| Inputs::random(&mut random))).collect()
}

#[test]
fn irradiance_of_a_polygon_matches() {
    let cases: Vec<_> = inputs(21, "polygon_lambert").iter().map(Inputs::irradiance).collect();
    check(&twin::POLYGON_IRRADIANCE, ("return 0.5 * abs(sum)", "return 0.501 * abs(sum)"), &cases);
}

#[test]
fn phong_integral_of_a_polygon_matches() {
    let cases: Vec<_> = inputs(22, "polygon_phong_nclip").iter().map(Inputs::phong).collect();
    check(&twin::POLYGON_PHONG, ("exp(-16.0 / (m + 1.0))", "exp(-2.0 / (m + 1.0))"), &cases);
}

#[test]
fn nearest_point_of_a_polygon_matches() {
    let cases: Vec<_> = inputs(23, "polygon_phong_nclip").iter().map(Inputs::nearest_point).collect();
    check(&twin::POLYGON_NEAREST_POINT, ("rise < bend", "rise > bend"), &cases);
}
