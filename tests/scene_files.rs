//! Scene files: loading, refusing, saving.

use std::fs;
use std::path::{Path, PathBuf};

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use softbox::light::{self, Light, Quantity, Tint};
use softbox::render::{MethodChoice, Progress, Settings, render};
use softbox::scene::{self, Camera, Display, Plot, PlotKind, PlotQuantity, Scene};
use softbox::shading::Method;
use softbox::surface::{self, Material, Surface};

/// A scene that is right; the tests below make it wrong.
const WINDOW: &str = include_str!("data/window.toml");

/// Its light's shape.
const SHAPE: &str = "polygon = { vertices = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]] }";

/// All vertices of its light but the first.
const VERTICES: &str = "[1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]";

/// What loading `text` says is wrong with it, one problem a line.
#[track_caller]
fn refusal(text: &str) -> String {
    match scene::parse(text, "window.toml") {
        Ok(_) => panic!("this loads, but should not:\n{text}"),
        Err(error) => error.to_string(),
    }
}

/// The scene with one passage replaced.
#[track_caller]
fn with(passage: &str, replacement: &str) -> String {
    assert_eq!(WINDOW.matches(passage).count(), 1, "`{passage}` must stand in the scene once");
    WINDOW.replace(passage, replacement)
}

#[track_caller]
fn check(passage: &str, replacement: &str, expected: &str) {
    assert_eq!(refusal(&with(passage, replacement)), expected, "`{passage}` replaced by `{replacement}`");
    let _ = expected;
}

