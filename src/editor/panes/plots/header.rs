//! The plots as tabs, what to add, and the choices of the one in front; the rest is in the inspector.

use std::sync::Arc;

use egui::containers::menu::{MenuButton, MenuConfig};
use egui::{Button, Layout, PopupCloseBehavior, Ui};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;

use super::sheet;
use crate::analysis::{Curves, turns};
use crate::editor::commands::Command;
use crate::editor::edits;
use crate::editor::panes::icon_button;
use crate::editor::session::{Item, Session};
use crate::export::plot::PlotFormat;
use crate::scene::{Plot, PlotKind, PlotQuantity};

/// Show the header; `fine` are the curves of the plot in front, once they are there. Whether the exact one shall be pinned.
pub(super) fn header(ui: &mut Ui, session: &mut Session, fine: Option<&Curves>, commands: &mut Vec<Command>) -> bool {
    let mut pinned = false;
    let scene = Arc::clone(session.scene());
    let height = ui.spacing().interact_size.y;
    ui.allocate_ui_with_layout(
        egui::vec2(ui.available_width(), height),
        Layout::right_to_left(egui::Align::Center),
        |ui| {
            if let Some(plot) = scene.plots.get(session.plots.active) {
                exports(ui, session, plot, fine, commands);
                pinned = pin_button(ui);
                choices(ui, session, plot);
            }
            ui.with_layout(Layout::left_to_right(egui::Align::Center), |ui| {
                egui::ScrollArea::horizontal().id_salt("plot tabs").show(ui, |ui| tabs(ui, session, commands));
            });
        },
    );
    pinned
}

fn tabs(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    let scene = Arc::clone(session.scene());
    for (index, plot) in scene.plots.iter().enumerate() {
        let active = session.plots.active == index;
        if ui.selectable_label(active, &plot.name).on_hover_text("Show this plot and select its probe").clicked() {
            session.plots.active = index;
            session.selection.set([Item::Plot(index)]);
        }
    }
    menu(ui, icons::ICON_ADD, "New plot", |ui| {
        for kind in [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance] {
            if ui.button(edits::kind_name(kind)).clicked() {
                commands.push(Command::AddPlot(kind));
                ui.close();
            }
        }
    });
}

/// A button that is only an icon and opens a menu, which stays open while something is chosen in it.
fn menu(ui: &mut Ui, icon: MaterialIcon, name: &str, contents: impl FnOnce(&mut Ui)) {
    let button = Button::new(icon.rich_text()).frame(false);
    let config = MenuConfig::new().close_behavior(PopupCloseBehavior::CloseOnClickOutside);
    let (response, _) = MenuButton::from_button(button).config(config).ui(ui, contents);
    response.on_hover_text(name).accessible_name(name);
}

fn exports(ui: &mut Ui, session: &Session, plot: &Plot, fine: Option<&Curves>, commands: &mut Vec<Command>) {
    menu(ui, icons::ICON_FILE_SAVE, "Export plot", |ui| {
        for format in PlotFormat::ALL {
            let name = format.extension().to_uppercase();
            let button = ui.add_enabled(fine.is_some(), Button::new(format!("{name}…"))).on_hover_text(hint(format));
            if let Some(fine) = fine.filter(|_| button.clicked()) {
                commands.push(Command::ExportPlot(format, Box::new(sheet(plot, fine, &session.plots))));
                ui.close();
            }
        }
    });
}

/// What a format is good for.
fn hint(format: PlotFormat) -> &'static str {
    match format {
        PlotFormat::Csv => "Numbers with all their digits, a row a point of a curve",
        PlotFormat::Svg => "A picture of lines that can be scaled, with the legend",
        PlotFormat::Png => "A picture of 2000 pixels’ width, with the legend",
    }
}

/// Whether the exact curve shall be pinned.
fn pin_button(ui: &mut Ui) -> bool {
    let color = ui.visuals().text_color();
    let response = icon_button(ui, icons::ICON_PUSH_PIN, color, "Pin");
    response.on_hover_text("Keep the exact curve as it is now, to compare later states with it").clicked()
}

fn choices(ui: &mut Ui, session: &mut Session, plot: &Plot) {
    let index = session.plots.active;
    let mut changed = plot.clone();
    let mut look = session.plots.look(plot);
    menu(ui, icons::ICON_TUNE, "Axes", |ui| {
        ui.checkbox(&mut changed.normalise, "Normalise").on_hover_text("Divide by the greatest exact value");
        ui.checkbox(&mut look.relative_error, "Errors in %").on_hover_text("Of the exact value at the same place");
        ui.checkbox(&mut look.logarithmic_error, "Logarithmic errors").on_hover_text("The magnitude of errors");
    });
    let toggle = |ui: &mut Ui, on: &mut bool, enabled: bool, text: &str, hint: &str| {
        let button = Button::selectable(*on && enabled, text);
        let response = ui.add_enabled(enabled, button).on_hover_text(hint);
        if response.on_disabled_hover_text("This plot’s abscissa is no angle").clicked() {
            *on = !*on;
        }
    };
    toggle(ui, &mut look.logarithmic, true, "log", "Values, or distances from the pole, on a logarithmic axis");
    toggle(ui, &mut look.polar, turns(plot.kind), "polar", "Angles as angles, values as distances from a pole");
    let quantity = |quantity| match quantity {
        PlotQuantity::Irradiance => "irradiance",
        PlotQuantity::Specular => "specular",
        PlotQuantity::Radiance => "radiance",
    };
    let combo = egui::ComboBox::from_id_salt("plot quantity").selected_text(quantity(changed.quantity)).width(84.0);
    let response = combo.show_ui(ui, |ui| {
        for choice in [PlotQuantity::Irradiance, PlotQuantity::Specular, PlotQuantity::Radiance] {
            ui.selectable_value(&mut changed.quantity, choice, quantity(choice));
        }
    });
    response.response.on_hover_text("What is plotted").accessible_name("Plotted quantity");
    if look != session.plots.look(plot) {
        session.plots.set_look(plot, look);
    }
    if changed != *plot {
        session.edit("Change plot", |scene| scene.plots[index] = changed);
    }
}
