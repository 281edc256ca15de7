//! The view into the scene: the live picture, what is painted over it, and what the mouse does there.
//!
//! Geometry without egui's input lives in [`ray`], [`projection`], [`navigate`] and [`pick`]; what a drag or a click
//! does to the document in [`super::handles`] and [`super::tools`]. `pointer.rs` joins them to the mouse.

pub mod bounds;
pub mod controls;
pub mod navigate;
pub mod overlay;
pub mod pick;
pub mod picture;
pub mod pointer;
pub mod projection;
pub mod ray;
pub mod symbol;

use std::time::Duration;

use eframe::egui_wgpu::RenderState;
use egui::{Align2, Color32, Rect, Sense, Ui, WidgetInfo, pos2, vec2};

use self::bounds::Ball;
use self::overlay::Grid;
use self::pick::Solids;
use self::picture::{Haste, Picture};
use self::pointer::Pointer;
use self::projection::Projection;
use super::panes::view_menu;
use super::session::{Framing, Item, Session};
use super::{library, theme};
use crate::gpu::{Stats, View};

/// What is painted over the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Overlays {
    /// Outlines, symbols and names of lights.
    pub outlines: bool,
    /// Handles on what is selected.
    pub handles: bool,
    /// The probe of the plot in front.
    pub probe: bool,
    /// The world's axes, and the camera in numbers.
    pub gnomon: bool,
}

impl Default for Overlays {
    fn default() -> Self {
        Self { outlines: true, handles: true, probe: true, gnomon: true }
    }
}

/// See the [module](self).
pub struct Viewport {
    picture: Picture,
    solids: Solids,
    grid: Grid,
    pointer: Pointer,
    overlays: Overlays,
}

/// Outlines of surfaces that no light shows.
const IN_THE_DARK: Color32 = Color32::from_gray(0x70);
/// The pointer has not moved for so long where nobody acts, seconds.
const CALM_AFTER: f32 = 0.5;
/// A pane narrower than this shows nothing, points.
const LEAST_SIDE: f32 = 8.0;
/// A pane narrower than this has no room for controls, points.
const LEAST_FOR_CONTROLS: f32 = 160.0;

impl Viewport {
    /// A viewport that draws on the window's device.
    pub fn new(render_state: &RenderState) -> Self {
        Self {
            picture: Picture::new(render_state),
            solids: Solids::default(),
            grid: Grid::default(),
            pointer: Pointer::default(),
            overlays: Overlays::default(),
        }
    }

