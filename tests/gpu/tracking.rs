//! What the preview redoes.

use glam::{DVec2, DVec3};
use softbox::gpu::{Display, Pixels, Preview, SharedPasses, Stats, View};
use softbox::light::{Light, Line, Point, Polygon, Quantity, QuantityKind, Shape, Tint};
use softbox::scene::{Camera, Scene};
use softbox::shading::Method;
use softbox::surface::{self, Material, ReflectionModel, Surface};

use crate::CONTEXT;

struct Bench {
    preview: Preview,
    scene: Scene,
    view: View,
}

impl Bench {
    fn new(scene: Scene) -> Self {
        let preview = Preview::new(&CONTEXT.device);
        let view = View {
            camera: scene.camera,
            size: [64, 48],
            method: Method::Exact,
            exposure_ev: 0.0,
            show_emitters: false,
            shadows: false,
            refine: false,
            display: Display::Picture,
        };
        Self { preview, scene, view }
    }

    fn render(&mut self) -> Stats {
        self.preview.render(&CONTEXT.device, &CONTEXT.queue, &self.scene, &self.view);
        self.preview.stats()
    }

    fn pixels(&self) -> Pixels {
        self.preview.read_back(&CONTEXT.device, &CONTEXT.queue).expect("the picture comes back")
    }

    /// What one more rendering costs.
    #[track_caller]
    fn check_cost(&mut self, change: &str, expected: Stats) {
        let before = self.preview.stats();
        let after = self.render();
        let cost = Stats {
            g_buffers: after.g_buffers - before.g_buffers,
            layers: after.layers - before.layers,
            shadows: after.shadows - before.shadows,
            composites: after.composites - before.composites,
        };
        assert_eq!(cost, expected, "{change}");
    }
}

fn light(name: &str, x: f64, kind: QuantityKind, shape: Shape) -> Light {
    Light {
        name: name.to_owned(),
        position: DVec3::new(x, 0.0, 2.0),
        rotation_deg: DVec3::ZERO,
        tint: Tint::default(),
        quantity: Quantity::new(kind, 1000.0),
        muted: false,
        group: None,
        only: None,
        shape,
    }
}

/// A floor, a ball, and a point, a line and a polygon over them.
fn scene() -> Scene {
    let material = Material {
        name: "grey".to_owned(),
        diffuse: DVec3::splat(0.5),
        specular: DVec3::splat(0.2),
        model: ReflectionModel::default(),
        exponent: 32.0,
    };
    let surface = |name: &str, position, shape| Surface {
        name: name.to_owned(),
        material: "grey".to_owned(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    };
    let square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)].map(DVec2::from).to_vec();
    let line = Line::isotropic(1.0);
    Scene {
        camera: Camera::default(),
        materials: vec![material],
        surfaces: vec![
            surface("floor", DVec3::ZERO, surface::Shape::Plane {}),
            surface("ball", DVec3::new(0.0, 0.0, 0.5), surface::Shape::Sphere { radius: 0.5 }),
        ],
        lights: vec![
            light("point", -1.0, QuantityKind::Intensity, Shape::Point(Point::default())),
            light("line", 0.0, QuantityKind::IntensityPerMetre, Shape::Line(line)),
            light(
                "window",
                1.0,
                QuantityKind::Luminance,
                Shape::Polygon(Polygon { vertices: square, two_sided: false }),
            ),
        ],
        ..Scene::default()
    }
}

const NOTHING: Stats = Stats { g_buffers: 0, layers: 0, shadows: 0, composites: 0 };
const COMPOSITE: Stats = Stats { composites: 1, ..NOTHING };

