//! The variants of the lights: store, switch, compare.

use egui::{Button, Rect, RichText, Sense, Ui, vec2};
use egui_material_icons::icons;

use super::gesture::RowDrag;
use super::icon_button;
use super::renaming::Renaming;
use crate::editor::commands::{Command, ListCommand};
use crate::editor::session::{Session, ViewMode};
use crate::editor::theme;

/// Height of a row, points.
const ROW: f32 = 22.0;
/// Width of the key before a name, points.
const KEY: f32 = 24.0;

/// The pane's own state.
#[derive(Debug, Default)]
pub struct Variants {
    /// The variant whose name is being typed.
    renaming: Option<Renaming<usize>>,
    /// The variant that is being dragged to another place.
    dragged: Option<usize>,
}

/// What a row asks for.
enum Ask {
    Switch(usize),
    StartRenaming(usize),
    Rename(usize, String),
    Update(usize),
    Delete(usize),
    Drag(usize),
    Move { index: usize, gap: usize },
    Look(Option<usize>),
    Compare(Option<usize>),
    CompareBy(ViewMode),
}

impl Variants {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let (mut asked, mut commands) = (Vec::new(), Vec::new());
        let scroll = egui::ScrollArea::vertical().auto_shrink(false);
        scroll.show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 6)).show(ui, |ui| {
                bar(ui, session, &mut asked, &mut commands);
                ui.add_space(4.0);
                ui.spacing_mut().item_spacing.y = 1.0;
                let count = session.scene().variants.len();
                let rows: Vec<Rect> = (0..count).map(|index| self.row(ui, session, index, &mut asked)).collect();
                self.drop(ui, &rows, &mut asked);
                looks(ui, session, &mut asked);
                comparison(ui, session, &mut asked);
            });
        });
        asked.into_iter().for_each(|ask| self.answer(ask, session));
        commands
    }

    /// The row of a variant, and where it is.
    fn row(&mut self, ui: &mut Ui, session: &mut Session, index: usize, asked: &mut Vec<Ask>) -> Rect {
        let scene = session.scene().clone();
        let Some(variant) = scene.variants.get(index) else { return Rect::NOTHING };
        let is_active = session.active_variant() == Some(index);
        let row = ui.push_id(("variant", index), |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 2.0;
                let key = Command::List(ListCommand::Variant(index)).shortcut();
                let key = key.map_or_else(String::new, |key| ui.ctx().format_shortcut(&key));
                ui.add_sized(vec2(KEY, ROW), egui::Label::new(RichText::new(key).weak().small()).selectable(false));
                if Renaming::show(&mut self.renaming, ui, &index, |index, name| asked.push(Ask::Rename(index, name))) {
                    return;
                }
                let changed = if is_active && scene.differs_from_variant() { "changed" } else { "" };
                let changed = RichText::new(changed).small().color(theme::accent(ui.visuals()));
                let label = Button::selectable(is_active, &variant.name).truncate().right_text(changed);
                let width = ui.available_width() - 66.0;
                let response = ui.add(label.min_size(vec2(width, ROW)).sense(Sense::click_and_drag()));
                let count = variant.lights.len();
                let lights = if count == 1 { "1 light".to_owned() } else { format!("{count} lights") };
                let response = response.on_hover_text(format!("Switch to its {lights}"));
                let response = response.accessible_name(format!("Switch to {}", variant.name));
                if response.double_clicked() {
                    asked.push(Ask::StartRenaming(index));
                } else if response.clicked() {
                    asked.push(Ask::Switch(index));
                } else if response.drag_started() {
                    asked.push(Ask::Drag(index));
                }
                if response.hovered() {
                    "Click switches the lights; a double click renames; a drag moves; the eye shows it in this view only"
                        .clone_into(&mut session.hint);
                }
                response.context_menu(|ui| menu(ui, index, scene.variants.len(), asked));
                self.buttons(ui, session, index, &variant.name, asked);
            });
        });
        row.response.rect
    }

    /// The line where the variant that is dragged would go; when it is let go, it does.
    fn drop(&mut self, ui: &Ui, rows: &[Rect], asked: &mut Vec<Ask>) {
        let Some(index) = self.dragged else { return };
        let (Some(first), Some(last)) = (rows.first(), rows.last()) else { return };
        let row_drag = RowDrag::of(ui);
        if let Some(y) = row_drag.y() {
            let gap = rows.iter().filter(|row| row.center().y < y).count();
            RowDrag::show_line(ui, first.left(), rows.get(gap).map_or(last.bottom(), Rect::top));
            if row_drag.is_let_go {
                asked.push(Ask::Move { index, gap });
            }
        }
        if row_drag.is_over() {
            self.dragged = None;
        }
    }

    fn buttons(&self, ui: &mut Ui, session: &Session, index: usize, name: &str, asked: &mut Vec<Ask>) {
        let is_shown = session.view.variant == Some(index);
        let color = if is_shown { theme::accent(ui.visuals()) } else { ui.visuals().weak_text_color() };
        let verb = if is_shown { "Show the scene’s lights in this view, not" } else { "Show in this view" };
        if icon_button(ui, icons::ICON_VISIBILITY, color, &format!("{verb} {name}")).clicked() {
            asked.push(Ask::Look((!is_shown).then_some(index)));
        }
        let is_compared = session.view.against_variant == Some(index);
        let color = if is_compared { theme::accent(ui.visuals()) } else { ui.visuals().weak_text_color() };
        let verb = if is_compared { "Stop comparing with" } else { "Compare with" };
        if icon_button(ui, icons::ICON_COMPARE, color, &format!("{verb} {name}")).clicked() {
            asked.push(Ask::Compare((!is_compared).then_some(index)));
        }
        let weak = ui.visuals().weak_text_color();
        if icon_button(ui, icons::ICON_SAVE, weak, &format!("Store the lights in {name}")).clicked() {
            asked.push(Ask::Update(index));
        }
    }

    fn answer(&mut self, ask: Ask, session: &mut Session) {
        match ask {
            Ask::Switch(index) => session.switch_variant(index),
            Ask::StartRenaming(index) => {
                let name = session.scene().variants.get(index).map(|variant| variant.name.clone());
                self.renaming = name.map(|name| Renaming::new(index, name));
            }
            Ask::Rename(index, name) => session.rename_variant(index, &name),
            Ask::Update(index) => session.update_variant(index),
            Ask::Delete(index) => session.delete_variant(index),
            Ask::Drag(index) => self.dragged = Some(index),
            Ask::Move { index, gap } => session.move_variant(index, gap),
            Ask::Look(variant) => session.view.variant = variant,
            Ask::Compare(variant) => {
                let compares = session.view.mode.compares();
                session.view.against_variant = variant;
                session.view.mode = match variant {
                    None => ViewMode::Picture,
                    Some(_) if compares => session.view.mode,
                    Some(_) => ViewMode::Split,
                };
            }
            Ask::CompareBy(mode) => session.view.mode = mode,
        }
    }
}

