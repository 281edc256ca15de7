//! Shadows: the GPU's rays tend to the CPU's shadows, and follow change.

use std::path::Path;

use glam::DVec3;
use softbox::gpu::{Display, Pixels, Preview, Stats, View};
use softbox::render::{Film, MethodChoice, Progress, Settings, Shadows, render};
use softbox::scene::{self, Scene};
use softbox::shading::Method;

use crate::CONTEXT;
use crate::agreement::{SIZE, Seen};

fn view(scene: &Scene) -> View {
    View {
        camera: scene.camera,
        size: SIZE,
        method: Method::Exact,
        exposure_ev: scene.display.exposure_ev,
        show_emitters: true,
        shadows: true,
        refine: false,
        display: Display::Picture,
    }
}

fn on_cpu(scene: &Scene, shadows: Shadows) -> Film {
    let settings = Settings { size: SIZE, choice: MethodChoice::Method(Method::Exact), samples: 1, shadows };
    render(scene, &settings, &Progress::default()).expect("nobody cancels")
}

/// The picture after as many rays as there are through the pixels' centres.
fn on_gpu(scene: &Scene, view: &View) -> Pixels {
    let mut preview = Preview::new(&CONTEXT.device);
    while {
        preview.render(&CONTEXT.device, &CONTEXT.queue, scene, view);
        !preview.is_refined()
    } {}
    preview.read_back(&CONTEXT.device, &CONTEXT.queue).expect("the picture comes back")
}

/// How far pixels differ whose neighbours all show the same smooth piece of surface.
#[derive(Debug)]
struct Difference {
    /// Root of the mean square of 8-bit channels.
    levels: f64,
    /// Mean difference of radiance as a share of the mean.
    bias: f64,
}

fn difference(scene: &Scene, cpu: &Film, gpu: &Pixels) -> Difference {
    let seen = Seen::new(scene);
    let interior: Vec<_> = (0..gpu.srgb.len()).filter(|index| !seen.is_edge(*index)).collect();
    let mut squares = 0.0;
    let (mut sum, mut whole) = (DVec3::ZERO, DVec3::ZERO);
    for &index in &interior {
        let levels = |channel: usize| f64::from(cpu.srgb()[index][channel]) - f64::from(gpu.srgb[index][channel]);
        let levels = [0, 1, 2].map(levels);
        squares += levels.iter().map(|x| x * x).sum::<f64>() / 3.0;
        sum += DVec3::from(gpu.radiance[index].map(f64::from)) - cpu.radiance()[index];
        whole += cpu.radiance()[index];
    }
    let count = interior.len() as f64;
    Difference { levels: (squares / count).sqrt(), bias: sum.element_sum() / whole.element_sum() }
}

/// As many levels may a picture differ, root mean square, by 16 rays to a light of some area.
const NOISE: f64 = 4.0;
/// As far may the mean of a picture be off, as a share of it.
const BIAS: f64 = 5e-4;

fn is_within(difference: &Difference) -> bool {
    difference.levels <= NOISE && difference.bias.abs() <= BIAS
}

#[test]
fn shadows_of_every_preset_scene_look_the_same() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/scenes");
    let mut paths: Vec<_> =
        folder.read_dir().expect("there are presets").map(|entry| entry.expect("a preset").path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    assert!(!paths.is_empty(), "there are preset scenes");
    let mut worst = Vec::new();
    for path in paths {
        let scene = scene::load(&path).expect("the preset loads");
        let difference = difference(&scene, &on_cpu(&scene, Shadows::default()), &on_gpu(&scene, &view(&scene)));
        println!("{}: {difference:.4?}", path.display());
        if !is_within(&difference) {
            worst.push((path, difference));
        }
    }
    assert!(worst.is_empty(), "{worst:#.4?}");
}

#[test]
fn a_light_that_is_moved_by_two_centimetres_is_told_apart() {
    let scene = scene::first_light();
    let mut moved = scene.clone();
    moved.lights[0].position.x += 0.02;
    let difference = difference(&scene, &on_cpu(&scene, Shadows::default()), &on_gpu(&moved, &view(&scene)));
    println!("{difference:.4?}");
    assert!(!is_within(&difference), "{difference:?} would be seen as the same");
}

#[test]
fn more_rays_are_nearer_and_on_average_right() {
    let scene = scene::first_light();
    let cpu = on_cpu(&scene, Shadows::default());
    let view = view(&scene);
    let mut preview = Preview::new(&CONTEXT.device);
    let mut before: Option<Difference> = None;
    loop {
        preview.render(&CONTEXT.device, &CONTEXT.queue, &scene, &view);
        let pixels = preview.read_back(&CONTEXT.device, &CONTEXT.queue).expect("the picture comes back");
        let after = difference(&scene, &cpu, &pixels);
        println!("{after:.4?}");
        if let Some(before) = before {
            assert!(after.levels < 0.75 * before.levels, "twice the rays: {after:?} after {before:?}");
        }
        if preview.is_refined() {
            assert!(after.bias.abs() < 5e-4, "{after:?}");
            return;
        }
        before = Some(after);
    }
}

#[test]
fn what_sees_all_of_a_light_is_as_without_shadows_to_the_last_bit() {
    let scene = scene::first_light();
    let [without, with] = [Shadows::None, Shadows::default()].map(|shadows| on_cpu(&scene, shadows));
    let view = view(&scene);
    let gpu = on_gpu(&scene, &view);
    let bare = on_gpu(&scene, &View { shadows: false, ..view });
    let mut count = 0;
    for (index, (all, seen)) in without.radiance().iter().zip(with.radiance()).enumerate() {
        if all == seen {
            assert_eq!(gpu.radiance[index], bare.radiance[index], "pixel {index} sees all of the light");
            count += 1;
        }
    }
    assert!(count > bare.radiance.len() / 2, "only {count} pixels see all of the light");
}

#[test]
fn a_scene_of_one_plane_casts_no_rays() {
    let mut scene = scene::first_light();
    scene.surfaces.truncate(1);
    let mut preview = Preview::new(&CONTEXT.device);
    let view = View { refine: true, ..view(&scene) };
    while !preview.is_converged() {
        preview.render(&CONTEXT.device, &CONTEXT.queue, &scene, &view);
    }
    assert_eq!(preview.stats(), Stats { g_buffers: 8, layers: 8, shadows: 0, composites: 8 }, "a sample a composite");
}
