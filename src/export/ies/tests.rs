//! Files of known lights, and the way back.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::{DVec2, DVec3, dvec2};

use super::field::FAINTEST;
use super::web::{SOUGHT_ERROR, Symmetry, direction};
use super::*;
use crate::export::Options;
use crate::export::Target;
use crate::light::pattern::{Channel, Pattern};
use crate::light::photometry::lm63;
use crate::light::{
    Cap, Directional, Disk, Line, Point, Polygon, Quantity, QuantityKind, Sky, Sphere, Textured, luminance_of,
};
use crate::math::angle::angle_between;
use crate::scene::{Scene, photometry_of_bytes};
use crate::shading::{Method, PhongLobe, ShadingPoint, respond};

fn light(name: &str, shape: Shape) -> Light {
    let (position, rotation_deg) = (DVec3::new(1.0, -2.0, 3.0), DVec3::new(10.0, 20.0, 30.0));
    Light { position, rotation_deg, ..Light::new(name, shape) }
}

fn rectangle(two_sided: bool) -> Shape {
    let vertices = vec![dvec2(-1.0, -0.5), dvec2(1.0, -0.5), dvec2(1.0, 0.5), dvec2(-1.0, 0.5)];
    Shape::Polygon(Polygon { vertices, two_sided })
}

/// A letter L, whose middle of the flux is not that of its box.
fn angle() -> Shape {
    let corners = [(0.0, 0.0), (1.2, 0.0), (1.2, 0.3), (0.3, 0.3), (0.3, 0.9), (0.0, 0.9)];
    Shape::Polygon(Polygon { vertices: corners.map(|(x, y)| dvec2(x, y)).to_vec(), two_sided: false })
}

fn textured() -> Shape {
    let texels = [0.1, 0.0, 1.0, 0.3, 0.0, 0.5];
    let channel = |scale: f32| Arc::new(Channel::new(3, texels.iter().map(|t| scale * t).collect()).expect("texels"));
    let pattern = Pattern::of_image("a.png", Image::Color([channel(1.0), channel(0.5), channel(0.2)]));
    Shape::Textured(Textured { size: dvec2(0.9, 0.6), pattern, two_sided: false })
}

/// A file with different intensities on all sides, by 45°.
fn lopsided() -> Shape {
    let mut file = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 5 9 1 2 0 0 0\n1 1 0\n0 45 90 135 180\n".to_owned();
    file += "0 45 90 135 180 225 270 315 360\n";
    for plane in 0..9 {
        let level = |row: i32| f64::from(10 + (plane % 8) * row.min(4 - row));
        file += &(0..5).map(|row| level(row).to_string()).collect::<Vec<_>>().join(" ");
        file += "\n";
    }
    Shape::Point(Point { ies: Some(photometry_of_bytes("lopsided.ies", file.into_bytes()).expect("an IES file")) })
}

/// One of each shape that can be held.
fn lights() -> Vec<Light> {
    vec![
        light("rectangle", rectangle(false)),
        light("both sides", rectangle(true)),
        light("angle", angle()),
        light("disk", Shape::Disk(Disk { radius: 0.5, two_sided: false })),
        light("sphere", Shape::Sphere(Sphere { radius: 0.2 })),
        light("line", Shape::Line(Line::isotropic(1.5))),
        light("tube", Shape::Line(Line::tube(1.5, 0.013))),
        light("picture", textured()),
        light("bulb", Shape::Point(Point::default())),
        light("lopsided", lopsided()),
    ]
}

fn written(lights: &[Light]) -> Result<Exported, ExportError> {
    let scene = Scene { lights: lights.to_vec(), ..Scene::default() };
    let job = Job {
        scene: &scene,
        scene_name: "naïve.toml",
        stem: "out",
        target: Target::Ies,
        lights: None,
        surfaces: true,
        options: Options::default(),
    };
    write(&job, &Progress::default())
}

fn written_text(lights: &[Light]) -> String {
    let exported = written(lights).unwrap_or_else(|error| panic!("{error}"));
    let [file] = exported.files.as_slice() else { panic!("one file") };
    String::from_utf8(file.bytes.clone()).expect("it is ASCII")
}

/// The luminaire of some lights, and the point light that their file makes at its place.
fn read_back(lights: &[Light]) -> (Luminaire, Light) {
    let luminaire = Luminaire::new(lights).expect("they shine");
    let photometry =
        photometry_of_bytes("out.ies", written_text(lights).into_bytes()).unwrap_or_else(|wrong| panic!("{wrong}"));
    let intensity = Quantity::new(QuantityKind::Intensity, photometry.distribution.peak());
    let shape = Shape::Point(Point { ies: Some(photometry) });
    let (position, rotation_deg) = (luminaire.center, luminaire.rotation_deg);
    (luminaire, Light { position, rotation_deg, quantity: intensity, ..Light::new("file", shape) })
}

