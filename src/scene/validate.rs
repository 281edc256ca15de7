//! What the values of a scene must fulfil beyond the structure of its file.

use std::collections::BTreeSet;
use std::ops::Bound::{self, Excluded, Included};

use glam::DVec3;

use super::nearest::{quoted, suggestion};
use super::{Camera, Display, Path, Plot, PlotKind, Problem, Scene, Variant, beside};
use crate::light::{Light, Line, LineEmission, Polygon, Shape, Sky, Sphere, Tint, luminance_of};
use crate::surface::{self, MOST_FLAKE_DEPTH, MOST_TETRAHEDRON_DEPTH, Material, ReflectionModel, Surface};

/// Lengths and coordinates reach this far, metres: squares of them stay within what the GPU's `f32` can hold.
const FARTHEST: f64 = 1e9;

/// No photometric quantity is above this, whatever its unit. The sun's luminance is 1.6e9 cd/m².
const BRIGHTEST: f64 = 1e15;

/// Phong exponents reach this far; the closed forms' cost grows with the exponent.
const SHARPEST: f64 = 1e4;

/// Exposure in either direction, steps.
const MOST_EXPOSURE: f64 = 100.0;

/// A polygon has at most this many vertices; whether its edges cross is found edge by edge.
const MOST_VERTICES: usize = 1024;

/// All that is wrong with a scene's values, with the paths that a scene file gives them.
pub fn validate(scene: &Scene) -> Vec<Problem> {
    let Scene { name, tags, camera, display, materials, surfaces, lights, plots, variants, active_variant } = scene;
    let mut checker = Checker { scene, problems: Vec::new() };
    let root = Path::default();
    checker.text(&root.key("name"), name);
    checker.tags(&root.key("tags"), tags);
    checker.camera(&root.key("camera"), camera);
    checker.display(&root.key("display"), *display);
    checker.each(&root.key("material"), materials, |material| &material.name, Checker::material);
    checker.each(&root.key("surface"), surfaces, |surface| &surface.name, Checker::surface);
    checker.each(&root.key("light"), lights, |light| &light.name, Checker::light);
    checker.each(&root.key("plot"), plots, |plot| &plot.name, Checker::plot);
    checker.each(&root.key("variant"), variants, |variant| &variant.name, Checker::variant);
    if let Some(active) = active_variant {
        checker.variant_name(&root.key("active_variant"), active);
    }
    checker.problems.extend(beside::ambiguous(scene));
    checker.problems
}

/// What a number must be, and how to say it.
struct Limits {
    low: Bound<f64>,
    high: Bound<f64>,
    right: &'static str,
}

const LENGTH: Limits =
    Limits { low: Excluded(0.0), high: Included(FARTHEST), right: "write a length in metres such as 0.5" };
const COORDINATE: Limits =
    Limits { low: Included(-FARTHEST), high: Included(FARTHEST), right: "write a number of metres such as 1.5" };
const DIRECTION: Limits =
    Limits { low: Included(-FARTHEST), high: Included(FARTHEST), right: "write a number such as 1.0" };
const ANGLE_DEG: Limits =
    Limits { low: Included(-FARTHEST), high: Included(FARTHEST), right: "write an angle in degrees such as 45.0" };
const SCALE: Limits = Limits { low: Excluded(0.0), high: Included(FARTHEST), right: "write a factor such as 1.0" };
const FLAKE_DEPTH: Limits = Limits {
    low: Included(0.0),
    high: Included(MOST_FLAKE_DEPTH as f64),
    right: "write a whole number such as 2, which gives 91 spheres",
};
const TETRAHEDRON_DEPTH: Limits = Limits {
    low: Included(0.0),
    high: Included(MOST_TETRAHEDRON_DEPTH as f64),
    right: "write a whole number such as 5, which gives 4096 triangles",
};
const FALLOFF: Limits =
    Limits { low: Included(0.0), high: Included(3.0), right: "write a number from 0.0 to 3.0; light itself has 2.0" };
const COLOR: Limits = Limits { low: Included(0.0), high: Included(FARTHEST), right: "write a number such as 0.8" };
const TEMPERATURE_K: Limits =
    Limits { low: Included(1000.0), high: Included(40_000.0), right: "write kelvins from 1000.0 to 40000.0" };
