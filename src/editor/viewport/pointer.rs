//! What the mouse and the keyboard do in the viewport: navigate, draw, drag handles, select.

use egui::{Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Stroke, Ui, Vec2};

use super::navigate;
use super::overlay::{self, Cursor, REFUSED};
use super::pick::{self, Solids};
use super::projection::Projection;
use crate::editor::handles::drag::{Change, Drag};
use crate::editor::handles::subject::Subject;
use crate::editor::handles::{self, Handle, Spot};
use crate::editor::session::{Item, Session, Tool, WorkPlane};
use crate::editor::tools::{Draft, Outcome, work_plane};
use crate::light::Shape;

/// Zoom per point of scrolling: a notch of 50 points is a factor of 0.88.
const ZOOM_PER_POINT: f32 = 0.0025;
/// A click this near to a polygon's first vertex closes it, points.
const CLOSING_REACH: f32 = 10.0;
/// Grid spacing that Ctrl snaps to where the work plane has none, metres.
const DEFAULT_GRID: f64 = 0.1;

/// What to do where the pointer meets no work plane.
const OFF_PLANE: &str = "The work plane is not seen here, or too flatly: orbit the view or change its height";

/// What the pointer is doing.
#[derive(Debug, Default)]
pub struct Pointer {
    draft: Draft,
    cursor: Option<Cursor>,
    held: Option<Held>,
    spots: Vec<(Item, Vec<Spot>)>,
    hot: Option<(Item, Handle)>,
    hovered: Option<Item>,
    navigating: bool,
    /// The press that is still down has done its work: its release is not a click.
    spent: bool,
    /// Why the last click was refused.
    refusal: Option<&'static str>,
    /// The tool seen last, to drop what another tool has begun.
    tool: Tool,
}

/// A handle held down.
#[derive(Debug)]
struct Held {
    item: Item,
    drag: Drag,
    refused: Option<Subject>,
}

impl Pointer {
    /// Whether something is dragged, be it a handle, a sphere's radius or the camera.
    pub fn is_dragging(&self) -> bool {
        self.held.is_some() || self.navigating
    }

    /// What a click would select.
    pub fn hovered(&self) -> Option<Item> {
        self.hovered
    }

    /// Whether a probe is being dragged.
    pub fn holds_probe(&self) -> bool {
        self.held.as_ref().is_some_and(|held| held.drag.handle() == Handle::Probe)
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
            self.hot = None;
            self.spots.clear();
            self.draw(ui, response, session, &projection);
            return;
        }
        self.spots = if handles { spots(session, &projection) } else { Vec::new() };
        self.hold(ui, response, session, solids, &projection);
        if self.held.is_none() && !self.navigating {
            self.hover(response, session, solids, &projection);
            if response.clicked() && !was_spent && self.hot.is_none_or(|(_, handle)| handle == Handle::Probe) {
                let item = self.hot.map(|(item, _)| item).or(self.hovered);
                select(session, item, ui.input(|input| input.modifiers));
            }
            self.double_click(response, session);
        }
    }

    /// Orbit, pan and zoom.
    fn navigate(&mut self, ui: &Ui, response: &Response, session: &mut Session) {
        let (modifiers, scroll, pinch) =
            ui.input(|input| (input.modifiers, input.smooth_scroll_delta().y, input.zoom_delta()));
        let by_middle = response.dragged_by(PointerButton::Middle);
        let by_alt = response.dragged_by(PointerButton::Primary) && modifiers.alt && self.held.is_none();
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
            && self.held.is_none()
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

    /// Take hold of a handle, drag it, let it go.
    fn hold(&mut self, ui: &Ui, response: &Response, session: &mut Session, solids: &Solids, projection: &Projection) {
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
        let Some(held) = &mut self.held else { return };
        if ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape)) {
            session.abort();
            self.held = None;
            self.spent = true;
            return;
        }
        if !session.history.in_gesture() {
            // Undo, or something else that ends gestures, came in between.
            self.held = None;
            return;
        }
        ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
        session.hint = "Ctrl snaps to the grid, Shift drags fine, Esc cancels".to_owned();
        let grid = session.work_plane.grid;
        let snap = modifiers.command.then_some(if grid > 0.0 { grid } else { DEFAULT_GRID });
        let by = if response.dragged() { response.drag_delta() } else { Vec2::ZERO };
        held.drag.pull(by, modifiers.shift);
        let under = |ray: &super::ray::Ray| solids.nearest(ray).map(|(_, hit)| hit);
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
    }

    fn hit(&self, pos: Pos2) -> Option<(Item, Handle)> {
        self.spots.iter().find_map(|(item, spots)| Some((*item, handles::hit(spots, pos)?)))
    }

    /// What the pointer is over, while nothing is held.
    fn hover(&mut self, response: &Response, session: &mut Session, solids: &Solids, projection: &Projection) {
        self.hot = None;
        let Some(pos) = response.hover_pos().filter(|_| response.hovered()) else { return };
        self.hot = self.hit(pos);
        if let Some((_, handle)) = self.hot {
            response.ctx.set_cursor_icon(CursorIcon::Grab);
            handle_hint(handle).clone_into(&mut session.hint);
        } else {
            self.hovered = pick::pick(session.scene(), solids, projection, pos);
            session.hint = self
                .hovered
                .and_then(|item| item.name(session.scene()))
                .map_or_else(String::new, |name| format!("Click to select {name}"));
        }
    }

    /// A double click on a polygon's edge splits it, on a vertex takes that away.
    fn double_click(&mut self, response: &Response, session: &mut Session) {
        if !response.double_clicked() {
            return;
        }
        let Some((item, handle)) = self.hot else { return };
        let Some(Subject::Light(mut light)) = Subject::of(item, session.scene()) else { return };
        let Shape::Polygon(polygon) = &mut light.shape else { return };
        let count = polygon.vertices.len();
        let label = match handle {
            Handle::Edge(i) if i < count => {
                polygon.vertices.insert(i + 1, polygon.vertices[i].midpoint(polygon.vertices[(i + 1) % count]));
                "Split edge"
            }
            Handle::Vertex(i) if i < count && count > 3 => {
                polygon.vertices.remove(i);
                "Delete vertex"
            }
            _ => return,
        };
        if crate::editor::tools::polygon::is_simple(&polygon.vertices) {
            session.edit(label, |scene| Subject::Light(light).put(item, scene));
        } else {
            session.hint = "Without this vertex edges would cross".to_owned();
        }
    }

    /// Draw handles, what is refused, and what is being drawn.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        let hot = self.held.as_ref().map(|held| (held.item, held.drag.handle())).or(self.hot);
        for (item, spots) in &self.spots {
            // The probe has its own look.
            let spots: Vec<Spot> = spots.iter().filter(|spot| spot.handle != Handle::Probe).cloned().collect();
            handles::paint(&spots, hot.filter(|(hot, _)| hot == item).map(|(_, handle)| handle), painter);
        }
        if let Some(Subject::Light(light)) = self.held.as_ref().and_then(|held| held.refused.as_ref()) {
            overlay::paint_outline(light, Stroke::new(2.0, REFUSED), projection, painter);
        }
        if session.tool.draws() {
            if let Some(cursor) = self.cursor {
                overlay::paint_work_plane(&session.work_plane, cursor.at, projection, painter);
            }
            overlay::paint_draft(&self.draft, self.cursor, session.work_plane.height, accent, projection, painter);
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
            Some((item, handles::spots(&subject, session.tool, projection)))
        })
        .collect()
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
