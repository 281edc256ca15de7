//! The scene's own numbers, shown when nothing is selected.

use egui::Ui;

use super::fields::{Fields, Number, row_label};

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>) {
    let scene = fields.session.scene().clone();
    ui.heading("Scene");
    fields.section(ui, "Document", |ui, fields| {
        row_label(ui, "Name");
        let mut name = scene.name.clone();
        let edit = egui::TextEdit::singleline(&mut name).hint_text("untitled").desired_width(150.0);
        let response = ui.add(edit).accessible_name("Scene name");
        fields.apply(&response, "Rename scene", |scene| scene.name = name);
        ui.end_row();
        let counts = [
            ("Lights", scene.lights.len()),
            ("Surfaces", scene.surfaces.len()),
            ("Materials", scene.materials.len()),
            ("Plots", scene.plots.len()),
        ];
        for (label, count) in counts {
            fields.derived(ui, label, &count.to_string());
        }
    });
    fields.section(ui, "Display", |ui, fields| {
        let style = Number { unit: " EV", speed: 0.02, range: -20.0..=20.0, hint: "0 makes 100 cd/m² white" };
        let set = |scene: &mut crate::scene::Scene, ev| scene.display.exposure_ev = ev;
        fields.number(ui, "Exposure", &style, scene.display.exposure_ev, set);
        fields.derived(ui, "White", &format!("{:.4} cd/m²", 100.0 * (-scene.display.exposure_ev).exp2()));
    });
    fields.section(ui, "Scene camera", |ui, fields| {
        fields.vector(ui, "Eye", &Number::PLACE, scene.camera.eye, |scene, eye| scene.camera.eye = eye);
        fields.vector(ui, "Target", &Number::PLACE, scene.camera.target, |scene, target| scene.camera.target = target);
        let fov = Number { speed: 0.2, range: 1.0..=170.0, hint: "From the lower to the upper edge", ..Number::ANGLE };
        fields.number(ui, "Field of view", &fov, scene.camera.fov_deg, |scene, fov| scene.camera.fov_deg = fov);
    });
    ui.add_space(4.0);
    ui.horizontal(|ui| {
        if ui.button("View through it").clicked() {
            fields.session.reset_view();
        }
        if ui.button("Set from view").clicked() {
            fields.session.save_view();
        }
    });
}
