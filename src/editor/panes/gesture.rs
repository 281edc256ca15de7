//! Edits by widgets: one undo step a gesture, and never to an invalid document.

use egui::{Id, Response, Ui};

use crate::editor::session::Session;
use crate::scene::{Scene, validate};

/// The gesture that a pane's widgets are in.
#[derive(Debug, Default)]
pub(super) struct Gesture {
    /// The widget whose gesture is open in the history.
    widget: Option<Id>,
    /// Why the last change was refused, and by which widget it was asked for.
    refused: Option<(Id, String)>,
}

impl Gesture {
    /// Apply `change` because the widget changed; it joins the steps of the widget's gesture.
    ///
    /// A change that would make the document invalid is refused, and the reason shown.
    pub(super) fn apply(
        &mut self,
        session: &mut Session,
        response: &Response,
        label: &str,
        change: impl FnOnce(&mut Scene),
    ) {
        if !response.changed() {
            return;
        }
        let mut changed = Scene::clone(session.scene());
        change(&mut changed);
        let before = validate(session.scene());
        if let Some(problem) = validate(&changed).into_iter().find(|problem| !before.contains(problem)) {
            self.refused = Some((response.id, problem.message));
            return;
        }
        self.refused = None;
        if self.widget != Some(response.id) || !session.history.in_gesture() {
            session.begin(label);
            self.widget = Some(response.id);
        }
        session.edit(label, |scene| *scene = changed);
    }

    /// Like [`Self::apply`], for a widget that is done with at once.
    pub(super) fn apply_now(
        &mut self,
        session: &mut Session,
        response: &Response,
        label: &str,
        change: impl FnOnce(&mut Scene),
    ) {
        self.apply(session, response, label, change);
        if response.changed() {
            session.commit();
            self.widget = None;
        }
    }

    /// Whether the widget's gesture is open.
    pub(super) fn is_of(&self, widget: Id) -> bool {
        self.widget == Some(widget)
    }

    /// End the open gesture once its widget is let go.
    pub(super) fn settle(&mut self, ui: &Ui, session: &mut Session) {
        let held = |id: Id| ui.input(|input| input.pointer.any_down()) || ui.memory(|memory| memory.has_focus(id));
        if self.widget.is_some_and(|id| !held(id)) {
            session.commit();
            self.widget = None;
        }
        if self.refused.as_ref().is_some_and(|(id, _)| !held(*id)) {
            self.refused = None;
        }
    }

    /// Say why the last change was refused.
    pub(super) fn show_refusal(&self, ui: &mut Ui) {
        if let Some((_, why)) = &self.refused {
            ui.add_space(6.0);
            ui.colored_label(ui.visuals().error_fg_color, format!("Not possible: {why}"));
        }
    }
}
