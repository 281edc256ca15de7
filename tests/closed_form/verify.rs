//! `softbox verify` as a user runs it, without the GPU.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::{Value, json};
use tempfile::TempDir;

fn reference(model: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/reference").join(model).with_extension("json")
}

/// A copy of a reference file with its first cases only, changed.
fn changed(model: &str, change: impl Fn(&mut Value)) -> (TempDir, PathBuf) {
    let text = std::fs::read_to_string(reference(model)).expect("the reference file is readable");
    let mut file: Value = serde_json::from_str(&text).expect("a reference file is JSON");
    file["cases"].as_array_mut().expect("a list of cases").truncate(5);
    change(&mut file);
    written(&file.to_string())
}

fn written(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("there is room for a file");
    let path = folder.path().join("cases.json");
    std::fs::write(&path, text).expect("there is room for a file");
    (folder, path)
}

fn verify(files: &[PathBuf], arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_softbox"));
    command.arg("verify").arg("--no-gpu").args(arguments).args(files).output().expect("softbox runs")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Ends with status 2, one line on standard error that has all of `words`, and nothing else.
#[track_caller]
fn check_refused(path: PathBuf, arguments: &[&str], words: &[&str]) {
    let output = verify(&[path], arguments);
    let (out, error) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(out.is_empty(), "nothing is printed but the error: {out}");
    assert_eq!(error.lines().count(), 1, "one line: {error}");
    for word in words {
        assert!(error.contains(word), "`{word}` in: {error}");
    }
}

/// The rows of a table, without its heading.
fn rows(output: &Output) -> Vec<String> {
    text(&output.stdout).lines().skip(1).map(str::to_owned).collect()
}

#[test]
fn every_reference_file_passes() {
    let models = [
        "linear_diffuse",
        "linear_phong",
        "polygon_lambert",
        "polygon_phong",
        "polygon_phong_nclip",
        "sphere_lambert",
        "sphere_phong",
        "subhemi_lambert",
        "subhemi_phong",
        "textured_rect_diffuse",
        "textured_rect_phong",
    ];
    let output = verify(&models.map(reference), &[]);
    let rows = rows(&output);
    println!("{}", text(&output.stdout));
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    for model in models {
        for method in ["exact", "reference"] {
            let start = [model, method, "right"];
            let found = rows.iter().any(|row| row.split_whitespace().take(3).eq(start));
            assert!(found, "{model} has a row `{method}` that is right");
        }
    }
    assert!(!rows.iter().any(|row| row.contains("gpu")), "--no-gpu leaves the GPU out");
}

#[test]
fn a_wrong_value_ends_with_status_1_and_names_the_case() {
    for model in ["polygon_lambert", "linear_phong", "subhemi_phong"] {
        let (_folder, path) = changed(model, |file| {
            let expected = file["cases"][2]["expected"].as_f64().expect("a number");
            file["cases"][2]["expected"] = json!(expected * (1.0 + 1e-5) + 1e-5);
        });
        let output = verify(&[path], &[]);
        let wrong: Vec<_> = rows(&output).into_iter().filter(|row| row.contains("WRONG")).collect();
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        assert_eq!(wrong.len(), 2, "exact and reference: {wrong:?}");
        let id = format!("{model}-public-002");
        assert!(wrong.iter().all(|row| row.ends_with(&id)), "{id} is named: {wrong:?}");
    }
}

#[test]
fn a_missing_input_is_one_clear_line() {
    for (model, input) in [("polygon_lambert", "vertices"), ("linear_diffuse", "decay"), ("subhemi_phong", "sigma")] {
        let (_folder, path) = changed(model, |file| {
            file["cases"][3]["inputs"].as_object_mut().expect("inputs").remove(input);
        });
        check_refused(path, &[], &["cases.json", &format!("{model}-public-003"), &format!("`{input}`")]);
    }
}

#[test]
fn a_missing_field_is_one_clear_line() {
    let (_folder, path) = changed("sphere_phong", |file| {
        file["cases"][1].as_object_mut().expect("a case").remove("expected");
    });
    check_refused(path, &[], &["cases.json", "cases[1]", "missing field `expected`"]);
}

#[test]
fn a_file_that_is_no_json_or_of_another_schema_or_not_there_is_one_clear_line() {
    let (_folder, path) = written("not JSON");
    check_refused(path, &[], &["cases.json", "line 1"]);
    let (_folder, path) = changed("sphere_phong", |file| file["schema"] = json!("area-light-reference/2"));
    check_refused(path, &[], &["cases.json", "area-light-reference/2", "area-light-reference/1"]);
    let (_folder, path) = changed("sphere_phong", |file| file["cases"] = json!([]));
    check_refused(path, &[], &["cases.json", "no cases"]);
    check_refused(reference("nowhere"), &[], &["nowhere.json", "cannot read"]);
}

#[test]
fn a_model_that_is_not_built_is_said_so_and_can_be_left_out() {
    let (_folder, unbuilt) = changed("sphere_lambert", |file| file["model"] = json!("torus_diffuse"));
    let files = [unbuilt, reference("sphere_lambert")];
    let output = verify(&files, &[]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(rows(&output)[0].split_whitespace().collect::<Vec<_>>(), ["torus_diffuse", "not", "built"]);

    let output = verify(&files, &["--model", "sphere_lambert"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(rows(&output).iter().all(|row| row.starts_with("sphere_lambert ")), "the other file is left out");
    check_refused(reference("sphere_lambert"), &["--model", "sphere_phong"], &["none of the files", "sphere_phong"]);
}