/// The illuminance of a light by its exact method, coloured parts together.
fn illuminance(lights: &[Light], at: &ShadingPoint) -> f64 {
    let lobe = PhongLobe::new(1.0);
    let parts = lights.iter().flat_map(Light::parts);
    parts.map(|(emitter, weight)| luminance_of(weight) * respond(&emitter, Method::Exact, at, &lobe).irradiance).sum()
}

/// Checks a file against the lights far away, as a share of the greatest illuminance there, and its flux.
#[track_caller]
fn check_read_back(lights: &[Light]) {
    let (luminaire, file) = read_back(lights);
    let web = Web::of(&luminaire);
    let distance = 400.0 * luminaire.radius().max(0.1);
    let mut worst = 0.0_f64;
    for i in 0..400 {
        let (c, gamma) = (360.0 * (f64::from(i) * 0.618_034).fract(), 180.0 * (f64::from(i) + 0.5) / 400.0);
        let w = crate::math::frame::rotation_from_deg(luminaire.rotation_deg) * direction(c, gamma);
        let at = ShadingPoint { p: luminaire.center + distance * w, n: -w, v: -w };
        let [exact, read] = [lights, std::slice::from_ref(&file)].map(|lights| illuminance(lights, &at));
        worst = worst.max((exact - read).abs() * distance * distance / web.peak);
    }
    let flux = file.in_quantity(QuantityKind::Flux).expect("a flux");
    let flux_error = (flux / luminaire.flux - 1.0).abs();
    let names: Vec<_> = lights.iter().map(|light| light.name.as_str()).collect();
    println!(
        "{}: {:.1e} of the peak far away, stated {:.1e}, flux {flux_error:.1e} off, {} x {} angles, {:?}",
        names.join(" + "),
        worst,
        web.error,
        web.planes.len(),
        web.gammas.len(),
        web.symmetry
    );
    assert!(worst <= 1.2 * web.error + 3e-5, "{names:?}: {worst} of the peak, stated are {}", web.error);
    assert!(flux_error <= 2e-3, "{names:?}: {flux} lm in the file, {} lm of the lights", luminaire.flux);
}

#[test]
fn a_files_light_is_the_lights_own_far_away() {
    for light in lights() {
        check_read_back(&[light]);
    }
}

#[test]
fn every_preset_light_that_has_candela_is_read_back() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/lights");
    let files = folder.read_dir().expect("there are presets").map(|entry| entry.expect("a preset").path());
    let mut presets: Vec<_> = files.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    presets.sort();
    let held = |light: &Light| what_is_lost(light).is_none();
    let mut count = 0;
    for path in presets {
        let lights = crate::scene::load(&path).expect("the preset loads").lights;
        let lights: Vec<Light> = lights.into_iter().filter(held).collect();
        if !lights.is_empty() {
            check_read_back(&lights);
            count += 1;
        }
    }
    assert!(count >= 20, "only {count} presets");
}

#[test]
fn several_lights_are_one_luminaire() {
    let [mut first, mut second] = [light("first", rectangle(false)), light("second", textured())];
    second.position.x += 1.0;
    check_read_back(&[first.clone(), second.clone()]);
    let turned = Luminaire::new(&[first.clone(), second.clone()]).expect("they shine");
    assert_eq!(turned.rotation_deg, first.rotation_deg, "as both are");
    first.rotation_deg = DVec3::new(40.0, 0.0, 0.0);
    second.rotation_deg = DVec3::new(0.0, -30.0, 0.0);
    check_read_back(&[first.clone(), second.clone()]);
    let (luminaire, _) = read_back(&[first.clone(), second.clone()]);
    assert_eq!(luminaire.rotation_deg, DVec3::ZERO, "as the world");
    let flux: f64 = [&first, &second].map(|light| light.in_quantity(QuantityKind::Flux).expect("a flux")).iter().sum();
    assert!((luminaire.flux / flux - 1.0).abs() < 1e-12, "{} lm of {flux} lm", luminaire.flux);
}

