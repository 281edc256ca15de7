//! Files: what cannot be read, what is written, and what `softbox check` answers.

use std::fs;
use std::path::{Path, PathBuf};

use softbox::scene::{self, Scene};

use super::{WINDOW, names, window, with};

#[test]
fn a_file_that_was_written_by_softbox_is_written_again_byte_for_byte() {
    let scene = scene::parse(WINDOW, "window.toml").unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(scene::to_toml(&scene), WINDOW, "saving what was loaded changes nothing");
}

/// The error of loading the file `name` in a new folder, after `make` has made it; the folder's name is left out.
#[track_caller]
fn file_refusal(name: &str, make: impl FnOnce(&Path)) -> String {
    let folder = tempfile::tempdir().expect("a temporary folder");
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
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("window.toml");
    fs::write(&file, WINDOW).expect("the folder is writable");
    (folder, file)
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
    fs::write(folder.path().join("wrong.toml"), with("luminance = 1000.0", "luminance = -3"))
        .expect("the folder is writable");
    assert!(file.exists(), "the scene is there");
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_softbox"))
        .arg("check")
        .args(arguments)
        .current_dir(folder.path())
        .output()
        .expect("softbox starts");
    let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).expect("it writes UTF-8"));
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