#[test]
fn a_file_that_was_written_by_softbox_is_written_again_byte_for_byte() {
    let scene = scene::parse(WINDOW, "window.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene::to_toml(&scene), WINDOW, "saving what was loaded changes nothing");
}

#[test]
fn the_format_comes_first() {
    check("format = 1", "", "window.toml:1:1: format: is missing; write 1 (The number of the format)");
    check("format = 1", "format = 99", "window.toml:1:10: format: is 99, which this Softbox cannot read; it reads 1");
    check("format = 1", "format = 1.5", "window.toml:1:10: format: must be 1, but is the number 1.5");
    check("format = 1", "format = \"one\"", "window.toml:1:10: format: must be 1, but is text");
    check("format = 1", "format = 1\nformat = 1", "window.toml:2:1: is not TOML: duplicate key");
}

#[test]
fn numbers_are_finite_and_within_their_limits() {
    check(
        "luminance = 1000.0",
        "luminance = nan",
        "window.toml:26:13: light[0].luminance: must be finite, but is NaN; write a number such as 1000.0",
    );
    check(
        "luminance = 1000.0",
        "luminance = inf",
        "window.toml:26:13: light[0].luminance: must be finite, but is inf; write a number such as 1000.0",
    );
    check(
        "luminance = 1000.0",
        "luminance = -3",
        "window.toml:26:13: light[0].luminance: must not be negative, but is -3.0; write a number such as 1000.0",
    );
    check(
        "luminance = 1000.0",
        "luminance = 1e999",
        "window.toml:26:13: light[0].luminance: must be finite, but is 1e999; write a smaller number",
    );
    check(
        "luminance = 1000.0",
        "luminance = 99999999999999999999",
        "window.toml:26:13: light[0].luminance: 99999999999999999999 is too large; write a smaller number",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "position = [0.0, inf, 2e9]",
        "window.toml:25:18: light[0].position[1]: must be finite, but is inf; write a number of metres such as 1.5\nwindow.toml:25:23: light[0].position[2]: must be at most 1e9, but is 2000000000.0; write a number of metres such as 1.5",
    );
    check(
        "fov_deg = 40.0",
        "fov_deg = 180",
        "window.toml:7:11: camera.fov_deg: must be less than 180, but is 180.0; write an angle in degrees such as 40.0",
    );
    check(
        "fov_deg = 40.0",
        "fov_deg = 0",
        "window.toml:7:11: camera.fov_deg: must be greater than 0, but is 0.0; write an angle in degrees such as 40.0",
    );
    check(
        "exponent = 32.0",
        "exponent = 0.5",
        "window.toml:16:12: material[0].exponent: must be at least 1, but is 0.5; write a number such as 32.0; larger is sharper",
    );
    check(
        "exponent = 32.0",
        "exponent = 1e5",
        "window.toml:16:12: material[0].exponent: must be at most 10000, but is 100000.0; write a number such as 32.0; larger is sharper",
    );
    check(
        "exposure_ev = 0.0",
        "exposure_ev = -200.0",
        "window.toml:10:15: display.exposure_ev: must be at least -100, but is -200.0; write a number of steps such as 1.0, which doubles the brightness",
    );
    check(
        "specular = [0.2, 0.2, 0.2]",
        "specular = [0.2, -0.2, 0.2]",
        "window.toml:15:18: material[0].specular[1]: must not be negative, but is -0.2; write a number from 0.0 to 1.0",
    );
    check(
        SHAPE,
        "sphere = { radius = -1 }",
        "window.toml:27:31: light[0].shape.sphere.radius: must be greater than 0, but is -1.0; write a length in metres such as 0.5",
    );
    check(
        SHAPE,
        "line = { length = 0 }",
        "window.toml:26:13: light[0].luminance: does not fit a `line`; write `intensity_per_metre` or `flux`\nwindow.toml:27:29: light[0].shape.line.length: must be greater than 0, but is 0.0; write a length in metres such as 0.5",
    );
    check(
        SHAPE,
        "line = { length = 1, falloff = 4 }",
        "window.toml:26:13: light[0].luminance: does not fit a `line`; write `intensity_per_metre` or `flux`\nwindow.toml:27:42: light[0].shape.line.falloff: must be at most 3, but is 4.0; write a number from 0.0 to 3.0; light itself has 2.0",
    );
    check(
        "{ plane = {} }",
        "{ box = { size = [1.0, -1.0, 0.0] } }",
        "window.toml:21:32: surface[0].shape.box.size[1]: must be greater than 0, but is -1.0; write a length in metres such as 0.5\nwindow.toml:21:38: surface[0].shape.box.size[2]: must be greater than 0, but is 0.0; write a length in metres such as 0.5",
    );
    check(
        "luminance = 1000.0",
        "temperature_k = 500\nluminance = 1000.0",
        "window.toml:26:17: light[0].temperature_k: must be at least 1000, but is 500.0; write kelvins from 1000.0 to 40000.0",
    );
}

#[test]
fn values_have_the_right_type() {
    check(
        "luminance = 1000.0",
        "luminance = ",
        "window.toml:26:13: is not TOML: string values must be quoted, expected literal string",
    );
    check(
        "luminance = 1000.0",
        "luminance = true",
        "window.toml:26:13: light[0].luminance: must be a number, but is true",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "position = [0.0, 0.0]",
        "window.toml:25:12: light[0].position: must be a list of 3 numbers, but has 2",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "position = [0.0, 0.0, 2.0, 3.0]",
        "window.toml:25:12: light[0].position: must be a list of 3 numbers, but has 4",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "position = [0.0, \"a\", 2.0]",
        "window.toml:25:18: light[0].position[1]: must be a number, but is text",
    );
    check(
        "name = \"window\"\nposition",
        "name = 7\nposition",
        "window.toml:24:8: light[0].name: must be text in quotes, but is the number 7",
    );
    check(
        "{ plane = {} }",
        "\"plane\"",
        "window.toml:21:9: surface[0].shape: must be a table with one of `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`, but is text",
    );
    check(
        "{ plane = {} }",
        "{}",
        "window.toml:21:9: surface[0].shape: is empty; write one of `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`",
    );
    check(
        "{ plane = {} }",
        "{ plane = {}, disk = { radius = 1.0 } }",
        "window.toml:21:9: surface[0].shape: has both `disk` and `plane`; keep one of the two",
    );
    check(
        "{ plane = {} }",
        "{ disk = {} }",
        "window.toml:21:18: surface[0].shape.disk.radius: is missing; write a number (Radius in metres)",
    );
}

#[test]
fn unknown_names_are_refused_and_the_known_ones_told() {
    check(
        "luminance = 1000.0",
        "luminence = 1000.0",
        "window.toml:26:1: light[0].luminence: is not known here; did you mean `luminance`?",
    );
    check(
        "fov_deg = 40.0",
        "fov_deg = 40.0\nroll = 3",
        "window.toml:8:1: camera.roll: is not known here; known are `eye`, `fov_deg`, `target`",
    );
    check(
        "{ plane = {} }",
        "{ plain = {} }",
        "window.toml:21:11: surface[0].shape.plain: is not known here; known are `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`",
    );
    check(
        "material = \"floor\"",
        "material = \"flor\"",
        "window.toml:20:12: surface[0].material: there is no material `flor`; did you mean `floor`?",
    );
    check(
        "{ plane = {} }",
        "{ mesh = { file = \"../../etc/passwd\" } }",
        "window.toml:21:11: surface[0].shape.mesh: is not known here; known are `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`",
    );
    check(
        SHAPE,
        "textured = { size = [1.0, 1.0], pattern = \"../leaf.png\" }",
        "window.toml:27:11: light[0].shape.textured: is not known here; known are `polygon`, `line`, `sphere`, `point`, `directional`",
    );
    check(
        SHAPE,
        "line = { length = 1.0, emission = \"tube\" }",
        "window.toml:27:45: light[0].shape.line.emission: `tube` is not known; only `isotropic` is",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "scale = [2.0, 1.0, 1.0]",
        "window.toml:25:1: light[0].scale: is not known here; known are `color`, `flux`, `illuminance`, `intensity`, `intensity_per_metre`, `luminance`, `muted`, `name`, `position`, `rotation_deg`, `shape`, `temperature_k`",
    );
}

#[test]
fn a_light_states_one_quantity_that_its_shape_has() {
    check(
        "luminance = 1000.0",
        "muted = false",
        "window.toml:23:1: light[0]: does not say how bright it is; a `polygon` takes `luminance` or `flux`",
    );
    check(
        "luminance = 1000.0",
        "flux = 10.0\nluminance = 1000.0",
        "window.toml:26:8: light[0].flux: stands beside `luminance`; keep one of the two",
    );
    check(
        "luminance = 1000.0",
        "intensity = 1000.0",
        "window.toml:26:13: light[0].intensity: does not fit a `polygon`; write `luminance` or `flux`",
    );
    check(
        SHAPE,
        "directional = {}",
        "window.toml:26:13: light[0].luminance: does not fit a `directional`; write `illuminance`",
    );
    check(
        "luminance = 1000.0",
        "color = [1, 1, 1]\ntemperature_k = 3000\nluminance = 1000.0",
        "window.toml:27:17: light[0].temperature_k: stands beside `color`; keep one of the two",
    );
    check(
        "luminance = 1000.0",
        "color = [0, 0, 0]\nluminance = 1000.0",
        "window.toml:26:9: light[0].color: is black, which is no tint; mute the light or write [1.0, 1.0, 1.0]",
    );
}

#[test]
fn polygons_are_simple() {
    check(
        VERTICES,
        "[1.0, -0.5]",
        "window.toml:27:34: light[0].shape.polygon.vertices: 2 vertices are too few; a polygon has at least 3",
    );
    check(
        VERTICES,
        "[1.0, -0.5], [-1.0, 0.5], [1.0, 0.5]",
        "window.toml:27:34: light[0].shape.polygon.vertices: edges 1 and 3 cross or touch; edges may meet only at the vertex between them",
    );
    check(
        VERTICES,
        "[1.0, -0.5], [2.0, -0.5], [3.0, -0.5]",
        "window.toml:27:34: light[0].shape.polygon.vertices: all vertices lie on one line; move one off it",
    );
    check(
        VERTICES,
        "[1.0, -0.5], [1.0, -0.5], [-1.0, 0.5]",
        "window.toml:27:34: light[0].shape.polygon.vertices: vertices 1 and 2 coincide; leave one of them out",
    );
    check(
        VERTICES,
        "[1.0, -0.5], [1.0, nan], [-1.0, 0.5]",
        "window.toml:27:68: light[0].shape.polygon.vertices[2][1]: must be finite, but is NaN; write a number of metres such as 1.5",
    );
}

#[test]
fn directions_and_views_are_not_zero() {
    check(
        "eye = [0.0, -6.0, 2.5]",
        "eye = [0.0, 0.0, 0.5]",
        "window.toml:6:10: camera.target: is where the eye is; write a point in front of the eye",
    );
    check(
        "[[light]]",
        "[[plot]]\nname = \"tilt\"\nkind = \"tilt\"\nrange = [90, -90]\naxis = [0, 0, 0]\nview = [0, 0, 0]\nnormal = [0, 0, 0]\n\n[[light]]",
        "window.toml:26:9: plot[0].range: must run upwards, but goes from 90.0 to -90.0; swap the two\nwindow.toml:27:8: plot[0].axis: is zero, which is no direction; write one such as [0.0, 0.0, 1.0]\nwindow.toml:28:8: plot[0].view: is zero, which is no direction; write one such as [0.0, 0.0, 1.0]\nwindow.toml:29:10: plot[0].normal: is zero, which is no direction; write one such as [0.0, 0.0, 1.0]",
    );
    check(
        "[[light]]",
        "[[plot]]\nname = \"far\"\nkind = \"distance\"\nrange = [0, 10]\n\n[[light]]",
        "window.toml:26:10: plot[0].range[0]: must be greater than 0, as distances are drawn on a logarithmic axis, but is 0.0; write 0.1",
    );
}

#[test]
fn names_are_unique() {
    check(
        "[[light]]",
        "[[material]]\nname = \"floor\"\ndiffuse = [0, 0, 0]\n\n[[light]]",
        "window.toml:24:8: material[1].name: `floor` is there twice; give each its own name",
    );
    check(
        "[[light]]",
        "[[material]]\nname = \"\"\ndiffuse = [0, 0, 0]\n\n[[light]]",
        "window.toml:24:8: material[1].name: is empty; write a name",
    );
    check(
        "name = \"window\"\nposition",
        "name = \"a\\nb\"\nposition",
        "window.toml:24:8: light[0].name: \"a\\nb\" has control characters; write it on one line",
    );
}
#[test]
fn every_problem_is_told_at_once_in_the_order_of_the_text() {
    let text = "format = 1\n\n[[light]]\nname = 3\nshape = 3\nx = 3\n\n[[plot]]\nkind = \"tilted\"\n";
    insta::assert_snapshot!(refusal(text), @r#"
window.toml:4:8: light[0].name: must be text in quotes, but is the number 3
window.toml:5:9: light[0].shape: must be a table with one of `polygon`, `line`, `sphere`, `point`, `directional`, but is the number 3
window.toml:6:1: light[0].x: is not known here; known are `color`, `flux`, `illuminance`, `intensity`, `intensity_per_metre`, `luminance`, `muted`, `name`, `position`, `rotation_deg`, `shape`, `temperature_k`
window.toml:8:1: plot[0].name: is missing; write text in quotes (Unique among the plots of a scene)
window.toml:8:1: plot[0].range: is missing; write a list of 2 numbers (First and last abscissa: degrees for `tilt` and `view`, metres for `line` and `distance`)
window.toml:9:8: plot[0].kind: `tilted` is not known; known are `tilt`, `view`, `line`, `distance`
    "#);
}

#[test]
fn problems_beyond_a_hundred_are_counted() {
    let text = format!("format = 1\n{}", "[[light]]\n".repeat(60));
    let refusal = refusal(&text);
    assert_eq!(refusal.lines().count(), 101, "a hundred problems and a line that counts the rest");
    assert_eq!(refusal.lines().last(), Some("window.toml: and 20 problems more"), "60 lights lack name and shape");
}

#[test]
fn texts_that_are_no_scene_are_refused_at_their_first_fault() {
    for (text, expected) in [
        ("", "window.toml:1:1: format: is missing; write 1 (The number of the format)"),
        ("hello", "window.toml:1:6: is not TOML: key with no value, expected `=`"),
        ("{\"format\": 1}", "window.toml:1:1: is not TOML: invalid key-value pair, expected key"),
        (
            &format!("format = 1\nname = {}", "[".repeat(100_000)),
            "window.toml:2:88: is not TOML: cannot recurse further; max recursion depth met",
        ),
    ] {
        assert_eq!(refusal(text), expected, "{}", text.get(..40).unwrap_or(text));
    }
}

#[test]
fn columns_count_characters_and_lines_may_end_in_crlf() {
    let text = "format = 1\r\n[display]\r\n\"é\" = 1\r\nexposure_ev = \"é\"\r\n";
    insta::assert_snapshot!(refusal(text), @r#"
window.toml:3:1: display.é: is not known here; only `exposure_ev` is
window.toml:4:15: display.exposure_ev: must be a number, but is text
    "#);
    insta::assert_snapshot!(refusal("format = 1\nname = \"é\" \"\"\n"), @"window.toml:2:12: is not TOML: unexpected key or value, expected newline, `#`");
}

/// The error of loading the file `name` in a new folder, after `make` has made it; the folder's name is left out.
#[track_caller]
fn file_refusal(name: &str, make: impl FnOnce(&Path)) -> String {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    make(&file);
    let error = scene::load(&file).expect_err("the file must be refused").to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn files_that_cannot_be_scenes_are_refused_unread() {
    insta::assert_snapshot!(file_refusal("absent.toml", |_| {}), @"absent.toml: cannot be read: No such file or directory (os error 2)");
    insta::assert_snapshot!(file_refusal("folder", |file| fs::create_dir(file).unwrap()), @"folder: cannot be read: it is a directory; name a scene file in it");
    // A sparse file: nobody could read it in the time that this test has.
    insta::assert_snapshot!(
        file_refusal("huge.toml", |file| fs::File::create(file).unwrap().set_len(1 << 40).unwrap()), @"huge.toml: cannot be read: it is larger than 16 MiB; no scene file is");
    insta::assert_snapshot!(file_refusal("empty.toml", |file| fs::write(file, "").unwrap()), @"empty.toml:1:1: format: is missing; write 1 (The number of the format)");
    insta::assert_snapshot!(
        file_refusal("latin1.toml", |file| fs::write(file, b"format = 1\nname = \"caf\xe9\"\n").unwrap()), @"latin1.toml:2:12: is not text in UTF-8; save the file as UTF-8");
}

#[cfg(unix)]
#[test]
fn a_file_without_end_is_cut_off() {
    insta::assert_snapshot!(scene::load("/dev/zero").expect_err("not a scene").to_string(), @"/dev/zero: cannot be read: it is larger than 16 MiB; no scene file is");
}

/// A new folder with the window scene in it.
fn folder_with_scene() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("window.toml");
    fs::write(&file, WINDOW).unwrap();
    (folder, file)
}

fn window() -> Scene {
    scene::parse(WINDOW, "window.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// The names in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<_> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn what_is_saved_is_loaded_and_nothing_else_is_left_in_the_folder() {
    let (folder, file) = folder_with_scene();
    let changed = Scene { name: "changed".to_owned(), ..window() };
    scene::save(&changed, &file).unwrap();
    assert_eq!(scene::load(&file).unwrap(), changed, "what was saved");
    assert_eq!(names(folder.path()), ["window.toml"], "no temporary file stays");
}

#[test]
fn a_scene_that_could_not_be_opened_again_is_not_saved() {
    let (folder, file) = folder_with_scene();
    let mut wrong = window();
    wrong.lights[0].position.z = f64::NAN;
    let error = scene::save(&wrong, &file).expect_err("NaN cannot be loaded").to_string();
    assert!(error.contains("window.toml: not saved, as it could not be opened again: light[0].position[2]"), "{error}");
    assert_eq!(fs::read_to_string(&file).unwrap(), WINDOW, "the old file stands");
    assert_eq!(names(folder.path()), ["window.toml"], "no temporary file stays");
}

#[test]
fn saving_never_changes_a_file_in_place() {
    // A second name of the old file still shows the old text: the new text came as another file.
    let (folder, file) = folder_with_scene();
    let witness = folder.path().join("witness.toml");
    fs::hard_link(&file, &witness).unwrap();
    scene::save(&Scene { name: "changed".to_owned(), ..window() }, &file).unwrap();
    assert_eq!(fs::read_to_string(&witness).unwrap(), WINDOW, "the old bytes are untouched");
    assert_ne!(fs::read_to_string(&file).unwrap(), WINDOW, "the name has the new text");
}

#[test]
fn a_failed_save_says_why_and_leaves_the_old_file() {
    let (folder, file) = folder_with_scene();
    let mut permissions = fs::metadata(&file).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&file, permissions).unwrap();
    let error = scene::save(&Scene::default(), &file).expect_err("the file is read-only").to_string();
    assert!(error.ends_with("window.toml: cannot be saved: the file is read-only"), "{error}");
    assert_eq!(fs::read_to_string(&file).unwrap(), WINDOW, "the old file stands");

    let absent = folder.path().join("absent").join("window.toml");
    let error = scene::save(&Scene::default(), &absent).expect_err("there is no such folder").to_string();
    assert!(error.contains("absent/window.toml: cannot be saved: "), "{error}");
    scene::save(&Scene::default(), folder.path()).expect_err("a folder is no file");
    assert_eq!(names(folder.path()), ["window.toml"], "no temporary file stays");
}

#[cfg(unix)]
#[test]
fn saving_keeps_permissions_and_follows_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let (folder, file) = folder_with_scene();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o600)).unwrap();
    let link = folder.path().join("link.toml");
    symlink("window.toml", &link).unwrap();
    let changed = Scene { name: "changed".to_owned(), ..window() };
    scene::save(&changed, &link).unwrap();
    assert!(link.is_symlink(), "the link is still one");
    assert_eq!(scene::load(&file).unwrap(), changed, "its target has the scene");
    assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o600, "as private as before");

    let other = folder.path().join("other.toml");
    fs::write(&other, "").unwrap();
    let usual = fs::metadata(&other).unwrap().permissions().mode();
    let new = folder.path().join("new.toml");
    scene::save(&changed, &new).unwrap();
    assert_eq!(fs::metadata(&new).unwrap().permissions().mode(), usual, "a new file is as any new file");
}

