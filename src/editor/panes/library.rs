//! The library: presets and scenes as small pictures, to be searched, opened, inserted and added to.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{Align2, DragAndDrop, FontId, Key, Rect, RichText, Sense, Ui, WidgetInfo, pos2, vec2};
use egui_material_icons::icons;

use super::icon_button;
use super::menu::light_icon;
use crate::editor::commands::Command;
use crate::editor::folders::Folders;
use crate::editor::library::drop::Carried;
use crate::editor::library::thumbnails::Thumbnails;
use crate::editor::library::{self, Entry, Shelf};
use crate::editor::session::{Item, Session};
use crate::editor::theme;

/// A picture's width and height, and the line below it, points.
const PICTURE: egui::Vec2 = vec2(128.0, 80.0);
const TITLE_HEIGHT: f32 = 20.0;

/// The pane of presets and scenes.
#[derive(Default)]
pub struct Library {
    folder: Option<PathBuf>,
    /// Read when the pane is first shown, and again when a preset is added.
    entries: Option<Vec<Entry>>,
    query: String,
    shelf: Option<Shelf>,
    /// The entry that Enter takes.
    chosen: Option<usize>,
    naming: Option<Naming>,
}

/// A preset that is being named.
#[derive(Default)]
struct Naming {
    name: String,
    tags: String,
    focused: bool,
}

impl Library {
    /// The library with the user's own presets.
    pub fn new(folders: &Folders) -> Self {
        Self { folder: folders.presets(), ..Self::default() }
    }

    /// Ask what the preset of the selected lights shall be called.
    pub fn name_selection(&mut self, session: &Session) {
        let name = session.selection.primary().and_then(|item| item.name(session.scene())).unwrap_or_default();
        self.naming = Some(Naming { name: name.to_owned(), ..Naming::default() });
    }

