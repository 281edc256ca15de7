//! The list of what is in the scene: select, mute, solo, colour, quantity, order, groups, rename, duplicate, delete, add.

mod drop;
mod group;
mod light;

use egui::{RichText, Sense, Ui, vec2};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;

use self::drop::Drag;
use super::gesture::Gesture;
use super::look::{display_color, plain_color};
use super::menu::{entries, light_icon};
use super::renaming::Renaming;
use crate::editor::commands::{Command, LightKind, SurfaceKind};
use crate::editor::light_list::{self, Entry, Slot};
use crate::editor::session::{Item, Session};
use crate::scene::{PlotKind, Scene};
use crate::surface;

/// Height of a row, points.
const ROW: f32 = 20.0;
/// How far the lights of a group stand in, points.
const INDENT: f32 = 14.0;

/// The pane's own state.
#[derive(Debug, Default)]
pub struct Outliner {
    /// The row whose name is being typed.
    renaming: Option<Renaming<Named>>,
    /// What the pane's widgets are in the middle of.
    gesture: Gesture,
    /// Lights on their way to another place.
    drag: Option<Drag>,
}

/// What can be given a name.
#[derive(Clone, Debug, PartialEq)]
enum Named {
    Item(Item),
    Group(String),
}

/// How a click selects.
#[derive(Clone, Copy, Debug, PartialEq)]
enum How {
    /// This and nothing else.
    Only,
    /// This too, or not any more.
    Toggle,
    /// All from what was selected last to this.
    Range,
}

/// What a row asks for.
enum Ask {
    Select(Vec<Item>, How),
    StartRenaming(Named),
    Rename(Named, String),
    Mute(Vec<usize>, bool),
    Solo(Vec<usize>),
    ToggleGroup(String),
    Drag(Drag),
    Put(Vec<usize>, Slot),
    Command(Command),
}

impl Outliner {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let mut asked = Vec::new();
        let scroll = egui::ScrollArea::vertical().auto_shrink(false);
        scroll.show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 6)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 1.0;
                self.sections(ui, session, &mut asked);
                self.gesture.show_refusal(ui);
            });
        });
        self.gesture.settle(ui, session);
        let mut commands = Vec::new();
        for ask in asked {
            self.answer(ask, session, &mut commands);
        }
        commands
    }

    fn sections(&mut self, ui: &mut Ui, session: &mut Session, asked: &mut Vec<Ask>) {
        section(ui, session, "Lights", &LightKind::ALL.map(Command::AddLight), asked);
        if session.scene().lights.is_empty() {
            ui.weak("  none yet");
        }
        self.lights(ui, session, asked);
        let counts = (session.scene().surfaces.len(), session.scene().materials.len(), session.scene().plots.len());
        section(ui, session, "Surfaces", &SurfaceKind::ALL.map(Command::AddSurface), asked);
        (0..counts.0).for_each(|index| self.row(ui, session, Item::Surface(index), asked));
        section(ui, session, "Materials", &[Command::AddMaterial], asked);
        (0..counts.1).for_each(|index| self.row(ui, session, Item::Material(index), asked));
        let plots = [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance].map(Command::AddPlot);
        section(ui, session, "Plots", &plots, asked);
        (0..counts.2).for_each(|index| self.row(ui, session, Item::Plot(index), asked));
    }

    /// The list of lights, and where one that is dragged would go.
    fn lights(&mut self, ui: &mut Ui, session: &mut Session, asked: &mut Vec<Ask>) {
        let scene = session.scene().clone();
        let mut rows = drop::Rows::default();
        for entry in light_list::entries(&scene.lights) {
            match entry {
                Entry::Light(index) => {
                    let rect = self.light_row(ui, session, index, asked);
                    rows.add_light(rect, index, None);
                }
                Entry::Group(name, members) => {
                    let is_closed = session.closed_groups.contains(&name);
                    let rect = self.group_row(ui, session, &name, &members, asked);
                    rows.add_group(rect, &name, members[0], is_closed);
                    for &index in members.iter().filter(|_| !is_closed) {
                        let rect = self.light_row(ui, session, index, asked);
                        rows.add_light(rect, index, Some(&name));
                    }
                }
            }
        }
        drop::show(ui, &rows, &scene.lights, &mut self.drag, asked);
    }

    /// A row of something that is no light.
    fn row(&mut self, ui: &mut Ui, session: &Session, item: Item, asked: &mut Vec<Ask>) {
        let scene = session.scene();
        let Some(name) = item.name(scene) else { return };
        ui.push_id(item, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                ui.add_space(4.0);
                icon(ui, scene, item);
                if self.name_field(ui, &Named::Item(item), asked) {
                    return;
                }
                let selected = session.selection.contains(item);
                let label = egui::Button::selectable(selected, name).truncate().right_text("");
                let response = ui.add(label.min_size(vec2(ui.available_width(), ROW)));
                let response = response.on_hover_text(hover_text(scene, item)).accessible_name(name);
                clicks(ui, &response, item, asked);
                response.context_menu(|ui| context_menu(ui, session, item, asked));
            });
        });
    }

    /// The name being typed, if it is that of this row.
    fn name_field(&mut self, ui: &mut Ui, named: &Named, asked: &mut Vec<Ask>) -> bool {
        Renaming::show(&mut self.renaming, ui, named, |named, name| asked.push(Ask::Rename(named, name)))
    }

    fn answer(&mut self, ask: Ask, session: &mut Session, commands: &mut Vec<Command>) {
        match ask {
            Ask::Select(items, how) => select(session, items, how),
            Ask::StartRenaming(named) => {
                let name = match &named {
                    Named::Item(item) => item.name(session.scene()).unwrap_or_default().to_owned(),
                    Named::Group(name) => name.clone(),
                };
                self.renaming = Some(Renaming::new(named, name));
            }
            Ask::Rename(Named::Item(item), name) => session.rename(item, &name),
            Ask::Rename(Named::Group(old), name) => session.rename_group(&old, &name),
            Ask::Mute(lights, muted) => session.mute(&lights, muted),
            Ask::Solo(lights) => session.solo(&lights),
            Ask::ToggleGroup(name) => {
                if !session.closed_groups.remove(&name) {
                    session.closed_groups.insert(name);
                }
            }
            Ask::Drag(drag) => self.drag = Some(drag),
            Ask::Put(lights, slot) => session.move_lights("Move in the list", &lights, &slot),
            Ask::Command(command) => commands.push(command),
        }
    }
}

