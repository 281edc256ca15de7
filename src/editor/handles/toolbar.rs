//! Along which axes and about which point handles act, in the toolbar.

use egui::{Button, Ui, vec2};
use egui_material_icons::icons;

use super::frame::{Axes, Pivot};
use crate::editor::commands::Command;
use crate::editor::session::Session;

/// Height of the toolbar's buttons, points.
const HEIGHT: f32 = 26.0;

/// Show both; the command that was chosen.
pub fn show(ui: &mut Ui, session: &Session, chosen: &mut Option<Command>) {
    let axes = session.transform.axes;
    let (icon, name) = match axes {
        Axes::World => (icons::ICON_PUBLIC, "World"),
        Axes::Local => (icons::ICON_DEPLOYED_CODE, "Local"),
    };
    let text = format!("{} {name}", icon.codepoint);
    let hover = "Handles move and turn along the world's axes, or the selection's own  (X)";
    let button = ui.add(Button::new(text).min_size(vec2(68.0, HEIGHT))).on_hover_text(hover);
    if button.accessible_name(axes.label()).clicked() {
        *chosen = Some(Command::ToggleAxes);
    }
    let pivot = session.transform.pivot;
    let name = match pivot {
        Pivot::Primary => "Last",
        Pivot::Center => "Middle",
        Pivot::Own => "Own",
    };
    let text = format!("{} {name}", icons::ICON_ADJUST.codepoint);
    let button = Button::new(text).min_size(vec2(72.0, HEIGHT));
    let (response, _) = egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
        for choice in Pivot::ALL {
            let entry = ui.add(Button::selectable(choice == pivot, choice.label()));
            if entry.clicked() {
                *chosen = Some(Command::Pivot(choice));
            }
        }
    });
    response.accessible_name("Pivot").on_hover_text("About what several things are turned and scaled  (.)");
}
