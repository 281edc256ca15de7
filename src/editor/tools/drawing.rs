//! Drawing with the mouse and the keyboard.

use egui::text::{CCursor, CCursorRange};
use egui::{Area, Color32, CursorIcon, Event, Frame, Id, Key, Modifiers, Order, Painter, Pos2};
use egui::{Response, TextEdit, Ui, vec2};
use glam::DVec2;

use super::work_plane::{self, PlaneKind};
use super::{Draft, Outcome, Pen, snap, typed};
use crate::editor::session::{Session, Tool};
use crate::editor::viewport::overlay::{self, Cursor};
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;

/// A click this near to a polygon's first vertex closes it, points.
const CLOSING_REACH: f32 = 10.0;
/// A click this near to a polygon's last vertex is the second of a double click, points.
const REPEATED_REACH: f32 = 4.0;
/// A press that is released further away than this was a drag, points.
const LEAST_DRAG: f32 = 6.0;
/// What is typed and what is measured stands so far from the pointer, points.
const BESIDE_POINTER: egui::Vec2 = vec2(16.0, 14.0);

/// What to do where the pointer meets no work plane.
const OFF_PLANE: &str =
    "The work plane is not seen here, or too flatly: Q takes another plane, such as one that faces the view";
/// What to do where the pointer meets no surface.
const OFF_SURFACE: &str = "Point at a surface to draw on it; Q takes another plane";

/// What is being drawn, and where the pointer is on the work plane.
#[derive(Debug, Default)]
pub struct Drawing {
    draft: Draft,
    pen: Option<Pen>,
    cursor: Option<Cursor>,
    typed: Option<Field>,
    /// Where the press was that began the draft, while it is held down.
    pressed: Option<Pos2>,
    /// Why the last input was refused, and where the pointer was.
    refusal: Option<(String, Option<DVec2>)>,
    /// The tool seen last, to drop what another tool has begun.
    tool: Tool,
    /// The press that is still down has done its work.
    spent: bool,
}

/// A dimension being typed.
#[derive(Debug)]
struct Field {
    text: String,
    pos: Pos2,
    /// Shall have the keyboard's focus.
    wants_focus: bool,
}

impl Drawing {
    /// React to this frame's input; whether the press that is still down has done its work.
    pub fn update(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &mut Session,
        solids: &Solids,
        projection: &Projection,
    ) -> bool {
        if self.tool != session.tool {
            *self = Self { tool: session.tool, ..Self::default() };
        }
        self.cursor = None;
        self.spent = false;
        if session.tool.draws() {
            let outcome = self.draw(ui, response, session, solids, projection);
            self.take(outcome, session);
            session.hint = self.hint(response, session);
        }
        // Whatever view it is in.
        session.is_drawing = !self.draft.is_empty();
        self.spent
    }

