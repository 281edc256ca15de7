//! Variants: named states of the lights, stored, shown and compared.

use std::sync::Arc;

use super::session::Session;
use crate::scene::{Scene, Variant};

impl Session {
    /// Store the lights as a new variant, which is then the active one.
    pub fn store_variant(&mut self) {
        let scene = self.scene();
        let name = (1..).map(|i| format!("Variant {i}")).find(|name| scene.variant(name).is_none());
        self.edit("Store variant", |scene| {
            scene.variants.extend(name.clone().map(|name| Variant { name, lights: scene.lights.clone() }));
            scene.active_variant = name;
        });
    }

    /// Store the lights in the variant of that place.
    pub fn update_variant(&mut self, index: usize) {
        let Some(name) = self.variant_name(index) else { return };
        self.edit(&format!("Update “{name}”"), |scene| {
            scene.variants[index].lights.clone_from(&scene.lights);
            scene.active_variant = Some(name);
        });
    }

    /// Show the lights of the variant of that place. Those that were not stored are an undo away, and the user is told.
    pub fn switch_variant(&mut self, index: usize) {
        let Some(name) = self.variant_name(index) else { return };
        let scene = Arc::clone(self.scene());
        let is_stored = |variant: &Variant| variant.lights == scene.lights;
        let undo = "Undo brings them back";
        if scene.lights.is_empty() || scene.variants.iter().any(is_stored) {
            self.done(format!("“{name}”"));
        } else if let Some(active) = &scene.active_variant {
            self.done(format!("“{name}”; the lights were not stored in “{active}”: {undo}"));
        } else {
            self.done(format!("“{name}”; the lights were not stored: {undo}"));
        }
        self.edit(&format!("Switch to “{name}”"), |scene| {
            scene.lights.clone_from(&scene.variants[index].lights);
            scene.active_variant = Some(name);
        });
    }

    /// Show the variant so many places after the active one, round and round.
    pub fn step_variant(&mut self, down: bool) {
        let scene = self.scene();
        let count = scene.variants.len();
        let active = self.active_variant();
        let target = match (active, down) {
            (None, true) => 0,
            (None, false) => count.saturating_sub(1),
            (Some(active), true) => (active + 1) % count,
            (Some(active), false) => (active + count - 1) % count,
        };
        self.switch_variant(target);
    }

    /// The place of the variant that the lights came from.
    pub fn active_variant(&self) -> Option<usize> {
        let active = self.scene().active_variant.as_ref()?;
        self.scene().variants.iter().position(|variant| variant.name == *active)
    }

    /// Give a variant another name; one that is empty or taken is refused, and the user is told.
    pub fn rename_variant(&mut self, index: usize, name: &str) {
        let name = name.trim();
        let Some(old) = self.variant_name(index).filter(|old| old != name) else { return };
        if name.is_empty() {
            self.failed("A name must not be empty");
        } else if self.scene().variant(name).is_some() {
            self.failed(format!("“{name}” is taken: choose another name"));
        } else {
            self.edit("Rename variant", |scene| {
                name.clone_into(&mut scene.variants[index].name);
                if scene.active_variant.as_ref() == Some(&old) {
                    scene.active_variant = Some(name.to_owned());
                }
            });
        }
    }

    /// Delete a variant; the lights that are shown stay.
    pub fn delete_variant(&mut self, index: usize) {
        let Some(name) = self.variant_name(index) else { return };
        self.edit("Delete variant", |scene| {
            scene.variants.remove(index);
            scene.active_variant = scene.active_variant.take().filter(|active| *active != name);
        });
    }

    /// Move a variant into the gap before the one at `gap`, counted before it moves; the last gap is after all.
    pub fn move_variant(&mut self, index: usize, gap: usize) {
        let stays = gap == index || gap == index + 1;
        if stays || index.max(gap.saturating_sub(1)) >= self.scene().variants.len() {
            return;
        }
        self.edit("Move variant", |scene| {
            let variant = scene.variants.remove(index);
            scene.variants.insert(if gap > index { gap - 1 } else { gap }, variant);
        });
    }

