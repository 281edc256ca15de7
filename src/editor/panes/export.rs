//! The export dialog: what to write, and what becomes of each thing before anything is written.

use std::collections::BTreeSet;

use egui::{Align, Button, Checkbox, Color32, ComboBox, DragValue, Grid, Id, Layout, Modal, RichText, ScrollArea, Ui};
use egui::{Visuals, vec2};

use crate::editor::commands::view_methods;
use crate::editor::exporting::{Exporting, Form};
use crate::editor::session::Session;
use crate::export::{Exported, Fate, Remark, Target};
use crate::render::MethodChoice;
use crate::scene::Scene;
use crate::shading::fit::{Budget, COUNTS};

/// Width of the dialog, points.
const WIDTH: f32 = 620.0;
/// The list of lights, and that of what becomes of things, scroll beyond these heights, points.
const HEIGHTS: [f32; 2] = [96.0, 220.0];
/// Width of the word that says what becomes of a thing, points.
const FATE: f32 = 56.0;
/// Its colour where all is well; good on dark and on bright.
const KEPT: Color32 = Color32::from_rgb(0x4c, 0xa8, 0x6c);
/// The error that a fit may have at first, as a share.
const WORST: f64 = 0.05;
/// Sides of pictures, pixels.
const SIDES: std::ops::RangeInclusive<u32> = 16..=8192;

/// Show the dialog. `Some(true)` when the files are to be written, `Some(false)` when it is to be closed.
pub(in crate::editor) fn ask_export(ctx: &egui::Context, exporting: &mut Exporting, session: &Session) -> Option<bool> {
    let modal = Modal::new(Id::unique("export")).show(ctx, |ui| {
        ui.set_width(WIDTH.min(ctx.content_rect().width() - 40.0));
        ui.heading(format!("Export “{}”", session.title()));
        ui.add_space(6.0);
        Grid::new("export").num_columns(2).spacing(vec2(10.0, 6.0)).min_col_width(70.0).show(ui, |ui| {
            fields(ui, &mut exporting.form, session.scene());
        });
        if let Some(names) = &mut exporting.form.lights {
            ui.separator();
            lights(ui, names, session.scene());
        }
        ui.separator();
        fates(ui, exporting);
        ui.separator();
        buttons(ui, exporting)
    });
    if modal.should_close() { Some(false) } else { modal.inner }
}

/// What to write.
fn fields(ui: &mut Ui, form: &mut Form, scene: &Scene) {
    ui.weak("Target");
    let combo = ComboBox::from_id_salt("target").selected_text(form.target.title()).width(360.0).height(400.0);
    let response = combo.show_ui(ui, |ui| {
        for target in Target::ALL {
            ui.selectable_value(&mut form.target, target, target.title());
        }
    });
    response.response.on_hover_text("The program or format that it is for").accessible_name("Export target");
    ui.end_row();
    ui.weak("Lights");
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 16.0;
        let all = ui.radio(form.lights.is_none(), "all that shine").on_hover_text("Lights that are muted are left out");
        if all.accessible_name("Export all lights").clicked() {
            form.lights = None;
        }
        let chosen = ui.radio(form.lights.is_some(), "chosen ones").on_hover_text("Those that are ticked below");
        if chosen.accessible_name("Export chosen lights").clicked() && form.lights.is_none() {
            form.lights = Some(scene.lights.iter().map(|light| light.name.clone()).collect());
        }
    });
    ui.end_row();
    ui.weak("Surfaces");
    let boxed = ui.checkbox(&mut form.surfaces, "with surfaces and their materials");
    boxed.on_hover_text("Targets that hold only lights say so below").accessible_name("Export surfaces");
    ui.end_row();
    options(ui, form, scene);
}

/// A box for each light.
fn lights(ui: &mut Ui, names: &mut BTreeSet<String>, scene: &Scene) {
    ScrollArea::vertical().max_height(HEIGHTS[0]).auto_shrink([false, true]).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            for light in &scene.lights {
                let mut is_chosen = names.contains(&light.name);
                let response = ui.add(Checkbox::new(&mut is_chosen, &light.name));
                if response.accessible_name(format!("Export {}", light.name)).clicked() {
                    if is_chosen {
                        names.insert(light.name.clone());
                    } else {
                        names.remove(&light.name);
                    }
                }
            }
        });
    });
}

/// What only some targets look at.
fn options(ui: &mut Ui, form: &mut Form, scene: &Scene) {
    if matches!(form.target, Target::Png | Target::Exr | Target::Wgsl | Target::Glsl) {
        ui.weak("Shaded by");
        let combo = ComboBox::from_id_salt("method").selected_text(form.options.method.to_string());
        let response = combo.show_ui(ui, |ui| {
            for method in view_methods(scene).into_iter().map(MethodChoice::Method) {
                ui.selectable_value(&mut form.options.method, method, method.to_string());
            }
        });
        response.response.on_hover_text("The method of all lights").accessible_name("Export method");
        ui.end_row();
    }
    match form.target {
        Target::Png | Target::Exr => {
            ui.weak("Size");
            ui.horizontal(|ui| {
                for (side, name) in form.options.size.iter_mut().zip(["Export width", "Export height"]) {
                    let number = DragValue::new(side).range(SIDES).suffix(" px").update_while_editing(false);
                    ui.add(number).on_hover_text("Pixels").accessible_name(name);
                }
            });
            ui.end_row();
        }
        Target::Gltf => {
            ui.weak("Each light");
            budget(ui, &mut form.options.punctual);
            ui.end_row();
        }
        _ => {}
    }
}

