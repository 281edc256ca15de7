//! Radiance and illuminance from the light layers, and their means over samples.

use super::gbuffer::GBuffer;
use super::pass::{self, Binding, Target};
use super::sample::{Lit, Sample};
use super::shader::{Module, Source};
use super::types::{Composite, Reflectance, Tone, VisibleEmitter, f32_of, u32_of, vec3_of, vec4_of};
use super::view::View;
use crate::light::{Emitter, Light, PolygonEmitter, Shape, Textured};
use crate::scene::Scene;
use crate::shading::textured;
use glam::DVec3;
use std::f64::consts::PI;
use std::sync::Arc;

/// Radiance, cd/m².
const RADIANCE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// The tone curve's output, 0…1.
const DISPLAY: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
// Kinds of visible emitters, in `composite.wgsl`; a polygon is 0.
const SPHERE: u32 = 1;
const DISK: u32 = 2;
const CAP: u32 = 3;
const SKY: u32 = 4;
/// Layers that one pass sums.
const BATCH: usize = 6;

/// Texels along a side of a pattern that is seen; of larger patterns some are left out.
const MOST_SEEN: u32 = 256;

/// A light that contributes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mixed {
    pub(crate) lit: Lit,
    pub(crate) weight: DVec3,
    /// Of each surface, whether it is lit; all of them where there is no list.
    pub(crate) reaches: Option<Arc<[bool]>>,
}

/// All that a picture depends on beside the layers. Equal mixes of the same layers give equal pictures.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Mix {
    lights: Vec<Mixed>,
    surfaces: usize,
    reflectances: Vec<Reflectance>,
    emitters: Vec<VisibleEmitter>,
    emitter_vertices: Vec<[f32; 4]>,
    /// 2^exposure / 100
    exposure: f32,
}

impl Mix {
    /// The scene's materials and emitters in this view; `lights` are its contributing lights in order.
    pub(crate) fn new(scene: &Scene, view: &View, lights: Vec<Mixed>) -> Self {
        let reflectances = scene
            .materials
            .iter()
            .map(|material| Reflectance {
                diffuse_over_pi: vec3_of(material.diffuse / PI),
                specular: vec3_of(material.specular),
                ..Default::default()
            })
            // Of surfaces whose material is missing.
            .chain([Reflectance::default()])
            .collect();
        let mut mix = Self {
            lights,
            surfaces: scene.surfaces.len(),
            reflectances,
            emitters: Vec::new(),
            emitter_vertices: Vec::new(),
            exposure: f32_of(view.exposure_ev.exp2() / 100.0),
        };
        if view.show_emitters {
            for light in scene.lights.iter().filter(|light| !light.muted) {
                match &light.shape {
                    Shape::Textured(shape) => mix.add_textured(light, shape, view.camera.eye),
                    _ => mix.add_emitter(&light.emitter(), light.weight(), view.camera.eye),
                }
            }
        }
        mix
    }

    fn add_emitter(&mut self, emitter: &Emitter, radiance: DVec3, eye: DVec3) {
        let common = VisibleEmitter { radiance: vec3_of(radiance), ..Default::default() };
        match emitter {
            Emitter::Disk(disk) => {
                let first = self.add_vertex(disk.center - eye, 0.0);
                self.emitters.push(VisibleEmitter {
                    kind: DISK,
                    vector: vec3_of(disk.normal),
                    radius: f32_of(disk.radius),
                    two_sided: u32::from(disk.two_sided),
                    first,
                    ..common
                });
            }
            Emitter::Cap(cap) => self.emitters.push(VisibleEmitter {
                kind: CAP,
                vector: vec3_of(cap.to_center),
                radius: f32_of(cap.half_angle.sin()),
                ..common
            }),
            Emitter::Sky(sky) => {
                let first = self.add_vertex(DVec3::new(sky.uniform, sky.cosine, 0.0), 0.0);
                self.emitters.push(VisibleEmitter { kind: SKY, vector: vec3_of(sky.zenith), first, ..common });
            }
            Emitter::Polygon(polygon) => self.add_polygon(polygon, common, eye),
            Emitter::Sphere(sphere) => self.emitters.push(VisibleEmitter {
                kind: SPHERE,
                vector: vec3_of(sphere.center - eye),
                radius: f32_of(sphere.radius),
                ..common
            }),
            Emitter::Textured(_) | Emitter::Line(_) | Emitter::Point(_) | Emitter::Directional(_) => {}
        }
    }

