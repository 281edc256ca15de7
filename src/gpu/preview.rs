//! The live picture of a scene: redoes what changed, and nothing else.

use std::sync::Arc;

use glam::DVec3;

use super::Context;
use super::composite::{Means, Mix, Mixed, Scratch};
use super::display::DisplayPass;
use super::gbuffer::Seen;
use super::lights::LightData;
use super::lobes;
use super::occluders::Occluders;
use super::pass::Target;
use super::passes::{Passes, SharedPasses};
use super::read_back::{self, Pixels, ReadBackError};
use super::sample::{Lit, Sample, Wanted};
use super::shadows::{self, ShadowData};
use super::survey::{Pending, Survey};
use super::types::{Lobe, Shown};
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
/// the G-buffer does; the sum of the layers when a weight, a material or the exposure changes; the picture of the sums
/// when what it shows of them does; and nothing at all when nothing did. What to compare is the very data that the
/// shaders read. Two methods that are compared share the G-buffer, shadows, and the layers of lights that do not have
/// one of them.
#[derive(Debug)]
pub struct Preview {
    passes: SharedPasses,
    /// What rays meet.
    occluders: Option<Arc<Occluders>>,
    /// Through the pixels' centres: what editing changes.
    centred: Sample,
    /// Off the centres: what smooths a still picture.
    jittered: Sample,
    /// By the view's method, and by the one that it is compared with.
    mixes: Vec<Mix>,
    scratch: Scratch,
    means: [Option<Means>; 2],
    /// In the means.
    samples: u16,
    shown: Option<Shown>,
    picture: Target,
    survey: Option<Pending>,
    /// The means are of other layers or weights than those of now.
    is_stale: bool,
    /// The picture is of what was asked for last.
    is_whole: bool,
    /// Every layer and shadow has been through all its stages.
    is_refined: bool,
    /// Bands that a stage is cut into.
    bands: u32,
    /// What was handed in last.
    submission: Option<wgpu::SubmissionIndex>,
    stats: Stats,
}

impl Preview {
    /// A preview with no picture yet. The device needs WebGPU's default limits: see [`super::device_descriptor`].
    pub fn new(device: &wgpu::Device) -> Self {
        Self::sharing(device, &SharedPasses::new(device))
    }

    /// The same, with passes of the same device that other previews have too.
    pub fn sharing(device: &wgpu::Device, passes: &SharedPasses) -> Self {
        Self {
            passes: passes.clone(),
            occluders: None,
            centred: Sample::default(),
            jittered: Sample::default(),
            mixes: Vec::new(),
            scratch: Scratch::new(device, [1, 1]),
            means: [None, None],
            samples: 0,
            shown: None,
            picture: DisplayPass::target(device, [1, 1]),
            survey: None,
            is_stale: false,
            is_whole: false,
            is_refined: false,
            bands: 1,
            submission: None,
            stats: Stats::default(),
        }
    }

    /// The picture of a scene, as an sRGB-encoded `Rgba8Unorm` texture. The view stays the same for as long as the
    /// size does. In [bands](Self::work_in_bands), the picture is the one before until it [is whole](Self::is_whole);
    /// of a new size it is empty until then.
    pub fn render(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        view: &View,
    ) -> &wgpu::TextureView {
        self.render_against(device, queue, [scene, scene], view)
    }

