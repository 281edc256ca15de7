//! The live picture as a texture of the window.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use eframe::egui_wgpu::RenderState;
use egui::TextureId;

use crate::gpu::{Preview, Stats, View};
use crate::scene::Scene;

/// A frame may take this long while something is dragged, before resolution is lowered.
const FRAME_BUDGET: Duration = Duration::from_millis(40);
/// Resolutions while dragging, as shares of the pane's: each halves the number of pixels.
const SCALES: [f32; 5] = [1.0, 0.7, 0.5, 0.35, 0.25];

/// A [`Preview`] shown by egui.
pub struct Picture {
    render_state: RenderState,
    preview: Preview,
    texture: Option<(wgpu::TextureView, TextureId)>,
    pace: Pace,
    clock: Clock,
}

impl Picture {
    /// No picture yet, on the window's device.
    pub fn new(render_state: &RenderState) -> Self {
        Self {
            render_state: render_state.clone(),
            preview: Preview::new(&render_state.device, &render_state.queue),
            texture: None,
            pace: Pace { step: 0, budget: FRAME_BUDGET },
            clock: Clock::default(),
        }
    }

    /// How long a frame may take while something is dragged.
    pub fn set_frame_budget(&mut self, budget: Duration) {
        self.pace.budget = budget;
    }

    /// The picture of `scene`, where `view.size` is the pane in physical pixels. While `dragging` fewer pixels may be
    /// shaded, and a picture that is still refines a little with each call.
    pub fn render(&mut self, scene: &Scene, view: &View, dragging: bool) -> TextureId {
        let RenderState { device, queue, renderer, .. } = &self.render_state;
        // A failed poll means a lost device; then there is nothing to learn, and eframe reports it.
        let polled = device.poll(wgpu::PollType::Poll).is_ok();
        if let Some(cost) = self.clock.read().filter(|_| polled && dragging) {
            self.pace.learn(cost);
        }
        let limit = device.limits().max_texture_dimension_2d;
        let scale = if dragging { self.pace.scale() } else { 1.0 };
        let view = View { size: view.size.map(|side| scaled(side, scale).clamp(1, limit)), ..*view };
        let before = self.preview.stats();
        let target = self.preview.render(device, queue, scene, &view).clone();
        if self.preview.stats() != before {
            self.clock.start(queue);
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
        self.preview.is_converged()
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

/// A side of the picture at a share of the pane's resolution.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a positive number of pixels below 2³²")]
fn scaled(side: u32, scale: f32) -> u32 {
    (f64::from(side) * f64::from(scale)).round() as u32
}

/// At what resolution to draw, learnt from what frames cost.
#[derive(Debug)]
struct Pace {
    step: usize,
    budget: Duration,
}

impl Pace {
    fn scale(&self) -> f32 {
        SCALES[self.step]
    }

    /// A frame took `cost`. A step halves the pixels, so a frame of less than a quarter of the budget leaves room to
    /// go back up.
    fn learn(&mut self, cost: Duration) {
        if cost > self.budget {
            self.step = (self.step + 1).min(SCALES.len() - 1);
        } else if cost < self.budget / 4 {
            self.step = self.step.saturating_sub(1);
        }
    }
}

/// Measures from handing work in until the device has done it.
#[derive(Debug, Default)]
struct Clock {
    nanos: Arc<AtomicU64>,
}

impl Clock {
    /// Measure the work handed in last.
    fn start(&mut self, queue: &wgpu::Queue) {
        self.nanos = Arc::default();
        let (nanos, start) = (Arc::clone(&self.nanos), Instant::now());
        queue.on_submitted_work_done(move || {
            let elapsed = u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX).max(1);
            nanos.store(elapsed, Ordering::Relaxed);
        });
    }

    /// How long the work took, once, when it is done.
    fn read(&self) -> Option<Duration> {
        let nanos = self.nanos.swap(0, Ordering::Relaxed);
        (nanos > 0).then(|| Duration::from_nanos(nanos))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slow_frames_lower_the_resolution_to_a_limit_and_fast_ones_restore_it() {
        let mut pace = Pace { step: 0, budget: Duration::from_millis(40) };
        for _ in 0..10 {
            pace.learn(Duration::from_millis(200));
        }
        assert_eq!(pace.scale(), 0.25, "a quarter");
        pace.learn(Duration::from_millis(20));
        assert_eq!(pace.scale(), 0.25, "within the budget nothing changes");
        for _ in 0..10 {
            pace.learn(Duration::from_millis(2));
        }
        assert_eq!(pace.scale(), 1.0, "all of it");
    }
}
