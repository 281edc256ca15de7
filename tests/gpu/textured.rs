//! Textured lights in the preview: their layers reach the core's values, by stages, and then rest.

use std::io::Cursor;

use glam::DVec3;
use image::{ImageBuffer, ImageFormat, Luma, Rgb};
use softbox::gpu::{Display, Preview, View, picture};
use softbox::render::{Geometry, MethodChoice, Progress, Settings, Shadows, Thing, render};
use softbox::scene::{self, Scene};
use softbox::shading::Method;

use crate::CONTEXT;

const SIZE: [u32; 2] = [72, 48];

/// A pattern over a floor, before a wall that its plane cuts; a ball that shines.
const SCENE: &str = r#"
format = 1
camera = { eye = [0.5, -4.0, 1.6], target = [0.0, 0.3, 0.7], fov_deg = 42.0 }
material = [
    { name = "matt", diffuse = [0.6, 0.5, 0.4], specular = [0.0, 0.0, 0.0], exponent = 1.0 },
    { name = "satin", diffuse = [0.2, 0.2, 0.2], specular = [0.4, 0.4, 0.4], exponent = 25.0 },
    { name = "gloss", diffuse = [0.1, 0.1, 0.1], specular = [0.8, 0.8, 0.8], exponent = 400.0 },
]
surface = [
    { name = "floor", material = "gloss", shape = { plane = {} } },
    { name = "wall", material = "matt", position = [0.0, 1.5, 1.0], shape = { box = { size = [4.0, 0.2, 2.0] } } },
    { name = "ball", material = "satin", position = [0.9, 0.2, 0.4], shape = { sphere = { radius = 0.4 } } },
]

[[light]]
name = "screen"
position = [-0.6, 0.4, 0.7]
rotation_deg = [-30.0, -50.0, 10.0]
luminance = 300.0
shape = { textured = { size = [1.2, 0.9], pattern = "screen.png", two_sided = TWO_SIDED } }
"#;

fn scene_of(pattern: &[u8], two_sided: bool) -> Scene {
    let text = SCENE.replace("TWO_SIDED", &two_sided.to_string());
    scene::parse_with(&text, "screen.toml", |_| Ok(pattern.to_vec())).unwrap_or_else(|error| panic!("{error}"))
}

fn encoded(picture: impl Into<image::DynamicImage>) -> Vec<u8> {
    let mut bytes = Vec::new();
    picture.into().write_to(&mut Cursor::new(&mut bytes), ImageFormat::Png).expect("it can be written");
    bytes
}

/// Stripes, a black frame and a black disk.
fn stripes(side: u32) -> Vec<u8> {
    encoded(ImageBuffer::from_fn(side, side, |x, y| {
        let (u, v) = (f64::from(x) / f64::from(side), f64::from(y) / f64::from(side));
        let is_black = (u - 0.5).hypot(v - 0.5) < 0.2 || !(0.1..0.9).contains(&u);
        Luma([if is_black {
            0_u8
        } else if (8.0 * v).fract() < 0.5 {
            255
        } else {
            120
        }])
    }))
}

fn view(scene: &Scene) -> View {
    View {
        camera: scene.camera,
        size: SIZE,
        method: Method::Exact,
        exposure_ev: 0.0,
        show_emitters: true,
        shadows: false,
        refine: false,
        display: Display::Picture,
    }
}

/// The worst difference of a pixel that shows a surface, as do its neighbours, as a share of the peak; and the share of
/// the pixels that show the light, and differ.
fn difference(scene: &Scene) -> (f64, f64) {
    let settings =
        Settings { size: SIZE, choice: MethodChoice::Method(Method::Exact), samples: 1, shadows: Shadows::None };
    let film = render(scene, &settings, &Progress::default()).expect("nobody cancels");
    let pixels = picture(&CONTEXT, scene, &view(scene)).expect("the picture comes back");
    let geometry = Geometry::new(scene);
    let [width, height] = SIZE.map(f64::from);
    let seen = |x: f64, y: f64| geometry.nearest(scene.camera.eye, scene.camera.ray_direction(x, y, width, height));
    let (mut worst, mut peak, mut shown, mut wrong) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for (index, (cpu, gpu)) in (0..).zip(film.radiance().iter().zip(&pixels.radiance)) {
        let (x, y) = (f64::from(index % SIZE[0]) + 0.5, f64::from(index / SIZE[0]) + 0.5);
        let error = (DVec3::from_array(gpu.map(f64::from)) - cpu).abs().max_element();
        let things: Vec<_> = [(0.0, 0.0), (0.7, 0.0), (-0.7, 0.0), (0.0, 0.7), (0.0, -0.7)]
            .iter()
            .map(|(dx, dy)| seen(x + dx, y + dy).map(|seen| seen.thing))
            .collect();
        match things[0] {
            Some(Thing::Surface(_)) if things.iter().all(|thing| *thing == things[0]) => {
                worst = worst.max(error);
                peak = peak.max(cpu.max_element());
            }
            Some(Thing::Light(_)) => {
                shown += 1.0;
                wrong += f64::from(u8::from(error > 1e-5 * cpu.max_element()));
            }
            _ => {}
        }
    }
    assert!(shown > 30.0, "the light is seen in {shown} pixels");
    (worst / peak, wrong / shown)
}

#[test]
fn a_textured_light_looks_the_same() {
    let level = |of: u32| u8::try_from(of).expect("at most 200");
    let color = ImageBuffer::from_fn(5, 4, |x, y| Rgb([level(40 * x), level(60 * y), level(200 - 40 * x)]));
    for (name, pattern, two_sided) in [
        ("one texel", encoded(ImageBuffer::from_pixel(1, 1, Luma([200_u8]))), false),
        ("colour", encoded(color), true),
        ("stripes", stripes(64), false),
        ("fine stripes", stripes(600), true),
    ] {
        let (worst, wrong) = difference(&scene_of(&pattern, two_sided));
        println!("{name}: surfaces within {worst:.1e} of the peak, {wrong:.4} of the light's pixels differ");
        assert!(worst <= 1.0 / 1024.0, "{name}: {worst:e} of the peak");
        assert!(wrong <= 0.02, "{name}: {wrong} of the light's pixels");
    }
}

#[test]
fn its_layer_is_made_by_stages_and_then_rests() {
    let scene = scene_of(&stripes(32), false);
    let mut preview = Preview::new(&CONTEXT.device);
    let mut layers = Vec::new();
    let mut render = |preview: &mut Preview, scene: &Scene| {
        preview.render(&CONTEXT.device, &CONTEXT.queue, scene, &view(scene));
        layers.push(preview.stats().layers);
        preview.is_refined()
    };
    let refined: Vec<bool> = (0..5).map(|_| render(&mut preview, &scene)).collect();
    let mut moved = scene.clone();
    moved.lights[0].position.x += 0.1;
    let again: Vec<bool> = (0..4).map(|_| render(&mut preview, &moved)).collect();
    assert_eq!(refined, [false, false, true, true, true], "three stages");
    assert_eq!(again, [false, false, true, true], "and again where it changed");
    assert_eq!(layers, [1, 2, 3, 3, 3, 4, 5, 6, 6], "and nothing else");
}