    /// [`Self::render`], where what the view compares the scene with has other lights: those of the second.
    pub fn render_against(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        [scene, other]: [&Scene; 2],
        view: &View,
    ) -> &wgpu::TextureView {
        let view = View { size: view.size.map(|side| side.max(1)), ..*view };
        let shared = self.passes.clone();
        let mut passes = shared.lock();
        let layout = passes.gbuffer.occluder_layout();
        let occluders = Occluders::of_scene(device, layout, (scene, view.camera.eye), self.occluders.as_ref());
        self.occluders = Some(Arc::clone(&occluders));
        let (wanted, mixes) = wanted([scene, other], &view, &occluders, self.bands);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let before = self.stats;
        let worked = self.centred.update(device, &mut encoder, &mut passes, &wanted, &mut self.stats);
        self.is_refined = self.centred.is_refined(&wanted.lit);
        self.is_whole = self.centred.is_whole(&wanted.lit);
        self.fit(device, view.size, mixes.len());
        self.is_stale |= self.stats != before || self.mixes != mixes;
        let sums = self.is_stale && self.is_whole;
        let refines = !worked && !sums && view.refine && !self.is_converged();
        self.mixes = mixes;
        if sums {
            self.is_stale = false;
            self.samples = 0;
            self.accumulate(device, &mut encoder, &passes, false);
        } else if refines {
            let seen = Seen::new(&occluders, &view, jitter(self.samples));
            let wanted = Wanted { seen, sample: self.samples, ..wanted };
            self.jittered.update(device, &mut encoder, &mut passes, &wanted, &mut self.stats);
            if self.jittered.is_refined(&wanted.lit) {
                self.accumulate(device, &mut encoder, &passes, true);
            }
        }
        let shown = Some(Shown::new(&view));
        let shows = self.is_whole && (self.stats.composites != before.composites || self.shown != shown);
        if shows {
            self.show(device, &mut encoder, &passes, Shown::new(&view));
        }
        if worked || shows || refines {
            self.submission = Some(queue.submit([encoder.finish()]));
        }
        &self.picture.view
    }

    /// Room for the means of that many methods.
    fn fit(&mut self, device: &wgpu::Device, size: [u32; 2], methods: usize) {
        if [self.picture.texture.width(), self.picture.texture.height()] != size {
            self.picture = DisplayPass::target(device, size);
            self.scratch = Scratch::new(device, size);
            self.means = [None, None];
            self.mixes.clear();
        }
        for (i, means) in self.means.iter_mut().enumerate() {
            if i < methods {
                means.get_or_insert_with(|| Means::new(device, size));
            } else {
                *means = None;
            }
        }
    }

    /// Adds a sample to the means.
    fn accumulate(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        passes: &Passes,
        jittered: bool,
    ) {
        let sample = if jittered { &self.jittered } else { &self.centred };
        self.samples += 1;
        for (mix, means) in self.mixes.iter().zip(self.means.iter_mut().flatten()) {
            passes.composite.accumulate(device, encoder, (sample, self.samples), mix, &self.scratch, means);
            self.stats.composites += 1;
        }
    }

    /// Draws the picture of the means.
    fn show(&mut self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, passes: &Passes, shown: Shown) {
        if let (Some(gbuffer), Some(means)) = (self.centred.gbuffer(), self.compared()) {
            passes.display.draw(device, encoder, gbuffer, means, &shown, &self.picture);
            self.shown = Some(shown);
        }
    }

    /// The means by the view's method and by the other one, or the same again.
    fn compared(&self) -> Option<[&Means; 2]> {
        let means = self.means[0].as_ref()?;
        Some([means, self.means[1].as_ref().unwrap_or(means)])
    }

    /// Starts a survey of the picture as it is now, if none is under way.
    pub fn start_survey(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) {
        if self.survey.is_none()
            && let Some(means) = self.compared()
        {
            self.survey = Some(self.passes.lock().survey.start(device, queue, means));
        }
    }

    /// The survey that was started, once, when the device has been polled after it was done.
    pub fn take_survey(&mut self) -> Option<Survey> {
        Some(self.survey.take_if(|pending| pending.is_ready())?.survey())
    }

    /// Gives up the survey that was started, if any.
    pub fn drop_survey(&mut self) {
        self.survey = None;
    }

    /// Whether a survey has been started and not been taken.
    pub fn is_surveying(&self) -> bool {
        self.survey.is_some()
    }

    /// Cuts a stage of all layers and shadows into that many bands, one a call, so that no call holds the device for
    /// long. With 1, as at first, a call does a whole stage or sample.
    pub fn work_in_bands(&mut self, bands: u32) {
        self.bands = bands.max(1);
    }

    /// What [`Self::render`] draws on; nothing before the first call.
    pub fn picture(&self) -> Option<&wgpu::TextureView> {
        self.submission.as_ref().map(|_| &self.picture.view)
    }