    /// Show the pane.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session, thumbnails: &mut Thumbnails) -> Vec<Command> {
        let mut asked = Vec::new();
        let entries = self.entries.take().unwrap_or_else(|| read(self.folder.as_deref()));
        egui::Frame::new().inner_margin(8).show(ui, |ui| {
            self.bar(ui, session, &mut asked);
            if let Some(preset) = self.name_row(ui, session) {
                self.save(&preset, session);
            }
            ui.add_space(4.0);
            self.cards(ui, &entries, thumbnails, session, &mut asked);
        });
        // Where a preset was saved, all are read again.
        if !std::mem::take(&mut session.library_changed) {
            self.entries = Some(entries);
        } else {
            ui.ctx().request_repaint();
        }
        asked
    }

    fn bar(&mut self, ui: &mut Ui, session: &Session, asked: &mut Vec<Command>) {
        ui.horizontal(|ui| {
            let field =
                egui::TextEdit::singleline(&mut self.query).hint_text("Search names and tags").desired_width(180.0);
            ui.add(field).accessible_name("Search library");
            let shelves = [
                ("All", None),
                ("Lights", Some(Shelf::Lights)),
                ("Scenes", Some(Shelf::Scenes)),
                ("Mine", Some(Shelf::Own)),
            ];
            for (label, shelf) in shelves {
                let button = egui::Button::selectable(self.shelf == shelf, label);
                if ui.add(button).accessible_name(format!("Show {}", label.to_lowercase())).clicked() {
                    self.shelf = shelf;
                }
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let weak = ui.visuals().weak_text_color();
                if icon_button(ui, icons::ICON_REFRESH, weak, "Read own presets again").clicked() {
                    self.entries = None;
                }
                let save = Command::SavePreset;
                let button = egui::Button::new(save.label(session));
                let hover = "Keep the selected lights, to insert them into other scenes";
                if ui.add_enabled(save.enabled(session), button).on_hover_text(hover).clicked() {
                    asked.push(save);
                }
            });
        });
    }

    /// The fields of the preset that is being named; the preset, once it is.
    fn name_row(&mut self, ui: &mut Ui, session: &Session) -> Option<crate::scene::Scene> {
        let naming = self.naming.as_mut()?;
        let (mut save, mut cancel) = (false, false);
        ui.horizontal(|ui| {
            let name = egui::TextEdit::singleline(&mut naming.name).hint_text("Name").desired_width(150.0);
            let name = ui.add(name).accessible_name("Preset name");
            let tags = egui::TextEdit::singleline(&mut naming.tags)
                .hint_text("tags, separated by spaces")
                .desired_width(180.0);
            let tags = ui.add(tags).accessible_name("Preset tags");
            if !std::mem::replace(&mut naming.focused, true) {
                name.request_focus();
            }
            let entered = (name.lost_focus() || tags.lost_focus()) && ui.input(|input| input.key_pressed(Key::Enter));
            save = ui.button("Save preset").clicked() || entered;
            cancel = ui.button("Cancel preset").clicked() || ui.input(|input| input.key_pressed(Key::Escape));
        });
        if cancel {
            self.naming = None;
            return None;
        }
        let naming = self.naming.as_ref().filter(|_| save)?;
        let mut tags: Vec<String> = Vec::new();
        for tag in naming.tags.split([' ', ',']).map(str::trim).filter(|tag| !tag.is_empty()) {
            if !tags.iter().any(|other| other == tag) {
                tags.push(tag.to_owned());
            }
        }
        Some(library::preset_of_selection(session, naming.name.trim(), &tags))
    }

    fn save(&mut self, preset: &crate::scene::Scene, session: &mut Session) {
        let Some(folder) = &self.folder else {
            return session.failed("This system has no folder for presets");
        };
        if preset.lights.is_empty() {
            return session.failed("Select the lights to keep first");
        }
        match library::write_preset(preset, folder) {
            Ok(path) => {
                session.done(format!("Saved preset {} as {}", preset.name, path.display()));
                session.library_changed = true;
                self.naming = None;
                self.shelf = Some(Shelf::Own);
                self.query.clear();
            }
            Err(error) => session.failed(error),
        }
    }

    fn cards(
        &mut self,
        ui: &mut Ui,
        entries: &[Entry],
        thumbnails: &mut Thumbnails,
        session: &mut Session,
        asked: &mut Vec<Command>,
    ) {
        let on_shelf = |entry: &Entry| self.shelf.is_none_or(|shelf| entry.shelf == shelf);
        let shown: Vec<usize> =
            (0..entries.len()).filter(|i| on_shelf(&entries[*i]) && entries[*i].matches(&self.query)).collect();
        let mut taken = None;
        let area = egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            if shown.is_empty() {
                let own = self.shelf == Some(Shelf::Own) && self.query.is_empty();
                ui.weak(if own {
                    "No presets of your own yet: select lights, then “Save selection as preset…”"
                } else {
                    "Nothing matches."
                });
            }
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = vec2(8.0, 8.0);
                for index in shown {
                    let response = card(ui, &entries[index], self.chosen == Some(index), thumbnails);
                    if response.clicked() {
                        self.chosen = Some(index);
                    }
                    let by_key = response.has_focus() && ui.input(|input| input.key_pressed(Key::Enter));
                    // A click elsewhere just before makes a double click the end of a triple one.
                    if response.double_clicked() || response.triple_clicked() || by_key {
                        taken = Some(index);
                    }
                    carry(&response, &entries[index], session);
                    response.context_menu(|ui| {
                        let verb = if entries[index].shelf == Shelf::Scenes { "Open" } else { "Insert" };
                        if ui.button(verb).clicked() {
                            taken = Some(index);
                        }
                    });
                }
            });
        });
        let over = ui.rect_contains_pointer(area.inner_rect);
        if over && !ui.ctx().egui_wants_keyboard_input() && ui.input(|input| input.key_pressed(Key::Enter)) {
            taken = taken.or(self.chosen);
        }
        if over && session.hint.is_empty() {
            "Double-click inserts a light or opens a scene; drag a light into the view".clone_into(&mut session.hint);
        }
        if let Some(entry) = taken.and_then(|index| entries.get(index)) {
            asked.push(take(entry));
        }
    }
}

