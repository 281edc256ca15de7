//! Groups and links of lights, and variants: read, refused, saved.

use softbox::scene::{self, Scene};

use super::{SHAPE, WINDOW, check};

/// The window scene with a variant beside it, as people write one.
const EVENING: &str = include_str!("../data/evening.toml");

fn evening() -> Scene {
    scene::parse(EVENING, "evening.toml").unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn groups_links_and_variants_are_read_and_written_byte_for_byte() {
    let scene = evening();
    assert_eq!(scene.lights[0].group.as_deref(), Some("key lights"), "the group");
    assert!(scene.lights[0].reaches("ball") && !scene.lights[0].reaches("floor"), "linked to the ball");
    assert!(scene.lights[1].reaches("floor"), "a light without links reaches everything");
    let names = |lights: &[softbox::light::Light]| lights.iter().map(|light| light.name.clone()).collect::<Vec<_>>();
    let variants: Vec<_> =
        scene.variants.iter().map(|variant| (variant.name.as_str(), names(&variant.lights))).collect();
    assert_eq!(variants, [("evening", vec!["lamp".to_owned()]), ("dark", Vec::new())], "the variants");
    assert_eq!(scene.active_variant.as_deref(), Some("evening"), "the active one");
    assert_eq!(scene::to_toml(&scene), EVENING, "saving what was loaded changes nothing");
}

#[test]
fn a_group_without_name_and_links_to_nothing_known_are_refused() {
    let shape = |keys: &str| format!("{keys}\nshape = {{ {SHAPE} }}");
    let passage = &shape("");
    let passage = passage.trim_start();
    let expected = "window.toml:27:9: light[0].group: is empty; write a name, or leave it out";
    check(passage, &shape("group = \"\""), expected);
    let expected = "window.toml:27:9: light[0].only[0]: there is no surface `flour`; did you mean `floor`?";
    check(passage, &shape("only = [\"flour\"]"), expected);
    let expected = "window.toml:27:18: light[0].only[1]: `floor` is there twice; write each surface once";
    check(passage, &shape("only = [\"floor\", \"floor\"]"), expected);
    let expected = "window.toml:27:8: light[0].only: must be a list of texts in quotes, but is text";
    check(passage, &shape("only = \"floor\""), expected);
    check(
        passage,
        &shape("only = [1]"),
        "window.toml:27:9: light[0].only[0]: must be text in quotes, but is the number 1",
    );
}

#[test]
fn the_lights_of_variants_are_held_to_the_same_rules() {
    let refusal = |passage: &str, replacement: &str| {
        assert_eq!(EVENING.matches(passage).count(), 1, "`{passage}` must stand in the scene once");
        let text = EVENING.replace(passage, replacement);
        scene::parse(&text, "evening.toml").expect_err("it must be refused").to_string()
    };
    let expected = "evening.toml:49:17: variant[0].light[0].temperature_k: must be at least 1000, but is 27.0; \
                    write kelvins from 1000.0 to 40000.0";
    assert_eq!(refusal("2700.0", "27"), expected, "a value");
    let expected =
        "evening.toml:46:1: variant[0].light[0]: does not say how bright it is; a `sphere` takes `luminance` or `flux`";
    assert_eq!(refusal("flux = 800.0\n", ""), expected, "what is contradictory");
    let expected = "evening.toml:51:9: variant[0].light[0].shape: has both `point` and `sphere`; keep one of the two";
    let shape = "{ sphere = { radius = 0.1 } }";
    assert_eq!(refusal(shape, "{ sphere = { radius = 0.1 }, point = {} }"), expected, "the structure");
    let expected = "evening.toml:3:18: active_variant: there is no variant `evning`; did you mean `evening`?";
    assert_eq!(refusal("active_variant = \"evening\"", "active_variant = \"evning\""), expected, "the active one");
    let expected = "evening.toml:54:8: variant[1].name: `evening` is there twice; give each its own name";
    assert_eq!(refusal("name = \"dark\"", "name = \"evening\""), expected, "names of variants");
}

#[test]
fn a_pattern_that_only_a_variant_has_is_looked_for_too() {
    let text = WINDOW.to_owned()
        + "\n[[variant]]\nname = \"leaves\"\n\n[[variant.light]]\nname = \"gobo\"\nflux = 100.0\n"
        + "shape = { textured = { size = [1.0, 1.0], pattern = \"leaf.png\" } }\n";
    let error = scene::parse(&text, "window.toml").expect_err("there is no such file").to_string();
    let place = "window.toml:35:53: variant[0].light[0].shape.textured.pattern: `leaf.png` cannot be read";
    assert!(error.starts_with(place), "{error}");
}

#[test]
fn a_change_in_a_variant_leaves_the_rest_of_the_file_as_it_was_written() {
    let text = EVENING.replace("[[variant.light]]", "# Over the table\n[[variant.light]] # from 6 o’clock");
    let mut scene = evening();
    scene.variants[0].lights[0].position.z = 1.25;
    let moved = text.replace("position = [0.0, 0.0, 1.0]", "position = [0.0, 0.0, 1.25]");
    assert_ne!(moved, text, "the lamp stands at this place");
    assert_eq!(scene::merge(&text, &scene), moved, "one number");
    let spare = scene.variants[0].lights[0].clone();
    scene.variants[1].lights.push(softbox::light::Light { name: "candle".to_owned(), ..spare });
    scene.variants.swap(0, 1);
    scene.active_variant = None;
    let merged = scene::merge(&text, &scene);
    let read = scene::parse(&merged, "evening.toml").unwrap_or_else(|error| panic!("{error}\n{merged}"));
    assert_eq!(read, scene, "the same scene");
    assert!(merged.contains("# Over the table\n[[variant.light]] # from 6 o’clock\nname = \"lamp\""), "{merged}");
}
