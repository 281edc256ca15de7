//! What things become while one of their handles is dragged.

use egui::{Pos2, Vec2};
use glam::DVec3;

use super::amount::Amount;
use super::frame::Frame;
use super::pull::Pull;
use super::subject::Subject;
use super::typed::Typed;
use super::{Handle, aim, probe, readout, reshape, vertices};
use crate::editor::session::Item;
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;

/// How much slower a fine drag is.
const FINE: f32 = 0.1;

/// A handle held by the pointer.
#[derive(Clone, Debug)]
pub struct Drag {
    handle: Handle,
    frame: Frame,
    /// What it acts on, as it was; what was selected last comes last.
    start: Vec<(Item, Subject)>,
    /// Corners that it may stick to.
    corners: Vec<DVec3>,
    grabbed_at: Pos2,
    pointer: Pos2,
    /// Numbers typed since.
    pub typed: Typed,
}

/// What a drag makes of one thing.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// The thing as it is to be.
    To(Subject),
    /// The thing as it would be, which may not be: a polygon that crosses itself.
    Refused(Subject),
}

/// What a drag makes of all things that it acts on.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// The things as they are to be; none where they may not be so.
    pub now: Vec<(Item, Subject)>,
    /// A thing as it would be but may not.
    pub refused: Option<Subject>,
    /// What to say at the cursor.
    pub readout: String,
}

impl Drag {
    /// `handle`, taken hold of at `pos`; `start` is not empty.
    pub fn new(handle: Handle, frame: Frame, start: Vec<(Item, Subject)>, pos: Pos2) -> Self {
        let corners = Vec::new();
        Self { handle, frame, start, corners, grabbed_at: pos, pointer: pos, typed: Typed::default() }
    }

    /// The drag, where it may stick to these corners as well as to the grid.
    pub fn among(self, corners: Vec<DVec3>) -> Self {
        Self { corners, ..self }
    }

    /// Which handle is held.
    pub fn handle(&self) -> Handle {
        self.handle
    }

    /// The pointer has moved by `delta`; `fine` slows it down.
    pub fn pull(&mut self, delta: Vec2, fine: bool) {
        self.pointer += if fine { FINE * delta } else { delta };
    }

    /// The things as the pointer has them now; `snap` is the spacing of the grid they stick to, unless a corner is near. `None` where the pointer
    /// says nothing, as past the horizon.
    pub fn change(&self, projection: &Projection, solids: &Solids, snap: Option<f64>) -> Option<Outcome> {
        let typed = self.typed.numbers();
        let pull = Pull {
            rays: [projection.ray(self.grabbed_at), projection.ray(self.pointer)],
            drag: self.pointer - self.grabbed_at,
            snap,
            corners: if snap.is_some() { &self.corners } else { &[] },
            typed: &typed,
            projection,
        };
        if !self.handle.is_transform() {
            return self.reshaped(&pull, solids);
        }
        let amount = self.amount(&pull)?;
        let applied = |(item, subject): &(Item, Subject)| (*item, amount.applied(subject, self.frame.pivot));
        let readout = readout::of_amount(self.handle, &amount, &self.frame);
        Some(Outcome { now: self.start.iter().map(applied).collect(), refused: None, readout })
    }

    /// By how much everything is moved, turned or scaled.
    fn amount(&self, pull: &Pull<'_>) -> Option<Amount> {
        let frame = &self.frame;
        match self.handle {
            Handle::Axis(axis) => pull.along(frame, axis),
            Handle::Plane(normal) => pull.across(frame, normal),
            Handle::Screen => pull.facing(frame),
            Handle::Ring(axis) => pull.turned(frame, frame.axes.col(axis)),
            Handle::ScreenRing => {
                let to_eye = (pull.projection.camera().eye - frame.origin).try_normalize()?;
                pull.turned(frame, to_eye)
            }
            Handle::Stretch(axis) => pull.stretched(frame, axis),
            Handle::Scale => Some(pull.scaled(frame)),
            _ => None,
        }
    }

    /// One thing after its own handle was dragged.
    fn reshaped(&self, pull: &Pull<'_>, solids: &Solids) -> Option<Outcome> {
        let (item, start) = self.start.last()?;
        let change = match self.handle {
            Handle::Vertex(i) => vertices::vertex(pull, start, i),
            Handle::Edge(i) => vertices::edge(pull, start, i),
            Handle::End(i) => reshape::end(pull, start, i),
            Handle::Side(signs) => reshape::side(pull, start, signs),
            Handle::Radius => reshape::radius(pull, start),
            Handle::HalfAngle => reshape::half_angle(pull, start),
            Handle::Control(i) => reshape::control(pull, start, i),
            Handle::Aim => aim::comes_from(pull, start),
            Handle::Target => aim::to_target(pull, start, solids),
            Handle::Probe => probe::moved(pull, start, solids, pull.snap.is_some()),
            Handle::Normal => probe::turned(pull, start),
            _ => None,
        };
        Some(match change? {
            Change::To(now) => {
                let readout = readout::of_shape(self.handle, &now, pull.projection);
                Outcome { now: vec![(*item, now)], refused: None, readout }
            }
            Change::Refused(subject) => Outcome { now: Vec::new(), refused: Some(subject), readout: String::new() },
        })
    }
}

#[cfg(test)]
#[path = "drag_tests.rs"]
mod tests;
