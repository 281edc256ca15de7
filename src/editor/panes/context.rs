//! What a right click in the view offers: for the thing that is there, or for the empty space.

use egui::{Response, Ui};

use super::menu::entries;
use crate::editor::commands::{Command, LightKind, SurfaceKind};
use crate::editor::session::{Item, Session};
use crate::light::Shape;

/// Offer what can be done with what is under the pointer. What is chosen goes to [`Session::asked`].
pub(in crate::editor) fn view_menu(response: &Response, session: &mut Session, under: Option<Item>) {
    if response.secondary_clicked() {
        // What is clicked is what the menu is for; several selected things stay selected together.
        match under {
            Some(item) if session.selection.contains(item) => {}
            Some(item) => session.selection.set([item]),
            None => session.selection.clear(),
        }
    }
    let mut chosen = None;
    response.context_menu(|ui| match session.selection.primary() {
        Some(item) => item_menu(ui, session, item, &mut chosen),
        None => empty_menu(ui, session, &mut chosen),
    });
    session.asked.extend(chosen);
}

fn item_menu(ui: &mut Ui, session: &Session, item: Item, chosen: &mut Option<Command>) {
    ui.weak(item.name(session.scene()).unwrap_or_default());
    entries(ui, session, &[Command::Focus, Command::Duplicate, Command::Delete], chosen);
    if let Item::Light(index) = item {
        ui.separator();
        entries(ui, session, &[Command::ToggleMute, Command::ToggleSolo], chosen);
        entries(ui, session, &[Command::SavePreset, Command::ExportLights], chosen);
        let light = session.scene().lights.get(index);
        if let Some(light) = light.filter(|light| matches!(light.shape, Shape::Textured(_))) {
            let replace = Command::ReplacePattern(light.name.clone());
            entries(ui, session, &[Command::EditPattern], chosen);
            if ui.button("Replace pattern…").clicked() {
                *chosen = Some(replace);
            }
        }
    }
    ui.separator();
    entries(ui, session, &[Command::Palette], chosen);
}

fn empty_menu(ui: &mut Ui, session: &Session, chosen: &mut Option<Command>) {
    ui.menu_button("Add light", |ui| entries(ui, session, &LightKind::ALL.map(Command::AddLight), chosen));
    ui.menu_button("Add surface", |ui| entries(ui, session, &SurfaceKind::ALL.map(Command::AddSurface), chosen));
    entries(ui, session, &[Command::Library], chosen);
    ui.separator();
    entries(ui, session, &[Command::SelectAll, Command::FrameAll, Command::ResetView, Command::SaveView], chosen);
    ui.separator();
    let toggles = [Command::ToggleEmitters, Command::ToggleShadows, Command::ToggleGrid, Command::ToggleSnap];
    entries(ui, session, &toggles, chosen);
    ui.separator();
    entries(ui, session, &[Command::Palette], chosen);
}
