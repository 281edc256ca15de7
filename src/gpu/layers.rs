//! Light layers: what each light does at unit strength, at every pixel of a G-buffer.

use std::collections::HashMap;

use super::gbuffer::{GBuffer, GBufferPass, Seen};
use super::lights::{LightData, Responder};
use super::pass::{self, Binding, Target};
use super::table::Tables;
use super::types::Lobe;
use super::view::Stats;

/// Irradiance and specular response.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;

/// What makes layers: one pipeline a light shape and method, and one for matte scenes, made when first needed.
#[derive(Debug)]
pub(crate) struct LayerPass {
    gbuffer_layout: wgpu::BindGroupLayout,
    light_layout: wgpu::BindGroupLayout,
    pipelines: HashMap<(Responder, bool), wgpu::RenderPipeline>,
    other_pipelines: HashMap<Responder, wgpu::RenderPipeline>,
    tables: Tables,
}

impl LayerPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        Self {
            gbuffer_layout: pass::bind_group_layout(device, &[Binding::Texture, Binding::Texture, Binding::Storage]),
            light_layout: pass::bind_group_layout(device, &[Binding::Uniform, Binding::Storage, Binding::Storage]),
            pipelines: HashMap::new(),
            other_pipelines: HashMap::new(),
            tables: Tables::default(),
        }
    }

    fn draw(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        gbuffer: &wgpu::BindGroup,
        (light, matte): (&LightData, bool),
        stage: usize,
        (target, part): (&Target, [u32; 4]),
    ) {
        let layouts = [&self.gbuffer_layout, &self.light_layout];
        let pipeline = self
            .pipelines
            .entry((light.responder, matte))
            .or_insert_with(|| pass::pipeline(device, &light.responder.source(matte), "layer", &layouts, &[FORMAT]));
        let group = light_group(device, &self.light_layout, &mut self.tables, (light, stage));
        let targets = [&target.view];
        pass::run_over(encoder, pipeline, &[gbuffer, &group], &targets, wgpu::LoadOp::Load, Some(part));
        let Some(others) = &light.other_lobes else { return };
        // Their specular response takes the place of the closed form's.
        let specular = wgpu::ColorTargetState { write_mask: wgpu::ColorWrites::GREEN, ..FORMAT.into() };
        let pipeline = self.other_pipelines.entry(others.responder).or_insert_with(|| {
            pass::pipeline_writing(
                device,
                &others.responder.source(false),
                "layer_of_other_lobes",
                &layouts,
                &[specular],
            )
        });
        let group = light_group(device, &self.light_layout, &mut self.tables, (others, 0));
        pass::run_over(encoder, pipeline, &[gbuffer, &group], &targets, wgpu::LoadOp::Load, Some(part));
    }
}

/// A light as its layer's shader reads it.
fn light_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    tables: &mut Tables,
    (light, stage): (&LightData, usize),
) -> wgpu::BindGroup {
    let uniform = pass::buffer(device, &light.uniform_at(stage), wgpu::BufferUsages::UNIFORM);
    let vertices = pass::storage(device, &light.vertices);
    let table = tables.buffer(device, &light.table);
    pass::bind_group(
        device,
        layout,
        &[uniform.as_entire_binding(), vertices.as_entire_binding(), table.as_entire_binding()],
    )
}

/// One sample a pixel: a G-buffer and the layers on it, each kept for as long as what it depends on stays the same.
#[derive(Debug, Default)]
pub(crate) struct Sample {
    gbuffer: Option<GBuffer>,
    lobes: Vec<Lobe>,
    matte: bool,
    /// The G-buffer and the lobes, as the layer shaders read them.
    group: Option<wgpu::BindGroup>,
    layers: Vec<Layer>,
}

/// What a light does at every pixel.
#[derive(Debug)]
struct Layer {
    light: LightData,
    /// Stages that it has been through.
    stages: usize,
    /// Rows that the next stage has been through.
    rows: u32,
    target: Target,
}

impl Sample {
    /// The G-buffer; none before the first [`Self::update`].
    pub(crate) fn gbuffer(&self) -> Option<&GBuffer> {
        self.gbuffer.as_ref()
    }

    /// The layer of a light; none where it was not asked for.
    pub(crate) fn layer(&self, light: &LightData) -> Option<&Target> {
        self.layers.iter().find(|layer| layer.light == *light).map(|layer| &layer.target)
    }

