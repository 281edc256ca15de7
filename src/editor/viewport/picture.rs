//! The live picture as a texture of the window.

use std::time::{Duration, Instant};

use eframe::egui_wgpu::RenderState;
use egui::TextureId;

use crate::gpu::{Preview, SharedPasses, Stats, Survey, View};
use crate::scene::Scene;

/// A frame may take this long while something is dragged, before resolution is lowered.
pub const FRAME_BUDGET: Duration = Duration::from_millis(40);
/// A band of a picture that stands still may take this many times as long.
const REFINE_SHARE: u32 = 2;
/// And this many times while nobody acts, so that most of the time is not spent on drawing the rest of the window: the
/// next click waits for no more.
const CALM_SHARE: u32 = 6;
/// The window never waits longer than this for the device.
const LONGEST_WAIT: Duration = Duration::from_secs(1);
/// Bands of a stage while nobody knows what one costs.
const FIRST_BANDS: u32 = 16;
/// And at most.
const MOST_BANDS: u32 = 256;
/// Resolutions of rough pictures, as shares of the pane's: each halves the number of pixels.
const SCALES: [f32; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// A step down in resolution that leaves more than this share of the cost is not worth it.
const LEAST_GAIN: f32 = 0.85;

/// What the user is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Haste {
    /// Dragging something in the picture: every frame counts, and may have fewer pixels.
    Dragging,
    /// Anything else.
    Acting,
    /// Nothing, for a while.
    Calm,
}

/// Two [`Preview`]s shown by egui: one of all pixels, made in bands that never hold up the window for long, and a rough
/// one that is there at once, for as long as the other takes.
pub struct Picture {
    render_state: RenderState,
    fine: Preview,
    rough: Preview,
    /// The rough one is what is shown.
    is_rough: bool,
    /// The rough one is of something older than what was asked for last.
    is_rough_stale: bool,
    texture: Option<Shown>,
    pace: Pace,
    stage: StageCost,
    /// What is shown is not what was asked for last, or not of all pixels though it might be.
    is_behind: bool,
    /// Sums that had been made when the last survey was begun.
    surveyed: u64,
}

/// A picture, and what it is of.
struct Shown {
    view: wgpu::TextureView,
    id: TextureId,
    /// Of the pane, in pixels, for which it was drawn.
    size: [u32; 2],
}

impl Picture {
    /// No picture yet, on the window's device.
    pub fn new(render_state: &RenderState, passes: &SharedPasses) -> Self {
        let preview = || Preview::sharing(&render_state.device, passes);
        Self {
            render_state: render_state.clone(),
            fine: preview(),
            rough: preview(),
            is_rough: false,
            is_rough_stale: true,
            texture: None,
            pace: Pace::new(FRAME_BUDGET),
            stage: StageCost::default(),
            is_behind: false,
            surveyed: 0,
        }
    }

    /// How long a frame may take while something is dragged, and about twice as long while it refines.
    pub fn set_frame_budget(&mut self, budget: Duration) {
        self.pace.budget = budget;
    }

    /// Draws a picture of the first scene, compared where the view does so with the second's lights, where `view.size` is
    /// the pane in physical pixels, and `is_new` says that something differs from the call before. While something is
    /// dragged fewer pixels may be shaded, and a picture that is still is drawn and refined a little with each call. What
    /// is shown stays as it was while the device is busy with it: see [`Self::is_behind`].
    pub fn render(&mut self, scenes: [&Scene; 2], view: &View, haste: Haste, is_new: bool) {
        self.is_rough_stale |= is_new;
        let patience = self.pace.budget.saturating_mul(match haste {
            Haste::Dragging => 1,
            Haste::Acting => REFINE_SHARE,
            Haste::Calm => CALM_SHARE,
        });
        let device = &self.render_state.device;
        // What was handed in before is done first, so that work never piles up and what follows has a cost of its own.
        if [&self.fine, &self.rough].into_iter().any(|preview| !wait(device, preview, patience)) {
            self.is_behind = true;
            return;
        }
        let limit = device.limits().max_texture_dimension_2d;
        let view = View { size: view.size.map(|side| side.clamp(1, limit)), ..*view };
        let drags = haste == Haste::Dragging;
        if !drags {
            self.pace.rest();
        }
        if (!drags || self.pace.scale() == 1.0) && self.draw_fine(scenes, &view, patience, drags) {
            self.is_behind = false;
            return;
        }
        if drags || self.is_rough_stale {
            self.draw_rough(scenes, &view, patience, drags);
        }
        self.is_behind = !drags;
    }

