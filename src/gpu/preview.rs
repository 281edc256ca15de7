//! The live picture of a scene: redoes what changed, and nothing else.

use std::sync::Arc;

use glam::DVec3;

use super::Context;
use super::composite::{CompositePass, Mix, Mixed, Picture};
use super::gbuffer::Seen;
use super::lights::LightData;
use super::lobes;
use super::occluders::Occluders;
use super::read_back::{self, Pixels, ReadBackError};
use super::sample::{Lit, Passes, Sample, Wanted};
use super::shadows::{self, ShadowData};
use super::types::Lobe;
use super::view::{Stats, View};
use crate::render::lobe_of;
use crate::scene::Scene;
use crate::shading::{self, Method};

/// Samples a pixel of a converged picture.
const SAMPLES: u16 = 8;

/// The live picture of a scene.
///
/// Work follows change: the G-buffer is redone when the camera, the size or a surface changes; a light's layer when
/// that light's emitter, its method, a lobe or the G-buffer changes; its shadow when its emitter, the width of a lobe or
/// the G-buffer does; the sum of the layers when a weight, a material or
/// the exposure changes; and nothing at all when nothing did. What to compare is the very data that the shaders read.
#[derive(Debug)]
pub struct Preview {
    passes: Passes,
    composite_pass: CompositePass,
    /// What rays meet.
    occluders: Option<Arc<Occluders>>,
    /// Through the pixels' centres: what editing changes.
    centred: Sample,
    /// Off the centres: what smooths a still picture.
    jittered: Sample,
    mix: Option<Mix>,
    picture: Picture,
    /// In the picture's mean.
    samples: u16,
    /// Every layer and shadow has been through all its stages.
    is_refined: bool,
    /// Bands that a stage is cut into.
    bands: u32,
    stats: Stats,
}

impl Preview {
    /// A preview with no picture yet. The device needs WebGPU's default limits: see [`super::device_descriptor`].
    pub fn new(device: &wgpu::Device, _queue: &wgpu::Queue) -> Self {
        Self {
            passes: Passes::new(device),
            composite_pass: CompositePass::new(device),
            occluders: None,
            centred: Sample::default(),
            jittered: Sample::default(),
            mix: None,
            picture: Picture::new(device, [1, 1]),
            samples: 0,
            is_refined: false,
            bands: 1,
            stats: Stats::default(),
        }
    }

    /// The picture of a scene, as an sRGB-encoded `Rgba8Unorm` texture. The view stays the same for as long as the
    /// size does.
    pub fn render(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        view: &View,
    ) -> &wgpu::TextureView {
        let view = View { size: view.size.map(|side| side.max(1)), ..*view };
        let layout = self.passes.gbuffer.occluder_layout();
        let occluders = Occluders::of_scene(device, layout, (scene, view.camera.eye), self.occluders.as_ref());
        self.occluders = Some(Arc::clone(&occluders));
        let (wanted, mix) = wanted(scene, &view, &occluders, self.bands);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let before = self.stats;
        let worked = self.centred.update(device, &mut encoder, &mut self.passes, &wanted, &mut self.stats);
        self.is_refined = self.centred.is_refined(&wanted.lit);
        if self.picture.size() != view.size {
            self.picture = Picture::new(device, view.size);
        }
        let shows = self.stats != before || self.mix.as_ref() != Some(&mix);
        let refines = !worked && !shows && view.refine && !self.is_converged();
        if shows {
            self.samples = 0;
            self.accumulate(device, &mut encoder, &mix, false);
        } else if refines {
            let seen = Seen::new(&occluders, &view, jitter(self.samples));
            let wanted = Wanted { seen, sample: self.samples, ..wanted };
            self.jittered.update(device, &mut encoder, &mut self.passes, &wanted, &mut self.stats);
            if self.jittered.is_refined(&wanted.lit) {
                self.accumulate(device, &mut encoder, &mix, true);
            }
        }
        self.mix = Some(mix);
        if worked || shows || refines {
            queue.submit([encoder.finish()]);
        }
        &self.picture.picture().view
    }

