//! What handles act on: a light, a surface, or a plot's probe.

use glam::{DMat3, DVec3};

use crate::editor::session::Item;
use crate::light::Light;
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
            Self::Probe(_) => DMat3::IDENTITY,
        }
    }

    /// The same thing elsewhere.
    pub fn at(mut self, position: DVec3) -> Self {
        match &mut self {
            Self::Light(light) => light.position = position,
            Self::Surface(surface) => surface.position = position,
            Self::Probe(plot) => plot.position = position,
        }
        self
    }

    /// The same thing turned so that its own axes are `rotation`.
    pub fn turned(mut self, rotation: DMat3) -> Self {
        let rotation_deg = frame::deg_from_rotation(rotation);
        match &mut self {
            Self::Light(light) => light.rotation_deg = rotation_deg,
            Self::Surface(surface) => surface.rotation_deg = rotation_deg,
            Self::Probe(_) => {}
        }
        self
    }
}

fn replace<T>(list: &mut [T], index: usize, value: T) {
    if let Some(slot) = list.get_mut(index) {
        *slot = value;
    }
}
