//! The scene's plots: every method's curve on the same axes, their errors beneath, and a legend with the figures.

mod chart;
mod curve;
mod legend;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use egui::{Ui, vec2};
use egui_material_icons::icons;

use self::chart::Chart;
use crate::analysis::{Curves, curves, methods_for};
use crate::editor::commands::Command;
use crate::editor::edits;
use crate::editor::jobs::Latest;
use crate::editor::session::{Item, Session};
use crate::light::Light;
use crate::scene::{Plot, PlotKind, PlotQuantity, Scene};
use crate::shading::Method;
use crate::surface::Material;

/// Points on each curve.
const SAMPLES: usize = 241;
/// Points on each curve that is shown first where all of them take long.
const FIRST_SAMPLES: usize = 31;
/// Curves through [`FIRST_SAMPLES`] points that take longer than this are shown before those through all.
const PATIENCE: Duration = Duration::from_millis(40);
/// Width of the legend, points.
const LEGEND_WIDTH: f32 = 360.0;
/// The error plot's share of the height.
const ERROR_SHARE: f32 = 0.36;

/// The pane's own state.
#[derive(Default)]
pub struct Plots {
    worker: Option<Latest<Arc<Subject>, Answer>>,
    asked: Option<Arc<Subject>>,
    answer: Option<Answer>,
}

/// All that a plot's curves depend on.
#[derive(Debug, PartialEq)]
struct Subject {
    lights: Vec<Light>,
    materials: Vec<Material>,
    plot: Plot,
}

/// Curves, and what they are of.
struct Answer {
    subject: Arc<Subject>,
    curves: Curves,
}

impl Plots {
    /// Show the pane; the commands that were asked for.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) -> Vec<Command> {
        let mut commands = Vec::new();
        let scene = session.shown();
        session.plots.active = session.plots.active.min(scene.plots.len().saturating_sub(1));
        egui::Frame::new().inner_margin(egui::Margin::symmetric(8, 6)).show(ui, |ui| {
            header(ui, session, &mut commands);
            let Some(plot) = scene.plots.get(session.plots.active) else {
                ui.add_space(20.0);
                ui.vertical_centered(|ui| ui.weak("No plots yet: add one by +, and drag its probe in the view."));
                return;
            };
            self.update(ui.ctx(), &scene, plot);
            let methods = methods_for(&scene);
            let shown = self.answer.as_ref().filter(|answer| answer.subject.plot.name == plot.name);
            ui.horizontal_top(|ui| {
                let size = vec2((ui.available_width() - LEGEND_WIDTH).max(120.0), ui.available_height());
                ui.allocate_ui(size, |ui| {
                    ui.set_min_size(size);
                    ui.vertical(|ui| {
                        if let Some(answer) = shown {
                            let chart = Chart {
                                plot,
                                curves: &answer.curves,
                                hidden: &session.plots.hidden,
                                logarithmic: session.plots.logarithmic,
                            };
                            chart.show(ui, ERROR_SHARE);
                        }
                    });
                });
                let series = shown.map_or(&[][..], |answer| &answer.curves.series);
                legend::show(ui, &methods, series, &mut session.plots.hidden);
            });
        });
        commands
    }

    /// Whether curves are still being worked out.
    pub fn is_busy(&self) -> bool {
        self.worker.as_ref().is_some_and(Latest::is_busy)
    }

    /// Take what has been worked out, and ask again when what is plotted has changed.
    fn update(&mut self, ctx: &egui::Context, scene: &Scene, plot: &Plot) {
        let unchanged = self.asked.as_ref().is_some_and(|asked| {
            asked.plot == *plot && asked.lights == scene.lights && asked.materials == scene.materials
        });
        if self.worker.is_none() {
            let ctx = ctx.clone();
            self.worker = Latest::spawn("curves", move || ctx.request_repaint(), work);
        }
        let Some(worker) = &mut self.worker else { return };
        if !unchanged {
            let subject = Arc::new(Subject {
                lights: scene.lights.clone(),
                materials: scene.materials.clone(),
                plot: plot.clone(),
            });
            self.asked = Some(Arc::clone(&subject));
            worker.submit(subject);
        }
        if let Some(answer) = worker.poll() {
            self.answer = Some(answer);
        }
    }
}

