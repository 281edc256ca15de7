//! Random scenes, and random damage to a file.

use std::path::Path;
use std::sync::OnceLock;

use glam::{DVec2, DVec3};
use proptest::prelude::*;
use softbox::light::pattern::Pattern;
use softbox::light::photometry::Photometry;
use softbox::light::{self, Light, Quantity, Tint};
use softbox::scene::{self, Camera, Display, Plot, PlotKind, PlotQuantity, Scene, Variant};
use softbox::surface::{self, Material, Mesh, ReflectionModel, Surface};

use super::WINDOW;

/// Numbers of every magnitude that a scene may hold.
fn number() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..10.0, -1e9..1e9, -1e-9..1e-9, Just(0.0), Just(0.1 + 0.2)]
}

fn positive() -> impl Strategy<Value = f64> {
    prop_oneof![1e-3..10.0, 1e-12..1e-3, 10.0..1e9]
}

fn vector() -> impl Strategy<Value = DVec3> {
    [number(), number(), number()].prop_map(DVec3::from)
}

/// Names with what TOML must escape.
fn name() -> impl Strategy<Value = String> {
    r#"[a-z"'\\# \[\]=.\u{e9}\u{1f4a1}]{1,12}"#
}

fn light_shape() -> impl Strategy<Value = light::Shape> {
    let polygon = (proptest::collection::vec(positive(), 3..12), any::<bool>()).prop_map(|(radii, two_sided)| {
        // About its centre, a vertex every equal angle: simple whatever the radii.
        let turn = std::f64::consts::TAU / radii.len() as f64;
        let vertices = radii.iter().enumerate().map(|(i, r)| *r * DVec2::from_angle(turn * i as f64)).collect();
        light::Shape::Polygon(light::Polygon { vertices, two_sided })
    });
    let isotropic = positive().prop_map(light::Line::isotropic);
    let tube = (positive(), positive()).prop_map(|(length, radius)| light::Line::tube(length, radius));
    let line = (prop_oneof![isotropic, tube], 0.0..=3.0)
        .prop_map(|(line, falloff)| light::Shape::Line(light::Line { falloff, ..line }));
    let disk = (positive(), any::<bool>())
        .prop_map(|(radius, two_sided)| light::Shape::Disk(light::Disk { radius, two_sided }));
    let textured = ([positive(), positive()], file_name("png"), any::<bool>()).prop_map(|(size, file, two_sided)| {
        let pattern = Pattern { file, ..pattern() };
        light::Shape::Textured(light::Textured { size: size.into(), pattern, two_sided })
    });
    let sky = (0.01..10.0, prop_oneof![0.01..10.0, Just(0.0)])
        .prop_map(|(uniform, cosine)| light::Shape::Sky(light::Sky { uniform, cosine }));
    prop_oneof![
        polygon,
        line,
        disk,
        textured,
        sky,
        positive().prop_map(|radius| light::Shape::Sphere(light::Sphere { radius })),
        (1e-3..=90.0).prop_map(|half_angle_deg| light::Shape::Cap(light::Cap { half_angle_deg })),
        Just(light::Shape::Point(light::Point::default())),
        file_name("ies").prop_map(|file| {
            let ies = Photometry { file, ..photometry() };
            light::Shape::Point(light::Point { ies: Some(ies) })
        }),
        Just(light::Shape::Directional(light::Directional {})),
    ]
}

/// Names of files below the scene's folder, with what TOML must escape.
fn file_name(extension: &'static str) -> impl Strategy<Value = String> {
    r#"([a-z]{1,4}/)?[a-z"\u{e9}' ]{0,6}[a-z]"#.prop_map(move |name| format!("{name}.{extension}"))
}

/// The file that every pattern here is read from.
const PICTURE: &[u8] = include_bytes!("../../presets/scenes/textures/lattice.png");

/// What is in that file.
fn pattern() -> Pattern {
    static PATTERN: OnceLock<Pattern> = OnceLock::new();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("presets/scenes/textures/lattice.png");
    PATTERN.get_or_init(|| scene::import_pattern(&path, None).expect("a picture")).clone()
}