/// `softbox check` in a folder that has the window scene: its exit status, standard output and error.
fn run_check(arguments: &[&str]) -> (Option<i32>, String, String) {
    let (folder, file) = folder_with_scene();
    fs::write(folder.path().join("wrong.toml"), with("luminance = 1000.0", "luminance = -3")).unwrap();
    assert!(file.exists(), "the scene is there");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_softbox"))
        .arg("check")
        .args(arguments)
        .current_dir(folder.path())
        .output()
        .unwrap();
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    (output.status.code(), out, err)
}

#[test]
fn check_answers_by_its_exit_status() {
    let problem =
        "wrong.toml:26:13: light[0].luminance: must not be negative, but is -3.0; write a number such as 1000.0\n";
    assert_eq!(run_check(&["window.toml"]), (Some(0), String::new(), String::new()), "a right scene");
    assert_eq!(run_check(&["window.toml", "wrong.toml"]), (Some(1), problem.to_owned(), String::new()), "a wrong one");
    let (status, out, err) = run_check(&["."]);
    assert_eq!((status, out.as_str()), (Some(2), ""), "a folder is bad use");
    assert_eq!(err, "softbox: .: cannot be read: it is a directory; name a scene file in it\n", "in one line");
}

/// The presets in a folder: file name, text and scene.
fn presets(folder: &str) -> Vec<(String, String, Scene)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets").join(folder);
    let open = |name: String| {
        let text = fs::read_to_string(folder.join(&name)).unwrap();
        let scene = scene::load(folder.join(&name)).unwrap_or_else(|error| panic!("{error}"));
        (name, text, scene)
    };
    names(&folder).into_iter().map(open).collect()
}

