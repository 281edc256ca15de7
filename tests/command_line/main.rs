//! The program as it is run: what it answers, with which status, and what it leaves behind.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

mod export;
mod ies;
mod shadows;

/// A light of 2 m² and 1000 cd/m², 2 m above the ground.
const WINDOW: &str = "tests/data/window.toml";

const POINTS_HEADER: &str = "x,y,z,nx,ny,nz,vx,vy,vz";

fn softbox(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_softbox"));
    command.args(arguments).current_dir(env!("CARGO_MANIFEST_DIR")).stdin(Stdio::null()).env_remove("RUST_LOG");
    command
}

fn run(arguments: &[&str]) -> Output {
    softbox(arguments).output().expect("the program runs")
}

fn text(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("the program speaks UTF-8")
}

/// Bad use or bad input: status 2, one line on standard error that says `expected`, nothing else.
#[track_caller]
fn check_refused(arguments: &[&str], expected: &str) {
    check_refusal(&run(arguments), arguments, expected);
}

#[track_caller]
fn check_refusal(output: &Output, arguments: &[&str], expected: &str) {
    let said = text(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{arguments:?} said: {said}");
    assert!(said.starts_with("softbox: ") && said.lines().count() == 1, "{arguments:?} is not one line: {said}");
    assert!(said.contains(expected), "{arguments:?} should say `{expected}` but said: {said}");
}

#[track_caller]
fn check_done(output: &Output) {
    assert!(output.status.success(), "{:?}: {}", output.status, text(&output.stderr));
}

fn folder() -> TempDir {
    tempfile::tempdir().expect("a folder for outputs")
}

fn shown(path: &Path) -> &str {
    path.to_str().expect("a name in Unicode")
}

fn names(folder: &Path) -> Vec<PathBuf> {
    fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path()).collect()
}

