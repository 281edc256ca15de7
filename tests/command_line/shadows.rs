//! Shadows as the commands answer with them.

use std::fs;
use std::path::{Path, PathBuf};

use super::{POINTS_HEADER, answer, check_done, check_refused, folder, probe, run, shown, text};

/// Under a light, a square at half its height hides all of it that lies at x < 0 as seen from the origin.
fn half_hidden(folder: &Path, light: &str) -> PathBuf {
    with_shutter(folder, light, -2.0, 4.0)
}

/// A light at a height of 2 m, and a square shutter of a size at half that height, its middle at x.
fn with_shutter(folder: &Path, light: &str, x: f64, size: f64) -> PathBuf {
    let scene = format!(
        "format = 1\n[camera]\neye = [0.0, -3.0, 0.5]\ntarget = [0.0, 0.0, 0.0]\nfov_deg = 40.0\n\
         [[material]]\nname = \"m\"\ndiffuse = [0.5, 0.5, 0.5]\nspecular = [0.2, 0.2, 0.2]\nexponent = 8.0\n\
         [[surface]]\nname = \"floor\"\nmaterial = \"m\"\nshape = {{ plane = {{}} }}\n\
         [[surface]]\nname = \"shutter\"\nmaterial = \"m\"\nposition = [{x:?}, 0.0, 1.0]\n\
         shape = {{ square = {{ size = [{size:?}, {size:?}] }} }}\n\
         [[light]]\nname = \"l\"\nposition = [0.0, 0.0, 2.0]\n{light}\n"
    );
    let path = folder.join("half.toml");
    fs::write(&path, scene).expect("the scene is written");
    path
}

/// Illuminance at the origin, facing up.
fn illuminance(scene: &Path, more: &[&str]) -> f64 {
    answer(&probe(shown(scene), &format!("{POINTS_HEADER}\n0,0,0,0,0,1,0,0,1\n"), more))[0].1[3]
}

#[test]
fn a_shutter_over_half_of_a_light_leaves_half_of_it() {
    let square = "[[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]";
    // Of the last three the share is had by rays, within their stated error.
    for (light, tolerance) in [
        (
            "intensity_per_metre = 100.0\nshape = { line = { length = 2.0, emission = \"isotropic\" } }".to_owned(),
            1e-14,
        ),
        (
            "luminance = 500.0\nshape = { line = { length = 1.5, emission = \"tube\", radius = 0.01 } }".to_owned(),
            1e-12,
        ),
        (format!("luminance = 1000.0\nshape = {{ polygon = {{ vertices = {square} }} }}"), 1e-13),
        ("luminance = 1000.0\nshape = { sphere = { radius = 0.4 } }".to_owned(), 2e-3),
        ("luminance = 1000.0\nshape = { disk = { radius = 0.4 } }".to_owned(), 2e-3),
    ] {
        let folder = folder();
        let scene = half_hidden(folder.path(), &light);
        let (seen, all) = (illuminance(&scene, &[]), illuminance(&scene, &["--no-shadows"]));
        assert!((seen / all - 0.5).abs() <= tolerance, "{light}: {seen} lx of {all} lx");
    }
}

#[test]
fn a_point_light_behind_a_shutter_is_dark_and_beside_it_is_whole() {
    let folder = folder();
    let scene = half_hidden(folder.path(), "intensity = 100.0\nshape = { point = {} }");
    let rows = format!("{POINTS_HEADER}\n-0.5,0,0,0,0,1,0,0,1\n0.5,0,0,0,0,1,0,0,1\n");
    let [with, without] = [&[][..], &["--no-shadows"]].map(|more| answer(&probe(shown(&scene), &rows, more)));
    assert_eq!(with[0].1[3..], [0.0; 6], "behind the shutter");
    assert_eq!(with[1], without[1], "beside it");
    assert!(without[0].1[3] > 0.0, "without shadows the light reaches both: {without:?}");
}

#[test]
fn every_structure_gives_the_same_picture_to_the_last_bit() {
    let folder = folder();
    let pictures = ["hierarchy", "every", "grid", "grid-5", "light-buffer", "light-buffer-24"].map(|structure| {
        let output = folder.path().join(format!("{structure}.exr"));
        let size = ["--size", "64x36", "--structure", structure];
        check_done(&run(&[&["render", "presets/scenes/three-spheres.toml", "-o", shown(&output)][..], &size].concat()));
        fs::read(output).expect("the picture")
    });
    assert!(pictures.iter().all(|picture| *picture == pictures[0]), "structures differ");
    check_refused(&["render", "presets/scenes/three-spheres.toml", "-o", "o.png", "--structure", "octree"], "octree");
}

#[test]
fn a_difference_and_a_report_are_of_what_is_lit() {
    let folder = folder();
    let scene = with_shutter(folder.path(), "intensity = 100.0\nshape = { point = {} }", 0.0, 1000.0);
    let picture = folder.path().join("d.png");
    for (more, is_lit) in [(&[][..], false), (&["--no-shadows"], true)] {
        let report = run(&[&["report", shown(&scene), "--points", "64", "--csv"][..], more].concat());
        check_done(&report);
        let peak: f64 = field(text(&report.stdout).lines().nth(1), ',', 3);
        let size = ["--size", "32x18"];
        let difference = run(&[&["difference", shown(&scene), "-o", shown(&picture)][..], &size, more].concat());
        check_done(&difference);
        let seen: f64 = field(text(&difference.stdout).lines().last(), ' ', 1);
        // The farthest ground is lit past the shutter's edge.
        assert_eq!([peak > 1e-6, seen > 1e-6], [is_lit; 2], "{more:?}: {peak} lx, {seen} cd/m²");
    }
}

/// A number of a line.
fn field(line: Option<&str>, separator: char, place: usize) -> f64 {
    let field = line.and_then(|line| line.split(separator).filter(|field| !field.is_empty()).nth(place));
    field.and_then(|field| field.parse().ok()).expect("a number")
}
