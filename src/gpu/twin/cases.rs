//! What is asked of a function and of its f64 twin alike: a light about p and what looks at it, rounded once to f32.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{Row, rounded, rounded_number};
use crate::light::{CapEmitter, DiskEmitter, LineEmitter, SkyEmitter, SphereEmitter};
use crate::math::spherical::triangle_solid_angle;
use crate::shading::PhongLobe;
use crate::shading::disk::{disk_irradiance, disk_phong, disk_solid_angle};
use crate::shading::line::{line_irradiance, line_phong};
use crate::shading::polygon::{polygon_irradiance, polygon_phong};
use crate::shading::sky::{sky_irradiance, sky_phong};
use crate::shading::sphere::{Cap, cap_irradiance, cap_phong, sphere_irradiance, sphere_phong};

/// Inputs, the f64 answer on them, and the scale of the case.
#[derive(Clone, Debug)]
pub struct Case {
    /// The inputs of the call.
    pub row: Row,
    /// What the f64 twin makes of them.
    pub expected: f64,
    /// The answer's natural size, which absolute errors are measured by.
    pub scale: f64,
}

/// A row of [`super::LINE_IRRADIANCE`].
pub fn line_irradiance_case(light: &LineEmitter, p: DVec3, n: DVec3) -> Case {
    let (light, n) = (line_about(light, p), rounded(n));
    let row = line_row(&light, n);
    Case { row, expected: line_irradiance(&light, DVec3::ZERO, n), scale: line_scale(&light) }
}