    fn draw(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &mut Session,
        solids: &Solids,
        projection: &Projection,
    ) -> Outcome {
        let pos = response.hover_pos().or_else(|| response.interact_pointer_pos());
        if let Some(pos) = pos
            && self.draft.is_empty()
            && session.work_plane.kind == PlaneKind::Surface
            && let Some((index, hit)) = solids.nearest(&projection.ray(pos))
        {
            let frame = work_plane::Frame::tangent(&solids.source()[index], &hit, &projection.ray(pos));
            session.work_plane.tangent = Some(frame);
        }
        let canvas = session.work_plane.canvas(projection.camera());
        self.pen = canvas.map(|canvas| Pen { tool: session.tool, outline: session.outline, canvas });
        let Some(pen) = self.pen else { return self.keys(ui, session, None) };
        let modifiers = ui.input(|input| input.modifiers);
        self.cursor = pos.and_then(|pos| self.locate(&pen, pos, session, modifiers, projection));
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
        }
        match self.type_dimension(ui, response, &pen) {
            Outcome::Drawing if self.typed.is_none() => {}
            outcome => return outcome,
        }
        match self.keys(ui, session, Some(&pen)) {
            Outcome::Drawing => self.mouse(ui, response, &pen, modifiers, projection),
            outcome => outcome,
        }
    }

    /// The point of the work plane under the pointer: the first vertex where a click would close, else on a corner, in a
    /// direction or on the grid, as far as these are wanted.
    fn locate(
        &self,
        pen: &Pen,
        pos: Pos2,
        session: &Session,
        modifiers: Modifiers,
        projection: &Projection,
    ) -> Option<Cursor> {
        let frame = &pen.canvas.frame;
        let free = frame.meet(&projection.ray(pos))?;
        let plain = |at| Cursor { pos, at, on_first: false, corner: None };
        if let Some(first) = self.first_under(pen, pos, projection) {
            return Some(Cursor { on_first: true, ..plain(first) });
        }
        let plane = &session.work_plane;
        let step = work_plane::sticks(plane, modifiers.command).then_some(plane.grid);
        if let Some(last) = self.draft.last().filter(|_| modifiers.shift) {
            return Some(plain(snap::constrained(last, free, step)));
        }
        let caught = plane.to_corners.then(|| snap::corner(session.scene(), frame, projection, pos, free)).flatten();
        if let Some(caught) = caught {
            return Some(Cursor { corner: Some(caught.corner), ..plain(caught.at) });
        }
        Some(plain(step.map_or(free, |step| work_plane::snapped(free, step))))
    }

    /// A polygon's first vertex, where a click would close it.
    fn first_under(&self, pen: &Pen, pos: Pos2, projection: &Projection) -> Option<DVec2> {
        let Draft::Polygon(polygon) = &self.draft else { return None };
        let first = *polygon.vertices().first().filter(|_| polygon.vertices().len() >= 3)?;
        let on_screen = projection.project(pen.canvas.frame.point(first))?;
        (on_screen.distance(pos) <= CLOSING_REACH).then_some(first)
    }

    /// Presses, drags, releases and double clicks.
    fn mouse(
        &mut self,
        ui: &Ui,
        response: &Response,
        pen: &Pen,
        modifiers: Modifiers,
        projection: &Projection,
    ) -> Outcome {
        let (press, release) = ui.input(|input| (input.pointer.primary_pressed(), input.pointer.primary_released()));
        let Some(cursor) = self.cursor.filter(|_| !modifiers.alt) else { return Outcome::Drawing };
        if response.double_clicked() && matches!(self.draft, Draft::Polygon(_)) {
            return self.draft.finish(pen);
        }
        if press && response.hovered() {
            self.refusal = None;
            let last = self.draft.last().and_then(|last| projection.project(pen.canvas.frame.point(last)));
            let repeated = last.is_some_and(|last| last.distance(cursor.pos) <= REPEATED_REACH) && !cursor.on_first;
            if repeated {
                return Outcome::Drawing;
            }
            self.pressed = self.draft.is_empty().then_some(cursor.pos);
            return self.draft.click(pen, cursor.at, cursor.on_first);
        }
        if release
            && let Some(pressed) = self.pressed.take()
            && matches!(self.draft, Draft::Span(_))
            && pressed.distance(cursor.pos) > LEAST_DRAG
        {
            return self.draft.click(pen, cursor.at, false);
        }
        Outcome::Drawing
    }

    /// Enter, Backspace and Esc.
    fn keys(&mut self, ui: &Ui, session: &mut Session, pen: Option<&Pen>) -> Outcome {
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
            self.refusal = None;
            self.draft.take_back();
        }
        match pen {
            Some(pen) if !self.draft.is_empty() && pressed(Key::Enter) => self.draft.finish(pen),
            _ => Outcome::Drawing,
        }
    }

    /// A digit opens a field at the pointer for the next length, direction or size; Enter takes it, Esc drops it.
    fn type_dimension(&mut self, ui: &Ui, response: &Response, pen: &Pen) -> Outcome {
        if self.typed.is_none()
            && !self.draft.is_empty()
            && !ui.ctx().text_edit_focused()
            && let Some(text) = ui.input(|input| typed_text(&input.events))
        {
            let pos = self.cursor.map_or(response.rect.center(), |cursor| cursor.pos) + BESIDE_POINTER;
            self.typed = Some(Field { text, pos, wants_focus: true });
        }
        let Some(mut field) = self.typed.take() else { return Outcome::Drawing };
        field.show(ui, response.id.with("typed"));
        let pressed = |key| ui.input_mut(|input| input.consume_key(Modifiers::NONE, key));
        if pressed(Key::Escape) {
            self.refusal = None;
            self.spent = true;
            return Outcome::Drawing;
        }
        let toward = self.cursor.map(|cursor| cursor.at).or(self.draft.last()).unwrap_or_default();
        let point = self.draft.typed(pen, &field.text, toward);
        if let (Ok(at), Some(cursor)) = (&point, &mut self.cursor) {
            *cursor = Cursor { at: *at, on_first: false, corner: None, ..*cursor };
        }
        if ui.input(|input| input.pointer.primary_pressed()) {
            // A click takes what is shown.
            return Outcome::Drawing;
        }
        if !pressed(Key::Enter) {
            self.typed = Some(field);
            return Outcome::Drawing;
        }
        ui.ctx().request_repaint();
        let outcome = match point {
            Ok(at) => self.draft.click(pen, at, false),
            Err(why) => Outcome::Refused(why),
        };
        match outcome {
            Outcome::Refused(_) => self.typed = Some(Field { wants_focus: true, ..field }),
            Outcome::Drawing | Outcome::Done(_) => self.spent = true,
        }
        outcome
    }

    /// Add what is done to the document; remember why something was refused.
    fn take(&mut self, outcome: Outcome, session: &mut Session) {
        match outcome {
            Outcome::Drawing => {}
            Outcome::Refused(why) => self.refusal = Some((why, self.cursor.map(|cursor| cursor.at))),
            Outcome::Done(light) => {
                session.add_light(*light);
                session.tool = Tool::Move;
                self.refusal = None;
                self.spent = true;
            }
        }
    }

    /// What the mouse would do now, or why it did not.
    fn hint(&self, response: &Response, session: &Session) -> String {
        // Once the pointer has moved on, what was refused there is past.
        let here = |at: &Option<DVec2>| self.typed.is_some() || *at == self.cursor.map(|cursor| cursor.at);
        if let Some((why, _)) = self.refusal.as_ref().filter(|(_, at)| here(at)) {
            return why.clone();
        }
        if let (Draft::Polygon(polygon), Some(cursor)) = (&self.draft, self.cursor) {
            let fault = if cursor.on_first { polygon.closing_fault() } else { polygon.edge_fault(cursor.at) };
            if let Some(fault) = fault.filter(|_| Some(cursor.at) != self.draft.last()) {
                return fault.to_string();
            }
        }
        if response.hovered() && self.cursor.is_none() {
            let on_surface = session.work_plane.kind == PlaneKind::Surface;
            return if on_surface { OFF_SURFACE } else { OFF_PLANE }.to_owned();
        }
        hint(session.tool, &self.draft).to_owned()
    }

    /// Paint the work plane and what is being drawn.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        let Some(pen) = self.pen.filter(|_| session.tool.draws()) else { return };
        if let Some(at) = self.cursor.map(|cursor| cursor.at).or(self.draft.last()) {
            overlay::paint_work_plane(&session.work_plane, &pen.canvas.frame, at, projection, painter);
        }
        overlay::paint_draft(&self.draft, &pen, self.cursor, self.typed.is_none(), accent, projection, painter);
    }
}

