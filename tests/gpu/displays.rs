//! What pictures show of radiance and illuminance: side by side, differences, illuminance and bands, against the CPU.

use std::path::Path;

use softbox::analysis::{Comparison, error_map};
use softbox::gpu::{Display, Pixels, Preview, Stats, View, picture, quantile};
use softbox::light::luminance_of;
use softbox::render::false_colour::{NOTHING, Scale, bands, diverging, sequential};
use softbox::render::{MethodChoice, Progress, Reflection, Shadows, Thing, prepare};
use softbox::scene::{self, Scene};
use softbox::shading::Method;

use crate::CONTEXT;
use crate::agreement::{SIZE, Seen};

/// Levels by which a channel of a false colour may differ where the numbers are a thousandth of the scale apart.
const LEVELS: u8 = 3;

fn scene() -> Scene {
    scene::load(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/everything.toml").as_path())
        .expect("the scene loads")
}

fn view(scene: &Scene, method: Method, display: Display) -> View {
    View {
        camera: scene.camera,
        size: SIZE,
        method,
        exposure_ev: scene.display.exposure_ev,
        show_emitters: true,
        shadows: false,
        refine: false,
        display,
    }
}

fn shown(scene: &Scene, method: Method, display: Display) -> Pixels {
    picture(&CONTEXT, scene, &view(scene, method, display)).expect("the picture comes back")
}

/// Luminance and illuminance at the pixels' centres, by the CPU; none where no surface is seen.
fn numbers(scene: &Scene, method: Method) -> Vec<Option<[f64; 2]>> {
    let (geometry, lighting) = prepare(scene, MethodChoice::Method(method), Shadows::None);
    let reflections: Vec<_> = scene.materials.iter().map(Reflection::new).collect();
    let [width, height] = SIZE.map(f64::from);
    let number = |x: u32, y: u32| {
        let direction = scene.camera.ray_direction(f64::from(x) + 0.5, f64::from(y) + 0.5, width, height);
        let seen = geometry.nearest(scene.camera.eye, direction)?;
        let Thing::Surface(surface) = seen.thing else { return None };
        let outgoing =
            lighting.outgoing_on(surface, &reflections[geometry.material(surface)?], &seen.shading_point(direction));
        Some([luminance_of(outgoing.radiance), luminance_of(outgoing.irradiance)])
    };
    (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| (x, y))).map(|(x, y)| number(x, y)).collect()
}

/// Holds a picture's colours against those that the CPU expects, away from edges; how many pixels were held.
#[track_caller]
fn check_colors(scene: &Scene, pixels: &Pixels, expected: impl Fn(usize) -> Option<[u8; 3]>) -> usize {
    let seen = Seen::new(scene);
    let mut held = 0;
    for (index, found) in pixels.srgb.iter().enumerate().filter(|(index, _)| !seen.is_edge(*index)) {
        let Some(color) = expected(index) else { continue };
        let levels = color.iter().zip(found).map(|(a, b)| a.abs_diff(*b)).max().unwrap_or_default();
        let at = (index % SIZE[0] as usize, index / SIZE[0] as usize);
        assert!(levels <= LEVELS, "{found:?} is not {color:?} at {at:?}");
        held += 1;
    }
    held
}

/// Most of the picture has to be held.
const MOST: usize = (SIZE[0] * SIZE[1] / 2) as usize;

#[test]
fn a_difference_has_the_colours_of_the_command_lines_map() {
    let scene = scene();
    let comparison = Comparison {
        of: MethodChoice::Method(Method::Point),
        against: MethodChoice::Method(Method::Exact),
        size: SIZE,
        samples: 1,
        shadows: Shadows::None,
    };
    let map = error_map(&scene, &comparison, &Progress::default()).expect("nobody cancels");
    let end = 2.0 * map.summary().rms;
    let display = Display::Difference { against: Method::Exact, relative: false, end };
    let pixels = shown(&scene, Method::Point, display);
    let color = |value: Option<f64>| value.map_or(NOTHING, |value| diverging(value / end));
    let expected: Vec<_> = map.luminance().map(color).collect();
    let held = check_colors(&scene, &pixels, |index| Some(expected[index]));
    assert!(held > MOST, "{held} pixels held");
    // The other way round, what was too dark is too bright.
    let other_way = shown(&scene, Method::Exact, Display::Difference { against: Method::Point, relative: false, end });
    let expected: Vec<_> = map.luminance().map(|value| color(value.map(|value| -value))).collect();
    check_colors(&scene, &other_way, |index| Some(expected[index]));
    let hued = |[r, _, b, _]: [u8; 4]| r.abs_diff(b) > 60;
    let turned = |(a, b): (&[u8; 4], &[u8; 4])| hued(*a) && hued(*b) && (a[0] > a[2]) != (b[0] > b[2]);
    let turned = pixels.srgb.iter().zip(&other_way.srgb).filter(|pair| turned(*pair)).count();
    assert!(turned > MOST / 20, "{turned} pixels change sign");
}

