//! Along which axes and about which point handles move, turn and scale what is selected.

use glam::{DMat3, DVec3};

use super::subject::Subject;
use crate::editor::session::{Item, Session, Tool};

/// The axes along which handles move, and about which they turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Axes {
    /// The world's.
    #[default]
    World,
    /// Those of what was selected last.
    Local,
}

/// The point about which what is selected is turned and scaled.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Pivot {
    /// The origin of what was selected last.
    #[default]
    Primary,
    /// The middle of the box about the origins.
    Center,
    /// Each thing's own origin.
    Own,
}

/// How handles act on what is selected.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Transform {
    /// Along which axes.
    pub axes: Axes,
    /// About which point.
    pub pivot: Pivot,
}

/// Where handles are and what they act about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// Where the handles are.
    pub origin: DVec3,
    /// Their axes, unit.
    pub axes: DMat3,
    /// Whether those are the world's.
    pub is_world: bool,
    /// What is turned and scaled about; `None` for each thing's own origin.
    pub pivot: Option<DVec3>,
}

impl Axes {
    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::World => "World axes",
            Self::Local => "Local axes",
        }
    }

    /// The other.
    pub fn other(self) -> Self {
        match self {
            Self::World => Self::Local,
            Self::Local => Self::World,
        }
    }
}

impl Pivot {
    /// All of them, in menu order.
    pub const ALL: [Self; 3] = [Self::Primary, Self::Center, Self::Own];

    /// The one after it.
    pub fn next(self) -> Self {
        match self {
            Self::Primary => Self::Center,
            Self::Center => Self::Own,
            Self::Own => Self::Primary,
        }
    }

    /// What it is called.
    pub fn label(self) -> &'static str {
        match self {
            Self::Primary => "Last selected",
            Self::Center => "Middle of the selection",
            Self::Own => "Each its own",
        }
    }
}

impl Frame {
    /// The frame of the handles on `subjects`, of which the last was selected last; `None` where there are none.
    ///
    /// A shape is scaled along its own axes whatever `transform` says: askew it would be no such shape any more.
    pub fn new(transform: Transform, tool: Tool, subjects: &[(Item, Subject)]) -> Option<Self> {
        let (_, primary) = subjects.last()?;
        let is_world = transform.axes == Axes::World && tool != Tool::Scale;
        let axes = if is_world { DMat3::IDENTITY } else { primary.rotation() };
        let origins = subjects.iter().map(|(_, subject)| subject.position());
        let (low, high) =
            origins.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let (origin, pivot) = match transform.pivot {
            Pivot::Primary => (primary.position(), Some(primary.position())),
            Pivot::Center => (low.midpoint(high), Some(low.midpoint(high))),
            Pivot::Own => (primary.position(), None),
        };
        Some(Self { origin, axes, is_world, pivot })
    }
}

/// What of the selection handles act on, in the order of selection.
pub fn selected(session: &Session) -> Vec<(Item, Subject)> {
    let items = session.selection.items().iter();
    items.filter_map(|item| Some((*item, Subject::of(*item, session.scene())?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Light, Point, Shape};

    fn at(i: usize, position: DVec3, rotation_deg: DVec3) -> (Item, Subject) {
        let light = Light { position, rotation_deg, ..Light::new("light", Shape::Point(Point::default())) };
        (Item::Light(i), Subject::Light(light))
    }

    #[test]
    fn the_pivot_is_where_it_is_chosen_to_be() {
        let subjects = [at(0, DVec3::ZERO, DVec3::ZERO), at(1, DVec3::new(4.0, 2.0, 0.0), DVec3::ZERO)];
        let frame = |pivot| {
            let transform = Transform { axes: Axes::World, pivot };
            Frame::new(transform, Tool::Rotate, &subjects).expect("two things")
        };
        let last = DVec3::new(4.0, 2.0, 0.0);
        assert_eq!((frame(Pivot::Primary).origin, frame(Pivot::Primary).pivot), (last, Some(last)), "last selected");
        assert_eq!(frame(Pivot::Center).pivot, Some(DVec3::new(2.0, 1.0, 0.0)), "middle");
        assert_eq!((frame(Pivot::Own).origin, frame(Pivot::Own).pivot), (last, None), "own");
    }

    #[test]
    fn axes_are_the_worlds_or_those_of_what_was_selected_last_and_scaling_is_always_along_the_latter() {
        let subjects = [at(0, DVec3::ZERO, DVec3::new(0.0, 0.0, 90.0))];
        let axes = |axes, tool| {
            Frame::new(Transform { axes, ..Transform::default() }, tool, &subjects).expect("a thing").axes.x_axis
        };
        assert!(axes(Axes::World, Tool::Move).distance(DVec3::X) < 1e-12, "world");
        assert!(axes(Axes::Local, Tool::Move).distance(DVec3::Y) < 1e-12, "local");
        assert!(axes(Axes::World, Tool::Scale).distance(DVec3::Y) < 1e-12, "scaling");
    }
}