    fn accumulate(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, mix: &Mix, jittered: bool) {
        let sample = if jittered { &self.jittered } else { &self.centred };
        self.samples += 1;
        self.composite_pass.accumulate(device, encoder, sample, mix, self.samples, &mut self.picture);
        self.stats.composites += 1;
    }

    /// Cuts a stage of all layers and shadows into that many bands, one a call, so that no call holds the device for
    /// long. With 1, as at first, a call does a whole stage or sample.
    pub fn refine_in_bands(&mut self, bands: u32) {
        self.bands = bands.max(1);
    }

    /// How often each step was done.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// Whether rendering the same again, with [`View::refine`], changes nothing.
    pub fn is_converged(&self) -> bool {
        self.is_refined && self.samples >= SAMPLES
    }

    /// Whether every layer and shadow through the pixels' centres is as accurate as it gets, which takes a few calls.
    pub fn is_refined(&self) -> bool {
        self.is_refined
    }

    /// The picture, copied out of the device.
    ///
    /// # Errors
    ///
    /// [`ReadBackError`] where the device was lost.
    pub fn read_back(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Pixels, ReadBackError> {
        read_back::pixels(device, queue, &self.picture)
    }
}

/// A finished picture of a scene: converged where the view asks for refinement, else one sample a pixel.
///
/// # Errors
///
/// [`ReadBackError`] where the device was lost.
pub fn picture(context: &Context, scene: &Scene, view: &View) -> Result<Pixels, ReadBackError> {
    let mut preview = Preview::new(&context.device, &context.queue);
    preview.render(&context.device, &context.queue, scene, view);
    while !preview.is_refined() || (view.refine && !preview.is_converged()) {
        preview.render(&context.device, &context.queue, scene, view);
    }
    preview.read_back(&context.device, &context.queue)
}

/// The lobe of each material, and one for surfaces whose material is missing.
fn lobes(scene: &Scene, method: Method) -> Vec<Lobe> {
    let known = scene.materials.iter().map(lobe_of).chain([shading::Lobe::new(1.0)]);
    known.map(|lobe| lobes::lobe(&lobe, method)).collect()
}

/// What the layers are to be, and how they are mixed.
fn wanted(scene: &Scene, view: &View, occluders: &Arc<Occluders>, bands: u32) -> (Wanted, Mix) {
    let mut mixed = Vec::new();
    let matte = scene.materials.iter().all(|material| material.specular == DVec3::ZERO);
    let mut wanted = Wanted {
        seen: Seen::new(occluders, view, [0.0, 0.0]),
        lobes: lobes(scene, view.method),
        matte,
        sample: 0,
        bands,
        lit: Vec::new(),
        dark: Vec::new(),
    };
    let shadows = view.shadows && shadows::are_cast(&scene.surfaces);
    let other_lobes = !matte && wanted.lobes.iter().any(lobes::is_other);
    for light in &scene.lights {
        let reached = || scene.surfaces.iter().map(|surface| light.reaches(&surface.name)).collect();
        let reaches: Option<Arc<[bool]>> = light.only.is_some().then(reached);
        for (emitter, weight) in light.parts() {
            let method = view.method.for_shape(&light.shape);
            let mut data = LightData::new(&emitter, method, view.camera.eye);
            if other_lobes {
                data = data.with_other_lobes(&emitter, method, view.camera.eye);
            }
            let shadow = shadows.then(|| ShadowData::new(&emitter, view.camera.eye, other_lobes));
            let lit = Lit { light: data, shadow };
            if weight.max_element() > 0.0 {
                wanted.lit.push(lit.clone());
                mixed.push(Mixed { lit, weight, reaches: reaches.clone() });
            } else {
                wanted.dark.push(lit);
            }
        }
    }
    let mix = Mix::new(scene, view, mixed);
    (wanted, mix)
}

/// Offset of a sample from the pixel's centre, in pixels, −½…½.
///
/// M. Roberts' R2 sequence, which is low-discrepancy for every number of samples: multiples of (1/φ, 1/φ²) modulo 1,
/// φ the root of φ³ = φ + 1. Sample 0 is the centre.
fn jitter(sample: u16) -> [f32; 2] {
    [0.754_877_7, 0.569_840_3].map(|step: f32| (0.5 + f32::from(sample) * step).fract() - 0.5)
}
