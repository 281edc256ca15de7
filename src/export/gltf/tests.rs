use serde_json::Value;

use super::*;
use crate::export::{Options, Target, export};
use crate::light::{Disk, Light, Line, Point, Shape, Sky};
use crate::shading::fit::{Budget, Cone, Punctual};
use crate::shading::{Method, PhongLobe, Prepared, ShadingPoint};

fn exported(scene: &Scene, punctual: Budget) -> (Value, Exported) {
    let job = Job {
        scene,
        scene_name: "scene.toml",
        stem: "out",
        target: Target::Gltf,
        lights: None,
        surfaces: true,
        options: Options { punctual, ..Options::default() },
    };
    let exported = export(&job, &Progress::default()).expect("it can be written");
    (serde_json::from_slice(&exported.files[0].bytes).expect("it is JSON"), exported)
}

fn vector(value: &Value, otherwise: [f64; 3]) -> DVec3 {
    let component = |i: usize| value[i].as_f64().unwrap_or(otherwise[i]);
    DVec3::new(component(0), component(1), component(2))
}

fn turn(value: &Value) -> DQuat {
    if value.is_null() {
        return DQuat::IDENTITY;
    }
    DQuat::from_array([0, 1, 2, 3].map(|i| value[i].as_f64().expect("a quaternion")))
}

/// What a viewer makes of a document's lights: each with its colour, placed by the nodes of the first scene.
fn read(document: &Value) -> Vec<(Punctual, DVec3)> {
    let mut lights = Vec::new();
    let mut open: Vec<(usize, DVec3, DQuat)> = Vec::new();
    let index = |value: &Value| usize::try_from(value.as_u64().expect("an index")).expect("a small one");
    for root in document["scenes"][0]["nodes"].as_array().expect("nodes") {
        open.push((index(root), DVec3::ZERO, DQuat::IDENTITY));
    }
    while let Some((node, position, rotation)) = open.pop() {
        let node = &document["nodes"][node];
        let position = position + rotation * vector(&node["translation"], [0.0; 3]);
        let rotation = rotation * turn(&node["rotation"]);
        for child in node["children"].as_array().into_iter().flatten() {
            open.push((index(child), position, rotation));
        }
        let light = &node["extensions"]["KHR_lights_punctual"]["light"];
        if light.is_null() {
            continue;
        }
        let light = &document["extensions"]["KHR_lights_punctual"]["lights"][index(light)];
        let strength = light["intensity"].as_f64().expect("an intensity");
        let axis = rotation * DVec3::NEG_Z;
        let punctual = match light["type"].as_str() {
            Some("point") => Punctual::Point { position, intensity: strength },
            Some("directional") => Punctual::Directional { to_light: -axis, illuminance: strength },
            Some("spot") => {
                let cosine = |key: &str| light["spot"][key].as_f64().expect("an angle").cos();
                let cone = Cone { cos_inner: cosine("innerConeAngle"), cos_outer: cosine("outerConeAngle") };
                Punctual::Spot { position, intensity: strength, axis, cone }
            }
            other => panic!("{other:?} is no type of light"),
        };
        lights.push((punctual, vector(&light["color"], [1.0; 3])));
    }
    lights
}

/// The illuminance in a document, in its own frame, is that of the scene's lights by their fit.
#[track_caller]
fn check(scene: &Scene, count: u32) {
    let (document, _) = exported(scene, Budget::Count(count));
    let lights = read(&document);
    assert!(!lights.is_empty(), "there is light");
    let lobe = PhongLobe::new(1.0);
    for (p, n) in [(DVec3::new(0.3, 0.2, 0.0), DVec3::Z), (DVec3::new(-1.0, 2.0, 0.5), DVec3::new(0.6, 0.0, 0.8))] {
        let at = ShadingPoint { p, n, v: n };
        let expected: DVec3 = scene
            .lights
            .iter()
            .flat_map(|light| light.parts().into_iter().map(|part| (Method::Fit(count).for_shape(&light.shape), part)))
            .map(|(method, (emitter, weight))| weight * Prepared::new(&emitter, method).respond(&at, &lobe).irradiance)
            .sum();
        // Its Y is our Z, its Z our −Y.
        let theirs = |v: DVec3| DVec3::new(v.x, v.z, -v.y);
        let at = ShadingPoint { p: theirs(p), n: theirs(n), v: theirs(n) };
        let found: DVec3 = lights.iter().map(|(light, color)| light.respond(&at, &lobe).irradiance * *color).sum();
        assert!((found - expected).length() <= 1e-9 * expected.length(), "{found} lx, not {expected} at {p}");
    }
}

