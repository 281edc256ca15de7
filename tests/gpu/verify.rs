//! The GPU's rows of `softbox verify`.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn reference(model: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference").join(model).with_extension("json")
}

fn verify() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_softbox"));
    command.arg("verify");
    command
}

fn text(output: &Output) -> (String, String) {
    (String::from_utf8_lossy(&output.stdout).into_owned(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn every_light_of_the_preview_has_a_row_that_is_right() {
    let models = [
        "disk_diffuse",
        "disk_phong",
        "hemi_lambert",
        "hemi_phong",
        "linear_diffuse",
        "linear_phong",
        "polygon_lambert",
        "polygon_phong",
        "polygon_phong_nclip",
        "sphere_lambert",
        "sphere_phong",
        "subhemi_lambert",
        "subhemi_phong",
    ];
    let output = verify().arg("--gpu").args(models.map(reference)).output().expect("softbox runs");
    let (table, error) = text(&output);
    println!("{table}");
    assert_eq!(output.status.code(), Some(0), "{error}");
    for model in models {
        let found = table.lines().any(|row| row.split_whitespace().take(4).eq([model, "exact", "(gpu)", "right"]));
        assert!(found, "{model} has a row `exact (gpu)` that is right");
    }
}

#[test]
fn without_an_adapter_the_rows_are_left_out_or_the_run_fails() {
    // Of no backend there is no adapter.
    let without = |flag: &[&str]| {
        let file = reference("sphere_lambert");
        verify().args(flag).arg(file).env("WGPU_BACKEND", "none").output().expect("softbox runs")
    };
    let output = without(&[]);
    let (table, error) = text(&output);
    assert_eq!(output.status.code(), Some(0), "{error}");
    assert!(!table.contains("gpu"), "no GPU rows: {table}");
    assert_eq!(error.lines().count(), 1, "one line: {error}");
    assert!(error.contains("left out") && error.contains("no graphics adapter"), "it says why: {error}");

    let output = without(&["--gpu"]);
    let (table, error) = text(&output);
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(table.is_empty() && error.lines().count() == 1, "one line: {table}{error}");
    assert!(error.contains("no graphics adapter"), "it says why: {error}");
}
