//! What the mouse and the keyboard do in the viewport: navigate, draw, drag handles, select.

use egui::{Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Ui};

use super::navigate;
use super::overlay::{self, Cursor};
use super::pick::{self, Solids};
use super::projection::Projection;
use crate::editor::handles::Handle;
use crate::editor::handles::grip::{Grip, Holding};
use crate::editor::session::{Item, Session, Tool, WorkPlane};
use crate::editor::tools::{Draft, Outcome, work_plane};

/// Zoom per point of scrolling: a notch of 50 points is a factor of 0.88.
const ZOOM_PER_POINT: f32 = 0.0025;
/// A click this near to a polygon's first vertex closes it, points.
const CLOSING_REACH: f32 = 10.0;

/// What to do where the pointer meets no work plane.
const OFF_PLANE: &str = "The work plane is not seen here, or too flatly: orbit the view or change its height";

/// What the pointer is doing.
#[derive(Debug, Default)]
pub struct Pointer {
    draft: Draft,
    cursor: Option<Cursor>,
    grip: Grip,
    hovered: Option<Item>,
    navigating: bool,
    /// The press that is still down has done its work: its release is not a click.
    spent: bool,
    /// Why the last click was refused.
    refusal: Option<&'static str>,
    /// The tool seen last, to drop what another tool has begun.
    tool: Tool,
}

impl Pointer {
    /// Whether something is dragged, be it a handle, a sphere's radius or the camera.
    pub fn is_dragging(&self) -> bool {
        self.grip.is_held() || self.navigating
    }

    /// What a click would select.
    pub fn hovered(&self) -> Option<Item> {
        self.hovered
    }

    /// Whether a probe is being dragged.
    pub fn holds_probe(&self) -> bool {
        self.grip.holds_probe()
    }

