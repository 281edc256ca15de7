//! Every light by every method that it has, through naga.

use glam::{DVec2, DVec3, dvec2};
use std::sync::Arc;

use naga::compact::{KeepUnused, compact};
use naga::valid::{Capabilities, ValidationFlags, Validator};

use crate::export::{Exported, Fate, Job, Options, Target, export};
use crate::light::pattern::{Channel, Image, Pattern};
use crate::light::{Cap, Directional, Disk, Light, Line, Point, Polygon, Shape, Sky, Sphere, Textured, Tint};
use crate::render::{MethodChoice, Progress};
use crate::scene::Scene;
use crate::shading::Method;

/// One light of each shape, and of each kind of line and pattern.
fn lights() -> Vec<Light> {
    let corners = [dvec2(-1.0, -0.5), dvec2(1.0, -0.5), dvec2(1.0, 0.5), dvec2(-1.0, 0.5)];
    let channel = |values: [f32; 4]| Arc::new(Channel::new(2, values.to_vec()).expect("two rows of two"));
    let grey = Image::Grey(channel([0.0, 1.0, 0.5, 0.25]));
    let color = Image::Color([[1.0, 0.5, 0.0, 0.2], [0.0, 0.3, 0.3, 0.1], [0.1, 0.1, 0.9, 0.0]].map(channel));
    let textured = |image| {
        Shape::Textured(Textured { size: DVec2::ONE, pattern: Pattern::of_image("p.png", image), two_sided: false })
    };
    let decaying = Line { falloff: 1.0, ..Line::isotropic(1.5) };
    let shapes = [
        ("Window 2", Shape::Polygon(Polygon { vertices: corners.to_vec(), two_sided: true })),
        ("line", Shape::Line(Line::isotropic(1.5))),
        ("decaying line", Shape::Line(decaying)),
        ("line frame", Shape::Line(Line::tube(1.5, 0.01))),
        ("größe", Shape::Sphere(Sphere { radius: 0.3 })),
        ("power", Shape::Disk(Disk { radius: 0.5, two_sided: false })),
        ("grey", textured(grey)),
        ("color", textured(color)),
        ("cap", Shape::Cap(Cap { half_angle_deg: 30.0 })),
        ("sky", Shape::Sky(Sky::OVERCAST)),
        ("point", Shape::Point(Point::default())),
        ("sun", Shape::Directional(Directional {})),
    ];
    let light = |(name, shape): (&str, Shape)| Light {
        position: DVec3::new(0.1, -0.2, 2.0),
        rotation_deg: DVec3::new(10.0, 20.0, 30.0),
        tint: Tint::TemperatureK(3000.0),
        ..Light::new(name, shape)
    };
    shapes.into_iter().map(light).collect()
}

fn exported(lights: Vec<Light>, target: Target, method: MethodChoice) -> Exported {
    let scene = Scene { lights, ..crate::scene::first_light() };
    let options = Options { method, ..Options::default() };
    let (scene_name, stem) = ("all.toml", "out");
    let job = Job { scene: &scene, scene_name, stem, target, lights: None, surfaces: true, options };
    export(&job, &Progress::default()).unwrap_or_else(|error| panic!("{method}: {error}"))
}

fn text(exported: &Exported) -> &str {
    std::str::from_utf8(&exported.files[0].bytes).expect("text")
}

fn validated(module: naga::Module, text: &str) -> Result<naga::Module, String> {
    let mut validator = Validator::new(ValidationFlags::all(), Capabilities::default());
    validator.validate(&module).map_err(|error| format!("{}\n{text}", error.emit_to_string(text)))?;
    Ok(module)
}

/// What is wrong with a WGSL file: in a right one nothing is unused but what is there to be called.
fn wgsl_fault(exported: &Exported) -> Option<String> {
    let text = format!("{}\n{}", text(exported), crate::export::glsl::MAIN);
    let module = naga::front::wgsl::parse_str(&text).map_err(|error| error.emit_to_string(&text));
    match module.and_then(|module| validated(module, &text)) {
        Err(error) => Some(error),
        Ok(module) => {
            let mut compacted = module.clone();
            compact(&mut compacted, KeepUnused::No);
            let needed = names(&compacted);
            let needless: Vec<_> = names(&module).into_iter().filter(|name| !needed.contains(name)).collect();
            (!needless.is_empty()).then(|| format!("{needless:?} is not needed"))
        }
    }
}

/// Functions and variables.
fn names(module: &naga::Module) -> Vec<String> {
    let functions = module.functions.iter().map(|(_, function)| function.name.clone());
    let variables = module.global_variables.iter().map(|(_, variable)| variable.name.clone());
    functions.chain(variables).flatten().collect()
}

