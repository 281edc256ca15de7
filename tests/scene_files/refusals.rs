//! What is refused, and what is said then.

use super::{SHAPE, VERTICES, check, refusal, with};

#[test]
fn the_format_comes_first() {
    check("format = 1", "", "window.toml:1:1: format: is missing; write 1 (The number of the format)");
    check("format = 1", "format = 99", "window.toml:1:10: format: is 99, which this Softbox cannot read; it reads 1");
    check("format = 1", "format = 1.5", "window.toml:1:10: format: must be 1, but is the number 1.5");
    check("format = 1", "format = \"one\"", "window.toml:1:10: format: must be 1, but is text");
    check("format = 1", "format = 1\nformat = 1", "window.toml:2:1: is not TOML: duplicate key");
}

#[test]
fn tags_are_words_said_once() {
    check(
        "format = 1",
        "format = 1\ntags = \"studio\"",
        "window.toml:2:8: tags: must be a list of texts in quotes, but is text",
    );
    check(
        "format = 1",
        "format = 1\ntags = [\" \"]",
        "window.toml:2:9: tags[0]: is empty; write a word such as \"studio\"",
    );
    check(
        "format = 1",
        "format = 1\ntags = [\"a\", \"a\"]",
        "window.toml:2:14: tags[1]: `a` is there twice; keep one of the two",
    );
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
fn the_numbers_of_disks_caps_skies_and_rectangles_are_within_their_limits() {
    let expected = "window.toml:27:29: light[0].shape.disk.radius: must be greater than 0, but is 0.0; \
                    write a length in metres such as 0.5";
    check(SHAPE, "disk = { radius = 0 }", expected);
    for (angle, wrong) in [
        ("0", "greater than 0, but is 0.0"),
        ("90.5", "at most 90, but is 90.5"),
        ("-10", "greater than 0, but is -10.0"),
    ] {
        let expected = format!(
            "window.toml:27:36: light[0].shape.cap.half_angle_deg: must be {wrong}; write an angle in degrees such as 30.0"
        );
        check(SHAPE, &format!("cap = {{ half_angle_deg = {angle} }}"), &expected);
    }
    check(
        SHAPE,
        "sky = { uniform = -0.5, cosine = inf }",
        "window.toml:27:29: light[0].shape.sky.uniform: must not be negative, but is -0.5; write a share such as 1.0\n\
         window.toml:27:44: light[0].shape.sky.cosine: must be finite, but is inf; write a share such as 1.0",
    );
    check(
        SHAPE,
        "sky = { uniform = 0, cosine = 0 }",
        "window.toml:27:17: light[0].shape.sky: is black; write { uniform = 1.0, cosine = 0.0 } and mute it to have it dark",
    );
    check(
        SHAPE,
        "sky = { uniform = 1 }",
        "window.toml:27:17: light[0].shape.sky.cosine: is missing; \
         write a number (The part that falls with the cosine of the angle from the zenith)",
    );
    check(
        "luminance = 1000.0\nshape = { polygon",
        "illuminance = 1000.0\nshape = { sky = { uniform = 1, cosine = 0 } } # { polygon",
        "window.toml:26:15: light[0].illuminance: does not fit a `sky`; write `luminance`",
    );
    check(
        SHAPE,
        "textured = { size = [1.0, 0.0], pattern = \"leaf.png\" }",
        "window.toml:27:37: light[0].shape.textured.size[1]: must be greater than 0, but is 0.0; \
         write a length in metres such as 0.5\nwindow.toml:27:53: light[0].shape.textured.pattern: `leaf.png` cannot be read: \
         there are no files beside this text; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder",
    );
    for name in ["", "/etc/passwd", "a/../../b.png", "."] {
        let said = refusal(&with(SHAPE, &format!("textured = {{ size = [1.0, 1.0], pattern = \"{name}\" }}")));
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(said.contains("pattern: is empty") || said.contains("leaves the scene's folder"), "{said}");
    }
}

#[test]
fn the_numbers_of_reflection_models_are_within_their_limits() {
    let model = |text: &str| format!("exponent = 32.0\nmodel = {{ {text} }}");
    for (text, expected) in [
        (
            "cook-torrance = { roughness = 0, reflectance = 1.5 }",
            "window.toml:17:41: material[0].model.cook-torrance.roughness: must be at least 0.01, but is 0.0; \
             write a slope such as 0.3; smaller is sharper\n\
             window.toml:17:58: material[0].model.cook-torrance.reflectance: must be at most 1, but is 1.5; \
             write a share such as 0.04, which is glass",
        ),
        (
            "lafortune = { tangential = -1.5, normal = nan }",
            "window.toml:17:38: material[0].model.lafortune.tangential: must be at least -1, but is -1.5; \
             write a factor such as 0.9\n\
             window.toml:17:53: material[0].model.lafortune.normal: must be finite, but is NaN; write a factor such as 0.9",
        ),
        (
            "lafortune = { tangential = 0, normal = 0 }",
            "window.toml:17:23: material[0].model.lafortune: reflects nothing; \
             write { tangential = -1.0, normal = 1.0 }, which is Phong's",
        ),
        (
            "ward = {}",
            "window.toml:17:11: material[0].model.ward: is not known here; \
             known are `phong`, `blinn`, `cook-torrance`, `lafortune`",
        ),
        (
            "blinn = { exponent = 3 }",
            "window.toml:17:21: material[0].model.blinn.exponent: is not known here; there are none",
        ),
    ] {
        check("exponent = 32.0", &model(text), expected);
    }
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
        "window.toml:21:9: surface[0].shape: must be a table with one of `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`, `sphereflake`, `tetrahedron`, `patch`, `mesh`, but is text",
    );
    check(
        "{ plane = {} }",
        "{}",
        "window.toml:21:9: surface[0].shape: is empty; write one of `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`, `sphereflake`, `tetrahedron`, `patch`, `mesh`",
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
        "window.toml:21:11: surface[0].shape.plain: is not known here; known are `plane`, `sphere`, `box`, `square`, `disk`, `cylinder`, `cone`, `sphereflake`, `tetrahedron`, `patch`, `mesh`",
    );
    check(
        "material = \"floor\"",
        "material = \"flor\"",
        "window.toml:20:12: surface[0].material: there is no material `flor`; did you mean `floor`?",
    );
    check(
        "{ plane = {} }",
        "{ mesh = { file = \"../../etc/passwd\" } }",
        "window.toml:21:27: surface[0].shape.mesh.file: `../../etc/passwd` leaves the scene's folder; write a name such as \"meshes/chair.obj\"",
    );
    check(
        SHAPE,
        "textured = { size = [1.0, 1.0], pattern = \"../leaf.png\" }",
        "window.toml:27:53: light[0].shape.textured.pattern: `../leaf.png` leaves the scene's folder; write a name such as \"textures/leaf.png\"",
    );
    check(
        SHAPE,
        "line = { length = 1.0, emission = \"spot\" }",
        "window.toml:27:45: light[0].shape.line.emission: `spot` is not known; known are `isotropic`, `tube`",
    );
    check(
        "position = [0.0, 0.0, 2.0]",
        "scale = [2.0, 1.0, 1.0]",
        "window.toml:25:1: light[0].scale: is not known here; known are `color`, `flux`, `group`, `illuminance`, `intensity`, `intensity_per_metre`, `luminance`, `muted`, `name`, `only`, `position`, `rotation_deg`, `shape`, `temperature_k`",
    );
}

#[test]
fn tubes_have_a_radius_and_isotropic_lines_have_none() {
    check(
        &format!("luminance = 1000.0\nshape = {{ {SHAPE} }}"),
        "luminance = 1000.0\nshape = { line = { length = 1.0, emission = \"tube\" } }",
        "window.toml:27:45: light[0].shape.line.emission: is `tube`, which has a radius; write radius = 0.01 beside it",
    );
    check(
        &format!("luminance = 1000.0\nshape = {{ {SHAPE} }}"),
        "intensity_per_metre = 10.0\nshape = { line = { length = 1.0, radius = 0.01 } }",
        "window.toml:27:43: light[0].shape.line.radius: does not fit an `isotropic` line; write emission = \"tube\", or leave it out",
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
window.toml:5:9: light[0].shape: must be a table with one of `polygon`, `line`, `sphere`, `disk`, `textured`, `cap`, `sky`, `point`, `directional`, but is the number 3
window.toml:6:1: light[0].x: is not known here; known are `color`, `flux`, `group`, `illuminance`, `intensity`, `intensity_per_metre`, `luminance`, `muted`, `name`, `only`, `position`, `rotation_deg`, `shape`, `temperature_k`
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