    /// Whether every layer that is made has been through all its stages.
    pub(crate) fn is_refined(&self, lit: &[LightData]) -> bool {
        lit.iter().all(|light| self.layers.iter().any(|layer| layer.light == *light && layer.stages == light.stages()))
    }

    /// Redoes what changed, takes layers on by a stage, and answers whether anything was done.
    ///
    /// Layers belong to light data, not to places in the list: deleting, inserting and reordering lights keep them.
    /// Those of `dark` lights are kept but not made.
    pub(crate) fn update(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        passes: (&GBufferPass, &mut LayerPass),
        wanted: &Wanted,
        stats: &mut Stats,
    ) -> bool {
        let (gbuffer_pass, layer_pass) = passes;
        let seen_before = self.gbuffer.as_ref().is_some_and(|gbuffer| gbuffer.shows(&wanted.seen));
        if !seen_before {
            let same_size = self.gbuffer.as_ref().is_some_and(|gbuffer| gbuffer.size() == wanted.seen.size());
            if !same_size {
                self.layers.clear();
            }
            self.gbuffer = Some(gbuffer_pass.draw(device, encoder, wanted.seen.clone(), self.gbuffer.take()));
            stats.g_buffers += 1;
        }
        let lobes_before = self.lobes == wanted.lobes && self.matte == wanted.matte;
        let Some(gbuffer) = &self.gbuffer else { return false };
        let fresh = !(seen_before && lobes_before);
        if fresh || self.group.is_none() {
            self.lobes.clone_from(&wanted.lobes);
            self.matte = wanted.matte;
            let lobes = pass::storage(device, &self.lobes);
            let resources = [
                wgpu::BindingResource::TextureView(&gbuffer.positions.view),
                wgpu::BindingResource::TextureView(&gbuffer.normals.view),
                lobes.as_entire_binding(),
            ];
            self.group = Some(pass::bind_group(device, &layer_pass.gbuffer_layout, &resources));
        }
        let Some(group) = &self.group else { return false };

        let known = |data: &LightData| wanted.lit.contains(data) || wanted.dark.contains(data);
        let (kept, spare): (Vec<_>, Vec<_>) = self.layers.drain(..).partition(|layer| !fresh && known(&layer.light));
        self.layers = kept;
        let mut spare = spare.into_iter().map(|layer| layer.target);
        let mut changed = fresh;
        let [width, height] = wanted.seen.size();
        let mut band_done = false;
        for light in &wanted.lit {
            let place = self.layers.iter().position(|layer| layer.light == *light).unwrap_or_else(|| {
                let target = spare.next().unwrap_or_else(|| Target::new(device, wanted.seen.size(), FORMAT));
                let stages = if wanted.by_stages { 0 } else { light.stages() - 1 };
                self.layers.push(Layer { light: light.clone(), stages, rows: 0, target });
                self.layers.len() - 1
            });
            let layer = &mut self.layers[place];
            // A first look is whole; what only refines it is done a band a call.
            let at_once = wanted.bands == 1 || (wanted.by_stages && layer.stages == 0);
            if layer.stages == light.stages() || (band_done && !at_once) {
                continue;
            }
            let rows = if at_once { height } else { height.div_ceil(wanted.bands) }.min(height - layer.rows);
            let part = [0, layer.rows, width, rows];
            layer_pass.draw(device, encoder, group, (light, self.matte), layer.stages, (&layer.target, part));
            layer.rows += rows;
            band_done |= !at_once;
            changed = true;
            if layer.rows == height {
                layer.rows = 0;
                layer.stages += 1;
                stats.layers += 1;
            }
        }
        changed
    }
}

/// What a [`Sample`] is to hold.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// What the camera sees.
    pub(crate) seen: Seen,
    /// The materials' lobes.
    pub(crate) lobes: Vec<Lobe>,
    /// No material has a specular part: the layers' need not be made.
    pub(crate) matte: bool,
    /// One stage of each layer an update, rather than the last at once.
    pub(crate) by_stages: bool,
    /// Bands that a layer's refinement is cut into, one an update; 1 does all layers at once.
    pub(crate) bands: u32,
    /// Lights that contribute.
    pub(crate) lit: Vec<LightData>,
    /// Lights that do not, for now.
    pub(crate) dark: Vec<LightData>,
}
