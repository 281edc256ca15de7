//! What is done to the list of lights: mute, order, groups, links.

use std::collections::BTreeSet;

use super::session::{Item, Session};
use super::units::{self, Unit};
use crate::light::Light;
use crate::scene::Scene;

/// A line of the list of lights.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Entry {
    /// A group, and the places of its lights.
    Group(String, Vec<usize>),
    /// A light of no group.
    Light(usize),
}

/// A place in the list of lights where others can be put.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The light that comes next; none at the list's end.
    pub before: Option<usize>,
    /// The group that it is in.
    pub group: Option<String>,
}

/// The list of lights as it is shown: a group stands where the first of its lights does.
pub fn entries(lights: &[Light]) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for (i, light) in lights.iter().enumerate() {
        let Some(group) = &light.group else {
            entries.push(Entry::Light(i));
            continue;
        };
        let known = entries.iter_mut().find_map(|entry| match entry {
            Entry::Group(name, members) if name == group => Some(members),
            _ => None,
        });
        match known {
            Some(members) => members.push(i),
            None => entries.push(Entry::Group(group.clone(), vec![i])),
        }
    }
    entries
}

/// All slots between the lights that are not in `moved`, from the top; groups in `closed` are passed as a whole.
fn slots(lights: &[Light], moved: &[usize], closed: &BTreeSet<String>) -> Vec<Slot> {
    let mut slots = Vec::new();
    for entry in entries(lights) {
        match entry {
            Entry::Light(i) if !moved.contains(&i) => slots.push(Slot { before: Some(i), group: None }),
            Entry::Light(_) => {}
            Entry::Group(name, members) => {
                let stay: Vec<_> = members.into_iter().filter(|i| !moved.contains(i)).collect();
                let Some(first) = stay.first() else { continue };
                slots.push(Slot { before: Some(*first), group: None });
                if !closed.contains(&name) {
                    let group = || Some(name.clone());
                    slots.extend(stay.iter().map(|i| Slot { before: Some(*i), group: group() }));
                    let next = stay.last().and_then(|last| after(lights, *last, moved));
                    slots.push(Slot { before: next, group: group() });
                }
            }
        }
    }
    slots.push(Slot { before: None, group: None });
    slots
}

/// The light that is shown after that one, of those that are not `moved`.
pub fn after(lights: &[Light], light: usize, moved: &[usize]) -> Option<usize> {
    let order = order(lights);
    let at = order.iter().position(|i| *i == light)?;
    order[at + 1..].iter().find(|i| !moved.contains(i)).copied()
}

/// The places of the lights in the order in which they are shown.
pub fn order(lights: &[Light]) -> Vec<usize> {
    let lights = entries(lights).into_iter().flat_map(|entry| match entry {
        Entry::Group(_, members) => members,
        Entry::Light(i) => vec![i],
    });
    lights.collect()
}

/// Put the lights of the places `moved` into a slot.
fn put(lights: &[Light], moved: &[usize], slot: &Slot) -> Vec<Light> {
    let order = order(lights);
    // What comes next may be moved itself: then it is what comes after that.
    let next =
        slot.before.and_then(|light| if moved.contains(&light) { after(lights, light, moved) } else { Some(light) });
    let taken = order.iter().filter(|i| moved.contains(i));
    let block = taken.map(|i| Light { group: slot.group.clone(), ..lights[*i].clone() });
    let mut block: Vec<_> = block.collect();
    let mut list = Vec::with_capacity(lights.len());
    for i in order.iter().filter(|i| !moved.contains(i)) {
        if Some(*i) == next {
            list.append(&mut block);
        }
        list.push(lights[*i].clone());
    }
    list.append(&mut block);
    list
}

impl Session {
    /// The places of the selected lights, ascending.
    pub fn selected_lights(&self) -> Vec<usize> {
        let mut lights: Vec<_> = self.selection.items().iter().filter_map(Item::light).collect();
        lights.sort_unstable();
        lights
    }

    /// The selected lights where the one at `index` is among them, else that one alone: what an edit in its row is for.
    pub fn lights_with(&self, index: usize) -> Vec<usize> {
        if self.selection.contains(Item::Light(index)) { self.selected_lights() } else { vec![index] }
    }

    /// Change lights, as one step.
    pub fn edit_lights(&mut self, label: &str, lights: &[usize], change: impl Fn(&mut Light)) {
        self.edit(label, |scene| each(scene, lights, change));
    }

    /// Mute lights, or stop doing so.
    pub fn mute(&mut self, lights: &[usize], muted: bool) {
        self.edit_lights(if muted { "Mute" } else { "Unmute" }, lights, |light| light.muted = muted);
    }

