//! The numbers of lights: of one, or of all that are selected together.

use egui::Ui;

use super::fields::{Fields, Number};
use super::together::Lights;
use super::{emission, pattern, photometry, vertices};
use crate::light::{Light, Line, LineEmission, Polygon, Shape, Sky};

/// Skies that have a name, and what they are.
const SKIES: [(Sky, &str, &str); 3] = [
    (Sky { uniform: 1.0, cosine: 0.0 }, "uniform", "The same luminance in all directions"),
    (Sky { uniform: 0.0, cosine: 1.0 }, "cosine", "Luminance falls with the cosine of the angle from the zenith"),
    (Sky::OVERCAST, "CIE overcast", "The zenith three times as bright as the horizon"),
];

/// What the selected lights have in common, the one at `index` first.
pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(lights) = Lights::selected(fields.session, index) else { return };
    fields.section(ui, "Emission", |ui, fields| emission::rows(ui, fields, &lights));
    fields.section(ui, "Shape", |ui, fields| shape(ui, fields, &lights));
    if let [Light { shape: Shape::Polygon(polygon), .. }] = lights.all() {
        vertices::show(ui, fields, index, polygon);
    }
    fields.section(ui, "Placement", |ui, fields| {
        let positions = lights.each(|light| light.position);
        fields.vectors(ui, "Position", &Number::PLACE, &positions, lights.set_each(|light, p| light.position = p));
        let rotations = lights.each(|light| light.rotation_deg);
        let set = lights.set_each(|light, r| light.rotation_deg = r);
        fields.vectors(ui, "Rotation", &Number::ANGLE, &rotations, set);
    });
}

/// A row for each number of their shapes that all of them have.
fn shape(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights) {
    let falloff = Number { range: 0.0..=3.0, hint: "Light falls with 1/rⁿ; 2 is physical", ..Number::FACTOR };
    let half_angle = Number {
        speed: 0.2,
        range: 0.01..=90.0,
        hint: "From the middle to the rim; the sun’s is 0.27°",
        ..Number::ANGLE
    };
    if lights.of_all(line).is_some() {
        let ways = [LineEmission::Isotropic, LineEmission::Tube].map(|way| (way, way.name().to_owned()));
        let current = lights.of_all(|light| line(light).map(|line| line.emission)).unwrap_or_default();
        fields.choice_of_all(ui, "Emits as", &current, &ways, "", lights.set(Light::set_line_emission));
    }
    let numbers: [(&str, &Number, Get, Set); 6] = [
        ("Length", &Number::LENGTH, |light| line(light).map(|line| line.length), set_length),
        ("Radius", &Number::LENGTH, radius, set_radius),
        ("Width", &Number::LENGTH, |light| size(light).map(|size| size.x), set_width),
        ("Height", &Number::LENGTH, |light| size(light).map(|size| size.y), set_height),
        ("Falloff n", &falloff, |light| line(light).map(|line| line.falloff), set_falloff),
        ("Half-angle", &half_angle, cap_angle, set_half_angle),
    ];
    for (label, style, get, set) in numbers {
        if let Some(values) = lights.of_all(get) {
            fields.numbers(ui, label, style, &values, lights.set_each(set));
        }
    }
    if let Some(values) = lights.of_all(two_sided) {
        fields.toggle_all(ui, "Two-sided", &values, lights.set(set_two_sided));
    }
    match lights.all() {
        [light] => shape_of_one(ui, fields, lights, light),
        [first, others @ ..] if others.iter().any(|light| light.shape.name() != first.shape.name()) => {
            fields.derived(ui, "Kinds", "differ");
        }
        _ => {}
    }
}

/// What is shown of a single light only.
fn shape_of_one(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights, light: &Light) {
    match &light.shape {
        Shape::Polygon(polygon) => fields.derived(ui, "Area", &format!("{:.4} m²", Polygon::area(polygon))),
        Shape::Textured(textured) => pattern::row(ui, fields, &light.name, &textured.pattern),
        Shape::Sky(sky) => sky_rows(ui, fields, lights, *sky),
        Shape::Point(point) => {
            fields.derived(ui, "Extent", "none, a point");
            if let Some(file) = &point.ies {
                photometry::row(ui, fields, &light.name, file);
            }
        }
        Shape::Directional(_) => fields.derived(ui, "Extent", "parallel light along −Z"),
        Shape::Line(_) | Shape::Sphere(_) | Shape::Disk(_) | Shape::Cap(_) => {}
    }
}

