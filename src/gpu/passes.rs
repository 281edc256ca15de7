//! What makes pictures, once for all previews on a device.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use super::composite::CompositePass;
use super::display::DisplayPass;
use super::gbuffer::GBufferPass;
use super::layers::LayerPass;
use super::shadows::ShadowPass;
use super::survey::SurveyPass;

/// Pipelines and tables on a device, made when first needed, for all the previews that are given a clone.
#[derive(Clone, Debug)]
pub struct SharedPasses(Arc<Mutex<Passes>>);

impl SharedPasses {
    /// No more than every picture needs, yet.
    pub fn new(device: &wgpu::Device) -> Self {
        Self(Arc::new(Mutex::new(Passes::new(device))))
    }

    /// The passes, for as long as one picture's work is written down. What a panic left behind is as good as any.
    pub(super) fn lock(&self) -> MutexGuard<'_, Passes> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Every pass of a picture.
#[derive(Debug)]
pub(crate) struct Passes {
    pub(crate) gbuffer: GBufferPass,
    pub(crate) layers: LayerPass,
    pub(crate) shadows: ShadowPass,
    pub(crate) composite: CompositePass,
    pub(crate) display: DisplayPass,
    pub(crate) survey: SurveyPass,
}

impl Passes {
    fn new(device: &wgpu::Device) -> Self {
        Self {
            gbuffer: GBufferPass::new(device),
            layers: LayerPass::new(device),
            shadows: ShadowPass::new(device),
            composite: CompositePass::new(device),
            display: DisplayPass::new(device),
            survey: SurveyPass::new(device),
        }
    }
}