#[test]
fn work_follows_change() {
    let mut bench = Bench::new(scene());
    bench.check_cost("first picture", Stats { g_buffers: 1, layers: 3, ..COMPOSITE });
    bench.check_cost("nothing", NOTHING);

    bench.scene.lights[1].position.z = 1.5;
    bench.check_cost("one light is dragged", Stats { layers: 1, ..COMPOSITE });
    bench.scene.lights[0].tint = Tint::Color(DVec3::new(1.0, 0.5, 0.2));
    bench.check_cost("a tint", COMPOSITE);
    bench.scene.lights[2].quantity = Quantity::new(QuantityKind::Flux, 500.0);
    bench.check_cost("a quantity", COMPOSITE);
    bench.scene.lights[2].muted = true;
    bench.check_cost("mute", COMPOSITE);
    bench.scene.lights[2].muted = false;
    bench.check_cost("unmute", COMPOSITE);
    bench.scene.lights[0].name = "lamp".to_owned();
    bench.check_cost("a name", NOTHING);
    bench.view.exposure_ev = 1.0;
    bench.check_cost("exposure", COMPOSITE);

    let taken = bench.scene.lights.remove(0);
    bench.check_cost("a light is deleted", COMPOSITE);
    bench.scene.lights.push(taken);
    bench.check_cost("and added again, last", Stats { layers: 1, ..COMPOSITE });
    bench.scene.lights.swap(0, 1);
    bench.check_cost("the order of the lights", COMPOSITE);
    bench.scene.lights[0].only = Some(vec!["ball".to_owned()]);
    bench.check_cost("a link", COMPOSITE);
    bench.scene.lights[0].only = None;
    bench.check_cost("no link", COMPOSITE);
    bench.scene.lights[0].group = Some("key".to_owned());
    bench.check_cost("a group", NOTHING);
    let mut copy = bench.scene.lights[0].clone();
    copy.name = "copy".to_owned();
    bench.scene.lights.push(copy);
    bench.check_cost("a copy in the same place shares its layer", COMPOSITE);

    bench.scene.materials[0].diffuse = DVec3::splat(0.7);
    bench.check_cost("a reflectance", COMPOSITE);
    bench.scene.materials[0].exponent = 64.0;
    bench.check_cost("an exponent", Stats { layers: 3, ..COMPOSITE });
    bench.scene.surfaces[1].position.x = 0.3;
    bench.check_cost("a surface", Stats { g_buffers: 1, layers: 3, ..COMPOSITE });
    bench.view.camera.eye.x = 1.0;
    bench.check_cost("the camera", Stats { g_buffers: 1, layers: 3, ..COMPOSITE });
    bench.view.size = [32, 32];
    bench.check_cost("the size", Stats { g_buffers: 1, layers: 3, ..COMPOSITE });
    bench.view.method = Method::Point;
    bench.check_cost("the method, which the point light does not have", Stats { layers: 2, ..COMPOSITE });
    bench.view.show_emitters = true;
    bench.check_cost("emitters", COMPOSITE);
    bench.check_cost("nothing", NOTHING);
}

#[test]
fn shadows_follow_the_lights_places_and_the_surfaces_only() {
    let mut bench = Bench::new(scene());
    bench.view.shadows = true;
    bench.check_cost("first picture", Stats { g_buffers: 1, layers: 3, shadows: 3, ..COMPOSITE });
    let more = Stats { shadows: 1, ..COMPOSITE };
    for _ in 0..2 {
        bench.check_cost("more rays to the window", more);
    }
    bench.check_cost("nothing", NOTHING);
    bench.view.method = Method::Point;
    bench.check_cost("the method", Stats { layers: 2, ..COMPOSITE });
    bench.scene.lights[0].tint = Tint::Color(DVec3::new(1.0, 0.5, 0.2));
    bench.check_cost("a tint", COMPOSITE);
    bench.scene.lights[2].quantity = Quantity::new(QuantityKind::Flux, 500.0);
    bench.check_cost("a quantity", COMPOSITE);
    bench.scene.lights[2].muted = true;
    bench.check_cost("mute", COMPOSITE);
    bench.scene.lights[2].muted = false;
    bench.check_cost("unmute", COMPOSITE);
    bench.scene.lights[1].position.z = 1.5;
    bench.check_cost("one light is dragged", Stats { layers: 1, shadows: 1, ..COMPOSITE });
    bench.view.shadows = false;
    bench.check_cost("no shadows", COMPOSITE);
    bench.view.shadows = true;
    bench.check_cost("shadows again", Stats { shadows: 3, ..COMPOSITE });
    bench.scene.surfaces[1].position.x = 0.3;
    bench.check_cost("a surface", Stats { g_buffers: 1, layers: 3, shadows: 3, ..COMPOSITE });
    bench.scene.materials[0].exponent = 64.0;
    bench.check_cost("an exponent", Stats { layers: 3, shadows: 3, ..COMPOSITE });
    bench.scene.lights[2].position.x = 0.9;
    bench.check_cost("a light before its rays are cast", Stats { layers: 1, shadows: 1, ..COMPOSITE });
}

#[test]
fn shadows_in_bands_end_in_the_same_picture() {
    let refined = |bands| {
        let mut bench = Bench::new(scene());
        bench.view = View { refine: true, shadows: true, ..bench.view };
        bench.preview.work_in_bands(bands);
        let mut calls = 0;
        while !bench.preview.is_converged() {
            bench.render();
            calls += 1;
            assert!(calls <= 1000, "the picture does not converge");
        }
        (bench.pixels().radiance, bench.render())
    };
    let (whole, banded) = (refined(1), refined(7));
    assert_eq!(whole.0, banded.0, "to the last bit");
    let stages = Stats { g_buffers: 8, layers: 8 * 3, shadows: 8 * 3 + 2, composites: 8 + 2 };
    assert_eq!((whole.1, banded.1), (stages, stages), "rays of eight samples");
}