/// The sky's two parts, and the skies that people know.
fn sky_rows(ui: &mut Ui, fields: &mut Fields<'_>, lights: &Lights, sky: Sky) {
    let known = SKIES.iter().find(|(known, ..)| *known == sky);
    let mut choices: Vec<_> = SKIES.iter().map(|(sky, name, _)| (*sky, (*name).to_owned())).collect();
    if known.is_none() {
        choices.push((sky, "other".to_owned()));
    }
    let hint = known.map_or("L·(uniform + cosine·cos θ), θ from the zenith", |(.., hint)| hint);
    let set = lights.set(|light: &mut Light, sky| light.shape = Shape::Sky(sky));
    fields.choice_explained(ui, "Kind", &sky, &choices, hint, set);
    let share = |hint| Number { speed: 0.01, range: 0.0..=10.0, hint, ..Number::FACTOR };
    let uniform = share("Share of the luminance that is the same in all directions");
    fields.number(ui, "Uniform", &uniform, sky.uniform, lights.set(set_uniform));
    let cosine = share("Share that falls with the cosine of the angle from the zenith");
    fields.number(ui, "Cosine", &cosine, sky.cosine, lights.set(set_cosine));
}

/// Reads a number of a light's shape; none where the shape does not have it.
type Get = fn(&Light) -> Option<f64>;
/// Writes it.
type Set = fn(&mut Light, f64);

fn line(light: &Light) -> Option<&Line> {
    if let Shape::Line(line) = &light.shape { Some(line) } else { None }
}

fn size(light: &Light) -> Option<glam::DVec2> {
    if let Shape::Textured(textured) = &light.shape { Some(textured.size) } else { None }
}

fn radius(light: &Light) -> Option<f64> {
    match &light.shape {
        Shape::Sphere(sphere) => Some(sphere.radius),
        Shape::Disk(disk) => Some(disk.radius),
        Shape::Line(line) => line.tube_radius(),
        _ => None,
    }
}

fn cap_angle(light: &Light) -> Option<f64> {
    if let Shape::Cap(cap) = &light.shape { Some(cap.half_angle_deg) } else { None }
}

fn two_sided(light: &Light) -> Option<bool> {
    match &light.shape {
        Shape::Polygon(polygon) => Some(polygon.two_sided),
        Shape::Disk(disk) => Some(disk.two_sided),
        Shape::Textured(textured) => Some(textured.two_sided),
        _ => None,
    }
}

fn set_length(light: &mut Light, length: f64) {
    if let Shape::Line(line) = &mut light.shape {
        line.length = length;
    }
}

fn set_falloff(light: &mut Light, falloff: f64) {
    if let Shape::Line(line) = &mut light.shape {
        line.falloff = falloff;
    }
}

fn set_radius(light: &mut Light, radius: f64) {
    match &mut light.shape {
        Shape::Sphere(sphere) => sphere.radius = radius,
        Shape::Disk(disk) => disk.radius = radius,
        Shape::Line(line) if line.emission == LineEmission::Tube => line.radius = Some(radius),
        _ => {}
    }
}

fn set_two_sided(light: &mut Light, two_sided: bool) {
    match &mut light.shape {
        Shape::Polygon(polygon) => polygon.two_sided = two_sided,
        Shape::Disk(disk) => disk.two_sided = two_sided,
        Shape::Textured(textured) => textured.two_sided = two_sided,
        _ => {}
    }
}

fn set_width(light: &mut Light, width: f64) {
    if let Shape::Textured(textured) = &mut light.shape {
        textured.size.x = width;
    }
}

fn set_height(light: &mut Light, height: f64) {
    if let Shape::Textured(textured) = &mut light.shape {
        textured.size.y = height;
    }
}

fn set_half_angle(light: &mut Light, half_angle_deg: f64) {
    if let Shape::Cap(cap) = &mut light.shape {
        cap.half_angle_deg = half_angle_deg;
    }
}

fn set_uniform(light: &mut Light, uniform: f64) {
    if let Shape::Sky(sky) = &mut light.shape {
        sky.uniform = uniform;
    }
}

fn set_cosine(light: &mut Light, cosine: f64) {
    if let Shape::Sky(sky) = &mut light.shape {
        sky.cosine = cosine;
    }
}