    /// What was handed to the device last: the picture is done when the device has done that, whatever else it draws.
    pub fn submission(&self) -> Option<wgpu::SubmissionIndex> {
        self.submission.clone()
    }

    /// How often each step was done.
    pub fn stats(&self) -> Stats {
        self.stats
    }

    /// Whether the picture shows what was asked for last, however roughly; always so after a call that is not cut into
    /// bands.
    pub fn is_whole(&self) -> bool {
        self.is_whole
    }

    /// Whether rendering the same again, with [`View::refine`], changes nothing.
    pub fn is_converged(&self) -> bool {
        self.is_refined && self.samples >= SAMPLES
    }

    /// Whether every layer and shadow through the pixels' centres is as accurate as it gets, which takes a few calls.
    pub fn is_refined(&self) -> bool {
        self.is_refined
    }

    /// The picture and the means by the view's method, copied out of the device.
    ///
    /// # Errors
    ///
    /// [`ReadBackError`] where the device was lost, or nothing has been rendered.
    pub fn read_back(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Pixels, ReadBackError> {
        let means = self.means[0].as_ref().ok_or(ReadBackError::Nothing)?;
        read_back::pixels(device, queue, means, &self.picture)
    }
}

/// A finished picture of a scene: converged where the view asks for refinement, else one sample a pixel.
///
/// # Errors
///
/// [`ReadBackError`] where the device was lost.
pub fn picture(context: &Context, scene: &Scene, view: &View) -> Result<Pixels, ReadBackError> {
    let mut preview = Preview::new(&context.device);
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

/// What the layers are to be, and how they are mixed: by the view's method, and by the one that it is compared with,
/// which has the lights of `other`.
fn wanted([scene, other]: [&Scene; 2], view: &View, occluders: &Arc<Occluders>, bands: u32) -> (Wanted, Vec<Mix>) {
    let methods: Vec<_> = [Some(view.method), view.display.against()].into_iter().flatten().collect();
    let matte = scene.materials.iter().all(|material| material.specular == DVec3::ZERO);
    // Lobes differ between methods by Chebyshev's fit only: where both have one, it is the first one's.
    let fitted = methods.iter().find(|method| matches!(method, Method::Chebyshev { .. }));
    let mut wanted = Wanted {
        seen: Seen::new(occluders, view, [0.0, 0.0]),
        lobes: lobes(scene, *fitted.unwrap_or(&view.method)),
        matte,
        sample: 0,
        bands,
        lit: Vec::new(),
        dark: Vec::new(),
    };
    let pictures = [scene, other].into_iter().zip(methods);
    let mixes = pictures.map(|(scene, method)| Mix::new(scene, view, light_up(scene, view, method, &mut wanted)));
    let mixes = mixes.collect();
    (wanted, mixes)
}

/// Adds a scene's lights by a method to what is wanted; those that contribute, with their weights.
fn light_up(scene: &Scene, view: &View, method: Method, wanted: &mut Wanted) -> Vec<Mixed> {
    let shadows = view.shadows && shadows::are_cast(&scene.surfaces);
    let other_lobes = !wanted.matte && wanted.lobes.iter().any(lobes::is_other);
    let mut mixed = Vec::new();
    for light in &scene.lights {
        let reached = || scene.surfaces.iter().map(|surface| light.reaches(&surface.name)).collect();
        let reaches: Option<Arc<[bool]>> = light.only.is_some().then(reached);
        for (emitter, weight) in light.parts() {
            let method = method.for_shape(&light.shape);
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
    mixed
}

/// Offset of a sample from the pixel's centre, in pixels, −½…½.
///
/// M. Roberts' R2 sequence, which is low-discrepancy for every number of samples: multiples of (1/φ, 1/φ²) modulo 1,
/// φ the root of φ³ = φ + 1. Sample 0 is the centre.
fn jitter(sample: u16) -> [f32; 2] {
    [0.754_877_7, 0.569_840_3].map(|step: f32| (0.5 + f32::from(sample) * step).fract() - 0.5)
}
