//! One sample a pixel: what is seen there, and what each light does there.

use super::gbuffer::{GBuffer, Seen};
use super::layers;
use super::lights::LightData;
use super::pass::{self, Target};
use super::passes::Passes;
use super::shadows::{self, Common, ShadowData};
use super::types::Lobe;
use super::view::Stats;

/// What a [`Sample`] is to hold.
#[derive(Clone, Debug)]
pub(crate) struct Wanted {
    /// What the camera sees.
    pub(crate) seen: Seen,
    /// The materials' lobes.
    pub(crate) lobes: Vec<Lobe>,
    /// No material has a specular part: the layers' need not be made.
    pub(crate) matte: bool,
    /// The sample's number. The first, 0, is through the pixels' centres, and made a stage an update.
    pub(crate) sample: u16,
    /// Updates that a stage of all layers and shadows is cut into.
    pub(crate) bands: u32,
    /// Lights that contribute.
    pub(crate) lit: Vec<Lit>,
    /// Lights that do not, for now.
    pub(crate) dark: Vec<Lit>,
}

/// A light, and its shadow where anything casts one.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Lit {
    pub(crate) light: LightData,
    pub(crate) shadow: Option<ShadowData>,
}

/// One sample a pixel: a G-buffer, and the layers and shadows on it, each kept for as long as what it depends on stays
/// the same.
#[derive(Debug, Default)]
pub(crate) struct Sample {
    gbuffer: Option<GBuffer>,
    lobes: Vec<Lobe>,
    matte: bool,
    /// The G-buffer and the lobes, as the shaders read them.
    group: Option<wgpu::BindGroup>,
    layers: Vec<Layer>,
    shadows: Vec<Shadow>,
    /// Targets that nothing is in.
    spare_layers: Vec<Target>,
    spare_shadows: Vec<Target>,
}

/// What a light does at every pixel.
#[derive(Debug)]
struct Layer {
    light: LightData,
    progress: Progress,
    target: Target,
}

/// The share of a light that is seen at every pixel.
#[derive(Debug)]
struct Shadow {
    data: ShadowData,
    progress: Progress,
    /// After the last stage that is done.
    sums: Target,
    /// Where the next one is made.
    next: Option<Target>,
}

/// How far something is.
#[derive(Clone, Copy, Debug, Default)]
struct Progress {
    /// Stages done, and all of them.
    stage: usize,
    stages: usize,
    /// Rows that the next stage has been through.
    rows: u32,
}

impl Progress {
    fn is_done(&self) -> bool {
        self.stage >= self.stages
    }

    /// Some rows more; whether that was the stage's last.
    fn advance(&mut self, rows: u32, height: u32) -> bool {
        self.rows += rows;
        let ends = self.rows >= height;
        if ends {
            *self = Self { stage: self.stage + 1, rows: 0, ..*self };
        }
        ends
    }
}

