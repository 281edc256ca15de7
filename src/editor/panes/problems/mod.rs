//! What is wrong with the scene, or likely not meant; a click leads there.

mod exposure;
mod oddities;
mod place;

use std::path::PathBuf;
use std::sync::Arc;

use egui::{Color32, Role, Sense, Ui, Visuals, WidgetInfo, vec2};
use egui_material_icons::MaterialIcon;
use egui_material_icons::icons;

use super::{Pane, inspector};
use crate::editor::commands::Command;
use crate::editor::session::{Framing, Item, Session};
use crate::scene::{Scene, validate};

/// Height of a row, points.
const ROW: f32 = 24.0;
/// Width of the column of icons, points.
const ICON: f32 = 26.0;
/// The widest the column of places gets, as a share of the pane.
const PLACE_SHARE: f32 = 0.3;

/// How bad something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Severity {
    /// The scene cannot be saved or shaded so.
    Error,
    /// Allowed, but likely not meant.
    Warning,
    /// Good to know.
    Note,
}

/// Something to look at.
#[derive(Clone, Debug, PartialEq)]
struct Row {
    severity: Severity,
    text: String,
    /// What it is about; none for the scene as a whole.
    item: Option<Item>,
    /// The label of the inspector's row that it is about.
    field: Option<&'static str>,
}

/// The pane's own state.
#[derive(Debug, Default)]
pub struct Problems {
    of: Option<(Arc<Scene>, Option<PathBuf>)>,
    rows: Vec<Row>,
}

impl Row {
    fn warning(item: impl Into<Option<Item>>, field: &'static str, text: String) -> Self {
        Self { severity: Severity::Warning, text, item: item.into(), field: Some(field) }
    }
}

impl Severity {
    fn icon(self) -> MaterialIcon {
        match self {
            Self::Error => icons::ICON_ERROR,
            Self::Warning => icons::ICON_WARNING,
            Self::Note => icons::ICON_INFO,
        }
    }

    fn color(self, visuals: &Visuals) -> Color32 {
        match self {
            Self::Error => visuals.error_fg_color,
            Self::Warning => visuals.warn_fg_color,
            Self::Note => visuals.weak_text_color(),
        }
    }

    fn name(self) -> &'static str {
        match self {
            Self::Error => "Error",
            Self::Warning => "Warning",
            Self::Note => "Note",
        }
    }
}

impl Problems {
    /// Look at the scene again, if it has changed and no gesture is under way.
    pub fn update(&mut self, session: &Session) {
        let (scene, path) = (session.scene(), &session.path);
        let known = self.of.as_ref().is_some_and(|(of, beside)| Arc::ptr_eq(of, scene) && beside == path);
        if known || session.history.in_gesture() && self.of.is_some() {
            return;
        }
        self.rows = rows(scene, path.as_deref());
        self.of = Some((Arc::clone(scene), path.clone()));
    }

    /// How many errors and warnings there are.
    pub fn count(&self) -> usize {
        self.rows.iter().filter(|row| row.severity < Severity::Note).count()
    }

    /// Show the pane; the commands that were asked for.
    pub fn show(&self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let mut commands = Vec::new();
        egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
            egui::Frame::new().inner_margin(egui::Margin::symmetric(6, 6)).show(ui, |ui| {
                ui.spacing_mut().item_spacing.y = 0.0;
                if self.rows.is_empty() {
                    ui.weak("No problems.");
                }
                for row in &self.rows {
                    if show_row(ui, session, row) {
                        go_to(ui.ctx(), session, row);
                        commands.push(Command::ShowPane(Pane::Inspector));
                    }
                }
            });
        });
        commands
    }
}

/// All there is to say about a scene, the worst first.
fn rows(scene: &Scene, path: Option<&std::path::Path>) -> Vec<Row> {
    let wrong = validate(scene).into_iter().map(|problem| Row {
        severity: Severity::Error,
        item: place::item(&problem.path),
        field: place::field(&problem.path),
        text: format!("{}: {}", problem.path, problem.message),
    });
    let mut rows: Vec<Row> = wrong.chain(oddities::oddities(scene)).chain(oddities::files(scene, path)).collect();
    rows.sort_by_key(|row| row.severity);
    rows
}

/// One row; whether it was clicked.
fn show_row(ui: &mut Ui, session: &mut Session, row: &Row) -> bool {
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), ROW), Sense::click());
    let selected = row.item.is_some_and(|item| session.selection.contains(item));
    let label = format!("{}: {}", row.severity.name(), row.text);
    response.widget_info(|| WidgetInfo::selected(Role::Button, true, selected, &label));
    if response.hovered() {
        session.hint = "Click to go there".to_owned();
        ui.painter().rect_filled(rect, 4.0, ui.visuals().widgets.hovered.bg_fill);
    }
    let mut cells = ui.new_child(
        egui::UiBuilder::new()
            .max_rect(rect.shrink2(vec2(6.0, 0.0)))
            .layout(egui::Layout::left_to_right(egui::Align::Center)),
    );
    let icon = row.severity.icon().rich_text().size(16.0).color(row.severity.color(ui.visuals()));
    cells.allocate_ui(vec2(ICON, ROW), |ui| ui.add(egui::Label::new(icon).selectable(false)));
    let place = row.item.map_or_else(|| "scene".to_owned(), |item| place::name(item, session.scene()));
    cells.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        let most = PLACE_SHARE * ui.available_width();
        let weak = egui::RichText::new(place).weak();
        ui.allocate_ui(vec2(most, ROW), |ui| ui.add(egui::Label::new(weak).selectable(false).truncate()));
        ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
            ui.add(egui::Label::new(&row.text).selectable(false).truncate());
        });
    });
    response.on_hover_text(&row.text).clicked()
}

/// Select what a row is about, bring it into view, and show its field.
fn go_to(ctx: &egui::Context, session: &mut Session, row: &Row) {
    session.selection.set(row.item);
    if let Some(Item::Light(_) | Item::Surface(_) | Item::Plot(_)) = row.item {
        session.framing = Some(Framing::Selection);
    }
    if let Some(Item::Plot(index)) = row.item {
        session.plots.active = index;
    }
    if let Some(field) = row.field {
        inspector::reveal(ctx, field);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::first_light;

    #[test]
    fn what_validation_says_comes_first_and_leads_to_its_field() {
        let mut scene = first_light();
        scene.lights[0].name = scene.lights.last().map(|light| light.name.clone()).unwrap_or_default();
        scene.materials[0].exponent = 0.5;
        scene.materials[0].diffuse = glam::DVec3::splat(2.0);
        let rows = rows(&scene, None);
        assert_eq!(rows[0].severity, Severity::Error, "{rows:?}");
        let exponent = rows.iter().find(|row| row.text.contains("exponent")).expect("a row about the exponent");
        assert_eq!((exponent.item, exponent.field), (Some(Item::Material(0)), Some("Exponent m")), "its place");
        assert_eq!(rows.last().map(|row| row.severity), Some(Severity::Warning), "then what is likely not meant");
    }

    #[test]
    fn the_scene_that_comes_first_has_no_problems() {
        assert_eq!(rows(&first_light(), None), [], "nothing to say");
    }
}
