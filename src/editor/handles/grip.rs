//! Handles under the mouse: hovered, taken hold of, dragged, let go.

use egui::{
    Align2, Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Stroke, Ui, Vec2, vec2,
};

use super::drag::Drag;
use super::frame::{Frame, selected};
use super::subject::Subject;
use super::{AXIS_COLORS, Handle, Spot, hints, probe};
use crate::editor::session::{Item, Session};
use crate::editor::tools::snap;
use crate::editor::viewport::overlay::{self, REFUSED};
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;

/// Grid spacing that Ctrl snaps to where the work plane has none, metres.
const DEFAULT_GRID: f64 = 0.1;
/// Where readouts are, from the cursor, points.
pub(super) const READOUT: Vec2 = vec2(16.0, 14.0);
/// A line along the axis that something is moved along reaches this far both ways, in lengths of what is seen.
const GUIDE: f64 = 2.0;

/// The handles on screen, and what the pointer does with them.
#[derive(Debug, Default)]
pub struct Grip {
    /// Those on what is selected, and what their drags act on.
    selection: Option<Selection>,
    /// Those of the probe of the plot in front.
    probe: Option<(Item, Vec<Spot>)>,
    hot: Option<(Item, Handle)>,
    held: Option<Held>,
}

/// What is selected and its handles.
#[derive(Debug)]
struct Selection {
    frame: Frame,
    subjects: Vec<(Item, Subject)>,
    spots: Vec<Spot>,
}

/// A handle held down.
#[derive(Debug)]
struct Held {
    drag: Drag,
    frame: Frame,
    label: &'static str,
    refused: Option<Subject>,
    /// What is said at the cursor, and where that is.
    readout: String,
    pos: Option<Pos2>,
}

/// How a frame of holding ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holding {
    /// No handle is held.
    Nothing,
    /// One is.
    Held,
    /// One was, and a key has ended that; the button may still be down.
    Ended,
}

impl Grip {
    /// Whether a handle is held.
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// Whether a probe is being dragged.
    pub fn holds_probe(&self) -> bool {
        self.held.as_ref().is_some_and(|held| matches!(held.drag.handle(), Handle::Probe | Handle::Normal))
    }

    /// The handle under the pointer.
    pub fn hot(&self) -> Option<(Item, Handle)> {
        self.hot
    }

    /// No handles are shown.
    pub fn hide(&mut self) {
        self.hot = None;
        self.selection = None;
        self.probe = None;
    }

    /// Lay the handles out anew: those on what is selected, and the probe of the plot in front.
    pub fn lay_out(&mut self, session: &Session, solids: &Solids, projection: &Projection) {
        let subjects = selected(session);
        self.selection = Frame::new(session.transform, session.tool, &subjects).map(|frame| {
            let spots = super::spots(&frame, &subjects, session.tool, projection, solids);
            Selection { frame, subjects, spots }
        });
        let plot = Item::Plot(session.plots.active);
        let has_handles = session.selection.primary() == Some(plot);
        let in_front = session.scene().plots.get(session.plots.active).filter(|_| !has_handles);
        self.probe = in_front.map(|shown| (plot, probe::spots(shown, projection)));
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
        self.take(ui, response, session);
        let Some(held) = &mut self.held else { return Holding::Nothing };
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            session.abort();
            self.held = None;
            return Holding::Ended;
        }
        if !session.history.in_gesture() {
            // Undo, or something else that ends gestures, came in between.
            self.held = None;
            return Holding::Nothing;
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        let entered = !ui.ctx().text_edit_focused() && held.drag.typed.take(ui);
        held.follow(ui, response, session, solids, projection);
        let ends = entered || !response.dragged();
        if ends {
            session.commit();
            self.held = None;
        }
        match (ends, entered) {
            (true, true) => Holding::Ended,
            (true, false) => Holding::Nothing,
            (false, _) => Holding::Held,
        }
    }

    /// Begin a drag where one starts on a handle.
    fn take(&mut self, ui: &Ui, response: &Response, session: &mut Session) {
        let (modifiers, origin, pos) =
            ui.input(|input| (input.modifiers, input.pointer.press_origin(), input.pointer.interact_pos()));
        if response.drag_started_by(PointerButton::Primary)
            && !modifiers.alt
            && let (Some(origin), Some(pos)) = (origin, pos)
            && let Some((item, handle)) = self.hit(origin)
        {
            let subjects = match &self.selection {
                Some(selection) if handle.is_transform() => selection.subjects.clone(),
                _ => Subject::of(item, session.scene()).map(|subject| (item, subject)).into_iter().collect(),
            };
            let Some(frame) = self
                .selection
                .as_ref()
                .filter(|_| handle.is_transform())
                .map(|selection| selection.frame)
                .or_else(|| Frame::new(session.transform, session.tool, &subjects))
            else {
                return;
            };
            let corners = snap::corners(session.scene(), Some(item));
            let mut drag = Drag::new(handle, frame, subjects, origin).among(corners);
            drag.pull(pos - origin - response.drag_delta(), false);
            let label = label(handle);
            session.begin(label);
            self.held = Some(Held { drag, frame, label, refused: None, readout: String::new(), pos: None });
        }
    }

