//! The GPU's picture is the CPU's.

use std::fmt;
use std::path::Path;

use glam::DVec3;
use softbox::gpu::{Display, View, picture};
use softbox::render::{Film, Geometry, MethodChoice, Progress, Settings, Shadows, Thing, lobe_of, render};
use softbox::scene::{self, Scene};
use softbox::shading::Method;

use crate::CONTEXT;

pub(crate) const SIZE: [u32; 2] = [240, 135];

/// Worst differences between two pictures as shares of the peak, and how much they cover.
#[derive(Default)]
struct Difference {
    /// Of pixels whose neighbours all show the same smooth piece of surface.
    interior: f64,
    /// Where `interior` is.
    at: [u32; 2],
    /// Share of the pixels whose neighbours show something else.
    edges: f64,
    /// Share of the edge pixels that differ by more than `interior` may.
    crossed: f64,
    /// Greatest difference of an 8-bit channel in the interior.
    levels: u8,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { interior, at: [x, y], edges, crossed, levels } = self;
        let (edges, crossed) = (100.0 * edges, 100.0 * crossed);
        write!(
            f,
            "worst {interior:.2e} of the peak at {x}, {y} and {levels} levels; {edges:.1} % edge pixels, {crossed:.2} % of them differ"
        )
    }
}

/// The most that an interior pixel may differ, as a share of the peak.
const TOLERANCE: f64 = 1.0 / 1024.0;
/// The most edge pixels that may differ by more, as a share of them: f32 decides a few rays otherwise.
const CROSSED: f64 = 0.02;

/// As [`TOLERANCE`], where the GPU has a cluster in place of a closed form: for Blinn's and for Cook and Torrance's lobes.
const CLUSTERED: f64 = 0.05;

#[track_caller]
fn check(name: &str, scene: &Scene, method: Method) {
    let clustered = !method.takes_any_lobe() && scene.materials.iter().any(|material| !lobe_of(material).is_cosine());
    let tolerance = if clustered { CLUSTERED } else { TOLERANCE };
    let difference = difference(scene, method, tolerance);
    println!("{name}, {method}: {difference}");
    assert!(difference.interior <= tolerance, "{name}, {method}: {difference}");
    assert!(clustered || difference.levels <= 1, "{name}, {method}: {difference}");
    assert!(difference.crossed <= CROSSED, "{name}, {method}: {difference}");
}

fn difference(scene: &Scene, method: Method, tolerance: f64) -> Difference {
    let settings = Settings { size: SIZE, choice: MethodChoice::Method(method), samples: 1, shadows: Shadows::None };
    let film = render(scene, &settings, &Progress::default()).expect("nobody cancels");
    let pixels = picture(&CONTEXT, scene, &bare_view(scene, method)).expect("the picture comes back");
    compare(scene, &film, &pixels.radiance, &pixels.srgb, tolerance)
}

/// Through the scene's own camera, without shadows.
fn bare_view(scene: &Scene, method: Method) -> View {
    View {
        camera: scene.camera,
        size: SIZE,
        method,
        exposure_ev: scene.display.exposure_ev,
        show_emitters: true,
        shadows: false,
        refine: false,
        display: Display::Picture,
    }
}

fn compare(scene: &Scene, film: &Film, radiance: &[[f32; 3]], srgb: &[[u8; 4]], tolerance: f64) -> Difference {
    let seen = Seen::new(scene);
    let on_surface = |index: usize| matches!(seen.0[index], Some((Thing::Surface(_), _)));
    let peak = (0..radiance.len())
        .filter(|index| on_surface(*index))
        .map(|index| film.radiance()[index].max_element())
        .fold(f64::MIN_POSITIVE, f64::max);
    let mut difference = Difference::default();
    let (mut edges, mut crossed) = (0.0, 0.0);
    for (index, (cpu, gpu)) in film.radiance().iter().zip(radiance).enumerate() {
        let gpu = DVec3::from_array(gpu.map(f64::from));
        let scale = if on_surface(index) { peak } else { peak.max(cpu.max_element()) };
        let error = (gpu - cpu).abs().max_element() / scale;
        assert!(error.is_finite(), "pixel {index} is {gpu}");
        if seen.is_edge(index) {
            edges += 1.0;
            crossed += f64::from(error > tolerance);
        } else {
            let levels = film.srgb()[index].iter().zip(&srgb[index]).map(|(a, b)| a.abs_diff(*b));
            difference.levels = levels.fold(difference.levels, u8::max);
            if error > difference.interior {
                difference.interior = error;
                difference.at = Seen::place(index);
            }
        }
    }
    difference.edges = edges / radiance.len() as f64;
    difference.crossed = if edges > 0.0 { crossed / edges } else { 0.0 };
    difference
}

/// What each pixel's centre shows, and its normal.
pub(crate) struct Seen(Vec<Option<(Thing, DVec3)>>);

impl Seen {
    pub(crate) fn new(scene: &Scene) -> Self {
        let geometry = Geometry::new(scene);
        let [width, height] = SIZE.map(f64::from);
        let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (f64::from(x) + 0.5, f64::from(y) + 0.5)));
        let seen = pixels.map(|(x, y)| {
            let seen = geometry.nearest(scene.camera.eye, scene.camera.ray_direction(x, y, width, height))?;
            Some((seen.thing, seen.n))
        });
        Self(seen.collect())
    }

    fn place(index: usize) -> [u32; 2] {
        let width = SIZE[0] as usize;
        [index % width, index / width].map(|x| u32::try_from(x).expect("a picture is small"))
    }

    /// Whether a neighbour shows another thing, or a normal more than 60° away.
    pub(crate) fn is_edge(&self, index: usize) -> bool {
        let [x, y] = Self::place(index);
        let ys = y.saturating_sub(1)..=(y + 1).min(SIZE[1] - 1);
        let mut neighbours = ys.flat_map(|y| (x.saturating_sub(1)..=(x + 1).min(SIZE[0] - 1)).map(move |x| (x, y)));
        neighbours.any(|(x, y)| match (self.0[index], self.0[(y * SIZE[0] + x) as usize]) {
            (Some((thing, n)), Some((other, m))) => thing != other || n.dot(m) < 0.5,
            (None, None) => false,
            _ => true,
        })
    }
}

