//! A polygon's corners in its own plane: numbers, and buttons to add and take away.

use egui::{Ui, vec2};

use super::fields::{Fields, Number, drag_all, row_label};
use crate::light::{Light, Polygon, Shape};
use crate::scene::Scene;

/// The corners of the polygon at `index`.
pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize, polygon: &Polygon) {
    fields.section(ui, "Vertices (m)", |ui, fields| {
        for (i, vertex) in polygon.vertices.iter().enumerate() {
            row_label(ui, &format!("{}", i + 1));
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 3.0;
                let mut edited = *vertex;
                for (axis, name) in ["X", "Y"].into_iter().enumerate() {
                    let name = format!("Vertex {} {name}", i + 1);
                    let style = Number { unit: "", ..Number::PLACE };
                    let (response, moved) = drag_all(ui, &style, &[vertex[axis]], 62.0);
                    let response = response.accessible_name(name);
                    edited[axis] = moved.first().copied().unwrap_or(edited[axis]);
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