/// What a double click on an entry does.
pub(super) fn take(entry: &Entry) -> Command {
    match (&entry.source, entry.shelf) {
        (library::Source::Shipped(preset), Shelf::Scenes) => Command::OpenExample(*preset),
        (library::Source::Shipped(preset), _) => Command::InsertPreset(*preset),
        (library::Source::File(path, _), Shelf::Scenes) => Command::OpenFile(path.clone()),
        (library::Source::File(path, _), _) => Command::InsertFile(path.clone()),
    }
}

fn read(folder: Option<&Path>) -> Vec<Entry> {
    let mut entries = folder.map(library::own).unwrap_or_default();
    entries.extend(library::shipped());
    entries
}

/// Size of the icon that stands for a picture, points.
const PLACEHOLDER: f32 = 34.0;

/// A picture and its title.
fn card(ui: &mut Ui, entry: &Entry, chosen: bool, thumbnails: &mut Thumbnails) -> egui::Response {
    let (rect, response) = ui.allocate_exact_size(PICTURE + vec2(0.0, TITLE_HEIGHT), Sense::click_and_drag());
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Button, true, &entry.title));
    if !ui.is_rect_visible(rect) {
        return response;
    }
    let picture = Rect::from_min_size(rect.min, PICTURE);
    let visuals = ui.visuals();
    ui.painter().rect_filled(picture, 4.0, visuals.extreme_bg_color);
    if let Some(texture) = thumbnails.get(ui.ctx(), &entry.source) {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture.id(), picture, whole, egui::Color32::WHITE);
    } else {
        // Until its picture is made.
        let icon = entry.kind.map_or(icons::ICON_IMAGE, light_icon);
        let font = FontId::proportional(PLACEHOLDER);
        let color = ui.visuals().weak_text_color().gamma_multiply(0.5);
        ui.painter().text(picture.center(), Align2::CENTER_CENTER, icon.codepoint, font, color);
    }
    let stroke = match (chosen, response.hovered() || response.has_focus()) {
        (true, _) => egui::Stroke::new(2.0, theme::accent(visuals)),
        (_, true) => egui::Stroke::new(1.0, visuals.strong_text_color()),
        _ => egui::Stroke::new(1.0, visuals.widgets.noninteractive.bg_stroke.color),
    };
    ui.painter().rect_stroke(picture, 4.0, stroke, egui::StrokeKind::Inside);
    let below = Rect::from_min_max(pos2(rect.left(), picture.bottom()), rect.max);
    let color = if chosen { visuals.strong_text_color() } else { visuals.text_color() };
    let title = ui.painter().with_clip_rect(below);
    title.text(
        below.left_center() + vec2(2.0, 1.0),
        Align2::LEFT_CENTER,
        &entry.title,
        FontId::proportional(12.0),
        color,
    );
    response.on_hover_ui(|ui| {
        ui.label(RichText::new(&entry.title).strong());
        ui.label(&entry.about);
        if !entry.tags.is_empty() {
            ui.weak(entry.tags.join(" · "));
        }
    })
}

/// Let an entry's lights be carried into the view.
fn carry(response: &egui::Response, entry: &Entry, session: &mut Session) {
    if entry.shelf == Shelf::Scenes {
        return;
    }
    if response.drag_started() {
        match entry.source.load() {
            Ok(scene) => {
                let carried = Carried { title: entry.title.clone(), scene: Arc::new(scene) };
                DragAndDrop::set_payload(&response.ctx, carried);
            }
            Err(error) => session.failed(error.to_string()),
        }
    }
    if response.dragged()
        && DragAndDrop::has_payload_of_type::<Carried>(&response.ctx)
        && let Some(pos) = response.ctx.input(|input| input.pointer.latest_pos())
    {
        let area = egui::Area::new(egui::Id::unique("carried")).order(egui::Order::Tooltip);
        area.fixed_pos(pos + vec2(14.0, 10.0)).interactable(false).show(&response.ctx, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| ui.label(&entry.title));
        });
        response.ctx.set_cursor_icon(egui::CursorIcon::Grabbing);
    }
}

/// Whether something that can be kept as a preset is selected.
pub(in crate::editor) fn has_lights(session: &Session) -> bool {
    session.selection.items().iter().any(|item| matches!(item, Item::Light(_)))
}