    /// Fill the rest of `ui` with the view of the session's scene.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Canvas, true, "Viewport"));
        if rect.width() < LEAST_SIDE || rect.height() < LEAST_SIDE || !ui.is_rect_visible(rect) {
            return;
        }
        self.solids.update(&session.scene().surfaces);
        self.frame(rect, session);
        self.pointer.update(ui, &response, session, &self.solids, self.overlays.handles);
        let projection = Projection::new(&session.view.camera, rect);
        session.under_pointer = self.pointer.hovered();
        view_menu(&response, session, self.pointer.hovered());
        library::drop::receive(ui, &response, &projection, &self.solids, session);
        self.paint_picture(ui, rect, session);
        self.paint_overlays(ui, &projection, session);
        if rect.width() >= LEAST_FOR_CONTROLS {
            controls::show(ui, rect, session, &mut self.overlays);
        }
    }

    /// What the picture has cost since the start.
    pub fn stats(&self) -> Stats {
        self.picture.stats()
    }

    /// How long a frame may take while something is dragged, before resolution is lowered.
    pub fn set_frame_budget(&mut self, budget: Duration) {
        self.picture.set_frame_budget(budget);
    }

    /// Bring into view what the session asks for.
    fn frame(&self, rect: Rect, session: &mut Session) {
        let Some(framing) = session.framing.take() else { return };
        let scene = session.scene();
        let items: Vec<Item> = match framing {
            Framing::Selection => session.selection.items().to_vec(),
            Framing::All => {
                let surfaces = (0..scene.surfaces.len()).map(Item::Surface);
                surfaces.chain((0..scene.lights.len()).map(Item::Light)).collect()
            }
        };
        let points = items.iter().flat_map(|item| match *item {
            Item::Light(i) => scene.lights.get(i).map(bounds::light_points).unwrap_or_default(),
            Item::Surface(i) => self.solids.corners(i),
            Item::Plot(i) => scene.plots.get(i).map(|plot| vec![plot.position]).unwrap_or_default(),
            Item::Material(_) => Vec::new(),
        });
        if let Some(ball) = Ball::around(points) {
            session.view.camera = navigate::focused(&Projection::new(&session.view.camera, rect), &ball);
        }
    }

    fn paint_picture(&mut self, ui: &Ui, rect: Rect, session: &mut Session) {
        let view = session.view;
        let shown = session.shown_for(&view);
        let view = View {
            camera: session.view.camera,
            size: [rect.width(), rect.height()].map(|side| physical(side, ui.ctx().pixels_per_point())),
            method: session.view.method,
            exposure_ev: shown.display.exposure_ev,
            show_emitters: session.view.show_emitters,
            shadows: session.view.show_shadows,
            refine: session.view.refines && !self.pointer.is_dragging(),
        };
        let quiet = ui.input(|input| input.events.is_empty() && input.pointer.time_since_last_movement() > CALM_AFTER);
        let haste = match self.pointer.is_dragging() {
            true => Haste::Dragging,
            false if quiet => Haste::Calm,
            false => Haste::Acting,
        };
        let texture = self.picture.render(&shown, &view, haste);
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        ui.painter().image(texture, rect, whole, Color32::WHITE);
        if self.picture.is_behind() || (view.refine && !self.picture.is_converged()) {
            ui.ctx().request_repaint();
        }
    }

    fn paint_overlays(&mut self, ui: &Ui, projection: &Projection, session: &Session) {
        let painter = ui.painter_at(projection.rect());
        let accent = theme::accent(ui.visuals());
        let scene = session.scene();
        if session.view.show_grid {
            self.grid.paint(projection, &self.solids, &painter);
        }
        if self.overlays.outlines {
            let hovered = self.pointer.hovered();
            overlay::paint_lights(scene, &session.selection, hovered, accent, &self.solids, projection, &painter);
        }
        self.paint_surfaces(session, accent, projection, &painter);
        if let Some(plot) = scene.plots.get(session.plots.active).filter(|_| self.overlays.probe) {
            let chosen = session.selection.contains(Item::Plot(session.plots.active)) || self.pointer.holds_probe();
            overlay::paint_probe(plot, chosen, accent, projection, &painter);
        }
        self.pointer.paint(session, accent, projection, &painter);
        if self.overlays.gnomon {
            overlay::paint_gnomon(projection, projection.rect().left_bottom() + vec2(46.0, -46.0), &painter);
            paint_camera_info(projection, &painter);
        }
    }

    /// Boxes around the selected surfaces; in the dark around all of them, and what to do about that.
    fn paint_surfaces(&self, session: &Session, accent: Color32, projection: &Projection, painter: &egui::Painter) {
        let dark = session.scene().lights.iter().all(|light| light.muted);
        for i in 0..session.scene().surfaces.len() {
            let selected = session.selection.contains(Item::Surface(i));
            if selected || dark {
                let color = if selected { accent } else { IN_THE_DARK };
                overlay::paint_box(&self.solids.corners(i), color, &self.solids, projection, painter);
            }
        }
        if dark && !session.tool.draws() {
            let text = "No light is on.  Draw one:  P polygon,  L line,  O sphere,  T textured,  N outline";
            let at = projection.rect().center_bottom() - vec2(0.0, 40.0);
            overlay::label(text, at, Align2::CENTER_BOTTOM, Color32::from_gray(0xd8), painter);
        }
    }
}

/// Field of view and distance to what is looked at, in the lower right corner.
fn paint_camera_info(projection: &Projection, painter: &egui::Painter) {
    let camera = projection.camera();
    let text = format!("{}°  ·  {}", camera.fov_deg.round(), overlay::length_text(camera.eye.distance(camera.target)));
    let at = projection.rect().right_bottom() - vec2(10.0, 8.0);
    overlay::label(&text, at, Align2::RIGHT_BOTTOM, Color32::from_gray(0xc8), painter);
}

/// A length in points as a number of pixels.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of pixels below 2³²")]
fn physical(side: f32, pixels_per_point: f32) -> u32 {
    (side * pixels_per_point).round().max(1.0) as u32
}