/// The answer of `probe` to rows on its standard input.
fn probe(scene: &str, rows: &str, more: &[&str]) -> Output {
    let arguments = [&["probe", scene, "--points", "-"], more].concat();
    let mut child = softbox(&arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // It may end before it has read everything.
    let _ = child.stdin.take().expect("its input").write_all(rows.as_bytes());
    child.wait_with_output().expect("the program ends")
}

/// Method and numbers of each row of an answer.
fn answer(output: &Output) -> Vec<(String, Vec<f64>)> {
    check_done(output);
    let mut lines = text(&output.stdout).lines();
    let header = "method,x,y,z,irradiance_r,irradiance_g,irradiance_b,radiance_r,radiance_g,radiance_b";
    assert_eq!(lines.next(), Some(header), "the header");
    lines
        .map(|line| {
            let (method, numbers) = line.split_once(',').expect("several columns");
            (method.to_owned(), numbers.split(',').map(|number| number.parse().expect("a number")).collect())
        })
        .collect()
}

/// A scene with one light of 1000 cd/m², `size` metres, at height 0 facing down.
fn rectangle(folder: &Path, size: [f64; 2]) -> PathBuf {
    let [x, y] = size.map(|side| 0.5 * side);
    let scene = format!(
        "format = 1\n[[material]]\nname = \"m\"\ndiffuse = [0.5, 0.5, 0.5]\n\
         [[light]]\nname = \"l\"\nluminance = 1000.0\n\
         shape = {{ polygon = {{ vertices = [[-{x:?}, -{y:?}], [{x:?}, -{y:?}], [{x:?}, {y:?}], [-{x:?}, {y:?}]] }} }}\n"
    );
    let path = folder.join("rectangle.toml");
    fs::write(&path, scene).expect("the scene is written");
    path
}

#[test]
fn probe_gives_the_values_that_three_renderers_gave() {
    let rows = format!("{POINTS_HEADER}\n0,0,0,0,0,1,0,0,1\n1.5,0.7,0,0,0,2,0,0,3\n");
    let rows = answer(&probe(WINDOW, &rows, &[]));
    assert_eq!(rows.len(), 2, "{rows:?}");
    for ((method, numbers), (place, expected)) in rows.iter().zip([([0.0, 0.0], 415.838), ([1.5, 0.7], 187.765)]) {
        assert_eq!(method, "exact", "the default");
        assert_eq!(numbers[..3], [place[0], place[1], 0.0], "the point comes back");
        assert!(numbers[3..6].iter().all(|e| (e - expected).abs() < 5e-4), "{numbers:?} is not {expected} lx");
    }
}

#[test]
fn probe_answers_by_every_method_and_the_point_law_is_off_as_published() {
    let folder = folder();
    // Excess of the point law on the axis, in percent, at 1, 2, 3 and 5 times the side.
    for (size, excess) in [([1.0, 1.0], [32.9, 8.30, 3.70, 1.33]), ([1.0, 1e-4], [15.8, 4.11, 1.84, 0.67])] {
        let scene = rectangle(folder.path(), size);
        for (distance, excess) in [1.0, 2.0, 3.0, 5.0].into_iter().zip(excess) {
            let rows = format!("{POINTS_HEADER}\n0,0,-{distance},0,0,1,0,0,1\n");
            let rows = answer(&probe(shown(&scene), &rows, &["--method", "all"]));
            let of = |name: &str| rows.iter().find(|(method, _)| method == name).expect("the method answers").1[3];
            let found = 100.0 * (of("point") / of("exact") - 1.0);
            assert!((found - excess).abs() <= 0.06, "{size:?} from {distance}: {found} % is not {excess} %");
            assert!((of("reference") / of("exact") - 1.0).abs() < 1e-9, "{size:?} from {distance}: {rows:?}");
        }
    }
}

#[test]
fn probe_writes_numbers_that_come_back_to_the_last_bit() {
    let rows = format!("{POINTS_HEADER}\n0.1,0.30000000000000004,1e-3,0,0,1,0,0,1\n");
    let rows = answer(&probe(WINDOW, &rows, &[]));
    assert_eq!(rows[0].1[..3], [0.1, 0.300_000_000_000_000_04, 1e-3], "the point");
}

#[test]
fn probe_refuses_bad_points_with_their_line() {
    for (row, expected) in [
        ("0,0,0,0,0,1,0,0", ":3: "),
        ("0,0,0,0,0,1,0,0,1,1", ":3: "),
        ("0,0,zero,0,0,1,0,0,1", ":3: z: "),
        ("0,0,0,0,0,1,NaN,0,1", ":3: vx: "),
        ("0,inf,0,0,0,1,0,0,1", ":3: y: "),
        ("0,0,0,0,0,0,0,0,1", ":3: nx,ny,nz: "),
        ("0,0,0,0,0,1,0,0,0", ":3: vx,vy,vz: "),
    ] {
        let rows = format!("{POINTS_HEADER}\n0,0,0,0,0,1,0,0,1\n{row}\n");
        check_refusal(&probe(WINDOW, &rows, &[]), &[row], expected);
    }
}

#[test]
fn probe_refuses_another_header_and_no_header() {
    for rows in ["", "x,y,z\n0,0,0\n", "0,0,0,0,0,1,0,0,1\n", "nx,ny,nz,x,y,z,vx,vy,vz\n0,0,1,0,0,0,0,0,1\n"] {
        check_refusal(&probe(WINDOW, rows, &[]), &[rows], POINTS_HEADER);
    }
}

#[test]
fn probe_says_which_materials_methods_and_files_there_are_not() {
    check_refusal(&probe(WINDOW, "", &["--material", "velvet"]), &["velvet"], "velvet");
    check_refusal(&probe(WINDOW, "", &["--method", "guess"]), &["guess"], "unknown method `guess`");
    check_refused(&["probe", WINDOW, "--points", "nowhere.csv"], "nowhere.csv");
}

#[test]
fn a_picture_is_marked_as_srgb_has_its_size_and_is_the_same_twice() {
    let folder = folder();
    let output = folder.path().join("a.png");
    let picture = || {
        check_done(&run(&["render", WINDOW, "-o", shown(&output), "--size", "61x35", "--samples", "4"]));
        fs::read(&output).expect("the picture is there")
    };
    let first = picture();
    assert!(first.windows(4).any(|chunk| chunk == b"sRGB"), "no sRGB chunk");
    let decoded = image::load_from_memory(&first).expect("a picture");
    assert_eq!([decoded.width(), decoded.height()], [61, 35], "size");
    assert!(first == picture(), "the second picture differs");
    assert!(names(folder.path()).iter().eq([&output]), "nothing else is left");
}

#[test]
fn an_exr_holds_the_radiance_that_probe_gives() {
    let folder = folder();
    let output = folder.path().join("a.exr");
    check_done(&run(&["render", WINDOW, "-o", shown(&output), "--size", "3x3", "--samples", "1"]));
    let picture = image::open(&output).expect("a picture").into_rgb32f();
    // The lower pixel of the middle column looks from the eye at this point of the floor.
    let camera = softbox::scene::load(WINDOW).expect("the scene loads").camera;
    let direction = camera.ray_direction(1.5, 2.5, 3.0, 3.0);
    let p = camera.eye - direction * (camera.eye.z / direction.z);
    let v = -direction;
    let rows = format!("{POINTS_HEADER}\n{},{},0,0,0,1,{},{},{}\n", p.x, p.y, v.x, v.y, v.z);
    let expected = answer(&probe(WINDOW, &rows, &[]))[0].1[6];
    let found = f64::from(picture.get_pixel(1, 2).0[0]);
    assert!(expected > 1.0 && (found / expected - 1.0).abs() < 1e-6, "{found} is not {expected}");
}

#[test]
fn every_method_renders_and_exact_is_not_approx() {
    let folder = folder();
    let picture = |method: &str| {
        let output = folder.path().join("a.exr");
        let arguments = ["render", WINDOW, "-o", shown(&output), "--size", "8x6", "--method", method, "--no-shadows"];
        check_done(&run(&arguments));
        fs::read(output).expect("the picture is there")
    };
    let exact = picture("exact");
    for method in ["approx", "nearest-point", "point-cluster-4", "point"] {
        assert!(picture(method) != exact, "{method} is the same as exact");
    }
    assert!(picture("chebyshev") == exact, "a polygon has no chebyshev and is shaded exactly");
}

#[test]
fn render_refuses_bad_use_before_any_work() {
    let folder = folder();
    let png = folder.path().join("a.png");
    let png = shown(&png);
    check_refused(&["render", WINDOW], "--output");
    check_refused(&["render", WINDOW, "-o", "a.jpg"], ".png or .exr");
    check_refused(&["render", WINDOW, "-o", "picture"], ".png or .exr");
    check_refused(&["render", WINDOW, "-o", png, "--method", "guess"], "unknown method `guess`");
    for size in ["640", "0x5", "5x0", "-1x5", "axb", "100000x2", "32768x32768", "1.5x2"] {
        check_refused(&["render", WINDOW, "-o", png, &format!("--size={size}")], "WIDTHxHEIGHT");
    }
    check_refused(&["render", WINDOW, "-o", png, "--samples", "0"], "0 is not in");
    check_refused(&["render", "nowhere.toml", "-o", png], "nowhere.toml");
    check_refused(&["render", "src", "-o", png], "directory");
    check_refused(&["render", WINDOW, "-o", "/nowhere/a.png"], "/nowhere/a.png: cannot be written");
    assert!(names(folder.path()).is_empty(), "a refused run leaves no file");
}

#[test]
fn an_output_that_is_no_regular_file_is_left_alone() {
    let folder = folder();
    let directory = folder.path().join("a.png");
    fs::create_dir(&directory).expect("a directory");
    check_refused(&["render", WINDOW, "-o", shown(&directory), "--size", "2x2"], "not a regular file");
    assert_eq!(names(folder.path()), [directory], "it is still there");
}

#[test]
fn a_scene_with_several_problems_is_refused_in_one_line() {
    let folder = folder();
    let scene = folder.path().join("bad.toml");
    let text = fs::read_to_string(WINDOW).expect("the scene is there");
    let bad = text.replace("luminance = 1000.0", "luminance = -1.0").replace("fov_deg = 40.0", "fov_deg = 0.0");
    fs::write(&scene, bad).expect("the scene is written");
    let output = folder.path().join("a.png");
    check_refused(&["render", shown(&scene), "-o", shown(&output)], "bad.toml:");
    assert_eq!(run(&["check", shown(&scene)]).status.code(), Some(1), "check answers no");
    assert_eq!(run(&["check", WINDOW]).status.code(), Some(0), "check answers yes");
}

#[test]
fn every_command_of_the_help_is_there() {
    let help = run(&["--help"]);
    check_done(&help);
    let help = text(&help.stdout);
    let commands = help.split("Commands:").nth(1).and_then(|rest| rest.split("\n\n").next()).expect("commands");
    let commands: Vec<_> = commands.lines().filter_map(|line| line.split_whitespace().next()).collect();
    for expected in ["render", "plot", "probe", "check", "schema", "verify"] {
        assert!(commands.contains(&expected), "{expected} is not among {commands:?}");
    }
    for command in commands.into_iter().filter(|command| *command != "help") {
        check_done(&run(&[command, "--help"]));
    }
    check_done(&run(&["--version"]));
}

#[test]
fn an_unknown_command_or_option_is_bad_use() {
    check_refused(&["rendr", WINDOW], "`rendr` is not a command");
    check_refused(&["render", WINDOW, "--sise", "2x2"], "--sise");
}

#[test]
fn a_reader_that_stops_reading_is_no_error() {
    let mut child =
        softbox(&["schema"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("the program starts");
    drop(child.stdout.take());
    let output = child.wait_with_output().expect("the program ends");
    check_done(&output);
    assert_eq!(text(&output.stderr), "", "it says nothing");
}

#[cfg(feature = "gpu")]
#[test]
fn the_gpu_renders_the_same_picture() {
    let folder = folder();
    let picture = |name: &str, renderer: &str| {
        let output = folder.path().join(name);
        let size = ["--size", "96x54", "--samples", "1", "--renderer", renderer];
        check_done(&run(&[&["render", WINDOW, "-o", shown(&output)], &size[..]].concat()));
        image::open(&output).expect("a picture").into_rgb8()
    };
    let (cpu, gpu) = (picture("cpu.png", "cpu"), picture("gpu.png", "gpu"));
    assert_eq!(cpu.dimensions(), gpu.dimensions(), "size");
    let apart = |a: &image::Rgb<u8>, b: &image::Rgb<u8>| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 1);
    let different = cpu.pixels().zip(gpu.pixels()).filter(|(a, b)| apart(a, b)).count();
    // A pixel's centre may lie on an edge.
    assert!(different < 10, "{different} pixels differ by more than a step");
    assert!(cpu.pixels().any(|pixel| pixel.0[0] > 100), "a picture of something");
    let output = folder.path().join("a.png");
    let refused = |method: &str, expected: &str| {
        check_refused(&["render", WINDOW, "-o", shown(&output), "--renderer", "gpu", "--method", method], expected);
    };
    refused("approx", "one method");
    refused("reference", "--renderer cpu");
}

#[cfg(not(feature = "gpu"))]
#[test]
fn a_build_without_gpu_says_so() {
    let folder = folder();
    let output = folder.path().join("a.png");
    check_refused(&["render", WINDOW, "-o", shown(&output), "--renderer", "gpu"], "no GPU renderer");
}

/// A scene with three plots.
const PLOTTED: &str = "presets/scenes/first-light.toml";

#[test]
fn plots_are_written_as_svg_png_and_csv() {
    let folder = folder();
    let file = |name: &str| {
        let output = folder.path().join(name);
        check_done(&run(&["plot", PLOTTED, "-o", shown(&output)]));
        fs::read(&output).expect("the plot is there")
    };
    let svg = file("a.svg");
    let scene = softbox::scene::load(PLOTTED).expect("the scene loads");
    assert!(scene.plots.len() > 1, "a scene with several plots");
    for plot in &scene.plots {
        assert!(text(&svg).contains(&plot.name), "the SVG has no {}", plot.name);
    }
    let png = image::load_from_memory(&file("a.png")).expect("a picture").into_rgb8();
    let inked = png.pixels().filter(|pixel| pixel.0 != [255; 3]).count();
    assert!(inked > 20_000, "only {inked} of {} x {} pixels are inked", png.width(), png.height());
    assert_eq!(names(folder.path()).len(), 2, "nothing else is left");
}

#[test]
fn a_plot_as_csv_has_the_values_of_probe() {
    let folder = folder();
    let output = folder.path().join("a.csv");
    let scene = softbox::scene::load(PLOTTED).expect("the scene loads");
    let plot = &scene.plots[0];
    check_done(&run(&["plot", PLOTTED, "--plot", &plot.name, "-o", shown(&output)]));
    let table = fs::read_to_string(&output).expect("the table is there");
    let mut lines = table.lines();
    let maker = concat!("# Softbox ", env!("CARGO_PKG_VERSION"), ", scene first-light.toml");
    assert_eq!(lines.next(), Some(maker), "who wrote it, and of what");
    assert_eq!(lines.next(), Some("plot,x,method,y,error,bound"), "the header");
    let rows: Vec<Vec<_>> = lines.map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row[0] == plot.name), "only the plot asked for");
    let of = |method: &str| rows.iter().filter(|row| row[2] == method).collect::<Vec<_>>();
    let (exact, point, reference) = (of("exact"), of("point"), of("reference"));
    assert!(exact.len() > 100 && point.len() == exact.len() && reference.len() == exact.len(), "{} rows", rows.len());
    let number = |text: &str| text.parse::<f64>().expect("a number");
    for (exact, point) in exact.iter().zip(&point) {
        assert_eq!(number(point[4]), number(point[3]) - number(exact[3]), "the error at {}", exact[1]);
        assert_eq!([exact[5], point[5]], [""; 2], "only the reference has a bound");
    }
    for row in [reference[0], reference[reference.len() / 2]] {
        assert!(number(row[4]).abs() <= number(row[5]) + 1e-9 * number(row[3]), "{row:?}");
    }
    // The plot tilts a probe that is seen along its normal; its lights' tints are left out, and shadows.
    let middle = exact[exact.len() / 2];
    let at = softbox::analysis::probe(plot, number(middle[1]));
    let [p, n, v] = [at.p, at.n, at.v].map(|v| format!("{},{},{}", v.x, v.y, v.z));
    let rows = answer(&probe(PLOTTED, &format!("{POINTS_HEADER}\n{p},{n},{v}\n"), &["--no-shadows"]));
    let rgb = &rows[0].1[3..6];
    let luminance = softbox::light::luminance_of(glam::DVec3::new(rgb[0], rgb[1], rgb[2]));
    assert!((luminance / number(middle[3]) - 1.0).abs() < 1e-9, "{luminance} lx is not {}", middle[3]);
}

