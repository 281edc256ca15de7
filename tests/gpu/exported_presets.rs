//! Exported shader functions of every light of every shipped preset against the layers of the preview.

use std::path::PathBuf;

use softbox::export::Target;
use softbox::light::{Light, Shape};
use softbox::scene;
use softbox::shading::Method;

use crate::exported::{Point, difference, exported, points_about, run};

/// Points for each light.
const POINTS: u16 = 64;

fn presets() -> Vec<PathBuf> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("presets");
    let kinds = ["scenes", "lights", "figures"].map(|kind| std::fs::read_dir(folder.join(kind)).expect("a folder"));
    let paths = kinds.into_iter().flatten().map(|entry| entry.expect("an entry").path());
    let mut paths: Vec<_> =
        paths.filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect();
    paths.sort();
    paths
}

/// Points that a light shines at, and others. Very near to a fine pattern they would cost too much.
fn points(light: &Light) -> Vec<Point> {
    let (place, reach) = match light.shape {
        Shape::Textured(_) => (light.position - 3.0 * light.world_from_light().matrix3.z_axis, 2.0),
        _ => (light.position, 3.0),
    };
    points_about(place.as_vec3(), reach, 1..POINTS + 1)
}

/// How far a function may be from its layer: see `exported::bound` for why.
fn bound(light: &Light) -> f32 {
    match light.shape {
        // What the table of an even line makes of a lobe near it.
        Shape::Line(_) => 1e-3,
        Shape::Textured(_) => 5e-4,
        Shape::Cap(_) => 5e-5,
        _ => 1e-6,
    }
}

#[test]
fn a_function_is_the_layer_of_its_light_in_every_preset() {
    let mut compared = 0;
    let mut wrong = Vec::new();
    for path in presets() {
        let scene = scene::load(&path).unwrap_or_else(|error| panic!("{error}"));
        let names: Vec<_> = scene.lights.iter().map(|light| light.name.clone()).collect();
        let exported = exported(&scene, &names, Target::Wgsl, Method::Exact);
        let wgsl = std::str::from_utf8(&exported.files[0].bytes).expect("text");
        let parts = scene.lights.iter().flat_map(|light| light.parts().into_iter().map(move |(part, _)| (light, part)));
        let parts: Vec<_> = parts.collect();
        let names = functions(wgsl);
        assert_eq!(parts.len(), names.len(), "{}: functions", path.display());
        let called: Vec<_> = names.into_iter().zip(&parts).map(|(name, (light, _))| (name, points(light))).collect();
        // A few at a time, as compilers need more and more time for each.
        let values: Vec<_> = called.chunks(4).flat_map(|called| run(&exported, wgsl, called, 24.0)).collect();
        for (((light, part), (_, points)), values) in parts.iter().zip(&called).zip(&values) {
            let found = difference((part, light.strength()), Method::Exact, 24.0, points, values);
            let what = format!("{}, {}: {found:?}", path.display(), light.name);
            println!("{what}");
            if found.worst > bound(light) || found.lit < 0.05 {
                wrong.push(what);
            }
            compared += 1;
        }
    }
    println!("{compared} lights");
    assert!(compared > 100, "only {compared} lights");
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// The functions of the lights in a file, in their order: each is the first one behind the light's title.
fn functions(wgsl: &str) -> Vec<String> {
    let of_title = |part: &str| {
        let line = part.lines().find_map(|line| line.strip_prefix("fn ")).expect("a function");
        line.split('(').next().expect("its name").to_owned()
    };
    wgsl.split("\n// Light \"").skip(1).map(of_title).collect()
}
