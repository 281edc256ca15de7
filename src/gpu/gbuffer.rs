//! The first layer: what the camera sees.

use std::sync::Arc;

use super::occluders::{self, Occluders};
use super::pass::{self, Binding, Target};
use super::shader::{Module, Source};
use super::types::{Camera, f32_of, vec3_of};
use super::view::View;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// All that the G-buffer depends on. Equal data give equal G-buffers.
#[derive(Clone, Debug)]
pub(crate) struct Seen {
    camera: Camera,
    occluders: Arc<Occluders>,
    size: [u32; 2],
}

impl PartialEq for Seen {
    fn eq(&self, other: &Self) -> bool {
        self.camera == other.camera && self.size == other.size && Arc::ptr_eq(&self.occluders, &other.occluders)
    }
}

impl Seen {
    /// The surfaces through the view's camera; `jitter` moves the sample off the pixels' centres, in pixels.
    pub(crate) fn new(occluders: &Arc<Occluders>, view: &View, jitter: [f32; 2]) -> Self {
        let [right, up, back] = view.camera.axes();
        let camera = Camera {
            right: vec3_of(right),
            tan_half: f32_of((0.5 * view.camera.fov_deg.to_radians()).tan()),
            up: vec3_of(up),
            width: f32_of(f64::from(view.size[0])),
            back: vec3_of(back),
            height: f32_of(f64::from(view.size[1])),
            jitter,
            unused: [0; 2],
        };
        Self { camera, occluders: Arc::clone(occluders), size: view.size }
    }

    /// The picture's size in pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }

    /// What rays meet.
    pub(crate) fn occluders(&self) -> &Arc<Occluders> {
        &self.occluders
    }
}

/// Position and normal at every pixel.
#[derive(Debug)]
pub(crate) struct GBuffer {
    /// About the eye; w is the item's number in `primitives.wgsl` + 1, 0 where nothing is seen.
    pub(crate) positions: Target,
    /// Towards the eye; w is the material's number.
    pub(crate) normals: Target,
    seen: Seen,
}

impl GBuffer {
    /// Whether it shows just this.
    pub(crate) fn shows(&self, seen: &Seen) -> bool {
        self.seen == *seen
    }

    /// Of each item that may be seen, its surface.
    pub(crate) fn surfaces(&self) -> &wgpu::Buffer {
        self.seen.occluders.surfaces()
    }

    /// Its size in pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.seen.size
    }
}

/// What makes G-buffers.
#[derive(Debug)]
pub(crate) struct GBufferPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    /// Group 1, which the pass has no use for.
    nothing: wgpu::BindGroup,
    occluder_layout: wgpu::BindGroupLayout,
}

impl GBufferPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let layout = pass::bind_group_layout(device, &[Binding::Uniform]);
        let none = pass::bind_group_layout(device, &[]);
        let occluder_layout = pass::bind_group_layout(device, &occluders::BINDINGS);
        let layouts = [&layout, &none, &occluder_layout];
        let pipeline = pass::pipeline(device, &Self::source(), "gbuffer", &layouts, &[FORMAT, FORMAT]);
        let nothing = pass::bind_group(device, &none, &[]);
        Self { pipeline, layout, nothing, occluder_layout }
    }

    /// The pass's shader.
    pub(crate) fn source() -> Source {
        Source::join(&[Module::FULLSCREEN, Module::PRIMITIVES, Module::GBUFFER])
    }

    /// The layout of [`Occluders::group`], which is the same in all passes.
    pub(crate) fn occluder_layout(&self) -> &wgpu::BindGroupLayout {
        &self.occluder_layout
    }

    /// Draws what is seen, in the textures of `old` where they have the size.
    pub(crate) fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        seen: Seen,
        old: Option<GBuffer>,
    ) -> GBuffer {
        let (positions, normals) = match old {
            Some(old) if old.seen.size == seen.size => (old.positions, old.normals),
            _ => (Target::new(device, seen.size, FORMAT), Target::new(device, seen.size, FORMAT)),
        };
        let camera = pass::uniform(device, &seen.camera);
        let group = pass::bind_group(device, &self.layout, &[camera.as_entire_binding()]);
        let groups = [&group, &self.nothing, seen.occluders.group()];
        pass::run(encoder, &self.pipeline, &groups, &[&positions.view, &normals.view]);
        GBuffer { positions, normals, seen }
    }
}
