//! Scene files: loading, refusing, saving.

use softbox::scene;

#[test]
fn a_file_that_was_written_by_softbox_is_written_again_byte_for_byte() {
    let text = include_str!("data/window.toml");
    let scene = scene::parse(text, "window.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene::to_toml(&scene), text, "saving what was loaded changes nothing");
}
