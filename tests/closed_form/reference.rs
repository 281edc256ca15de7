//! The quadrature that judges the closed forms, itself judged by the reference cases.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::light::{LineEmitter, PolygonEmitter, SphereEmitter};
use softbox::math::quadrature::Estimate;
use softbox::shading::reference::{Kernel, cap_reference, line_reference, polygon_reference, sphere_reference};

use crate::cases::{self, Case};

/// Runs a file through `value`, which gives the estimate and the scale of a case: the truth must lie in the bound, and
/// the bound be no wider than 1e-6 of the value and 1e-9 of the scale.
#[track_caller]
fn check(model: &str, value: impl Fn(&Case) -> (Estimate, f64)) {
    for case in cases::load(model) {
        let (estimate, scale) = value(&case);
        let expected = case.value("expected");
        let off = (estimate.value - expected).abs();
        let (id, error) = (case.id(), estimate.error);
        assert!(
            off <= error + 50.0 * case.rounding() * expected,
            "{id}: {:e} for {expected:e}, off by {off:e}, bound {error:e}",
            estimate.value
        );
        assert!(error <= 1e-6 * expected + 1e-9 * scale, "{id}: bound {error:e} is too wide for {expected:e}");
    }
}

fn kernel(case: &Case, axis: &str) -> Kernel<'static> {
    let exponent = if axis == "N" { 1.0 } else { case.number("n") };
    Kernel::cosine_power(case.direction(axis), exponent)
}

/// What makes unit weight of a solid angle the normalised answer.
fn normalisation(kernel: &Kernel) -> f64 {
    (kernel.exponent + 1.0) / (2.0 * PI)
}

fn polygon(case: &Case, kernel: &Kernel) -> (Estimate, f64) {
    let vertices = case.vectors("vertices");
    let doubled: DVec3 = vertices.windows(2).map(|edge| (edge[0] - vertices[0]).cross(edge[1] - vertices[0])).sum();
    let light = PolygonEmitter { vertices, normal: doubled.normalize(), two_sided: true };
    let solid_angle = super::polygon::solid_angle(&light.vertices, case.vector("p"));
    let factor = normalisation(kernel);
    (polygon_reference(&light, case.vector("p"), kernel) * factor, (factor * solid_angle).min(1.0))
}

fn sphere(case: &Case, kernel: &Kernel) -> (Estimate, f64) {
    let light = SphereEmitter { center: case.vector("center"), radius: case.number("radius") };
    let ratio = light.radius / light.center.distance(case.vector("p"));
    let solid_angle = 2.0 * PI * ratio * ratio / (1.0 + (1.0 - ratio * ratio).sqrt());
    let factor = normalisation(kernel);
    (sphere_reference(&light, case.vector("p"), kernel) * factor, (factor * solid_angle).min(1.0))
}

fn cap(case: &Case, kernel: &Kernel) -> (Estimate, f64) {
    let half_angle = case.number("sigma");
    let solid_angle = 4.0 * PI * (0.5 * half_angle).sin().powi(2);
    let factor = normalisation(kernel);
    (cap_reference(case.direction("L"), half_angle, kernel) * factor, (factor * solid_angle).min(1.0))
}

fn line(case: &Case, kernel: &Kernel, falloff: f64) -> (Estimate, f64) {
    let light = LineEmitter { a: case.vector("A"), b: case.vector("B"), falloff, tube: None };
    let p = case.vector("p");
    let along = (light.b - light.a).normalize();
    let s = (p - light.a).dot(along).clamp(0.0, light.length());
    let distance = (light.a + s * along).distance(p);
    (line_reference(&light, p, kernel), light.length() / distance.powf(falloff))
}

#[test]
fn polygon_reference_holds_its_bound_on_every_case() {
    check("polygon_lambert", |case| polygon(case, &kernel(case, "N")));
    check("polygon_phong", |case| polygon(case, &kernel(case, "R")));
    check("polygon_phong_nclip", |case| {
        polygon(case, &Kernel::lobe(case.direction("R"), case.number("n"), case.direction("N")))
    });
}

#[test]
fn line_reference_holds_its_bound_on_every_case() {
    check("linear_diffuse", |case| line(case, &kernel(case, "N"), case.number("decay")));
    check("linear_phong", |case| line(case, &kernel(case, "R"), 2.0));
}

#[test]
fn sphere_reference_holds_its_bound_on_every_case() {
    check("sphere_lambert", |case| sphere(case, &kernel(case, "N")));
    check("sphere_phong", |case| sphere(case, &kernel(case, "R")));
}

#[test]
fn cap_reference_holds_its_bound_on_every_case() {
    check("subhemi_lambert", |case| cap(case, &kernel(case, "N")));
    check("subhemi_phong", |case| cap(case, &kernel(case, "R")));
}
