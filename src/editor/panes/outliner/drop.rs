//! Lights that are dragged to another place in the list.

use egui::{Rect, Ui};

use super::{Ask, INDENT};
use crate::editor::light_list::{Slot, after};
use crate::editor::panes::gesture::RowDrag;
use crate::light::Light;

/// Lights on their way.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Drag {
    /// Their places in the scene.
    pub(super) lights: Vec<usize>,
    /// The group that they are, where it is dragged as a whole.
    pub(super) group: Option<String>,
}

/// The rows of the list, from the top.
#[derive(Debug, Default)]
pub(super) struct Rows(Vec<Row>);

#[derive(Debug)]
struct Row {
    rect: Rect,
    /// The light; of a group's own row, its first.
    light: usize,
    group: Option<String>,
    kind: Kind,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Light,
    OpenGroup,
    ClosedGroup,
}

impl Rows {
    pub(super) fn add_light(&mut self, rect: Rect, light: usize, group: Option<&str>) {
        self.0.push(Row { rect, light, group: group.map(str::to_owned), kind: Kind::Light });
    }

    pub(super) fn add_group(&mut self, rect: Rect, name: &str, first: usize, is_closed: bool) {
        let kind = if is_closed { Kind::ClosedGroup } else { Kind::OpenGroup };
        self.0.push(Row { rect, light: first, group: Some(name.to_owned()), kind });
    }

    /// The slot at a height, and the height of its line: the gap above or below the row that is there.
    fn slot(&self, lights: &[Light], y: f32) -> Option<(Slot, f32)> {
        let (first, last) = (self.0.first()?, self.0.last()?);
        if y > last.rect.bottom() {
            return Some((Slot { before: None, group: None }, last.rect.bottom()));
        }
        let at = self.0.iter().position(|row| y <= row.rect.bottom()).unwrap_or_default();
        let row = if y < first.rect.top() { first } else { &self.0[at] };
        if y < row.rect.center().y {
            let group = if row.kind == Kind::Light { row.group.clone() } else { None };
            return Some((Slot { before: Some(row.light), group }, row.rect.top()));
        }
        let below = self.0.get(at + 1);
        let slot = match row.kind {
            Kind::OpenGroup => Slot { before: Some(row.light), group: row.group.clone() },
            Kind::Light => Slot { before: after(lights, row.light, &[]), group: row.group.clone() },
            Kind::ClosedGroup => Slot { before: below.map(|row| row.light), group: None },
        };
        Some((slot, row.rect.bottom()))
    }

    /// The gap above the group that a slot is in: groups do not go into groups.
    fn outside(&self, slot: Slot) -> Option<(Slot, f32)> {
        let is_its_own = |row: &&Row| row.group == slot.group && row.kind != Kind::Light;
        let row = self.0.iter().find(is_its_own)?;
        Some((Slot { before: Some(row.light), group: None }, row.rect.top()))
    }
}

/// The line where what is dragged would go; when it is let go, it does.
pub(super) fn show(ui: &Ui, rows: &Rows, lights: &[Light], drag: &mut Option<Drag>, asked: &mut Vec<Ask>) {
    let Some(dragged) = drag.as_ref() else { return };
    let row_drag = RowDrag::of(ui);
    let slot = row_drag.y().and_then(|y| rows.slot(lights, y)).and_then(|(slot, y)| {
        if dragged.group.is_some() && slot.group.is_some() { rows.outside(slot) } else { Some((slot, y)) }
    });
    if let Some((slot, y)) = slot {
        RowDrag::show_line(ui, ui.max_rect().left() + if slot.group.is_some() { INDENT } else { 0.0 }, y);
        if row_drag.is_let_go {
            let slot = Slot { group: slot.group.or_else(|| dragged.group.clone()), ..slot };
            asked.push(Ask::Put(dragged.lights.clone(), slot));
        }
    }
    if row_drag.is_over() {
        *drag = None;
    }
}
