//! Handles under the mouse: taken hold of, dragged, let go; hovered and double-clicked.

use egui::{CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Stroke, Ui, Vec2};

use super::drag::{Change, Drag};
use super::subject::Subject;
use super::vertices::{Edited, double_clicked};
use super::{Handle, Spot};
use crate::editor::session::{Item, Session};
use crate::editor::viewport::overlay::{self, REFUSED};
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::ray::Ray;

/// Grid spacing that Ctrl snaps to where the work plane has none, metres.
const DEFAULT_GRID: f64 = 0.1;

/// The handles on screen, and what the pointer does with them.
#[derive(Debug, Default)]
pub struct Grip {
    spots: Vec<(Item, Vec<Spot>)>,
    hot: Option<(Item, Handle)>,
    held: Option<Held>,
}

/// A handle held down.
#[derive(Debug)]
struct Held {
    item: Item,
    drag: Drag,
    refused: Option<Subject>,
}

/// How a frame of holding ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holding {
    /// No handle is held.
    Nothing,
    /// One is.
    Held,
    /// One was, and Esc took back what it did; the button may still be down.
    Cancelled,
}

impl Grip {
    /// Whether a handle is held.
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// Whether a probe is being dragged.
    pub fn holds_probe(&self) -> bool {
        self.held.as_ref().is_some_and(|held| held.drag.handle() == Handle::Probe)
    }

    /// The handle under the pointer.
    pub fn hot(&self) -> Option<(Item, Handle)> {
        self.hot
    }

    /// No handles are shown.
    pub fn hide(&mut self) {
        self.hot = None;
        self.spots.clear();
    }

    /// Lay the handles out anew.
    pub fn lay_out(&mut self, session: &Session, projection: &Projection) {
        self.spots = spots(session, projection);
    }

    /// Take hold of a handle, drag it, let it go.
    pub fn hold(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &mut Session,
        solids: &Solids,
        projection: &Projection,
    ) -> Holding {
        let modifiers = ui.input(|input| input.modifiers);
        self.take(ui, response, session);
        let Some(held) = &mut self.held else { return Holding::Nothing };
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            session.abort();
            self.held = None;
            return Holding::Cancelled;
        }
        if !session.history.in_gesture() {
            // Undo, or something else that ends gestures, came in between.
            self.held = None;
            return Holding::Nothing;
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        session.hint = "Ctrl snaps to the grid, Shift drags fine, Esc cancels".to_owned();
        let grid = session.work_plane.grid;
        let snap = modifiers.command.then_some(if grid > 0.0 { grid } else { DEFAULT_GRID });
        let by = if response.dragged() { response.drag_delta() } else { Vec2::ZERO };
        held.drag.pull(by, modifiers.shift);
        let under = |ray: &Ray| solids.nearest(ray).map(|(_, hit)| hit);
        match held.drag.change(projection, snap, under) {
            Some(Change::To(subject)) => {
                held.refused = None;
                let (item, label) = (held.item, held.drag.label());
                if Subject::of(item, session.scene()).is_some_and(|now| now != subject) {
                    session.edit(label, |scene| subject.put(item, scene));
                }
            }
            Some(Change::Refused(subject)) => {
                held.refused = Some(subject);
                session.hint = "Edges may not cross".to_owned();
            }
            None => session.hint = "This is seen too flatly to be dragged there: orbit the view".to_owned(),
        }
        if !response.dragged() {
            session.commit();
            self.held = None;
        }
        if self.held.is_some() { Holding::Held } else { Holding::Nothing }
    }