/// All curves but the slow reference, which follows when it is done. Where even the exact curve is by quadrature, as of
/// patterns, all are shown through few points first.
///
/// What takes long is given up when something newer is asked for, but never what is shown first: were that too, a
/// steady drag would show nothing at all.
fn work(subject: Arc<Subject>, cancel: &AtomicBool, answer: &mut dyn FnMut(Answer)) {
    let scene = Scene { lights: subject.lights.clone(), materials: subject.materials.clone(), ..Scene::default() };
    let (reference, quick): (Vec<Method>, Vec<Method>) =
        methods_for(&scene).into_iter().partition(|method| *method == Method::Reference);
    let never = AtomicBool::new(false);
    let start = Instant::now();
    let Some(first) = curves(&scene, &subject.plot, &quick, FIRST_SAMPLES, &never) else { return };
    let is_slow = start.elapsed() > PATIENCE;
    if is_slow {
        answer(Answer { subject: Arc::clone(&subject), curves: first });
    }
    let Some(mut all) = curves(&scene, &subject.plot, &quick, SAMPLES, if is_slow { cancel } else { &never }) else {
        return;
    };
    answer(Answer { subject: Arc::clone(&subject), curves: all.clone() });
    if reference.is_empty() || cancel.load(Ordering::Relaxed) {
        return;
    }
    if let Some(slow) = curves(&scene, &subject.plot, &reference, SAMPLES, cancel) {
        all.series.extend(slow.series);
        answer(Answer { subject, curves: all });
    }
}

/// The plots as tabs, what to add, and the choices that matter most; the rest is in the inspector.
fn header(ui: &mut Ui, session: &mut Session, commands: &mut Vec<Command>) {
    let scene = Arc::clone(session.scene());
    ui.horizontal(|ui| {
        for (index, plot) in scene.plots.iter().enumerate() {
            let active = session.plots.active == index;
            if ui.selectable_label(active, &plot.name).on_hover_text("Show this plot and select its probe").clicked() {
                session.plots.active = index;
                session.selection.set([Item::Plot(index)]);
            }
        }
        let add = egui::Button::new(icons::ICON_ADD.rich_text()).frame(false);
        let (response, _) = egui::containers::menu::MenuButton::from_button(add).ui(ui, |ui| {
            for kind in [PlotKind::Tilt, PlotKind::View, PlotKind::Line, PlotKind::Distance] {
                if ui.button(edits::kind_name(kind)).clicked() {
                    commands.push(Command::AddPlot(kind));
                }
            }
        });
        response.on_hover_text("New plot").accessible_name("New plot");
        let Some(plot) = scene.plots.get(session.plots.active) else { return };
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| choices(ui, session, plot));
    });
}

fn choices(ui: &mut Ui, session: &mut Session, plot: &Plot) {
    let index = session.plots.active;
    ui.checkbox(&mut session.plots.logarithmic, "log").on_hover_text("Logarithmic ordinate");
    let mut changed = plot.clone();
    ui.checkbox(&mut changed.normalise, "normalise").on_hover_text("Divide by the greatest exact value");
    let quantity = |quantity| match quantity {
        PlotQuantity::Irradiance => "irradiance",
        PlotQuantity::Specular => "specular",
        PlotQuantity::Radiance => "radiance",
    };
    let combo = egui::ComboBox::from_id_salt("plot quantity").selected_text(quantity(changed.quantity)).width(84.0);
    let response = combo.show_ui(ui, |ui| {
        for choice in [PlotQuantity::Irradiance, PlotQuantity::Specular, PlotQuantity::Radiance] {
            ui.selectable_value(&mut changed.quantity, choice, quantity(choice));
        }
    });
    response.response.accessible_name("Plotted quantity");
    if changed != *plot {
        session.edit("Change plot", |scene| scene.plots[index] = changed);
    }
}
