//! A light's numbers.

use egui::{Ui, vec2};

use super::fields::{Fields, Number, drag, row_label};
use super::pattern;
use crate::light::{Light, LineEmission, Polygon, Quantity, QuantityKind, Shape, Sky, Tint};
use crate::scene::Scene;

/// The temperature that a light gets when its tint becomes one, kelvin.
const DAYLIGHT_K: f64 = 6500.0;

/// Skies that have a name, and what they are.
const SKIES: [(Sky, &str, &str); 3] = [
    (Sky { uniform: 1.0, cosine: 0.0 }, "uniform", "The same luminance in all directions"),
    (Sky { uniform: 0.0, cosine: 1.0 }, "cosine", "Luminance falls with the cosine of the angle from the zenith"),
    (Sky::OVERCAST, "CIE overcast", "The zenith three times as bright as the horizon"),
];

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(light) = fields.scene().lights.get(index).cloned() else { return };
    fields.section(ui, "Emission", |ui, fields| {
        emission(ui, fields, index, &light);
        tint(ui, fields, index, light.tint);
        fields.toggle(ui, "Muted", light.muted, at(index, |light, muted| light.muted = muted));
    });
    fields.section(ui, "Shape", |ui, fields| match &light.shape {
        Shape::Polygon(polygon) => polygon_rows(ui, fields, index, polygon),
        Shape::Line(line) => {
            fields.number(ui, "Length", &Number::LENGTH, line.length, at(index, set_length));
            let ways = [LineEmission::Isotropic, LineEmission::Tube].map(|way| (way, way.name().to_owned()));
            fields.choice(ui, "Emits as", &line.emission, &ways, at(index, Light::set_line_emission));
            if let Some(radius) = line.tube_radius() {
                fields.number(ui, "Radius", &Number::LENGTH, radius, at(index, set_radius));
            }
            let falloff = Number { range: 0.0..=3.0, hint: "Light falls with 1/rⁿ; 2 is physical", ..Number::FACTOR };
            fields.number(ui, "Falloff n", &falloff, line.falloff, at(index, set_falloff));
        }
        Shape::Sphere(sphere) => {
            fields.number(ui, "Radius", &Number::LENGTH, sphere.radius, at(index, set_radius));
        }
        Shape::Disk(disk) => {
            fields.number(ui, "Radius", &Number::LENGTH, disk.radius, at(index, set_radius));
            fields.toggle(ui, "Two-sided", disk.two_sided, at(index, set_two_sided));
        }
        Shape::Textured(textured) => {
            fields.number(ui, "Width", &Number::LENGTH, textured.size.x, at(index, set_width));
            fields.number(ui, "Height", &Number::LENGTH, textured.size.y, at(index, set_height));
            fields.toggle(ui, "Two-sided", textured.two_sided, at(index, set_two_sided));
            pattern::row(ui, fields, &light.name, &textured.pattern);
        }
        Shape::Cap(cap) => {
            let half_angle = Number {
                speed: 0.2,
                range: 0.01..=90.0,
                hint: "From the middle to the rim; the sun’s is 0.27°",
                ..Number::ANGLE
            };
            fields.number(ui, "Half-angle", &half_angle, cap.half_angle_deg, at(index, set_half_angle));
        }
        Shape::Sky(sky) => {
            sky_rows(ui, fields, index, *sky);
        }
        Shape::Point(_) => fields.derived(ui, "Extent", "none, a point"),
        Shape::Directional(_) => fields.derived(ui, "Extent", "parallel light along −Z"),
    });
    if let Shape::Polygon(polygon) = &light.shape {
        vertices(ui, fields, index, polygon);
    }
    fields.section(ui, "Placement", |ui, fields| {
        fields.vector(ui, "Position", &Number::PLACE, light.position, at(index, |light, p| light.position = p));
        fields.vector(ui, "Rotation", &Number::ANGLE, light.rotation_deg, at(index, |light, r| light.rotation_deg = r));
    });
}

/// An edit of the scene that is an edit of one light.
fn at<T>(index: usize, set: impl Fn(&mut Light, T)) -> impl Fn(&mut Scene, T) {
    move |scene, value| {
        if let Some(light) = scene.lights.get_mut(index) {
            set(light, value);
        }
    }
}

/// One row for each unit in which the emission may be stated; the one that is stated is kept when the light is resized.
fn emission(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, light: &Light) {
    for kind in light.shape.quantity_kinds() {
        let Some(value) = light.in_quantity(*kind) else { continue };
        let name = row_label(ui, quantity_name(*kind));
        ui.horizontal(|ui| {
            let mut edited = value;
            let style = Number::amount(quantity_suffix(*kind), value);
            let response = drag(ui, &style, &mut edited, 130.0).labelled_by(name);
            let set = at(index, |light: &mut Light, value| light.quantity = Quantity::new(*kind, value));
            fields.apply(&response, "Change emission", |scene| set(scene, edited));
            if light.shape.quantity_kinds().len() > 1 {
                let stated = light.quantity.kind() == *kind;
                let mut keep = ui.radio(stated, "").on_hover_text("State the light so: keeps this when it is resized");
                keep = keep.accessible_name(format!("Keep {}", quantity_name(*kind).to_lowercase()));
                if keep.clicked() && !stated {
                    keep.mark_changed();
                }
                fields.apply_now(&keep, "Change stated quantity", |scene| set(scene, value));
            }
        });
        ui.end_row();
    }
}

