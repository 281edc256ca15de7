//! What a light layer costs: every light and method, as a multiple of a point light's layer in the same run.
//!
//! `cargo bench --bench layers`. A layer's time is that of a picture in which all of a scene's lights moved, less that
//! of one in which only their weights changed, over the number of lights; the least of several runs.

use std::time::{Duration, Instant};

use glam::{DVec2, DVec3};
use softbox::gpu::{Context, Preview, View};
use softbox::light::{Directional, Light, Line, LineEmission, Point, Polygon, Quantity, Shape, Sphere, Tint};
use softbox::scene::{Camera, Scene};
use softbox::shading::Method;
use softbox::surface::{self, Material, Surface};

const SIZE: [u32; 2] = [640, 360];
/// Lights in the scene, all alike but for their places.
const LIGHTS: u32 = 8;
const RUNS: usize = 15;

fn main() {
    let context = match Context::new() {
        Ok(context) => context,
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    println!("{}, {}×{}", context.adapter, SIZE[0], SIZE[1]);
    println!("{:<12} {:<14} {:>10} {:>14}", "light", "method", "ms", "point lights");
    let point = layer_time(&context, &Shape::Point(Point {}), Method::Exact);
    for shape in shapes() {
        let methods = Method::of(&shape).iter().copied().filter(|method| *method != Method::Reference);
        for method in methods {
            let time = layer_time(&context, &shape, method);
            let ratio = time.as_secs_f64() / point.as_secs_f64();
            let name = name(&shape);
            println!("{name:<12} {method:<14} {:>10.3} {ratio:>14.2}", 1e3 * time.as_secs_f64());
        }
    }
}

fn shapes() -> Vec<Shape> {
    let ring = |vertices: u32, radius: f64| {
        let corner = |i| DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / f64::from(vertices)) * radius;
        Shape::Polygon(Polygon { vertices: (0..vertices).map(corner).collect(), two_sided: false })
    };
    let line = |falloff| Shape::Line(Line { length: 1.0, emission: LineEmission::Isotropic, falloff });
    vec![
        Shape::Point(Point {}),
        Shape::Directional(Directional {}),
        line(2.0),
        line(1.0),
        ring(4, 0.7),
        ring(8, 0.7),
        Shape::Sphere(Sphere { radius: 0.3 }),
    ]
}

fn name(shape: &Shape) -> String {
    match shape {
        Shape::Polygon(polygon) => format!("{}-gon", polygon.vertices.len()),
        Shape::Line(line) => format!("line 1/r^{}", line.falloff),
        _ => shape.name().to_owned(),
    }
}

/// Time of one layer of such a light.
fn layer_time(context: &Context, shape: &Shape, method: Method) -> Duration {
    let mut preview = Preview::new(&context.device, &context.queue);
    let mut scene = scene(shape);
    let camera = scene.camera;
    let view = View { camera, size: SIZE, method, exposure_ev: 0.0, show_emitters: false, refine: false };
    let mut time = |scene: &Scene| {
        let start = Instant::now();
        preview.render(&context.device, &context.queue, scene, &view);
        context.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        start.elapsed()
    };
    time(&scene);
    let (mut moved, mut weighed) = (Duration::MAX, Duration::MAX);
    for _ in 0..RUNS {
        for light in &mut scene.lights {
            light.position.x += 0.01;
            light.rotation_deg.x += 0.1;
        }
        moved = moved.min(time(&scene));
        for light in &mut scene.lights {
            light.quantity = Quantity::new(light.quantity.kind(), light.quantity.value() + 1.0);
        }
        weighed = weighed.min(time(&scene));
    }
    moved.saturating_sub(weighed) / LIGHTS
}

/// A floor and a ball under a row of lights.
fn scene(shape: &Shape) -> Scene {
    let material =
        Material { name: "grey".to_owned(), diffuse: DVec3::splat(0.5), specular: DVec3::splat(0.2), exponent: 32.0 };
    let surface = |name: &str, position, shape| Surface {
        name: name.to_owned(),
        material: material.name.clone(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    };
    let light = |i| Light {
        name: format!("light {i}"),
        position: DVec3::new(0.5 * f64::from(i) - 2.0, 0.5, 2.0),
        rotation_deg: DVec3::new(20.0, 0.0, 0.0),
        tint: Tint::default(),
        quantity: Quantity::new(shape.strength_kind(), 100.0),
        muted: false,
        shape: shape.clone(),
    };
    Scene {
        camera: Camera::default(),
        surfaces: vec![
            surface("floor", DVec3::ZERO, surface::Shape::Plane {}),
            surface("ball", DVec3::new(0.0, 0.0, 0.5), surface::Shape::Sphere { radius: 0.5 }),
        ],
        materials: vec![material],
        lights: (0..LIGHTS).map(light).collect(),
        ..Scene::default()
    }
}
