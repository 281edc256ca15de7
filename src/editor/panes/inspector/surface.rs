//! A surface's numbers.

use egui::Ui;

use super::fields::{Fields, Number};
use super::material;
use crate::scene::Scene;
use crate::surface::{Shape, Surface};

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(surface) = fields.scene().surfaces.get(index).cloned() else { return };
    fields.section(ui, "Surface", |ui, fields| {
        let materials = material_names(fields.scene());
        let choices: Vec<_> = materials.into_iter().map(|name| (name.clone(), name)).collect();
        let set = at(index, |surface, name| surface.material = name);
        fields.choice(ui, "Material", &surface.material, &choices, set);
        shape(ui, fields, index, &surface.shape);
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

fn shape(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, shape: &Shape) {
    let mut length = |ui: &mut Ui, label: &str, value: f64, remake: fn(&Shape, f64) -> Shape| {
        fields.number(ui, label, &Number::LENGTH, value, at(index, move |s, v| s.shape = remake(&s.shape, v)));
    };
    match *shape {
        Shape::Plane {} => fields.derived(ui, "Extent", "infinite"),
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

fn with_radius(shape: &Shape, radius: f64) -> Shape {
    match *shape {
        Shape::Sphere { .. } => Shape::Sphere { radius },
        Shape::Disk { .. } => Shape::Disk { radius },
        Shape::Cylinder { height, .. } => Shape::Cylinder { radius, height },
        Shape::Cone { height, .. } => Shape::Cone { radius, height },
        Shape::Plane {} | Shape::Box { .. } | Shape::Square { .. } => shape.clone(),
    }
}

fn with_height(shape: &Shape, height: f64) -> Shape {
    match *shape {
        Shape::Cylinder { radius, .. } => Shape::Cylinder { radius, height },
        Shape::Cone { radius, .. } => Shape::Cone { radius, height },
        Shape::Plane {} | Shape::Sphere { .. } | Shape::Box { .. } | Shape::Square { .. } | Shape::Disk { .. } => {
            shape.clone()
        }
    }
}

fn resized(shape: &Shape, change: impl FnOnce(&mut glam::DVec2)) -> Shape {
    let mut shape = shape.clone();
    if let Shape::Square { size } = &mut shape {
        change(size);
    }
    shape
}