#[test]
fn a_relative_difference_is_a_share_of_the_other_method() {
    let scene = scene();
    let [point, exact] = [Method::Point, Method::Exact].map(|method| numbers(&scene, method));
    let display = Display::Difference { against: Method::Exact, relative: true, end: 0.5 };
    let pixels = shown(&scene, Method::Point, display);
    let peak = exact.iter().flatten().map(|number| number[0]).fold(0.0, f64::max);
    let expected = |index: usize| match (point[index], exact[index]) {
        // Where there is hardly any light, so do shares of it.
        (Some([a, _]), Some([b, _])) => (b > 0.05 * peak).then(|| diverging((a - b) / b / 0.5)),
        _ => Some(NOTHING),
    };
    let held = check_colors(&scene, &pixels, expected);
    assert!(held > MOST / 2, "{held} pixels held");
}

#[test]
fn illuminance_is_the_cpus_and_has_its_colours() {
    let scene = scene();
    let numbers = numbers(&scene, Method::Exact);
    let peak = numbers.iter().flatten().map(|number| number[1]).fold(0.0, f64::max);
    for logarithmic in [false, true] {
        let scale = Scale { end: peak, logarithmic };
        let pixels = shown(&scene, Method::Exact, Display::Illuminance { scale, isolines: false });
        let seen = Seen::new(&scene);
        for (index, found) in pixels.illuminance.iter().enumerate().filter(|(index, _)| !seen.is_edge(*index)) {
            let (expected, found) = (numbers[index].map_or(0.0, |n| n[1]), found.map_or(0.0, f64::from));
            assert!((found - expected).abs() <= 1e-3 * peak, "{found} lx is not {expected} lx at pixel {index}");
        }
        // On three decades, a small number is known less well than its colour tells.
        let least = if logarithmic { 0.1 * peak } else { 0.0 };
        let expected = |index: usize| match numbers[index] {
            Some([_, illuminance]) => (illuminance >= least).then(|| sequential(scale.share(illuminance))),
            None => Some(NOTHING),
        };
        let held = check_colors(&scene, &pixels, expected);
        assert!(held > MOST / 2, "{held} pixels held");
    }
}

#[test]
fn isolines_are_where_the_illuminance_passes_a_level() {
    let scene = scene();
    let plain = shown(&scene, Method::Exact, Display::Picture);
    let peak = plain.illuminance.iter().flatten().fold(0.0_f32, |peak, e| peak.max(*e));
    let scale = Scale { end: f64::from(peak), logarithmic: false };
    let [bare, lined] =
        [false, true].map(|isolines| shown(&scene, Method::Exact, Display::Illuminance { scale, isolines }));
    let seen = Seen::new(&scene);
    let width = SIZE[0] as usize;
    let (mut on, mut off) = (0, 0);
    for index in (0..plain.illuminance.len()).filter(|index| !seen.is_edge(*index)) {
        let at = |i: usize| plain.illuminance.get(i).copied().flatten().map(f64::from);
        let beside = [index.wrapping_sub(1), index + 1, index.wrapping_sub(width), index + width].map(at);
        let ([Some(left), Some(right), Some(above), Some(below)], Some(here)) = (beside, at(index)) else { continue };
        let inside = !index.is_multiple_of(width) && !(index + 1).is_multiple_of(width);
        let slope = (0.5 * (right - left)).hypot(0.5 * (below - above));
        let nearest = scale.levels().into_iter().map(|level| (level - here).abs()).fold(f64::MAX, f64::min);
        let drawn = bare.srgb[index] != lined.srgb[index];
        if inside && nearest < 0.8 * slope {
            assert!(drawn, "no line at pixel {index}, {here} lx, {slope} lx a pixel");
            on += 1;
        } else if inside && nearest > 1.5 * slope {
            assert!(!drawn, "a line at pixel {index}, {here} lx, {slope} lx a pixel");
            off += 1;
        }
    }
    assert!(on > 500 && off > 5000, "{on} pixels on lines, {off} off");
}

#[test]
fn bands_say_where_a_point_light_would_do() {
    let scene = scene();
    let [point, exact] = [Method::Point, Method::Exact].map(|method| numbers(&scene, method));
    let peak = exact.iter().flatten().map(|number| number[1]).fold(0.0, f64::max);
    for illuminance in [false, true] {
        let pixels = shown(&scene, Method::Point, Display::Bands { against: Method::Exact, illuminance });
        let which = usize::from(illuminance);
        let mut counts = [0; 4];
        let seen = Seen::new(&scene);
        let width = SIZE[0] as usize;
        let share = |index: usize| match (point.get(index)?, exact.get(index)?) {
            (Some(a), Some(b)) if b[1] > 0.02 * peak => Some((a[which] - b[which]).abs() / b[which]),
            _ => None,
        };
        let band = |share: f64| [0.01, 0.05, 0.1].iter().filter(|limit| share > **limit).count();
        // A number near a limit may fall on either side, and the lines between bands are darker.
        let is_near = |share: f64| [0.01, 0.05, 0.1].iter().any(|limit| (share - limit).abs() < 0.02 * limit + 1e-3);
        for index in (0..pixels.srgb.len()).filter(|index| !seen.is_edge(*index)) {
            let Some(here) = share(index).filter(|share| !is_near(*share)) else { continue };
            let beside = [index + 1, index + width].map(|i| share(i).map(band));
            if beside.iter().any(|other| *other != Some(band(here))) {
                continue;
            }
            let [r, g, b, _] = pixels.srgb[index];
            assert_eq!([r, g, b], bands()[band(here)], "{here} at pixel {index}");
            counts[band(here)] += 1;
        }
        println!("illuminance {illuminance}: {counts:?} pixels within each band");
        assert!(counts.iter().all(|count| *count > 50), "every band is there: {counts:?}");
    }
}

