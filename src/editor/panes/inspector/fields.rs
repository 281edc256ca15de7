//! Rows of a label and its values, whose edits are one undo step a gesture.

use std::ops::RangeInclusive;

use egui::{DragValue, Grid, Id, Response, RichText, Ui, vec2};
use glam::DVec3;

use super::pattern::Thumbnail;
use crate::editor::commands::Command;
use crate::editor::panes::bars;
use crate::editor::panes::gesture::Gesture;
use crate::editor::session::Session;
use crate::editor::theme;
use crate::scene::Scene;

/// Shown in place of a value that is not the same in all things that are edited together.
const MIXED: &str = "mixed";

/// What a pane needs to show fields and to apply what is edited in them.
pub(super) struct Fields<'a> {
    /// The document.
    pub(super) session: &'a mut Session,
    /// What the pane's widgets are in the middle of.
    pub(super) gesture: &'a mut Gesture,
    /// The pattern shown last.
    pub(super) thumbnail: &'a mut Option<Thumbnail>,
    /// Commands asked for.
    pub(super) commands: &'a mut Vec<Command>,
}

/// How a number is shown and dragged.
#[derive(Clone, Debug)]
pub(super) struct Number {
    /// The unit after it, with its space.
    pub(super) unit: &'static str,
    /// Change for each point dragged.
    pub(super) speed: f64,
    /// What it may be.
    pub(super) range: RangeInclusive<f64>,
    /// What it means, for who hovers over it; empty where the label says all.
    pub(super) hint: &'static str,
}

impl Number {
    /// A place, metres.
    pub(super) const PLACE: Self = Self { unit: " m", speed: 0.01, range: -1e4..=1e4, hint: "" };
    /// A length, metres.
    pub(super) const LENGTH: Self = Self { unit: " m", speed: 0.005, range: 1e-3..=1e4, hint: "" };
    /// An angle, degrees.
    pub(super) const ANGLE: Self = Self { unit: "°", speed: 0.5, range: -360.0..=360.0, hint: "" };
    /// A share, or a component of a colour.
    pub(super) const SHARE: Self = Self { unit: "", speed: 0.005, range: 0.0..=1.0, hint: "" };
    /// A number without unit.
    pub(super) const FACTOR: Self = Self { unit: "", speed: 0.01, range: -1e3..=1e3, hint: "" };
    /// A component of a direction.
    pub(super) const DIRECTION: Self = Self::FACTOR;

    /// A positive amount, dragged in proportion to its size.
    pub(super) fn amount(unit: &'static str, value: f64) -> Self {
        Self { unit, speed: (0.01 * value.abs()).max(0.01), range: 0.0..=1e12, hint: "" }
    }
}

