//! UsdLux lights of `.usda` files: those that others write, and our own.

use std::f64::consts::PI;
use std::io;

use glam::DVec3;
use softbox::export::{self, Job, Options, Target};
use softbox::import::Imported;
use softbox::import::usda::{self, UsdaError};
use softbox::light::{Emitter, Light, LineEmission, Point, QuantityKind, Shape, Tint, temperature_color};
use softbox::render::Progress;
use softbox::scene::{self, Scene, validate};
use softbox::shading::{Lobe, Method, Prepared, ShadingPoint};

const STUDIO: &str = include_str!("../data/usda/studio.usda");

fn read(text: &str) -> Imported {
    usda::read(text, "studio", &mut |_| Err(io::ErrorKind::NotFound.into())).expect("it is read")
}

#[track_caller]
fn light<'a>(imported: &'a Imported, name: &str) -> &'a Light {
    imported.scene.lights.iter().find(|light| light.name == name).unwrap_or_else(|| panic!("no light {name}"))
}

#[track_caller]
fn check_near(found: DVec3, expected: DVec3, what: &str) {
    assert!((found - expected).length() <= 1e-6 * expected.length().max(1.0), "{what}: {found}, not {expected}");
}

#[track_caller]
fn check_quantity(light: &Light, kind: QuantityKind, expected: f64) {
    assert_eq!(light.quantity.kind(), kind, "{}", light.name);
    let found = light.quantity.value();
    assert!((found / expected - 1.0).abs() < 1e-6, "{}: {found}, not {expected}", light.name);
}

/// Where a light is, and to where it shines.
fn pose(light: &Light) -> (DVec3, DVec3) {
    let world_from_light = light.world_from_light();
    (world_from_light.translation, -world_from_light.matrix3.z_axis)
}

#[test]
fn a_rectangle_in_centimetres_under_a_scaled_parent_arrives_in_metres_z_up() {
    let imported = read(STUDIO);
    let key = light(&imported, "Key light");
    let Shape::Polygon(polygon) = &key.shape else { panic!("a rectangle, not {:?}", key.shape) };
    assert!((polygon.area() - 1.0 * 0.4).abs() < 1e-9, "twice 50 by 20 cm: {:?}", polygon.vertices);
    // Its own −Z is turned to −Y, about a point 10 to +Z of its origin; then the parent turns about Y, doubles, moves up.
    // In the stage: pivot (0,0,10) − turned (0,0,10) = (0, 0, 10) − (0, 10, 0).
    let (position, direction) = pose(key);
    let in_stage = DVec3::new(2.0 * 10.0, 100.0 + 2.0 * -10.0, 0.0);
    check_near(position, 0.01 * DVec3::new(in_stage.x, -in_stage.z, in_stage.y), "its place");
    check_near(direction, DVec3::NEG_Z, "shines down");
    // 200 · 2³ nits over its area in the stage's units, times the luminance of its colour.
    let luminance = 0.212_639_005_871_510 + 0.5 * 0.715_168_678_767_756 + 0.25 * 0.072_192_315_360_734;
    check_quantity(key, QuantityKind::Luminance, 1600.0 / (100.0 * 40.0) * luminance);
    check_near(key.weight(), 1600.0 / 4000.0 * DVec3::new(1.0, 0.5, 0.25), "what it sends out");
}

#[test]
fn a_disk_turned_by_a_quaternion_forgets_its_parents_when_it_says_so() {
    let imported = read(STUDIO);
    let fill = light(&imported, "fill");
    assert_eq!(fill.tint, Tint::TemperatureK(3200.0), "its temperature");
    let Shape::Disk(disk) = fill.shape else { panic!("a disk") };
    assert!((disk.radius - 0.25).abs() < 1e-12, "25 cm: {disk:?}");
    let (position, direction) = pose(fill);
    assert_eq!(position, DVec3::ZERO, "at the stage's origin");
    // A quarter about −X takes −Z to −Y of the stage, down.
    check_near(direction, DVec3::NEG_Z, "shines down");
    check_quantity(fill, QuantityKind::Luminance, 30.0);
    assert!(fill.muted, "invisible");
}

