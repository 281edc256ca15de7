//! Things of one kind that are edited together.

use crate::editor::session::{Item, Session};
use crate::light::Light;
use crate::scene::Scene;
use crate::surface::{Material, Surface};

/// Things as they are, one at least, and their places in the scene.
pub(super) struct Together<T> {
    places: Vec<usize>,
    things: Vec<T>,
    list: fn(&mut Scene) -> &mut Vec<T>,
}

/// Lights that are edited together.
pub(super) type Lights = Together<Light>;

impl Together<Light> {
    /// All selected lights, the one at `first` before the others.
    pub(super) fn selected(session: &Session, first: usize) -> Option<Self> {
        Self::at(session.scene(), selected(session, first, |item| item.light()))
    }

    /// The lights at these places.
    pub(super) fn at(scene: &Scene, places: Vec<usize>) -> Option<Self> {
        Self::new(&scene.lights, places, |scene| &mut scene.lights)
    }
}

impl Together<Surface> {
    /// All selected surfaces, the one at `first` before the others.
    pub(super) fn selected(session: &Session, first: usize) -> Option<Self> {
        let places = selected(session, first, |item| if let Item::Surface(i) = item { Some(*i) } else { None });
        Self::new(&session.scene().surfaces, places, |scene| &mut scene.surfaces)
    }
}

impl Together<Material> {
    /// All selected materials, the one at `first` before the others.
    pub(super) fn selected(session: &Session, first: usize) -> Option<Self> {
        let places = selected(session, first, |item| if let Item::Material(i) = item { Some(*i) } else { None });
        Self::new(&session.scene().materials, places, |scene| &mut scene.materials)
    }

    /// The materials of surfaces, that of the first before the others.
    pub(super) fn of(scene: &Scene, surfaces: &Together<Surface>) -> Option<Self> {
        let mut places = Vec::new();
        for surface in surfaces.all() {
            let place = scene.materials.iter().position(|material| material.name == surface.material);
            places.extend(place.filter(|place| !places.contains(place)));
        }
        Self::new(&scene.materials, places, |scene| &mut scene.materials)
    }
}

/// The places of what is selected and has one, that at `first` before the others.
fn selected(session: &Session, first: usize, place: impl Fn(&Item) -> Option<usize>) -> Vec<usize> {
    let others = session.selection.items().iter().filter_map(place).filter(|index| *index != first);
    std::iter::once(first).chain(others).collect()
}

impl<T: Clone> Together<T> {
    fn new(all: &[T], places: Vec<usize>, list: fn(&mut Scene) -> &mut Vec<T>) -> Option<Self> {
        let things: Option<Vec<_>> = places.iter().map(|index| all.get(*index).cloned()).collect();
        things.filter(|things| !things.is_empty()).map(|things| Self { places, things, list })
    }

    /// All of them.
    pub(super) fn all(&self) -> &[T] {
        &self.things
    }

    /// Their places in the scene.
    pub(super) fn places(&self) -> &[usize] {
        &self.places
    }

    /// Something that each of them has.
    pub(super) fn each<'a, V>(&'a self, get: impl Fn(&'a T) -> V) -> Vec<V> {
        self.things.iter().map(get).collect()
    }

    /// Something of each of them, if each has it.
    pub(super) fn of_all<'a, V>(&'a self, get: impl Fn(&'a T) -> Option<V>) -> Option<Vec<V>> {
        self.things.iter().map(get).collect()
    }

    /// An edit of the scene that sets the same in all of them.
    pub(super) fn set<'a, V: Clone>(&'a self, set: impl Fn(&mut T, V) + 'a) -> impl Fn(&mut Scene, V) + 'a {
        let set_each = self.set_each(set);
        move |scene, value| (0..self.places.len()).for_each(|i| set_each(scene, i, value.clone()))
    }

    /// An edit of the scene that sets something in one of them.
    pub(super) fn set_each<'a, V>(&'a self, set: impl Fn(&mut T, V) + 'a) -> impl Fn(&mut Scene, usize, V) + 'a {
        move |scene, i, value| {
            if let Some(thing) = self.places.get(i).and_then(|index| (self.list)(scene).get_mut(*index)) {
                set(thing, value);
            }
        }
    }
}