/// What is wrong with a GLSL file. naga's own reader knows textures only apart from samplers.
fn glsl_fault(exported: &Exported) -> Option<String> {
    let text = text(exported);
    if text.contains("main(") || text.contains("#version") || text.contains("_group_") {
        return Some("it is no library".to_owned());
    }
    let bound = |(i, part): (usize, &str)| match i {
        0 => part.to_owned(),
        _ => format!("layout(set = 1, binding = {}) uniform texture2D{part}", i - 1),
    };
    let text: String = text.split("uniform highp sampler2D").enumerate().map(bound).collect();
    let text = format!("#version 450\n{text}\nvoid main() {{}}\n");
    let options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
    let module = naga::front::glsl::Frontend::default().parse(&options, &text);
    module.map_err(|error| error.emit_to_string(&text)).and_then(|module| validated(module, &text)).err()
}

#[track_caller]
fn check(faults: &[String]) {
    let heads: Vec<_> = faults.iter().map(|fault| fault.lines().take(9).collect::<Vec<_>>().join("\n")).collect();
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), heads.join("\n"));
}

#[test]
fn every_light_has_functions_by_every_method_in_both_languages() {
    let mut count = 0;
    let mut faults = Vec::new();
    for light in lights() {
        for method in Method::of(&light.shape) {
            let choice = MethodChoice::Method(*method);
            let wgsl = wgsl_fault(&exported(vec![light.clone()], Target::Wgsl, choice));
            let glsl = glsl_fault(&exported(vec![light.clone()], Target::Glsl, choice));
            let of = |fault| format!("{}, {method}: {fault}", light.name);
            faults.extend(wgsl.into_iter().chain(glsl).map(of));
            count += 1;
        }
    }
    println!("{count} lights and methods");
    assert!(count > 60, "only {count}");
    check(&faults);
}

#[test]
fn lights_together_share_what_they_can() {
    let mut faults = Vec::new();
    for method in ["exact", "approx", "point", "point-cluster-4", "one-shot", "one-shot-square"] {
        let choice = method.parse().expect("a method");
        let wgsl = exported(lights(), Target::Wgsl, choice);
        let glsl = exported(lights(), Target::Glsl, choice);
        faults.extend(wgsl_fault(&wgsl).into_iter().chain(glsl_fault(&glsl)).map(|fault| format!("{method}: {fault}")));
        println!("{method}: {} lines of WGSL, {} of GLSL", text(&wgsl).lines().count(), text(&glsl).lines().count());
    }
    check(&faults);
}

#[test]
fn a_file_says_what_it_is_and_is_always_the_same() {
    for target in [Target::Wgsl, Target::Glsl] {
        let of = || exported(lights(), target, MethodChoice::Method(Method::OneShot));
        let file = of();
        assert_eq!(file, of(), "once more");
        let first = format!("// Softbox {}, scene all.toml", env!("CARGO_PKG_VERSION"));
        assert_eq!(text(&file).lines().next(), Some(first.as_str()), "its first line");
        for name in [
            "softbox_window_2(",
            "softbox_line_frame_2(",
            "softbox_gr_e(",
            "softbox_power_2(",
            "softbox_color_green(",
            "softbox_lights(",
        ] {
            assert!(text(&file).contains(name), "{name} is in {target}");
        }
        assert!(file.files.len() > 1, "tables are beside");
        let changed = file.remarks.iter().filter(|remark| remark.fate == Fate::Changed);
        let what: Vec<_> = changed.map(|remark| format!("{}: {}", remark.thing, remark.what)).collect();
        assert!(
            what.contains(&"light \"line\": is written by exact, as a line has no one-shot".to_owned()),
            "{what:?}"
        );
        assert!(file.remarks.iter().all(|remark| remark.fate != Fate::Lost), "nothing is lost");
    }
}

#[test]
fn a_light_that_does_not_fit_is_lost_and_said_so() {
    let [far, many] = [DVec3::splat(1e39), DVec3::ZERO]
        .map(|position| Light { position, ..Light::new("light", Shape::Sphere(Sphere { radius: 1.0 })) });
    let disk = Light::new("power", Shape::Disk(Disk { radius: 1.0, two_sided: false }));
    let lost = |lights: Vec<Light>, method| {
        let remarks = exported(lights, Target::Wgsl, MethodChoice::Method(method)).remarks;
        let lost = remarks.into_iter().filter(|remark| remark.fate == Fate::Lost);
        lost.map(|remark| remark.what).collect::<Vec<_>>()
    };
    let what = lost(vec![far, many], Method::Exact);
    assert!(matches!(what.as_slice(), [what] if what.contains("too large")), "{what:?}");
    let sphere = Light::new("sphere", Shape::Sphere(Sphere { radius: 1.0 }));
    let what = lost(vec![disk, sphere], Method::PointCluster(3000));
    assert!(matches!(what.as_slice(), [what] if what.contains("3000 points")), "{what:?}");
}

#[test]
fn no_two_shaders_of_lights_declare_the_same() {
    let mut names: Vec<_> =
        super::Module::LIGHTS.iter().flat_map(|module| super::items::items(module.text())).collect();
    let count = names.len();
    names.sort_by(|a, b| a.name.cmp(&b.name));
    names.dedup_by(|a, b| a.name == b.name);
    assert!(count > 200, "only {count} declarations");
    assert_eq!(names.len(), count, "declarations that are told apart by their names");
}
