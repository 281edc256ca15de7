//! The list of what is in the scene: select, mute, solo, rename, duplicate, delete, add.

use egui::{Color32, RichText, Sense, Ui, vec2};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;

use super::icon_button;
use super::menu::{entries, light_icon};
use crate::editor::commands::{Command, LightKind, SurfaceKind};
use crate::editor::session::{Item, Session};
use crate::editor::theme;
use crate::scene::{PlotKind, Scene};
use crate::surface;

/// The pane's own state.
#[derive(Debug, Default)]
pub struct Outliner {
    /// The row whose name is being typed.
    renaming: Option<Renaming>,
}

#[derive(Debug)]
struct Renaming {
    item: Item,
    name: String,
    /// The field has had the focus, so losing it ends the edit.
    focused: bool,
}

/// What a row asks for.
enum Ask {
    Select { item: Item, toggle: bool },
    StartRenaming(Item),
    Rename(Item, String),
    CancelRenaming,
    ToggleMute(usize),
    ToggleSolo(usize),
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
                self.groups(ui, session, &mut asked);
            });
        });
        let mut commands = Vec::new();
        for ask in asked {
            self.answer(ask, session, &mut commands);
        }
        commands
    }

    fn groups(&mut self, ui: &mut Ui, session: &Session, asked: &mut Vec<Ask>) {
        let scene = session.scene();
        let lights = LightKind::ALL.map(Command::AddLight);
        group(ui, session, "Lights", &lights, asked);
        if scene.lights.is_empty() {
            ui.weak("  none yet");
        }
        for index in 0..scene.lights.len() {
            self.row(ui, session, Item::Light(index), asked);
        }
        group(ui, session, "Surfaces", &SurfaceKind::ALL.map(Command::AddSurface), asked);
        for index in 0..scene.surfaces.len() {
            self.row(ui, session, Item::Surface(index), asked);
        }
        group(ui, session, "Materials", &[Command::AddMaterial], asked);
        for index in 0..scene.materials.len() {
            self.row(ui, session, Item::Material(index), asked);
        }
        let plots = [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance].map(Command::AddPlot);
        group(ui, session, "Plots", &plots, asked);
        for index in 0..scene.plots.len() {
            self.row(ui, session, Item::Plot(index), asked);
        }
    }

    fn row(&mut self, ui: &mut Ui, session: &Session, item: Item, asked: &mut Vec<Ask>) {
        let scene = session.scene();
        let Some(name) = item.name(scene) else { return };
        ui.push_id(item, |ui| {
            ui.horizontal(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                ui.add_space(4.0);
                swatch(ui, scene, item);
                if self.renaming.as_ref().is_some_and(|renaming| renaming.item == item) {
                    self.name_field(ui, asked);
                    return;
                }
                let buttons = if matches!(item, Item::Light(_)) { 52.0 } else { 0.0 };
                let width = ui.available_width() - buttons;
                let dimmed = is_dimmed(session, item);
                let text = RichText::new(name);
                let text = if dimmed { text.weak() } else { text };
                let selected = session.selection.contains(item);
                let label =
                    egui::Button::selectable(selected, text).truncate().right_text("").min_size(vec2(width, 20.0));
                let response = ui.add(label).on_hover_text(hover_text(scene, item)).accessible_name(name);
                if response.double_clicked() {
                    asked.push(Ask::StartRenaming(item));
                } else if response.clicked() {
                    asked.push(Ask::Select { item, toggle: ui.input(|input| input.modifiers.command) });
                }
                response.context_menu(|ui| context_menu(ui, session, item, asked));
                if let Item::Light(index) = item {
                    light_buttons(ui, session, index, asked);
                }
            });
        });
    }

    /// The name being typed; Enter or a click elsewhere takes it, Esc does not.
    fn name_field(&mut self, ui: &mut Ui, asked: &mut Vec<Ask>) {
        let Some(renaming) = &mut self.renaming else { return };
        let edit = egui::TextEdit::singleline(&mut renaming.name).desired_width(f32::INFINITY);
        let response = ui.add(edit).accessible_name("New name");
        if !renaming.focused {
            response.request_focus();
            renaming.focused = true;
        } else if response.lost_focus() {
            let cancelled = ui.input(|input| input.key_pressed(egui::Key::Escape));
            let rename = Ask::Rename(renaming.item, renaming.name.clone());
            asked.push(if cancelled { Ask::CancelRenaming } else { rename });
        }
    }

    fn answer(&mut self, ask: Ask, session: &mut Session, commands: &mut Vec<Command>) {
        match ask {
            Ask::Select { item, toggle: true } => session.selection.toggle(item),
            Ask::Select { item, toggle: false } => {
                session.selection.set([item]);
                if let Item::Plot(index) = item {
                    session.plots.active = index;
                }
            }
            Ask::StartRenaming(item) => {
                let name = item.name(session.scene()).unwrap_or_default().to_owned();
                self.renaming = Some(Renaming { item, name, focused: false });
            }
            Ask::Rename(item, name) => {
                session.rename(item, &name);
                self.renaming = None;
            }
            Ask::CancelRenaming => self.renaming = None,
            Ask::ToggleMute(index) => session.edit("Mute", |scene| {
                if let Some(light) = scene.lights.get_mut(index) {
                    light.muted ^= true;
                }
            }),
            Ask::ToggleSolo(index) => {
                let name = session.scene().lights.get(index).map(|light| light.name.clone());
                if let Some(name) = name {
                    session.toggle_solo(&name);
                }
            }
            Ask::Command(command) => commands.push(command),
        }
    }
}

