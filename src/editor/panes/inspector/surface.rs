//! The numbers of surfaces: of one, or of all that are selected together.

use egui::Ui;
use glam::DVec3;

use super::fields::{Fields, Number, row_label};
use super::material;
use super::together::Together;
use crate::editor::commands::Command;
use crate::scene::Scene;
use crate::surface::{MOST_FLAKE_DEPTH, MOST_TETRAHEDRON_DEPTH, Material, Mesh, Shape, Surface};

/// What the selected surfaces have in common, the one at `index` first, and their materials.
pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(surfaces) = Together::<Surface>::selected(fields.session, index) else { return };
    let title = if surfaces.all().len() > 1 { "Surfaces" } else { "Surface" };
    fields.section(ui, title, |ui, fields| {
        let materials = material_names(fields.scene());
        let choices: Vec<_> = materials.into_iter().map(|name| (name.clone(), name)).collect();
        let current = surfaces.each(|surface| surface.material.clone());
        let set = surfaces.set(|surface, name| surface.material = name);
        fields.choice_of_all(ui, "Material", &current, &choices, "", set);
        shape(ui, fields, &surfaces);
    });
    fields.section(ui, "Placement", |ui, fields| {
        let positions = surfaces.each(|surface| surface.position);
        fields.vectors(ui, "Position", &Number::PLACE, &positions, surfaces.set_each(|s, p| s.position = p));
        let rotations = surfaces.each(|surface| surface.rotation_deg);
        fields.vectors(ui, "Rotation", &Number::ANGLE, &rotations, surfaces.set_each(|s, r| s.rotation_deg = r));
        let style = Number { speed: 0.005, range: 1e-3..=1e3, ..Number::FACTOR };
        let scales = surfaces.each(|surface| surface.scale);
        fields.vectors(ui, "Scale", &style, &scales, surfaces.set_each(|s, scale| s.scale = scale));
    });
    if let Some(materials) = Together::<Material>::of(fields.scene(), &surfaces) {
        material::show(ui, fields, &materials);
    }
}

pub(super) fn material_names(scene: &Scene) -> Vec<String> {
    scene.materials.iter().map(|material| material.name.clone()).collect()
}

/// A row for each number of their shapes that all of them have; more of one alone.
fn shape(ui: &mut Ui, fields: &mut Fields<'_>, surfaces: &Together<Surface>) {
    if let [surface] = surfaces.all() {
        match &surface.shape {
            Shape::Mesh(mesh) => mesh_row(ui, fields, &surface.name, mesh),
            Shape::Patch { control_points } => control_point_rows(ui, fields, surfaces, control_points),
            Shape::Plane {} => fields.derived(ui, "Extent", "infinite"),
            Shape::Sphereflake { depth } => {
                let set = surfaces.set(|surface, depth| surface.shape = Shape::Sphereflake { depth });
                fields.whole(ui, "Depth", 0..=MOST_FLAKE_DEPTH, *depth, set);
            }
            Shape::Tetrahedron { depth } => {
                let set = surfaces.set(|surface, depth| surface.shape = Shape::Tetrahedron { depth });
                fields.whole(ui, "Depth", 0..=MOST_TETRAHEDRON_DEPTH, *depth, set);
            }
            _ => {}
        }
    }
    let lengths: [(&str, Length); 4] = [("Radius", radius), ("Height", height), ("Width", width), ("Depth", depth)];
    for (label, length) in lengths {
        if let Some(values) = surfaces.of_all(|surface| length(&mut surface.shape.clone()).map(|value| *value)) {
            let set = surfaces.set_each(move |surface, value| {
                if let Some(length) = length(&mut surface.shape) {
                    *length = value;
                }
            });
            fields.numbers(ui, label, &Number::LENGTH, &values, set);
        }
    }
    let size = |surface: &Surface| if let Shape::Box { size } = surface.shape { Some(size) } else { None };
    if let Some(sizes) = surfaces.of_all(size) {
        let set = surfaces.set_each(|surface, size| surface.shape = Shape::Box { size });
        fields.vectors(ui, "Size", &Number::LENGTH, &sizes, set);
    }
}

/// A mesh's file and size, and another in its place.
fn mesh_row(ui: &mut Ui, fields: &mut Fields<'_>, surface: &str, mesh: &Mesh) {
    row_label(ui, "Mesh");
    ui.vertical(|ui| {
        ui.monospace(&mesh.file);
        let look = if mesh.triangles.iter().any(|triangle| triangle.normals.is_some()) { "smooth" } else { "flat" };
        ui.weak(format!("{} triangles, {look}", mesh.triangles.len()));
        let button = egui::Button::new("Replace…").min_size(egui::vec2(70.0, 20.0));
        let response = ui.add(button).on_hover_text("Choose another OBJ file");
        if response.accessible_name("Replace mesh").clicked() {
            fields.commands.push(Command::ReplaceMesh(surface.to_owned()));
        }
    });
    ui.end_row();
}

/// The control points of a patch, each called by its row and its place in it.
fn control_point_rows(
    ui: &mut Ui,
    fields: &mut Fields<'_>,
    surfaces: &Together<Surface>,
    control_points: &[DVec3; 16],
) {
    for (i, p) in control_points.iter().enumerate() {
        let label = format!("Point {} {}", i / 4 + 1, i % 4 + 1);
        let set = surfaces.set(move |surface, p| {
            if let Shape::Patch { control_points } = &mut surface.shape {
                control_points[i] = p;
            }
        });
        fields.vector(ui, &label, &Number::PLACE, *p, set);
    }
}

/// A length of a shape; none where the shape has it not.
type Length = fn(&mut Shape) -> Option<&mut f64>;

fn radius(shape: &mut Shape) -> Option<&mut f64> {
    match shape {
        Shape::Sphere { radius }
        | Shape::Disk { radius }
        | Shape::Cylinder { radius, .. }
        | Shape::Cone { radius, .. } => Some(radius),
        _ => None,
    }
}

fn height(shape: &mut Shape) -> Option<&mut f64> {
    if let Shape::Cylinder { height, .. } | Shape::Cone { height, .. } = shape { Some(height) } else { None }
}

fn width(shape: &mut Shape) -> Option<&mut f64> {
    if let Shape::Square { size } = shape { Some(&mut size.x) } else { None }
}

fn depth(shape: &mut Shape) -> Option<&mut f64> {
    if let Shape::Square { size } = shape { Some(&mut size.y) } else { None }
}