    /// Draws all pixels, for about as long as `patience` says; whether they are shown.
    fn draw_fine(&mut self, scenes: [&Scene; 2], view: &View, patience: Duration, drags: bool) -> bool {
        let RenderState { device, queue, .. } = &self.render_state;
        let start = Instant::now();
        loop {
            let bands = self.stage.bands(patience);
            let before = self.fine.stats();
            let was_whole = self.fine.is_whole();
            self.fine.work_in_bands(bands);
            let started = Instant::now();
            self.fine.render_against(device, queue, scenes, view);
            let works = !self.fine.is_whole() || (view.refine && !self.fine.is_converged());
            if works || self.fine.stats() != before {
                // Longer than the patience counts as twice as long.
                let is_done = wait(device, &self.fine, patience);
                let cost = if is_done { started.elapsed() } else { patience.saturating_mul(2) };
                self.stage.learn(bands, cost, patience);
                if drags && was_whole && self.fine.is_whole() {
                    self.pace.learn(cost);
                }
            }
            if self.fine.is_whole() || start.elapsed() > patience / 2 {
                break;
            }
        }
        if self.fine.is_whole() {
            self.is_rough = false;
            self.rough.drop_survey();
            self.show(view.size);
        } else if drags {
            self.pace.go_down_to(self.pace.step_for(self.stage.whole));
        }
        self.fine.is_whole()
    }

    /// Draws fewer pixels, all of them, and shows them.
    fn draw_rough(&mut self, scenes: [&Scene; 2], view: &View, patience: Duration, drags: bool) {
        let RenderState { device, queue, .. } = &self.render_state;
        let scale = if drags { self.pace.scale() } else { SCALES[self.pace.step_for(self.stage.whole)] };
        let rough = View { size: view.size.map(|side| scaled(side, scale).max(1)), refine: false, ..*view };
        let before = self.rough.stats();
        let start = Instant::now();
        self.rough.render_against(device, queue, scenes, &rough);
        if drags && self.rough.stats() != before {
            let is_done = wait(device, &self.rough, patience);
            self.pace.learn(if is_done { start.elapsed() } else { patience.saturating_mul(2) });
        }
        self.is_rough_stale = false;
        self.is_rough = true;
        self.fine.drop_survey();
        self.show(view.size);
    }

    /// Makes what the preview in front has drawn the window's texture.
    fn show(&mut self, size: [u32; 2]) {
        let RenderState { device, renderer, .. } = &self.render_state;
        let Some(target) = self.front().picture() else { return };
        let target = target.clone();
        let mut renderer = renderer.write();
        let filter = wgpu::FilterMode::Linear;
        let id = match &self.texture {
            Some(shown) => {
                if shown.view != target {
                    renderer.update_egui_texture_from_wgpu_texture(device, &target, filter, shown.id);
                }
                shown.id
            }
            None => renderer.register_native_texture(device, &target, filter),
        };
        self.texture = Some(Shown { view: target, id, size });
    }

    fn front(&self) -> &Preview {
        if self.is_rough { &self.rough } else { &self.fine }
    }

    /// What is there to be shown, and the size in pixels of the pane that it was drawn for; nothing before the first.
    pub fn texture(&self) -> Option<(TextureId, [u32; 2])> {
        self.texture.as_ref().map(|shown| (shown.id, shown.size))
    }

