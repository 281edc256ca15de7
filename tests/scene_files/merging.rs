//! Saving over what people wrote: comments, order and form stay where nothing changed.

use std::fs;

use glam::{DVec2, DVec3};
use softbox::light::{Quantity, QuantityKind, Shape, Tint};
use softbox::scene::{self, Scene};

/// A scene as nobody but its author would write it.
const ROOM: &str = include_str!("../data/room.toml");

/// The three lights in it, each from the empty line above it.
const LIGHTS: [&str; 3] =
    ["\n# The window to the courtyard", "\n# The tube over the door", "\n[[light]] # behind the desk"];

fn room() -> Scene {
    scene::parse(ROOM, "room.toml").unwrap_or_else(|error| panic!("{error}"))
}

/// The room's file before its lights, each light's passage, and what follows.
fn passages() -> (&'static str, [&'static str; 3], &'static str) {
    let [window, tube, globe] = LIGHTS.map(|start| ROOM.find(start).expect("a light starts so"));
    let end = ROOM.find("\n# The end.").expect("the file ends so");
    (&ROOM[..window], [&ROOM[window..tube], &ROOM[tube..globe], &ROOM[globe..end]], &ROOM[end..])
}

/// What stands in the file after an edit of the room.
#[track_caller]
fn edited(edit: impl FnOnce(&mut Scene)) -> String {
    let mut scene = room();
    edit(&mut scene);
    let text = scene::merge(ROOM, &scene);
    let read = scene::parse(&text, "room.toml").unwrap_or_else(|error| panic!("{error}\n{text}"));
    assert_eq!(read, scene, "what was saved");
    text
}

/// That an edit changes these passages of the file, and nothing else.
#[track_caller]
fn check(edit: impl FnOnce(&mut Scene), changes: &[(&str, &str)]) {
    let mut expected = ROOM.to_owned();
    for (passage, replacement) in changes {
        assert_eq!(expected.matches(passage).count(), 1, "`{passage}` must stand in the file once");
        expected = expected.replace(passage, replacement);
    }
    pretty(&edited(edit), &expected);
}

/// Equality of texts, shown as they are.
#[track_caller]
fn pretty(text: &str, expected: &str) {
    assert!(text == expected, "found:\n{text}\nexpected:\n{expected}");
}

#[test]
fn an_unchanged_scene_leaves_the_file_byte_for_byte() {
    pretty(&scene::merge(ROOM, &room()), ROOM);
    let windows = ROOM.replace('\n', "\r\n");
    pretty(&scene::merge(&windows, &room()), &windows);
}

#[test]
fn a_change_of_one_number_changes_one_line() {
    let luminance = |value| Quantity::new(QuantityKind::Luminance, value);
    check(|room| room.lights[0].quantity = luminance(1500.0), &[("= 1_000 ", "= 1500.0 ")]);
    check(|room| room.lights[0].position.z = 2.5, &[("position = [0, 0, 2]", "position = [0, 0, 2.5]")]);
    check(|room| room.camera.eye.x = 1.0, &[("eye = [0, -6, 2.5]", "eye = [1.0, -6, 2.5]")]);
    check(|room| room.materials[0].exponent = 64.0, &[("exponent = 32", "exponent = 64.0")]);
    check(|room| room.name = "South room".to_owned(), &[("'North room'", "\"South room\"")]);
    check(|room| room.lights[0].muted = true, &[("muted = false", "muted = true")]);
    let longer = |shape: &mut Shape| match shape {
        Shape::Line(line) => line.length = 1.5,
        _ => panic!("the tube is a line"),
    };
    check(|room| longer(&mut room.lights[1].shape), &[("length = 1.2 # m", "length = 1.5 # m")]);
}

#[test]
fn lines_end_as_they_did() {
    let windows = ROOM.replace('\n', "\r\n");
    let scene = Scene { name: "South room".to_owned(), ..room() };
    pretty(&scene::merge(&windows, &scene), &windows.replace("'North room'", "\"South room\""));
}

#[test]
fn a_key_comes_where_softbox_writes_it_and_goes_with_its_comment() {
    check(|room| room.lights[1].muted = true, &[("flux = 2.5e3 # lm\n", "flux = 2.5e3 # lm\nmuted = true\n")]);
    check(|room| room.name.clear(), &[("name   = 'North room'   # what visitors call it\n", "")]);
    check(|room| room.lights[2].position = DVec3::ZERO, &[("position = [-2, 0, 1] # by eye\n", "")]);
    check(|room| room.camera.fov_deg = 30.0, &[("0.5] }  #", "0.5], fov_deg = 30.0 }  #")]);
    check(
        |room| room.display.exposure_ev = 1.0,
        &[("\n# ---- Materials", "\n[display]\nexposure_ev = 1.0\n\n# ---- Materials")],
    );
}