#[test]
fn every_primitive_and_light_looks_the_same() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/everything.toml");
    let scene = scene::load(&path).expect("the scene loads");
    let methods = [
        "exact",
        "chebyshev",
        "nearest-point",
        "hermite-1",
        "hermite-2",
        "one-shot",
        "one-shot-square",
        "one-shot-sized",
        "point-cluster",
        "fit-4",
        "point",
    ];
    for method in methods {
        check("everything", &scene, method.parse().expect("a method"));
    }
}

/// Every third light reaches half of the surfaces, another third the other half: parts of batches, meshes too.
#[test]
fn linked_lights_look_the_same_and_not_as_lights_that_reach_everything() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/everything.toml");
    let mut scene = scene::load(&path).expect("the scene loads");
    let whole = picture(&CONTEXT, &scene, &bare_view(&scene, Method::Exact)).expect("the picture comes back");
    let names: Vec<_> = scene.surfaces.iter().map(|surface| surface.name.clone()).collect();
    for (i, light) in scene.lights.iter_mut().enumerate().filter(|(i, _)| i % 3 < 2) {
        light.only = Some(names.iter().skip(i % 3).step_by(2).cloned().collect());
    }
    check("linked", &scene, Method::Exact);
    let linked = picture(&CONTEXT, &scene, &bare_view(&scene, Method::Exact)).expect("the picture comes back");
    let changed = whole.srgb.iter().zip(&linked.srgb).filter(|(a, b)| a != b).count();
    assert!(4 * changed > whole.srgb.len(), "links darken what they leave out: {changed} pixels");
}

#[test]
fn every_model_of_reflection_looks_the_same() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reflections.toml");
    let scene = scene::load(&path).expect("the scene loads");
    for method in ["exact", "one-shot", "one-shot-sized", "point-cluster", "point"] {
        check("reflections", &scene, method.parse().expect("a method"));
    }
}

#[test]
fn disks_caps_and_skies_look_the_same() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/terrace.toml");
    let scene = scene::load(&path).expect("the scene loads");
    for method in ["exact", "hermite-1", "hermite-2", "point-cluster", "fit-3", "point"] {
        check("terrace", &scene, method.parse().expect("a method"));
    }
}

#[test]
fn every_preset_scene_looks_the_same() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/scenes");
    let mut paths: Vec<_> =
        folder.read_dir().expect("there are presets").map(|entry| entry.expect("a preset").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(!paths.is_empty(), "there are preset scenes");
    for path in paths {
        let scene = scene::load(&path).expect("the preset loads");
        check(&path.file_stem().expect("a name").to_string_lossy(), &scene, Method::Exact);
    }
}

/// A file with all of its planes different, at uneven angles, bright towards C = 135.
fn web() -> Vec<u8> {
    let mut file = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 9 7 1 2 0 0 0\n1 1 0\n".to_owned();
    file += "0 5 10 17.5 30 45 75 120 180\n0 30 90 135 200 270 360\n";
    for level in [1, 2, 3, 6, 4, 2, 1] {
        file +=
            &[9, 8, 3 + level, 9 * level, 5 * level, 2 * level, level, 1, 0].map(|value| value.to_string()).join(" ");
        file += "\n";
    }
    file.into_bytes()
}

#[test]
fn a_point_light_with_measured_intensities_looks_the_same_and_as_it_is_turned() {
    let text = r#"
format = 1
camera = { eye = [0.0, -5.0, 2.5], target = [0.0, 0.0, 0.5], fov_deg = 45.0 }
material = [{ name = "satin", diffuse = [0.5, 0.5, 0.5], specular = [0.3, 0.3, 0.3], exponent = 30.0 }]
surface = [
    { name = "floor", material = "satin", shape = { plane = {} } },
    { name = "wall", material = "satin", position = [0.0, 2.0, 1.0], shape = { box = { size = [5.0, 0.2, 2.0] } } },
    { name = "ball", material = "satin", position = [0.8, 0.3, 0.5], shape = { sphere = { radius = 0.5 } } },
]

[[light]]
name = "lamp"
position = [-0.2, 0.1, 1.4]
rotation_deg = [25.0, -15.0, 40.0]
intensity = 300.0
shape = { point = { ies = "lamp.ies" } }
"#;
    let read =
        |text: &str| scene::parse_with(text, "lamp.toml", |_| Ok(web())).unwrap_or_else(|error| panic!("{error}"));
    let scene = read(text);
    check("web", &scene, Method::Exact);
    let settings =
        Settings { size: SIZE, choice: MethodChoice::Method(Method::Exact), samples: 1, shadows: Shadows::None };
    for (error, wrong) in [
        ("turned by half a degree", text.replace("25.0, -15.0, 40.0", "25.0, -15.0, 40.5")),
        ("the same all around", text.replace("{ ies = \"lamp.ies\" }", "{}")),
    ] {
        let film = render(&read(&wrong), &settings, &Progress::default()).expect("nobody cancels");
        let pixels = picture(&CONTEXT, &scene, &bare_view(&scene, Method::Exact)).expect("the picture comes back");
        let difference = compare(&scene, &film, &pixels.radiance, &pixels.srgb, TOLERANCE);
        assert!(difference.interior > 2.0 * TOLERANCE, "{error} is not seen: {difference}");
    }
}
