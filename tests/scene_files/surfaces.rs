//! Patches, meshes, flakes and tetrahedra: what they become, what is refused, and that mesh files go along with a scene.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use softbox::scene::{self, Scene};
use softbox::surface::{Placed, Shape, Surface};

use super::{check, names, refusal, with};

/// The shape of the window scene's floor.
const FLOOR: &str = "plane = {}";

/// A square of two triangles, with normals.
const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1 4//1\n";

fn mesh(name: &str) -> String {
    with(FLOOR, &format!("mesh = {{ file = \"{name}\" }}"))
}

/// What is wrong with a scene whose mesh file holds this.
#[track_caller]
fn mesh_refusal(contents: &str) -> String {
    let read = scene::parse_with(&mesh("chair.obj"), "window.toml", |_| Ok(contents.as_bytes().to_vec()));
    read.expect_err("this must be refused").to_string()
}

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().expect("a file is in a folder")).expect("the folder is writable");
        fs::write(path, text).expect("the folder is writable");
    }
    folder
}

#[track_caller]
fn load(folder: &Path) -> Scene {
    scene::load(folder.join("window.toml")).unwrap_or_else(|error| panic!("{error}"))
}

fn meshes(scene: &Scene) -> Vec<&softbox::surface::Mesh> {
    let mesh = |surface: &'_ Surface| matches!(surface.shape, Shape::Mesh(_));
    let shapes = scene.surfaces.iter().filter(|surface| mesh(surface)).map(|surface| &surface.shape);
    shapes.filter_map(|shape| if let Shape::Mesh(mesh) = shape { Some(mesh) } else { None }).collect()
}

#[test]
fn depths_are_whole_and_within_their_limits() {
    check(
        FLOOR,
        "sphereflake = { depth = 6 }",
        "window.toml:21:35: surface[0].shape.sphereflake.depth: must be at most 5, but is 6.0; write a whole number such as 2, which gives 91 spheres",
    );
    check(
        FLOOR,
        "tetrahedron = { depth = 9 }",
        "window.toml:21:35: surface[0].shape.tetrahedron.depth: must be at most 8, but is 9.0; write a whole number such as 5, which gives 4096 triangles",
    );
    check(
        FLOOR,
        "tetrahedron = { depth = -1 }",
        "window.toml:21:35: surface[0].shape.tetrahedron.depth: -1 is too small; write a larger number",
    );
    check(
        FLOOR,
        "tetrahedron = { depth = 4294967296 }",
        "window.toml:21:35: surface[0].shape.tetrahedron.depth: 4294967296 is too large; write a smaller number",
    );
    check(
        FLOOR,
        "sphereflake = { depth = 1.5 }",
        "window.toml:21:35: surface[0].shape.sphereflake.depth: must be a whole number, but is the number 1.5",
    );
}

#[test]
fn a_patch_has_sixteen_points_that_span_an_area() {
    let patch = |points: &str| with(FLOOR, &format!("patch = {{ control_points = [{points}] }}"));
    insta::assert_snapshot!(refusal(&patch("[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]")), @"window.toml:21:38: surface[0].shape.patch.control_points: must be a list of 16 points, but has 2");
    let line: Vec<String> = (0..16).map(|i| format!("[{i}.0, {i}.0, 1.0]")).collect();
    insta::assert_snapshot!(refusal(&patch(&line.join(", "))), @"window.toml:21:38: surface[0].shape.patch.control_points: lie on one line, which has no area; move some of them off it");
    let far = line.join(", ").replacen("0.0", "inf", 1);
    let told = refusal(&patch(&far));
    assert!(told.contains("control_points[0][0]: must be finite, but is inf"), "{told}");
}