    /// Whether rendering again would change nothing.
    pub fn is_converged(&self) -> bool {
        self.fine.is_converged() && !self.is_behind
    }

    /// Whether the picture is not yet of what was asked for last, in all its pixels.
    pub fn is_behind(&self) -> bool {
        self.is_behind
    }

    /// Whether fewer pixels are shown than the pane has.
    pub fn is_rough(&self) -> bool {
        self.is_rough
    }

    /// The picture's numbers, once, some frames after it has changed; see [`Self::is_surveying`].
    pub fn survey(&mut self) -> Option<Survey> {
        let RenderState { device, queue, .. } = &self.render_state;
        let front = if self.is_rough { &mut self.rough } else { &mut self.fine };
        // A poll fails where the device was lost, which eframe reports.
        let found = device.poll(wgpu::PollType::Poll).ok().and_then(|_| front.take_survey());
        let composites = self.rough.stats().composites + self.fine.stats().composites;
        let front = if self.is_rough { &mut self.rough } else { &mut self.fine };
        if self.surveyed != composites && !front.is_surveying() {
            self.surveyed = composites;
            front.start_survey(device, queue);
        }
        found
    }

    /// Whether a survey is under way.
    pub fn is_surveying(&self) -> bool {
        self.front().is_surveying()
    }

    /// What has been redone since the start.
    pub fn stats(&self) -> Stats {
        self.fine.stats() + self.rough.stats()
    }
}

impl Drop for Picture {
    fn drop(&mut self) {
        if let Some(Shown { id, .. }) = &self.texture {
            self.render_state.renderer.write().free_texture(id);
        }
    }
}

/// What a stage of all pixels costs, learnt from its bands.
#[derive(Debug, Default)]
struct StageCost {
    /// Zero while nobody knows.
    whole: Duration,
}

impl StageCost {
    /// Bands of a stage that take about `patience` each.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and the most bands")]
    fn bands(&self, patience: Duration) -> u32 {
        if self.whole.is_zero() {
            return FIRST_BANDS;
        }
        let share = self.whole.as_secs_f64() / patience.as_secs_f64();
        share.ceil().clamp(1.0, f64::from(MOST_BANDS)) as u32
    }

    /// One of `bands` took `cost`. One that is short says little: it may have been a stage's last rows, so the whole is
    /// taken to be a quarter of what it was at least. One in which pipelines were made is far too long.
    fn learn(&mut self, bands: u32, cost: Duration, patience: Duration) {
        let found = cost.saturating_mul(bands);
        if bands == 1 || cost > patience || self.whole.is_zero() {
            self.whole = found;
        } else if cost < patience / 4 {
            self.whole = found.max(self.whole / 4);
        }
    }
}

/// A side of the picture at a share of the pane's resolution.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of pixels below 2³²")]
fn scaled(side: u32, scale: f32) -> u32 {
    (f64::from(side) * f64::from(scale)).round() as u32
}

/// At what resolution to draw, learnt from what frames cost.
///
/// The cost is the time until the picture is seen to be done, so it holds whatever else the frame did. Where fewer
/// pixels do not make it less, it is not the pixels that cost, and resolution stays.
#[derive(Debug)]
struct Pace {
    /// Into [`SCALES`].
    step: usize,
    /// The last step worth taking.
    limit: usize,
    budget: Duration,
    /// The next frame is the first of its size, in which everything is redone: it says nothing.
    resized: bool,
    /// Where it stepped down from, and what a frame cost there, when that was the last thing learnt.
    before: Option<(usize, Duration)>,
}

impl Pace {
    fn new(budget: Duration) -> Self {
        Self { step: 0, limit: SCALES.len() - 1, budget, resized: false, before: None }
    }

    fn scale(&self) -> f32 {
        SCALES[self.step]
    }