    /// Begin a drag where one starts on a handle.
    fn take(&mut self, ui: &Ui, response: &Response, session: &mut Session) {
        let (modifiers, origin, pos) =
            ui.input(|input| (input.modifiers, input.pointer.press_origin(), input.pointer.interact_pos()));
        if response.drag_started_by(PointerButton::Primary)
            && !modifiers.alt
            && let (Some(origin), Some(pos)) = (origin, pos)
            && let Some((item, handle)) = self.hit(origin)
            && let Some(subject) = Subject::of(item, session.scene())
        {
            let mut drag = Drag::new(handle, subject, origin);
            drag.pull(pos - origin - response.drag_delta(), false);
            session.begin(drag.label());
            self.held = Some(Held { item, drag, refused: None });
        }
    }

    fn hit(&self, pos: Pos2) -> Option<(Item, Handle)> {
        self.spots.iter().find_map(|(item, spots)| Some((*item, super::hit(spots, pos)?)))
    }

    /// Find the handle under the pointer, while none is held; whether there is one.
    pub fn hover(&mut self, response: &Response, session: &mut Session) -> bool {
        let pos = response.hover_pos().filter(|_| response.hovered());
        self.hot = pos.and_then(|pos| self.hit(pos));
        if let Some((_, handle)) = self.hot {
            response.ctx.set_cursor_icon(CursorIcon::Grab);
            handle_hint(handle).clone_into(&mut session.hint);
        }
        self.hot.is_some()
    }

    /// A double click on the handle under the pointer.
    pub fn double_click(&self, session: &mut Session) {
        let Some((item, handle)) = self.hot else { return };
        let Some(subject) = Subject::of(item, session.scene()) else { return };
        match double_clicked(&subject, handle) {
            Some(Edited::To(label, light)) => session.edit(label, |scene| Subject::Light(*light).put(item, scene)),
            Some(Edited::Refused(why)) => why.clone_into(&mut session.hint),
            None => {}
        }
    }

    /// Draw handles and what is refused.
    pub fn paint(&self, projection: &Projection, painter: &Painter) {
        let hot = self.held.as_ref().map(|held| (held.item, held.drag.handle())).or(self.hot);
        for (item, spots) in &self.spots {
            // The probe has its own look.
            let spots: Vec<Spot> = spots.iter().filter(|spot| spot.handle != Handle::Probe).cloned().collect();
            super::paint(&spots, hot.filter(|(hot, _)| hot == item).map(|(_, handle)| handle), painter);
        }
        if let Some(Subject::Light(light)) = self.held.as_ref().and_then(|held| held.refused.as_ref()) {
            overlay::paint_outline(light, Stroke::new(2.0, REFUSED), projection, painter);
        }
    }
}

/// The handles of what is selected last, then of the plot in front.
fn spots(session: &Session, projection: &Projection) -> Vec<(Item, Vec<Spot>)> {
    let active = Item::Plot(session.plots.active);
    let items = session.selection.primary().into_iter().filter(|item| *item != active).chain([active]);
    items
        .filter_map(|item| {
            let subject = Subject::of(item, session.scene())?;
            Some((item, super::spots(&subject, session.tool, projection)))
        })
        .collect()
}

fn handle_hint(handle: Handle) -> &'static str {
    match handle {
        Handle::Axis(_) => "Drag to move along this axis",
        Handle::Plane(_) => "Drag to move in this plane",
        Handle::Ring(_) => "Drag to rotate; Ctrl snaps to 15°",
        Handle::Stretch(_) => "Drag to stretch",
        Handle::Scale => "Drag to scale",
        Handle::Vertex(_) => "Drag to move this vertex; double-click deletes it",
        Handle::Edge(_) => "Drag to move this edge; double-click splits it",
        Handle::End(_) => "Drag to move this end",
        Handle::Frame([0, _] | [_, 0]) => "Drag to move this side",
        Handle::Frame(_) => "Drag to move this corner",
        Handle::Radius => "Drag to change the radius",
        Handle::HalfAngle => "Drag to change the half-angle; Ctrl snaps to 5°",
        Handle::Aim => "Drag to where the light comes from; Ctrl snaps to 15°",
        Handle::Probe => "Drag the probe over the surfaces",
    }
}