#[test]
fn plot_refuses_bad_use_before_any_work() {
    let folder = folder();
    let output = folder.path().join("a.svg");
    check_refused(&["plot", PLOTTED, "-o", "a.pdf"], ".svg, .png or .csv");
    check_refused(&["plot", PLOTTED, "--plot", "none such", "-o", shown(&output)], "tilt under the window");
    check_refused(&["plot", WINDOW, "-o", shown(&output)], "has no plots");
    check_refused(&["plot", PLOTTED, "-o", "/nowhere/a.svg"], "cannot be written");
    assert!(names(folder.path()).is_empty(), "a refused run leaves no file");
}

#[test]
fn a_difference_is_a_map_with_a_scale_and_printed_figures() {
    let folder = folder();
    let output = folder.path().join("a.png");
    let map = |name: &str, more: &[&str]| {
        let output = folder.path().join(name);
        let size = ["difference", WINDOW, "-o", shown(&output), "--size", "440x240", "--samples", "1"];
        let answer = run(&[&size[..], more].concat());
        check_done(&answer);
        let said = text(&answer.stdout).to_owned();
        (image::open(&output).expect("a picture").into_rgb32f(), said)
    };
    let (picture, said) = map("a.png", &["--of", "point"]);
    assert!(picture.width() == 440 && picture.height() > 260, "the scale is beneath: {:?}", picture.dimensions());
    assert!(said.starts_with("point \u{2212} exact") && said.contains("rms") && said.contains("peak"), "{said}");
    let (difference, said) = map("a.exr", &["--of", "point"]);
    assert_eq!(difference.dimensions(), (440, 240), "the difference itself has no scale");
    let luminance = |rgb: &image::Rgb<f32>| {
        let [r, g, b] = rgb.0.map(f64::from);
        softbox::light::luminance_of(glam::DVec3::new(r, g, b))
    };
    let worst =
        difference.pixels().map(luminance).fold(0.0, |worst: f64, x| if x.abs() > worst.abs() { x } else { worst });
    let told = said.lines().find_map(|line| line.strip_prefix("max")).expect("the greatest difference");
    let told: f64 = told.split_whitespace().next().and_then(|number| number.parse().ok()).expect("a number");
    assert!(worst.abs() > 1.0 && (told / worst - 1.0).abs() < 1e-4, "{told} is not {worst}");
    let (same, said) = map("b.exr", &["--of", "exact"]);
    assert!(same.pixels().all(|pixel| pixel.0 == [0.0; 3]) && said.contains("+0.0000e0"), "{said}");
    assert!(output.exists() && names(folder.path()).len() == 3, "nothing else is left");
}