    /// Solo lights, or stop doing so where all of them are.
    pub fn solo(&mut self, lights: &[usize]) {
        let scene = self.scene().clone();
        let names: Vec<_> = lights.iter().filter_map(|i| scene.lights.get(*i)).map(|light| &light.name).collect();
        let all = names.iter().all(|name| self.is_solo(name));
        for name in names {
            if self.is_solo(name) == all {
                self.toggle_solo(name);
            }
        }
    }

    /// Put the selected lights in a new group, where the first of them stands.
    pub fn group_selection(&mut self) {
        let lights = self.selected_lights();
        let scene = self.scene();
        let order = order(&scene.lights);
        let Some(first) = order.into_iter().find(|i| lights.contains(i)) else { return };
        let is_taken = |name: &String| scene.lights.iter().any(|light| light.group.as_ref() == Some(name));
        let name = (1..).map(|i| format!("Group {i}")).find(|name| !is_taken(name));
        self.move_lights("Group", &lights, &Slot { before: Some(first), group: name });
    }

    /// Take the selected lights out of their groups; where they are all of a group, it is gone.
    pub fn ungroup_selection(&mut self) {
        let lights = self.selected_lights();
        self.edit("Ungroup", |scene| {
            // In the order shown, so that nothing jumps.
            let list: Vec<_> = order(&scene.lights).into_iter().map(|i| (i, scene.lights[i].clone())).collect();
            let taken = |(i, light): (usize, Light)| match lights.contains(&i) {
                true => Light { group: None, ..light },
                false => light,
            };
            scene.lights = list.into_iter().map(taken).collect();
        });
    }

    /// Give a group another name; one that is empty or taken is refused, and the user is told.
    pub fn rename_group(&mut self, old: &str, new: &str) {
        let new = new.trim();
        let is_taken = |light: &Light| light.group.as_deref() == Some(new);
        if new == old {
        } else if new.is_empty() {
            self.failed("A name must not be empty");
        } else if self.scene().lights.iter().any(is_taken) {
            self.failed(format!("“{new}” is taken: choose another name"));
        } else {
            self.edit("Rename group", |scene| {
                for group in scene.lights.iter_mut().filter_map(|light| light.group.as_mut()) {
                    if group == old {
                        new.clone_into(group);
                    }
                }
            });
        }
    }

    /// Put lights elsewhere in the list.
    pub fn move_lights(&mut self, label: &str, lights: &[usize], slot: &Slot) {
        self.edit(label, |scene| scene.lights = put(&scene.lights, lights, slot));
    }

    /// Move the selected lights a line up or down: into, through and out of groups that are open.
    pub fn shift_selection(&mut self, up: bool) {
        let moved = self.selected_lights();
        let scene = self.scene().clone();
        let lights = &scene.lights;
        if moved.is_empty() {
            return;
        }
        let same = |slot: &Slot| put(lights, &moved, slot) == *lights;
        let slots = slots(lights, &moved, &self.closed_groups);
        // Where they stand, as a block at the first one's place.
        let first = order(lights).into_iter().find(|i| moved.contains(i)).unwrap_or_default();
        let next = after(lights, first, &moved);
        let is_here = |slot: &&Slot| slot.before == next && slot.group == lights[first].group;
        let here = slots.iter().position(|slot| is_here(&slot));
        let target = match (here, up) {
            (Some(here), true) => slots[..here].iter().rev().find(|slot| !same(slot)),
            (Some(here), false) => slots[here + 1..].iter().find(|slot| !same(slot)),
            // The last of a group that is closed, or that goes with them.
            (None, _) => slots.iter().find(|slot| slot.before == next && !same(slot)),
        };
        if let Some(slot) = target {
            self.move_lights(if up { "Move up" } else { "Move down" }, &moved, slot);
        }
    }

    /// Let lights reach only these surfaces, or all.
    pub fn link_lights(&mut self, lights: &[usize], only: Option<&[String]>) {
        self.edit_lights("Link lights", lights, |light| light.only = only.map(<[String]>::to_vec));
    }
}

impl Item {
    /// The place of a light.
    pub fn light(&self) -> Option<usize> {
        if let Self::Light(index) = self { Some(*index) } else { None }
    }
}

/// Change the lights at these places.
pub fn each(scene: &mut Scene, lights: &[usize], change: impl Fn(&mut Light)) {
    for light in lights {
        if let Some(light) = scene.lights.get_mut(*light) {
            change(light);
        }
    }
}

/// Multiply what lights emit, each in the quantity in which it is stated.
pub fn scale_emission(scene: &mut Scene, lights: &[usize], factor: f64) {
    each(scene, lights, |light| {
        light.quantity = crate::light::Quantity::new(light.quantity.kind(), light.quantity.value() * factor);
    });
}