    /// A rectangle, and its texels after its corners.
    fn add_textured(&mut self, light: &Light, shape: &Textured, eye: DVec3) {
        let Emitter::Textured(emitter) = light.emitter() else { return };
        let image = &shape.pattern.image;
        let [columns, rows] = emitter.pattern.size().map(|side| side.min(MOST_SEEN));
        let radiance = vec3_of(light.weight());
        let common = VisibleEmitter { radiance, columns, rows, ..Default::default() };
        self.add_polygon(&textured::as_polygon(&emitter), common, eye);
        let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
        for row in 0..rows {
            for column in 0..columns {
                let value = image.value(share(column, columns), share(row, rows));
                self.emitter_vertices.push(vec4_of(value, 0.0));
            }
        }
    }

    /// Its place among the emitters' vertices.
    fn add_vertex(&mut self, vertex: DVec3, w: f64) -> u32 {
        self.emitter_vertices.push(vec4_of(vertex, w));
        u32_of(self.emitter_vertices.len() - 1)
    }

    fn add_polygon(&mut self, polygon: &PolygonEmitter, common: VisibleEmitter, eye: DVec3) {
        self.emitters.push(VisibleEmitter {
            vector: vec3_of(polygon.normal),
            two_sided: u32::from(polygon.two_sided),
            first: u32_of(self.emitter_vertices.len()),
            count: u32_of(polygon.vertices.len()),
            ..common
        });
        self.emitter_vertices.extend(polygon.vertices.iter().map(|vertex| vec4_of(*vertex - eye, 0.0)));
    }
}

/// Of each surface, a bit for each light that reaches it.
fn reached(lights: &[Mixed], surfaces: usize) -> Vec<u32> {
    let reaches = |mixed: &Mixed, surface: usize| mixed.reaches.as_ref().is_none_or(|list| list[surface]);
    let bits = |surface| lights.iter().enumerate().map(move |(i, mixed)| u32::from(reaches(mixed, surface)) << i).sum();
    (0..surfaces).map(bits).collect()
}

/// Means over samples by one method.
#[derive(Debug)]
pub(crate) struct Means {
    /// Mean radiance with illuminance, and mean of the tone curve's output with the share of the samples that see a
    /// surface; samples are written to each pair in turn.
    pairs: [[Target; 2]; 2],
    current: usize,
}

/// The sample in work: batches are written to each in turn.
#[derive(Debug)]
pub(crate) struct Scratch([Target; 2]);

impl Scratch {
    pub(crate) fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        Self([0, 1].map(|_| Target::new(device, size, RADIANCE)))
    }
}

impl Means {
    pub(crate) fn new(device: &wgpu::Device, size: [u32; 2]) -> Self {
        let pair = || [RADIANCE, DISPLAY].map(|format| Target::new(device, size, format));
        Self { pairs: [pair(), pair()], current: 0 }
    }

    /// Radiance, cd/m², and illuminance, lx.
    pub(crate) fn radiance(&self) -> &Target {
        &self.pairs[self.current][0]
    }

    /// The tone curve's output, and the share of the samples that see a surface.
    pub(crate) fn display(&self) -> &Target {
        &self.pairs[self.current][1]
    }
}

/// What makes means.
#[derive(Debug)]
pub(crate) struct CompositePass {
    scene_layout: wgpu::BindGroupLayout,
    batch_layout: wgpu::BindGroupLayout,
    sum: wgpu::RenderPipeline,
    tone_layout: wgpu::BindGroupLayout,
    tone: wgpu::RenderPipeline,
    /// Stands in for the layers that a batch does not have.
    no_layer: Target,
}