/// Select things as a click does.
fn select(session: &mut Session, items: Vec<Item>, how: How) {
    match (how, items.as_slice()) {
        (How::Toggle, items) => items.iter().for_each(|item| session.selection.toggle(*item)),
        (How::Range, [to]) => {
            let from = session.selection.primary().unwrap_or(*to);
            session.selection.set(between(session, from, *to));
        }
        _ => {
            if let [Item::Plot(index)] = items.as_slice() {
                session.plots.active = *index;
            }
            session.selection.set(items);
        }
    }
}

/// All things of one kind from one to another, the latter last.
fn between(session: &Session, from: Item, to: Item) -> Vec<Item> {
    let scene = session.scene();
    let list: Vec<Item> = match (from, to) {
        (Item::Light(_), Item::Light(_)) => light_list::order(&scene.lights).into_iter().map(Item::Light).collect(),
        (Item::Surface(_), Item::Surface(_)) => (0..scene.surfaces.len()).map(Item::Surface).collect(),
        (Item::Material(_), Item::Material(_)) => (0..scene.materials.len()).map(Item::Material).collect(),
        _ => return vec![to],
    };
    let place = |item: Item| list.iter().position(|other| *other == item).unwrap_or_default();
    let (a, b) = (place(from), place(to));
    let mut range = list[a.min(b)..=a.max(b)].to_vec();
    if a > b {
        range.reverse();
    }
    range
}

/// What clicks on a row's name ask for.
fn clicks(ui: &Ui, response: &egui::Response, item: Item, asked: &mut Vec<Ask>) {
    if response.double_clicked() {
        asked.push(Ask::StartRenaming(Named::Item(item)));
    } else if response.clicked() {
        asked.push(Ask::Select(vec![item], how(ui)));
    }
}

/// How a click selects with the keys that are held.
fn how(ui: &Ui) -> How {
    ui.input(|input| match input.modifiers {
        held if held.command => How::Toggle,
        held if held.shift => How::Range,
        _ => How::Only,
    })
}

