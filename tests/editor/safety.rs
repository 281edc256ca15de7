//! Work is not lost: autosave and recovery, failed saves, and undo of everything.

use std::fs;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use softbox::scene;

use crate::window::Window;

/// Make the document differ from its file.
fn modify(window: &mut Window) {
    window.click("strip");
    window.enter("Length", "3.5");
}

/// Let the window's clock go on.
fn wait(window: &mut Window, seconds: f64) {
    let now = window.harness.ctx.input(|input| input.time);
    window.harness.input_mut().time = Some(now + seconds);
    window.harness.step();
    window.harness.input_mut().time = None;
    window.settle();
}

/// The recovery files there are.
fn notes(window: &Window) -> usize {
    let windows = fs::read_dir(window.path("data/recovery")).expect("the recovery folder").flatten();
    let numbered = windows.flat_map(|window| fs::read_dir(window.path()).expect("a window's folder").flatten());
    numbered.filter(|entry| entry.path().join("recovery.json").exists()).count()
}

#[test]
fn unsaved_work_is_written_aside_after_half_a_minute_and_recovered_after_a_crash() {
    let mut window = Window::with_scene();
    wait(&mut window, 100.0);
    assert_eq!(notes(&window), 0, "nothing is written while nothing has changed");
    modify(&mut window);
    wait(&mut window, 20.0);
    assert_eq!(notes(&window), 0, "not yet");
    wait(&mut window, 15.0);
    assert_eq!(notes(&window), 1, "after 30 s");
    let modified = window.scene();
    let mut window = window.crash();
    assert!(window.says("Recover “scene.toml”?"), "it is offered");
    window.snapshot("recover");
    window.click("Recover");
    assert_eq!(window.scene(), modified, "what was not saved");
    assert!(window.session().history.is_modified(), "it still has to be saved");
    assert!(window.session().path.as_ref().is_some_and(|path| path.ends_with("scene.toml")), "it knows its file");
    assert_eq!(notes(&window), 1, "written aside anew, and what was left is gone");
    window.key(Modifiers::COMMAND, Key::S);
    assert_eq!(notes(&window), 0, "saved: nothing is to be recovered");
    assert_eq!(scene::load(window.path("scene.toml")).expect("it opens"), *modified, "the file has it");
    let window = window.crash();
    assert!(!window.says("Recover “"), "nothing is offered");
}

#[test]
fn work_that_is_not_wanted_is_discarded() {
    let mut window = Window::with_scene();
    modify(&mut window);
    wait(&mut window, 1.0);
    wait(&mut window, 31.0);
    let mut window = window.crash();
    window.click("Discard work");
    assert!(!window.says("Recover “"), "asked once");
    assert_eq!(notes(&window), 0, "gone");
    let window = window.crash();
    assert!(!window.says("Recover “"), "and not asked again");
}

#[test]
fn a_failed_save_loses_nothing_says_why_and_offers_another_place() {
    let mut window = Window::with_scene();
    modify(&mut window);
    let path = window.path("scene.toml");
    let text = fs::read_to_string(&path).expect("the scene");
    let mut permissions = fs::metadata(&path).expect("the scene").permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&path, permissions).expect("made read-only");
    let modified = window.scene();
    window.key(Modifiers::COMMAND, Key::S);
    assert!(window.says("cannot be saved"), "the user is told");
    assert_eq!(fs::read_to_string(&path).expect("the scene"), text, "the file is as it was");
    assert!(window.session().history.is_modified(), "the document still has to be saved");
    assert_eq!(window.scene(), modified, "nothing is lost");
    let elsewhere = window.path("elsewhere.toml");
    window.choose(Some(&elsewhere));
    window.click("Save elsewhere…");
    assert!(!window.session().history.is_modified(), "saved");
    assert_eq!(scene::load(elsewhere).expect("it opens"), *modified, "there");
}

#[test]
fn what_was_deleted_comes_back_from_its_message() {
    let mut window = Window::with_scene();
    let before = window.scene();
    window.click_role(Role::Button, "globe");
    window.key(Modifiers::NONE, Key::Delete);
    assert!(window.says("Deleted globe"), "the user is told");
    window.click("Undo this");
    assert_eq!(window.scene(), before, "it is back");
    assert!(!window.has("Undo this"), "the message is gone");
}