const QUANTITY: Limits =
    Limits { low: Included(0.0), high: Included(BRIGHTEST), right: "write a number such as 1000.0" };
const REFLECTANCE: Limits =
    Limits { low: Included(0.0), high: Included(FARTHEST), right: "write a number from 0.0 to 1.0" };
const EXPONENT: Limits =
    Limits { low: Included(1.0), high: Included(SHARPEST), right: "write a number such as 32.0; larger is sharper" };
const ROUGHNESS: Limits =
    Limits { low: Included(0.01), high: Included(1.0), right: "write a slope such as 0.3; smaller is sharper" };
const FRESNEL: Limits =
    Limits { low: Included(0.0), high: Included(1.0), right: "write a share such as 0.04, which is glass" };
const LAFORTUNE: Limits = Limits { low: Included(-1.0), high: Included(1.0), right: "write a factor such as 0.9" };
const FOV_DEG: Limits =
    Limits { low: Excluded(0.0), high: Excluded(180.0), right: "write an angle in degrees such as 40.0" };
const CAP_ANGLE_DEG: Limits =
    Limits { low: Excluded(0.0), high: Included(90.0), right: "write an angle in degrees such as 30.0" };
const SKY_SHARE: Limits = Limits { low: Included(0.0), high: Included(FARTHEST), right: "write a share such as 1.0" };
const EXPOSURE_EV: Limits = Limits {
    low: Included(-MOST_EXPOSURE),
    high: Included(MOST_EXPOSURE),
    right: "write a number of steps such as 1.0, which doubles the brightness",
};

struct Checker<'s> {
    scene: &'s Scene,
    problems: Vec<Problem>,
}