fn quantity_name(kind: QuantityKind) -> &'static str {
    match kind {
        QuantityKind::Luminance => "Luminance",
        QuantityKind::Flux => "Flux",
        QuantityKind::Intensity => "Intensity",
        QuantityKind::IntensityPerMetre => "Intensity/m",
        QuantityKind::Illuminance => "Illuminance",
    }
}

fn quantity_suffix(kind: QuantityKind) -> &'static str {
    match kind {
        QuantityKind::Luminance => " cd/m²",
        QuantityKind::Flux => " lm",
        QuantityKind::Intensity => " cd",
        QuantityKind::IntensityPerMetre => " cd/m",
        QuantityKind::Illuminance => " lx",
    }
}

fn tint(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, tint: Tint) {
    let by_temperature = matches!(tint, Tint::TemperatureK(_));
    let ways = [(false, "colour".to_owned()), (true, "temperature".to_owned())];
    fields.choice(ui, "Tint", &by_temperature, &ways, |scene, temperature| {
        // A colour taken from a temperature keeps what is seen; its greatest component becomes 1.
        let rgb = tint.rgb();
        let new = if temperature { Tint::TemperatureK(DAYLIGHT_K) } else { Tint::Color(rgb / rgb.max_element()) };
        at(index, |light, ()| light.tint = new)(scene, ());
    });
    match tint {
        Tint::Color(color) => {
            fields.color(ui, "Colour", color, at(index, |light, rgb| light.tint = Tint::Color(rgb)));
        }
        Tint::TemperatureK(kelvin) => {
            let style = Number { unit: " K", speed: 10.0, range: 1000.0..=40_000.0, hint: "" };
            let set = at(index, |light, kelvin| light.tint = Tint::TemperatureK(kelvin));
            fields.number(ui, "Temperature", &style, kelvin, set);
        }
    }
}

/// The sky's two parts, and the skies that people know.
fn sky_rows(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, sky: Sky) {
    let known = SKIES.iter().find(|(known, ..)| *known == sky);
    let mut choices: Vec<_> = SKIES.iter().map(|(sky, name, _)| (*sky, (*name).to_owned())).collect();
    if known.is_none() {
        choices.push((sky, "other".to_owned()));
    }
    let hint = known.map_or("L·(uniform + cosine·cos θ), θ from the zenith", |(.., hint)| hint);
    let set = at(index, |light: &mut Light, sky| light.shape = Shape::Sky(sky));
    fields.choice_explained(ui, "Kind", &sky, &choices, hint, set);
    let share = |hint| Number { speed: 0.01, range: 0.0..=10.0, hint, ..Number::FACTOR };
    let uniform = share("Share of the luminance that is the same in all directions");
    fields.number(ui, "Uniform", &uniform, sky.uniform, at(index, set_uniform));
    let cosine = share("Share that falls with the cosine of the angle from the zenith");
    fields.number(ui, "Cosine", &cosine, sky.cosine, at(index, set_cosine));
}

fn polygon_rows(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, polygon: &Polygon) {
    fields.derived(ui, "Area", &format!("{:.4} m²", polygon.area()));
    fields.toggle(ui, "Two-sided", polygon.two_sided, at(index, set_two_sided));
}

/// The polygon's corners in its own plane: numbers, and buttons to add and take away.
fn vertices(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, polygon: &Polygon) {
    fields.section(ui, "Vertices (m)", |ui, fields| {
        for (i, vertex) in polygon.vertices.iter().enumerate() {
            row_label(ui, &format!("{}", i + 1));
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 3.0;
                let mut edited = *vertex;
                for (axis, name) in ["X", "Y"].into_iter().enumerate() {
                    let name = format!("Vertex {} {name}", i + 1);
                    let style = Number { unit: "", ..Number::PLACE };
                    let response = drag(ui, &style, &mut edited[axis], 62.0).accessible_name(name);
                    let set = polygon_at(index, |polygon: &mut Polygon| polygon.vertices[i] = edited);
                    fields.apply(&response, "Move vertex", set);
                }
                vertex_buttons(ui, fields, index, polygon, i);
            });
            ui.end_row();
        }
    });
}

fn vertex_buttons(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, polygon: &Polygon, i: usize) {
    use egui_material_icons::icons::{ICON_ADD, ICON_REMOVE};
    let button =
        |icon: egui_material_icons::MaterialIcon| egui::Button::new(icon.rich_text()).min_size(vec2(20.0, 20.0));
    let middle = polygon.vertices[i].midpoint(polygon.vertices[(i + 1) % polygon.vertices.len()]);
    let mut add = ui.add(button(ICON_ADD)).on_hover_text("Add a vertex after this one");
    add = add.accessible_name(format!("Add after vertex {}", i + 1));
    if add.clicked() {
        add.mark_changed();
    }
    fields.apply_now(&add, "Add vertex", polygon_at(index, |polygon| polygon.vertices.insert(i + 1, middle)));
    let mut delete =
        ui.add_enabled(polygon.vertices.len() > 3, button(ICON_REMOVE)).on_hover_text("Delete this vertex");
    delete = delete.accessible_name(format!("Delete vertex {}", i + 1));
    if delete.clicked() {
        delete.mark_changed();
    }
    let delete_vertex = polygon_at(index, |polygon| {
        polygon.vertices.remove(i);
    });
    fields.apply_now(&delete, "Delete vertex", delete_vertex);
}

/// An edit of the scene that is an edit of one light's polygon.
fn polygon_at(index: usize, edit: impl FnOnce(&mut Polygon)) -> impl FnOnce(&mut Scene) {
    move |scene| {
        if let Some(Light { shape: Shape::Polygon(polygon), .. }) = scene.lights.get_mut(index) {
            edit(polygon);
        }
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
