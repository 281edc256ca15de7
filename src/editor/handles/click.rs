//! Aiming and placing lights by pressing the mouse on what they shall light.

use egui::{Align2, Color32, CursorIcon, Key, Modifiers, Painter, PointerButton, Pos2, Response, Shape, Stroke, Ui};
use glam::DVec3;

use super::grip::READOUT;
use super::place::{self, Place};
use super::readout::{direction_text, point_text};
use super::typed::Typed;
use super::{aim, circle};
use crate::editor::session::{Item, Session, Tool};
use crate::editor::viewport::overlay::{self, length_text};
use crate::editor::viewport::pick::{self, Solids};
use crate::editor::viewport::projection::Projection;
use crate::editor::viewport::ray::Ray;
use crate::light::Light;
use crate::shading::ShadingPoint;

/// The ground farther away than this, metres, cannot be pointed at.
const FAR: f64 = 1000.0;
/// Radius of the mark on the surface, screen points.
const MARK: f64 = 11.0;
/// Length of the arrow to where the light would come from, screen points.
const ARROW: f64 = 70.0;
/// Under lines, so that they are seen on any background.
const RIM: Color32 = Color32::from_black_alpha(150);

/// What a press on a surface does to lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Purpose {
    /// They face the point.
    Aim,
    /// One is placed for the point.
    Place(Place),
}

/// The tools that aim and place, under the mouse.
#[derive(Debug, Default)]
pub struct Placing {
    /// What the pointer is on.
    at: Option<ShadingPoint>,
    pos: Option<Pos2>,
    held: Option<Held>,
}

/// A press that is still down.
#[derive(Debug)]
struct Held {
    purpose: Purpose,
    /// The lights as they were.
    start: Vec<(usize, Light)>,
    typed: Typed,
    readout: String,
}

impl Purpose {
    fn of(tool: Tool) -> Option<Self> {
        match tool {
            Tool::Aim => Some(Self::Aim),
            Tool::Place(place) => Some(Self::Place(place)),
            _ => None,
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Aim => "Aim",
            Self::Place(place) => place.label(),
        }
    }

    /// The lights that it acts on: all selected ones are aimed, the one selected last is placed.
    fn targets(self, session: &Session) -> Vec<(usize, Light)> {
        let lights = session.selection.items().iter().filter_map(|item| match *item {
            Item::Light(i) => Some((i, session.scene().lights.get(i)?.clone())),
            _ => None,
        });
        match self {
            Self::Aim => lights.filter(|(_, light)| aim::can_aim(light)).collect(),
            Self::Place(_) => lights.rev().take(1).collect(),
        }
    }

    /// A light after it; `distance` where one was typed.
    fn applied(self, light: &Light, at: &ShadingPoint, distance: Option<f64>) -> Light {
        match self {
            Self::Aim => aim::aimed(light, at.p).unwrap_or_else(|| light.clone()),
            Self::Place(place) => place::placed(light, place, at, distance),
        }
    }

    /// What a press would do to what is selected.
    fn hint(self, session: &Session) -> String {
        let lights = self.targets(session);
        let name = lights.last().map_or("", |(_, light)| light.name.as_str());
        let what = match lights.len() {
            0 if session.selection.items().iter().any(|item| matches!(item, Item::Light(_))) => {
                return "This light shines alike in all directions: select another to aim it; Esc is done".to_owned();
            }
            0 => return format!("Click a light to select it, then {}; Esc is done", self.then()),
            1 => format!("“{name}”"),
            count => format!("{count} lights"),
        };
        let does = match self {
            Self::Aim => format!("Press where {what} shall shine"),
            Self::Place(Place::Highlight) => format!("Press where the highlight of {what} shall be"),
            Self::Place(Place::Diffuse) => format!("Press where {what} shall shine brightest"),
            Self::Place(Place::Rim) => format!("Press near an edge that {what} shall rim from behind"),
        };
        format!("{does}, and drag to follow; Esc is done")
    }

    fn then(self) -> &'static str {
        match self {
            Self::Aim => "press where it shall shine",
            Self::Place(_) => "press where its light shall fall",
        }
    }
}

impl Placing {
    /// Whether the button is held and lights follow.
    pub fn is_held(&self) -> bool {
        self.held.is_some()
    }

    /// React to this frame's input while a tool that aims or places is in hand.
    pub fn update(
        &mut self,
        ui: &Ui,
        response: &Response,
        session: &mut Session,
        solids: &Solids,
        projection: &Projection,
    ) {
        let Some(purpose) = Purpose::of(session.tool) else {
            if self.held.is_some() {
                session.commit();
            }
            *self = Self::default();
            return;
        };
        self.pos = response.hover_pos().or_else(|| response.interact_pointer_pos());
        self.at = self.pos.and_then(|pos| under(&projection.ray(pos), solids));
        if response.hovered() {
            ui.ctx().set_cursor_icon(CursorIcon::Crosshair);
            session.hint = purpose.hint(session);
        }
        if self.keys(ui, session) {
            return;
        }
        let (pressed, down, alt) = ui.input(|input| {
            let pointer = &input.pointer;
            (pointer.primary_pressed(), pointer.button_down(PointerButton::Primary), input.modifiers.alt)
        });
        if pressed && response.contains_pointer() && !alt {
            self.press(purpose, session, solids, projection);
        }
        if let Some(held) = &mut self.held {
            held.follow(self.at.as_ref(), session, solids);
            let entered = !ui.ctx().text_edit_focused() && held.typed.take(ui);
            if entered || !down {
                session.commit();
                self.held = None;
            }
        }
    }

