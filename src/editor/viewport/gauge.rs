//! Illuminance over a rectangle: its outline with corners to drag, and its numbers.

use std::sync::Arc;

use egui::{Align, Color32, CursorIcon, Frame, Layout, Margin, Painter, Popup, PopupCloseBehavior, Rect, RichText};
use egui::{Sense, Stroke, Ui, UiBuilder, WidgetInfo, pos2, vec2};
use egui_material_icons::icons;
use glam::{DVec2, DVec3};

use super::overlay::PLATE;
use super::projection::Projection;
use super::scales::short;
use crate::analysis::{Measured, Rectangle, measure};
use crate::editor::jobs::Latest;
use crate::editor::session::Session;
use crate::render::{MethodChoice, Shadows};
use crate::scene::Scene;
use crate::shading::Method;

/// Sides of a rectangle, metres.
const SIDES: std::ops::RangeInclusive<f64> = 0.01..=1000.0;
/// A corner is taken hold of within this distance, points.
const REACH: f32 = 8.0;
/// Colour of the outline.
const COLOR: Color32 = Color32::from_rgb(0xff, 0xe0, 0x6b);

/// What is measured.
#[derive(Clone, Debug)]
struct Request {
    scene: Arc<Scene>,
    rectangle: Rectangle,
    method: Method,
    shadows: bool,
}

impl PartialEq for Request {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.scene, &other.scene)
            && self.rectangle == other.rectangle
            && self.method == other.method
            && self.shadows == other.shadows
    }
}

/// Measures off the UI thread; a measurement that has been overtaken is given up.
#[derive(Debug, Default)]
pub struct Gauge {
    job: Option<Latest<Request, Measured>>,
    asked: Option<Request>,
    found: Option<Measured>,
}

impl Gauge {
    /// Whether a measurement is under way.
    pub fn is_busy(&self) -> bool {
        self.job.as_ref().is_some_and(Latest::is_busy)
    }

    /// Measure what the viewport shows; again only where that has changed.
    fn follow(&mut self, ctx: &egui::Context, session: &mut Session) {
        let view = session.view;
        let request = Request {
            scene: session.shown_for(&view),
            rectangle: session.measure.rectangle,
            method: session.view.method,
            shadows: session.view.show_shadows,
        };
        let ctx = ctx.clone();
        let job = self.job.take().or_else(|| Latest::spawn("measure", move || ctx.request_repaint(), answer));
        let Some(mut job) = job else { return };
        self.found = job.poll().or(self.found);
        if self.asked.as_ref() != Some(&request) {
            job.submit(request.clone());
            self.asked = Some(request);
        }
        self.job = Some(job);
    }

    /// Show the rectangle and its numbers in the viewport that shows the session's view; `left` is where the numbers may
    /// begin. What the numbers cover.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        projection: &Projection,
        session: &mut Session,
        left: f32,
        name: &str,
    ) -> Option<Rect> {
        self.follow(ui.ctx(), session);
        let painter = ui.painter_at(projection.rect());
        paint(&session.measure.rectangle, projection, &painter);
        drag(ui, projection, session, name);
        self.card(ui, projection.rect(), session, left, name)
    }

    /// The numbers, in the lower left corner.
    fn card(&self, ui: &mut Ui, rect: Rect, session: &mut Session, left: f32, name: &str) -> Option<Rect> {
        let room = Rect::from_min_max(pos2(rect.left() + left, rect.bottom() - 64.0), rect.max - vec2(8.0, 8.0));
        if room.width() < 120.0 || rect.height() < 130.0 {
            return None;
        }
        let builder = UiBuilder::new().max_rect(room).layout(Layout::bottom_up(Align::Min));
        let shown = ui.scope_builder(builder, |ui| {
            let frame = Frame::NONE.fill(PLATE).corner_radius(4.0).inner_margin(Margin::symmetric(8, 4));
            let shown = frame.show(ui, |ui| {
                ui.with_layout(Layout::top_down(Align::Min), |ui| {
                    ui.visuals_mut().override_text_color = Some(Color32::from_rgb(0xe6, 0xe9, 0xec));
                    self.numbers(ui, session, name, room.width() - 20.0);
                });
            });
            shown.response.rect
        });
        Some(shown.inner)
    }

    fn numbers(&self, ui: &mut Ui, session: &mut Session, name: &str, width: f32) {
        ui.set_max_width(width);
        let Some(found) = self.found else {
            ui.label("Measuring…");
            return;
        };
        let is_small = width < 300.0;
        let (extent, spread) = told(&found);
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let text = RichText::new(&extent).small();
            ui.add(egui::Label::new(text).truncate()).on_hover_text("Illuminance at the points of the grid");
        });
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            let grid =
                if is_small { String::new() } else { format!("   {} × {} points", found.grid[0], found.grid[1]) };
            let text = RichText::new(format!("{spread}{grid}")).small();
            ui.add(egui::Label::new(text))
                .on_hover_text("U0: least by mean. Ud: least by greatest. Grid of EN 12464-1");
            let edit = icon(ui, icons::ICON_TUNE, &format!("Measuring rectangle{name}"));
            Popup::menu(&edit)
                .close_behavior(PopupCloseBehavior::CloseOnClickOutside)
                .show(|ui| fields(ui, &mut session.measure.rectangle));
            if icon(ui, icons::ICON_CONTENT_COPY, &format!("Copy measurement{name}")).clicked() {
                ui.ctx().copy_text(copied(&session.measure.rectangle, &found, session.view.method));
                session.done("Copied the measurement");
            }
        });
    }
}