impl CompositePass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        use Binding::{Storage, Texture, Uniform};
        let scene_layout = pass::bind_group_layout(device, &[Texture, Texture, Storage, Storage, Storage, Storage]);
        let batch_layout =
            pass::bind_group_layout(device, &[&[Uniform, Texture][..], &[Texture; 2 * BATCH], &[Storage]].concat());
        let tone_layout = pass::bind_group_layout(device, &[Texture, Texture, Texture, Uniform]);
        let [sum, tone] = Self::sources();
        Self {
            sum: pass::pipeline(device, &sum, "composite", &[&scene_layout, &batch_layout], &[RADIANCE]),
            tone: pass::pipeline(device, &tone, "tone", &[&tone_layout], &[RADIANCE, DISPLAY]),
            scene_layout,
            batch_layout,
            tone_layout,
            no_layer: Target::new(device, [1, 1], wgpu::TextureFormat::Rg32Float),
        }
    }

    /// The shaders of the sum and of the tone curve.
    pub(crate) fn sources() -> [Source; 2] {
        [Module::COMPOSITE, Module::TONE].map(|module| Source::join(&[Module::FULLSCREEN, module]))
    }

    /// Adds sample number `count` (from 1) to the means; the first starts them anew.
    pub(crate) fn accumulate(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        (sample, count): (&Sample, u16),
        mix: &Mix,
        scratch: &Scratch,
        means: &mut Means,
    ) {
        let Some(gbuffer) = sample.gbuffer() else { return };
        let scene = self.scene_group(device, gbuffer, mix);
        let batches = mix.lights.len().div_ceil(BATCH).max(1);
        for batch in 0..batches {
            let lights = &mix.lights[batch * BATCH..mix.lights.len().min((batch + 1) * BATCH)];
            let mut uniform = Composite {
                adds: u32::from(batch > 0),
                emitter_count: u32_of(mix.emitters.len()),
                ..Default::default()
            };
            for (slot, mixed) in uniform.weights.iter_mut().zip(lights) {
                *slot = vec4_of(mixed.weight, f64::from(u8::from(mixed.lit.shadow.is_some())));
            }
            let reached = pass::storage(device, &reached(lights, mix.surfaces));
            let [before, after] = [batch + 1, batch].map(|i| &scratch.0[i % 2]);
            let group = self.batch_group(device, (&uniform, &reached), sample, lights, before);
            pass::run(encoder, &self.sum, &[&scene, &group], &[&after.view]);
        }
        let settings = Tone { exposure: mix.exposure, share: f32::from(count).recip() };
        self.tone(device, encoder, settings, &scratch.0[(batches - 1) % 2], means);
    }

    /// Takes a sample into the means.
    fn tone(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        settings: Tone,
        sample: &Target,
        means: &mut Means,
    ) {
        let settings = pass::uniform(device, &settings);
        let [before, after] = [&means.pairs[means.current], &means.pairs[1 - means.current]];
        let resources = [
            wgpu::BindingResource::TextureView(&sample.view),
            wgpu::BindingResource::TextureView(&before[0].view),
            wgpu::BindingResource::TextureView(&before[1].view),
            settings.as_entire_binding(),
        ];
        let group = pass::bind_group(device, &self.tone_layout, &resources);
        pass::run(encoder, &self.tone, &[&group], &[&after[0].view, &after[1].view]);
        means.current = 1 - means.current;
    }

    fn scene_group(&self, device: &wgpu::Device, gbuffer: &GBuffer, mix: &Mix) -> wgpu::BindGroup {
        let reflectances = pass::storage(device, &mix.reflectances);
        let emitters = pass::storage(device, &mix.emitters);
        let vertices = pass::storage(device, &mix.emitter_vertices);
        let resources = [
            wgpu::BindingResource::TextureView(&gbuffer.positions.view),
            wgpu::BindingResource::TextureView(&gbuffer.normals.view),
            reflectances.as_entire_binding(),
            emitters.as_entire_binding(),
            vertices.as_entire_binding(),
            gbuffer.surfaces().as_entire_binding(),
        ];
        pass::bind_group(device, &self.scene_layout, &resources)
    }

    fn batch_group(
        &self,
        device: &wgpu::Device,
        (uniform, reached): (&Composite, &wgpu::Buffer),
        sample: &Sample,
        lights: &[Mixed],
        before: &Target,
    ) -> wgpu::BindGroup {
        let uniform = pass::uniform(device, uniform);
        let mut resources = vec![uniform.as_entire_binding(), wgpu::BindingResource::TextureView(&before.view)];
        let layers = lights.iter().map(|mixed| sample.layer(&mixed.lit.light));
        let shadows = lights.iter().map(|mixed| sample.shadow(mixed.lit.shadow.as_ref()?));
        let filled = |targets: &mut dyn Iterator<Item = Option<&Target>>| -> [wgpu::TextureView; BATCH] {
            std::array::from_fn(|_| targets.next().flatten().unwrap_or(&self.no_layer).view.clone())
        };
        let views = [filled(&mut layers.into_iter()), filled(&mut shadows.into_iter())];
        resources.extend(views.as_flattened().iter().map(wgpu::BindingResource::TextureView));
        resources.push(reached.as_entire_binding());
        pass::bind_group(device, &self.batch_layout, &resources)
    }
}
