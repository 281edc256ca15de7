//! What the mouse and the keyboard do in the viewport: navigate, draw, drag handles, select.

use egui::{Color32, Modifiers, Painter, PointerButton, Response, Ui};

use super::navigate;
use super::pick::{self, Solids};
use super::projection::Projection;
use crate::editor::commands::Command;
use crate::editor::handles::click::Placing;
use crate::editor::handles::grip::{Grip, Holding};
use crate::editor::handles::{Handle, corners};
use crate::editor::session::{Item, Session};
use crate::editor::tools::drawing::Drawing;

/// Zoom per point of scrolling: a notch of 50 points is a factor of 0.88.
const ZOOM_PER_POINT: f32 = 0.0025;

/// What the pointer is doing.
#[derive(Debug, Default)]
pub struct Pointer {
    drawing: Drawing,
    grip: Grip,
    placing: Placing,
    hovered: Option<Item>,
    navigating: bool,
    /// The press that is still down has done its work: its release is not a click.
    spent: bool,
}

impl Pointer {
    /// Whether something is dragged, be it a handle, a sphere's radius or the camera.
    pub fn is_dragging(&self) -> bool {
        self.grip.is_held() || self.placing.is_held() || self.navigating
    }

    /// What is under the pointer: what a click would select, or that of which it is on a handle.
    pub fn hovered(&self) -> Option<Item> {
        self.hovered.or(self.grip.hot().map(|(item, _)| item))
    }

    /// Whether a probe is being dragged.
    pub fn holds_probe(&self) -> bool {
        self.grip.holds_probe()
    }

    /// React to this frame's input.
    pub fn update(&mut self, ui: &Ui, response: &Response, session: &mut Session, solids: &Solids, handles: bool) {
        self.navigate(ui, response, session);
        let projection = Projection::new(&session.view.camera, response.rect);
        let was_spent = self.spent;
        if !ui.input(|input| input.pointer.any_down()) {
            self.spent = false;
        }
        self.hovered = None;
        if self.drawing.update(ui, response, session, solids, &projection) {
            self.spent = true;
        }
        if session.tool.draws() {
            self.grip.hide();
            return;
        }
        self.placing.update(ui, response, session, solids, &projection);
        if session.tool.places() {
            self.grip.hide();
            return;
        }
        if handles {
            self.grip.lay_out(session, solids, &projection);
        } else {
            self.grip.hide();
        }
        self.spent |= self.grip.hold(ui, response, session, solids, &projection) == Holding::Ended;
        if self.grip.is_held() {
            // Handles are seen where the thing is by now.
            self.grip.lay_out(session, solids, &projection);
        } else if !self.navigating {
            if !self.grip.hover(response, session) {
                self.hover(response, session, solids, &projection);
            }
            let hot = self.grip.hot();
            let done = !was_spent && corners::update(ui, response, session, hot, &projection);
            if response.clicked() && !was_spent && !done && hot.is_none_or(|(_, handle)| handle == Handle::Probe) {
                let item = hot.map(|(item, _)| item).or(self.hovered);
                select(session, item, ui.input(|input| input.modifiers));
            }
            let has_pattern = |item: Item| item.has_pattern(session.scene());
            if response.double_clicked() && hot.is_none() && self.hovered.is_some_and(has_pattern) {
                session.asked.push(Command::EditPattern);
            }
        }
    }

    /// Orbit, pan and zoom.
    fn navigate(&mut self, ui: &Ui, response: &Response, session: &mut Session) {
        let (modifiers, scroll, pinch) =
            ui.input(|input| (input.modifiers, input.smooth_scroll_delta().y, input.zoom_delta()));
        let by_middle = response.dragged_by(PointerButton::Middle);
        let by_alt = response.dragged_by(PointerButton::Primary) && modifiers.alt && !self.grip.is_held();
        self.navigating = by_middle || by_alt;
        let projection = Projection::new(&session.view.camera, response.rect);
        if self.navigating {
            let drag = response.drag_delta();
            session.view.camera = if modifiers.shift {
                navigate::panned(&projection, drag)
            } else {
                navigate::orbited(&session.view.camera, drag)
            };
        }
        let zoom = (-ZOOM_PER_POINT * scroll).exp() / pinch;
        if let Some(pos) = response.hover_pos()
            && !self.grip.is_held()
            && !self.placing.is_held()
            && zoom != 1.0
        {
            session.view.camera = navigate::zoomed(&projection, pos, f64::from(zoom));
        }
    }

    /// What the pointer is over, while nothing is held.
    fn hover(&mut self, response: &Response, session: &mut Session, solids: &Solids, projection: &Projection) {
        let Some(pos) = response.hover_pos().filter(|_| response.hovered()) else { return };
        self.hovered = pick::pick(session.scene(), solids, projection, pos);
        session.hint = self
            .hovered
            .and_then(|item| item.name(session.scene()))
            .map_or_else(String::new, |name| format!("Click to select {name}"));
        if self.hovered.is_none_or(|item| session.selection.contains(item))
            && let Some(hint) = corners::edge_on_hint(session, projection)
        {
            session.hint = hint;
        }
    }

    /// Draw handles, what is refused, and what is being drawn.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        self.grip.paint(projection, painter);
        corners::paint(session, self.grip.hot().filter(|_| !self.grip.is_held()), accent, projection, painter);
        self.drawing.paint(session, accent, projection, painter);
        self.placing.paint(session, accent, projection, painter);
    }
}

/// Select what was clicked; with Shift or Ctrl add it or take it away.
fn select(session: &mut Session, item: Option<Item>, modifiers: Modifiers) {
    match item {
        Some(item) if modifiers.shift || modifiers.command => session.selection.toggle(item),
        Some(item) => session.selection.set([item]),
        None if modifiers.is_none() => session.selection.clear(),
        None => {}
    }
}
