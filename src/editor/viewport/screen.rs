//! One viewport: its picture, and what lies over it.

use std::sync::Arc;

use eframe::egui_wgpu::RenderState;
use egui::{Align2, Color32, Painter, Rect, Ui, pos2, vec2};

use super::gauge::Gauge;
use super::overlay::{self, Grid, Marks};
use super::pick::Solids;
use super::picture::{Haste, Picture};
use super::pointer::Pointer;
use super::projection::Projection;
use super::{Overlays, controls, isolines, scales, split};
use crate::editor::session::{Item, Session, ViewMode, ViewState};
use crate::editor::theme;
use crate::gpu::{Display, SharedPasses, Survey, View};
use crate::scene::Scene;
use crate::shading::Method;

/// Outlines of surfaces that no light shows.
const IN_THE_DARK: Color32 = Color32::from_gray(0x70);
/// A pane narrower than this has no room for controls, points.
const LEAST_FOR_CONTROLS: f32 = 160.0;
/// Exposures that the slider offers, in steps of a factor of two.
pub const EXPOSURE: std::ops::RangeInclusive<f64> = -8.0..=8.0;
/// Room for the world's axes, points.
const GNOMON: f32 = 92.0;

/// See the [module](self). All of its functions look at the session's view.
pub struct Screen {
    pub(super) picture: Picture,
    grid: Grid,
    gauge: Gauge,
    survey: Survey,
    /// Of what the survey was made.
    surveyed: Option<([Arc<Scene>; 2], View)>,
    asked: Option<([Arc<Scene>; 2], View)>,
    /// What controls, scale and numbers covered in the frame before.
    covered: Vec<Rect>,
}

impl Screen {
    /// Nothing to see yet.
    pub fn new(render_state: &RenderState, passes: &SharedPasses) -> Self {
        Self {
            picture: Picture::new(render_state, passes),
            grid: Grid::default(),
            gauge: Gauge::default(),
            survey: Survey::default(),
            surveyed: None,
            asked: None,
            covered: Vec::new(),
        }
    }

    /// Whether its numbers are being found.
    pub fn is_busy(&self) -> bool {
        self.gauge.is_busy()
    }

    /// Draw the picture; whether it is still at work. One that `waits` draws only what has changed.
    pub fn paint_picture(&mut self, ui: &Ui, rect: Rect, session: &mut Session, haste: Haste, waits: bool) -> bool {
        let view = session.view;
        let shown = session.shown_for(&view);
        let other = session.shown_against(&view);
        let asked = View {
            camera: view.camera,
            size: [rect.width(), rect.height()].map(|side| physical(side, ui.ctx().pixels_per_point())),
            method: view.method,
            exposure_ev: shown.display.exposure_ev,
            show_emitters: view.show_emitters,
            shadows: view.show_shadows,
            refine: view.refines && haste != Haste::Dragging && !waits,
            display: scales::display(&view, &self.survey),
        };
        let is_same = self.asked.as_ref().is_some_and(|(scene, before)| {
            Arc::ptr_eq(&scene[0], &shown)
                && Arc::ptr_eq(&scene[1], &other)
                && *before == View { refine: before.refine, ..asked }
        });
        let rests = haste == Haste::Dragging || (waits && !self.picture.is_rough());
        if !is_same || self.picture.is_behind() || !rests {
            self.picture.render([&shown, &other], &asked, haste, !is_same);
        }
        self.asked = Some(([shown, other], asked));
        self.paint_texture(ui, rect);
        let is_working = self.picture.is_behind() || (asked.refine && !self.picture.is_converged());
        if is_working {
            ui.ctx().request_repaint();
        }
        is_working
    }

    /// The picture that there is, on neutral ground. One that was drawn for a pane of another size keeps its sides'
    /// proportion, and fills the height, as its field of view does.
    fn paint_texture(&self, ui: &Ui, rect: Rect) {
        let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
        let size = self.asked.as_ref().map(|(_, view)| view.size);
        match (self.picture.texture(), size) {
            (Some((texture, drawn)), Some(size)) if drawn == size => {
                ui.painter().image(texture, rect, whole, Color32::WHITE);
            }
            (texture, _) => {
                let painter = ui.painter_at(rect);
                painter.rect_filled(rect, 0.0, ui.visuals().extreme_bg_color);
                if let Some((texture, drawn)) = texture {
                    painter.image(texture, placed(drawn, rect), whole, Color32::WHITE);
                }
            }
        }
    }

