//! The numbers of what is selected; of the scene as a whole when nothing is.

mod fields;
mod light;
mod material;
mod pattern;
mod plot;
mod scene;
mod surface;

use egui::{Id, RichText, Ui};

use self::fields::Fields;
use self::pattern::Thumbnail;
use crate::editor::commands::Command;
use crate::editor::session::{Item, Session};

/// The pane's own state.
#[derive(Default)]
pub struct Inspector {
    /// The widget whose gesture is open in the history.
    gesture: Option<Id>,
    /// Why the last change was refused, and by which widget it was asked for.
    refused: Option<(Id, String)>,
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
        self.settle(ui, session);
        commands
    }

    fn contents(&mut self, ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
        let item = session.selection.primary();
        if let Some(item) = item {
            self.heading(ui, session, item);
        }
        let others = session.selection.items().len().saturating_sub(1);
        if others > 0 {
            ui.weak(format!("and {others} more selected"));
        }
        let mut fields = Fields {
            session,
            gesture: &mut self.gesture,
            refused: &mut self.refused,
            thumbnail: &mut self.thumbnail,
            commands,
        };
        match item {
            Some(Item::Light(index)) => light::show(ui, &mut fields, index),
            Some(Item::Surface(index)) => surface::show(ui, &mut fields, index),
            Some(Item::Material(index)) => material::show(ui, &mut fields, index),
            Some(Item::Plot(index)) => plot::show(ui, &mut fields, index),
            None => scene::show(ui, &mut fields),
        }
        if let Some((_, why)) = &self.refused {
            ui.add_space(6.0);
            ui.label(RichText::new(format!("Not possible: {why}")).color(ui.visuals().error_fg_color));
        }
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

    /// End the open gesture once its widget is let go.
    fn settle(&mut self, ui: &Ui, session: &mut Session) {
        let held = |id: Id| ui.input(|input| input.pointer.any_down()) || ui.memory(|memory| memory.has_focus(id));
        if self.gesture.is_some_and(|id| !held(id)) {
            session.commit();
            self.gesture = None;
        }
        if self.refused.as_ref().is_some_and(|(id, _)| !held(*id)) {
            self.refused = None;
        }
    }
}
