//! Opening, saving, and not losing work.

use std::path::Path;
use std::sync::Arc;

use egui::{Key, Modifiers};
use softbox::editor::dialogs::Reply;
use softbox::scene;

use egui_kittest::kittest::Queryable;

use crate::window::{SCENE, Window};

/// Make the document differ from its file.
fn modify(window: &mut Window) {
    window.click("strip");
    window.enter("Length", "3.5");
    assert!(window.session().history.is_modified(), "the number was not taken");
}

#[test]
fn a_scene_is_changed_saved_and_opened_again() {
    let mut window = Window::with_scene();
    modify(&mut window);
    window.key(Modifiers::COMMAND, Key::S);
    assert!(!window.session().history.is_modified(), "saved");
    assert!(window.says("Saved scene.toml"), "the user is told");
    let saved = window.scene();
    window.key(Modifiers::COMMAND, Key::N);
    assert!(window.scene().lights.is_empty(), "a new document has no lights");
    let path = window.path("scene.toml");
    window.choose(Some(&path));
    window.key(Modifiers::COMMAND, Key::O);
    assert_eq!(window.scene(), saved, "what was saved is what is opened");
    assert_eq!(window.session().path.as_deref(), Some(path.as_path()), "the document knows its file");
}

#[test]
fn a_new_document_asks_where_to_be_saved_and_gets_an_extension() {
    let mut window = Window::new();
    window.menu(&["Add", "Light", "Sphere"]);
    let path = window.path("mine");
    window.choose(Some(&path));
    window.key(Modifiers::COMMAND, Key::S);
    let saved = scene::load(window.path("mine.toml")).expect("the file is there");
    assert_eq!(saved, *window.scene(), "the file holds the document");
}

#[test]
fn a_cancelled_dialog_changes_nothing() {
    let mut window = Window::with_scene();
    let before = window.scene();
    window.choose(None);
    window.key(Modifiers::COMMAND, Key::O);
    assert!(Arc::ptr_eq(&before, &window.scene()), "the document is untouched");
}

#[test]
fn a_desktop_without_dialogs_is_told_of() {
    let mut window = Window::with_scene();
    window.reply(Reply::Unavailable);
    window.key(Modifiers::COMMAND, Key::O);
    assert!(window.says("no file dialog"), "the user is told");
}

#[test]
fn unsaved_work_is_asked_about_and_cancel_keeps_it() {
    let mut window = Window::with_scene();
    modify(&mut window);
    let modified = window.scene();
    window.key(Modifiers::COMMAND, Key::N);
    assert!(window.says("Save changes to"), "the question is asked");
    window.click("Cancel");
    assert_eq!(window.scene(), modified, "still there");
    assert!(!window.says("Save changes to"), "the question is gone");
}

#[test]
fn unsaved_work_can_be_discarded_or_saved_before_going_on() {
    for (answer, saved) in [("Discard", false), ("Save", true)] {
        let mut window = Window::with_scene();
        modify(&mut window);
        let modified = window.scene();
        window.key(Modifiers::COMMAND, Key::N);
        let in_dialog = window.harness.get_all_by_label(answer).last().expect("the answer's button");
        in_dialog.click();
        window.settle();
        assert!(window.scene().lights.is_empty(), "{answer}: the new document is open");
        let in_file = scene::load(window.path("scene.toml")).expect("the file is still good");
        assert_eq!(in_file == *modified, saved, "{answer}: what the file holds");
    }
}

#[test]
fn closing_the_window_asks_about_unsaved_work() {
    let mut window = Window::with_scene();
    modify(&mut window);
    let root = window.harness.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default();
    root.events.push(egui::ViewportEvent::Close);
    window.harness.step();
    let commands = &window.harness.output().viewport_output[&egui::ViewportId::ROOT].commands;
    assert!(commands.contains(&egui::ViewportCommand::CancelClose), "closing is held up: {commands:?}");
    window.harness.input_mut().viewports.entry(egui::ViewportId::ROOT).or_default().events.clear();
    window.settle();
    assert!(window.says("Save changes to"), "the question is asked");
}

#[test]
fn a_bad_file_is_told_once_and_the_document_stays() {
    let mut window = Window::with_scene();
    let before = window.scene();
    let bad = window.path("bad.toml");
    std::fs::write(&bad, SCENE.replace("radius = 0.2", "radius = -0.2")).expect("the bad file is written");
    window.choose(Some(&bad));
    window.key(Modifiers::COMMAND, Key::O);
    assert!(window.says("bad.toml:"), "file and line are named");
    assert_eq!(window.scene(), before, "the document stays");
    window.click("Dismiss message 1");
    assert!(!window.says("bad.toml:"), "dismissed");
}

/// A file dropped on the window.
#[derive(Debug)]
struct Dropped(std::path::PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

#[test]
fn a_scene_dropped_on_the_window_is_opened() {
    let mut window = Window::new();
    let path = window.path("dropped.toml");
    std::fs::write(&path, SCENE).expect("the file is written");
    window.harness.input_mut().dropped_files.push(Arc::new(Dropped(path.clone())));
    window.harness.step();
    window.settle();
    assert_eq!(window.session().path.as_deref(), Some(path.as_path()), "opened");
    assert_eq!(window.scene().lights.len(), 3, "all of it");
}

#[test]
fn a_mesh_dropped_on_the_window_is_added() {
    let mut window = Window::with_scene();
    let before = window.scene().surfaces.len();
    let path = window.path("dropped.OBJ");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("the file is written");
    window.harness.input_mut().dropped_files.push(Arc::new(Dropped(path)));
    window.harness.step();
    window.settle();
    let scene = window.scene();
    assert_eq!(scene.surfaces.len(), before + 1, "one more");
    assert!(scene::to_toml(&scene).contains("shape = { mesh = { file = \"dropped.OBJ\" } }"), "beside the scene");
}

#[test]
fn a_recent_file_can_be_opened_again_from_the_menu() {
    let mut window = Window::with_scene();
    window.key(Modifiers::COMMAND, Key::N);
    window.menu(&["File", "Open recent", "scene.toml"]);
    assert_eq!(window.scene().lights.len(), 3, "opened again");
}
