//! The last layer: the picture, from the means over samples.

use super::composite::Means;
use super::gbuffer::GBuffer;
use super::pass::{self, Binding, Target};
use super::shader::{Module, Source};
use super::types::{Shown, f32_of, u32_of};
use super::view::{Display, View};
use crate::render::false_colour::{self, NOTHING, Scale};

/// sRGB-encoded already, which is what egui shows.
const PICTURE: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
// Modes in `display.wgsl`; a picture is 0.
const SPLIT: u32 = 1;
const DIFFERENCE: u32 = 2;
const ILLUMINANCE: u32 = 3;
const BANDS: u32 = 4;
/// Entries of a continuous map of colours.
const CELLS: u16 = 256;

impl Shown {
    /// What a view shows, as the shader reads it.
    pub(crate) fn new(view: &View) -> Self {
        match view.display {
            Display::Picture => Self::default(),
            Display::Split { at, .. } => {
                Self { mode: SPLIT, split: f32_of(at * f64::from(view.size[0])), ..Self::default() }
            }
            Display::Difference { relative, end, .. } => {
                Self { mode: DIFFERENCE, option: u32::from(relative), end: f32_of(end), ..Self::default() }
            }
            Display::Illuminance { scale, isolines } => Self::illuminance(&scale, isolines),
            Display::Bands { illuminance, .. } => {
                Self { mode: BANDS, option: u32::from(illuminance), ..Self::default() }
            }
        }
    }

    fn illuminance(scale: &Scale, isolines: bool) -> Self {
        let levels = if isolines { scale.levels() } else { Vec::new() };
        let mut shown =
            Self { mode: ILLUMINANCE, option: u32::from(scale.logarithmic), end: f32_of(scale.end), ..Self::default() };
        let slots = shown.levels.as_flattened_mut();
        shown.level_count = u32_of(levels.len().min(slots.len()));
        for (slot, level) in slots.iter_mut().zip(levels) {
            *slot = f32_of(level);
        }
        shown
    }
}

/// What shows means.
#[derive(Debug)]
pub(crate) struct DisplayPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    colors: wgpu::Buffer,
}

impl DisplayPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        let layout = pass::bind_group_layout(
            device,
            &[&[Binding::Texture; 6][..], &[Binding::Uniform, Binding::Storage, Binding::Storage]].concat(),
        );
        Self {
            pipeline: pass::pipeline(device, &Self::source(), "display", &[&layout], &[PICTURE]),
            layout,
            colors: pass::storage(device, &colors()),
        }
    }

    /// The pass's shader.
    pub(crate) fn source() -> Source {
        Source::join(&[Module::FULLSCREEN, Module::DISPLAY])
    }

    /// Where pictures are drawn.
    pub(crate) fn target(device: &wgpu::Device, size: [u32; 2]) -> Target {
        Target::new(device, size, PICTURE)
    }

    /// Draws the picture of the means by the view's method, and by the other one, if there is one.
    pub(crate) fn draw(
        &self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        gbuffer: &GBuffer,
        [means, other]: [&Means; 2],
        shown: &Shown,
        picture: &Target,
    ) {
        let shown = pass::uniform(device, shown);
        let textures = [
            means.radiance(),
            means.display(),
            other.radiance(),
            other.display(),
            &gbuffer.positions,
            &gbuffer.normals,
        ];
        let mut resources: Vec<_> =
            textures.iter().map(|target| wgpu::BindingResource::TextureView(&target.view)).collect();
        let buffers = [&shown, &self.colors, gbuffer.surfaces()];
        resources.extend(buffers.map(wgpu::Buffer::as_entire_binding));
        let group = pass::bind_group(device, &self.layout, &resources);
        pass::run(encoder, &self.pipeline, &[&group], &[&picture.view]);
    }
}

/// The table of colours in `display.wgsl`.
fn colors() -> Vec<[f32; 4]> {
    let share = |cell: u16| f64::from(cell) / f64::from(CELLS - 1);
    let sequential = (0..CELLS).map(|cell| false_colour::sequential(share(cell)));
    let diverging = (0..CELLS).map(|cell| false_colour::diverging(2.0 * share(cell) - 1.0));
    let colors = sequential.chain(diverging).chain(false_colour::bands()).chain([NOTHING]);
    colors.map(|[r, g, b]| [r, g, b, u8::MAX].map(|channel| f32::from(channel) / f32::from(u8::MAX))).collect()
}
