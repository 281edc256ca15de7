//! What shading costs on the CPU: every light and method, in ns a point and as a multiple of a point light in the same run.
//!
//! `cargo bench --no-default-features --bench shading`. The least of several runs over the same random points.

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use glam::DVec3;
use softbox::light::{Emitter, Line, LineEmission, LineEmitter, PointEmitter, Shape, Sphere, SphereEmitter};
use softbox::shading::line::line_irradiance;
use softbox::shading::sphere::{Cap, cap_irradiance_hermite_1, cap_irradiance_hermite_2, sphere_irradiance};
use softbox::shading::{Method, PhongLobe, ShadingPoint, respond};

const POINTS: u32 = 10_000;
const RUNS: usize = 15;
/// Of the lobe; a real one, for which no recurrence serves.
const EXPONENT: f64 = 32.5;

fn main() {
    let points: Vec<ShadingPoint> = (0..POINTS).map(shading_point).collect();
    let lobe = PhongLobe::new(EXPONENT);
    let ceiling = DVec3::new(0.0, 0.0, 2.0);
    let line = LineEmitter { a: ceiling - DVec3::X, b: ceiling + DVec3::X, falloff: 2.0 };
    let sphere = SphereEmitter { center: ceiling, radius: 0.5 };

    println!("{:<10} {:<10} {:<16} {:>8} {:>14}", "light", "part", "method", "ns", "point lights");
    // The diffuse part alone is held against a point light without a lobe.
    let diffuse_point = time(&points, |at| {
        let to_light = ceiling - at.p;
        let square = to_light.length_squared();
        at.n.dot(to_light).max(0.0) / (square * square.sqrt())
    });
    let diffuse = |light: &str, method: &str, f: &dyn Fn(&ShadingPoint) -> f64| {
        row(light, "diffuse", method, time(&points, f), diffuse_point);
    };
    row("point", "diffuse", "exact", diffuse_point, diffuse_point);
    diffuse("line", "exact", &|at| line_irradiance(&line, at.p, at.n));
    for falloff in [0.0, 1.0, 3.0, 2.5] {
        let line = LineEmitter { falloff, ..line };
        diffuse("line", &format!("falloff {falloff}"), &|at| line_irradiance(&line, at.p, at.n));
    }
    diffuse("sphere", "exact", &|at| sphere_irradiance(&sphere, at.p, at.n));
    diffuse("sphere", "hermite-1", &|at| cap_irradiance_hermite_1(&Cap::of_sphere(&sphere, at.p, at.n), at.n));
    diffuse("sphere", "hermite-2", &|at| cap_irradiance_hermite_2(&Cap::of_sphere(&sphere, at.p, at.n), at.n));

    let point = Emitter::Point(PointEmitter { position: ceiling });
    let both = |emitter: &Emitter, method: Method| {
        time(&points, |at| {
            let response = respond(emitter, method, at, &lobe);
            response.irradiance + response.specular
        })
    };
    let whole_point = both(&point, Method::Exact);
    row("point", "both", "exact", whole_point, whole_point);
    let shapes = [
        (Shape::Line(Line { length: 2.0, emission: LineEmission::Isotropic, falloff: 2.0 }), Emitter::Line(line)),
        (Shape::Sphere(Sphere { radius: 0.5 }), Emitter::Sphere(sphere)),
    ];
    for (shape, emitter) in &shapes {
        for method in Method::of(shape).iter().copied().filter(|method| *method != Method::Reference) {
            row(shape.name(), "both", &method.to_string(), both(emitter, method), whole_point);
        }
    }
}

/// Nanoseconds a point.
fn time(points: &[ShadingPoint], f: impl Fn(&ShadingPoint) -> f64) -> f64 {
    let mut least = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        let sum: f64 = points.iter().map(|at| f(black_box(at))).sum();
        black_box(sum);
        least = least.min(start.elapsed().as_secs_f64());
    }
    1e9 * least / points.len() as f64
}

fn row(light: &str, part: &str, method: &str, ns: f64, point: f64) {
    println!("{light:<10} {part:<10} {method:<16} {ns:>8.1} {:>14.2}", ns / point);
}

/// Points of a ground plane 8 m wide with tilted normals, by the R₂ sequence (M. Roberts, 2018).
fn shading_point(i: u32) -> ShadingPoint {
    let i = f64::from(i);
    let (x, y) = ((0.754_877_666 * i).fract(), (0.569_840_291 * i).fract());
    let (sin, cos) = (TAU * (0.618_033_989 * i).fract()).sin_cos();
    let n = DVec3::new(0.5 * cos, 0.5 * sin, 1.0).normalize();
    let v = DVec3::new(0.4 * sin, -0.6, 0.8).normalize();
    ShadingPoint { p: DVec3::new(8.0 * x - 4.0, 8.0 * y - 4.0, 0.0), n, v }
}