    /// Find the picture's numbers where scales or the exposure follow them.
    pub fn follow(&mut self, ui: &Ui, session: &mut Session, is_active: bool) {
        let exposes = session.wants_exposure && is_active;
        if !exposes && !scales::follows_picture(&session.view) {
            return;
        }
        if let Some(survey) = self.picture.survey() {
            self.survey = survey;
            if !self.picture.is_behind() {
                self.surveyed.clone_from(&self.asked);
            }
            ui.ctx().request_repaint();
        }
        if self.picture.is_surveying() {
            ui.ctx().request_repaint();
        } else if exposes && !self.picture.is_behind() {
            session.wants_exposure = false;
            expose(session, &self.survey);
        }
    }

    /// The lux on the isolines; nothing while the picture is another than that of which they are known.
    fn paint_isoline_labels(&self, rect: Rect, taken: &mut Vec<Rect>, painter: &Painter) {
        let (Some((scenes, now)), Some((known, then))) = (&self.asked, &self.surveyed) else { return };
        let Display::Illuminance { scale, isolines: true } = now.display else { return };
        let is_same = scenes.iter().zip(known).all(|(now, then)| Arc::ptr_eq(now, then));
        if is_same && now.camera == then.camera && now.size == then.size && now.method == then.method {
            isolines::paint(&self.survey, &scale.levels(), rect, taken, painter);
        }
    }

    /// Draw lights, grid, probe and axes over the picture; handles where the pointer is at home.
    pub fn paint_overlays(
        &mut self,
        ui: &Ui,
        projection: &Projection,
        session: &Session,
        overlays: &Overlays,
        solids: &Solids,
        (pointer, is_home): (&Pointer, bool),
    ) {
        let painter = ui.painter_at(projection.rect());
        let accent = theme::ACCENT_OVER_PICTURE;
        let scene = session.scene();
        if session.view.show_grid {
            self.grid.paint(projection, solids, &painter);
        }
        let mut taken = self.covered.clone();
        if overlays.outlines {
            let marks = Marks {
                selection: &session.selection,
                hovered: pointer.hovered(),
                accent,
                on_bright: session.view.mode.is_false_colour(),
            };
            overlay::paint_lights(scene, &marks, solids, projection, &mut taken, &painter);
        }
        self.paint_isoline_labels(projection.rect(), &mut taken, &painter);
        if let Some(count) = shown_fit(session) {
            let selected = |(i, light): (usize, _)| session.selection.contains(Item::Light(i)).then_some(light);
            for light in scene.lights.iter().enumerate().filter_map(selected) {
                overlay::paint_fit(light, count, accent, projection, &painter);
            }
        }
        paint_surfaces(session, accent, solids, projection, &painter);
        if let Some(plot) = scene.plots.get(session.plots.active).filter(|_| overlays.probe) {
            let chosen = session.selection.contains(Item::Plot(session.plots.active)) || pointer.holds_probe();
            overlay::paint_probe(plot, chosen, accent, projection, &painter);
            if let Some(x) = session.plots.cursor {
                overlay::paint_probe_at(plot, x, accent, projection, &painter);
            }
        }
        if is_home {
            pointer.paint(session, accent, projection, &painter);
        }
        if overlays.gnomon {
            overlay::paint_gnomon(projection, projection.rect().left_bottom() + vec2(46.0, -46.0), &painter);
            if !measures(session) {
                paint_camera_info(projection, &painter);
            }
        }
    }

    /// Show what can be set and dragged in this viewport; `name` tells it from the others.
    pub fn show_controls(
        &mut self,
        ui: &mut Ui,
        projection: &Projection,
        session: &mut Session,
        overlays: &mut Overlays,
        name: &str,
    ) {
        let rect = projection.rect();
        let mut covered = Vec::new();
        if overlays.gnomon {
            covered.push(Rect::from_min_size(rect.left_bottom() - vec2(0.0, GNOMON), vec2(GNOMON, GNOMON)));
        }
        if rect.width() >= LEAST_FOR_CONTROLS {
            self.show_settings(ui, projection, session, (overlays, &mut covered), name);
        }
        if self.covered != covered {
            self.covered = covered;
            // What lies over the picture makes room for it.
            ui.ctx().request_repaint();
        }
    }