impl Checker<'_> {
    fn report(&mut self, path: &Path, message: impl Into<String>) {
        self.problems.push(Problem::new(path.clone(), message));
    }

    fn camera(&mut self, path: &Path, camera: &Camera) {
        let Camera { eye, target, fov_deg } = *camera;
        self.vector(&path.key("eye"), eye, &COORDINATE);
        self.vector(&path.key("target"), target, &COORDINATE);
        if eye == target {
            self.report(&path.key("target"), "is where the eye is; write a point in front of the eye");
        }
        self.number(&path.key("fov_deg"), fov_deg, &FOV_DEG);
    }

    fn display(&mut self, path: &Path, display: Display) {
        let Display { exposure_ev } = display;
        self.number(&path.key("exposure_ev"), exposure_ev, &EXPOSURE_EV);
    }

    fn material(&mut self, path: &Path, material: &Material) {
        let Material { name: _, diffuse, specular, model, exponent } = material;
        self.vector(&path.key("diffuse"), *diffuse, &REFLECTANCE);
        self.vector(&path.key("specular"), *specular, &REFLECTANCE);
        self.number(&path.key("exponent"), *exponent, &EXPONENT);
        let path = path.key("model").key(model.name());
        match *model {
            ReflectionModel::Phong {} | ReflectionModel::Blinn {} => {}
            ReflectionModel::CookTorrance { roughness, reflectance } => {
                self.number(&path.key("roughness"), roughness, &ROUGHNESS);
                self.number(&path.key("reflectance"), reflectance, &FRESNEL);
            }
            ReflectionModel::Lafortune { tangential, normal } => {
                self.number(&path.key("tangential"), tangential, &LAFORTUNE);
                self.number(&path.key("normal"), normal, &LAFORTUNE);
                if tangential == 0.0 && normal == 0.0 {
                    self.report(&path, "reflects nothing; write { tangential = -1.0, normal = 1.0 }, which is Phong's");
                }
            }
        }
    }

    fn surface(&mut self, path: &Path, surface: &Surface) {
        let Surface { name: _, material, position, rotation_deg, scale, shape } = surface;
        self.material_name(&path.key("material"), material);
        self.vector(&path.key("position"), *position, &COORDINATE);
        self.vector(&path.key("rotation_deg"), *rotation_deg, &ANGLE_DEG);
        self.vector(&path.key("scale"), *scale, &SCALE);
        let path = path.key("shape").key(shape.name());
        match *shape {
            surface::Shape::Mesh(ref mesh) => self.file(&path.key("file"), &mesh.file, "meshes/chair.obj"),
            surface::Shape::Patch { ref control_points } => self.patch(&path.key("control_points"), control_points),
            surface::Shape::Plane {} => {}
            surface::Shape::Sphere { radius } | surface::Shape::Disk { radius } => {
                self.number(&path.key("radius"), radius, &LENGTH);
            }
            surface::Shape::Box { size } => self.vector(&path.key("size"), size, &LENGTH),
            surface::Shape::Square { size } => self.components(&path.key("size"), &size.to_array(), &LENGTH),
            surface::Shape::Cylinder { radius, height } | surface::Shape::Cone { radius, height } => {
                self.number(&path.key("radius"), radius, &LENGTH);
                self.number(&path.key("height"), height, &LENGTH);
            }
            surface::Shape::Sphereflake { depth } => {
                self.number(&path.key("depth"), depth.into(), &FLAKE_DEPTH);
            }
            surface::Shape::Tetrahedron { depth } => {
                self.number(&path.key("depth"), depth.into(), &TETRAHEDRON_DEPTH);
            }
        }
    }

    fn patch(&mut self, path: &Path, control_points: &[DVec3; 16]) {
        for (i, p) in control_points.iter().enumerate() {
            self.vector(&path.index(i), *p, &COORDINATE);
        }
        let [first, ..] = control_points;
        let directions = || control_points.iter().map(|p| p - first);
        let widest = |from: DVec3| directions().map(|to| from.cross(to).length_squared()).fold(0.0, f64::max);
        if directions().map(widest).fold(0.0, f64::max) == 0.0 {
            self.report(path, "lie on one line, which has no area; move some of them off it");
        }
    }

    fn variant(&mut self, path: &Path, variant: &Variant) {
        let Variant { name: _, lights } = variant;
        self.each(&path.key("light"), lights, |light| &light.name, Self::light);
    }

    /// What a light says of other things: its group and the surfaces that it lights.
    fn belonging(&mut self, path: &Path, group: Option<&String>, only: &[String]) {
        if let Some(group) = group {
            self.text(&path.key("group"), group);
            if group.is_empty() {
                self.report(&path.key("group"), "is empty; write a name, or leave it out");
            }
        }
        let mut names = BTreeSet::new();
        for (i, name) in only.iter().enumerate() {
            let path = path.key("only").index(i);
            if !self.scene.surfaces.iter().any(|surface| surface.name == *name) {
                let known = self.scene.surfaces.iter().map(|surface| surface.name.as_str());
                self.report(&path, format!("there is no surface `{name}`; {}", suggestion(name, known)));
            } else if !names.insert(name) {
                self.report(&path, format!("`{name}` is there twice; write each surface once"));
            }
        }
    }

    fn light(&mut self, path: &Path, light: &Light) {
        let Light { name: _, position, rotation_deg, tint, quantity, muted: _, group, only, shape } = light;
        self.belonging(path, group.as_ref(), only.as_deref().unwrap_or_default());
        self.vector(&path.key("position"), *position, &COORDINATE);
        self.vector(&path.key("rotation_deg"), *rotation_deg, &ANGLE_DEG);
        match *tint {
            Tint::Color(color) => {
                self.vector(&path.key("color"), color, &COLOR);
                if luminance_of(color.max(DVec3::ZERO)) <= 0.0 {
                    self.report(
                        &path.key("color"),
                        "is black, which is no tint; mute the light or write [1.0, 1.0, 1.0]",
                    );
                }
            }
            Tint::TemperatureK(kelvin) => self.number(&path.key("temperature_k"), kelvin, &TEMPERATURE_K),
        }
        let quantity_path = path.key(quantity.kind().key());
        if !shape.quantity_kinds().contains(&quantity.kind()) {
            let keys: Vec<_> = shape.quantity_kinds().iter().map(|kind| kind.key()).collect();
            self.report(&quantity_path, format!("does not fit a `{}`; write {}", shape.name(), either(&keys)));
        }
        self.number(&quantity_path, quantity.value(), &QUANTITY);
        let path = path.key("shape").key(shape.name());
        match shape {
            Shape::Polygon(polygon) => self.polygon(&path.key("vertices"), polygon),
            Shape::Line(Line { length, emission, radius, falloff }) => {
                self.number(&path.key("length"), *length, &LENGTH);
                match (emission, radius) {
                    (LineEmission::Isotropic, None) => {}
                    (LineEmission::Isotropic, Some(_)) => {
                        let message = "does not fit an `isotropic` line; write emission = \"tube\", or leave it out";
                        self.report(&path.key("radius"), message);
                    }
                    (LineEmission::Tube, None) => {
                        self.report(
                            &path.key("emission"),
                            "is `tube`, which has a radius; write radius = 0.01 beside it",
                        );
                    }
                    (LineEmission::Tube, Some(radius)) => self.number(&path.key("radius"), *radius, &LENGTH),
                }
                self.number(&path.key("falloff"), *falloff, &FALLOFF);
            }
            Shape::Sphere(Sphere { radius }) => self.number(&path.key("radius"), *radius, &LENGTH),
            Shape::Disk(disk) => self.number(&path.key("radius"), disk.radius, &LENGTH),
            Shape::Textured(textured) => {
                self.components(&path.key("size"), &textured.size.to_array(), &LENGTH);
                self.file(&path.key("pattern"), &textured.pattern.file, "textures/leaf.png");
            }
            Shape::Cap(cap) => self.number(&path.key("half_angle_deg"), cap.half_angle_deg, &CAP_ANGLE_DEG),
            Shape::Sky(Sky { uniform, cosine }) => {
                self.number(&path.key("uniform"), *uniform, &SKY_SHARE);
                self.number(&path.key("cosine"), *cosine, &SKY_SHARE);
                if *uniform == 0.0 && *cosine == 0.0 {
                    self.report(&path, "is black; write { uniform = 1.0, cosine = 0.0 } and mute it to have it dark");
                }
            }
            Shape::Point(point) => {
                if let Some(photometry) = &point.ies {
                    self.file(&path.key("ies"), &photometry.file, "photometry/spot.ies");
                }
            }
            Shape::Directional(_) => {}
        }
    }

    fn polygon(&mut self, path: &Path, polygon: &Polygon) {
        let before = self.problems.len();
        for (i, vertex) in polygon.vertices.iter().enumerate() {
            self.components(&path.index(i), &vertex.to_array(), &COORDINATE);
        }
        if polygon.vertices.len() > MOST_VERTICES {
            let message = format!("has {} vertices; write at most {MOST_VERTICES}", polygon.vertices.len());
            self.report(path, message);
        }
        if self.problems.len() == before
            && let Err(error) = polygon.check()
        {
            self.report(path, error.to_string());
        }
    }

    fn plot(&mut self, path: &Path, plot: &Plot) {
        let Plot { name: _, kind, quantity: _, position, normal, view, axis, range, material, normalise: _ } = plot;
        self.vector(&path.key("position"), *position, &COORDINATE);
        self.direction(&path.key("normal"), *normal);
        self.direction(&path.key("axis"), *axis);
        if let Some(view) = view {
            self.direction(&path.key("view"), *view);
        }
        if let Some(material) = material {
            self.material_name(&path.key("material"), material);
        }
        let path = path.key("range");
        let turns = matches!(kind, PlotKind::Tilt | PlotKind::View);
        self.components(&path, range, if turns { &ANGLE_DEG } else { &COORDINATE });
        let [first, last] = *range;
        if first >= last {
            self.report(&path, format!("must run upwards, but goes from {first:?} to {last:?}; swap the two"));
        }
        if *kind == PlotKind::Distance && first <= 0.0 {
            self.report(
                &path.index(0),
                format!(
                    "must be greater than 0, as distances are drawn on a logarithmic axis, but is {first:?}; write 0.1"
                ),
            );
        }
    }

    /// Check the entries of an array, and that no two have one name.
    fn each<T>(
        &mut self,
        path: &Path,
        entries: &[T],
        name_of: impl Fn(&T) -> &String,
        check: impl Fn(&mut Self, &Path, &T),
    ) {
        let mut names = BTreeSet::new();
        for (i, entry) in entries.iter().enumerate() {
            let (path, name) = (path.index(i), name_of(entry));
            if name.is_empty() {
                self.report(&path.key("name"), "is empty; write a name");
            } else if !names.insert(name) {
                self.report(&path.key("name"), format!("`{name}` is there twice; give each its own name"));
            }
            self.text(&path.key("name"), name);
            check(self, &path, entry);
        }
    }

    /// Names appear in errors, tables and file formats of one line each.
    fn text(&mut self, path: &Path, text: &str) {
        if text.contains(char::is_control) {
            self.report(path, format!("{text:?} has control characters; write it on one line"));
        }
    }

    /// Tags are words, each said once.
    fn tags(&mut self, path: &Path, tags: &[String]) {
        for (i, tag) in tags.iter().enumerate() {
            let path = path.index(i);
            if tag.trim().is_empty() {
                self.report(&path, "is empty; write a word such as \"studio\"");
            } else if tags[..i].contains(tag) {
                self.report(&path, format!("`{tag}` is there twice; keep one of the two"));
            }
            self.text(&path, tag);
        }
    }

    /// Files named in a scene stay below its folder.
    fn file(&mut self, path: &Path, name: &str, example: &str) {
        self.text(path, name);
        if !beside::is_inside(name) {
            let message = format!("`{name}` leaves the scene's folder; write a name such as \"{example}\"");
            self.report(path, if name.is_empty() { "is empty; write a file's name".to_owned() } else { message });
        }
    }

    fn material_name(&mut self, path: &Path, name: &str) {
        if self.scene.material(name).is_none() {
            let names = self.scene.materials.iter().map(|material| material.name.as_str());
            self.report(path, format!("there is no material `{name}`; {}", suggestion(name, names)));
        }
    }

    fn variant_name(&mut self, path: &Path, name: &str) {
        if self.scene.variant(name).is_none() {
            let names = self.scene.variants.iter().map(|variant| variant.name.as_str());
            self.report(path, format!("there is no variant `{name}`; {}", suggestion(name, names)));
        }
    }

    fn direction(&mut self, path: &Path, direction: DVec3) {
        self.vector(path, direction, &DIRECTION);
        if direction == DVec3::ZERO {
            self.report(path, "is zero, which is no direction; write one such as [0.0, 0.0, 1.0]");
        }
    }

    fn vector(&mut self, path: &Path, vector: DVec3, limits: &Limits) {
        self.components(path, &vector.to_array(), limits);
    }

    fn components(&mut self, path: &Path, components: &[f64], limits: &Limits) {
        for (i, component) in components.iter().enumerate() {
            self.number(&path.index(i), *component, limits);
        }
    }

    fn number(&mut self, path: &Path, value: f64, limits: &Limits) {
        if let Some(wrong) = limits.wrong(value) {
            self.report(path, format!("{wrong}, but is {value:?}; {}", limits.right));
        }
    }
}

impl Limits {
    /// Which limit `value` is beyond.
    fn wrong(&self, value: f64) -> Option<String> {
        if !value.is_finite() {
            return Some("must be finite".to_owned());
        }
        match self.low {
            Excluded(low) if value <= low => return Some(format!("must be greater than {}", short(low))),
            Included(0.0) if value < 0.0 => return Some("must not be negative".to_owned()),
            Included(low) if value < low => return Some(format!("must be at least {}", short(low))),
            _ => {}
        }
        match self.high {
            Excluded(high) if value >= high => Some(format!("must be less than {}", short(high))),
            Included(high) if value > high => Some(format!("must be at most {}", short(high))),
            _ => None,
        }
    }
}

/// A limit as people write it: 180, 1e9.
fn short(limit: f64) -> String {
    if limit.abs() < 1e6 { limit.to_string() } else { format!("{limit:e}") }
}

/// Names in backquotes, as alternatives.
fn either(names: &[&str]) -> String {
    quoted(names).replace(", ", " or ")
}
