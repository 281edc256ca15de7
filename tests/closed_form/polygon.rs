//! Polygons: Lambert's sum and the Phong contour integral.

use std::f64::consts::PI;

use glam::DVec3;
use softbox::math::spherical::triangle_solid_angle;
use softbox::shading::polygon::{polygon_irradiance, polygon_phong, polygon_phong_lobe_only};

use crate::cases::{self, Worst};

/// Solid angle of a planar polygon seen from p.
pub(crate) fn solid_angle(vertices: &[DVec3], p: DVec3) -> f64 {
    let fan = vertices.windows(2).map(|edge| triangle_solid_angle(vertices[0] - p, edge[0] - p, edge[1] - p));
    fan.sum::<f64>().abs()
}

/// The scale of a Phong case.
fn lobe_scale(vertices: &[DVec3], p: DVec3, m: f64) -> f64 {
    ((m + 1.0) / (2.0 * PI) * solid_angle(vertices, p)).min(1.0)
}

#[test]
fn polygon_irradiance_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_lambert") {
        let (p, vertices) = (case.vector("p"), case.vectors("vertices"));
        let value = polygon_irradiance(&vertices, p, case.direction("N")) / PI;
        worst.check(&case, value, case.value("expected"), (solid_angle(&vertices, p) / PI).min(1.0));
    }
    worst.finish("polygon_irradiance", 1e-13, 1e-12);
}

#[test]
fn polygon_phong_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_phong_nclip") {
        let (p, vertices, m) = (case.vector("p"), case.vectors("vertices"), case.number("n"));
        let value = polygon_phong(&vertices, p, case.direction("N"), case.direction("R"), m);
        worst.check(&case, value, case.value("expected"), lobe_scale(&vertices, p, m));
    }
    worst.finish("polygon_phong", 5e-12, 1e-10);
}

#[test]
fn polygon_phong_lobe_only_matches_the_reference_cases() {
    let mut worst = Worst::default();
    for case in cases::load("polygon_phong") {
        let (p, vertices, m) = (case.vector("p"), case.vectors("vertices"), case.number("n"));
        let value = polygon_phong_lobe_only(&vertices, p, case.direction("R"), m);
        worst.check(&case, value, case.value("expected"), lobe_scale(&vertices, p, m));
    }
    worst.finish("polygon_phong_lobe_only", 1e-13, 1e-10);
}