    fn show_settings(
        &mut self,
        ui: &mut Ui,
        projection: &Projection,
        session: &mut Session,
        (overlays, covered): (&mut Overlays, &mut Vec<Rect>),
        name: &str,
    ) {
        let rect = projection.rect();
        let display = self.asked.as_ref().map_or(Display::Picture, |(_, view)| view.display);
        if measures(session) {
            let left = if overlays.gnomon { GNOMON } else { 8.0 };
            covered.extend(self.gauge.show(ui, projection, session, left, name));
        }
        if session.view.mode == ViewMode::Split {
            split::show(ui, rect, session, name);
        }
        covered.extend(scales::show(ui, rect, session, &display, name));
        covered.push(controls::show(ui, rect, session, overlays, &display, name));
    }
}

/// Where a picture lies in a pane that was drawn for one of `drawn` pixels.
fn placed(drawn: [u32; 2], rect: Rect) -> Rect {
    let [width, height] = drawn.map(|side| side as f32);
    Rect::from_center_size(rect.center(), vec2(rect.height() * width / height, rect.height()))
}

/// How many lights the fit has that the view shows, by itself or to compare with.
fn shown_fit(session: &Session) -> Option<u32> {
    let ViewState { mode, method, against, against_variant, .. } = session.view;
    let compared = Some(against).filter(|_| mode.compares() && against_variant.is_none());
    [Some(method), compared].into_iter().flatten().find_map(|method| match method {
        Method::Fit(count) => Some(count),
        _ => None,
    })
}

/// Whether illuminance is measured in this viewport.
fn measures(session: &Session) -> bool {
    session.measure.shown || session.view.mode == ViewMode::Illuminance
}

/// Set the exposure by what is seen.
fn expose(session: &mut Session, survey: &Survey) {
    let Some(exposure_ev) = scales::auto_exposure(survey) else {
        session.failed("There is no light to expose for");
        return;
    };
    let exposure_ev = exposure_ev.clamp(*EXPOSURE.start(), *EXPOSURE.end());
    if exposure_ev != session.scene().display.exposure_ev {
        session.edit("Auto exposure", |scene| scene.display.exposure_ev = exposure_ev);
    }
}

/// Boxes around the selected surfaces; in the dark around all of them, and what to do about that.
fn paint_surfaces(session: &Session, accent: Color32, solids: &Solids, projection: &Projection, painter: &Painter) {
    let dark = session.scene().lights.iter().all(|light| light.muted);
    for i in 0..session.scene().surfaces.len() {
        let selected = session.selection.contains(Item::Surface(i));
        if selected || dark {
            let color = if selected { accent } else { IN_THE_DARK };
            overlay::paint_box(&solids.corners(i), color, solids, projection, painter);
        }
    }
    if dark && !session.tool.draws() {
        let text = "No light is on.  Draw one:  P polygon,  L line,  O sphere,  T textured,  N outline";
        let at = projection.rect().center_bottom() - vec2(0.0, 40.0);
        overlay::label(text, at, Align2::CENTER_BOTTOM, Color32::from_gray(0xd8), painter);
    }
}

/// Field of view and distance to what is looked at, in the lower right corner.
fn paint_camera_info(projection: &Projection, painter: &Painter) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_of_another_pane_is_not_stretched() {
        let rect = Rect::from_min_size(pos2(10.0, 20.0), vec2(300.0, 400.0));
        assert_eq!(placed([300, 400], rect), rect, "of this pane");
        let wider = placed([1200, 800], rect);
        assert_eq!((wider.size(), wider.center()), (vec2(600.0, 400.0), rect.center()), "cut at both sides");
        let narrower = placed([150, 800], rect);
        assert_eq!(narrower.size(), vec2(75.0, 400.0), "with ground at both sides");
    }
}
