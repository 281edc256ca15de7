//! The live picture as a texture of the window.

use std::time::{Duration, Instant};

use eframe::egui_wgpu::RenderState;
use egui::TextureId;

use crate::gpu::{Preview, Stats, Survey, View};
use crate::scene::Scene;

/// A frame may take this long while something is dragged, before resolution is lowered.
pub const FRAME_BUDGET: Duration = Duration::from_millis(40);
/// A band of refinement may take this many times as long.
const REFINE_SHARE: u32 = 2;
/// And this many times while nobody acts, so that most of the time is not spent on drawing the rest of the window: the
/// next click waits for no more.
const CALM_SHARE: u32 = 6;
/// The window never waits longer than this for the device.
const LONGEST_WAIT: Duration = Duration::from_secs(1);
/// Bands of a layer, at most.
const MOST_BANDS: u32 = 256;
/// Resolutions while dragging, as shares of the pane's: each halves the number of pixels.
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

/// A [`Preview`] shown by egui.
pub struct Picture {
    render_state: RenderState,
    preview: Preview,
    texture: Option<(wgpu::TextureView, TextureId)>,
    pace: Pace,
    /// Bands that refinement is cut into, so that each takes about [`REFINE_SHARE`] frames' budget.
    bands: u32,
    /// The device was too busy for what was asked for last.
    is_behind: bool,
    /// Sums that had been made when the last survey was begun.
    surveyed: u64,
}

impl Picture {
    /// No picture yet, on the window's device.
    pub fn new(render_state: &RenderState) -> Self {
        Self {
            render_state: render_state.clone(),
            preview: Preview::new(&render_state.device, &render_state.queue),
            texture: None,
            pace: Pace::new(FRAME_BUDGET),
            bands: 1,
            is_behind: false,
            surveyed: 0,
        }
    }

    /// How long a frame may take while something is dragged, and about twice as long while it refines.
    pub fn set_frame_budget(&mut self, budget: Duration) {
        self.pace.budget = budget;
    }

    /// The picture of the first scene, compared where the view does so with the second's lights, where `view.size` is the
    /// pane in physical pixels. While something is dragged fewer pixels may be shaded, and a picture that is still refines
    /// a little with each call. It stays as it was while the device is busy with it: see [`Self::is_behind`].
    pub fn render(&mut self, scenes: [&Scene; 2], view: &View, haste: Haste) -> TextureId {
        let RenderState { device, queue, renderer, .. } = &self.render_state;
        let share = match haste {
            Haste::Dragging => 1,
            Haste::Acting => REFINE_SHARE,
            Haste::Calm => CALM_SHARE,
        };
        let dragging = haste == Haste::Dragging;
        let patience = self.pace.budget.saturating_mul(share);
        // What was handed in before is done first, so that work never piles up and what follows has a cost of its own.
        self.is_behind = !wait(device, &self.preview, patience);
        if let (true, Some((_, id))) = (self.is_behind, &self.texture) {
            return *id;
        }
        let limit = device.limits().max_texture_dimension_2d;
        let scale = if dragging { self.pace.scale() } else { 1.0 };
        let size = view.size.map(|side| scaled(side, scale).clamp(1, limit));
        let view = View { size, ..*view };
        let before = self.preview.stats();
        self.preview.refine_in_bands(self.bands);
        let start = Instant::now();
        let target = self.preview.render_against(device, queue, scenes, &view).clone();
        let worked = self.preview.stats() != before || (view.refine && !self.preview.is_converged());
        if worked {
            // Longer than the patience counts as twice as long.
            let cost = if wait(device, &self.preview, patience) { start.elapsed() } else { patience.saturating_mul(2) };
            if dragging {
                self.pace.learn(cost);
            } else {
                self.bands = bands_after(self.bands, cost, patience);
            }
        }
        if !dragging {
            self.pace.rest();
        }
        let mut renderer = renderer.write();
        let filter = wgpu::FilterMode::Linear;
        let id = match &self.texture {
            Some((shown, id)) => {
                if *shown != target {
                    renderer.update_egui_texture_from_wgpu_texture(device, &target, filter, *id);
                }
                *id
            }
            None => renderer.register_native_texture(device, &target, filter),
        };
        self.texture = Some((target, id));
        id
    }

