//! A viewport's own controls: what it shows, by which methods, exposure, and what is painted over the picture.

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{ComboBox, Frame, Margin, PopupCloseBehavior, Rect, Ui, UiBuilder, vec2};
use egui_material_icons::icons;

use super::Overlays;
use super::scales::{self, WHITE, short};
use super::screen::EXPOSURE;
use crate::editor::commands::{Command, view_methods};
use crate::editor::panes::icon_button;
use crate::editor::session::{Session, ViewMode};
use crate::gpu::Display;
use crate::shading::Method;

/// Room for every method of a scene with every shape, points.
const ALL_METHODS: f32 = 400.0;
/// From these widths on the bar has the second method, and the exposure; below, the menu has them.
const WIDE: [f32; 2] = [420.0, 600.0];
/// Width of a box to choose from, points.
const BOX: f32 = 84.0;

/// Show the controls in the upper left corner of `rect`; `name` tells this viewport from the others. What they cover.
pub fn show(
    ui: &mut Ui,
    rect: Rect,
    session: &mut Session,
    overlays: &mut Overlays,
    display: &Display,
    name: &str,
) -> Rect {
    let corner = Rect::from_min_max(rect.min + vec2(8.0, 8.0), rect.max);
    let compares = session.view.mode.compares();
    let has_second = rect.width() >= WIDE[0];
    let has_exposure = rect.width() - if compares { BOX } else { 0.0 } >= WIDE[1];
    let shown = ui.scope_builder(UiBuilder::new().max_rect(corner), |ui| {
        let fill = ui.visuals().panel_fill.gamma_multiply(0.85);
        let frame = Frame::NONE.fill(fill).corner_radius(4.0).inner_margin(Margin::symmetric(6, 3));
        let shown = frame.show(ui, |ui| {
            ui.horizontal(|ui| {
                mode(ui, session, name);
                method(ui, session, name);
                if compares && has_second {
                    ui.label(if session.view.mode == ViewMode::Difference { "−" } else { "|" });
                    against(ui, session, name);
                }
                if has_exposure {
                    exposure(ui, session, name);
                }
                let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
                let (response, _) = MenuButton::new("Show").config(config).ui(ui, |ui| {
                    if compares && !has_second {
                        ui.horizontal(|ui| {
                            ui.label("Compared with");
                            against(ui, session, name);
                        });
                    }
                    if !has_exposure {
                        ui.horizontal(|ui| exposure(ui, session, name));
                    }
                    menu(ui, session, overlays, display);
                });
                response.on_hover_text("What is drawn over the picture");
            });
        });
        shown.response.rect
    });
    shown.inner
}

fn mode(ui: &mut Ui, session: &mut Session, name: &str) {
    let mut mode = session.view.mode;
    let combo = ComboBox::from_id_salt("mode").selected_text(mode.label()).width(BOX).height(ALL_METHODS);
    let response = combo.show_ui(ui, |ui| {
        for choice in ViewMode::ALL {
            ui.selectable_value(&mut mode, choice, choice.label()).on_hover_text(choice.hint());
        }
    });
    response.response.on_hover_text(mode.hint()).accessible_name(format!("View shows{name}"));
    if mode != session.view.mode {
        session.view.set_mode(mode);
    }
}

fn method(ui: &mut Ui, session: &mut Session, name: &str) {
    let methods = view_methods(session.scene());
    methods_box(ui, "method", &methods, &mut session.view.method)
        .on_hover_text("How lights are shaded in this viewport")
        .accessible_name(format!("Method{name}"));
}

fn against(ui: &mut Ui, session: &mut Session, name: &str) {
    if let Some(variant) = session.view.against_variant.and_then(|index| session.scene().variants.get(index)) {
        let text = format!("{} ×", variant.name);
        let button = ui.add(egui::Button::new(text).truncate().min_size(vec2(BOX, 0.0)));
        let button = button.on_hover_text("The variant that the lights are compared with; click to compare methods");
        if button.accessible_name(format!("Compared with{name}")).clicked() {
            session.view.against_variant = None;
            session.view.set_mode(session.view.mode);
        }
        return;
    }
    let methods = view_methods(session.scene());
    methods_box(ui, "against", &methods, &mut session.view.against)
        .on_hover_text("The method that it is compared with")
        .accessible_name(format!("Compared with{name}"));
}

fn methods_box(ui: &mut Ui, id: &str, methods: &[Method], chosen: &mut Method) -> egui::Response {
    let combo = ComboBox::from_id_salt(id).selected_text(chosen.to_string()).width(BOX).truncate().height(ALL_METHODS);
    let response = combo.show_ui(ui, |ui| {
        for method in methods {
            ui.selectable_value(chosen, *method, method.to_string());
        }
    });
    response.response
}

/// A slider, and a button that sets it by what is seen.
fn exposure(ui: &mut Ui, session: &mut Session, name: &str) {
    let mut exposure_ev = session.scene().display.exposure_ev;
    let white = format!("Exposure: white is {} cd/m²", short(WHITE / exposure_ev.exp2()));
    ui.spacing_mut().slider_width = 80.0;
    let slider = egui::Slider::new(&mut exposure_ev, EXPOSURE).suffix(" EV").fixed_decimals(1).step_by(0.1);
    let response = ui.add(slider).on_hover_text(white).accessible_name(format!("Exposure{name}"));
    if response.drag_started() {
        session.begin("Change exposure");
    }
    if response.changed() {
        session.edit("Change exposure", |scene| scene.display.exposure_ev = exposure_ev);
    }
    if response.drag_stopped() {
        session.commit();
    }
    let color = ui.visuals().text_color();
    if icon_button(ui, icons::ICON_BRIGHTNESS_AUTO, color, &format!("Auto exposure{name}")).clicked() {
        session.wants_exposure = true;
    }
}

/// What the numbers mean, and what is drawn over the picture.
fn menu(ui: &mut Ui, session: &mut Session, overlays: &mut Overlays, display: &Display) {
    if !matches!(display, Display::Picture | Display::Split { .. }) {
        scales::settings(ui, session, display);
        ui.separator();
    }
    ui.checkbox(&mut session.view.show_emitters, "Emitters");
    ui.checkbox(&mut session.view.show_shadows, "Shadows");
    ui.checkbox(&mut session.view.refines, "Refinement").on_hover_text("Smooth a picture that stands still");
    ui.checkbox(&mut session.view.show_grid, "Ground grid");
    ui.checkbox(&mut overlays.outlines, "Outlines and names");
    ui.checkbox(&mut overlays.probe, "Probe");
    ui.checkbox(&mut overlays.handles, "Handles");
    ui.checkbox(&mut overlays.gnomon, "Axes");
    let measure = ui.checkbox(&mut session.measure.shown, "Measuring rectangle");
    if let Some(hint) = Command::ToggleMeasure.hint() {
        measure.on_hover_text(hint);
    }
    if session.views.count() > 1 && ui.checkbox(&mut session.views.linked, "Link cameras").changed() {
        session.link_views();
    }
}
