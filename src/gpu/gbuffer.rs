//! The first layer: what the camera sees.

use super::pass::{self, Binding, Target};
use super::shader::{Module, Source};
use super::types::{Camera, Primitive, f32_of, u32_of, vec3_of, vec4_of};
use super::view::View;
use crate::scene::Scene;
use crate::surface::{Shape, Surface};
use glam::{DMat3, DVec3, Vec3};

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// All that the G-buffer depends on. Equal data give equal G-buffers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Seen {
    camera: Camera,
    primitives: Vec<Primitive>,
    size: [u32; 2],
}

impl Seen {
    /// The scene's surfaces through the view's camera; `jitter` moves the sample off the pixels' centres, in pixels.
    pub(crate) fn new(scene: &Scene, view: &View, jitter: [f32; 2]) -> Self {
        let primitives: Vec<_> = scene
            .surfaces
            .iter()
            .map(|surface| {
                let material = scene.materials.iter().position(|material| material.name == surface.material);
                primitive(surface, u32_of(material.unwrap_or(scene.materials.len())), view.camera.eye)
            })
            .collect();
        let [right, up, back] = view.camera.axes();
        let camera = Camera {
            right: vec3_of(right),
            tan_half: f32_of((0.5 * view.camera.fov_deg.to_radians()).tan()),
            up: vec3_of(up),
            width: f32_of(f64::from(view.size[0])),
            back: vec3_of(back),
            height: f32_of(f64::from(view.size[1])),
            jitter,
            primitive_count: u32_of(primitives.len()),
            unused: 0,
        };
        Self { camera, primitives, size: view.size }
    }

    /// The picture's size in pixels.
    pub(crate) fn size(&self) -> [u32; 2] {
        self.size
    }
}

/// A surface about the eye. The inverse is taken in f64: a far or flat surface costs no digits.
fn primitive(surface: &Surface, material: u32, eye: DVec3) -> Primitive {
    let world_from_local = surface.world_from_surface();
    let local_from_world = world_from_local.inverse();
    let (kind, size) = kind_and_size(&surface.shape);
    Primitive {
        local_from_world: columns(&local_from_world.matrix3),
        world_from_local: columns(&world_from_local.matrix3),
        eye_local: vec3_of(local_from_world.transform_point3(eye)),
        kind,
        origin: vec3_of(world_from_local.translation - eye),
        material,
        size,
        unused: 0,
    }
}

fn columns(matrix: &DMat3) -> [[f32; 4]; 3] {
    [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(|column| vec4_of(column, 0.0))
}

/// The shape's number in `gbuffer.wgsl`, and its half edges, or radius and half height.
fn kind_and_size(shape: &Shape) -> (u32, Vec3) {
    let (kind, size) = match *shape {
        Shape::Plane {} => (0, DVec3::ZERO),
        Shape::Sphere { radius } => (1, DVec3::splat(radius)),
        Shape::Box { size } => (2, 0.5 * size),
        Shape::Square { size } => (3, 0.5 * size.extend(0.0)),
        Shape::Disk { radius } => (4, DVec3::splat(radius)),
        Shape::Cylinder { radius, height } => (5, DVec3::new(radius, 0.5 * height, 0.0)),
        Shape::Cone { radius, height } => (6, DVec3::new(radius, 0.5 * height, 0.0)),
    };
    (kind, vec3_of(size))
}

/// Position and normal at every pixel.
#[derive(Debug)]
pub(crate) struct GBuffer {
    /// About the eye; w is the surface's number + 1, 0 where nothing is seen.
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
}

impl GBufferPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let layout = pass::bind_group_layout(device, &[Binding::Uniform, Binding::Storage]);
        let source = Self::source();
        let pipeline = pass::pipeline(device, &source, "gbuffer", &[&layout], &[FORMAT, FORMAT]);
        Self { pipeline, layout }
    }

    /// The pass's shader.
    pub(crate) fn source() -> Source {
        Source::join(&[Module::FULLSCREEN, Module::GBUFFER])
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
        let primitives = pass::storage(device, &seen.primitives);
        let resources = [camera.as_entire_binding(), primitives.as_entire_binding()];
        let group = pass::bind_group(device, &self.layout, &resources);
        pass::run(encoder, &self.pipeline, &[&group], &[&positions.view, &normals.view]);
        GBuffer { positions, normals, seen }
    }
}