    /// A frame took `cost`. One that is too slow says how many pixels there is time for. A step halves the pixels, so a
    /// frame of less than a quarter of the budget leaves room to go back up.
    fn learn(&mut self, cost: Duration) {
        if std::mem::take(&mut self.resized) {
            return;
        }
        if let Some((step, _)) = self.before.take().filter(|(_, before)| cost > before.mul_f32(LEAST_GAIN)) {
            self.limit = step;
            self.go(step);
        } else if cost > self.budget && self.step < self.limit {
            self.before = Some((self.step, cost));
            let whole = Duration::from_secs_f32(cost.as_secs_f32() / self.scale().powi(2));
            self.go(self.step_for(whole).clamp(self.step + 1, self.limit));
        } else if cost < self.budget / 4 && self.step > 0 {
            self.go(self.step - 1);
        }
    }

    /// The first step at which a picture is within the budget that takes `whole` at all pixels; the last, if none is.
    fn step_for(&self, whole: Duration) -> usize {
        let share = self.budget.as_secs_f64() / whole.as_secs_f64();
        SCALES.iter().position(|scale| f64::from(scale * scale) <= share).unwrap_or(SCALES.len() - 1)
    }

    /// No more pixels than at a step.
    fn go_down_to(&mut self, step: usize) {
        if step > self.step {
            self.go(step);
        }
    }

    fn go(&mut self, step: usize) {
        self.step = step;
        self.resized = true;
    }

    /// Nothing is dragged: what was found not worth it may be tried again.
    fn rest(&mut self) {
        self.limit = SCALES.len() - 1;
        self.resized = true;
        self.before = None;
    }
}

/// Whether the device has done all that it was handed for a picture, waiting for it for that long.
fn wait(device: &wgpu::Device, preview: &Preview, patience: Duration) -> bool {
    let Some(submission) = preview.submission() else { return true };
    // A poll fails where the work takes longer, or the device was lost, which eframe reports.
    let timeout = Some(patience.min(LONGEST_WAIT));
    device.poll(wgpu::PollType::Wait { submission_index: Some(submission), timeout }).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BUDGET: Duration = Duration::from_millis(40);

    /// Frames that cost `fixed` and, at full resolution, `pixels` milliseconds.
    fn after_frames(pace: &mut Pace, count: usize, fixed: f32, pixels: f32) -> f32 {
        for _ in 0..count {
            let millis = fixed + pixels * pace.scale() * pace.scale();
            pace.learn(Duration::from_secs_f32(1e-3 * millis));
        }
        pace.scale()
    }

    #[test]
    fn slow_frames_lower_the_resolution_until_they_are_fast_enough_and_fast_ones_restore_it() {
        let mut pace = Pace::new(BUDGET);
        assert_eq!(after_frames(&mut pace, 20, 0.0, 100.0), 0.5, "25 ms are within the budget");
        assert_eq!(after_frames(&mut pace, 20, 0.0, 5000.0), 0.25, "no less than a quarter");
        assert_eq!(after_frames(&mut pace, 20, 0.0, 5.0), 1.0, "all of it");
    }

    #[test]
    fn a_stage_is_cut_until_a_band_is_short_and_no_finer() {
        let patience = 2 * BUDGET;
        let mut stage = StageCost::default();
        let mut bands_of = |whole: Duration| {
            for _ in 0..10 {
                let bands = stage.bands(patience);
                stage.learn(bands, whole / bands, patience);
            }
            stage.bands(patience)
        };
        assert_eq!(bands_of(Duration::from_secs(8)), 100, "8 s in bands of 80 ms");
        assert_eq!(bands_of(Duration::from_millis(10)), 1, "short work at once");
        assert_eq!(bands_of(Duration::from_secs(1000)), MOST_BANDS, "no more than that");
    }

    #[test]
    fn frames_that_are_slow_whatever_the_resolution_keep_it() {
        let mut pace = Pace::new(BUDGET);
        assert_eq!(after_frames(&mut pace, 20, 200.0, 5.0), 1.0, "it is not the pixels");
    }
}
