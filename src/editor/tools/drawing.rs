//! Drawing with the mouse and the keyboard.

use egui::{Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Ui};

use super::{Draft, Outcome, work_plane};
use crate::editor::session::{Session, Tool, WorkPlane};
use crate::editor::viewport::overlay::{self, Cursor};
use crate::editor::viewport::projection::Projection;

/// A click this near to a polygon's first vertex closes it, points.
const CLOSING_REACH: f32 = 10.0;

/// What to do where the pointer meets no work plane.
const OFF_PLANE: &str = "The work plane is not seen here, or too flatly: orbit the view or change its height";

/// What is being drawn, and where the pointer is on the work plane.
#[derive(Debug, Default)]
pub struct Drawing {
    draft: Draft,
    cursor: Option<Cursor>,
    /// Why the last click was refused.
    refusal: Option<&'static str>,
    /// The tool seen last, to drop what another tool has begun.
    tool: Tool,
    /// The press that is still down has done its work.
    spent: bool,
}

impl Drawing {
    /// React to this frame's input; whether the press that is still down has done its work.
    pub fn update(&mut self, ui: &Ui, response: &Response, session: &mut Session, projection: &Projection) -> bool {
        if self.tool != session.tool {
            self.draft.cancel();
            self.refusal = None;
            self.tool = session.tool;
        }
        self.cursor = None;
        self.spent = false;
        if session.tool.draws() {
            self.draw(ui, response, session, projection);
        }
        self.spent
    }

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

    /// Paint the work plane and what is being drawn.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        if session.tool.draws() {
            if let Some(cursor) = self.cursor {
                overlay::paint_work_plane(&session.work_plane, cursor.at, projection, painter);
            }
            overlay::paint_draft(&self.draft, self.cursor, session.work_plane.height, accent, projection, painter);
        }
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
        (Tool::Move | Tool::Rotate | Tool::Scale | Tool::Aim | Tool::Place(_), _) => "",
    }
}