#[test]
fn difference_refuses_bad_use_before_any_work() {
    let folder = folder();
    let output = folder.path().join("a.png");
    check_refused(&["difference", WINDOW, "-o", "a.jpg"], ".png or .exr");
    check_refused(&["difference", WINDOW, "-o", shown(&output), "--of", "guess"], "unknown method `guess`");
    check_refused(&["difference", WINDOW, "-o", shown(&output), "--limit", "0"], "above 0");
    check_refused(&["difference", "nowhere.toml", "-o", shown(&output)], "nowhere.toml");
    check_refused(&["difference", WINDOW, "-o", "/nowhere/a.png"], "cannot be written");
    assert!(names(folder.path()).is_empty(), "a refused run leaves no file");
}

#[test]
fn a_report_has_a_row_for_each_light_and_method() {
    let answer = run(&["report", WINDOW, "--points", "64"]);
    check_done(&answer);
    let said = text(&answer.stdout);
    assert!(said.starts_with("Ground: "), "it says what the ground is: {said}");
    for method in ["exact", "nearest-point", "point-cluster", "point", "reference"] {
        assert!(said.lines().any(|line| line.split_whitespace().any(|word| word == method)), "no {method}: {said}");
    }
}

#[test]
fn a_report_as_csv_agrees_with_probe() {
    let answer = run(&["report", WINDOW, "--points", "64", "--csv"]);
    check_done(&answer);
    let mut rows = csv::Reader::from_reader(text(&answer.stdout).as_bytes());
    let header = rows.headers().expect("a header").clone();
    let rows: Vec<csv::StringRecord> = rows.records().map(|row| row.expect("a row")).collect();
    let cell = |row: &csv::StringRecord, name: &str| {
        row[header.iter().position(|column| column == name).expect("the column")].to_owned()
    };
    let number = |row: &csv::StringRecord, name: &str| cell(row, name).parse::<f64>().expect("a number");
    let point = rows.iter().find(|row| cell(row, "method") == "point").expect("the point law");
    let at = ["diffuse_worst_x", "diffuse_worst_y", "diffuse_worst_z"].map(|name| cell(point, name)).join(",");
    let lit = answer_at(&format!("{at},0,0,1,0,0,1"));
    let error = lit("point") - lit("exact");
    assert!((number(point, "diffuse_worst") / error - 1.0).abs() < 1e-9, "{point:?} is not {error}");
    let share = number(point, "diffuse_worst") / number(point, "diffuse_peak");
    assert!((number(point, "diffuse_worst_relative") / share - 1.0).abs() < 1e-12, "{point:?}");
    assert!(rows.iter().all(|row| number(row, "cost_ns") > 0.0), "costs");
}