impl Fields<'_> {
    /// The document as it is.
    pub(super) fn scene(&self) -> &Scene {
        self.session.scene()
    }

    /// A part of the pane with a title, its rows aligned.
    pub(super) fn section(&mut self, ui: &mut Ui, title: &str, rows: impl FnOnce(&mut Ui, &mut Self)) {
        ui.add_space(8.0);
        egui::CollapsingHeader::new(RichText::new(title).strong()).default_open(true).show_unindented(ui, |ui| {
            Grid::new(title).num_columns(2).spacing(vec2(8.0, 5.0)).min_col_width(theme::LABEL_WIDTH).show(ui, |ui| {
                rows(ui, self);
            });
        });
    }

    /// Apply `change` because the widget changed; see [`Gesture::apply`].
    pub(super) fn apply(&mut self, response: &Response, label: &str, change: impl FnOnce(&mut Scene)) {
        self.gesture.apply(self.session, response, label, change);
    }

    /// Like [`Self::apply`], for a widget that is done with at once.
    pub(super) fn apply_now(&mut self, response: &Response, label: &str, change: impl FnOnce(&mut Scene)) {
        self.gesture.apply_now(self.session, response, label, change);
    }

    /// A row with one number.
    pub(super) fn number(
        &mut self,
        ui: &mut Ui,
        label: &str,
        style: &Number,
        value: f64,
        set: impl Fn(&mut Scene, f64),
    ) {
        self.numbers(ui, label, style, &[value], |scene, _, value| set(scene, value));
    }

    /// A row with a number of each of some things: `set` is given a thing's place among them and what it becomes.
    pub(super) fn numbers(
        &mut self,
        ui: &mut Ui,
        label: &str,
        style: &Number,
        values: &[f64],
        set: impl Fn(&mut Scene, usize, f64),
    ) {
        let name = row_label(ui, label);
        let (response, edited) = drag_all(ui, style, values, ui.available_width().min(110.0));
        let mut response = response.labelled_by(name);
        if !style.hint.is_empty() {
            response = response.on_hover_text(style.hint);
        }
        self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| {
            edited.into_iter().enumerate().for_each(|(i, value)| set(scene, i, value));
        });
        ui.end_row();
    }

    /// A row with a factor: 1 until it is dragged or typed, and 1 again once it has been applied.
    pub(super) fn factor(&mut self, ui: &mut Ui, label: &str, hint: &str, scale: impl FnOnce(&mut Scene, f64)) {
        let name = row_label(ui, label);
        let key = ui.scope_id().with((label, "so far"));
        let so_far = ui.data(|data| data.get_temp(key)).unwrap_or(1.0);
        let mut edited: f64 = so_far;
        let drag = DragValue::new(&mut edited).prefix("× ").speed(0.01).range(1e-3..=1e3).max_decimals(3);
        let size = vec2(ui.available_width().min(110.0), ui.spacing().interact_size.y);
        let response = ui.add_sized(size, drag.update_while_editing(false)).labelled_by(name).on_hover_text(hint);
        self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| scale(scene, edited / so_far));
        let is_held = self.gesture.is_of(response.id);
        ui.data_mut(|data| *data.get_temp_mut_or(key, 1.0) = if is_held { edited } else { 1.0 });
        ui.end_row();
    }

    /// A row with a whole number.
    pub(super) fn whole(
        &mut self,
        ui: &mut Ui,
        label: &str,
        range: RangeInclusive<u32>,
        value: u32,
        set: impl FnOnce(&mut Scene, u32),
    ) {
        let name = row_label(ui, label);
        let mut edited = value;
        let response = ui.add(DragValue::new(&mut edited).range(range).speed(0.05)).labelled_by(name);
        self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, edited));
        ui.end_row();
    }

    /// A row with three numbers, called X, Y and Z.
    pub(super) fn vector(
        &mut self,
        ui: &mut Ui,
        label: &str,
        style: &Number,
        value: DVec3,
        set: impl Fn(&mut Scene, DVec3),
    ) {
        self.vectors(ui, label, style, &[value], |scene, _, value| set(scene, value));
    }

    /// A row with a vector of each of some things; see [`Self::numbers`].
    pub(super) fn vectors(
        &mut self,
        ui: &mut Ui,
        label: &str,
        style: &Number,
        values: &[DVec3],
        set: impl Fn(&mut Scene, usize, DVec3),
    ) {
        row_label(ui, label);
        self.components(ui, label, ["X", "Y", "Z"], style, values, set);
        ui.end_row();
    }

    /// A row with a colour of each of some things to pick, and its three components; see [`Self::numbers`].
    pub(super) fn colors(
        &mut self,
        ui: &mut Ui,
        label: &str,
        values: &[DVec3],
        set: impl Fn(&mut Scene, usize, DVec3),
    ) {
        let Some(first) = values.first() else { return };
        row_label(ui, label);
        ui.vertical(|ui| {
            let name = format!("Pick {}", label.to_lowercase());
            let mut color = *first;
            let response = bars::color_button(ui, &name, &name, &mut color);
            let step = format!("Change {}", label.to_lowercase());
            self.apply(&response, &step, |scene| (0..values.len()).for_each(|i| set(scene, i, color)));
            self.components(ui, label, ["red", "green", "blue"], &Number::SHARE, values, &set);
        });
        ui.end_row();
    }

    /// A row with a choice.
    pub(super) fn choice<T: PartialEq + Clone>(
        &mut self,
        ui: &mut Ui,
        label: &str,
        current: &T,
        choices: &[(T, String)],
        set: impl FnOnce(&mut Scene, T),
    ) {
        self.choice_explained(ui, label, current, choices, "", set);
    }

    /// A row with a choice, and what the current one means for who hovers over it.
    pub(super) fn choice_explained<T: PartialEq + Clone>(
        &mut self,
        ui: &mut Ui,
        label: &str,
        current: &T,
        choices: &[(T, String)],
        hint: &str,
        set: impl FnOnce(&mut Scene, T),
    ) {
        self.choice_of_all(ui, label, std::slice::from_ref(current), choices, hint, set);
    }

    /// A row with a choice for some things together.
    pub(super) fn choice_of_all<T: PartialEq + Clone>(
        &mut self,
        ui: &mut Ui,
        label: &str,
        current: &[T],
        choices: &[(T, String)],
        hint: &str,
        set: impl FnOnce(&mut Scene, T),
    ) {
        let name = row_label(ui, label);
        let current = common(current);
        let known = current.and_then(|current| choices.iter().find(|(choice, _)| choice == current));
        let shown = match current {
            None => MIXED,
            Some(_) => known.map_or("", |(_, name)| name.as_str()),
        };
        let mut picked = None;
        let combo = egui::ComboBox::from_id_salt(label).selected_text(shown).width(110.0);
        let mut response = combo.show_ui(ui, |ui| {
            for (choice, name) in choices {
                if ui.selectable_label(current == Some(choice), name).clicked() {
                    picked = Some(choice.clone());
                }
            }
        });
        response.response = response.response.labelled_by(name);
        if !hint.is_empty() {
            response.response = response.response.on_hover_text(hint);
        }
        if let Some(picked) = picked.filter(|picked| Some(picked) != current) {
            response.response.mark_changed();
            self.apply_now(&response.response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, picked));
        }
        ui.end_row();
    }

    /// A row with a box to tick.
    pub(super) fn toggle(&mut self, ui: &mut Ui, label: &str, value: bool, set: impl FnOnce(&mut Scene, bool)) {
        self.toggle_all(ui, label, &[value], set);
    }

    /// A row with a box to tick for some things together.
    pub(super) fn toggle_all(&mut self, ui: &mut Ui, label: &str, values: &[bool], set: impl FnOnce(&mut Scene, bool)) {
        let name = row_label(ui, label);
        let common = common(values);
        let mut ticked = common.copied().unwrap_or_default();
        let tick_box = egui::Checkbox::without_text(&mut ticked).indeterminate(common.is_none());
        let response = ui.add(tick_box).labelled_by(name);
        self.apply_now(&response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, ticked));
        ui.end_row();
    }

    /// A row with something that follows from the rest.
    #[expect(clippy::unused_self, reason = "reads like its siblings")]
    pub(super) fn derived(&mut self, ui: &mut Ui, label: &str, text: &str) {
        row_label(ui, label);
        ui.monospace(text);
        ui.end_row();
    }

    fn components(
        &mut self,
        ui: &mut Ui,
        label: &str,
        names: [&str; 3],
        style: &Number,
        values: &[DVec3],
        set: impl Fn(&mut Scene, usize, DVec3),
    ) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            // The unit stands in the tooltip: three numbers and their units do not fit.
            let bare = Number { unit: "", ..style.clone() };
            ui.spacing_mut().button_padding.x = 2.0;
            let width = (0.333 * (ui.available_width() - 6.0)).clamp(36.0, 72.0);
            for (axis, name) in names.into_iter().enumerate() {
                let name = format!("{label} {name}");
                let along: Vec<_> = values.iter().map(|value| value[axis]).collect();
                let (response, edited) = drag_all(ui, &bare, &along, width);
                let response = response.accessible_name(&name);
                let response = response.on_hover_text(format!("{name}{}", unit_in_brackets(style.unit)));
                self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| {
                    for (i, (mut value, edited)) in values.iter().copied().zip(edited).enumerate() {
                        value[axis] = edited;
                        set(scene, i, value);
                    }
                });
            }
        });
    }
}