/// How many punctual lights stand for a light: so many, or as few as a bound of the error allows.
fn budget(ui: &mut Ui, budget: &mut Budget) {
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 8.0;
        let by_count = matches!(budget, Budget::Count(_));
        let hint = "So many punctual lights stand for it at most";
        let count = ui.radio(by_count, "at most").on_hover_text(hint).accessible_name("Fit by number");
        if count.clicked() && !by_count {
            *budget = Budget::default();
        }
        let hint = "As few as keep the worst error of its illuminance at most at this share";
        let worst = ui.radio(!by_count, "error up to").on_hover_text(hint).accessible_name("Fit by error");
        if worst.clicked() && by_count {
            *budget = Budget::Worst(WORST);
        }
        match budget {
            Budget::Count(count) => {
                let number = DragValue::new(count).range(COUNTS).speed(0.05).suffix(" punctual lights");
                ui.add(number).on_hover_text("Punctual lights").accessible_name("Most punctual lights");
            }
            Budget::Worst(worst) => {
                let mut percent = 100.0 * *worst;
                let number = DragValue::new(&mut percent).range(0.1..=100.0).speed(0.1).suffix(" %");
                if ui.add(number).on_hover_text("Worst error, %").accessible_name("Worst error of a fit").changed() {
                    *worst = 0.01 * percent;
                }
            }
        }
    });
}

/// What becomes of each thing, worst first.
fn fates(ui: &mut Ui, exporting: &Exporting) {
    match exporting.found() {
        None => {
            ui.weak("Working out what becomes of each thing…");
            ui.add_space(HEIGHTS[1]);
        }
        Some(Err(error)) => {
            ui.colored_label(ui.visuals().error_fg_color, error);
        }
        Some(Ok(exported)) => {
            ui.label(RichText::new(told(exported)).strong());
            let mut remarks: Vec<&Remark> = exported.remarks.iter().collect();
            remarks.sort_by_key(|remark| std::cmp::Reverse(remark.fate));
            let area = ScrollArea::vertical().id_salt("fates").max_height(HEIGHTS[1]).auto_shrink([false, true]);
            area.show(ui, |ui| remarks.into_iter().for_each(|remark| row(ui, remark)));
        }
    }
}

/// What becomes of a thing; lines after the first begin where the thing's name does.
fn row(ui: &mut Ui, remark: &Remark) {
    ui.horizontal_top(|ui| {
        let color = color(remark.fate, ui.visuals());
        let start = ui.cursor().left();
        ui.colored_label(color, remark.fate.name());
        ui.add_space((start + FATE - ui.cursor().left()).max(0.0));
        let mut text = egui::text::LayoutJob::default();
        let parts = [RichText::new(&remark.thing), RichText::new(format!("  {}", remark.what)).weak()];
        for part in parts {
            part.append_to(&mut text, ui.style(), egui::FontSelection::Default, Align::Center);
        }
        ui.add(egui::Label::new(text).wrap());
    });
}

fn color(fate: Fate, visuals: &Visuals) -> Color32 {
    match fate {
        Fate::Kept => KEPT,
        Fate::Changed => visuals.warn_fg_color,
        Fate::Lost => visuals.error_fg_color,
    }
}

/// How much is kept, changed and lost, and how many files there are.
fn told(exported: &Exported) -> String {
    let count = |fate| exported.remarks.iter().filter(|remark| remark.fate == fate).count();
    let [kept, changed, lost] = [Fate::Kept, Fate::Changed, Fate::Lost].map(count);
    let files = exported.files.len();
    format!("{kept} kept, {changed} changed, {lost} lost; {files} file{}", if files == 1 { "" } else { "s" })
}

/// `Some(true)` to write, `Some(false)` to close.
fn buttons(ui: &mut Ui, exporting: &mut Exporting) -> Option<bool> {
    let mut answer = None;
    ui.horizontal(|ui| {
        if exporting.found().is_some_and(|found| found.is_ok_and(Exported::has_losses)) {
            let boxed = ui.checkbox(&mut exporting.anyway, "Export anyway");
            boxed.on_hover_text("Write what the target can hold; what is lost is not in the file");
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let write = Button::new(RichText::new("Export").strong()).fill(ui.visuals().selection.bg_fill);
            let response = ui.add_enabled(exporting.is_ready(), write).accessible_name("Write export");
            let why = "Something would be lost: tick “Export anyway”, or choose another target";
            if response.on_hover_text("Choose where to put it").on_disabled_hover_text(why).clicked() {
                answer = Some(true);
            }
            if ui.button("Cancel").clicked() {
                answer = Some(false);
            }
        });
    });
    answer
}