/// A row of [`super::LINE_PHONG`].
pub fn line_phong_case(light: &LineEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> Case {
    let (light, n, r, m) = (line_about(light, p), rounded(n), rounded(r), rounded_number(m));
    let row = line_row(&light, n).vector(r).lobe(PhongLobe::new(m));
    Case { row, expected: line_phong(&light, DVec3::ZERO, n, r, m), scale: line_scale(&light) }
}

/// A row of [`super::POLYGON_IRRADIANCE`].
pub fn polygon_irradiance_case(vertices: &[DVec3], p: DVec3, n: DVec3) -> Case {
    let normal = normal_of(vertices);
    let (vertices, n) = (vertices_about(vertices, p), rounded(n));
    let row = Row::default().vertices(&vertices).vector(DVec3::ZERO).vector(normal).vector(n);
    let expected = polygon_irradiance(&vertices, DVec3::ZERO, n.normalize());
    Case { row, expected, scale: polygon_solid_angle(&vertices).min(PI) }
}

/// A row of [`super::POLYGON_PHONG`].
pub fn polygon_phong_case(vertices: &[DVec3], p: DVec3, n: DVec3, r: DVec3, m: f64) -> Case {
    let normal = normal_of(vertices);
    let (vertices, n, r, m) = (vertices_about(vertices, p), rounded(n), rounded(r), rounded_number(m));
    let row = Row::default().vertices(&vertices).vector(DVec3::ZERO).vector(normal).vector(n).vector(r).number(m);
    let expected = polygon_phong(&vertices, DVec3::ZERO, n.normalize(), r.normalize(), m);
    Case { row, expected, scale: lobe_scale(polygon_solid_angle(&vertices), m) }
}

/// A row of [`super::SPHERE_IRRADIANCE`].
pub fn sphere_irradiance_case(light: &SphereEmitter, p: DVec3, n: DVec3) -> Case {
    let (light, n) = (sphere_about(light, p), rounded(n));
    let row = Row::default().vector(light.center).number(light.radius).vector(n);
    let expected = sphere_irradiance(&light, DVec3::ZERO, n.normalize());
    Case { row, expected, scale: sphere_solid_angle(&light).min(PI) }
}

/// A row of [`super::SPHERE_PHONG`].
pub fn sphere_phong_case(light: &SphereEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> Case {
    let (light, n, r, m) = (sphere_about(light, p), rounded(n), rounded(r), rounded_number(m));
    let row = Row::default().vector(light.center).number(light.radius).vector(n).vector(r).number(m);
    let expected = sphere_phong(&light, DVec3::ZERO, n.normalize(), r.normalize(), m);
    Case { row, expected, scale: lobe_scale(sphere_solid_angle(&light), m) }
}

/// A row of [`super::DISK_IRRADIANCE`].
pub fn disk_irradiance_case(light: &DiskEmitter, p: DVec3, n: DVec3) -> Case {
    let (light, normal, n) = (disk_about(light, p), rounded(light.normal), rounded(n));
    let row = Row::default().vector(light.center).vector(normal).number(light.radius).vector(n);
    let expected = disk_irradiance(&light, DVec3::ZERO, n.normalize());
    Case { row, expected, scale: disk_solid_angle(&light, DVec3::ZERO).min(PI) }
}

/// A row of [`super::DISK_PHONG`].
pub fn disk_phong_case(light: &DiskEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> Case {
    let (light, normal) = (disk_about(light, p), rounded(light.normal));
    let (n, r, m) = (rounded(n), rounded(r), rounded_number(m));
    let row = Row::default().vector(light.center).vector(normal).number(light.radius).vector(n).vector(r).number(m);
    let expected = disk_phong(&light, DVec3::ZERO, n.normalize(), r.normalize(), m);
    Case { row, expected, scale: lobe_scale(disk_solid_angle(&light, DVec3::ZERO), m) }
}

/// A row of [`super::CAP_IRRADIANCE`].
pub fn cap_irradiance_case(light: &CapEmitter, n: DVec3) -> Case {
    let (cap, row) = cap_rounded(light);
    let n = rounded(n);
    let expected = cap_irradiance(&cap, n.normalize());
    Case { row: row.vector(n), expected, scale: cap.solid_angle().min(PI) }
}

/// A row of [`super::CAP_PHONG`].
pub fn cap_phong_case(light: &CapEmitter, n: DVec3, r: DVec3, m: f64) -> Case {
    let (cap, row) = cap_rounded(light);
    let (n, r, m) = (rounded(n), rounded(r), rounded_number(m));
    let expected = cap_phong(&cap, n.normalize(), r.normalize(), m);
    Case { row: row.vector(n).vector(r).number(m), expected, scale: lobe_scale(cap.solid_angle(), m) }
}

/// A row of [`super::SKY_IRRADIANCE`].
pub fn sky_irradiance_case(light: &SkyEmitter, n: DVec3) -> Case {
    let (light, row) = sky_rounded(light);
    let n = rounded(n);
    Case { row: row.vector(n), expected: sky_irradiance(&light, n.normalize()), scale: PI }
}

/// A row of [`super::SKY_PHONG`].
pub fn sky_phong_case(light: &SkyEmitter, n: DVec3, r: DVec3, m: f64) -> Case {
    let (light, row) = sky_rounded(light);
    let (n, r, m) = (rounded(n), rounded(r), rounded_number(m));
    let expected = sky_phong(&light, n.normalize(), r.normalize(), m);
    Case { row: row.vector(n).vector(r).number(m), expected, scale: 1.0 }
}

/// The unit normal of a polygon's plane, about which its corners run counter-clockwise.
fn normal_of(vertices: &[DVec3]) -> DVec3 {
    let Some(&corner) = vertices.first() else { return DVec3::ZERO };
    let doubled: DVec3 = vertices.windows(2).map(|edge| (edge[0] - corner).cross(edge[1] - corner)).sum();
    doubled.normalize_or_zero()
}

/// What the rows of all functions of lines begin with.
pub fn line_row(light: &LineEmitter, n: DVec3) -> Row {
    let diameter = light.tube.map_or(0.0, |radius| 2.0 * radius);
    Row::default().vector(light.a).vector(light.b).vector(n).number(light.falloff).number(diameter)
}

fn line_about(light: &LineEmitter, p: DVec3) -> LineEmitter {
    LineEmitter {
        a: rounded(light.a - p),
        b: rounded(light.b - p),
        falloff: rounded_number(light.falloff),
        tube: light.tube.map(rounded_number),
    }
}

fn vertices_about(vertices: &[DVec3], p: DVec3) -> Vec<DVec3> {
    vertices.iter().map(|vertex| rounded(*vertex - p)).collect()
}

fn sphere_about(light: &SphereEmitter, p: DVec3) -> SphereEmitter {
    SphereEmitter { center: rounded(light.center - p), radius: rounded_number(light.radius) }
}

fn disk_about(light: &DiskEmitter, p: DVec3) -> DiskEmitter {
    let radius = rounded_number(light.radius);
    DiskEmitter { center: rounded(light.center - p), normal: rounded(light.normal).normalize(), radius, ..*light }
}

fn cap_rounded(light: &CapEmitter) -> (Cap, Row) {
    let center = rounded(light.to_center);
    let (sin, cos) = light.half_angle.sin_cos();
    let row = Row::default().vector(center).number(sin).number(cos);
    (Cap::new(center.normalize(), light.half_angle), row)
}

fn sky_rounded(light: &SkyEmitter) -> (SkyEmitter, Row) {
    let (zenith, uniform, cosine) =
        (rounded(light.zenith), rounded_number(light.uniform), rounded_number(light.cosine));
    let row = Row::default().vector(zenith).number(uniform).number(cosine);
    (SkyEmitter { zenith: zenith.normalize(), uniform, cosine }, row)
}

/// |B−A|/dᶠ, d the least distance from the origin; that times 2ϱ of a tube.
pub fn line_scale(light: &LineEmitter) -> f64 {
    let along = light.b - light.a;
    let t = (-light.a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
    let emission = light.tube.map_or(1.0, |radius| 2.0 * radius);
    emission * along.length() / (light.a + t * along).length().powf(light.falloff)
}

/// (m+1)/(2π)·Ω, at most 1.
pub fn lobe_scale(solid_angle: f64, m: f64) -> f64 {
    ((m + 1.0) / TAU * solid_angle).min(1.0)
}

fn polygon_solid_angle(vertices: &[DVec3]) -> f64 {
    let fan = vertices.windows(2).map(|edge| triangle_solid_angle(vertices[0], edge[0], edge[1]));
    fan.sum::<f64>().abs()
}

/// Of a sphere seen from the origin; 2π from inside.
pub fn sphere_solid_angle(light: &SphereEmitter) -> f64 {
    Cap::of_sphere(light, DVec3::ZERO, DVec3::Z).solid_angle()
}