#[test]
fn a_deleted_light_takes_its_own_comments_only() {
    let (_, lights, _) = passages();
    for (i, light) in lights.into_iter().enumerate() {
        check(|room| drop(room.lights.remove(i)), &[(light, "")]);
    }
    let (start, _, end) = passages();
    pretty(&edited(|room| room.lights.clear()), &[start, end].concat());
}

#[test]
fn a_renamed_light_keeps_its_comments() {
    check(|room| room.lights[0].name = "court".to_owned(), &[("name = \"window\"", "name = \"court\"")]);
    check(
        |room| {
            room.lights[2].name = "lamp".to_owned();
            room.lights[2].position.z = 1.5;
        },
        &[("name = \"globe\"", "name = \"lamp\""), ("[-2, 0, 1]", "[-2, 0, 1.5]")],
    );
}

#[test]
fn a_new_light_is_written_as_softbox_does_after_the_one_before_it() {
    let copy = "\n[[light]]\nname = \"globe 2\"\nposition = [-2.0, 0.0, 1.0]\nluminance = 400.0\n\
                shape = { sphere = { radius = 0.15 } }\n";
    let (start, [window, tube, globe], end) = passages();
    for (at, expected) in [
        (3, [start, window, tube, globe, copy, end].concat()),
        (2, [start, window, tube, copy, globe, end].concat()),
        (0, [start, copy, window, tube, globe, end].concat()),
    ] {
        let text = edited(|room| {
            let mut light = room.lights[2].clone();
            "globe 2".clone_into(&mut light.name);
            room.lights.insert(at, light);
        });
        pretty(&text, &expected);
    }
}

#[test]
fn reordered_lights_take_their_comments_along() {
    let (start, [window, tube, globe], end) = passages();
    pretty(&edited(|room| room.lights.rotate_left(1)), &[start, tube, globe, window, end].concat());
    pretty(&edited(|room| room.lights.reverse()), &[start, globe, tube, window, end].concat());
}

#[test]
fn a_list_of_another_length_keeps_an_item_a_line() {
    let vertices = "[\n  [-1.0, -0.5],\n  [1.0, -0.5],\n  [1.0, 0.5],\n  [0.0, 0.75],\n  [-1.0, 0.5],\n]";
    let start = ROOM.find("[\n  [-1, -0.5]").expect("the list starts so");
    let end = start + ROOM[start..].find("\n]").expect("the list ends so") + 2;
    let edit = |room: &mut Scene| match &mut room.lights[0].shape {
        Shape::Polygon(polygon) => polygon.vertices.insert(3, DVec2::new(0.0, 0.75)),
        _ => panic!("the window is a polygon"),
    };
    check(edit, &[(&ROOM[start..end], vertices)]);
}

#[test]
fn a_default_that_contradicts_the_new_scene_goes() {
    let text = edited(|room| room.lights[2].tint = Tint::TemperatureK(3000.0));
    assert!(!text.contains("color"), "a temperature takes its place:\n{text}");
    assert!(text.contains("\n[[light]] # behind the desk\nname = \"globe\"\n"), "its comment stays:\n{text}");
    assert!(text.contains("luminance = 1_000           # cd/m², at noon"), "so do the others':\n{text}");
}

#[test]
fn what_is_not_a_scene_is_written_over() {
    for text in ["", "# notes\n", "format = 1\nname = 3 # no name\n", "format = 99 # of the future\n"] {
        pretty(&scene::merge(text, &room()), &scene::to_toml(&room()));
    }
}

#[test]
fn save_as_takes_the_comments_of_the_file_that_was_loaded() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let [source, target] = ["room.toml", "other.toml"].map(|name| folder.path().join(name));
    fs::write(&source, ROOM).expect("the folder is writable");
    fs::write(&target, "# another's comment\nformat = 1\n").expect("the folder is writable");
    let changed = Scene { name: "South room".to_owned(), ..room() };
    let expected = ROOM.replace("'North room'", "\"South room\"");
    scene::save_as(&changed, &target, &source).unwrap();
    pretty(&fs::read_to_string(&target).unwrap(), &expected);
    pretty(&fs::read_to_string(&source).unwrap(), ROOM);
    scene::save(&changed, &source).unwrap();
    pretty(&fs::read_to_string(&source).unwrap(), &expected);
}