    /// React to this frame's input.
    pub fn update(&mut self, ui: &Ui, response: &Response, session: &mut Session, solids: &Solids, handles: bool) {
        if self.tool != session.tool {
            self.draft.cancel();
            self.refusal = None;
            self.tool = session.tool;
        }
        self.navigate(ui, response, session);
        let projection = Projection::new(&session.view.camera, response.rect);
        let was_spent = self.spent;
        if !ui.input(|input| input.pointer.any_down()) {
            self.spent = false;
        }
        self.hovered = None;
        self.cursor = None;
        if session.tool.draws() {
            self.grip.hide();
            self.draw(ui, response, session, &projection);
            return;
        }
        if handles {
            self.grip.lay_out(session, &projection);
        } else {
            self.grip.hide();
        }
        self.spent |= self.grip.hold(ui, response, session, solids, &projection) == Holding::Cancelled;
        if !self.grip.is_held() && !self.navigating {
            if !self.grip.hover(response, session) {
                self.hover(response, session, solids, &projection);
            }
            let hot = self.grip.hot();
            if response.clicked() && !was_spent && hot.is_none_or(|(_, handle)| handle == Handle::Probe) {
                let item = hot.map(|(item, _)| item).or(self.hovered);
                select(session, item, ui.input(|input| input.modifiers));
            }
            if response.double_clicked() {
                self.grip.double_click(session);
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
            && zoom != 1.0
        {
            session.view.camera = navigate::zoomed(&projection, pos, f64::from(zoom));
        }
    }

    /// Draw with a drawing tool.
    fn draw(&mut self, ui: &Ui, response: &Response, session: &mut Session, projection: &Projection) {
        let plane = session.work_plane;
        let (modifiers, press, origin) =
            ui.input(|input| (input.modifiers, input.pointer.primary_pressed(), input.pointer.press_origin()));
        let snap = work_plane::sticks(&plane, modifiers.command);
        let point = |pos: Pos2| work_plane::point_at(&projection.ray(pos), &plane, snap);
        self.cursor = response
            .hover_pos()
            .or_else(|| response.interact_pointer_pos())
            .and_then(|pos| Some(Cursor { pos, at: point(pos)?, on_first: self.on_first(pos, &plane, projection) }));
        if press {
            self.refusal = None;
        }
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        let mut outcome = self.keys(ui, session);
        if let Some(cursor) = self.cursor {
            let drawing = !modifiers.alt;
            if press && response.hovered() && drawing && session.tool != Tool::Sphere {
                outcome = self.draft.click(session.tool, cursor.at, cursor.on_first, plane.height);
            }
            if response.double_clicked() && drawing {
                outcome = self.draft.finish(plane.height);
            }
            if response.dragged_by(PointerButton::Primary)
                && drawing
                && let Some(pressed) = origin.and_then(point)
            {
                self.draft.drag(session.tool, pressed, cursor.at);
            }
        }
        if response.drag_stopped_by(PointerButton::Primary) {
            outcome = self.draft.release(plane.height);
        }
        match outcome {
            Outcome::Drawing => {}
            Outcome::Refused(why) => self.refusal = Some(why),
            Outcome::Done(light) => {
                session.add_light(*light);
                session.tool = Tool::Move;
                self.spent = true;
            }
        }
        let off_plane = (response.hovered() && self.cursor.is_none()).then_some(OFF_PLANE);
        session.hint = self.refusal.or(off_plane).unwrap_or(hint(session.tool, &self.draft)).to_owned();
    }

    /// Enter, Backspace and Esc while drawing.
    fn keys(&mut self, ui: &Ui, session: &mut Session) -> Outcome {
        if ui.ctx().text_edit_focused() {
            return Outcome::Drawing;
        }
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) {
            if self.draft.is_empty() {
                session.tool = Tool::Move;
            }
            self.draft.cancel();
            self.refusal = None;
            self.spent = true;
        }
        if !self.draft.is_empty() && pressed(Key::Backspace) {
            self.draft.take_back();
        }
        if !self.draft.is_empty() && pressed(Key::Enter) {
            return self.draft.finish(session.work_plane.height);
        }
        Outcome::Drawing
    }

    fn on_first(&self, pos: Pos2, plane: &WorkPlane, projection: &Projection) -> bool {
        let Draft::Polygon(polygon) = &self.draft else { return false };
        polygon.vertices().len() >= 3
            && polygon
                .vertices()
                .first()
                .and_then(|first| projection.project(first.extend(plane.height)))
                .is_some_and(|first| first.distance(pos) <= CLOSING_REACH)
    }

    /// What the pointer is over, while nothing is held.
    fn hover(&mut self, response: &Response, session: &mut Session, solids: &Solids, projection: &Projection) {
        let Some(pos) = response.hover_pos().filter(|_| response.hovered()) else { return };
        self.hovered = pick::pick(session.scene(), solids, projection, pos);
        session.hint = self
            .hovered
            .and_then(|item| item.name(session.scene()))
            .map_or_else(String::new, |name| format!("Click to select {name}"));
    }

    /// Draw handles, what is refused, and what is being drawn.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        self.grip.paint(projection, painter);
        if session.tool.draws() {
            if let Some(cursor) = self.cursor {
                overlay::paint_work_plane(&session.work_plane, cursor.at, projection, painter);
            }
            overlay::paint_draft(&self.draft, self.cursor, session.work_plane.height, accent, projection, painter);
        }
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

fn hint(tool: Tool, draft: &Draft) -> &'static str {
    match (tool, draft) {
        (Tool::Polygon, Draft::Polygon(_)) => {
            "Click adds a corner; Enter, double-click or the first corner closes; Backspace takes back; Esc cancels"
        }
        (Tool::Polygon, _) => "Click the first corner of a polygon; Ctrl switches grid snap",
        (Tool::Line, Draft::Line(_)) => "Click the other end; Esc cancels",
        (Tool::Line, _) => "Click one end of a line; Ctrl switches grid snap",
        (Tool::Sphere, Draft::Sphere(..)) => "Release to set the radius; Esc cancels",
        (Tool::Sphere, _) => "Press at the centre of a sphere and drag its radius",
        (Tool::Move | Tool::Rotate | Tool::Scale, _) => "",
    }
}