/// A group's title, and a button that adds to it.
fn group(ui: &mut Ui, session: &Session, title: &str, add: &[Command], asked: &mut Vec<Ask>) {
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
            asked.push(Ask::Select { item, toggle: false });
        }
    };
    if ui.button("Rename").clicked() {
        asked.push(Ask::StartRenaming(item));
    }
    for command in [Command::Duplicate, Command::Delete, Command::Focus] {
        if ui.button(command.label(session)).clicked() {
            select(asked);
            asked.push(Ask::Command(command));
        }
    }
}

fn light_buttons(ui: &mut Ui, session: &Session, index: usize, asked: &mut Vec<Ask>) {
    let Some(light) = session.scene().lights.get(index) else { return };
    let solo = session.is_solo(&light.name);
    let (accent, weak, text) = (theme::accent(ui.visuals()), ui.visuals().weak_text_color(), ui.visuals().text_color());
    let solo_color = if solo { accent } else { weak };
    if icon_button(ui, icons::ICON_HEADPHONES, solo_color, &format!("Solo {}", light.name)).clicked() {
        asked.push(Ask::ToggleSolo(index));
    }
    let (icon, verb, color) =
        if light.muted { (icons::ICON_VISIBILITY_OFF, "Unmute", weak) } else { (icons::ICON_VISIBILITY, "Mute", text) };
    if icon_button(ui, icon, color, &format!("{verb} {}", light.name)).clicked() {
        asked.push(Ask::ToggleMute(index));
    }
}

/// Whether a light does not contribute to what is shown.
fn is_dimmed(session: &Session, item: Item) -> bool {
    let Item::Light(index) = item else { return false };
    let Some(light) = session.scene().lights.get(index) else { return false };
    light.muted || (session.has_solo() && !session.is_solo(&light.name))
}

/// The icon of a row, in its colour where it has one.
fn swatch(ui: &mut Ui, scene: &Scene, item: Item) {
    let weak = ui.visuals().weak_text_color();
    let (icon, color) = match item {
        Item::Light(i) => match scene.lights.get(i) {
            Some(light) => {
                let color = display_color(light.tint.rgb());
                // White would be lost on a light pane.
                let shade = if ui.visuals().dark_mode { 0.0 } else { 0.3 };
                (light_icon(LightKind::of(&light.shape)), color.lerp_to_gamma(Color32::BLACK, shade))
            }
            None => return,
        },
        Item::Surface(i) => (scene.surfaces.get(i).map_or(icons::ICON_CATEGORY, |s| surface_icon(&s.shape)), weak),
        Item::Material(i) => {
            let color = scene.materials.get(i).map_or(weak, |material| plain_color(material.diffuse));
            let (rect, _) = ui.allocate_exact_size(vec2(14.0, 14.0), Sense::hover());
            ui.painter().circle(rect.center(), 6.0, color, egui::Stroke::new(1.0, weak));
            return;
        }
        Item::Plot(_) => (icons::ICON_SHOW_CHART, weak),
    };
    ui.add_sized(vec2(14.0, 18.0), egui::Label::new(icon.rich_text().color(color).size(15.0)).selectable(false));
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
            format!("{} light, {:.4} {}", light.shape.name(), light.quantity.value(), light.quantity.kind().unit())
        }),
        Item::Surface(i) => {
            scene.surfaces.get(i).map_or_else(String::new, |s| format!("{} of “{}”", s.shape.name(), s.material))
        }
        Item::Material(_) => "material".to_owned(),
        Item::Plot(_) => "plot, and its probe".to_owned(),
    }
}

/// A tint at full brightness, as sRGB.
fn display_color(rgb: glam::DVec3) -> Color32 {
    plain_color(rgb / rgb.max_element().max(1e-12))
}

/// Linear Rec. 709, as sRGB.
fn plain_color(rgb: glam::DVec3) -> Color32 {
    let [r, g, b] = rgb.clamp(glam::DVec3::ZERO, glam::DVec3::ONE).as_vec3().to_array();
    egui::Rgba::from_rgb(r, g, b).into()
}