#[test]
fn every_preset_opens_and_is_saved_byte_for_byte() {
    for (name, text, scene) in presets("scenes").into_iter().chain(presets("lights")) {
        assert_eq!(scene::to_toml(&scene), text, "{name} is as Softbox writes it");
        assert!(!scene.name.is_empty(), "{name} has a title");
    }
}

#[test]
fn there_are_enough_presets_of_each_kind() {
    let (scenes, lights) = (presets("scenes"), presets("lights"));
    assert!(scenes.len() >= 8 && lights.len() >= 8, "{} scenes, {} lights", scenes.len(), lights.len());
    for (name, _, scene) in &scenes {
        assert!(!scene.lights.is_empty() && !scene.plots.is_empty(), "{name} has lights and plots");
    }
    for (name, _, scene) in &lights {
        let only_lights = Scene { name: scene.name.clone(), lights: scene.lights.clone(), ..Scene::default() };
        assert!(!scene.lights.is_empty(), "{name} has a light");
        assert_eq!(*scene, only_lights, "{name} has nothing else");
    }
}

#[test]
fn preset_scenes_show_all_that_the_schema_knows() {
    let all: String = presets("scenes").into_iter().map(|(_, text, _)| text).collect();
    for (definition, pattern) in [("Shape", "{ NAME = "), ("Shape2", "{ NAME = "), ("PlotKind", "kind = \"NAME\"")] {
        let schema = scene::schema();
        let variants = schema["$defs"][definition]["oneOf"].as_array().expect("an enum of the format");
        for variant in variants {
            let name = variant["const"].as_str().or(variant["required"][0].as_str()).expect("a name");
            assert!(all.contains(&pattern.replace("NAME", name)), "no scene has {name}");
        }
    }
}