    /// Whether rendering again would change nothing.
    pub fn is_converged(&self) -> bool {
        self.preview.is_converged() && !self.is_behind
    }

    /// Whether the picture is not yet of what was asked for last.
    pub fn is_behind(&self) -> bool {
        self.is_behind
    }

    /// The picture's numbers, once, some frames after it has changed; see [`Self::is_surveying`].
    pub fn survey(&mut self) -> Option<Survey> {
        let RenderState { device, queue, .. } = &self.render_state;
        // A poll fails where the device was lost, which eframe reports.
        let found = device.poll(wgpu::PollType::Poll).ok().and_then(|_| self.preview.take_survey());
        let composites = self.preview.stats().composites;
        if self.surveyed != composites && !self.preview.is_surveying() {
            self.surveyed = composites;
            self.preview.start_survey(device, queue);
        }
        found
    }

    /// Whether a survey is under way.
    pub fn is_surveying(&self) -> bool {
        self.preview.is_surveying()
    }

    /// What has been redone since the start.
    pub fn stats(&self) -> Stats {
        self.preview.stats()
    }
}

impl Drop for Picture {
    fn drop(&mut self) {
        if let Some((_, id)) = &self.texture {
            self.render_state.renderer.write().free_texture(id);
        }
    }
}

/// Bands for the next refinement, where one of `bands` took `cost`: as many more as it was too long, or a quarter,
/// because a first look that makes pipelines too costs far more than what follows.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 1 and the most bands")]
fn bands_after(bands: u32, cost: Duration, budget: Duration) -> u32 {
    let share = cost.as_secs_f64() / budget.as_secs_f64();
    if share > 1.0 {
        (f64::from(bands) * share).ceil().min(f64::from(MOST_BANDS)) as u32
    } else if share < 0.25 {
        bands.div_ceil(4)
    } else {
        bands
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
    /// What a frame cost one step up, when the last thing learnt was to step down.
    before: Option<Duration>,
}

impl Pace {
    fn new(budget: Duration) -> Self {
        Self { step: 0, limit: SCALES.len() - 1, budget, resized: false, before: None }
    }

    fn scale(&self) -> f32 {
        SCALES[self.step]
    }

    /// A frame took `cost`. A step halves the pixels, so a frame of less than a quarter of the budget leaves room to
    /// go back up.
    fn learn(&mut self, cost: Duration) {
        if std::mem::take(&mut self.resized) {
            return;
        }
        if self.before.take().is_some_and(|before| cost > before.mul_f32(LEAST_GAIN)) {
            self.limit = self.step.saturating_sub(1);
            self.go(self.limit);
        } else if cost > self.budget && self.step < self.limit {
            self.before = Some(cost);
            self.go(self.step + 1);
        } else if cost < self.budget / 4 && self.step > 0 {
            self.go(self.step - 1);
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
    fn refinement_is_cut_until_a_band_is_short_and_no_finer() {
        let mut bands = 1;
        for _ in 0..10 {
            bands = bands_after(bands, Duration::from_secs(8) / bands, 2 * BUDGET);
        }
        assert_eq!(bands, 100, "8 s in bands of 80 ms");
        for _ in 0..10 {
            bands = bands_after(bands, Duration::from_millis(10) / bands, 2 * BUDGET);
        }
        assert_eq!(bands, 1, "short work at once");
        assert_eq!(bands_after(1, Duration::from_secs(1000), 2 * BUDGET), MOST_BANDS, "no more than that");
    }

    #[test]
    fn frames_that_are_slow_whatever_the_resolution_keep_it() {
        let mut pace = Pace::new(BUDGET);
        assert_eq!(after_frames(&mut pace, 20, 200.0, 5.0), 1.0, "it is not the pixels");
    }
}