/// Something that is made in stages, by its place in the sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece {
    Layer(usize),
    Shadow(usize),
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

    /// The sums of a light's shadow; none where it was not asked for.
    pub(crate) fn shadow(&self, data: &ShadowData) -> Option<&Target> {
        self.shadows.iter().find(|shadow| shadow.data == *data).map(|shadow| &shadow.sums)
    }

    /// Whether every layer and shadow of these lights has been through its first stage.
    pub(crate) fn is_whole(&self, lit: &[Lit]) -> bool {
        self.have_all(lit, |progress| progress.stage > 0)
    }

    /// Whether every layer and shadow of these lights has been through all its stages.
    pub(crate) fn is_refined(&self, lit: &[Lit]) -> bool {
        self.have_all(lit, Progress::is_done)
    }

    fn have_all(&self, lit: &[Lit], are: impl Fn(&Progress) -> bool) -> bool {
        lit.iter().all(|lit| {
            let layer = self.layers.iter().find(|layer| layer.light == lit.light);
            let shadow = |data: &ShadowData| self.shadows.iter().find(|shadow| shadow.data == *data);
            layer.is_some_and(|layer| are(&layer.progress))
                && lit.shadow.as_ref().is_none_or(|data| shadow(data).is_some_and(|shadow| are(&shadow.progress)))
        })
    }

    /// Redoes what changed, takes layers and shadows on by a stage, and answers whether anything was done.
    ///
    /// They belong to light data, not to places in the list: deleting, inserting and reordering lights keep them. Those
    /// of `dark` lights are kept but not made.
    pub(crate) fn update(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        passes: &mut Passes,
        wanted: &Wanted,
        stats: &mut Stats,
    ) -> bool {
        let fresh = self.look(device, encoder, passes, wanted, stats);
        let pieces = self.pieces(device, wanted);
        let height = wanted.seen.size()[1];
        let mut left = (u32::try_from(pieces.len()).unwrap_or(u32::MAX).saturating_mul(height)).div_ceil(wanted.bands);
        // What only refines comes after the first look at everything.
        let (first, later): (Vec<_>, Vec<_>) =
            pieces.into_iter().partition(|piece| wanted.sample == 0 && self.progress(*piece).stage == 0);
        let pieces = if first.is_empty() { later } else { first };
        let mut changed = fresh;
        for piece in pieces.into_iter().filter(|piece| !self.progress(*piece).is_done()).collect::<Vec<_>>() {
            let rows = left.next_multiple_of(pass::BLOCK).min(height - self.progress(piece).rows);
            if rows > 0 {
                self.draw(device, encoder, passes, wanted, (piece, rows), stats);
                left = left.saturating_sub(rows);
                changed = true;
            }
        }
        changed
    }

    /// Redoes the G-buffer and drops what is out of date, if anything is; answers whether that was all of it.
    fn look(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        passes: &Passes,
        wanted: &Wanted,
        stats: &mut Stats,
    ) -> bool {
        let seen_before = self.gbuffer.as_ref().is_some_and(|gbuffer| gbuffer.shows(&wanted.seen));
        if !seen_before {
            let same_size = self.gbuffer.as_ref().is_some_and(|gbuffer| gbuffer.size() == wanted.seen.size());
            if !same_size {
                *self = Self::default();
            }
            self.gbuffer = Some(passes.gbuffer.draw(device, encoder, wanted.seen.clone(), self.gbuffer.take()));
            stats.g_buffers += 1;
        }
        let same_lobes = self.lobes == wanted.lobes && self.matte == wanted.matte;
        let same_shapes =
            self.matte == wanted.matte && self.lobes.iter().map(Lobe::shape).eq(wanted.lobes.iter().map(Lobe::shape));
        let fresh = !(seen_before && same_lobes);
        if fresh || self.group.is_none() {
            self.lobes.clone_from(&wanted.lobes);
            self.matte = wanted.matte;
            self.group = self.gbuffer.as_ref().map(|gbuffer| {
                let lobes = pass::storage(device, &self.lobes);
                let resources = [
                    wgpu::BindingResource::TextureView(&gbuffer.positions.view),
                    wgpu::BindingResource::TextureView(&gbuffer.normals.view),
                    lobes.as_entire_binding(),
                ];
                pass::bind_group(device, &passes.layers.gbuffer_layout, &resources)
            });
        }
        let known = || wanted.lit.iter().chain(&wanted.dark);
        for layer in self.layers.extract_if(.., |layer| fresh || !known().any(|lit| lit.light == layer.light)) {
            self.spare_layers.push(layer.target);
        }
        let fresh_shadows = !(seen_before && same_shapes);
        let is_known = |shadow: &Shadow| known().any(|lit| lit.shadow.as_ref() == Some(&shadow.data));
        for shadow in self.shadows.extract_if(.., |shadow| fresh_shadows || !is_known(shadow)) {
            self.spare_shadows.extend([Some(shadow.sums), shadow.next].into_iter().flatten());
        }
        fresh
    }

    /// The layers and shadows of the lights that contribute, those in work first, then those of the fewest stages.
    fn pieces(&mut self, device: &wgpu::Device, wanted: &Wanted) -> Vec<Piece> {
        let mut pieces = Vec::new();
        for Lit { light, shadow } in &wanted.lit {
            pieces.push(Piece::Layer(self.place_of_layer(device, wanted, light)));
            pieces.extend(shadow.as_ref().map(|data| Piece::Shadow(self.place_of_shadow(device, wanted, data))));
        }
        let mut found = Vec::new();
        pieces.retain(|piece| {
            !found.contains(piece) && {
                found.push(*piece);
                true
            }
        });
        pieces.sort_by_key(|piece| {
            let progress = self.progress(*piece);
            (progress.rows == 0, progress.stage)
        });
        pieces
    }

    fn place_of_layer(&mut self, device: &wgpu::Device, wanted: &Wanted, light: &LightData) -> usize {
        self.layers.iter().position(|layer| layer.light == *light).unwrap_or_else(|| {
            let stages = light.stages();
            let stage = if wanted.sample == 0 { 0 } else { stages - 1 };
            let target = self.spare_layers.pop();
            let target = target.unwrap_or_else(|| Target::new(device, wanted.seen.size(), layers::FORMAT));
            self.layers.push(Layer { light: light.clone(), progress: Progress { stage, stages, rows: 0 }, target });
            self.layers.len() - 1
        })
    }

    fn place_of_shadow(&mut self, device: &wgpu::Device, wanted: &Wanted, data: &ShadowData) -> usize {
        self.shadows.iter().position(|shadow| shadow.data == *data).unwrap_or_else(|| {
            let stages = data.stages(wanted.sample);
            let sums = self.spare_shadow(device, wanted.seen.size());
            self.shadows.push(Shadow {
                data: data.clone(),
                progress: Progress { stage: 0, stages, rows: 0 },
                sums,
                next: None,
            });
            self.shadows.len() - 1
        })
    }

    fn spare_shadow(&mut self, device: &wgpu::Device, size: [u32; 2]) -> Target {
        self.spare_shadows.pop().unwrap_or_else(|| Target::new(device, size, shadows::FORMAT))
    }

    fn progress(&self, piece: Piece) -> Progress {
        match piece {
            Piece::Layer(place) => self.layers[place].progress,
            Piece::Shadow(place) => self.shadows[place].progress,
        }
    }

    /// Takes a piece on by some rows.
    fn draw(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        passes: &mut Passes,
        wanted: &Wanted,
        (piece, rows): (Piece, u32),
        stats: &mut Stats,
    ) {
        let Some(group) = self.group.clone() else { return };
        let [width, height] = wanted.seen.size();
        let part = |progress: &Progress| [0, progress.rows, width, rows];
        match piece {
            Piece::Layer(place) => {
                let Layer { light, progress, target } = &mut self.layers[place];
                let of_stage = (target as &Target, part(progress));
                passes.layers.draw(device, encoder, &group, (light, self.matte), progress.stage, of_stage);
                stats.layers += u64::from(progress.advance(rows, height));
            }
            Piece::Shadow(place) => {
                let common = Common {
                    gbuffer: (&passes.layers.gbuffer_layout, &group),
                    occluders: (passes.gbuffer.occluder_layout(), wanted.seen.occluders().group()),
                    matte: self.matte,
                    sample: wanted.sample,
                };
                let next = self.shadows[place].next.take();
                let next = next.unwrap_or_else(|| {
                    let spare = self.spare_shadows.pop();
                    spare.unwrap_or_else(|| Target::new(device, wanted.seen.size(), shadows::FORMAT))
                });
                let Shadow { data, progress, sums, .. } = &mut self.shadows[place];
                let of_stage = (data as &ShadowData, progress.stage);
                passes.shadows.draw(device, encoder, common, of_stage, [sums, &next], part(progress));
                if progress.advance(rows, height) {
                    stats.shadows += 1;
                    self.spare_shadows.push(std::mem::replace(sums, next));
                } else {
                    self.shadows[place].next = Some(next);
                }
            }
        }
    }
}
