//! A plot's numbers.

use egui::Ui;
use glam::DVec3;

use super::fields::{Fields, Number};
use super::surface::material_names;
use crate::editor::edits;
use crate::scene::{Plot, PlotKind, PlotQuantity, Scene};

pub(super) fn show(ui: &mut Ui, fields: &mut Fields<'_>, index: usize) {
    let Some(plot) = fields.scene().plots.get(index).cloned() else { return };
    fields.section(ui, "Plot", |ui, fields| {
        let kinds = [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance];
        let kinds = kinds.map(|kind| (kind, edits::kind_name(kind).to_owned()));
        fields.choice(ui, "Kind", &plot.kind, &kinds, at(index, set_kind));
        let quantities = [
            (PlotQuantity::Irradiance, "irradiance".to_owned()),
            (PlotQuantity::Specular, "specular".to_owned()),
            (PlotQuantity::Radiance, "radiance".to_owned()),
        ];
        fields.choice(ui, "Quantity", &plot.quantity, &quantities, at(index, |plot, q| plot.quantity = q));
        let range = if turns(plot.kind) { Number::ANGLE } else { range_in_metres(plot.kind) };
        fields.number(ui, "From", &range, plot.range[0], at(index, |plot, x| plot.range[0] = x));
        fields.number(ui, "To", &range, plot.range[1], at(index, |plot, x| plot.range[1] = x));
        fields.toggle(ui, "Normalise", plot.normalise, at(index, |plot, normalise| plot.normalise = normalise));
    });
    fields.section(ui, "Probe", |ui, fields| {
        fields.vector(ui, "Position", &Number::PLACE, plot.position, at(index, |plot, p| plot.position = p));
        fields.vector(ui, "Normal", &Number::DIRECTION, plot.normal, at(index, |plot, n| plot.normal = n));
        let axis = if turns(plot.kind) { "Turns about" } else { "Moves along" };
        fields.vector(ui, axis, &Number::DIRECTION, plot.axis, at(index, |plot, axis| plot.axis = axis));
        let set = at(index, |plot: &mut Plot, given: bool| plot.view = given.then_some(plot.normal));
        fields.toggle(ui, "Own view", plot.view.is_some(), set);
        if let Some(view) = plot.view {
            let set = at(index, |plot: &mut Plot, view: DVec3| plot.view = Some(view));
            fields.vector(ui, "Seen from", &Number::DIRECTION, view, set);
        }
        let first = (None, "scene’s first".to_owned());
        let others = material_names(fields.scene()).into_iter().map(|name| (Some(name.clone()), name));
        let materials: Vec<_> = std::iter::once(first).chain(others).collect();
        fields.choice(ui, "Material", &plot.material, &materials, at(index, |plot, m| plot.material = m));
    });
}

/// Whether the abscissa is an angle.
fn turns(kind: PlotKind) -> bool {
    matches!(kind, PlotKind::Tilt | PlotKind::View)
}

fn range_in_metres(kind: PlotKind) -> Number {
    // A distance is on a logarithmic axis.
    if kind == PlotKind::Distance { Number::LENGTH } else { Number::PLACE }
}

/// Another kind keeps the range where that means the same, and else starts with its own.
fn set_kind(plot: &mut Plot, kind: PlotKind) {
    if turns(plot.kind) != turns(kind) || kind == PlotKind::Distance {
        plot.range = edits::default_range(kind);
    }
    plot.kind = kind;
}

fn at<T>(index: usize, set: impl Fn(&mut Plot, T)) -> impl Fn(&mut Scene, T) {
    move |scene, value| {
        if let Some(plot) = scene.plots.get_mut(index) {
            set(plot, value);
        }
    }
}