#[test]
fn points_tubes_suns_and_skies_keep_their_strength() {
    let imported = read(STUDIO);
    let bulb = light(&imported, "bulb");
    assert_eq!(bulb.shape, Shape::Point(Point { ..Default::default() }), "treated as a point, by attributes of old");
    check_near(bulb.position, DVec3::new(0.1, -0.3, 0.2), "10, 20, 30 cm with Y up");
    check_quantity(bulb, QuantityKind::Intensity, 10_000.0 * PI * 0.01 * 0.01);
    let tube = light(&imported, "tube");
    let Shape::Line(line) = &tube.shape else { panic!("a line") };
    assert_eq!((line.length, line.emission), (1.2, LineEmission::Tube), "in metres");
    assert!((line.radius.unwrap_or(0.0) - 0.013).abs() < 1e-15, "its radius in metres: {line:?}");
    check_quantity(tube, QuantityKind::Luminance, 5000.0);
    let sun = light(&imported, "sun");
    let Shape::Cap(cap) = sun.shape else { panic!("a cap") };
    let facing = sun.quantity.value() * cap.illuminance_per_luminance();
    assert!((facing / 100_000.0 - 1.0).abs() < 1e-9, "normalized, its intensity is its illuminance: {facing}");
    // rotateZYX turns about Z first: angles in the order of the axes' names, X −60°, Y 30°, Z 0.
    let (_, direction) = pose(sun);
    let in_stage = glam::DMat3::from_rotation_x(-60_f64.to_radians())
        * glam::DMat3::from_rotation_y(30_f64.to_radians())
        * DVec3::NEG_Z;
    check_near(direction, DVec3::new(in_stage.x, -in_stage.z, in_stage.y), "the sun's direction");
    let sky = light(&imported, "sky");
    let Shape::Sky(even) = sky.shape else { panic!("a sky") };
    assert_eq!((even.uniform, even.cosine), (1.0, 0.0), "an even dome");
    check_near(sky.world_from_light().matrix3.z_axis, DVec3::Z, "its zenith");
    check_quantity(sky, QuantityKind::Luminance, 300.0);
}

#[test]
fn a_flat_mesh_is_a_polygon_and_others_are_told() {
    let imported = read(STUDIO);
    let arrow = light(&imported, "arrow");
    let Emitter::Polygon(emitter) = arrow.emitter() else { panic!("a polygon") };
    assert_eq!(emitter.vertices.len(), 4, "its outline alone: {:?}", emitter.vertices);
    // Counter-clockwise about +Z of the stage, which is −Y here.
    check_near(emitter.normal, DVec3::NEG_Y, "shines to where it turns counter-clockwise");
    assert!((emitter.vector_area().length() - 0.5 * (100.0 * 200.0 - 30.0 * 200.0) * 1e-4).abs() < 1e-9, "{emitter:?}");
    check_quantity(arrow, QuantityKind::Luminance, 700.0);
    assert_eq!(light(&imported, "lamp").quantity.value(), 42.0, "of the chosen variant");
    let told: Vec<String> = imported.remarks.iter().map(ToString::to_string).collect();
    let line = |what: &str| STUDIO.lines().position(|line| line.contains(what)).expect("it is there") + 1;
    for (place, said) in [
        ("def DiskLight \"fill\"", "\"fill\" is invisible"),
        ("shaping:cone:angle", "\"fill\" has a cone, which is left out"),
        ("intensity.timeSamples", "\"fill\" has an animated value"),
        ("def DomeLight \"sky\"", "loses what is below the horizon"),
        ("def PortalLight", "\"portal\" is no kind of light"),
        ("def Mesh \"ball light\"", "\"ball light\" has no single outline"),
        ("references = ", "has references, which are not followed"),
        ("over \"elsewhere\"", "changes what another layer defines"),
    ] {
        let expected = format!("{}: ", line(place));
        assert!(
            told.iter().any(|told| told.starts_with(&expected) && told.contains(said)),
            "{expected}{said}\n{told:#?}"
        );
    }
    assert_eq!(imported.scene.lights.len(), 8, "one each, and none of a class");
    assert!(validate(&imported.scene).is_empty(), "a scene that can be saved");
}

#[test]
fn what_is_no_stage_or_has_no_lights_is_told_with_its_line() {
    let wrong =
        |text: &str| usda::read(text, "x", &mut |_| Err(io::ErrorKind::NotFound.into())).expect_err("it is wrong");
    assert_eq!(wrong("PXR-USDC"), UsdaError::OtherFormat, "binary");
    for (text, line) in [
        ("#usda 1.0\ndef Sphere \"a\"\n{\n  float radius = ]\n}", 4),
        ("#usda 1.0\ndef Sphere \"a\"\n{\n", 4),
        ("#usda 1.0\ndef \"a\" {\n string x = \"open\n}", 3),
        ("#usda 1.0\n}", 2),
    ] {
        let error = wrong(text);
        assert!(matches!(error, UsdaError::Syntax { line: found, .. } if found == line), "{text}: {error:?}");
    }
    let deep = format!("#usda 1.0\n{}", "def \"a\" {".repeat(100_000));
    assert!(matches!(wrong(&deep), UsdaError::Syntax { .. }), "too deep");
    assert!(wrong("#usda 1.0\ndef VolumeLight \"v\" {}").to_string().contains("line 2"), "why it has no lights");
}