/// State what lights emit as `value` of a unit; those that do not have it stay as they are.
pub fn set_emission(scene: &mut Scene, lights: &[usize], unit: Unit, value: f64) {
    each(scene, lights, |light| {
        if let Some(stated) = units::stated(light, unit, value) {
            *light = stated;
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Point, Shape};

    /// Lights called a, b, c, …; a letter after a colon is the group.
    fn session(list: &[&str]) -> Session {
        let light = |text: &&str| {
            let (name, group) = text.split_once(':').map_or((*text, None), |(name, group)| (name, Some(group)));
            Light { group: group.map(str::to_owned), ..Light::new(name, Shape::Point(Point::default())) }
        };
        Session::new(Scene { lights: list.iter().map(light).collect(), ..Scene::default() }, None)
    }

    fn list(session: &Session) -> Vec<String> {
        let name = |light: &Light| match &light.group {
            Some(group) => format!("{}:{group}", light.name),
            None => light.name.clone(),
        };
        session.scene().lights.iter().map(name).collect()
    }

    fn select(session: &mut Session, names: &str) {
        let place = |name: char| session.scene().lights.iter().position(|light| light.name == name.to_string());
        let items: Vec<_> = names.chars().filter_map(place).map(Item::Light).collect();
        session.selection.set(items);
    }

    fn shift(session: &mut Session, up: bool) -> Vec<String> {
        session.shift_selection(up);
        list(session)
    }

    #[test]
    fn a_light_moves_through_groups_line_by_line_and_back() {
        let mut session = session(&["a", "b:g", "c:g", "d"]);
        select(&mut session, "d");
        let way = [["a", "b:g", "c:g", "d:g"], ["a", "b:g", "d:g", "c:g"], ["a", "d:g", "b:g", "c:g"]];
        for expected in way {
            assert_eq!(shift(&mut session, true), expected, "up, within the group");
        }
        assert_eq!(shift(&mut session, true), ["a", "d", "b:g", "c:g"], "out of it");
        assert_eq!(shift(&mut session, true), ["d", "a", "b:g", "c:g"], "to the top");
        assert_eq!(shift(&mut session, true), ["d", "a", "b:g", "c:g"], "no further");
        for expected in [["a", "d", "b:g", "c:g"], ["a", "d:g", "b:g", "c:g"]] {
            assert_eq!(shift(&mut session, false), expected, "and down again");
        }
        session.shift_selection(false);
        session.shift_selection(false);
        assert_eq!(shift(&mut session, false), ["a", "b:g", "c:g", "d"], "out at the lower end");
        assert_eq!(session.selection.items(), [Item::Light(3)], "it stays selected");
    }

    #[test]
    fn a_closed_group_is_passed_as_a_whole() {
        let mut session = session(&["a", "b:g", "c:g", "d"]);
        select(&mut session, "d");
        session.closed_groups.insert("g".to_owned());
        session.shift_selection(true);
        assert_eq!(list(&session), ["a", "d", "b:g", "c:g"], "over the group");
    }

    #[test]
    fn several_lights_become_a_group_at_the_first_ones_place_and_apart_again() {
        let mut session = session(&["a", "b", "c", "d"]);
        select(&mut session, "db");
        session.group_selection();
        assert_eq!(list(&session), ["a", "b:Group 1", "d:Group 1", "c"], "grouped");
        assert_eq!(session.history.undo_label(), Some("Group"), "one step");
        session.rename_group("Group 1", " key ");
        assert_eq!(list(&session), ["a", "b:key", "d:key", "c"], "renamed");
        session.ungroup_selection();
        assert_eq!(list(&session), ["a", "b", "d", "c"], "apart");
        session.undo();
        session.undo();
        session.undo();
        assert_eq!(list(&session), ["a", "b", "c", "d"], "as before");
    }

    #[test]
    fn a_group_name_that_is_empty_or_taken_is_refused() {
        let mut session = session(&["a:g", "b:h"]);
        session.rename_group("g", "h");
        session.rename_group("g", " ");
        assert_eq!(
            (list(&session), session.notices.len()),
            (vec!["a:g".to_owned(), "b:h".to_owned()], 2),
            "told twice"
        );
    }

    #[test]
    fn scattered_members_are_shown_together_and_stay_so_when_something_moves() {
        let mut session = session(&["a:g", "b", "c:g"]);
        let expected = vec![Entry::Group("g".to_owned(), vec![0, 2]), Entry::Light(1)];
        assert_eq!(entries(&session.scene().lights), expected, "the group stands at its first light");
        select(&mut session, "b");
        assert_eq!(shift(&mut session, true), ["a:g", "c:g", "b:g"], "into the group");
    }

    #[test]
    fn solo_of_several_ends_when_all_have_it() {
        let mut session = session(&["a", "b", "c"]);
        session.solo(&[0]);
        session.solo(&[0, 1]);
        assert!(session.is_solo("a") && session.is_solo("b"), "both");
        session.solo(&[0, 1]);
        assert!(!session.has_solo(), "none");
    }
}
