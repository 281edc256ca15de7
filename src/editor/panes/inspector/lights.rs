//! Lights that are edited together.

use crate::editor::light_list;
use crate::editor::session::{Item, Session};
use crate::light::Light;
use crate::scene::Scene;

/// Lights as they are, one at least, and their places in the scene.
pub(super) struct Lights {
    places: Vec<usize>,
    lights: Vec<Light>,
}

impl Lights {
    /// All selected lights, the one at `first` before the others.
    pub(super) fn selected(session: &Session, first: usize) -> Option<Self> {
        let others = session.selection.items().iter().filter_map(Item::light).filter(|index| *index != first);
        Self::at(session.scene(), std::iter::once(first).chain(others).collect())
    }

    /// The lights at these places.
    pub(super) fn at(scene: &Scene, places: Vec<usize>) -> Option<Self> {
        let lights: Option<Vec<_>> = places.iter().map(|index| scene.lights.get(*index).cloned()).collect();
        lights.filter(|lights| !lights.is_empty()).map(|lights| Self { places, lights })
    }

    /// All of them.
    pub(super) fn all(&self) -> &[Light] {
        &self.lights
    }

    /// Their places in the scene.
    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// Something that each of them has.
    pub(super) fn each<'a, T>(&'a self, get: impl Fn(&'a Light) -> T) -> Vec<T> {
        self.lights.iter().map(get).collect()
    }

    /// Something of each of them, if each has it.
    pub(super) fn of_all<'a, T>(&'a self, get: impl Fn(&'a Light) -> Option<T>) -> Option<Vec<T>> {
        self.lights.iter().map(get).collect()
    }

    /// An edit of the scene that sets the same in all of them.
    pub(super) fn set<'a, T: Clone>(&'a self, set: impl Fn(&mut Light, T) + 'a) -> impl Fn(&mut Scene, T) + 'a {
        move |scene, value| light_list::each(scene, &self.places, |light| set(light, value.clone()))
    }

    /// An edit of the scene that sets something in one of them.
    pub(super) fn set_each<'a, T>(&'a self, set: impl Fn(&mut Light, T) + 'a) -> impl Fn(&mut Scene, usize, T) + 'a {
        move |scene, i, value| {
            if let Some(light) = self.places.get(i).and_then(|index| scene.lights.get_mut(*index)) {
                set(light, value);
            }
        }
    }
}
