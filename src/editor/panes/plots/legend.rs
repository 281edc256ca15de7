//! The legend: which curves are drawn, how they look, how far off they are and what they cost; and the pinned ones.

use egui::{
    Color32, Label, Layout, Rect, Response, RichText, Role, Sense, Stroke, TextStyle, Ui, UiBuilder, WidgetInfo,
    WidgetText, pos2, vec2,
};
use egui_material_icons::icons;

use super::curve::dashed;
use super::work::Shown;
use crate::analysis::axis::three_digits;
use crate::analysis::{Curves, Pen, Pin, interpolated, unit};
use crate::editor::panes::icon_button;
use crate::editor::plotting::{Pinned, PlotState};
use crate::editor::theme;
use crate::shading::Method;

/// Width of the columns of figures, points.
const FIGURES: [f32; 3] = [58.0, 54.0, 52.0];
/// Width of a sample of a curve, points: the longest pattern of dashes fits.
const SAMPLE: f32 = 30.0;
/// Height of a row, points: what lies between suits the pane.
const ROWS: [f32; 2] = [14.5, 17.0];
/// Room for the button at the end of a row, points.
const BUTTON: f32 = 22.0;
/// Room for a method's name, points; the longest reach into what short figures leave of the first column.
const NAME: f32 = 72.0;

/// What the legend was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Asked {
    /// The curve that is pointed at.
    pub(super) pointed: Option<Entry>,
    /// The curve that shall be pinned.
    pub(super) pin: Option<Method>,
}

/// A row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Entry {
    /// A method's.
    Method(Method),
    /// The pinned curve of that pen.
    Pin(usize),
}

/// What stands in the columns of figures.
#[derive(Clone, Copy, Debug)]
pub(super) enum Figures {
    /// Greatest and RMS error, and cost.
    Errors,
    /// Value, difference from the exact one, and that in %, at an abscissa.
    At(f64),
}

/// Show the legend; clicks take curves out of sight and back.
pub(super) fn show(
    ui: &mut Ui,
    rows: &[(Method, Option<Shown<'_>>)],
    present: Option<&Curves>,
    figures: Figures,
    state: &mut PlotState,
) -> Asked {
    let mut asked = Asked::default();
    ui.vertical(|ui| {
        let count = 1 + rows.len() + state.pins.len();
        ui.spacing_mut().interact_size.y = (ui.available_height() / count as f32).clamp(ROWS[0], ROWS[1]);
        // That there is more is seen without pointing at it.
        ui.spacing_mut().scroll.dormant_handle_opacity = 0.6;
        egui::ScrollArea::vertical().id_salt("legend").auto_shrink(false).show(ui, |ui| {
            ui.spacing_mut().item_spacing.y = 0.0;
            heading(ui, rows.iter().find_map(|(_, shown)| shown.map(|shown| shown.curves)), figures);
            pins(ui, present, figures, state, &mut asked);
            for (method, shown) in rows {
                method_row(ui, *method, *shown, figures, state, &mut asked);
            }
        });
    });
    asked
}

/// Height of a row: that of what one acts on.
fn row(ui: &Ui) -> f32 {
    ui.spacing().interact_size.y
}

fn heading(ui: &mut Ui, curves: Option<&Curves>, figures: Figures) {
    let rect = ui.allocate_exact_size(vec2(ui.available_width(), row(ui)), Sense::hover()).0;
    let labels = curves.map_or(["", ""], |curves| [&curves.x_label, &curves.y_label].map(|label| unit(label)));
    let in_unit = |name: &str| if labels[1].is_empty() { name.to_owned() } else { format!("{name} ({})", labels[1]) };
    let weak = |text: String| RichText::new(text).small().weak();
    cells(ui, rect, |ui| {
        let titles = match figures {
            Figures::Errors => {
                ui.add_space(SAMPLE + ui.spacing().item_spacing.x);
                plain(ui, weak("method".to_owned()));
                [in_unit("max"), "RMS".to_owned(), "cost".to_owned()]
            }
            Figures::At(x) => {
                let space = if labels[0] == "°" { "" } else { " " };
                plain(ui, RichText::new(format!("At {}{space}{}", short(x), labels[0])).strong());
                [in_unit("value"), "\u{2212} exact".to_owned(), "%".to_owned()]
            }
        };
        columns(ui, titles.map(weak), |ui| ui.add_space(BUTTON));
    });
}

/// The columns of figures that a row has room for beside a name: all of them, or the first.
fn columns_in(ui: &Ui) -> &'static [f32] {
    let space = ui.spacing().item_spacing.x;
    let room = ui.max_rect().width() - SAMPLE - NAME - BUTTON - 2.0 * space;
    let fits = |count: &usize| FIGURES[..*count].iter().map(|width| width + space).sum::<f32>() <= room;
    &FIGURES[..(1..=FIGURES.len()).rev().find(fits).unwrap_or(1)]
}

/// Figures in their columns, and `last` at the end of the row.
fn columns(ui: &mut Ui, texts: [RichText; 3], last: impl FnOnce(&mut Ui)) {
    let widths = columns_in(ui);
    ui.with_layout(Layout::right_to_left(egui::Align::Center), |ui| {
        last(ui);
        for (width, text) in widths.iter().zip(texts).rev() {
            cell(ui, *width, text);
        }
    });
}

/// What is read of a curve at an abscissa.
fn reading(value: Option<f64>, exact: Option<f64>) -> [String; 3] {
    let Some(value) = value else { return Default::default() };
    let [difference, percent] = exact.map_or_else(Default::default, |exact| {
        let apart = value - exact;
        let share = 100.0 * apart / exact;
        let sign = if apart < 0.0 { "" } else { "+" };
        let percent = match share {
            share if !share.is_finite() => String::new(),
            share if share.abs() >= 1000.0 => ">1000".to_owned(),
            share => format!("{sign}{share:.1}").replace('-', "\u{2212}"),
        };
        [format!("{sign}{}", short(apart)), percent]
    });
    [short(value), difference, percent]
}

fn method_row(
    ui: &mut Ui,
    method: Method,
    shown: Option<Shown<'_>>,
    figures: Figures,
    state: &mut PlotState,
    asked: &mut Asked,
) {
    let name = method.to_string();
    let visible = !state.hidden.contains(&name);
    let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), row(ui)), Sense::click());
    let label = format!("Show {name}");
    response.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, visible, &label));
    if response.clicked() && !state.hidden.remove(&name) {
        state.hidden.insert(name.clone());
    }
    let hovered = highlight(ui, rect, &response);
    let texts = shown.map_or_else(|| ["…"; 3].map(str::to_owned), |shown| method_figures(shown, figures));
    cells(ui, rect, |ui| {
        faint_unless(ui, visible);
        sample(ui, &Pen::of(method));
        let text = RichText::new(&name);
        painted(ui, if visible { text } else { text.strikethrough() });
        columns(ui, texts.map(|text| RichText::new(text).monospace()), |ui| {
            let color = if hovered { ui.visuals().text_color() } else { Color32::TRANSPARENT };
            let pin = icon_button(ui, icons::ICON_PUSH_PIN, color, &format!("Pin {name}"));
            if pin.clicked() && shown.is_some() {
                asked.pin = Some(method);
            }
        });
    });
    if hovered {
        asked.pointed = Some(Entry::Method(method));
    }
}