/// The illuminance at one point of the window's scene, by method.
fn answer_at(row: &str) -> impl Fn(&str) -> f64 + use<> {
    let rows = answer(&probe(WINDOW, &format!("{POINTS_HEADER}\n{row}\n"), &["--method", "all"]));
    move |name| rows.iter().find(|(method, _)| method == name).expect("the method answers").1[3]
}

#[test]
fn report_says_what_is_missing() {
    let folder = folder();
    let dark = folder.path().join("dark.toml");
    fs::write(&dark, "format = 1\n[[material]]\nname = \"m\"\ndiffuse = [0.5, 0.5, 0.5]\n").expect("written");
    check_refused(&["report", shown(&dark)], "no light that shines");
    let bare = folder.path().join("bare.toml");
    let light = "format = 1\n[[light]]\nname = \"l\"\nluminance = 1.0\nshape = { sphere = { radius = 0.1 } }\n";
    fs::write(&bare, light).expect("written");
    check_refused(&["report", shown(&bare)], "no material");
    check_refused(&["report", WINDOW, "--points", "0"], "--points");
    check_refused(&["report", "nowhere.toml"], "nowhere.toml");
}

#[test]
fn figures_are_pictures_charts_and_tables() {
    let folder = folder();
    let output = folder.path().join("new");
    check_done(&run(&["figures", "-o", shown(&output), "--size", "32x24", "poulin-1", "snyder-2", "hermite-errors"]));
    let mut found: Vec<_> = names(&output).iter().map(|path| path.file_name().expect("a name").to_owned()).collect();
    found.sort();
    assert_eq!(found, ["hermite-errors.csv", "poulin-1.png", "snyder-2.png", "snyder-2.svg"], "files");
    let picture = image::open(output.join("poulin-1.png")).expect("a picture").into_rgb8();
    assert_eq!(picture.dimensions(), (32, 24), "size");
    assert!(picture.pixels().any(|pixel| pixel.0[0] > 100), "a picture of something");
    let table = fs::read_to_string(output.join("hermite-errors.csv")).expect("a table");
    let table = table.split_once('\n').expect("a line of who wrote it").1;
    assert!(table.starts_with("sigma_deg,hermite_1,hermite_2\n") && table.lines().count() > 4, "{table}");
}

