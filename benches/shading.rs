//! What shading costs on the CPU: every light and method, in ns a point and as a multiple of a point light in the same run.
//!
//! `cargo bench --no-default-features --bench shading [-- FILTER]`. The least of many runs over the same random points.

mod common;

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::{Duration, Instant};

use common::{Bench, Times};
use glam::DVec3;
use softbox::light::{Emitter, Light, LineEmitter, Shape, SphereEmitter};
use softbox::shading::line::line_irradiance;
use softbox::shading::sphere::{sphere_irradiance, sphere_irradiance_hermite_1, sphere_irradiance_hermite_2};
use softbox::shading::{Method, PhongLobe, Prepared, ShadingPoint};

const POINTS: u32 = 1000;

/// Of the lobe: a whole one, and for the exact method a real one too.
const EXPONENT: f64 = 31.0;
const REAL_EXPONENT: f64 = 32.5;

fn main() {
    let points: Vec<ShadingPoint> = (0..POINTS).map(shading_point).collect();
    let mut bench = Bench::new();

    // As a function that is called, like the others.
    let point: Irradiance = Box::new(point_irradiance);
    for (light, method, irradiance) in diffuse_parts() {
        let mut least = [Duration::MAX; 2];
        bench.measure([light, "diffuse", method], || Times {
            light: time(&points, &irradiance, &mut least[0]),
            point: time(&points, &point, &mut least[1]),
        });
    }
    let lobe = PhongLobe::new(EXPONENT);
    let point_emitter = placed(common::point());
    let point = Prepared::new(&point_emitter, Method::Exact);
    for (light, shape) in common::lights() {
        let emitter = placed(shape.clone());
        let methods = common::methods(&shape).map(|method| (method, EXPONENT));
        let first = common::methods(&shape).next().map(|method| (method, REAL_EXPONENT));
        for (method, exponent) in methods.chain(first) {
            let light_lobe = PhongLobe::new(exponent);
            let light_prepared = Prepared::new(&emitter, method);
            let part = format!("both, m = {exponent}");
            let mut least = [Duration::MAX; 2];
            bench.measure([light, &part, &method.to_string()], || Times {
                light: time(&points, |at| both(&light_prepared, at, &light_lobe), &mut least[0]),
                point: time(&points, |at| both(&point, at, &lobe), &mut least[1]),
            });
        }
    }
    bench.finish("ns", POINTS.into());
}

/// Where the lights are.
const CEILING: DVec3 = DVec3::new(0.0, 0.0, 2.0);

fn placed(shape: Shape) -> Emitter {
    Light { position: CEILING, ..Light::new("light", shape) }.emitter()
}

fn both(light: &Prepared, at: &ShadingPoint, lobe: &PhongLobe) -> f64 {
    let response = light.respond(at, lobe);
    response.irradiance + response.specular
}

/// A point light's irradiance and no more, which diffuse parts are multiples of.
fn point_irradiance(at: &ShadingPoint) -> f64 {
    let to_light = CEILING - at.p;
    let square = to_light.length_squared();
    at.n.dot(to_light).max(0.0) / (square * square.sqrt())
}

type Irradiance = Box<dyn Fn(&ShadingPoint) -> f64>;

/// Irradiance alone, by light and method.
fn diffuse_parts() -> Vec<(&'static str, &'static str, Irradiance)> {
    let line = |falloff| {
        let light = LineEmitter { a: CEILING - DVec3::X, b: CEILING + DVec3::X, falloff, tube: None };
        Box::new(move |at: &ShadingPoint| line_irradiance(&light, at.p, at.n)) as Irradiance
    };
    let sphere = SphereEmitter { center: CEILING, radius: 0.5 };
    let ball = |irradiance: fn(&SphereEmitter, DVec3, DVec3) -> f64| {
        Box::new(move |at: &ShadingPoint| irradiance(&sphere, at.p, at.n)) as Irradiance
    };
    vec![
        ("line", "exact", line(2.0)),
        ("line n=0", "exact", line(0.0)),
        ("line n=1", "exact", line(1.0)),
        ("line n=3", "exact", line(3.0)),
        ("line n=2.5", "exact", line(2.5)),
        ("sphere", "exact", ball(sphere_irradiance)),
        ("sphere", "hermite-1", ball(sphere_irradiance_hermite_1)),
        ("sphere", "hermite-2", ball(sphere_irradiance_hermite_2)),
    ]
}

/// The least time of all points so far.
fn time(points: &[ShadingPoint], f: impl Fn(&ShadingPoint) -> f64, least: &mut Duration) -> Duration {
    let start = Instant::now();
    let sum: f64 = points.iter().map(|at| f(black_box(at))).sum();
    black_box(sum);
    *least = start.elapsed().min(*least);
    *least
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