fn method_figures(Shown { curves, series, .. }: Shown<'_>, figures: Figures) -> [String; 3] {
    let is_exact = series.method == Method::Exact;
    match figures {
        Figures::Errors => {
            let error = |error: f64| if is_exact { String::new() } else { short(error) };
            [error(series.max_error), error(series.rms_error), duration(series.cost_ns)]
        }
        Figures::At(x) => {
            let exact = interpolated(&curves.x, &curves.exact, x).filter(|_| !is_exact);
            reading(interpolated(&curves.x, &series.y, x), exact)
        }
    }
}

/// The pinned curves: their names to be edited, and how far the exact curve is from each now.
fn pins(ui: &mut Ui, present: Option<&Curves>, figures: Figures, state: &mut PlotState, asked: &mut Asked) {
    if state.pins.is_empty() {
        return;
    }
    let mut removed = None;
    for (i, pinned) in state.pins.iter_mut().enumerate() {
        let (rect, response) = ui.allocate_exact_size(vec2(ui.available_width(), row(ui)), Sense::hover());
        let fits = present.filter(|curves| pinned.pin.fits(curves));
        let texts = fits.map_or_else(Default::default, |curves| pin_figures(&pinned.pin, curves, figures));
        highlight(ui, rect, &response);
        cells(ui, rect, |ui| {
            faint_unless(ui, fits.is_some() && !pinned.hidden);
            if pin_row(ui, i + 1, pinned, fits.is_some(), texts) {
                removed = Some(i);
            }
        });
        if response.contains_pointer() {
            asked.pointed = Some(Entry::Pin(pinned.pen));
        }
    }
    let line = ui.allocate_exact_size(vec2(ui.available_width(), 5.0), Sense::hover()).0;
    ui.painter().hline(line.x_range(), line.center().y, ui.visuals().widgets.noninteractive.bg_stroke);
    if let Some(i) = removed {
        state.pins.remove(i);
    }
}