/// The value that all have.
fn common<T: PartialEq>(values: &[T]) -> Option<&T> {
    let (first, others) = values.split_first()?;
    others.iter().all(|other| other == first).then_some(first)
}

/// The label at the start of a row, by which the row's widget is found.
pub(super) fn row_label(ui: &mut Ui, label: &str) -> Id {
    let response = ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| ui.weak(label)).inner;
    show_revealed(ui, &response, label);
    response.id
}

/// A row that shall be seen: its label, and whether it has been scrolled to.
#[derive(Clone)]
struct Revealed(String, bool);

/// Bring the row of that label into sight when it is shown next, and mark it until the next click.
pub(in crate::editor) fn reveal(ctx: &egui::Context, label: &str) {
    ctx.data_mut(|data| data.insert_temp(Id::NULL, Revealed(label.to_owned(), false)));
}

fn show_revealed(ui: &Ui, response: &Response, label: &str) {
    let Some(Revealed(_, seen)) =
        ui.data(|data| data.get_temp(Id::NULL)).filter(|revealed: &Revealed| revealed.0 == label)
    else {
        return;
    };
    if !seen {
        response.scroll_to_me(Some(egui::Align::Center));
        ui.data_mut(|data| data.insert_temp(Id::NULL, Revealed(label.to_owned(), true)));
    } else if ui.input(|input| input.pointer.any_pressed()) {
        ui.data_mut(|data| data.remove::<Revealed>(Id::NULL));
    }
    let stroke = egui::Stroke::new(1.5, theme::accent(ui.visuals()));
    let mark = response.rect.expand2(vec2(4.0, 2.0));
    ui.painter().rect_stroke(mark, 3.0, stroke, egui::StrokeKind::Outside);
}

