//! Rows of a label and its values, whose edits are one undo step a gesture.

use std::ops::RangeInclusive;

use egui::{DragValue, Grid, Id, Response, RichText, Ui, vec2};
use glam::DVec3;

use super::pattern::Thumbnail;
use crate::editor::commands::Command;
use crate::editor::session::Session;
use crate::editor::theme;
use crate::scene::{Scene, validate};

/// What a pane needs to show fields and to apply what is edited in them.
pub(super) struct Fields<'a> {
    /// The document.
    pub(super) session: &'a mut Session,
    pub(super) gesture: &'a mut Option<Id>,
    pub(super) refused: &'a mut Option<(Id, String)>,
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

    /// Apply `change` because the widget changed; it joins the steps of the widget's gesture.
    ///
    /// A change that would make the document invalid is refused, and the reason shown.
    pub(super) fn apply(&mut self, response: &Response, label: &str, change: impl FnOnce(&mut Scene)) {
        if !response.changed() {
            return;
        }
        let mut changed = self.scene().clone();
        change(&mut changed);
        let before = validate(self.scene());
        if let Some(problem) = validate(&changed).into_iter().find(|problem| !before.contains(problem)) {
            *self.refused = Some((response.id, problem.message));
            return;
        }
        *self.refused = None;
        if *self.gesture != Some(response.id) || !self.session.history.in_gesture() {
            self.session.begin(label);
            *self.gesture = Some(response.id);
        }
        self.session.edit(label, |scene| *scene = changed);
    }

    /// Like [`Self::apply`], for a widget that is done with at once.
    pub(super) fn apply_now(&mut self, response: &Response, label: &str, change: impl FnOnce(&mut Scene)) {
        self.apply(response, label, change);
        if response.changed() {
            self.session.commit();
            *self.gesture = None;
        }
    }

    /// A row with one number.
    pub(super) fn number(
        &mut self,
        ui: &mut Ui,
        label: &str,
        style: &Number,
        value: f64,
        set: impl FnOnce(&mut Scene, f64),
    ) {
        let name = row_label(ui, label);
        let mut edited = value;
        let mut response = drag(ui, style, &mut edited, ui.available_width().min(110.0)).labelled_by(name);
        if !style.hint.is_empty() {
            response = response.on_hover_text(style.hint);
        }
        self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, edited));
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
        row_label(ui, label);
        self.components(ui, label, ["X", "Y", "Z"], style, value, set);
        ui.end_row();
    }

    /// A row with a colour to pick, and its three components.
    pub(super) fn color(&mut self, ui: &mut Ui, label: &str, value: DVec3, set: impl Fn(&mut Scene, DVec3)) {
        row_label(ui, label);
        ui.vertical(|ui| {
            let mut picked = to_f32(value);
            let response =
                ui.color_edit_button_rgb(&mut picked).on_hover_text(format!("Pick {}", label.to_lowercase()));
            let response = response.accessible_name(format!("Pick {}", label.to_lowercase()));
            let step = format!("Change {}", label.to_lowercase());
            self.apply(&response, &step, |scene| set(scene, DVec3::from_array(picked.map(f64::from))));
            self.components(ui, label, ["red", "green", "blue"], &Number::SHARE, value, &set);
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
        let name = row_label(ui, label);
        let shown = choices.iter().find(|(choice, _)| choice == current).map_or("", |(_, name)| name.as_str());
        let mut picked = current.clone();
        let combo = egui::ComboBox::from_id_salt(label).selected_text(shown).width(110.0);
        let mut response = combo.show_ui(ui, |ui| {
            for (choice, name) in choices {
                ui.selectable_value(&mut picked, choice.clone(), name);
            }
        });
        response.response = response.response.labelled_by(name);
        if !hint.is_empty() {
            response.response = response.response.on_hover_text(hint);
        }
        if picked != *current {
            response.response.mark_changed();
        }
        self.apply_now(&response.response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, picked));
        ui.end_row();
    }

    /// A row with a box to tick.
    pub(super) fn toggle(&mut self, ui: &mut Ui, label: &str, value: bool, set: impl FnOnce(&mut Scene, bool)) {
        let name = row_label(ui, label);
        let mut ticked = value;
        let response = ui.checkbox(&mut ticked, "").labelled_by(name);
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
        value: DVec3,
        set: impl Fn(&mut Scene, DVec3),
    ) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 3.0;
            // The unit stands in the tooltip: three numbers and their units do not fit.
            let bare = Number { unit: "", ..style.clone() };
            let width = (0.333 * (ui.available_width() - 6.0)).clamp(44.0, 72.0);
            for (i, name) in names.into_iter().enumerate() {
                let mut edited = value;
                let name = format!("{label} {name}");
                let response = drag(ui, &bare, &mut edited[i], width).accessible_name(&name);
                let response = response.on_hover_text(format!("{name}{}", unit_in_brackets(style.unit)));
                self.apply(&response, &format!("Change {}", label.to_lowercase()), |scene| set(scene, edited));
            }
        });
    }
}

/// The label at the start of a row, by which the row's widget is found.
pub(super) fn row_label(ui: &mut Ui, label: &str) -> Id {
    ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| ui.weak(label).id).inner
}

/// A number to drag or type.
pub(super) fn drag(ui: &mut Ui, style: &Number, value: &mut f64, width: f32) -> Response {
    let height = ui.spacing().interact_size.y;
    let drag = DragValue::new(value)
        .speed(style.speed)
        .range(style.range.clone())
        .clamp_existing_to_range(false)
        .max_decimals(6)
        .suffix(style.unit);
    ui.add_sized(vec2(width, height), drag)
}

fn unit_in_brackets(unit: &str) -> String {
    if unit.is_empty() { String::new() } else { format!(" ({})", unit.trim()) }
}

#[expect(clippy::cast_possible_truncation, reason = "for a colour picker")]
fn to_f32(color: DVec3) -> [f32; 3] {
    color.to_array().map(|component| component as f32)
}
