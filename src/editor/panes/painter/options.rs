//! What is chosen for the painter's tools.

use std::ops::RangeInclusive;

use egui::{ComboBox, DragValue, Grid, Response, Ui, vec2};

use glam::DVec3;

use super::tools::{Ink, Mirrors, Options, PaintTool};
use crate::editor::panes::bars;
use crate::light::pattern::paint::fill::Course;

/// Diameters of brushes, texels.
pub(super) const SIZES: RangeInclusive<f64> = 1.0..=1024.0;
/// The greatest value that is painted: pictures that know more than 1 may have lamps in them.
const MOST_VALUE: f32 = 1000.0;
/// Width of a number, points.
const WIDTH: f32 = 84.0;
/// Its height.
const HEIGHT: f32 = 19.0;

/// The options as rows; those that the tool does not heed are greyed out, so that nothing jumps.
pub(super) fn show(ui: &mut Ui, options: &mut Options) {
    use PaintTool::{Brush, Ellipse, Eraser, Fill, Gradient, Line, Rectangle};
    let tool = options.tool;
    let shape = matches!(tool, Rectangle | Ellipse);
    let brushed = matches!(tool, Brush | Eraser | Line) || (shape && !options.filled);
    Grid::new("paint options").num_columns(2).spacing(vec2(8.0, 5.0)).min_col_width(60.0).show(ui, |ui| {
        row(ui, "Size", "Paint size", "Brush diameter in texels; [ and ] change it", brushed, |ui| {
            let drag = DragValue::new(&mut options.brush.size).range(SIZES).speed(0.25).max_decimals(1).suffix(" tx");
            ui.add_sized(vec2(WIDTH, HEIGHT), drag)
        });
        row(ui, "Hardness", "Paint hardness", "Of the brush’s edge; Shift+[ and Shift+] change it", brushed, |ui| {
            percent(ui, &mut options.brush.hardness)
        });
        row(ui, "Opacity", "Paint opacity", "How much of what was there is covered", true, |ui| {
            let mut opacity = f64::from(options.opacity);
            let response = percent(ui, &mut opacity);
            options.opacity = single(opacity);
            response
        });
        ink(ui, "Value", ["Paint value", "Paint colour"], &mut options.ink, tool != Eraser);
        ink(ui, "To value", ["Second value", "Second colour"], &mut options.second, tool == Gradient);
        match tool {
            Fill => row(ui, "Tolerance", "Fill tolerance", "How much texels may differ to be filled", true, |ui| {
                let drag = DragValue::new(&mut options.tolerance).range(0.0..=10.0).speed(0.005).max_decimals(3);
                ui.add_sized(vec2(WIDTH, HEIGHT), drag)
            }),
            Rectangle | Ellipse => {
                let hint = "Fill the shape, or draw its outline with the brush";
                row(ui, "Shape", "Filled shape", hint, true, |ui| ui.checkbox(&mut options.filled, "filled"));
            }
            Gradient => row(ui, "Course", "Radial gradient", "Around its first end, or along the way", true, |ui| {
                let mut radial = options.course == Course::Radial;
                let response = ui.checkbox(&mut radial, "radial");
                options.course = if radial { Course::Radial } else { Course::Linear };
                response
            }),
            _ => {}
        }
    });
}

/// Where what is painted is repeated.
pub(super) fn symmetry(ui: &mut Ui, options: &mut Options) {
    ui.weak("Symmetry");
    let combo = ComboBox::from_id_salt("symmetry").selected_text(options.mirrors.name()).width(84.0);
    let inner = combo.show_ui(ui, |ui| {
        for mirrors in Mirrors::ALL {
            ui.selectable_value(&mut options.mirrors, mirrors, mirrors.name());
        }
    });
    let hint = "What is painted is repeated mirrored, or around the middle; gradients are not";
    inner.response.on_hover_text(hint).accessible_name("Paint symmetry");
    let copies = DragValue::new(&mut options.copies).range(2..=64).speed(0.05).prefix("× ");
    let response = ui.add_enabled(options.mirrors == Mirrors::Radial, copies);
    response.on_hover_text("Copies around the middle").accessible_name("Symmetry copies");
}

/// A value and a tint.
fn ink(ui: &mut Ui, label: &str, [value, color]: [&str; 2], ink: &mut Ink, enabled: bool) {
    ui.weak(label);
    ui.add_enabled_ui(enabled, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let drag = DragValue::new(&mut ink.value).range(0.0..=MOST_VALUE).speed(0.005).max_decimals(4);
            let response = ui.add_sized(vec2(WIDTH - 28.0, HEIGHT), drag);
            response.on_hover_text("Share of the light’s luminance; X swaps both").accessible_name(value);
            let mut tint = DVec3::from_array(ink.tint.map(f64::from));
            if bars::color_button(ui, color, "Tint, linear Rec. 709", &mut tint).changed() {
                ink.tint = tint.as_vec3().to_array();
            }
        });
    });
    ui.end_row();
}

fn row(ui: &mut Ui, label: &str, name: &str, hint: &str, enabled: bool, widget: impl FnOnce(&mut Ui) -> Response) {
    ui.weak(label);
    ui.add_enabled_ui(enabled, |ui| widget(ui).on_hover_text(hint).accessible_name(name));
    ui.end_row();
}

/// A share, shown in percent.
fn percent(ui: &mut Ui, share: &mut f64) -> Response {
    let mut percent = 100.0 * *share;
    let drag = DragValue::new(&mut percent).range(0.0..=100.0).speed(0.5).max_decimals(0).suffix(" %");
    let response = ui.add_sized(vec2(WIDTH, HEIGHT), drag);
    if response.changed() {
        *share = percent / 100.0;
    }
    response
}

#[expect(clippy::cast_possible_truncation, reason = "a share of a texel")]
fn single(value: f64) -> f32 {
    value as f32
}