#[test]
fn planes_are_as_few_as_the_symmetry_allows() {
    let symmetry = |lights: &[Light]| Web::of(&Luminaire::new(lights).expect("they shine")).symmetry;
    let found: Vec<Symmetry> = lights().into_iter().map(|light| symmetry(&[light])).collect();
    use Symmetry::{Across, Bilateral, None, Quadrant, Rotational};
    let expected = [
        Rotational, Rotational, Rotational, Rotational, Rotational, Rotational, Quadrant, Rotational, Rotational, None,
    ];
    assert_eq!(found, expected, "each light in its own frame");
    let turned = |x: f64, y: f64| Light { rotation_deg: DVec3::new(x, y, 0.0), ..light("turned", rectangle(false)) };
    let ball = light("ball", Shape::Sphere(Sphere { radius: 0.1 }));
    let beside =
        |first: Light| symmetry(&[first, Light { rotation_deg: DVec3::ZERO, ..light("flat", rectangle(false)) }]);
    assert_eq!(beside(turned(0.0, 40.0)), Bilateral, "leaning along X");
    assert_eq!(beside(turned(40.0, 0.0)), Across, "leaning along Y");
    assert_eq!(beside(turned(40.0, 40.0)), None, "leaning anyhow");
    assert_eq!(symmetry(&[turned(0.0, 40.0), ball]), Rotational, "a ball is never turned");
}

#[test]
fn the_steps_are_fine_enough_or_the_error_says_so() {
    for light in lights() {
        let web = Web::of(&Luminaire::new(std::slice::from_ref(&light)).expect("it shines"));
        // Along a tube's axis intensity falls to 0 in a point, which is sharper than any step.
        let bound = if light.name == "tube" { 2e-3 } else { SOUGHT_ERROR };
        assert!(web.error <= bound, "{}: {} of the peak", light.name, web.error);
    }
    let leaning = Light { rotation_deg: DVec3::new(40.0, 10.0, 0.0), ..light("leaning", rectangle(false)) };
    let flat = Light { rotation_deg: DVec3::ZERO, ..light("flat", rectangle(false)) };
    let web = Web::of(&Luminaire::new(&[leaning, flat]).expect("they shine"));
    println!("a horizon askew: {:.1e} of the peak at {} x {} angles", web.error, web.planes.len(), web.gammas.len());
    assert!(web.error <= 4e-3, "{} of the peak", web.error);
}