#[test]
fn figures_lists_what_there_is_and_refuses_what_there_is_not() {
    let answer = run(&["figures", "--list", "snyder"]);
    check_done(&answer);
    let listed = text(&answer.stdout);
    for figure in ["snyder-2", "snyder-3", "snyder-4", "snyder-5", "snyder-6", "snyder-7a", "snyder-7e"] {
        assert!(listed.lines().any(|line| line.split_whitespace().next() == Some(figure)), "no {figure}: {listed}");
    }
    let folder = folder();
    let output = shown(folder.path());
    check_refused(&["figures", "-o", output, "guess"], "no figure `guess`");
    check_refused(&["figures", "-o", output, "--scenes", "/nowhere", "poulin"], "/nowhere");
    check_refused(&["figures", "-o", "/proc/nowhere", "hermite-errors"], "/proc/nowhere");
    assert!(names(folder.path()).is_empty(), "a refused run leaves no file");
}

#[test]
fn the_page_of_figures_shows_what_there_is() {
    let page = fs::read_to_string("docs/figures.md").expect("the page is there");
    let listed = run(&["figures", "--list"]);
    check_done(&listed);
    let listed: Vec<_> = text(&listed.stdout).lines().filter_map(|line| line.split_whitespace().next()).collect();
    let named: Vec<_> = page.split("`softbox figures ").skip(1).filter_map(|rest| rest.split('`').next()).collect();
    assert!(named.len() > 15, "only {} commands are found", named.len());
    for name in &named {
        assert!(listed.contains(name), "there is no figure {name}");
    }
    for name in &listed {
        assert!(named.contains(name), "the page does not show {name}");
    }
    for picture in page.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
        let size = fs::metadata(Path::new("docs").join(picture)).expect("the picture is there").len();
        assert!(size <= 60 * 1024, "{picture} has {size} bytes");
    }
}

