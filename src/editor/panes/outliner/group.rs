//! A group's row in the list of lights.

use egui::{Button, Rect, RichText, Sense, Ui, vec2};
use egui_material_icons::icons;

use super::light::buttons_of;
use super::{Ask, Drag, Named, Outliner, ROW, how};
use crate::editor::commands::{Command, ListCommand};
use crate::editor::panes::icon_button;
use crate::editor::session::{Item, Session};

impl Outliner {
    /// The row of a group, and where it is.
    pub(super) fn group_row(
        &mut self,
        ui: &mut Ui,
        session: &mut Session,
        name: &str,
        members: &[usize],
        asked: &mut Vec<Ask>,
    ) -> Rect {
        let scene = session.scene().clone();
        let muted = members.iter().filter_map(|i| scene.lights.get(*i)).all(|light| light.muted);
        let row = ui.push_id(("group", name), |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                let is_closed = session.closed_groups.contains(name);
                let (icon, verb) =
                    if is_closed { (icons::ICON_CHEVRON_RIGHT, "Open") } else { (icons::ICON_EXPAND_MORE, "Close") };
                let color = ui.visuals().weak_text_color();
                if icon_button(ui, icon, color, &format!("{verb} group {name}")).clicked() {
                    asked.push(Ask::ToggleGroup(name.to_owned()));
                }
                if self.name_field(ui, &Named::Group(name.to_owned()), asked) {
                    return;
                }
                let width = ui.available_width() - 46.0;
                title(ui, session, name, members, width, asked);
                buttons_of(ui, session, name, members, muted, asked);
            })
        });
        row.inner.response.rect
    }
}

/// The name: click selects all lights of the group, a double click renames, a drag moves them.
fn title(ui: &mut Ui, session: &mut Session, name: &str, members: &[usize], width: f32, asked: &mut Vec<Ask>) {
    let items: Vec<_> = members.iter().copied().map(Item::Light).collect();
    let selected = items.iter().all(|item| session.selection.contains(*item));
    let count = RichText::new(format!("{}", members.len())).weak().small();
    let label = Button::selectable(selected, RichText::new(name).strong()).truncate().right_text(count);
    let label = label.min_size(vec2(width, ROW)).sense(Sense::click_and_drag());
    let response = ui.add_sized(vec2(width, ROW), label).on_hover_text(format!("{} lights", members.len()));
    let response = response.accessible_name(name);
    if response.double_clicked() {
        asked.push(Ask::StartRenaming(Named::Group(name.to_owned())));
    } else if response.clicked() {
        asked.push(Ask::Select(items.clone(), how(ui)));
    }
    if response.drag_started() {
        asked.push(Ask::Drag(Drag { lights: members.to_vec(), group: Some(name.to_owned()) }));
    }
    if response.hovered() {
        "Click selects the group’s lights, a double click renames; drag moves".clone_into(&mut session.hint);
    }
    response.context_menu(|ui| {
        if ui.button("Rename").clicked() {
            asked.push(Ask::StartRenaming(Named::Group(name.to_owned())));
        }
        for command in [Command::List(ListCommand::Ungroup), Command::Duplicate, Command::Delete, Command::Focus] {
            if ui.button(command.label(session)).clicked() {
                asked.push(Ask::Select(items.clone(), super::How::Only));
                asked.push(Ask::Command(command));
            }
        }
    });
}
