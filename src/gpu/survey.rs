//! What a picture's numbers are, by and large: for scales and exposure that fit by themselves.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use super::composite::Means;
use super::pass::{self, Binding, Target};
use super::shader::{Module, Source};

/// Pixels of a survey along each side, as in `survey.wgsl`. A row of them is a multiple of what copies are aligned to.
const PLACES: [u32; 2] = [96, 64];
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
/// Bytes of a row.
const ROW: u32 = PLACES[0] * 16;

/// Numbers of some pixels, in a grid spread evenly over a picture; those that show no surface have none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Survey {
    places: Vec<[f32; 4]>,
}

impl Survey {
    /// Columns and rows of the grid.
    pub const SIDES: [usize; 2] = [PLACES[0] as usize, PLACES[1] as usize];

    /// Luminances by the view's method, cd/m².
    pub fn luminances(&self) -> impl Iterator<Item = f64> {
        self.seen().map(|place| f64::from(place[0]))
    }

    /// Illuminances by the view's method, lx.
    pub fn illuminances(&self) -> impl Iterator<Item = f64> {
        self.seen().map(|place| f64::from(place[1]))
    }

    /// Luminances by the view's method and by the other one, cd/m²; the same where there is none.
    pub fn compared_luminances(&self) -> impl Iterator<Item = [f64; 2]> {
        self.seen().map(|place| [place[0], place[2]].map(f64::from))
    }

    /// Illuminances by the view's method and by the other one, lx; the same where there is none.
    pub fn compared_illuminances(&self) -> impl Iterator<Item = [f64; 2]> {
        self.seen().map(|place| [place[1], place[3]].map(f64::from))
    }

    /// Illuminance by the view's method at a place of the grid, lx; none off the grid, or where no surface is seen.
    pub fn illuminance(&self, column: usize, row: usize) -> Option<f64> {
        let index = (column < Self::SIDES[0]).then_some(row * Self::SIDES[0] + column)?;
        self.places.get(index).filter(|place| is_surface(place)).map(|place| f64::from(place[1]))
    }

    fn seen(&self) -> impl Iterator<Item = &[f32; 4]> {
        self.places.iter().filter(|place| is_surface(place))
    }
}

fn is_surface(place: &[f32; 4]) -> bool {
    place[0] >= 0.0
}

/// The value that a share of `values` lie below; none of no values.
pub fn quantile(values: impl Iterator<Item = f64>, share: f64) -> Option<f64> {
    let mut values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    let last = values.len().checked_sub(1)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a place in a short list")]
    let place = (share.clamp(0.0, 1.0) * last as f64).round() as usize;
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// What surveys pictures.
#[derive(Debug)]
pub(crate) struct SurveyPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    target: Target,
}

impl SurveyPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let layout = pass::bind_group_layout(device, &[Binding::Texture; 3]);
        Self {
            pipeline: pass::pipeline(device, &Self::source(), "survey", &[&layout], &[FORMAT]),
            layout,
            target: Target::new(device, PLACES, FORMAT),
        }
    }

    /// The pass's shader.
    pub(crate) fn source() -> Source {
        Source::join(&[Module::FULLSCREEN, Module::SURVEY])
    }

    /// Starts the survey of a picture.
    pub(crate) fn start(&self, device: &wgpu::Device, queue: &wgpu::Queue, [means, other]: [&Means; 2]) -> Pending {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(ROW * PLACES[1]),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let textures = [means.radiance(), means.display(), other.radiance()];
        let resources = textures.map(|target| wgpu::BindingResource::TextureView(&target.view));
        let group = pass::bind_group(device, &self.layout, &resources);
        pass::run(&mut encoder, &self.pipeline, &[&group], &[&self.target.view]);
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(ROW), rows_per_image: None };
        encoder.copy_texture_to_buffer(
            self.target.texture.as_image_copy(),
            wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
            self.target.texture.size(),
        );
        queue.submit([encoder.finish()]);
        let ready = Arc::new(AtomicBool::new(false));
        let theirs = Arc::clone(&ready);
        buffer.slice(..).map_async(wgpu::MapMode::Read, move |_| theirs.store(true, Ordering::Release));
        Pending { buffer, ready }
    }
}

/// A survey under way: it is ready after the device has been polled.
#[derive(Debug)]
pub(crate) struct Pending {
    buffer: wgpu::Buffer,
    ready: Arc<AtomicBool>,
}

impl Pending {
    pub(crate) fn is_ready(&self) -> bool {
        self.ready.load(Ordering::Acquire)
    }

    /// What was found; nothing where the device was lost.
    pub(crate) fn survey(&self) -> Survey {
        let Ok(range) = self.buffer.slice(..).get_mapped_range() else { return Survey::default() };
        Survey { places: bytemuck::pod_collect_to_vec(&range) }
    }
}

#[cfg(test)]
impl Survey {
    /// A survey of nothing but illuminance, lx, by column and row.
    pub(crate) fn of_illuminance(lux: impl Fn(usize, usize) -> Option<f64>) -> Self {
        let [columns, rows] = Self::SIDES;
        let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
        #[expect(clippy::cast_possible_truncation, reason = "as on the GPU")]
        let place = |(column, row)| lux(column, row).map_or([-1.0; 4], |lux| [0.0, lux as f32, 0.0, 0.0]);
        Self { places: cells.map(place).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quantile_is_one_of_the_values() {
        let values = || (0..=100).rev().map(f64::from);
        assert_eq!(quantile(values(), 0.99), Some(99.0), "99 of a hundred");
        assert_eq!([0.0, 1.0].map(|share| quantile(values(), share)), [Some(0.0), Some(100.0)], "the ends");
        assert_eq!(quantile([f64::NAN, 3.0].into_iter(), 0.5), Some(3.0), "numbers only");
        assert_eq!(quantile(std::iter::empty(), 0.5), None, "of nothing");
    }
}