#[test]
fn a_point_light_over_the_floor_gives_the_inverse_square() {
    let mut bench = Bench::new(scene());
    bench.scene.lights.truncate(1);
    bench.scene.lights[0].position = DVec3::new(0.0, 0.0, 2.0);
    bench.scene.surfaces.truncate(1);
    bench.scene.materials[0].specular = DVec3::ZERO;
    bench.view.camera = Camera { eye: DVec3::new(0.0, 0.0, 5.0), target: DVec3::ZERO, fov_deg: 40.0 };
    bench.view.size = [1, 1];
    bench.render();
    let expected = 1000.0 / 4.0 * 0.5 / std::f64::consts::PI;
    let radiance = bench.pixels().radiance[0];
    for channel in radiance {
        let error = (f64::from(channel) - expected).abs() / expected;
        assert!(error < 1e-6, "{radiance:?} is not {expected} (relative error {error:e})");
    }
}

#[test]
fn a_still_picture_is_refined_and_then_left_alone() {
    let mut bench = Bench::new(scene());
    bench.view.refine = true;
    bench.render();
    let first = bench.pixels();
    let mut samples = 1;
    while !bench.preview.is_converged() {
        bench.check_cost("another sample", Stats { g_buffers: 1, layers: 3, ..COMPOSITE });
        samples += 1;
        assert!(samples <= 64, "the picture does not converge");
    }
    bench.check_cost("converged", NOTHING);
    let refined = bench.pixels();
    assert_ne!(first.radiance, refined.radiance, "refinement changes edges");
    let mean = |pixels: &Pixels| pixels.radiance.iter().map(|rgb| f64::from(rgb[1])).sum::<f64>();
    let ratio = mean(&refined) / mean(&first);
    assert!((ratio - 1.0).abs() < 0.01, "refinement changes the whole by {ratio}");

    bench.scene.lights[0].position.x = 0.2;
    bench.check_cost("one light is dragged", Stats { layers: 1, ..COMPOSITE });
    assert!(!bench.preview.is_converged(), "a change starts anew");
}

#[test]
fn refinement_in_bands_ends_in_the_same_picture() {
    let refined = |bands| {
        let mut bench = Bench::new(scene());
        bench.view.refine = true;
        bench.preview.work_in_bands(bands);
        let mut calls = 0;
        while !bench.preview.is_converged() {
            bench.render();
            calls += 1;
            assert!(calls <= 1000, "the picture does not converge");
        }
        (bench.pixels().radiance, calls)
    };
    let ((whole, calls), (banded, more_calls)) = (refined(1), refined(5));
    assert_eq!(whole, banded, "to the last bit");
    assert_eq!((calls, more_calls), (8, 8 * 5), "a sample a call; a fifth of a sample a call");
}

#[test]
fn in_bands_the_picture_before_stays_until_the_next_is_whole() {
    let mut bench = Bench::new(scene());
    bench.view.shadows = true;
    bench.render();
    let before = bench.pixels();
    bench.scene.lights[2].position.x = 0.5;
    bench.preview.work_in_bands(7);
    let mut calls = 0;
    while {
        bench.render();
        calls += 1;
        !bench.preview.is_whole()
    } {
        assert_eq!(bench.pixels().srgb, before.srgb, "nothing half done after {calls} calls");
    }
    assert_eq!(calls, 3, "two of six layers and shadows in sevenths of all");
    let mut fresh = Bench::new(bench.scene);
    fresh.view.shadows = true;
    fresh.render();
    assert_eq!(
        bench.preview.read_back(&CONTEXT.device, &CONTEXT.queue).expect("pixels").srgb,
        fresh.pixels().srgb,
        "to the last bit"
    );
}

#[test]
fn previews_that_share_passes_draw_the_same() {
    let passes = SharedPasses::new(&CONTEXT.device);
    let [first, second] = [0, 1].map(|_| {
        let preview = Preview::sharing(&CONTEXT.device, &passes);
        let mut bench = Bench { preview, ..Bench::new(scene()) };
        bench.render();
        bench.pixels().srgb
    });
    let mut own = Bench::new(scene());
    own.render();
    assert_eq!((&first, &second), (&own.pixels().srgb, &own.pixels().srgb), "to the last bit");
}

#[test]
fn more_lights_than_a_batch_add_up() {
    let mut bench = Bench::new(scene());
    bench.scene.lights.truncate(1);
    bench.render();
    let one = bench.pixels();
    bench.scene.lights = (0..11)
        .map(|i| Light {
            name: format!("{i}"),
            position: DVec3::new(-1.0, 1e-5 * f64::from(i), 2.0),
            ..bench.scene.lights[0].clone()
        })
        .collect();
    bench.check_cost("ten more", Stats { layers: 10, ..COMPOSITE });
    let peak = 11.0 * one.radiance.iter().fold(0.0_f32, |peak, rgb| peak.max(rgb[0]));
    for (one, eleven) in one.radiance.iter().zip(&bench.pixels().radiance) {
        let (expected, found) = (11.0 * one[0], eleven[0]);
        assert!((found - expected).abs() <= 1e-3 * peak, "{found} is not {expected}");
    }
}
