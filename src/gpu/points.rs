//! A light's layer at points that no camera sees, to hold other shaders against it.

use glam::{DVec3, Vec3};

use super::context::Context;
use super::layers::{self, LayerPass};
use super::lights::LightData;
use super::lobes;
use super::pass::{self, Target};
use super::read_back::{self, ReadBackError};
use super::types::u32_of;
use crate::light::Emitter;
use crate::shading::{Lobe, Method};

/// The layer of a light, with the eye at the world's origin, at points with their unit normals: irradiance and specular
/// response at unit strength.
///
/// # Errors
///
/// [`ReadBackError`] where the device was lost.
pub fn layer_at(
    context: &Context,
    (emitter, method): (&Emitter, Method),
    lobe: &Lobe,
    points: &[(Vec3, Vec3)],
) -> Result<Vec<[f32; 2]>, ReadBackError> {
    let Context { device, queue, .. } = context;
    let size = [u32_of(points.len()), 1];
    let mut passes = LayerPass::new(device);
    let target = Target::new(device, size, layers::FORMAT);
    let positions = row(context, points.iter().map(|(p, _)| p.extend(1.0).to_array()).collect());
    let normals = row(context, points.iter().map(|(_, n)| n.extend(0.0).to_array()).collect());
    let lobes = pass::storage(device, &[lobes::lobe(lobe, method)]);
    let seen = [
        wgpu::BindingResource::TextureView(&positions),
        wgpu::BindingResource::TextureView(&normals),
        lobes.as_entire_binding(),
    ];
    let group = pass::bind_group(device, &passes.gbuffer_layout, &seen);
    let light = LightData::new(emitter, method, DVec3::ZERO);
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let last = light.stages() - 1;
    passes.draw(device, &mut encoder, &group, (&light, false), last, (&target, [0, 0, size[0], size[1]]));
    queue.submit([encoder.finish()]);
    read_back::texture(device, queue, &target.texture)
}

/// A texture of one row.
fn row(context: &Context, texels: Vec<[f32; 4]>) -> wgpu::TextureView {
    use wgpu::util::DeviceExt as _;
    let texture = context.device.create_texture_with_data(
        &context.queue,
        &wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: u32_of(texels.len()), height: 1, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::default(),
        bytemuck::cast_slice(&texels),
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