/// Characters that fields have room for which are narrower than so many points; a wider one has room for all.
const ROOM: [(f32, usize); 2] = [(56.0, 5), (80.0, 7)];

/// Decimals that a field has room for.
fn decimals(value: f64, width: f32) -> usize {
    let before_point = format!("{:.0}", value.trunc()).len();
    let room = ROOM.into_iter().find(|(limit, _)| width < *limit);
    room.map_or(6, |(_, room)| room.saturating_sub(before_point + 1).min(4))
}

/// A number of each of some things, to drag or type: the one that all have, or "mixed". What each becomes: what was
/// typed; where the first was dragged, the others by as much, or, where all are positive, in proportion.
pub(super) fn drag_all(ui: &mut Ui, style: &Number, values: &[f64], width: f32) -> (Response, Vec<f64>) {
    let first = values.first().copied().unwrap_or_default();
    let mixed = common(values).is_none();
    let (mut edited, mut is_set) = (first, false);
    let height = ui.spacing().interact_size.y;
    let places = decimals(first, width);
    let shown = |value: f64| format!("{value:.places$}");
    let mut drag = DragValue::from_get_set(|new| {
        is_set |= new.is_some();
        // A click in and out of the field keeps the digits that it does not show.
        let differs = |new: &f64| mixed || shown(*new) != shown(first);
        edited = new.filter(differs).unwrap_or(edited);
        edited
    })
    .speed(style.speed)
    .range(style.range.clone())
    .clamp_existing_to_range(false)
    .max_decimals(places);
    drag = if mixed { drag.custom_formatter(|_, _| MIXED.to_owned()) } else { drag.suffix(style.unit) };
    let mut response = ui.add_sized(vec2(width, height), drag);
    if mixed && is_set {
        // The first may have had what was typed for all.
        response.mark_changed();
    }
    let scales = *style.range.start() >= 0.0 && values.iter().all(|value| *value > 0.0);
    let moved = |value: &f64| match response.dragged() {
        true if scales => (value * (edited / first)).clamp(*style.range.start(), *style.range.end()),
        true => value + (edited - first),
        false => edited,
    };
    let others = values.iter().skip(1).map(moved);
    let all = std::iter::once(edited).chain(others).collect();
    (response, all)
}

fn unit_in_brackets(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" ({})", unit.trim()) }
}
