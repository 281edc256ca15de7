//! The legend: which curves are drawn, how they look, how far off they are and what they cost.

use std::collections::BTreeSet;

use egui::{Grid, RichText, Sense, Ui, pos2, vec2};

use super::chart::short;
use super::curve::dashed;
use crate::analysis::Series;
use crate::editor::theme;
use crate::shading::Method;

/// Width of a column of figures, points.
const FIGURE_WIDTH: f32 = 54.0;
/// Width of a sample of a curve, points: the longest pattern of dashes fits.
const SAMPLE_WIDTH: f32 = 30.0;

/// Show the legend; ticks take methods out of `hidden` and put them in.
pub(super) fn show(ui: &mut Ui, methods: &[Method], series: &[Series], hidden: &mut BTreeSet<String>) {
    egui::ScrollArea::vertical().id_salt("legend").show(ui, |ui| {
        Grid::new("legend").num_columns(5).spacing(vec2(6.0, 0.0)).striped(true).show(ui, |ui| {
            ui.label(RichText::new("method").small().weak());
            ui.label("");
            for title in ["max error", "RMS", "cost"] {
                right_aligned(ui, RichText::new(title).small().weak());
            }
            ui.end_row();
            for method in methods {
                row(ui, *method, series.iter().find(|series| series.method == *method), hidden);
                ui.end_row();
            }
        });
    });
}

fn row(ui: &mut Ui, method: Method, series: Option<&Series>, hidden: &mut BTreeSet<String>) {
    let name = method.to_string();
    let mut shown = !hidden.contains(&name);
    if ui.checkbox(&mut shown, &name).accessible_name(format!("Show {name}")).changed() {
        if shown {
            hidden.remove(&name);
        } else {
            hidden.insert(name);
        }
    }
    stroke_sample(ui, method);
    let figure = |ui: &mut Ui, value: Option<String>| {
        let text = RichText::new(value.unwrap_or_else(|| "…".to_owned())).monospace();
        right_aligned(ui, text);
    };
    if method == Method::Exact {
        ui.label("");
        ui.label("");
    } else {
        figure(ui, series.map(|series| short(series.max_error)));
        figure(ui, series.map(|series| short(series.rms_error)));
    }
    figure(ui, series.map(|series| duration(series.cost_ns)));
}

/// A cell of a column of figures.
fn right_aligned(ui: &mut Ui, text: RichText) {
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(vec2(FIGURE_WIDTH, 18.0), layout, |ui| ui.label(text));
}

/// A duration in the unit that suits it.
fn duration(ns: f64) -> String {
    let (value, unit) = match ns {
        ns if ns < 1e3 => (ns, "ns"),
        ns if ns < 1e6 => (1e-3 * ns, "µs"),
        ns => (1e-6 * ns, "ms"),
    };
    let decimals = usize::from(value < 10.0);
    format!("{value:.decimals$} {unit}")
}

/// A short piece of the method's curve.
fn stroke_sample(ui: &mut Ui, method: Method) {
    let (color, dashes) = theme::method_pen(method, ui.visuals());
    let (rect, _) = ui.allocate_exact_size(vec2(SAMPLE_WIDTH, 12.0), Sense::hover());
    let ends = [pos2(rect.left(), rect.center().y), pos2(rect.right(), rect.center().y)];
    ui.painter().extend(dashed(&ends, dashes, egui::Stroke::new(2.0, color)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_duration_is_told_in_the_unit_that_suits_it() {
        for (ns, text) in [(4.25, "4.2 ns"), (110.0, "110 ns"), (1504.0, "1.5 µs"), (2.0e6, "2.0 ms"), (5e7, "50 ms")]
        {
            assert_eq!(duration(ns), text, "{ns} ns");
        }
    }
}