/// Buttons for all of them.
fn bar(ui: &mut Ui, session: &Session, asked: &mut Vec<Ask>, commands: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        let store = Button::new((icons::ICON_ADD.rich_text(), "Store"));
        let response = ui.add(store).on_hover_text("Store the lights as they are as a new variant");
        if response.accessible_name("Store lights as a variant").clicked() {
            commands.push(Command::List(ListCommand::StoreVariant));
        }
        let differs = session.active_variant().filter(|_| session.scene().differs_from_variant());
        let revert = ui.add_enabled(differs.is_some(), Button::new("Revert"));
        let revert =
            revert.on_hover_text("Back to the lights that are stored").accessible_name("Revert to the variant");
        if let Some(index) = differs.filter(|_| revert.clicked()) {
            asked.push(Ask::Switch(index));
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (icon, command) in [
                (icons::ICON_CHEVRON_RIGHT, ListCommand::NextVariant),
                (icons::ICON_CHEVRON_LEFT, ListCommand::PreviousVariant),
            ] {
                let command = Command::List(command);
                let key = command.shortcut().map_or_else(String::new, |key| ui.ctx().format_shortcut(&key));
                let label = command.label(session);
                let button = Button::new(icon.rich_text().size(15.0)).frame(false).min_size(vec2(20.0, 20.0));
                let response = ui.add_enabled(command.enabled(session), button);
                if response.on_hover_text(format!("{label}  ({key})")).accessible_name(label).clicked() {
                    commands.push(command);
                }
            }
        });
    });
}

/// What the active view shows, where that are not the scene's own lights; else how to begin.
fn looks(ui: &mut Ui, session: &Session, asked: &mut Vec<Ask>) {
    let scene = session.scene();
    if scene.variants.is_empty() {
        ui.weak("None yet: store the lights as they are, change them, store them again; then switch by a key.");
    }
    if let Some(variant) = session.view.variant.and_then(|index| scene.variants.get(index)) {
        ui.add_space(4.0);
        ui.horizontal_wrapped(|ui| {
            ui.colored_label(theme::accent(ui.visuals()), format!("This view shows “{}”", variant.name));
            if ui.small_button("Show the scene’s lights").clicked() {
                asked.push(Ask::Look(None));
            }
        });
    }
}

/// How the lights are compared with a variant, while they are.
fn comparison(ui: &mut Ui, session: &Session, asked: &mut Vec<Ask>) {
    let scene = session.scene();
    let Some(variant) = session.view.against_variant.and_then(|index| scene.variants.get(index)) else { return };
    ui.add_space(4.0);
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        ui.colored_label(theme::accent(ui.visuals()), format!("Compared with “{}”", variant.name));
        for mode in [ViewMode::Split, ViewMode::Difference] {
            let response = ui.selectable_label(session.view.mode == mode, mode.label().to_lowercase());
            let name = format!("Compare by {}", mode.label().to_lowercase());
            let hint = match mode {
                ViewMode::Split => "Beside each other, with a line to drag between them",
                _ => "How much brighter the lights that are shown are than the variant, in false colour",
            };
            if response.on_hover_text(hint).accessible_name(name).clicked() {
                asked.push(Ask::CompareBy(mode));
            }
        }
    });
}

fn menu(ui: &mut Ui, index: usize, count: usize, asked: &mut Vec<Ask>) {
    if ui.button("Rename").clicked() {
        asked.push(Ask::StartRenaming(index));
    }
    if ui.button("Store the lights here").clicked() {
        asked.push(Ask::Update(index));
    }
    if ui.add_enabled(index > 0, Button::new("Move up")).clicked() {
        asked.push(Ask::Move { index, gap: index - 1 });
    }
    if ui.add_enabled(index + 1 < count, Button::new("Move down")).clicked() {
        asked.push(Ask::Move { index, gap: index + 2 });
    }
    if ui.button("Delete").clicked() {
        asked.push(Ask::Delete(index));
    }
}
