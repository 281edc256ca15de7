//! The view into the scene: one, two or four live pictures, what is painted over them, and what the mouse does there.
//!
//! Geometry without egui's input lives in [`ray`], [`projection`], [`navigate`] and [`pick`]; what a drag or a click
//! does to the document in [`super::handles`] and [`super::tools`]. `pointer.rs` joins them to the mouse. A [`screen`]
//! is one picture with its [`controls`], its [`scales`] of false colours, its [`split`] between two methods, the
//! [`gauge`] of illuminance and the numbers on its [`isolines`].

pub mod controls;
pub mod gauge;
pub mod isolines;
pub mod layout;
pub mod navigate;
pub mod overlay;
pub mod pick;
pub mod picture;
pub mod pointer;
pub mod projection;
pub mod ray;
pub mod scales;
pub mod screen;
pub mod split;
pub mod symbol;

use std::time::Duration;

use eframe::egui_wgpu::RenderState;
use egui::{Rect, Response, Sense, Stroke, StrokeKind, Ui, UiBuilder, WidgetInfo};

use self::pick::Solids;
use self::picture::{FRAME_BUDGET, Haste};
use self::pointer::Pointer;
use self::projection::Projection;
use self::screen::Screen;
use super::panes::view_menu;
use super::session::{Framing, Item, Session};
use super::{library, theme};
use crate::gpu::{SharedPasses, Stats};
pub use crate::render::bounds;
use crate::render::bounds::Ball;

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
    render_state: RenderState,
    passes: SharedPasses,
    screens: Vec<Screen>,
    /// The screen that the pointer is in, or was last.
    home: usize,
    solids: Solids,
    pointer: Pointer,
    overlays: Overlays,
    frame_budget: Duration,
}

/// The pointer has not moved for so long where nobody acts, seconds.
const CALM_AFTER: f32 = 0.5;
/// A pane narrower than this shows nothing, points.
const LEAST_SIDE: f32 = 8.0;

impl Viewport {
    /// A viewport that draws on the window's device.
    pub fn new(render_state: &RenderState) -> Self {
        Self {
            render_state: render_state.clone(),
            passes: SharedPasses::new(&render_state.device),
            screens: Vec::new(),
            home: 0,
            solids: Solids::default(),
            pointer: Pointer::default(),
            overlays: Overlays::default(),
            frame_budget: FRAME_BUDGET,
        }
    }

    /// Fill the rest of `ui` with views of the session's scene.
    pub fn show(&mut self, ui: &mut Ui, session: &mut Session) {
        let whole = ui.available_rect_before_wrap();
        ui.allocate_rect(whole, Sense::hover());
        let count = session.views.count();
        let places = layout::places(whole, count, session.views.dividers);
        let canvases: Vec<_> = places.iter().enumerate().map(|(i, rect)| canvas(ui, *rect, (i, count))).collect();
        let is_tiny = |rect: &Rect| rect.width() < LEAST_SIDE || rect.height() < LEAST_SIDE;
        if places.iter().any(is_tiny) || !ui.is_rect_visible(whole) {
            return;
        }
        self.fit(count);
        self.solids.update(&session.scene().surfaces);
        layout::dividers(ui, whole, session);
        self.go_home(ui, &canvases, session);
        self.frame(places[session.views.active()], session);
        self.act(ui, &canvases[self.home], session);
        session.link_views();
        self.paint_pictures(ui, &places, session);
        for (index, rect) in places.iter().enumerate() {
            let name = if count > 1 { format!(", view {}", index + 1) } else { String::new() };
            let builder = UiBuilder::new().id_salt(("screen", index)).max_rect(*rect);
            ui.scope_builder(builder, |ui| self.overlay(ui, *rect, session, index, &name));
        }
        if count > 1 {
            let stroke = Stroke::new(1.5, theme::ACCENT_OVER_PICTURE.gamma_multiply(0.8));
            ui.painter().rect_stroke(places[session.views.active()], 0.0, stroke, StrokeKind::Inside);
        }
    }

    /// What the pictures have cost since they were first shown.
    pub fn stats(&self) -> Stats {
        self.screens.iter().map(|screen| screen.picture.stats()).fold(Stats::default(), |sum, stats| sum + stats)
    }

    /// What the picture of one viewport has cost; nothing of one that is not shown.
    pub fn stats_of(&self, index: usize) -> Stats {
        self.screens.get(index).map(|screen| screen.picture.stats()).unwrap_or_default()
    }