#[test]
fn a_split_shows_each_method_on_its_side() {
    let scene = scene();
    let split = shown(&scene, Method::Exact, Display::Split { against: Method::Point, at: 0.25 });
    let [exact, point] = [Method::Exact, Method::Point].map(|method| shown(&scene, method, Display::Picture));
    assert_ne!(exact.srgb, point.srgb, "the methods differ");
    for (index, found) in split.srgb.iter().enumerate() {
        let is_left = (index % SIZE[0] as usize) < SIZE[0] as usize / 4;
        let side = if is_left { &exact } else { &point };
        assert_eq!(*found, side.srgb[index], "pixel {index}");
    }
}

#[test]
fn comparing_shades_only_what_the_other_method_adds_and_looking_otherwise_nothing() {
    let scene = scene();
    let mut preview = Preview::new(&CONTEXT.device);
    let mut cost = |method: Method, display: Display| {
        let before = preview.stats();
        preview.render(
            &CONTEXT.device,
            &CONTEXT.queue,
            &scene,
            &View { shadows: true, ..view(&scene, method, display) },
        );
        let after = preview.stats();
        Stats {
            g_buffers: after.g_buffers - before.g_buffers,
            layers: after.layers - before.layers,
            shadows: after.shadows - before.shadows,
            composites: after.composites - before.composites,
        }
    };
    let scale = Scale { end: 100.0, logarithmic: false };
    let against = Method::Point;
    cost(Method::Exact, Display::Picture);
    let illuminance = cost(Method::Exact, Display::Illuminance { scale, isolines: true });
    assert_eq!((illuminance.g_buffers, illuminance.layers), (0, 0), "illuminance is there already");
    let split = cost(Method::Exact, Display::Split { against, at: 0.5 });
    assert_eq!((split.g_buffers, split.composites), (0, 2), "two sums");
    assert!(split.layers > 0, "the other method's layers");
    while cost(Method::Exact, Display::Split { against, at: 0.5 }) != Stats::default() {}
    for (what, display) in [
        ("the divider", Display::Split { against, at: 0.7 }),
        ("a difference", Display::Difference { against, relative: false, end: 10.0 }),
        ("its scale", Display::Difference { against, relative: false, end: 20.0 }),
        ("its unit", Display::Difference { against, relative: true, end: 0.2 }),
        ("bands", Display::Bands { against, illuminance: true }),
    ] {
        assert_eq!(cost(Method::Exact, display), Stats::default(), "{what}");
    }
}

#[test]
fn a_survey_has_the_pictures_numbers() {
    let scene = scene();
    let mut preview = Preview::new(&CONTEXT.device);
    let display = Display::Split { against: Method::Point, at: 0.5 };
    preview.render(&CONTEXT.device, &CONTEXT.queue, &scene, &view(&scene, Method::Exact, display));
    assert!(!preview.is_surveying(), "none was asked for");
    preview.start_survey(&CONTEXT.device, &CONTEXT.queue);
    CONTEXT.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    let survey = preview.take_survey().expect("the survey is done");
    assert_eq!(preview.take_survey(), None, "once");
    let [exact, point] = [Method::Exact, Method::Point].map(|method| numbers(&scene, method));
    let close = |found: Option<f64>, numbers: &[Option<[f64; 2]>], which: usize| {
        let expected = quantile(numbers.iter().flatten().map(|number| number[which]), 0.9);
        let (found, expected) = (found.expect("there are places"), expected.expect("there are pixels"));
        assert!((found / expected - 1.0).abs() < 0.1, "{found} is not {expected}");
    };
    close(quantile(survey.luminances(), 0.9), &exact, 0);
    close(quantile(survey.illuminances(), 0.9), &exact, 1);
    close(quantile(survey.compared_luminances().map(|pair| pair[1]), 0.9), &point, 0);
    close(quantile(survey.compared_illuminances().map(|pair| pair[1]), 0.9), &point, 1);
    let share = survey.luminances().count() as f64 / (96.0 * 64.0);
    let covered = exact.iter().flatten().count() as f64 / exact.len() as f64;
    assert!((share - covered).abs() < 0.05, "{share} of the places show a surface, {covered} of the pixels");
}

#[test]
fn nothing_is_read_back_of_no_picture() {
    let preview = Preview::new(&CONTEXT.device);
    let error = preview.read_back(&CONTEXT.device, &CONTEXT.queue).expect_err("there is no picture");
    assert_eq!(error.to_string(), "there is no picture yet", "the reason");
}
