//! What every export does with every light: said in the documents as the program says it.

use std::fmt::Write as _;
use std::fs;
use std::sync::Arc;

use glam::dvec2;
use softbox::export::{self, ExportError, Fate, Job, Options, Target};
use softbox::light::pattern::{Channel, Image, Pattern};
use softbox::light::{Cap, Directional, Disk, Light, Line, Point, Polygon, Shape, Sky, Sphere, Textured};
use softbox::render::Progress;
use softbox::scene::{Scene, photometry_of_bytes};

/// Where the table stands in a document.
const MARKS: [&str; 2] = ["<!-- exports -->\n", "<!-- /exports -->\n"];

/// An even half space of 100 cd.
const IES: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 100\n";

/// Targets that hold lights; the others are pictures and numbers of what they do.
fn targets() -> Vec<Target> {
    let is_result = |target: &Target| matches!(target, Target::Csv | Target::Svg | Target::Png | Target::Exr);
    Target::ALL.into_iter().filter(|target| !is_result(target)).collect()
}

/// A light of every kind that targets tell apart.
fn lights() -> Vec<(&'static str, Light)> {
    let polygon = |vertices: &[[f64; 2]], two_sided| {
        let vertices = vertices.iter().map(|[x, y]| dvec2(*x, *y)).collect();
        Shape::Polygon(Polygon { vertices, two_sided })
    };
    let rectangle = [[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]];
    let arrow = [[-0.6, -0.4], [0.0, -0.1], [0.6, -0.4], [0.0, 0.8]];
    let channel = Channel::new(2, vec![0.0, 0.25, 0.5, 1.0]).expect("two rows of two");
    let pattern = Pattern::of_image("p.png", Image::Grey(Arc::new(channel)));
    let textured = |two_sided| Shape::Textured(Textured { size: dvec2(2.0, 1.0), pattern: pattern.clone(), two_sided });
    let measured = photometry_of_bytes("lamp.ies", IES.into()).expect("a photometric file");
    let shapes = [
        ("`polygon`, a rectangle", polygon(&rectangle, false)),
        ("`polygon`, two-sided", polygon(&rectangle, true)),
        ("`polygon`, any other", polygon(&arrow, false)),
        ("`disk`", Shape::Disk(Disk { radius: 0.5, two_sided: false })),
        ("`disk`, two-sided", Shape::Disk(Disk { radius: 0.5, two_sided: true })),
        ("`textured`", textured(false)),
        ("`textured`, two-sided", textured(true)),
        ("`line`", Shape::Line(Line::isotropic(1.2))),
        ("`line`, falloff other than 2", Shape::Line(Line { falloff: 1.0, ..Line::isotropic(1.2) })),
        ("`line`, tube", Shape::Line(Line::tube(1.2, 0.013))),
        ("`line`, tube, falloff other than 2", Shape::Line(Line { falloff: 1.0, ..Line::tube(1.2, 0.013) })),
        ("`sphere`", Shape::Sphere(Sphere { radius: 0.2 })),
        ("`cap`", Shape::Cap(Cap { half_angle_deg: 5.0 })),
        ("`sky`", Shape::Sky(Sky::OVERCAST)),
        ("`point`", Shape::Point(Point { ies: None })),
        ("`point` with an IES file", Shape::Point(Point { ies: Some(measured) })),
        ("`directional`", Shape::Directional(Directional {})),
    ];
    shapes.map(|(name, shape)| (name, Light { position: glam::DVec3::Z, ..Light::new("light", shape) })).into()
}