/// The file that every photometry here is read from.
const SPOT: &[u8] = b"IESNA91\nTILT=NONE\n1 -1 1 3 1 1 2 0 0 0\n1 1 0\n0 30 90\n0\n800 400 0\n";

/// What is in that file.
fn photometry() -> Photometry {
    scene::photometry_of_bytes("spot.ies", SPOT.to_vec()).expect("an IES file")
}

/// The file that every mesh here is read from.
const TRIANGLE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// What is in that file.
fn mesh() -> Mesh {
    static MESH: OnceLock<Mesh> = OnceLock::new();
    let read = || {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join("triangle.obj");
        std::fs::write(&path, TRIANGLE).expect("the folder is writable");
        scene::import_mesh(&path, None).expect("a mesh")
    };
    MESH.get_or_init(read).clone()
}

/// Read a scene whose patterns all have the same picture, whose points the same photometry, and whose meshes the same
/// triangle.
fn read(text: &str) -> Result<Scene, TestCaseError> {
    let bytes = |name: &str| match name.rsplit('.').next() {
        Some("obj") => TRIANGLE,
        Some("ies") => SPOT,
        _ => PICTURE,
    };
    let read = scene::parse_with(text, "any.toml", |name| Ok(bytes(name).to_vec()));
    read.map_err(|error| TestCaseError::fail(format!("{error}\n{text}")))
}

fn any_model() -> impl Strategy<Value = ReflectionModel> {
    let factor = || prop_oneof![-1.0..-0.01, 0.01..1.0];
    prop_oneof![
        Just(ReflectionModel::Phong {}),
        Just(ReflectionModel::Blinn {}),
        (0.01..=1.0, 0.0..=1.0)
            .prop_map(|(roughness, reflectance)| ReflectionModel::CookTorrance { roughness, reflectance }),
        (factor(), factor()).prop_map(|(tangential, normal)| ReflectionModel::Lafortune { tangential, normal }),
    ]
}

fn tint() -> impl Strategy<Value = Tint> {
    prop_oneof![
        Just(Tint::default()),
        [positive(), positive(), positive()].prop_map(|rgb| Tint::Color(rgb.into())),
        (1000.0..=40_000.0).prop_map(Tint::TemperatureK),
    ]
}

fn any_light() -> impl Strategy<Value = Light> {
    let quantity = (any::<bool>(), positive());
    // Names of surfaces that the scene may have or not; see `link`.
    let only = proptest::option::of(proptest::collection::vec("[0-3]", 0..4));
    let belonging = (proptest::option::of(name()), only);
    (name(), vector(), vector(), tint(), any::<bool>(), light_shape(), quantity, belonging).prop_map(
        |(name, position, rotation_deg, tint, muted, shape, (last, value), (group, only))| {
            let kinds = shape.quantity_kinds();
            let quantity = Quantity::new(kinds[if last { kinds.len() - 1 } else { 0 }], value);
            Light { name, position, rotation_deg, tint, quantity, muted, group, only, shape }
        },
    )
}

/// Points that are not all on one line.
fn control_points() -> impl Strategy<Value = [DVec3; 16]> {
    proptest::collection::vec(vector(), 16).prop_map(|points| {
        let mut points: [DVec3; 16] = std::array::from_fn(|i| points[i]);
        points[..3].copy_from_slice(&DVec3::AXES);
        points
    })
}

fn any_surface() -> impl Strategy<Value = Surface> {
    let size = || [positive(), positive(), positive()];
    let shape = prop_oneof![
        Just(surface::Shape::Plane {}),
        positive().prop_map(|radius| surface::Shape::Sphere { radius }),
        size().prop_map(|size| surface::Shape::Box { size: size.into() }),
        size().prop_map(|[x, y, _]| surface::Shape::Square { size: DVec2::new(x, y) }),
        positive().prop_map(|radius| surface::Shape::Disk { radius }),
        size().prop_map(|[radius, height, _]| surface::Shape::Cylinder { radius, height }),
        size().prop_map(|[radius, height, _]| surface::Shape::Cone { radius, height }),
        (0..=surface::MOST_FLAKE_DEPTH).prop_map(|depth| surface::Shape::Sphereflake { depth }),
        (0..=surface::MOST_TETRAHEDRON_DEPTH).prop_map(|depth| surface::Shape::Tetrahedron { depth }),
        control_points().prop_map(|control_points| surface::Shape::Patch { control_points: Box::new(control_points) }),
        file_name("obj").prop_map(|file| surface::Shape::Mesh(Mesh { file, ..mesh() })),
    ];
    (name(), vector(), vector(), size(), shape).prop_map(|(name, position, rotation_deg, scale, shape)| Surface {
        name,
        material: "clay".to_owned(),
        position,
        rotation_deg,
        scale: scale.into(),
        shape,
    })
}