#[test]
fn what_is_wrong_with_a_mesh_is_told_with_its_line() {
    insta::assert_snapshot!(mesh_refusal("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), @"window.toml:21:27: surface[0].shape.mesh.file: `chair.obj`, line 3: there is no vertex 3; the file has 2");
    insta::assert_snapshot!(mesh_refusal("v 0 0 inf\n"), @"window.toml:21:27: surface[0].shape.mesh.file: `chair.obj`, line 1: `inf` is too large; write a number of metres up to 1e9");
    insta::assert_snapshot!(mesh_refusal("\u{0}\u{1}PNG"), @"window.toml:21:27: surface[0].shape.mesh.file: `chair.obj` has no faces; save it as OBJ with polygons");
    insta::assert_snapshot!(refusal(&mesh("chair.obj")), @"window.toml:21:27: surface[0].shape.mesh.file: `chair.obj` cannot be read: there are no files beside this text; write the name of an OBJ file in the scene's folder");
    insta::assert_snapshot!(refusal(&mesh("../chair.obj")), @r#"window.toml:21:27: surface[0].shape.mesh.file: `../chair.obj` leaves the scene's folder; write a name such as "meshes/chair.obj""#);
}

#[test]
fn the_meshes_of_a_scene_have_a_limit_together() {
    let many = "v 0 0 0\nv 1 0 0\nv 0 1 0\n".to_owned() + &"f 1 2 3\n".repeat(scene::MOST_TRIANGLES / 2 + 1);
    let second =
        "\n[[surface]]\nname = \"second\"\nmaterial = \"floor\"\nshape = { mesh = { file = \"chair.obj\" } }\n";
    let text = mesh("chair.obj") + second;
    let error = scene::parse_with(&text, "window.toml", |_| Ok(many.clone().into_bytes())).expect_err("too many");
    let told = error.to_string();
    assert!(told.ends_with("is too much: a scene's meshes have at most 1000000 triangles; simplify some"), "{told}");
    assert_eq!(told.lines().count(), 1, "{told}");
}

#[test]
fn a_mesh_is_placed_as_its_surface_is() {
    let text = mesh("chair.obj")
        .replace("shape = { mesh", "rotation_deg = [0.0, 90.0, 0.0]\nscale = [2.0, 1.0, 1.0]\nshape = { mesh");
    let scene = scene::parse_with(&text, "window.toml", |_| Ok(SQUARE.as_bytes().to_vec()));
    let scene = scene.unwrap_or_else(|error| panic!("{error}"));
    let parts = Placed::parts(&scene.surfaces[0]);
    assert_eq!(parts.len(), 2, "triangles");
    let position = scene.surfaces[0].position;
    let bounds = parts.iter().filter_map(Placed::bounds).reduce(|a, b| a.union(b)).expect("bounds");
    assert!((bounds.max - bounds.min - glam::DVec3::new(0.0, 1.0, 2.0)).length() < 1e-15, "{bounds:?}");
    let hit = parts[0].intersect(position + glam::DVec3::new(3.0, 0.3, -1.0), glam::DVec3::NEG_X);
    let hit = hit.or_else(|| parts[1].intersect(position + glam::DVec3::new(3.0, 0.3, -1.0), glam::DVec3::NEG_X));
    assert!(hit.is_some_and(|hit| (hit.n - glam::DVec3::X).length() < 1e-15 && (hit.t - 3.0).abs() < 1e-15), "{hit:?}");
}

#[test]
fn copies_of_a_scene_share_its_meshes() {
    let files = folder(&[("window.toml", &mesh("chair.obj")), ("chair.obj", SQUARE)]);
    let scene = load(files.path());
    let copy = scene.clone();
    assert!(Arc::ptr_eq(&meshes(&scene)[0].triangles, &meshes(&copy)[0].triangles), "the same triangles");
    assert_eq!(load(files.path()), scene, "and another reading is equal");
}

#[test]
fn meshes_go_along_when_a_scene_is_saved_elsewhere() {
    let files = folder(&[("window.toml", &mesh("meshes/chair.obj")), ("meshes/chair.obj", SQUARE)]);
    let scene = load(files.path());
    let target = folder(&[]);
    fs::remove_dir_all(files.path().join("meshes")).expect("nothing depends on the old files");
    let file = target.path().join("window.toml");
    scene::save_as(&scene, &file, files.path().join("window.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(load(target.path()), scene, "the same scene");
    assert_eq!(fs::read_to_string(target.path().join("meshes/chair.obj")).expect("it is there"), SQUARE, "the file");

    let other = folder(&[("meshes/chair.obj", "another")]);
    let error = scene::save(&scene, other.path().join("window.toml")).expect_err("the names collide").to_string();
    insta::assert_snapshot!(error.replace(&format!("{}/", other.path().display()), ""), @"window.toml: not saved, as its mesh meshes/chair.obj cannot be: there is another file of that name; rename one of the two");
    assert_eq!(names(other.path()), ["meshes"], "nothing was saved");
}

#[test]
fn meshes_of_one_name_are_kept_apart() {
    let taller = SQUARE.replace("v 1 1 0", "v 1 2 0");
    let files = folder(&[("a/chair.obj", SQUARE), ("b/chair.obj", &taller)]);
    let import =
        |name: &str| scene::import_mesh(&files.path().join(name), None).unwrap_or_else(|error| panic!("{error}"));
    let mut scene = super::window();
    for name in ["a/chair.obj", "b/chair.obj", "a/chair.obj"] {
        let shape = Shape::Mesh(import(name));
        let mut surface =
            Surface { name: format!("chair {}", scene.surfaces.len()), shape, ..scene.surfaces[0].clone() };
        scene::keep_mesh_apart(&mut surface, &scene.surfaces);
        scene.surfaces.push(surface);
    }
    let named: Vec<_> = meshes(&scene).into_iter().map(|mesh| mesh.file.as_str()).collect();
    assert_eq!(named, ["meshes/chair.obj", "meshes/chair-2.obj", "meshes/chair.obj"], "one name a mesh");
    let target = folder(&[]);
    scene::save(&scene, target.path().join("window.toml")).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(load(target.path()), scene, "saved and loaded");
}
