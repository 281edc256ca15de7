//! A surface's numbers.

use egui::Ui;
use glam::DVec3;

use super::fields::{Fields, Number, row_label};
use super::material;
use crate::editor::commands::Command;
use crate::scene::Scene;
use crate::surface::{MOST_FLAKE_DEPTH, MOST_TETRAHEDRON_DEPTH, Mesh, Shape, Surface};

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(surface) = fields.scene().surfaces.get(index).cloned() else { return };
    fields.section(ui, "Surface", |ui, fields| {
        let materials = material_names(fields.scene());
        let choices: Vec<_> = materials.into_iter().map(|name| (name.clone(), name)).collect();
        let set = at(index, |surface, name| surface.material = name);
        fields.choice(ui, "Material", &surface.material, &choices, set);
        shape(ui, fields, index, &surface);
    });
    fields.section(ui, "Placement", |ui, fields| {
        fields.vector(ui, "Position", &Number::PLACE, surface.position, at(index, |s, p| s.position = p));
        fields.vector(ui, "Rotation", &Number::ANGLE, surface.rotation_deg, at(index, |s, r| s.rotation_deg = r));
        let scale = Number { speed: 0.005, range: 1e-3..=1e3, ..Number::FACTOR };
        fields.vector(ui, "Scale", &scale, surface.scale, at(index, |s, scale| s.scale = scale));
    });
    if let Some(position) = fields.scene().materials.iter().position(|m| m.name == surface.material) {
        material::show(ui, fields, position);
    }
}

pub(super) fn material_names(scene: &Scene) -> Vec<String> {
    scene.materials.iter().map(|material| material.name.clone()).collect()
}

fn at<T>(index: usize, set: impl Fn(&mut Surface, T)) -> impl Fn(&mut Scene, T) {
    move |scene, value| {
        if let Some(surface) = scene.surfaces.get_mut(index) {
            set(surface, value);
        }
    }
}

fn shape(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, surface: &Surface) {
    let mut length = |ui: &mut Ui, label: &str, value: f64, remake: fn(&Shape, f64) -> Shape| {
        fields.number(ui, label, &Number::LENGTH, value, at(index, move |s, v| s.shape = remake(&s.shape, v)));
    };
    match surface.shape {
        Shape::Mesh(ref mesh) => mesh_row(ui, fields, &surface.name, mesh),
        Shape::Patch { ref control_points } => control_point_rows(ui, fields, index, control_points),
        Shape::Plane {} => fields.derived(ui, "Extent", "infinite"),
        Shape::Sphereflake { depth } => {
            let set = at(index, |surface: &mut Surface, depth| surface.shape = Shape::Sphereflake { depth });
            fields.whole(ui, "Depth", 0..=MOST_FLAKE_DEPTH, depth, set);
        }
        Shape::Tetrahedron { depth } => {
            let set = at(index, |surface: &mut Surface, depth| surface.shape = Shape::Tetrahedron { depth });
            fields.whole(ui, "Depth", 0..=MOST_TETRAHEDRON_DEPTH, depth, set);
        }
        Shape::Sphere { radius } => length(ui, "Radius", radius, with_radius),
        Shape::Disk { radius } => length(ui, "Radius", radius, with_radius),
        Shape::Cylinder { radius, height } | Shape::Cone { radius, height } => {
            length(ui, "Radius", radius, with_radius);
            length(ui, "Height", height, with_height);
        }
        Shape::Box { size } => {
            let set = at(index, |surface: &mut Surface, size| surface.shape = Shape::Box { size });
            fields.vector(ui, "Size", &Number::LENGTH, size, set);
        }
        Shape::Square { size } => {
            length(ui, "Width", size.x, |shape, x| resized(shape, |size| size.x = x));
            length(ui, "Depth", size.y, |shape, y| resized(shape, |size| size.y = y));
        }
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
fn control_point_rows(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, control_points: &[DVec3; 16]) {
    for (i, p) in control_points.iter().enumerate() {
        let label = format!("Point {} {}", i / 4 + 1, i % 4 + 1);
        let set = at(index, move |surface: &mut Surface, p| {
            if let Shape::Patch { control_points } = &mut surface.shape {
                control_points[i] = p;
            }
        });
        fields.vector(ui, &label, &Number::PLACE, *p, set);
    }
}

fn with_radius(shape: &Shape, radius: f64) -> Shape {
    match *shape {
        Shape::Sphere { .. } => Shape::Sphere { radius },
        Shape::Disk { .. } => Shape::Disk { radius },
        Shape::Cylinder { height, .. } => Shape::Cylinder { radius, height },
        Shape::Cone { height, .. } => Shape::Cone { radius, height },
        _ => shape.clone(),
    }
}

fn with_height(shape: &Shape, height: f64) -> Shape {
    match *shape {
        Shape::Cylinder { radius, .. } => Shape::Cylinder { radius, height },
        Shape::Cone { radius, .. } => Shape::Cone { radius, height },
        _ => shape.clone(),
    }
}

fn resized(shape: &Shape, change: impl FnOnce(&mut glam::DVec2)) -> Shape {
    let mut shape = shape.clone();
    if let Shape::Square { size } = &mut shape {
        change(size);
    }
    shape
}