#[test]
fn every_preset_renders_finite_and_lit() {
    let settings = Settings { size: [24, 14], choice: MethodChoice::Method(Method::Exact), samples: 1 };
    let floor = scene::first_light();
    for (name, _, mut preset) in presets("scenes").into_iter().chain(presets("lights")) {
        if preset.surfaces.is_empty() {
            // A light alone is shown over a floor.
            preset.surfaces = floor.surfaces.clone();
            preset.materials = floor.materials.clone();
        }
        let film = render(&preset, &settings, &Progress::default()).expect("not cancelled");
        assert!(film.radiance().iter().all(|pixel| pixel.is_finite()), "{name} is finite");
        assert!(film.radiance().iter().any(|pixel| pixel.max_element() > 0.0), "{name} is lit");
    }
}

/// Numbers of every magnitude that a scene may hold.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, -1e9..1e9, -1e-9..1e-9, Just(0.0), Just(0.1 + 0.2)]
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..10.0, 1e-12..1e-3, 10.0..1e9]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from)
}

/// Names with what TOML must escape.
fn name() -> impl Strategy<Value = String> {
    r#"[a-z"'\\# \[\]=.\u{e9}\u{1f4a1}]{1,12}"#
}

fn light_shape() -> impl Strategy<Value = light::Shape> {
    let polygon = (proptest::collection::vec(positive(), 3..12), any::<bool>()).prop_map(|(radii, two_sided)| {
        // About its centre, a vertex every equal angle: simple whatever the radii.
        let turn = std::f64::consts::TAU / radii.len() as f64;
        let vertices = radii.iter().enumerate().map(|(i, r)| *r * DVec2::from_angle(turn * i as f64)).collect();
        light::Shape::Polygon(light::Polygon { vertices, two_sided })
    });
    let line = (positive(), 0.0..=3.0).prop_map(|(length, falloff)| light::Line {
        length,
        emission: light::LineEmission::Isotropic,
        falloff,
    });
    prop_oneof![
        polygon,
        line.prop_map(light::Shape::Line),
        positive().prop_map(|radius| light::Shape::Sphere(light::Sphere { radius })),
        Just(light::Shape::Point(light::Point {})),
        Just(light::Shape::Directional(light::Directional {})),
    ]
}

