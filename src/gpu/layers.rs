//! Light layers: what each light does at unit strength, at every pixel of a G-buffer.

use std::collections::HashMap;

use super::lights::{LightData, Responder};
use super::pass::{self, Binding, Target};
use super::tables::Tables;

/// Irradiance and specular response.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;

/// What makes layers: one pipeline a light shape and method, and one for matte scenes, made when first needed.
#[derive(Debug)]
pub(crate) struct LayerPass {
    pub(super) gbuffer_layout: wgpu::BindGroupLayout,
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

    /// Draws a part of a stage of a light's layer.
    pub(crate) fn draw(
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