/// The pinned curve of a number; whether it shall go.
fn pin_row(ui: &mut Ui, number: usize, pinned: &mut Pinned, fits: bool, texts: [String; 3]) -> bool {
    let shown = sample(ui, &Pen::pinned(pinned.pen)).interact(Sense::click());
    let label = format!("Show pin {number}");
    shown.widget_info(|| WidgetInfo::selected(Role::CheckBox, true, !pinned.hidden, &label));
    if shown.on_hover_text("Show or hide this pinned curve").clicked() {
        pinned.hidden ^= true;
    }
    let figures = columns_in(ui).iter().map(|width| width + ui.spacing().item_spacing.x).sum::<f32>();
    let width = ui.available_width() - figures - BUTTON - ui.spacing().item_spacing.x;
    let hint = if fits { "Click to rename" } else { "This plot has other axes than the pinned curve" };
    let hint = format!("{}\n{hint}", pinned.pin.name);
    let name = egui::TextEdit::singleline(&mut pinned.pin.name).frame(egui::Frame::NONE);
    let edit = ui.add_sized(vec2(width, row(ui) - 2.0), name).on_hover_text(hint);
    edit.accessible_name(format!("Name of pin {number}"));
    let mut removed = false;
    columns(ui, texts.map(|text| RichText::new(text).monospace()), |ui| {
        let color = ui.visuals().weak_text_color();
        removed = icon_button(ui, icons::ICON_CLOSE, color, &format!("Remove pin {number}")).clicked();
    });
    removed
}

fn pin_figures(pin: &Pin, curves: &Curves, figures: Figures) -> [String; 3] {
    match figures {
        Figures::Errors => {
            let [max, rms] = pin.distance(curves).map_or_else(Default::default, |apart| apart.map(short));
            [max, rms, String::new()]
        }
        Figures::At(x) => {
            let [value, exact] = [(&pin.x, &pin.y), (&curves.x, &curves.exact)].map(|(xs, y)| interpolated(xs, y, x));
            reading(value, exact)
        }
    }
}

/// Widgets in a row, from the left.
fn cells(ui: &mut Ui, rect: Rect, contents: impl FnOnce(&mut Ui)) {
    let layout = Layout::left_to_right(egui::Align::Center);
    let mut row = ui.new_child(UiBuilder::new().max_rect(rect.shrink2(vec2(3.0, 0.0))).layout(layout));
    row.spacing_mut().item_spacing.x = 6.0;
    contents(&mut row);
}

/// A cell of a column of figures.
fn cell(ui: &mut Ui, width: f32, text: RichText) {
    let layout = Layout::right_to_left(egui::Align::Center);
    ui.allocate_ui_with_layout(vec2(width, row(ui)), layout, |ui| {
        ui.set_min_width(width);
        plain(ui, text);
    });
}

/// Text that lets the pointer through.
fn plain(ui: &mut Ui, text: RichText) {
    ui.add(Label::new(text).selectable(false));
}

/// Text that is no widget of its own: its row already bears it as its name.
fn painted(ui: &mut Ui, text: RichText) {
    let galley = WidgetText::from(text).into_galley(ui, None, f32::INFINITY, TextStyle::Body);
    let (rect, _) = ui.allocate_exact_size(galley.size(), Sense::hover());
    ui.painter().galley(rect.min, galley, ui.visuals().text_color());
}

fn faint_unless(ui: &mut Ui, visible: bool) {
    if !visible {
        ui.set_opacity(0.5);
    }
}

/// The ground of a row that is pointed at.
fn highlight(ui: &Ui, rect: Rect, response: &Response) -> bool {
    let hovered = response.contains_pointer();
    if hovered {
        ui.painter().rect_filled(rect, 3.0, ui.visuals().faint_bg_color);
    }
    hovered
}

/// A short piece of a curve.
pub(super) fn sample(ui: &mut Ui, pen: &Pen) -> Response {
    let color = theme::pen_color(pen, ui.visuals());
    let (rect, response) = ui.allocate_exact_size(vec2(SAMPLE, 12.0), Sense::hover());
    let ends = [pos2(rect.left(), rect.center().y), pos2(rect.right(), rect.center().y)];
    ui.painter().extend(dashed(&ends, pen.dashes, Stroke::new(2.0, color)));
    response
}

/// A number with three digits, on one line.
fn short(value: f64) -> String {
    let text = three_digits(value);
    if text.contains('^') { format!("{value:.1e}").replace('-', "\u{2212}") } else { text }
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

    #[test]
    fn readings_tell_how_far_a_value_is_from_the_exact_one() {
        for (value, exact, expected) in [
            (110.0, Some(100.0), ["110", "+10.0", "+10.0"]),
            (75.0, Some(100.0), ["75.0", "\u{2212}25.0", "\u{2212}25.0"]),
            (5.0, Some(0.0), ["5.00", "+5.00", ""]),
            (90.0, Some(1.0), ["90.0", "+89.0", ">1000"]),
            (1.5e-9, None, ["1.5e\u{2212}9", "", ""]),
        ] {
            assert_eq!(reading(Some(value), exact), expected, "{value} for {exact:?}");
        }
        assert_eq!(reading(None, Some(1.0)), ["", "", ""], "nothing to read");
    }
}
