//! What handles act on: a light, a surface, or a plot's probe.

use glam::{DMat3, DQuat, DVec3};

use crate::editor::session::Item;
use crate::light::{self, Light};
use crate::math::frame;
use crate::scene::{Plot, Scene};
use crate::surface::Surface;

/// A copy of the selected thing, to be changed and put back.
#[derive(Clone, Debug, PartialEq)]
pub enum Subject {
    /// A light.
    Light(Light),
    /// A surface.
    Surface(Surface),
    /// A plot: its probe.
    Probe(Plot),
}

impl Subject {
    /// A copy of `item`; `None` where handles do not apply.
    pub fn of(item: Item, scene: &Scene) -> Option<Self> {
        match item {
            Item::Light(i) => scene.lights.get(i).cloned().map(Self::Light),
            Item::Surface(i) => scene.surfaces.get(i).cloned().map(Self::Surface),
            Item::Plot(i) => scene.plots.get(i).cloned().map(Self::Probe),
            Item::Material(_) => None,
        }
    }

    /// Put the copy in the place of `item`.
    pub fn put(self, item: Item, scene: &mut Scene) {
        match (self, item) {
            (Self::Light(light), Item::Light(i)) => replace(&mut scene.lights, i, light),
            (Self::Surface(surface), Item::Surface(i)) => replace(&mut scene.surfaces, i, surface),
            (Self::Probe(plot), Item::Plot(i)) => replace(&mut scene.plots, i, plot),
            _ => {}
        }
    }

    /// Where it is.
    pub fn position(&self) -> DVec3 {
        match self {
            Self::Light(light) => light.position,
            Self::Surface(surface) => surface.position,
            Self::Probe(plot) => plot.position,
        }
    }

    /// Its own axes in the world.
    pub fn rotation(&self) -> DMat3 {
        match self {
            Self::Light(light) => frame::rotation_from_deg(light.rotation_deg),
            Self::Surface(surface) => frame::rotation_from_deg(surface.rotation_deg),
            Self::Probe(plot) => {
                DMat3::from_quat(DQuat::from_rotation_arc(DVec3::Z, plot.normal.normalize_or(DVec3::Z)))
            }
        }
    }

    /// The same thing elsewhere, to a micrometre.
    pub fn at(mut self, position: DVec3) -> Self {
        let place = match &mut self {
            Self::Light(light) => &mut light.position,
            Self::Surface(surface) => &mut surface.position,
            Self::Probe(plot) => &mut plot.position,
        };
        // What stays is not rounded.
        *place = DVec3::select(position.cmpeq(*place), *place, tidied(position));
        self
    }

    /// The same thing turned so that its own axes are `rotation`, to a millionth of a degree; a probe's normal is its Z.
    pub fn turned(mut self, rotation: DMat3) -> Self {
        let rotation_deg = tidied(frame::deg_from_rotation(rotation));
        match &mut self {
            Self::Light(light) => light.rotation_deg = rotation_deg,
            Self::Surface(surface) => surface.rotation_deg = rotation_deg,
            Self::Probe(plot) => plot.normal = tidied(rotation.z_axis),
        }
        self
    }

    /// The same thing turned by `turn`; what looks the same from all sides stays as it is.
    pub fn turned_by(mut self, turn: DMat3) -> Self {
        match &mut self {
            Self::Light(light)
                if matches!(light.shape, light::Shape::Sphere(_) | light::Shape::Point(light::Point { ies: None })) =>
            {
                self
            }
            Self::Probe(plot) => {
                plot.normal = tidied(turn * plot.normal);
                plot.axis = tidied(turn * plot.axis);
                plot.view = plot.view.map(|view| tidied(turn * view));
                self
            }
            _ => {
                let rotation = turn * self.rotation();
                self.turned(rotation)
            }
        }
    }
}

/// Rounded to 10⁻⁶, so that files stay readable; zeros are positive.
pub fn tidied(v: DVec3) -> DVec3 {
    const PER_UNIT: f64 = 1e6;
    // Farther out than this there are no digits left to round.
    const FAR: f64 = 1e9;
    if v.abs().max_element() < FAR { (v * PER_UNIT).round() / PER_UNIT + DVec3::ZERO } else { v }
}

fn replace<T>(list: &mut [T], index: usize, value: T) {
    if let Some(slot) = list.get_mut(index) {
        *slot = value;
    }
}