fn any_plot() -> impl Strategy<Value = Plot> {
    let kind = prop_oneof![Just(PlotKind::Tilt), Just(PlotKind::View), Just(PlotKind::Line), Just(PlotKind::Distance)];
    let material = proptest::option::of(Just("clay".to_owned()));
    (name(), kind, vector(), proptest::option::of(positive()), positive(), material, any::<bool>()).prop_map(
        |(name, kind, position, view, first, material, normalise)| Plot {
            name,
            kind,
            quantity: PlotQuantity::Radiance,
            position,
            normal: DVec3::new(first, 0.0, -1.0),
            view: view.map(DVec3::splat),
            axis: DVec3::X,
            range: [0.5 * first, first],
            material,
            normalise,
        },
    )
}

/// Rename so that no two are called the same.
fn number_names<T>(entries: &mut [T], name_of: impl Fn(&mut T) -> &mut String) {
    for (i, entry) in entries.iter_mut().enumerate() {
        name_of(entry).push_str(&i.to_string());
    }
}

/// Let the names of surfaces that lights are linked to be those of the scene's, each once.
fn link(scene: &mut Scene) {
    let names: Vec<_> = scene.surfaces.iter().map(|surface| surface.name.clone()).collect();
    for only in scene.all_lights_mut().filter_map(|light| light.only.as_mut()) {
        *only = names.iter().filter(|name| only.iter().any(|end| name.ends_with(end.as_str()))).cloned().collect();
    }
}

fn any_variant() -> impl Strategy<Value = Variant> {
    (name(), proptest::collection::vec(any_light(), 0..3)).prop_map(|(name, mut lights)| {
        number_names(&mut lights, |light| &mut light.name);
        Variant { name, lights }
    })
}

fn any_scene() -> impl Strategy<Value = Scene> {
    use proptest::collection::vec;
    let camera = (vector(), 0.1..179.0)
        .prop_map(|(eye, fov_deg)| Camera { eye, target: eye + DVec3::splat(1.0 + 1e-3 * eye.length()), fov_deg })
        .prop_filter("the camera looks somewhere within the limits", |camera| camera.target.max_element() < 1e9);
    let display = (-100.0..=100.0).prop_map(|exposure_ev| Display { exposure_ev });
    let tags = vec("[a-z]{1,6}", 0..3).prop_map(|mut tags| {
        number_names(&mut tags, |tag| tag);
        tags
    });
    let view = ((name(), tags), camera, display, any_model());
    let variants = (vec(any_variant(), 0..3), any::<bool>());
    (view, vec(any_surface(), 0..4), vec(any_light(), 0..4), vec(any_plot(), 0..3), variants).prop_map(
        |(((name, tags), camera, display, model), mut surfaces, mut lights, mut plots, (mut variants, is_active))| {
            number_names(&mut variants, |variant| &mut variant.name);
            number_names(&mut surfaces, |surface| &mut surface.name);
            number_names(&mut lights, |light| &mut light.name);
            number_names(&mut plots, |plot| &mut plot.name);
            let clay = Material {
                name: "clay".to_owned(),
                diffuse: DVec3::splat(0.3),
                specular: DVec3::ZERO,
                model,
                exponent: 1.5,
            };
            let active_variant = variants.first().map(|variant| variant.name.clone()).filter(|_| is_active);
            let materials = vec![clay];
            let mut scene =
                Scene { name, tags, camera, display, materials, surfaces, lights, plots, variants, active_variant };
            link(&mut scene);
            scene
        },
    )
}