    /// Esc; whether it ends what is under way.
    fn keys(&mut self, ui: &Ui, session: &mut Session) -> bool {
        if self.held.is_some() && !session.history.in_gesture() {
            // Undo, or something else that ends gestures, came in between.
            self.held = None;
        }
        let elsewhere = self.held.is_none() && session.history.in_gesture();
        if elsewhere
            || ui.ctx().text_edit_focused()
            || !ui.input_mut(|input| input.consume_key(Modifiers::NONE, Key::Escape))
        {
            return false;
        }
        if self.held.take().is_some() {
            session.abort();
        } else {
            session.tool = Tool::Move;
            self.at = None;
        }
        true
    }

    /// Take the selected lights, or select the one that is pressed.
    fn press(&mut self, purpose: Purpose, session: &mut Session, solids: &Solids, projection: &Projection) {
        let start = purpose.targets(session);
        if start.is_empty() {
            let picked = self.pos.and_then(|pos| pick::pick(session.scene(), solids, projection, pos));
            session.selection.set(picked.filter(|item| matches!(item, Item::Light(_))));
        } else if self.at.is_some() {
            session.begin(purpose.label());
            self.held = Some(Held { purpose, start, typed: Typed::default(), readout: String::new() });
        }
    }

    /// Draw where the pointer is on the surface, and what the lights do about it.
    pub fn paint(&self, session: &Session, accent: Color32, projection: &Projection, painter: &Painter) {
        let (Some(purpose), Some(at)) = (Purpose::of(session.tool), &self.at) else { return };
        let metres = projection.metres_per_point(at.p);
        let (u, v) = at.n.any_orthonormal_pair();
        lines(&circle(at.p, MARK * metres * u, MARK * metres * v, projection), accent, painter);
        for (i, light) in purpose.targets(session) {
            let now = session.scene().lights.get(i).unwrap_or(&light);
            match purpose {
                Purpose::Place(place) if self.held.is_none() || aim::is_far(now) => {
                    let direction = place.direction(at);
                    let line = projection.segment(at.p, at.p + ARROW * metres * direction);
                    lines(line.as_slice(), accent, painter);
                }
                _ => {
                    let line = projection.segment(at.p, aim::center(now));
                    lines(line.as_slice(), accent, painter);
                }
            }
        }
        if let (Some(held), Some(pos)) = (&self.held, self.pos) {
            overlay::label(&held.readout, pos + READOUT, Align2::LEFT_TOP, Color32::WHITE, painter);
        }
    }
}

impl Held {
    /// The lights as the point has them.
    fn follow(&mut self, at: Option<&ShadingPoint>, session: &mut Session, solids: &Solids) {
        let Some(at) = at else {
            "There is no surface here".clone_into(&mut session.hint);
            return;
        };
        let distance = self.typed.numbers().first().copied();
        let now: Vec<(usize, Light)> =
            self.start.iter().map(|(i, light)| (*i, self.purpose.applied(light, at, distance))).collect();
        session.hint = self.hint(&now, at, solids);
        self.readout = self.told(&now, at);
        if now.iter().any(|(i, light)| session.scene().lights.get(*i).is_some_and(|was| was != light)) {
            session.edit(self.purpose.label(), |scene| {
                for (i, light) in now {
                    if let Some(slot) = scene.lights.get_mut(i) {
                        *slot = light;
                    }
                }
            });
        }
    }

    fn hint(&self, now: &[(usize, Light)], at: &ShadingPoint, solids: &Solids) -> String {
        let blocked = |light: &Light| !aim::is_far(light) && solids.hide(at.p, aim::center(light));
        if now.iter().any(|(_, light)| blocked(light)) {
            return "Something stands between the light and this point".to_owned();
        }
        match self.purpose {
            Purpose::Aim => "Drag to follow, release to set; Esc cancels".to_owned(),
            Purpose::Place(_) => {
                "Drag to follow, type a distance in m, release or Enter to set; Esc cancels".to_owned()
            }
        }
    }

    /// Where the point is, or how far the light is from it.
    fn told(&self, now: &[(usize, Light)], at: &ShadingPoint) -> String {
        let text = match (self.purpose, now) {
            (Purpose::Place(place), [(_, light)]) if aim::is_far(light) => direction_text(place.direction(at)),
            (Purpose::Place(_), [(_, light)]) => length_text(aim::center(light).distance(at.p)),
            _ => point_text(at.p),
        };
        match self.typed.text() {
            "" => text,
            typed => format!("{text}   = {typed}"),
        }
    }
}

/// The surface under the pointer, else the ground, with its normal towards the eye.
fn under(ray: &Ray, solids: &Solids) -> Option<ShadingPoint> {
    let on_surface = solids.nearest(ray).map(|(_, hit)| (hit.p, hit.n));
    let on_ground = || ray.plane_distance(DVec3::ZERO, DVec3::Z).filter(|t| *t < FAR).map(|t| (ray.at(t), DVec3::Z));
    let (p, n) = on_surface.or_else(on_ground)?;
    let v = -ray.direction;
    Some(ShadingPoint { p, n: if n.dot(v) < 0.0 { -n } else { n }, v })
}

/// Lines in one colour, rimmed.
fn lines(pieces: &[[Pos2; 2]], color: Color32, painter: &Painter) {
    for (width, color) in [(3.5, RIM), (1.75, color)] {
        painter.extend(pieces.iter().map(|piece| Shape::line_segment(*piece, Stroke::new(width, color))));
    }
}