fn tint() -> impl Strategy<Value = Tint> {
    prop_oneof![
        Just(Tint::default()),
        [positive(), positive(), positive()].prop_map(|rgb| Tint::Color(rgb.into())),
        (1000.0..=40_000.0).prop_map(Tint::TemperatureK),
    ]
}

fn any_light() -> impl Strategy<Value = Light> {
    (name(), vector(), vector(), tint(), any::<bool>(), light_shape(), any::<bool>(), positive()).prop_map(
        |(name, position, rotation_deg, tint, muted, shape, last, value)| {
            let kinds = shape.quantity_kinds();
            let kind = kinds[if last { kinds.len() - 1 } else { 0 }];
            Light { name, position, rotation_deg, tint, quantity: Quantity::new(kind, value), muted, shape }
        },
    )
}

fn any_surface() -> impl Strategy<Value = Surface> {
    let size = || [positive(), positive(), positive()];
    let shape = prop_oneof![
        Just(surface::Shape::Plane {}),
        positive().prop_map(|radius| surface::Shape::Sphere { radius }),
        size().prop_map(|size| surface::Shape::Box { size: size.into() }),
        size().prop_map(|[x, y, _]| surface::Shape::Square { size: DVec2::new(x, y) }),
        positive().prop_map(|radius| surface::Shape::Disk { radius }),
        size().prop_map(|[radius, height, _]| surface::Shape::Cylinder { radius, height }),
        size().prop_map(|[radius, height, _]| surface::Shape::Cone { radius, height }),
    ];
    (name(), vector(), vector(), size(), shape).prop_map(|(name, position, rotation_deg, scale, shape)| Surface {
        name,
        material: "clay".to_owned(),
        position,
        rotation_deg,
        scale: scale.into(),
        shape,
    })
}

