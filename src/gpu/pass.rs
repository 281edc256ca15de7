//! Full-screen passes, and what they read and write.

use wgpu::util::DeviceExt as _;

use super::shader::Source;
use super::types::f32_of;

/// A texture that one pass writes and another reads.
#[derive(Clone, Debug)]
pub(crate) struct Target {
    /// Written by a pass, or copied out.
    pub(crate) texture: wgpu::Texture,
    /// All of it.
    pub(crate) view: wgpu::TextureView,
}

impl Target {
    /// A texture of `size` pixels.
    pub(crate) fn new(device: &wgpu::Device, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture = device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                | wgpu::TextureUsages::TEXTURE_BINDING
                | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        Self { texture, view }
    }
}

/// What kind of thing a binding is.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Binding {
    /// `var<uniform>`.
    Uniform,
    /// `var<storage, read>`.
    Storage,
    /// `texture_2d<f32>`, read with `textureLoad`.
    Texture,
}

/// A bind group layout for fragment and compute shaders; binding i is `bindings[i]`.
pub(crate) fn bind_group_layout(device: &wgpu::Device, bindings: &[Binding]) -> wgpu::BindGroupLayout {
    let buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let entries: Vec<_> = (0..)
        .zip(bindings)
        .map(|(binding, kind)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
            ty: match kind {
                Binding::Uniform => buffer(wgpu::BufferBindingType::Uniform),
                Binding::Storage => buffer(wgpu::BufferBindingType::Storage { read_only: true }),
                Binding::Texture => wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
            },
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
}

/// A bind group; binding i is `resources[i]`.
pub(crate) fn bind_group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// A buffer that shaders read.
pub(crate) fn buffer(device: &wgpu::Device, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
}

/// A storage buffer of `items`; one zero item where there is none, because a binding may not be empty.
pub(crate) fn storage<T: bytemuck::Pod>(device: &wgpu::Device, items: &[T]) -> wgpu::Buffer {
    let none = [T::zeroed()];
    let items = if items.is_empty() { &none } else { items };
    buffer(device, bytemuck::cast_slice(items), wgpu::BufferUsages::STORAGE)
}

/// A uniform buffer.
pub(crate) fn uniform<T: bytemuck::Pod>(device: &wgpu::Device, value: &T) -> wgpu::Buffer {
    buffer(device, bytemuck::bytes_of(value), wgpu::BufferUsages::UNIFORM)
}

/// A pipeline that runs `entry` on every pixel of its targets.
pub(crate) fn pipeline(
    device: &wgpu::Device,
    source: &Source,
    entry: &str,
    layouts: &[&wgpu::BindGroupLayout],
    formats: &[wgpu::TextureFormat],
) -> wgpu::RenderPipeline {
    let targets: Vec<_> = formats.iter().map(|format| (*format).into()).collect();
    pipeline_writing(device, source, entry, layouts, &targets)
}

/// A pipeline that runs `entry` on every pixel of its targets, and writes of them what they say.
pub(crate) fn pipeline_writing(
    device: &wgpu::Device,
    source: &Source,
    entry: &str,
    layouts: &[&wgpu::BindGroupLayout],
    targets: &[wgpu::ColorTargetState],
) -> wgpu::RenderPipeline {
    let module = source.compile(device, entry);
    let layouts: Vec<_> = layouts.iter().copied().map(Some).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(entry),
        bind_group_layouts: &layouts,
        immediate_size: 0,
    });
    let targets: Vec<_> = targets.iter().cloned().map(Some).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("fullscreen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some(entry),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// Runs a pipeline on every pixel of `targets`, which it fills.
pub(crate) fn run(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::RenderPipeline,
    groups: &[&wgpu::BindGroup],
    targets: &[&wgpu::TextureView],
) {
    run_over(encoder, pipeline, groups, targets, wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), None);
}

/// Viewports of this size are allowed on every device.
const LARGEST_VIEWPORT: u32 = 8192;
/// How much larger than twice the picture a viewport is, so that its triangle's long side stays clear of the picture.
const MARGIN: u32 = 128;
/// Passes over a part of the rows begin at a multiple of this.
pub(crate) const BLOCK: u32 = 4;

/// Runs a pipeline on `targets`, which hold what `load` says before: on the part `[x, y, width, height]`, or on every
/// pixel.
pub(crate) fn run_over(
    encoder: &mut wgpu::CommandEncoder,
    pipeline: &wgpu::RenderPipeline,
    groups: &[&wgpu::BindGroup],
    targets: &[&wgpu::TextureView],
    load: wgpu::LoadOp<wgpu::Color>,
    part: Option<[u32; 4]>,
) {
    let attachments: Vec<_> = targets
        .iter()
        .map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })
        })
        .collect();
    let mut pass = encoder
        .begin_render_pass(&wgpu::RenderPassDescriptor { color_attachments: &attachments, ..Default::default() });
    pass.set_pipeline(pipeline);
    if let Some([x, y, width, height]) = part {
        pass.set_scissor_rect(x, y, width, height);
    }
    for (index, group) in (0..).zip(groups) {
        pass.set_bind_group(index, *group, &[]);
    }
    // No edge of the triangle crosses the picture, not even where a driver clips it: at blocks of pixels that are only partly
    // inside of a triangle, Mesa's llvmpipe ends nested loops too early.
    let size = targets.first().map_or([0, 0], |view| [view.texture().width(), view.texture().height()]);
    let [width, height] = size.map(|side| side.saturating_mul(2).saturating_add(MARGIN));
    if width.max(height) <= LARGEST_VIEWPORT {
        pass.set_viewport(0.0, 0.0, f32_of(width.into()), f32_of(height.into()), 0.0, 1.0);
        pass.draw(0..3, 0..1);
    } else {
        pass.draw(3..6, 0..1);
    }
}