fn icon(ui: &mut Ui, icon: egui_material_icons::MaterialIcon, name: &str) -> egui::Response {
    crate::editor::panes::icon_button(ui, icon, ui.visuals().text_color(), name)
}

fn answer(request: Request, cancel: &std::sync::atomic::AtomicBool, answer: &mut dyn FnMut(Measured)) {
    let shadows = if request.shadows { Shadows::default() } else { Shadows::None };
    let choice = MethodChoice::Method(request.method);
    if let Some(found) = measure(&request.scene, &request.rectangle, choice, shadows, cancel) {
        answer(found);
    }
}

/// Least, mean and greatest; uniformities.
fn told(found: &Measured) -> (String, String) {
    let [least, mean, greatest] = [found.least, found.mean, found.greatest].map(short);
    (
        format!("E  min {least}   mean {mean}   max {greatest} lx"),
        format!("U0 {:.2}   Ud {:.2}", found.uniformity(), found.diversity()),
    )
}

/// The measurement as a table of two columns.
fn copied(rectangle: &Rectangle, found: &Measured, method: Method) -> String {
    let Rectangle { center, size } = rectangle;
    let Measured { grid: [columns, rows], least, mean, greatest } = found;
    let (uniformity, diversity) = (found.uniformity(), found.diversity());
    format!(
        "minimum lx\t{least}\nmean lx\t{mean}\nmaximum lx\t{greatest}\nU0 min/mean\t{uniformity}\nUd min/max\t{diversity}\n\
         points\t{columns} x {rows}\ncenter m\t{}, {}, {}\nsize m\t{} x {}\nmethod\t{method}\n",
        center.x, center.y, center.z, size.x, size.y
    )
}

/// Place and size in numbers.
fn fields(ui: &mut Ui, rectangle: &mut Rectangle) {
    ui.set_min_width(180.0);
    let mut row = |label: &str, hint: &str, value: &mut f64, range: std::ops::RangeInclusive<f64>| {
        ui.horizontal(|ui| {
            let label = ui.add_sized(vec2(70.0, 18.0), egui::Label::new(label).halign(Align::Min));
            let number = egui::DragValue::new(value).range(range).speed(0.01).suffix(" m").max_decimals(3);
            ui.add(number).labelled_by(label.id).on_hover_text(hint);
        });
    };
    let anywhere = -1e4..=1e4;
    row("Center X", "Middle of the rectangle", &mut rectangle.center.x, anywhere.clone());
    row("Center Y", "Middle of the rectangle", &mut rectangle.center.y, anywhere.clone());
    row("Height", "Above the ground: 0.75 m is a desk", &mut rectangle.center.z, anywhere);
    row("Width", "Along X", &mut rectangle.size.x, SIDES);
    row("Depth", "Along Y", &mut rectangle.size.y, SIDES);
}