/// What a target says of a light: the worst fate, and all that it says.
fn said(target: Target, light: &Light) -> (Fate, String) {
    let scene = Scene { lights: vec![light.clone()], ..Scene::default() };
    let options = Options::default();
    let job = Job { scene: &scene, scene_name: "s.toml", stem: "s", target, lights: None, surfaces: true, options };
    let exported = match export::export(&job, &Progress::default()) {
        Err(ExportError::Nothing(why)) => return (Fate::Lost, why),
        exported => exported.expect("it is exported"),
    };
    let about: Vec<_> = exported.remarks.iter().filter(|remark| remark.thing == "light \"light\"").collect();
    let fate = about.iter().map(|remark| remark.fate).max().expect("every light is spoken of");
    (fate, about.iter().map(|remark| remark.what.as_str()).collect::<Vec<_>>().join("; "))
}

/// The table of fates, then what each target says.
fn tables() -> (String, String) {
    let lights = lights();
    let targets = targets();
    let heads: Vec<_> = targets.iter().map(|target| format!("`{target}`")).collect();
    let mut fates = format!("| light | {} |\n|---|{}\n", heads.join(" | "), "---|".repeat(heads.len()));
    let mut details = String::new();
    let all: Vec<Vec<_>> =
        targets.iter().map(|target| lights.iter().map(|(_, light)| said(*target, light)).collect()).collect();
    for (row, (name, _)) in lights.iter().enumerate() {
        let cells: Vec<_> = all.iter().map(|column| column[row].0.name()).collect();
        let _ = writeln!(fates, "| {name} | {} |", cells.join(" | "));
    }
    for (target, column) in targets.iter().zip(&all) {
        let _ = writeln!(
            details,
            "\n### `{target}`\n\n{}\n\n| light | | what the export says |\n|---|---|---|",
            target.title()
        );
        for ((name, _), (fate, what)) in lights.iter().zip(column) {
            let _ = writeln!(details, "| {name} | {fate} | {} |", what.replace('|', "\\|"));
        }
    }
    (fates, details)
}

/// A document holds that text between its marks; with `UPDATE_DOCS` set, it is put there.
#[track_caller]
fn check(document: &str, expected: &str) {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(document);
    let text = fs::read_to_string(&path).expect("the document");
    let [start, end] = MARKS.map(|mark| text.find(mark).expect("its mark"));
    let start = start + MARKS[0].len();
    if std::env::var_os("UPDATE_DOCS").is_some() {
        fs::write(&path, format!("{}{expected}{}", &text[..start], &text[end..])).expect("the document is written");
        return;
    }
    let hint = "run this test with UPDATE_DOCS=1 and look at what changes";
    assert!(text[start..end] == *expected, "{document} does not say what the exports do; {hint}:\n{expected}");
}

#[test]
fn the_documents_say_what_every_export_does_with_every_light() {
    let (fates, details) = tables();
    check("README.md", &fates);
    check("docs/exports.md", &format!("{fates}{details}"));
}

#[test]
fn every_target_speaks_of_every_light_and_surface_and_is_the_same_twice() {
    let scene = softbox::scene::load("tests/data/everything.toml").expect("it loads");
    for target in targets() {
        let options = Options::default();
        let job = Job { scene: &scene, scene_name: "s.toml", stem: "s", target, lights: None, surfaces: true, options };
        let export = || export::export(&job, &Progress::default()).expect("it is exported");
        let exported = export();
        for thing in scene.lights.iter().map(|light| format!("light \"{}\"", light.name)) {
            assert!(exported.remarks.iter().any(|remark| remark.thing == thing), "{target} says nothing of {thing}");
        }
        for (i, file) in exported.files.iter().enumerate() {
            // Copies of the scene's own files stay as they are, and a buffer of numbers has no words.
            let is_copy = i > 0 && (target == Target::Json || file.name.ends_with(".ies"));
            if !is_copy && !file.name.ends_with(".bin") {
                let held = String::from_utf8_lossy(&file.bytes);
                let is_named = held.contains(concat!("Softbox ", env!("CARGO_PKG_VERSION"))) && held.contains("s.toml");
                assert!(is_named, "{target}: {} does not name Softbox's version and the scene", file.name);
            }
        }
        assert!(exported == export(), "{target} differs from run to run");
    }
}