    fn hit(&self, pos: Pos2) -> Option<(Item, Handle)> {
        let of_selection = self.selection.as_ref().and_then(|selection| {
            let (item, _) = selection.subjects.last()?;
            Some((*item, super::hit(&selection.spots, pos)?))
        });
        let of_probe = || self.probe.as_ref().and_then(|(item, spots)| Some((*item, super::hit(spots, pos)?)));
        of_selection.or_else(of_probe)
    }

    /// Find the handle under the pointer, while none is held; whether there is one.
    pub fn hover(&mut self, response: &Response, session: &mut Session) -> bool {
        let pos = response.hover_pos().filter(|_| response.hovered());
        self.hot = pos.and_then(|pos| self.hit(pos));
        if let Some((_, handle)) = self.hot {
            response.ctx.set_cursor_icon(CursorIcon::Grab);
            session.hint = hints::of_handle(handle);
        }
        self.hot.is_some()
    }

    /// Draw handles, what is refused, and what is said at the cursor.
    pub fn paint(&self, projection: &Projection, painter: &Painter) {
        let hot = self.held.as_ref().map(|held| held.drag.handle()).or(self.hot.map(|(_, handle)| handle));
        if let Some(held) = &self.held {
            held.paint_guide(projection, painter);
        }
        if let Some(selection) = &self.selection {
            super::paint(&selection.spots, hot, painter);
        }
        if let Some((_, spots)) = &self.probe {
            // The probe has its own look, but where the pointer is.
            let spots: Vec<Spot> = spots.iter().filter(|spot| hot == Some(spot.handle)).cloned().collect();
            super::paint(&spots, hot, painter);
        }
        if let Some(held) = &self.held {
            held.paint(projection, painter);
        }
    }
}

impl Held {
    /// Change the document as the pointer has it.
    fn follow(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &mut Session,
        solids: &Solids,
        projection: &Projection,
    ) {
        let modifiers = ui.input(|input| input.modifiers);
        let grid = if session.work_plane.grid > 0.0 { session.work_plane.grid } else { DEFAULT_GRID };
        session.hint = hints::while_held(self.drag.handle(), grid);
        let by = if response.dragged() { response.drag_delta() } else { Vec2::ZERO };
        self.drag.pull(by, modifiers.shift);
        self.pos = response.interact_pointer_pos();
        let Some(outcome) = self.drag.change(projection, solids, modifiers.command.then_some(grid)) else {
            "This is seen too flatly to be dragged there: orbit the view".clone_into(&mut session.hint);
            return;
        };
        if outcome.refused.is_some() {
            "Edges may not cross".clone_into(&mut session.hint);
        }
        self.readout = match self.drag.typed.text() {
            "" => outcome.readout,
            typed => format!("{}   = {typed}", outcome.readout),
        };
        self.refused = outcome.refused;
        let scene = session.scene();
        let is_new = |(item, now): &(Item, Subject)| Subject::of(*item, scene).is_some_and(|was| was != *now);
        if outcome.now.iter().any(is_new) {
            session.edit(self.label, |scene| outcome.now.into_iter().for_each(|(item, now)| now.put(item, scene)));
        }
    }

    /// The axis that things are moved or stretched along.
    fn paint_guide(&self, projection: &Projection, painter: &Painter) {
        let (Handle::Axis(axis) | Handle::Stretch(axis)) = self.drag.handle() else { return };
        let reach =
            GUIDE * projection.metres_per_point(self.frame.origin) * f64::from(projection.rect().size().length());
        let along = reach * self.frame.axes.col(axis);
        if let Some(line) = projection.segment(self.frame.origin - along, self.frame.origin + along) {
            painter.line_segment(line, Stroke::new(1.0, AXIS_COLORS[axis].gamma_multiply(0.6)));
        }
    }

    fn paint(&self, projection: &Projection, painter: &Painter) {
        if let Some(Subject::Light(light)) = &self.refused {
            overlay::paint_outline(light, Stroke::new(2.0, REFUSED), projection, painter);
        }
        if let Some(pos) = self.pos.filter(|_| !self.readout.is_empty()) {
            overlay::label(&self.readout, pos + READOUT, Align2::LEFT_TOP, Color32::WHITE, painter);
        }
    }
}

/// What an undo step made by dragging a handle is called.
fn label(handle: Handle) -> &'static str {
    match handle {
        Handle::Axis(_) | Handle::Plane(_) | Handle::Screen => "Move",
        Handle::Ring(_) | Handle::ScreenRing => "Rotate",
        Handle::Stretch(_) | Handle::Scale => "Scale",
        Handle::Vertex(_) => "Move vertex",
        Handle::Edge(_) => "Move edge",
        Handle::End(_) => "Move end",
        Handle::Side(_) => "Change size",
        Handle::Radius => "Change radius",
        Handle::HalfAngle => "Change half-angle",
        Handle::Control(_) => "Move control point",
        Handle::Aim | Handle::Target => "Aim",
        Handle::Probe => "Move probe",
        Handle::Normal => "Turn probe",
    }
}