/// The outline and the points of the grid.
fn paint(rectangle: &Rectangle, projection: &Projection, painter: &Painter) {
    let corners = rectangle.corners();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        if let Some(segment) = projection.segment(*a, *b) {
            painter.line_segment(segment, Stroke::new(3.0, Color32::from_black_alpha(120)));
            painter.line_segment(segment, Stroke::new(1.5, COLOR));
        }
    }
    for p in rectangle.points() {
        if let Some(at) = projection.project(p) {
            painter.circle_filled(at, 1.2, COLOR.gamma_multiply(0.7));
        }
    }
}

/// Corners change the size, the middle the place.
fn drag(ui: &mut Ui, projection: &Projection, session: &mut Session, name: &str) {
    let corners = session.measure.rectangle.corners();
    let center = session.measure.rectangle.center;
    let painter = ui.painter_at(projection.rect());
    for (i, p) in corners.into_iter().chain([center]).enumerate() {
        let Some(at) = projection.project(p).filter(|at| projection.rect().contains(*at)) else { continue };
        let grip = Rect::from_center_size(at, vec2(2.0 * REACH, 2.0 * REACH));
        let is_center = i == corners.len();
        let response =
            ui.interact(grip, ui.scope_id().with(("measure", i)), Sense::drag()).on_hover_cursor(CursorIcon::Grab);
        let what = if is_center { "middle".to_owned() } else { format!("corner {}", i + 1) };
        response.widget_info(|| {
            WidgetInfo::labeled(egui::Role::Button, true, format!("Measuring rectangle, {what}{name}"))
        });
        let lit = response.hovered() || response.dragged();
        let size = if lit { 5.0 } else { 4.0 };
        let fill = if lit { Color32::WHITE } else { COLOR };
        let square = Rect::from_center_size(at, vec2(2.0 * size, 2.0 * size));
        painter.rect(square, 1.5, fill, Stroke::new(1.0, Color32::from_black_alpha(190)), egui::StrokeKind::Outside);
        if lit {
            "Drag the measuring rectangle; Ctrl snaps to the grid".clone_into(&mut session.hint);
        }
        let Some(pos) = response.interact_pointer_pos().filter(|_| response.dragged()) else { continue };
        let Some(to) = projection.ray(pos).on_plane(center, DVec3::Z) else { continue };
        let snap = ui.input(|input| input.modifiers.command).then_some(session.work_plane.grid);
        let to = snapped(to.truncate(), snap);
        session.measure.rectangle = if is_center {
            Rectangle { center: to.extend(center.z), ..session.measure.rectangle }
        } else {
            between(corners[(i + 2) % corners.len()].truncate(), to, center.z)
        };
    }
}

/// The rectangle between two corners.
fn between(a: DVec2, b: DVec2, height: f64) -> Rectangle {
    let size = (a - b).abs().clamp(DVec2::splat(*SIDES.start()), DVec2::splat(*SIDES.end()));
    Rectangle { center: a.midpoint(b).extend(height), size }
}

fn snapped(p: DVec2, grid: Option<f64>) -> DVec2 {
    grid.filter(|grid| *grid > 0.0).map_or(p, |grid| (p / grid).round() * grid)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_drags_its_rectangle_about_the_opposite_one() {
        let dragged = between(DVec2::ZERO, DVec2::new(-2.0, 4.0), 0.75);
        assert_eq!(dragged, Rectangle { center: DVec3::new(-1.0, 2.0, 0.75), size: DVec2::new(2.0, 4.0) }, "between");
        assert!(between(DVec2::ONE, DVec2::ONE, 0.0).size.min_element() > 0.0, "it never vanishes");
        assert_eq!(snapped(DVec2::new(0.26, 1.01), Some(0.5)), DVec2::new(0.5, 1.0), "snapped");
    }

    #[test]
    fn a_measurement_is_told_in_numbers_with_units() {
        let found = Measured { grid: [7, 5], least: 50.0, mean: 200.0, greatest: 500.0 };
        let (extent, spread) = told(&found);
        assert_eq!(extent, "E  min 50   mean 200   max 500 lx", "extent");
        assert_eq!(spread, "U0 0.25   Ud 0.10", "spread");
        let rectangle = between(DVec2::ZERO, DVec2::ONE, 0.0);
        let table = copied(&rectangle, &found, Method::Exact);
        assert!(table.contains("U0 min/mean\t0.25\n") && table.contains("points\t7 x 5\n"), "{table}");
    }
}
