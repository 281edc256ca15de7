//! Pictures copied out of the device.

use super::composite::Means;
use super::pass::Target;

/// A picture in memory, rows from the top.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Width and height.
    pub size: [u32; 2],
    /// Linear radiance, cd/m², Rec. 709.
    pub radiance: Vec<[f32; 3]>,
    /// Illuminance, lx; none where no surface is seen.
    pub illuminance: Vec<Option<f32>>,
    /// What the view shows, sRGB-encoded, opaque.
    pub srgb: Vec<[u8; 4]>,
}

/// Why nothing came back.
#[derive(Debug, thiserror::Error)]
pub enum ReadBackError {
    /// The device was lost.
    #[error("the graphics device was lost")]
    Lost(#[source] wgpu::PollError),
    /// The buffer could not be mapped.
    #[error("the graphics device does not give its memory back")]
    Unmapped,
    /// There is no picture yet.
    #[error("there is no picture yet")]
    Nothing,
}

/// The means by the view's method, and the picture.
pub(crate) fn pixels(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    means: &Means,
    picture: &Target,
) -> Result<Pixels, ReadBackError> {
    let radiance: Vec<[f32; 4]> = texture(device, queue, &means.radiance().texture)?;
    let display: Vec<[f32; 4]> = texture(device, queue, &means.display().texture)?;
    let covered = display.iter().map(|texel| texel[3]);
    Ok(Pixels {
        size: [picture.texture.width(), picture.texture.height()],
        radiance: radiance.iter().map(|&[r, g, b, _]| [r, g, b]).collect(),
        illuminance: radiance.iter().zip(covered).map(|(texel, c)| (c > 0.0).then(|| texel[3] / c)).collect(),
        srgb: texture(device, queue, &picture.texture)?,
    })
}

/// All texels of a texture, each of type `T`.
pub(crate) fn texture<T: bytemuck::Pod>(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
) -> Result<Vec<T>, ReadBackError> {
    let row = texture.width() as usize * size_of::<T>();
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT as usize);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: padded_row as u64 * u64::from(texture.height()),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let layout =
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: u32::try_from(padded_row).ok(), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    let bytes = mapped(device, &buffer)?;
    let rows = bytes.chunks_exact(padded_row);
    Ok(rows.flat_map(|padded| bytemuck::pod_collect_to_vec::<u8, T>(&padded[..row])).collect())
}

/// The bytes of a buffer that can be mapped, once all work handed in is done.
pub(crate) fn mapped(device: &wgpu::Device, buffer: &wgpu::Buffer) -> Result<Vec<u8>, ReadBackError> {
    let slice = buffer.slice(..);
    slice.map_async(wgpu::MapMode::Read, |_| {});
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(ReadBackError::Lost)?;
    let Ok(range) = slice.get_mapped_range() else { return Err(ReadBackError::Unmapped) };
    Ok(range.to_vec())
}