/// What we write and read back.
fn round_trip(scene: &Scene) -> Imported {
    let options = Options::default();
    let job =
        Job { scene, scene_name: "s.toml", stem: "s", target: Target::Usda, lights: None, surfaces: false, options };
    let exported = export::export(&job, &Progress::default()).expect("it is exported");
    let text = std::str::from_utf8(&exported.files[0].bytes).expect("text");
    let mut beside = |name: &str| {
        let file = exported.files.iter().find(|file| file.name == name);
        file.map(|file| file.bytes.clone()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    usda::read(text, "s", &mut beside).expect("it is read back")
}

/// Illuminance by lights at a point that faces up, and one that faces aside.
fn illuminance(lights: &[Light]) -> Vec<DVec3> {
    let lobe = Lobe::new(8.0);
    let at = |p: DVec3, n: DVec3| ShadingPoint { p, n, v: n };
    let points = [
        at(DVec3::new(0.3, 0.2, 0.0), DVec3::Z),
        at(DVec3::new(-1.1, 0.7, 0.1), DVec3::new(0.6, 0.0, 0.8)),
        at(DVec3::new(0.9, -1.3, 5.0), DVec3::NEG_Z),
    ];
    let parts: Vec<_> = lights.iter().flat_map(Light::parts).collect();
    let sum = |at: &ShadingPoint| {
        parts
            .iter()
            .map(|(emitter, weight)| *weight * Prepared::new(emitter, Method::Exact).respond(at, &lobe).irradiance)
            .sum()
    };
    points.iter().map(sum).collect()
}

#[test]
fn our_own_lights_come_back_with_the_same_light() {
    let presets = std::fs::read_dir("presets/lights").expect("presets").map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> = presets.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    paths.extend(["tests/data/everything.toml".into(), "presets/scenes/portrait.toml".into()]);
    let mut worst: f64 = 0.0;
    for path in paths {
        let mut scene = scene::load(&path).expect("it loads");
        scene.lights.retain(|light| !matches!(&light.shape, Shape::Line(line) if line.falloff != 2.0) && !light.muted);
        if scene.lights.is_empty() {
            continue;
        }
        let back = round_trip(&scene);
        for (found, expected) in illuminance(&back.scene.lights).iter().zip(illuminance(&scene.lights)) {
            let off = (*found - expected).length() / expected.length().max(1e-3);
            assert!(off <= 2e-3, "{}: {found} lx, not {expected}", path.display());
            worst = worst.max(off);
        }
    }
    assert!(worst > 0.0, "nothing was compared");
}

#[test]
fn temperature_is_written_as_the_colour_that_it_has() {
    let mut scene =
        Scene { lights: vec![Light::new("l", Shape::Point(Point { ..Default::default() }))], ..Scene::default() };
    scene.lights[0].tint = Tint::TemperatureK(2700.0);
    let back = round_trip(&scene);
    check_near(back.scene.lights[0].tint.rgb(), Tint::Color(temperature_color(2700.0)).rgb(), "its colour");
}

#[test]
fn variants_are_a_variant_set_that_comes_back() {
    let scene = scene::load("tests/data/evening.toml").expect("it loads");
    let options = Options::default();
    let target = Target::Usda;
    let job = Job { scene: &scene, scene_name: "s.toml", stem: "s", target, lights: None, surfaces: true, options };
    let exported = export::export(&job, &Progress::default()).expect("it is exported");
    let stage = String::from_utf8(exported.files[0].bytes.clone()).expect("text");
    let states =
        [("as_shown", &scene.lights), ("evening", &scene.variants[0].lights), ("dark", &scene.variants[1].lights)];
    for (name, lights) in states {
        let chosen = stage.replace("lights = \"as_shown\"", &format!("lights = \"{name}\""));
        let read = usda::read(&chosen, "s", &mut |_| Err(io::ErrorKind::NotFound.into()));
        if lights.is_empty() {
            assert!(matches!(read, Err(UsdaError::NoLights { .. })), "{name}: {read:?}");
            continue;
        }
        let found = read.expect("it is read").scene.lights;
        assert!(found.iter().map(|light| &light.name).eq(lights.iter().map(|light| &light.name)), "{name}: {found:?}");
        for (found, light) in found.iter().zip(lights) {
            assert!((found.strength() / light.strength() - 1.0).abs() < 1e-6, "{name}: {found:?}");
        }
    }
    let told: Vec<_> = exported.remarks.iter().map(|remark| remark.thing.as_str()).collect();
    assert!(told.contains(&"light \"lamp\" of variant \"evening\""), "{told:?}");
    let one = ["sun".to_owned()];
    let job = Job { lights: Some(&one), ..job };
    let exported = export::export(&job, &Progress::default()).expect("it is exported");
    let stage = String::from_utf8_lossy(&exported.files[0].bytes);
    assert!(!stage.contains("variantSet") && stage.contains("variants are left out"), "chosen lights go alone");
}