fn scene(lights: Vec<Light>) -> Scene {
    Scene { lights, ..crate::scene::first_light() }
}

fn placed_light(name: &str, shape: Shape) -> Light {
    let (position, rotation_deg) = (DVec3::new(0.5, -0.4, 2.5), DVec3::new(10.0, -20.0, 30.0));
    Light { position, rotation_deg, ..Light::new(name, shape) }
}

#[test]
fn a_viewer_sees_the_fit_in_its_own_frame() {
    check(&crate::scene::first_light(), 4);
    let lights = vec![
        placed_light("disk", Shape::Disk(Disk { radius: 0.4, two_sided: true })),
        placed_light("tube", Shape::Line(Line::tube(1.2, 0.02))),
        placed_light("bulb", Shape::Point(Point::default())),
        placed_light("sun", Shape::Directional(crate::light::Directional {})),
        placed_light("sky", Shape::Sky(Sky::OVERCAST)),
    ];
    for light in &lights {
        check(&scene(vec![light.clone()]), 5);
    }
    check(&scene(lights), 3);
}

#[test]
fn rectangles_and_disks_are_area_lights_too_but_never_in_the_same_scene() {
    let disk = placed_light("disk", Shape::Disk(Disk { radius: 0.4, two_sided: false }));
    let tube = placed_light("tube", Shape::Line(Line::tube(1.2, 0.02)));
    let luminance = disk.weight().max_element();
    let (document, exported) = exported(&scene(vec![disk, tube]), Budget::Count(2));
    let [punctual, area] = document["scenes"].as_array().expect("scenes").as_slice() else { panic!("two scenes") };
    let shared = area["nodes"].as_array().expect("nodes").iter();
    let shared = shared.filter(|node| punctual["nodes"].as_array().expect("nodes").contains(node)).count();
    let whole = punctual["nodes"].as_array().expect("nodes").len();
    assert_eq!(shared + 1, whole, "all but the disk are in both scenes");
    let light = &document["extensions"]["EXT_lights_area"]["lights"][0];
    assert_eq!((light["type"].as_str(), light["size"].as_f64()), (Some("disk"), Some(0.8)), "{light}");
    assert!((light["intensity"].as_f64().expect("nits") - luminance).abs() < 1e-9, "{light}");
    assert!(document["extensionsRequired"].is_null(), "nothing is required");
    assert!(exported.remarks.iter().any(|remark| remark.what.contains("EXT_lights_area")), "{:?}", exported.remarks);
}

#[test]
fn errors_stand_in_extras_and_remarks() {
    let disk = placed_light("disk", Shape::Disk(Disk { radius: 0.4, two_sided: false }));
    let (document, exported) = exported(&scene(vec![disk]), Budget::Worst(0.1));
    let nodes = document["nodes"].as_array().expect("nodes");
    let fit = nodes.iter().map(|node| &node["extras"]["softbox"]["fit"]).find(|fit| !fit.is_null()).expect("a fit");
    let worst = fit["worst_error"].as_f64().expect("a number");
    assert!(worst <= 0.1 && fit["lights"].as_u64().is_some_and(|count| count > 2), "{fit}");
    let remark = exported.remarks.iter().find(|remark| remark.thing.contains("disk")).expect("a remark");
    assert!(remark.fate == Fate::Changed && remark.what.contains("worst"), "{remark:?}");
}

#[test]
fn meshes_have_their_bytes_and_the_same_scene_the_same_files() {
    let (document, first) = exported(&crate::scene::first_light(), Budget::Count(1));
    let (_, second) = exported(&crate::scene::first_light(), Budget::Count(1));
    assert_eq!(first.files, second.files, "the same again");
    let [_, buffer] = first.files.as_slice() else { panic!("a document and its buffer") };
    assert_eq!(document["buffers"][0]["uri"], buffer.name.as_str(), "named by the document");
    let used: usize = document["bufferViews"]
        .as_array()
        .expect("views")
        .iter()
        .map(|view| usize::try_from(view["byteLength"].as_u64().expect("a length")).expect("a small one"))
        .sum();
    assert_eq!(used, buffer.bytes.len(), "all bytes are in views");
    let surfaces = crate::scene::first_light().surfaces.len();
    assert_eq!(first.remarks.iter().filter(|remark| remark.thing.starts_with("surface")).count(), surfaces, "remarks");
}
