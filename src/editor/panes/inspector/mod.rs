//! The numbers of what is selected; of the scene as a whole when nothing is.

mod emission;
mod fields;
mod light;
mod material;
mod pattern;
mod photometry;
mod plot;
mod scene;
mod surface;
mod together;
mod vertices;

use egui::Ui;

pub(in crate::editor) use self::fields::reveal;

use self::fields::Fields;
use self::pattern::Thumbnail;
use self::together::{Lights, Together};
use super::gesture::Gesture;
use crate::editor::commands::Command;
use crate::editor::session::{Item, Session};
use crate::surface::Material;

/// The pane's own state.
#[derive(Default)]
pub struct Inspector {
    /// What the pane's widgets are in the middle of.
    gesture: Gesture,
    /// A name that is being typed.
    name: Option<(Item, String)>,
    /// The pattern shown last.
    thumbnail: Option<Thumbnail>,
}

impl Inspector {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let mut commands = Vec::new();
        let scroll = egui::ScrollArea::vertical().auto_shrink(false);
        scroll.show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(10, 8)).show(ui, |ui| {
                self.contents(ui, session, &mut commands);
            });
        });
        self.gesture.settle(ui, session);
        commands
    }

    fn contents(&mut self, ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
        let item = session.selection.primary();
        if let Some(item) = item {
            self.heading(ui, session, item);
        }
        let others = session.selection.items().len().saturating_sub(1);
        if others > 0 {
            let what = match item.and_then(|item| edited_together(session, item)) {
                Some((count @ 2.., kind)) => format!("edits {count} {kind} together"),
                _ => format!("and {others} more"),
            };
            ui.weak(what).on_hover_text("Typed values go to all of them; dragged ones change each by as much");
        }
        let mut fields = Fields { session, gesture: &mut self.gesture, thumbnail: &mut self.thumbnail, commands };
        match item {
            Some(Item::Light(index)) => light::show(ui, &mut fields, index),
            Some(Item::Surface(index)) => surface::show(ui, &mut fields, index),
            Some(Item::Material(index)) => {
                if let Some(materials) = Together::<Material>::selected(fields.session, index) {
                    material::show(ui, &mut fields, &materials);
                }
            }
            Some(Item::Plot(index)) => plot::show(ui, &mut fields, index),
            None => scene::show(ui, &mut fields),
        }
        self.gesture.show_refusal(ui);
    }

    /// What is selected, and its name to be edited.
    fn heading(&mut self, ui: &mut Ui, session: &mut Session, item: Item) {
        let scene = session.scene();
        let kind = match item {
            Item::Light(i) => scene.lights.get(i).map(|light| format!("{} light", light.shape.name())),
            Item::Surface(i) => scene.surfaces.get(i).map(|surface| surface.shape.name().to_owned()),
            Item::Material(_) => Some("material".to_owned()),
            Item::Plot(_) => Some("plot".to_owned()),
        };
        let current = item.name(scene).unwrap_or_default().to_owned();
        if self.name.as_ref().is_none_or(|(named, _)| *named != item) {
            self.name = Some((item, current.clone()));
        }
        let Some((_, name)) = &mut self.name else { return };
        ui.horizontal(|ui| {
            let edit = egui::TextEdit::singleline(name).font(egui::TextStyle::Heading).desired_width(150.0);
            let response = ui.add(edit).accessible_name("Name");
            if response.lost_focus() {
                session.rename(item, name);
            }
            if !response.has_focus() {
                *name = item.name(session.scene()).unwrap_or_default().to_owned();
            }
            ui.weak(kind.unwrap_or_default());
        });
    }
}

/// How many things of the kind of `first` are selected, and what they are called, where such are edited together.
fn edited_together(session: &Session, first: Item) -> Option<(usize, &'static str)> {
    let kind = match first {
        Item::Light(_) => "lights",
        Item::Surface(_) => "surfaces",
        Item::Material(_) => "materials",
        Item::Plot(_) => return None,
    };
    let is_alike = |item: &&Item| std::mem::discriminant(*item) == std::mem::discriminant(&first);
    Some((session.selection.items().iter().filter(is_alike).count(), kind))
}

/// The colour of the lights at these places, to be edited in a popup.
pub(super) fn tint_popup(ui: &mut Ui, session: &mut Session, gesture: &mut Gesture, places: &[usize]) {
    let Some(lights) = Lights::at(session.scene(), places.to_vec()) else { return };
    let (mut thumbnail, mut commands) = (None, Vec::new());
    let mut fields = Fields { session, gesture, thumbnail: &mut thumbnail, commands: &mut commands };
    egui::Grid::new("tint").num_columns(2).show(ui, |ui| emission::tint(ui, &mut fields, &lights, true));
}