/// The worst error of the point law at a distance, in directions of its own.
fn worst(lights: &[Light], luminaire: &Luminaire, distance: f64) -> f64 {
    let web = Web::of(luminaire);
    let directions = (0..36).flat_map(|c| (0..=36).map(move |g| direction(10.0 * f64::from(c), 5.0 * f64::from(g))));
    let errors = directions.map(|w| {
        let candela = luminaire.intensity(w);
        let w = crate::math::frame::rotation_from_deg(luminaire.rotation_deg) * w;
        let at = ShadingPoint { p: luminaire.center + distance * w, n: -w, v: -w };
        let share = illuminance(lights, &at) * distance * distance / candela - 1.0;
        if candela >= FAINTEST * web.peak { share.abs() } else { 0.0 }
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn the_file_holds_from_the_distances_that_it_states() {
    for light in lights() {
        let lights = [light];
        let luminaire = Luminaire::new(&lights).expect("it shines");
        let field = Field::of(&luminaire, &Web::of(&luminaire), &Progress::default()).expect("nobody cancels");
        let radius = luminaire.radius();
        println!("{}: radius {radius:.3} m, {}", lights[0].name, field.in_words());
        for (distance, bound) in [(field.within_1, 0.01), (field.within_5, 0.05)] {
            if distance > radius {
                let [inside, outside] = [0.97, 1.0].map(|share| worst(&lights, &luminaire, share * distance));
                assert!(outside <= 1.1 * bound, "{}: {outside} at {distance} m", lights[0].name);
                assert!(inside > bound, "{}: {inside} nearer than {distance} m", lights[0].name);
                let far = worst(&lights, &luminaire, 2.0 * distance);
                assert!(far < bound, "{}: {far} at twice {distance} m", lights[0].name);
            }
        }
    }
    // On its axis, a disk's illuminance is πL·r²/(r² + d²): 1 % off at d = r·√99.
    let disk = [light("disk", Shape::Disk(Disk { radius: 0.5, two_sided: false }))];
    let luminaire = Luminaire::new(&disk).expect("it shines");
    let axis = luminaire.illuminance(DVec3::NEG_Z, 0.5 * 99.0_f64.sqrt());
    let law = luminaire.intensity(DVec3::NEG_Z) / (0.25 * 99.0);
    assert!((axis / law - 0.99).abs() < 1e-12, "{} of the law on the axis", axis / law);
}

#[test]
fn the_opening_is_the_lights_own() {
    let opening = |light: &Light| Luminaire::new(std::slice::from_ref(light)).expect("it shines").opening();
    let lights = lights();
    let expected = [
        [1.0, 2.0, 0.0],
        [1.0, 2.0, 0.0],
        [0.9, 1.2, 0.0],
        [-1.0, -1.0, 0.0],
        [-0.4, -0.4, -0.4],
        [0.0, 1.5, 0.0],
        [-0.026, 1.5, -0.026],
        [0.6, 0.9, 0.0],
        [0.0; 3],
        [0.0; 3],
    ];
    for (light, expected) in lights.iter().zip(expected) {
        let found = opening(light);
        let same = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-12);
        assert!(same, "{}: {found:?}, not {expected:?}", light.name);
    }
    let stated = written_text(&[lights[3].clone()]);
    assert!(stated.contains(" 1 2 -1 -1 0\r\n"), "in the file: {stated}");
}

#[test]
fn what_has_no_candela_is_lost_and_the_rest_is_told() {
    let sun = light("sun", Shape::Directional(Directional {}));
    let mut odd = Line::isotropic(1.0);
    odd.falloff = 1.0;
    let endless = [
        sun.clone(),
        light("sky", Shape::Sky(Sky::OVERCAST)),
        light("cap", Shape::Cap(Cap { half_angle_deg: 5.0 })),
        light("line", Shape::Line(odd)),
    ];
    for light in endless {
        let error = written(&[light]).expect_err("nothing is left").to_string();
        assert!(error.contains("no light that an IES file can hold"), "{error}");
    }
    let red = Light { tint: Tint::Color(DVec3::X), ..light("red", rectangle(false)) };
    let muted = Light { muted: true, ..light("muted", rectangle(false)) };
    let exported = written(&[sun, red, muted]).expect("one is left");
    assert!(exported.has_losses(), "the sun is lost");
    let told = |name: &str, fate: Fate, words: &str| {
        let of = |remark: &&Remark| remark.thing == format!("light \"{name}\"") && remark.fate == fate;
        exported.remarks.iter().filter(of).any(|remark| remark.what.contains(words))
    };
    assert!(told("sun", Fate::Lost, "infinitely far away"), "{:?}", exported.remarks);
    assert!(told("red", Fate::Changed, "within 1 % from"), "{:?}", exported.remarks);
    assert!(told("red", Fate::Changed, "colour is left out"), "{:?}", exported.remarks);
    assert!(told("muted", Fate::Changed, "muted"), "{:?}", exported.remarks);
}

#[test]
fn the_text_is_as_the_standard_asks() {
    let mut disk = Light::new("größer", Shape::Disk(Disk { radius: 0.5, two_sided: false }));
    disk.quantity = Quantity::new(QuantityKind::Flux, PI * PI * 250.0);
    let lights = [disk, light("a name that is longer than any line of such a file may be ".repeat(4).trim(), angle())];
    for lights in [&lights[..1], &lights[..]] {
        let file = written_text(lights);
        assert_eq!(file, written_text(lights), "the same every time");
        for line in file.split_terminator("\r\n") {
            assert!(line.len() <= 132, "{} characters: {line}", line.len());
            assert!(line.bytes().all(|byte| (b' '..=b'~').contains(&byte)), "printable ASCII: {line}");
        }
        assert!(lm63::read(file.as_bytes()).is_ok(), "it is read");
    }
    let file = written_text(&lights[..1]).replace("\r\n", "\n").replace(env!("CARGO_PKG_VERSION"), "VERSION");
    let head: Vec<&str> = file.lines().take(24).map(|line| line.get(..110).unwrap_or(line)).collect();
    insta::assert_snapshot!(head.join("\n"));
    for (value, stated) in [(4.998092, "5"), (13.0, "13"), (13.01, "13.1"), (0.0951, "0.0951"), (0.0, "0")] {
        assert_eq!(text::rounded_up(value), stated, "{value}, not below it");
    }
}

#[test]
fn cancelled_work_gives_nothing() {
    let scene = Scene { lights: vec![light("picture", textured())], ..Scene::default() };
    let progress = Progress::default();
    progress.cancel();
    let job = Job {
        scene: &scene,
        scene_name: "any.toml",
        stem: "out",
        target: Target::Ies,
        lights: None,
        surfaces: true,
        options: Options::default(),
    };
    assert!(matches!(write(&job, &progress), Err(ExportError::Cancelled)), "stopped");
}

#[test]
fn directions_are_exact_at_right_angles() {
    assert_eq!(direction(0.0, 0.0), DVec3::NEG_Z, "nadir");
    assert_eq!(direction(90.0, 90.0), DVec3::Y, "C = 90");
    assert_eq!(direction(180.0, 90.0), DVec3::NEG_X, "C = 180");
    assert_eq!(direction(270.0, 90.0), DVec3::NEG_Y, "C = 270");
    let angle = angle_between(direction(30.0, 45.0), DVec3::NEG_Z);
    assert!((angle - 0.25 * PI).abs() < 1e-15, "{angle} from nadir");
    assert_eq!(DVec2::new(1.0, 0.0).extend(0.0), direction(360.0, 90.0), "all around");
}