impl Field {
    /// Show the field and read what is typed into it.
    fn show(&mut self, ui: &Ui, id: Id) {
        let area = Area::new(id).order(Order::Foreground).fixed_pos(self.pos).interactable(false);
        area.show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).inner_margin(3).show(ui, |ui| {
                let edit = TextEdit::singleline(&mut self.text).id(id.with("text")).desired_width(96.0);
                let response = ui.add(edit);
                if std::mem::take(&mut self.wants_focus) {
                    response.request_focus();
                    let mut state = egui::text_edit::TextEditState::load(ui.ctx(), response.id).unwrap_or_default();
                    state.cursor.set_char_range(Some(CCursorRange::one(CCursor::end_of_str(&self.text))));
                    state.store(ui.ctx(), response.id);
                }
                response.accessible_name("Typed dimension");
            });
        });
    }
}

/// What was typed in a frame, where it begins a dimension.
fn typed_text(events: &[Event]) -> Option<String> {
    let text: String = events
        .iter()
        .filter_map(|event| if let Event::Text(text) = event { Some(text.as_str()) } else { None })
        .collect();
    text.starts_with(typed::begins).then_some(text)
}

fn hint(tool: Tool, draft: &Draft) -> &'static str {
    match (tool, draft) {
        (Tool::Polygon, Draft::Polygon(_)) => {
            "Click or type a length adds a corner; Enter, double-click or the first corner closes; Backspace takes back; \
             Shift keeps to 15°; Esc cancels"
        }
        (Tool::Polygon, _) => "Click the first corner of a polygon; Ctrl switches grid snap; Q takes another plane",
        (Tool::Line, Draft::Span(_)) => "Click the other end, or type 1.5 or 1.5<30; Shift keeps to 15°; Esc cancels",
        (Tool::Line, _) => "Click one end of a line; Ctrl switches grid snap; Q takes another plane",
        (Tool::Sphere, Draft::Span(_)) => "Release or click to set the radius, or type it; Esc cancels",
        (Tool::Sphere, _) => "Press at the centre of a sphere and drag its radius; Q takes another plane",
        (Tool::Textured, Draft::Span(_)) => "Release or click at the other corner, or type 1.2x0.8; Esc cancels",
        (Tool::Textured, _) => "Press at one corner of a textured light and drag to the other; Q takes another plane",
        (Tool::Outline, Draft::Span(_)) => {
            "Release or click to set the size, or type it; Shift keeps to 15°; Esc cancels"
        }
        (Tool::Outline, _) => "Press and drag to make the outline chosen in the bar; Q takes another plane",
        (Tool::Move | Tool::Rotate | Tool::Scale | Tool::Aim | Tool::Place(_), _) => "",
    }
}
