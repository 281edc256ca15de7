//! The viewport's own controls: method, exposure, and what is painted over the picture.

use egui::{Frame, Margin, Rect, Ui, UiBuilder, vec2};

use super::Overlays;
use crate::editor::commands::view_methods;
use crate::editor::session::Session;

/// Exposures that the slider offers, in steps of a factor of two.
const EXPOSURE: std::ops::RangeInclusive<f64> = -8.0..=8.0;

/// Room for every method of a scene with every shape, points.
const ALL_METHODS: f32 = 400.0;

/// Show the controls in the upper left corner of `rect`.
pub fn show(ui: &mut Ui, rect: Rect, session: &mut Session, overlays: &mut Overlays) {
    let corner = Rect::from_min_max(rect.min + vec2(8.0, 8.0), rect.max);
    ui.scope_builder(UiBuilder::new().max_rect(corner), |ui| {
        let fill = ui.visuals().panel_fill.gamma_multiply(0.85);
        let frame = Frame::NONE.fill(fill).corner_radius(4.0).inner_margin(Margin::symmetric(8, 4));
        frame.show(ui, |ui| {
            ui.horizontal(|ui| {
                method(ui, session);
                ui.add_space(8.0);
                exposure(ui, session);
                ui.add_space(8.0);
                toggles(ui, session, overlays);
            });
        });
    });
}

fn method(ui: &mut Ui, session: &mut Session) {
    let label = ui.label("Method");
    let methods = view_methods(session.scene());
    let combo = egui::ComboBox::from_id_salt("viewport method")
        .selected_text(session.view.method.to_string())
        .height(ALL_METHODS);
    let response = combo.show_ui(ui, |ui| {
        for method in methods {
            ui.selectable_value(&mut session.view.method, method, method.to_string());
        }
    });
    response.response.labelled_by(label.id).on_hover_text("How lights are shaded in this viewport");
}

fn exposure(ui: &mut Ui, session: &mut Session) {
    let label = ui.label("Exposure");
    let mut exposure_ev = session.scene().display.exposure_ev;
    let number = egui::DragValue::new(&mut exposure_ev).range(EXPOSURE).speed(0.02).suffix(" EV").fixed_decimals(1);
    let response = ui.add(number).labelled_by(label.id).on_hover_text("At 0, 100 cd/m² is white; drag to change");
    if response.drag_started() {
        session.begin("Change exposure");
    }
    if response.changed() {
        session.edit("Change exposure", |scene| scene.display.exposure_ev = exposure_ev);
    }
    if response.drag_stopped() {
        session.commit();
    }
}

fn toggles(ui: &mut Ui, session: &mut Session, overlays: &mut Overlays) {
    let (response, _) = egui::containers::menu::MenuButton::new("Show")
        .config(egui::containers::menu::MenuConfig::new().close_behavior(egui::PopupCloseBehavior::CloseOnClickOutside))
        .ui(ui, |ui| {
            ui.checkbox(&mut session.view.show_emitters, "Emitters");
            ui.checkbox(&mut session.view.show_shadows, "Shadows");
            ui.checkbox(&mut session.view.refines, "Refinement").on_hover_text("Smooth a picture that stands still");
            ui.checkbox(&mut session.view.show_grid, "Ground grid");
            ui.checkbox(&mut overlays.outlines, "Outlines and names");
            ui.checkbox(&mut overlays.probe, "Probe");
            ui.checkbox(&mut overlays.handles, "Handles");
            ui.checkbox(&mut overlays.gnomon, "Axes");
        });
    response.on_hover_text("What is drawn over the picture");
}
