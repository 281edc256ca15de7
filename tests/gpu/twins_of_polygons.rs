//! The WGSL of polygonal lights against `shading::polygon`.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::gpu::twin::cases::{Case, polygon_irradiance_case, polygon_phong_case};
use softbox::gpu::twin::{self, Row, rounded, rounded_number};
use softbox::light::PolygonEmitter;
use softbox::shading::polygon::{polygon_least_angle_cosine, polygon_projected_edge_cosine};

use crate::cases;
use crate::twins::{Random, check};

/// What finds the nearest point's cosine.
type Rule = fn(&PolygonEmitter, DVec3, DVec3, DVec3) -> Option<f64>;

/// Corners about p, and what looks at them; rounded to f32.
struct Inputs {
    vertices: Vec<DVec3>,
    n: DVec3,
    r: DVec3,
    m: f64,
}

impl Inputs {
    fn of_reference(case: &cases::Case, n: &str, r: &str) -> Self {
        let p = case.vector("p");
        let vertices = case.vectors("vertices").into_iter().map(|vertex| rounded(vertex - p)).collect();
        let m = if r == "R" { rounded_number(case.number("n")) } else { 1.0 };
        Self { vertices, n: rounded(case.direction(n)), r: rounded(case.direction(r)), m }
    }

    /// A star-shaped polygon of three to eight corners, near or far.
    fn random(random: &mut Random) -> Self {
        let normal = random.direction();
        let (u, v) = normal.any_orthonormal_pair();
        let center = random.direction() * random.magnitude(0.1, 20.0);
        let corners = 3 + random.bits() % 6;
        let corner = |i: u64| {
            let angle = 2.0 * PI * i as f64 / corners as f64;
            let radius = random.within(0.2, 1.0);
            rounded(center + radius * (angle.cos() * u + angle.sin() * v))
        };
        let vertices = (0..corners).map(corner).collect();
        Self { vertices, n: random.direction(), r: random.direction(), m: random.exponent() }
    }

    fn irradiance(&self) -> Case {
        polygon_irradiance_case(&self.vertices, DVec3::ZERO, self.n)
    }

    fn phong(&self) -> Case {
        polygon_phong_case(&self.vertices, DVec3::ZERO, self.n, self.r, self.m)
    }

    fn nearest_point(&self, rule: Rule) -> Case {
        let corner = self.vertices[0];
        let doubled: DVec3 = self.vertices.windows(2).map(|edge| (edge[0] - corner).cross(edge[1] - corner)).sum();
        let light =
            PolygonEmitter { vertices: self.vertices.clone(), normal: rounded(doubled.normalize()), two_sided: true };
        let cosine = rule(&light, DVec3::ZERO, self.n.normalize(), self.r.normalize());
        let row = Row::default()
            .vertices(&self.vertices)
            .vector(DVec3::ZERO)
            .vector(light.normal)
            .vector(self.n)
            .vector(self.r);
        Case { row, expected: cosine.unwrap_or(0.0), scale: 1.0 }
    }
}

fn phong_inputs(seed: u64) -> Vec<Inputs> {
    let mut random = Random(seed);
    let clipped = cases::load("polygon_phong_nclip");
    let clipped = clipped.iter().map(|case| Inputs::of_reference(case, "N", "R"));
    let lobe_only = cases::load("polygon_phong");
    let lobe_only = lobe_only.iter().map(|case| Inputs::of_reference(case, "R", "R"));
    clipped.chain(lobe_only).chain((0..2000).map(|_| Inputs::random(&mut random))).collect()
}

#[test]
fn irradiance_of_a_polygon_matches() {
    let mut random = Random(21);
    let reference = cases::load("polygon_lambert");
    let reference = reference.iter().map(|case| Inputs::of_reference(case, "N", "N"));
    let inputs = reference.chain((0..4000).map(|_| Inputs::random(&mut random)));
    let cases: Vec<_> = inputs.map(|inputs| inputs.irradiance()).collect();
    check(
        &twin::POLYGON_IRRADIANCE,
        ("0.5 * abs(dot(contour.vector, n))", "0.501 * abs(dot(contour.vector, n))"),
        &cases,
    );
}

#[test]
fn phong_integral_of_a_polygon_matches() {
    let cases: Vec<_> = phong_inputs(22).iter().map(Inputs::phong).collect();
    check(&twin::POLYGON_PHONG, ("0.96028985649753623", "0.95"), &cases);
}

#[test]
fn phong_series_of_a_polygon_matches() {
    let whole = |inputs: Inputs| Inputs { m: inputs.m.min(64.0).round(), ..inputs };
    let cases: Vec<_> = phong_inputs(24).into_iter().map(|inputs| whole(inputs).phong()).collect();
    check(&twin::POLYGON_PHONG, ("let term = weight / k;", "let term = 1.001 * weight / k;"), &cases);
}

#[test]
fn least_angle_of_a_polygon_matches() {
    let cases: Vec<_> =
        phong_inputs(23).iter().map(|inputs| inputs.nearest_point(polygon_least_angle_cosine)).collect();
    check(
        &twin::POLYGON_LEAST_ANGLE_COSINE,
        (
            "inside = abs(core.z_along) * core.half_cosine < core.z",
            "inside = abs(core.z_along) * core.half_cosine > core.z",
        ),
        &cases,
    );
}

#[test]
fn projected_edge_of_a_polygon_matches() {
    let mut random = Random(25);
    let cases: Vec<_> =
        (0..4000).map(|_| Inputs::random(&mut random).nearest_point(polygon_projected_edge_cosine)).collect();
    check(&twin::POLYGON_PROJECTED_EDGE_COSINE, ("a + share * side", "a + 1.001 * share * side"), &cases);
}
