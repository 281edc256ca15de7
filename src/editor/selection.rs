//! What is selected, and how it follows its things through edits.

use crate::light::Shape;
use crate::scene::Scene;

/// One thing in the document, by its place in the scene's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Item {
    /// A light.
    Light(usize),
    /// A surface.
    Surface(usize),
    /// A material.
    Material(usize),
    /// A plot, and its probe.
    Plot(usize),
}

/// What is selected, in the order of selection.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    items: Vec<Item>,
}

impl Selection {
    /// The thing selected last, which the inspector and the handles show.
    pub fn primary(&self) -> Option<Item> {
        self.items.last().copied()
    }

    /// All selected things, in the order of selection.
    pub fn items(&self) -> &[Item] {
        &self.items
    }

    /// Whether `item` is selected.
    pub fn contains(&self, item: Item) -> bool {
        self.items.contains(&item)
    }

    /// Select `items` and nothing else.
    pub fn set(&mut self, items: impl IntoIterator<Item = Item>) {
        self.items = items.into_iter().collect();
    }

    /// Add `item`, or take it away where it was selected.
    pub fn toggle(&mut self, item: Item) {
        if self.contains(item) {
            self.items.retain(|other| *other != item);
        } else {
            self.items.push(item);
        }
    }

    /// Select nothing.
    pub fn clear(&mut self) {
        self.items.clear();
    }

    /// Follow the selected things, by name, from one state of the document to another.
    ///
    /// What kept its place but not its name, in a list as long as before, was renamed; anything else is forgotten.
    pub(super) fn follow(&mut self, from: &Scene, to: &Scene) {
        let followed = self.items.iter().filter_map(|item| {
            let by_name = item.name(from).and_then(|name| item.find(name, to));
            by_name.or_else(|| (item.count(from) == item.count(to)).then_some(*item))
        });
        self.items = followed.collect();
    }
}

impl Item {
    /// Whether the scene has it.
    pub fn exists(self, scene: &Scene) -> bool {
        self.name(scene).is_some()
    }

    /// The thing of the same kind that has that name in `scene`.
    fn find(self, name: &str, scene: &Scene) -> Option<Self> {
        match self {
            Self::Light(_) => scene.lights.iter().position(|light| light.name == name).map(Self::Light),
            Self::Surface(_) => scene.surfaces.iter().position(|surface| surface.name == name).map(Self::Surface),
            Self::Material(_) => scene.materials.iter().position(|material| material.name == name).map(Self::Material),
            Self::Plot(_) => scene.plots.iter().position(|plot| plot.name == name).map(Self::Plot),
        }
    }

    /// How many things of its kind the scene has.
    fn count(self, scene: &Scene) -> usize {
        match self {
            Self::Light(_) => scene.lights.len(),
            Self::Surface(_) => scene.surfaces.len(),
            Self::Material(_) => scene.materials.len(),
            Self::Plot(_) => scene.plots.len(),
        }
    }

    /// Whether it is a light with a pattern, which can be painted.
    pub fn has_pattern(self, scene: &Scene) -> bool {
        let Self::Light(i) = self else { return false };
        scene.lights.get(i).is_some_and(|light| matches!(light.shape, Shape::Textured(_)))
    }

    /// Its name in the scene.
    pub fn name(self, scene: &Scene) -> Option<&str> {
        match self {
            Self::Light(i) => scene.lights.get(i).map(|light| light.name.as_str()),
            Self::Surface(i) => scene.surfaces.get(i).map(|surface| surface.name.as_str()),
            Self::Material(i) => scene.materials.get(i).map(|material| material.name.as_str()),
            Self::Plot(i) => scene.plots.get(i).map(|plot| plot.name.as_str()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::Session;
    use crate::surface::{Material, ReflectionModel};
    use glam::DVec3;

    fn material(name: &str) -> Material {
        Material {
            name: name.to_owned(),
            diffuse: DVec3::ONE,
            specular: DVec3::ZERO,
            model: ReflectionModel::default(),
            exponent: 8.0,
        }
    }

    fn session() -> Session {
        let scene = Scene { materials: vec![material("a"), material("b"), material("c")], ..Scene::default() };
        Session::new(scene, None)
    }

    #[test]
    fn the_selection_follows_its_thing_by_name_through_edits_and_undo() {
        let mut session = session();
        session.selection.set([Item::Material(2)]);
        session.edit("Delete", |scene| {
            scene.materials.remove(0);
        });
        assert_eq!(session.selection.items(), [Item::Material(1)], "after the list has shrunk");
        session.undo();
        assert_eq!(session.selection.items(), [Item::Material(2)], "after undo");
    }

    #[test]
    fn the_selection_survives_a_rename_and_forgets_what_is_gone() {
        let mut session = session();
        session.selection.set([Item::Material(1)]);
        session.edit("Rename", |scene| scene.materials[1].name = "d".to_owned());
        assert_eq!(session.selection.primary(), Some(Item::Material(1)), "after a rename");
        session.edit("Delete", |scene| scene.materials.retain(|m| m.name != "d"));
        assert_eq!(session.selection.primary(), None, "after the thing is gone");
    }
}
