//! What a light layer costs on the GPU: every light and method, as a multiple of a point light's layer in the same run.
//!
//! `cargo bench --bench layers [-- FILTER]`. A layer's time is that of a picture in which all of a scene's lights moved,
//! less that of one in which only their weights changed, over the number of lights; the least of many.

mod common;

use std::time::{Duration, Instant};

use common::{Bench, Times};
use glam::DVec3;
use softbox::gpu::{Context, Display, Preview, View};
use softbox::light::{Light, Quantity, Shape};
use softbox::scene::{Camera, Scene};
use softbox::shading::Method;
use softbox::surface::{self, Material, ReflectionModel, Surface};

const SIZE: [u32; 2] = [320, 180];
/// Lights in the scene, all alike but for their places.
const LIGHTS: u32 = 8;
const EXPONENT: f64 = 31.0;

fn main() {
    let context = match Context::new() {
        Ok(context) => context,
        Err(error) => {
            eprintln!("{error}");
            std::process::exit(2);
        }
    };
    println!("{}, {}×{}", context.adapter, SIZE[0], SIZE[1]);
    let mut bench = Bench::new();
    for (part, specular) in [("diffuse", 0.0), ("both, m = 31", 0.2)] {
        let mut point = Layers::new(&context, &common::point(), Method::Exact, specular);
        for (light, shape) in common::lights() {
            for method in common::methods(&shape) {
                let mut layers = Layers::new(&context, &shape, method, specular);
                bench.measure([light, part, &method.to_string()], || Times {
                    light: layers.time(),
                    point: point.time(),
                });
            }
        }
    }
    bench.finish("ns a pixel", f64::from(SIZE[0]) * f64::from(SIZE[1]));
}

/// A scene of lights that are all alike, and its preview.
struct Layers<'a> {
    context: &'a Context,
    preview: Preview,
    scene: Scene,
    view: View,
    /// Least times so far of pictures in which all lights moved, and in which only weights changed.
    moved: Duration,
    weighed: Duration,
}

impl<'a> Layers<'a> {
    fn new(context: &'a Context, shape: &Shape, method: Method, specular: f64) -> Self {
        let scene = scene(shape, specular);
        let camera = scene.camera;
        let view = View {
            camera,
            size: SIZE,
            method,
            exposure_ev: 0.0,
            show_emitters: false,
            shadows: false,
            refine: false,
            display: Display::Picture,
        };
        let preview = Preview::new(&context.device);
        let mut layers = Self { context, preview, scene, view, moved: Duration::MAX, weighed: Duration::MAX };
        layers.draw();
        layers
    }

    /// Time of one picture.
    fn draw(&mut self) -> Duration {
        let Context { device, queue, .. } = self.context;
        let start = Instant::now();
        self.preview.render(device, queue, &self.scene, &self.view);
        device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
        start.elapsed()
    }

    /// Time of one layer.
    fn time(&mut self) -> Duration {
        for light in &mut self.scene.lights {
            light.quantity = Quantity::new(light.quantity.kind(), light.quantity.value() + 1.0);
        }
        self.weighed = self.draw().min(self.weighed);
        for light in &mut self.scene.lights {
            light.position.x += 0.001;
            light.rotation_deg.x += 0.01;
        }
        self.moved = self.draw().min(self.moved);
        self.moved.saturating_sub(self.weighed) / LIGHTS
    }
}

/// A floor and a ball under a row of lights.
fn scene(shape: &Shape, specular: f64) -> Scene {
    let material = Material {
        name: "grey".to_owned(),
        diffuse: DVec3::splat(0.5),
        specular: DVec3::splat(specular),
        model: ReflectionModel::default(),
        exponent: EXPONENT,
    };
    let surface = |name: &str, position, shape| Surface {
        name: name.to_owned(),
        material: material.name.clone(),
        position,
        shape,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
    };
    let light = |i| Light {
        name: format!("light {i}"),
        position: DVec3::new(0.5 * f64::from(i) - 2.0, 0.5, 2.0),
        rotation_deg: DVec3::new(20.0, 0.0, 0.0),
        ..Light::new("", shape.clone())
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
