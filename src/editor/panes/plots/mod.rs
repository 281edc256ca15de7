//! The scene's plots: every method's curve on the same axes, their errors, and a legend with the figures.
//!
//! Curves are worked out aside ([`work`]), shown as they come, and stay, faint, until newer ones are there.

mod axes;
mod chart;
mod curve;
mod frame;
mod header;
mod legend;
mod polar;
mod work;

pub use work::Work;

use egui::{Ui, vec2};

use self::axes::Axes;
use self::chart::Chart;
use self::curve::Drawn;
use self::header::header;
use self::legend::{Asked, Entry, Figures};
use self::work::{Shown, Worker};
use crate::analysis::{Curves, Pin, Sheet, Trace, methods_for};
use crate::editor::commands::Command;
use crate::editor::plotting::{PlotState, pin_name};
use crate::editor::session::{Item, Session};
use crate::scene::Plot;
use crate::shading::Method;

/// Width of the legend, points.
const LEGEND_WIDTH: f32 = 340.0;
/// Width that is left to the curves at least, points.
const LEAST_CHART_WIDTH: f32 = 160.0;

/// The pane's own state.
#[derive(Default)]
pub struct Plots {
    worker: Worker,
    axes: Axes,
    /// What the legend was asked for in the frame before.
    asked: Asked,
}

impl Plots {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let mut commands = Vec::new();
        let scene = session.shown();
        session.plots.active = session.plots.active.min(scene.plots.len().saturating_sub(1));
        let plot = scene.plots.get(session.plots.active);
        if let Some(plot) = plot {
            self.worker.update(ui.ctx(), &scene, plot);
        }
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 6)).show(ui, |ui| {
            if header(ui, session, self.worker.fine(), &mut commands) {
                self.pin(session, Method::Exact);
            }
            match plot {
                Some(plot) => self.contents(ui, session, plot, &methods_for(&scene)),
                None => {
                    ui.add_space(20.0);
                    ui.vertical_centered(|ui| ui.weak("No plots yet: add one by +, and drag its probe in the view."));
                }
            }
        });
        commands
    }

    /// Whether curves are still being worked out.
    pub fn is_busy(&self) -> bool {
        self.worker.is_busy()
    }

    /// What has been asked for and done.
    pub fn work(&self) -> Work {
        self.worker.work
    }

    fn contents(&mut self, ui: &mut Ui, session: &mut Session, plot: &Plot, methods: &[Method]) {
        let rows: Vec<_> = methods.iter().map(|method| (*method, self.worker.series(plot, *method))).collect();
        let state = session.plots.clone();
        let drawn = drawn(&rows, &state, self.asked.pointed);
        let look = session.plots.look(plot);
        let before = session.plots.cursor.take();
        let legend = ui.horizontal_top(|ui| {
            let width = (ui.available_width() - LEGEND_WIDTH).max(LEAST_CHART_WIDTH);
            let size = vec2(width, ui.available_height());
            ui.allocate_ui(size, |ui| {
                ui.set_min_size(size);
                let Some(of) = rows.iter().find_map(|(_, shown)| shown.map(|shown| shown.curves)) else { return };
                let labels = [of.x_label.as_str(), of.y_label.as_str()];
                let chart = Chart {
                    plot,
                    drawn: &drawn,
                    look,
                    labels,
                    logarithmic_x: of.logarithmic_x,
                    complete: self.worker.is_complete(),
                };
                let (cursor, hint) = chart.show(ui, &mut self.axes);
                session.plots.cursor = cursor;
                if let Some(hint) = hint {
                    session.hint = hint.to_owned();
                }
            });
            let figures = session.plots.cursor.map_or(Figures::Errors, Figures::At);
            legend::show(ui, &rows, self.worker.fine(), figures, &mut session.plots)
        });
        // The view, drawn before, shows the probe at the abscissa under the pointer; curves drawn before stand out.
        if before != session.plots.cursor || legend.inner.pointed != self.asked.pointed {
            ui.ctx().request_repaint();
        }
        self.asked = legend.inner;
        if let Some(method) = self.asked.pin.take() {
            self.pin(session, method);
        }
    }

    /// Keep a curve as it is now.
    fn pin(&self, session: &mut Session, method: Method) {
        let Some(fine) = self.worker.fine() else { return };
        let selected = match session.selection.primary() {
            Some(Item::Light(index)) => Some(index),
            _ => None,
        };
        let name = pin_name(session.scene(), selected);
        let name = if method == Method::Exact { name } else { format!("{name} ({method})") };
        let Some(series) = fine.series.iter().find(|series| series.method == method) else { return };
        let labels = [fine.x_label.clone(), fine.y_label.clone()];
        session.plots.pin(Pin { name, labels, x: fine.x.clone(), y: series.y.clone() });
    }
}

/// What is drawn, in drawing order.
fn drawn<'a>(rows: &[(Method, Option<Shown<'a>>)], state: &'a PlotState, pointed: Option<Entry>) -> Vec<Drawn<'a>> {
    let visible = |method: &Method| !state.hidden.contains(&method.to_string());
    let present = rows.iter().find_map(|(_, shown)| *shown).map(|shown| shown.curves);
    let stands_out = |entry: Entry| (pointed == Some(entry), pointed.is_some_and(|pointed| pointed != entry));
    let methods = rows.iter().filter(|(method, _)| visible(method)).filter_map(|(method, shown)| {
        let Shown { curves, series, stale } = (*shown)?;
        let (raised, lowered) = stands_out(Entry::Method(*method));
        let trace = Trace::of_series(series, &curves.x, &curves.exact);
        Some(Drawn { trace, stale, raised, lowered })
    });
    let pins = state.pins.iter().filter(|pinned| !pinned.hidden && present.is_some_and(|of| pinned.pin.fits(of)));
    let pins = pins.map(|pinned| {
        let (raised, lowered) = stands_out(Entry::Pin(pinned.pen));
        let trace = Trace::of_pin(&pinned.pin, pinned.pen);
        Drawn { trace, stale: false, raised, lowered }
    });
    let mut drawn: Vec<_> = methods.chain(pins).collect();
    drawn.sort_by_key(|drawn| (drawn.raised, drawn.trace.layer()));
    drawn
}

/// The plot as it is shown, for an export.
fn sheet(plot: &Plot, fine: &Curves, state: &PlotState) -> Sheet {
    let mut curves = fine.clone();
    curves.series.retain(|series| !state.hidden.contains(&series.method.to_string()));
    let pins = state.pins.iter().filter(|pinned| !pinned.hidden && pinned.pin.fits(fine));
    let pins = pins.map(|pinned| (pinned.pen, pinned.pin.clone())).collect();
    Sheet { plot: plot.clone(), curves, pins, look: state.look(plot) }
}