fn any_plot() -> impl Strategy<Value = Plot> {
    let kind = prop_oneof![Just(PlotKind::Tilt), Just(PlotKind::View), Just(PlotKind::Line), Just(PlotKind::Distance)];
    let material = proptest::option::of(Just("clay".to_owned()));
    (name(), kind, vector(), proptest::option::of(positive()), positive(), material, any::<bool>()).prop_map(
        |(name, kind, position, view, first, material, normalise)| Plot {
            name,
            kind,
            quantity: PlotQuantity::Radiance,
            position,
            normal: DVec3::new(first, 0.0, -1.0),
            view: view.map(DVec3::splat),
            axis: DVec3::X,
            range: [0.5 * first, first],
            material,
            normalise,
        },
    )
}

/// Rename so that no two are called the same.
fn number_names<T>(entries: &mut [T], name_of: impl Fn(&mut T) -> &mut String) {
    for (i, entry) in entries.iter_mut().enumerate() {
        name_of(entry).push_str(&i.to_string());
    }
}

fn any_scene() -> impl Strategy<Value = Scene> {
    use proptest::collection::vec;
    let camera = (vector(), 0.1..179.0)
        .prop_map(|(eye, fov_deg)| Camera { eye, target: eye + DVec3::splat(1.0 + 1e-3 * eye.length()), fov_deg })
        .prop_filter("the camera looks somewhere within the limits", |camera| camera.target.max_element() < 1e9);
    (name(), camera, -100.0..=100.0, vec(any_surface(), 0..4), vec(any_light(), 0..4), vec(any_plot(), 0..3)).prop_map(
        |(name, camera, exposure_ev, mut surfaces, mut lights, mut plots)| {
            number_names(&mut surfaces, |surface| &mut surface.name);
            number_names(&mut lights, |light| &mut light.name);
            number_names(&mut plots, |plot| &mut plot.name);
            let clay =
                Material { name: "clay".to_owned(), diffuse: DVec3::splat(0.3), specular: DVec3::ZERO, exponent: 1.5 };
            let display = Display { exposure_ev };
            Scene { name, camera, display, materials: vec![clay], surfaces, lights, plots }
        },
    )
}

proptest! {
    #[test]
    fn any_scene_is_read_as_it_was_written(scene in any_scene()) {
        let text = scene::to_toml(&scene);
        let read = scene::parse(&text, "any.toml").map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))?;
        prop_assert_eq!(&read, &scene, "the same scene");
        prop_assert_eq!(scene::to_toml(&read), text, "the same text");
    }

    #[test]
    fn no_text_makes_the_loader_panic(edit in 0..WINDOW.len(), insertion in ".{0,3}", cut in 0..40_usize) {
        let mut text = WINDOW.to_owned();
        let start = text.floor_char_boundary(edit);
        let end = text.ceil_char_boundary((edit + cut).min(text.len()));
        text.replace_range(start..end, &insertion);
        if let Err(error) = scene::parse(&text, "any.toml") {
            prop_assert!(error.to_string().starts_with("any.toml:"), "{}", error);
        }
    }
}