    fn variant_name(&self, index: usize) -> Option<String> {
        Some(self.scene().variants.get(index)?.name.clone())
    }
}

/// The place in `to` of the variant at `index` in `from`, by name; by place where it was renamed.
pub(super) fn follow(index: usize, from: &Scene, to: &Scene) -> Option<usize> {
    let name = &from.variants.get(index)?.name;
    let by_name = to.variants.iter().position(|variant| variant.name == *name);
    by_name.or_else(|| (from.variants.len() == to.variants.len()).then_some(index))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Light, Point, Shape};

    fn session() -> Session {
        let lights = vec![Light::new("lamp", Shape::Point(Point::default()))];
        Session::new(Scene { lights, ..Scene::default() }, None)
    }

    fn move_lamp(session: &mut Session, z: f64) {
        session.edit("Move", |scene| scene.lights[0].position.z = z);
    }

    fn height(session: &Session) -> f64 {
        session.scene().lights[0].position.z
    }

    #[test]
    fn lights_are_stored_switched_updated_and_undone() {
        let mut session = session();
        session.store_variant();
        session.rename_variant(0, "low");
        move_lamp(&mut session, 2.0);
        session.store_variant();
        assert_eq!(session.scene().active_variant.as_deref(), Some("Variant 1"), "the new one is active");
        session.switch_variant(0);
        assert_eq!((height(&session), session.active_variant()), (0.0, Some(0)), "low");
        assert_eq!(session.notices.pop(), Some(crate::editor::session::Notice::Done("“low”".to_owned())), "no warning");
        session.step_variant(true);
        session.step_variant(true);
        assert_eq!(session.active_variant(), Some(0), "round and round");
        move_lamp(&mut session, 5.0);
        assert!(session.scene().differs_from_variant(), "changed");
        session.update_variant(0);
        assert!(!session.scene().differs_from_variant(), "stored");
        session.switch_variant(1);
        session.switch_variant(0);
        assert_eq!(height(&session), 5.0, "as it was stored");
    }

    #[test]
    fn switching_from_lights_that_were_not_stored_warns_and_is_undone() {
        let mut session = session();
        session.store_variant();
        move_lamp(&mut session, 3.0);
        session.switch_variant(0);
        let Some(crate::editor::session::Notice::Done(text)) = session.notices.pop() else { panic!("a message") };
        assert!(text.contains("not stored") && text.contains("Undo"), "{text}");
        assert_eq!(height(&session), 0.0, "switched");
        session.undo();
        assert_eq!(height(&session), 3.0, "nothing is lost");
    }

    #[test]
    fn a_view_of_a_variant_follows_it_when_variants_move_and_forgets_one_that_is_gone() {
        let mut session = session();
        for _ in 0..3 {
            session.store_variant();
        }
        session.view.variant = Some(1);
        session.move_variant(1, 0);
        assert_eq!(session.view.variant, Some(0), "moved");
        session.rename_variant(0, "other");
        assert_eq!(session.view.variant, Some(0), "renamed");
        session.delete_variant(2);
        assert_eq!(session.view.variant, Some(0), "another is gone");
        session.delete_variant(0);
        assert_eq!(session.view.variant, None, "gone itself");
    }

    #[test]
    fn the_scene_is_shown_with_a_variants_lights_and_solo_holds_there_too() {
        let mut session = session();
        session.store_variant();
        session.edit("Add", |scene| scene.lights.push(Light::new("spare", Shape::Point(Point::default()))));
        session.view.variant = Some(0);
        let view = session.view;
        assert_eq!(session.shown_for(&view).lights.len(), 1, "the variant's");
        session.toggle_solo("spare");
        assert!(session.shown_for(&view).lights[0].muted, "another light is soloed");
        assert!(Arc::ptr_eq(&session.shown_for(&view), &session.shown_for(&view)), "the same until something changes");
        assert_eq!(session.shown().lights.len(), 2, "the scene's own");
    }
}
