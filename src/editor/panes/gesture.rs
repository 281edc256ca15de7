//! Edits by widgets: one undo step a gesture, and never to an invalid document; rows dragged to another place.

use egui::{CursorIcon, Id, Key, LayerId, Order, Pos2, Response, Stroke, Ui, pos2};

use crate::editor::session::Session;
use crate::editor::theme;
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

/// A row of a list on its way to another place.
#[derive(Clone, Copy, Debug)]
pub(super) struct RowDrag {
    pointer: Option<Pos2>,
    /// The button is up: the row goes where it is now.
    pub(super) is_let_go: bool,
    is_cancelled: bool,
}

impl RowDrag {
    /// The drag as mouse and keys have it.
    pub(super) fn of(ui: &Ui) -> Self {
        ui.input(|input| Self {
            pointer: input.pointer.latest_pos(),
            is_let_go: !input.pointer.primary_down(),
            is_cancelled: input.key_pressed(Key::Escape),
        })
    }

    /// The height of the pointer, unless Esc has ended the drag.
    pub(super) fn y(&self) -> Option<f32> {
        self.pointer.filter(|_| !self.is_cancelled).map(|pointer| pointer.y)
    }

    /// Whether the drag ends in this frame.
    pub(super) fn is_over(&self) -> bool {
        self.is_let_go || self.is_cancelled
    }

    /// The line where the row would go.
    pub(super) fn show_line(ui: &Ui, left: f32, y: f32) {
        let accent = theme::accent(ui.visuals());
        let painter = ui.ctx().layer_painter(LayerId::new(Order::Foreground, ui.scope_id().with("drop")));
        painter.hline(left..=ui.max_rect().right(), y, Stroke::new(2.0, accent));
        painter.circle_filled(pos2(left, y), 3.0, accent);
        ui.set_cursor_icon(CursorIcon::Grabbing);
    }
}