/// Ctrl-C while the program works: status 130.
#[cfg(target_os = "linux")]
#[track_caller]
fn check_interrupted(arguments: &[&str]) {
    use std::time::Duration;

    let mut child = softbox(arguments).stderr(Stdio::piped()).spawn().expect("the program starts");
    while !catches_interrupts(&mut child) {
        std::thread::sleep(Duration::from_millis(5));
    }
    let killed = Command::new("kill").args(["-INT", &child.id().to_string()]).status().expect("kill runs");
    assert!(killed.success(), "the signal was sent");
    let ended = child.wait_with_output().expect("the program ends");
    assert_eq!(ended.status.code(), Some(130), "{arguments:?}, {:?}: {}", ended.status, text(&ended.stderr));
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_picture_leaves_the_old_file_and_no_other() {
    let folder = folder();
    let output = folder.path().join("a.png");
    fs::write(&output, "old").expect("the old file");
    let size = ["-o", shown(&output), "--size", "2000x2000"];
    check_interrupted(&[&["render", WINDOW, "--method", "reference"], &size[..]].concat());
    check_interrupted(&[&["difference", WINDOW, "--of", "reference"], &size[..]].concat());
    assert!(names(folder.path()).iter().eq([&output]), "no other file");
    assert_eq!(fs::read(&output).expect("the old file"), b"old", "the old file is as it was");
}

#[cfg(target_os = "linux")]
#[test]
fn interrupted_measurements_leave_nothing_behind() {
    let folder = folder();
    check_interrupted(&["figures", "-o", shown(folder.path()), "--size", "4000x4000", "poulin-3"]);
    check_interrupted(&["report", WINDOW, "--points", "1000000"]);
    assert!(names(folder.path()).is_empty(), "no file");
}

/// Whether a running program has a handler for SIGINT, as the kernel tells it.
#[cfg(target_os = "linux")]
fn catches_interrupts(child: &mut std::process::Child) -> bool {
    const SIGINT: u64 = 2;
    assert_eq!(child.try_wait().expect("the program's status"), None, "the program ended before it was interrupted");
    let status = fs::read_to_string(format!("/proc/{}/status", child.id())).expect("the kernel's word");
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).expect("the caught signals");
    u64::from_str_radix(caught.trim(), 16).expect("a mask") >> (SIGINT - 1) & 1 == 1
}
