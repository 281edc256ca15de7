//! Photometric files of point lights: what they become, what is refused and how, and that they go along with a scene.

use std::fs;
use std::path::Path;

use glam::DVec3;
use softbox::light::photometry::Photometry;
use softbox::light::{QuantityKind, Shape};
use softbox::scene::{self, Scene};
use softbox::shading::{Method, PhongLobe, ShadingPoint, respond};

use super::names;

/// 400 cd straight down, 100 cd at 60° on the side of C = 0, 300 cd on that of C = 180.
const SPOT: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 2 3 3 1 2 0 0 0\n1 1 10\n0 60 90\n0 90 180\n\
                    200 50 0\n200 100 0\n200 150 0\n";

fn text(ies: &str) -> String {
    format!("format = 1\n[[light]]\nname = \"spot\"\nintensity = 800.0\nshape = {{ point = {{ ies = \"{ies}\" }} }}\n")
}

fn parse(ies: &str, file: &str) -> Result<Scene, String> {
    scene::parse_with(&text(ies), "spot.toml", |_| Ok(file.as_bytes().to_vec())).map_err(|error| error.to_string())
}

fn photometry(scene: &Scene, light: usize) -> &Photometry {
    let Shape::Point(point) = &scene.lights[light].shape else { panic!("a point light") };
    point.ies.as_ref().expect("a photometric file")
}

#[test]
fn the_files_intensities_are_scaled_to_the_stated_one_and_shade_a_point() {
    let mut scene = parse("spot.ies", SPOT).unwrap_or_else(|error| panic!("{error}"));
    let light = &mut scene.lights[0];
    assert_eq!(light.strength(), 800.0, "the greatest intensity is what the scene states");
    let flux = light.in_quantity(QuantityKind::Flux).expect("a flux");
    let distribution = &photometry(&scene, 0).distribution;
    assert_eq!(distribution.peak(), 400.0, "the file's own greatest intensity");
    assert!((flux / (800.0 * distribution.flux_per_peak()) - 1.0).abs() < 1e-15, "{flux} lm");

    let light = &mut scene.lights[0];
    (light.position, light.rotation_deg) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(0.0, 0.0, 90.0));
    let lobe = PhongLobe::new(1.0);
    // Turned by 90° about Z, C = 0 is on the side of +Y: 2·100 cd there, 2·300 cd on the other side.
    for (side, candela) in [(1.0, 200.0), (-1.0, 600.0)] {
        let w = DVec3::new(0.0, side * 60.0_f64.to_radians().sin(), -0.5);
        let at = ShadingPoint { p: light.position + 2.0 * w, n: -w, v: -w };
        for method in [Method::Exact, Method::Point, Method::Reference] {
            let illuminance = light.strength() * respond(&light.emitter(), method, &at, &lobe).irradiance;
            assert!((illuminance - candela / 4.0).abs() < 1e-12 * candela, "{method} gives {illuminance} lx at {side}");
        }
    }
}

#[test]
fn a_bad_file_is_told_with_its_place_in_the_scene_and_its_own_line() {
    let refusal = |ies: &str, file: &str| parse(ies, file).expect_err("it is refused");
    insta::assert_snapshot!(refusal("spot.ies", &SPOT.replace("0 60 90", "0 9O 90")), @"spot.toml:5:27: light[0].shape.point.ies: `spot.ies`, line 5: `9O` is no number; here stands vertical angles 2 of 3");
    insta::assert_snapshot!(refusal("spot.ies", "no photometry"), @"spot.toml:5:27: light[0].shape.point.ies: `spot.ies` has no line TILT=; save it as an IES file (LM-63)");
    insta::assert_snapshot!(refusal("../spot.ies", SPOT), @r#"spot.toml:5:27: light[0].shape.point.ies: `../spot.ies` leaves the scene's folder; write a name such as "photometry/spot.ies""#);
    let absent = scene::parse(&text("spot.ies"), "spot.toml").expect_err("there is no file");
    insta::assert_snapshot!(absent, @"spot.toml:5:27: light[0].shape.point.ies: `spot.ies` cannot be read: there are no files beside this text; write the name of an IES file in the scene's folder");
}

#[test]
fn it_goes_along_when_the_scene_is_saved_elsewhere() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let (from, to) = (folder.path().join("from"), folder.path().join("to"));
    for path in [&from.join("photometry"), &to] {
        fs::create_dir_all(path).expect("the folder is writable");
    }
    fs::write(from.join("spot.toml"), text("photometry/spot.ies")).expect("the folder is writable");
    fs::write(from.join("photometry/spot.ies"), SPOT).expect("the folder is writable");
    let load = |folder: &Path| scene::load(folder.join("spot.toml")).unwrap_or_else(|error| panic!("{error}"));
    let scene = load(&from);
    scene::save_as(&scene, to.join("spot.toml"), from.join("spot.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(load(&to), scene, "the same scene");
    assert_eq!(fs::read_to_string(to.join("photometry/spot.ies")).expect("it is there"), SPOT, "the same file");
    assert_eq!(names(&to), ["photometry", "spot.toml"], "and nothing else");
}

#[test]
fn files_from_anywhere_are_named_in_a_folder_of_their_own_and_kept_apart() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("spot.ies");
    fs::write(&path, SPOT).expect("the folder is writable");
    let imported = scene::import_photometry(&path, None).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(imported.file, "photometry/spot.ies", "its name in a scene");
    let mut scene = parse("photometry/spot.ies", &SPOT.replace("200 50 0", "200 60 0")).expect("another file");
    let mut light = parse("photometry/spot.ies", SPOT).expect("a scene").lights.remove(0);
    scene::keep_apart(&mut light, &scene.lights);
    light.name = "second".to_owned();
    scene.lights.push(light);
    assert_eq!(photometry(&scene, 1).file, "photometry/spot-2.ies", "a name of its own");
    fs::write(&path, "nothing").expect("the folder is writable");
    let wrong = scene::import_photometry(&path, None).expect_err("no IES file");
    assert_eq!(wrong, "`spot.ies` has no line TILT=; save it as an IES file (LM-63)", "one line");
}