/// A section's title, and a button that adds to it.
fn section(ui: &mut Ui, session: &Session, title: &str, add: &[Command], asked: &mut Vec<Ask>) {
    ui.add_space(6.0);
    ui.horizontal(|ui| {
        ui.label(RichText::new(title).strong());
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let singular = title.trim_end_matches('s').to_lowercase();
            let button = egui::Button::new(icons::ICON_ADD.rich_text()).frame(false);
            if let [only] = add {
                let response = ui.add(button).on_hover_text(format!("Add {singular}"));
                if response.accessible_name(format!("Add {singular}")).clicked() {
                    asked.push(Ask::Command(only.clone()));
                }
                return;
            }
            let (response, _) = egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
                let mut chosen = None;
                entries(ui, session, add, &mut chosen);
                asked.extend(chosen.map(Ask::Command));
            });
            response.on_hover_text(format!("Add {singular}")).accessible_name(format!("Add {singular}"));
        });
    });
}

fn context_menu(ui: &mut Ui, session: &Session, item: Item, asked: &mut Vec<Ask>) {
    // What is clicked is what the menu is for.
    let select = |asked: &mut Vec<Ask>| {
        if !session.selection.contains(item) {
            asked.push(Ask::Select(vec![item], How::Only));
        }
    };
    if ui.button("Rename").clicked() {
        asked.push(Ask::StartRenaming(Named::Item(item)));
    }
    let paint = item.has_pattern(session.scene()).then_some(Command::EditPattern);
    let export = item.light().map(|_| Command::ExportLights);
    let commands = paint.into_iter().chain([Command::Duplicate, Command::Delete, Command::Focus]).chain(export);
    for command in commands {
        if ui.button(command.label(session)).clicked() {
            select(asked);
            asked.push(Ask::Command(command));
        }
    }
}

/// The icon of a row, in its colour where it has one.
fn icon(ui: &mut Ui, scene: &Scene, item: Item) {
    let weak = ui.visuals().weak_text_color();
    let icon = match item {
        Item::Light(i) => {
            scene.lights.get(i).map_or(icons::ICON_FLARE, |light| light_icon(LightKind::of(&light.shape)))
        }
        Item::Surface(i) => scene.surfaces.get(i).map_or(icons::ICON_CATEGORY, |s| surface_icon(&s.shape)),
        Item::Material(i) => {
            let color = scene.materials.get(i).map_or(weak, |material| plain_color(material.diffuse));
            let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
            ui.painter().circle(rect.center(), 6.0, color, egui::Stroke::new(1.0, weak));
            return;
        }
        Item::Plot(_) => icons::ICON_SHOW_CHART,
    };
    ui.add_sized(vec2(14.0, 18.0), egui::Label::new(icon.rich_text().color(weak).size(15.0)).selectable(false));
}

fn surface_icon(shape: &surface::Shape) -> MaterialIcon {
    match shape {
        surface::Shape::Plane {} => icons::ICON_GRID_4X4,
        surface::Shape::Sphere { .. } => icons::ICON_CIRCLE,
        surface::Shape::Box { .. } => icons::ICON_DEPLOYED_CODE,
        surface::Shape::Square { .. } => icons::ICON_SQUARE,
        surface::Shape::Disk { .. } => icons::ICON_ADJUST,
        surface::Shape::Cylinder { .. } => icons::ICON_DATABASE,
        surface::Shape::Cone { .. } => icons::ICON_CHANGE_HISTORY,
        surface::Shape::Sphereflake { .. } => icons::ICON_BUBBLE_CHART,
        surface::Shape::Tetrahedron { .. } => icons::ICON_DETAILS,
        surface::Shape::Patch { .. } => icons::ICON_SAILING,
        surface::Shape::Mesh(_) => icons::ICON_CHAIR,
    }
}

fn hover_text(scene: &Scene, item: Item) -> String {
    match item {
        Item::Light(i) => scene.lights.get(i).map_or_else(String::new, |light| {
            format!(
                "{}, {} light, {:.4} {}",
                light.name,
                light.shape.name(),
                light.quantity.value(),
                light.quantity.kind().unit()
            )
        }),
        Item::Surface(i) => {
            scene.surfaces.get(i).map_or_else(String::new, |s| format!("{} of “{}”", s.shape.name(), s.material))
        }
        Item::Material(_) => "material".to_owned(),
        Item::Plot(_) => "plot, and its probe".to_owned(),
    }
}
