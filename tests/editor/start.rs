//! The editor where it cannot open: one line, exit status 2, and what can be done instead.

use std::process::{Command, Output};

/// The program without a display, and then with these variables set.
fn start(variables: &[(&str, &str)]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_softbox"));
    for variable in ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"] {
        command.env_remove(variable);
    }
    command.env_remove("RUST_LOG").envs(variables.iter().copied()).output().expect("the program starts")
}

#[track_caller]
fn check(output: &Output, says: &str) {
    let error = String::from_utf8_lossy(&output.stderr);
    // Graphics drivers may complain on their own; the program's own lines start with its name.
    let own: Vec<&str> = error.lines().filter(|line| line.starts_with("softbox")).collect();
    assert_eq!(own.len(), 1, "one line, not:\n{error}");
    assert!(own[0].contains(says) && own[0].contains("render"), "{}", own[0]);
    assert!(!error.contains("panicked"), "no panic:\n{error}");
    assert_eq!(output.status.code(), Some(2), "exit status");
}

#[test]
fn without_a_display_the_headless_commands_are_named() {
    check(&start(&[]), "no display");
}

#[test]
fn a_display_that_is_not_there_is_no_display() {
    check(&start(&[("DISPLAY", ":4711")]), "no display");
}

#[test]
fn without_an_adapter_the_headless_commands_are_named() {
    // Vulkan and OpenGL find no driver.
    let none = [("DISPLAY", ":4711"), ("VK_DRIVER_FILES", "/dev/null"), ("VK_ICD_FILENAMES", "/dev/null")];
    let gl = [("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null")];
    check(&start(&[&none[..], &gl[..]].concat()), "no graphics adapter");
}