    /// Whether numbers are being found off this thread.
    pub fn is_busy(&self) -> bool {
        self.screens.iter().any(Screen::is_busy)
    }

    /// How long a frame may take while something is dragged, before resolution is lowered.
    pub fn set_frame_budget(&mut self, budget: Duration) {
        self.frame_budget = budget;
        self.fit(self.screens.len());
    }

    /// As many screens as are shown, which share the time of a frame.
    fn fit(&mut self, count: usize) {
        self.screens.truncate(count);
        self.screens.resize_with(count, || Screen::new(&self.render_state, &self.passes));
        self.home = self.home.min(count.saturating_sub(1));
        for screen in &mut self.screens {
            screen.picture.set_frame_budget(self.frame_budget / u32::try_from(count).unwrap_or(1));
        }
    }

    /// Follow the pointer to the screen that it is in. A press or a turn of the wheel makes that the active one.
    fn go_home(&mut self, ui: &Ui, canvases: &[Response], session: &mut Session) {
        let (pos, pressed, down, turned) = ui.input(|input| {
            let turned = input.smooth_scroll_delta().y != 0.0 || input.zoom_delta() != 1.0;
            (input.pointer.interact_pos(), input.pointer.any_pressed(), input.pointer.any_down(), turned)
        });
        if self.pointer.is_dragging() || (down && !pressed) {
            return;
        }
        let Some(pos) = pos else { return };
        let is_free = ui.ctx().layer_id_at(pos).is_none_or(|layer| layer == ui.layer_id());
        let Some(under) = canvases.iter().position(|canvas| is_free && canvas.rect.contains(pos)) else { return };
        self.home = under;
        if pressed || turned {
            session.activate_view(under);
        }
    }

    /// What the mouse does in the screen that it is in.
    fn act(&mut self, ui: &Ui, canvas: &Response, session: &mut Session) {
        let handles = self.overlays.handles;
        if canvas.drag_started() {
            // A click elsewhere takes the keys from a text field, but a drag would not.
            ui.memory_mut(|memory| memory.stop_text_input());
        }
        session.with_view(self.home, |session| {
            self.pointer.update(ui, canvas, session, &self.solids, handles);
            session.under_pointer = self.pointer.hovered();
            view_menu(canvas, session, self.pointer.hovered());
            let projection = Projection::new(&session.view.camera, canvas.rect);
            library::drop::receive(ui, canvas, &projection, &self.solids, session);
        });
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

    /// Draw all pictures, the active one first. One at a time is refined.
    fn paint_pictures(&mut self, ui: &Ui, places: &[Rect], session: &mut Session) {
        let dragging = self.pointer.is_dragging() || session.live.is_some();
        let quiet = ui.input(|input| input.events.is_empty() && input.pointer.time_since_last_movement() > CALM_AFTER);
        let haste = match dragging {
            true => Haste::Dragging,
            false if quiet => Haste::Calm,
            false => Haste::Acting,
        };
        let active = session.views.active();
        let mut working = false;
        let order = std::iter::once(active).chain((0..places.len()).filter(|index| *index != active));
        for index in order {
            let screen = &mut self.screens[index];
            working |= session.with_view(index, |session| {
                let works = screen.paint_picture(ui, places[index], session, haste, working);
                screen.follow(ui, session, index == active);
                works
            });
        }
    }

    /// Show what lies over one picture.
    fn overlay(&mut self, ui: &mut Ui, rect: Rect, session: &mut Session, index: usize, name: &str) {
        let screen = &mut self.screens[index];
        let (pointer, solids, overlays) = (&self.pointer, &self.solids, &mut self.overlays);
        let is_home = index == self.home;
        session.with_view(index, |session| {
            let projection = Projection::new(&session.view.camera, rect);
            screen.paint_overlays(ui, &projection, session, overlays, solids, (pointer, is_home));
            screen.show_controls(ui, &projection, session, overlays, name);
        });
    }
}

/// What the mouse acts on in one viewport.
fn canvas(ui: &Ui, rect: Rect, (index, count): (usize, usize)) -> Response {
    let response = ui.interact(rect, ui.scope_id().with(("canvas", index)), Sense::click_and_drag());
    let name = if count > 1 { format!("Viewport {}", index + 1) } else { "Viewport".to_owned() };
    response.widget_info(|| WidgetInfo::labeled(egui::Role::Canvas, true, name.as_str()));
    response
}