/// What an edit makes of a list: entries stay, come first, change under their name, are replaced, or go.
fn edited<T: Clone>(old: &[T], new: &[T], choices: &[u8], name_of: impl Fn(&mut T) -> &mut String) -> Vec<T> {
    let mut edited = Vec::new();
    for (i, choice) in choices.iter().enumerate() {
        match (choice, old.get(i).cloned(), new.get(i).cloned()) {
            (0, Some(old), _) => edited.push(old),
            (1, Some(old), _) => edited.insert(0, old),
            (2, Some(mut old), Some(mut new)) => {
                name_of(&mut new).clone_from(name_of(&mut old));
                edited.push(new);
            }
            (3, _, Some(mut new)) => {
                name_of(&mut new).push_str(" new");
                edited.push(new);
            }
            _ => {}
        }
    }
    edited
}

/// A scene and what an edit makes of it.
fn any_edit() -> impl Strategy<Value = (Scene, Scene)> {
    (any_scene(), any_scene(), proptest::collection::vec(0_u8..5, 4)).prop_map(|(old, new, choices)| {
        let surfaces = edited(&old.surfaces, &new.surfaces, &choices, |surface| &mut surface.name);
        let lights = edited(&old.lights, &new.lights, &choices, |light| &mut light.name);
        let plots = edited(&old.plots, &new.plots, &choices, |plot| &mut plot.name);
        let variants = edited(&old.variants, &new.variants, &choices, |variant| &mut variant.name);
        let is_there = |name: &String| variants.iter().any(|variant| variant.name == *name);
        let active_variant = new.active_variant.clone().filter(is_there);
        let mut new = Scene { surfaces, lights, plots, variants, active_variant, ..new };
        link(&mut new);
        (old, new)
    })
}

/// The comments beside the headers, each with its header and the name below it.
fn marks(text: &str) -> Vec<(&str, &str, &str)> {
    let lines: Vec<_> = text.lines().collect();
    let mark = |pair: &[&'_ str]| pair[0].starts_with("[[") && pair[0].contains(" # ");
    lines
        .windows(2)
        .filter(|pair| mark(pair))
        .filter_map(|pair| pair[0].split_once(" # ").map(|(header, comment)| (header, comment, pair[1])))
        .collect()
}

proptest! {
    #[test]
    fn a_file_that_softbox_wrote_stays_as_softbox_writes_it((old, new) in any_edit()) {
        // The comment at the end shows that the text was merged, not written anew.
        let [old, expected] = [&old, &new].map(|scene| scene::to_toml(scene) + "# end\n");
        prop_assert_eq!(scene::merge(&old, &new), expected, "the same text");
    }

    #[test]
    fn comments_stay_with_the_names_that_stay((old, new) in any_edit()) {
        let mark = |(i, line): (usize, &str)| match line.starts_with("[[") {
            true => format!("{line} # comment {i}\n"),
            false => format!("{line}\n"),
        };
        let text: String = scene::to_toml(&old).lines().enumerate().map(mark).collect();
        let merged = scene::merge(&text, &new);
        prop_assert_eq!(read(&merged)?, new.clone(), "the same scene");
        let (after, plain) = (marks(&merged), scene::to_toml(&new));
        for (header, comment, name) in marks(&text) {
            let stays = plain.contains(&format!("{header}\n{name}\n"));
            prop_assert!(!stays || after.contains(&(header, comment, name)), "{} {} in\n{}", header, name, merged);
        }
    }

    #[test]
    fn any_scene_is_read_as_it_was_written(scene in any_scene()) {
        let text = scene::to_toml(&scene);
        let read = read(&text)?;
        prop_assert_eq!(&read, &scene, "the same scene");
        prop_assert_eq!(scene::to_toml(&read), text, "the same text");
    }

    #[test]
    fn no_text_makes_the_loader_panic(edit in 0..WINDOW.len(), insertion in ".{0,3}", cut in 0..40_usize) {
        let mut text = WINDOW.to_owned();
        let start = text.floor_char_boundary(edit);
        let end = text.ceil_char_boundary((edit + cut).min(text.len()));
        text.replace_range(start..end, &insertion);
        if let Err(error) = scene::parse(&text, "any.toml") {
            prop_assert!(error.to_string().starts_with("any.toml:"), "{}", error);
        }
    }
}
