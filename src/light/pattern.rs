//! The pattern of a textured light: its image, and the file that it comes from.

pub mod code;
pub mod pack;
pub mod paint;
mod spread;

pub use spread::Span;

use std::fmt;
use std::sync::{Arc, OnceLock};

use glam::DVec3;

use self::code::single;
use self::spread::{Fluxes, Spread};
use crate::contents::Contents;
use crate::math::interpolation::{Grid, even_weights};

/// One channel of a pattern: luminance of each texel as a share of the light's, row by row, constant over a texel.
///
/// Values are finite and not negative. They are kept as images give them, in single precision.
#[derive(Clone)]
pub struct Channel {
    width: u32,
    height: u32,
    texels: Vec<f32>,
    mean: f64,
    /// Computed when first asked for.
    spread: OnceLock<Spread>,
    /// As `spread`.
    fluxes: OnceLock<Fluxes>,
}

impl fmt::Debug for Channel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Channel({} x {})", self.width, self.height)
    }
}

/// The image of a pattern.
#[derive(Clone, Debug)]
pub enum Image {
    /// The same for red, green and blue.
    Grey(Arc<Channel>),
    /// Red, green and blue, linear Rec. 709.
    Color([Arc<Channel>; 3]),
}

/// A pattern: a file's name as the scene file gives it, and the image in it. Copies share both.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// Relative to the scene file, and below its folder.
    pub file: String,
    /// What the file shows.
    pub image: Image,
    /// What the file holds, to be saved beside another scene; empty for an image that came from no file.
    pub contents: Contents,
}

impl PartialEq for Channel {
    /// Texel by texel, but for copies that share them.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other) || (self.width == other.width && self.texels == other.texels)
    }
}

impl Channel {
    /// The channel of those texels, `width` a row; `None` where they do not fill rows, or one is negative or not finite.
    pub fn new(width: usize, texels: Vec<f32>) -> Option<Self> {
        let height = texels.len().checked_div(width)?;
        let right = height > 0 && height * width == texels.len();
        let sound = texels.iter().all(|texel| texel.is_finite() && *texel >= 0.0);
        let [width, height] = [width.try_into().ok()?, height.try_into().ok()?];
        let sum: f64 = texels.iter().map(|texel| f64::from(*texel)).sum();
        let mean = sum / texels.len() as f64;
        (right && sound).then_some(Self {
            width,
            height,
            texels,
            mean,
            spread: OnceLock::new(),
            fluxes: OnceLock::new(),
        })
    }

    /// A channel of that size whose texels are a function's values at their middles, by shares u of a row and v of a
    /// column.
    pub fn of_shares(width: usize, height: usize, value: impl Fn(f64, f64) -> f64) -> Option<Self> {
        let share = |i: usize, count: usize| (i as f64 + 0.5) / count as f64;
        let texels = (0..width * height).map(|i| single(value(share(i % width, width), share(i / width, height))));
        Self::new(width, texels.collect())
    }

    /// One texel of value 1.
    pub fn white() -> Self {
        Self { width: 1, height: 1, texels: vec![1.0], mean: 1.0, spread: OnceLock::new(), fluxes: OnceLock::new() }
    }

    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        [self.width, self.height]
    }

    /// Texels in a row.
    pub fn width(&self) -> usize {
        self.width as usize
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height as usize
    }

    /// The texels, row by row.
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// `count` texels of a row, from the column `first`.
    fn row(&self, row: usize, first: usize, count: usize) -> &[f32] {
        &self.texels[row * self.width() + first..][..count]
    }

    /// The texel at shares u of a row and v of a column, from 0 to 1.
    #[expect(clippy::cast_possible_truncation, reason = "a share of a count, cut to the texel's index")]
    pub fn value(&self, u: f64, v: f64) -> f64 {
        let index = |share: f64, count: u32| (share * f64::from(count)).clamp(0.0, f64::from(count - 1)) as usize;
        f64::from(self.texels[index(v, self.height) * self.width() + index(u, self.width)])
    }

    /// A part's texels, gathered on few nodes: ∫ L ℓ_k ℓ_l du dv over it, ℓ the polynomials of
    /// [`crate::math::interpolation`]. Indexed by row, then column.
    pub fn weights(&self, columns: &Span, rows: &Span) -> Grid {
        if columns.is_within_texel() && rows.is_within_texel() {
            let level = self.value(columns.at(0.0), rows.at(0.0));
            even_weights(level * 0.25 * columns.length() * rows.length())
        } else {
            self.spread.get_or_init(|| Spread::new(self)).weights(self, columns, rows)
        }
    }

    /// ∫ L du dv over a part: the sum of its [`Self::weights`], for far less.
    pub fn flux(&self, columns: &Span, rows: &Span) -> f64 {
        if columns.is_within_texel() && rows.is_within_texel() {
            self.value(columns.at(0.0), rows.at(0.0)) * columns.length() * rows.length()
        } else {
            self.fluxes.get_or_init(|| Fluxes::new(self)).flux(self, columns, rows)
        }
    }

    /// Mean of the texels.
    pub fn mean(&self) -> f64 {
        self.mean
    }
}

impl PartialEq for Image {
    /// Texel by texel, but for images that share their texels.
    fn eq(&self, other: &Self) -> bool {
        let same = |(a, b): (&Arc<Channel>, &Arc<Channel>)| Arc::ptr_eq(a, b) || a == b;
        let (a, b) = (self.channels(), other.channels());
        a.len() == b.len() && a.iter().zip(b).all(same)
    }
}

impl Image {
    /// One texel of value 1.
    pub fn white() -> Self {
        Self::Grey(Arc::new(Channel::white()))
    }

    /// The texel at shares u of a row and v of a column, from 0 to 1.
    pub fn value(&self, u: f64, v: f64) -> DVec3 {
        match self {
            Self::Grey(channel) => DVec3::splat(channel.value(u, v)),
            Self::Color(channels) => DVec3::from_array(channels.each_ref().map(|channel| channel.value(u, v))),
        }
    }

    /// Whether these are the very same texels.
    pub fn is_same(&self, other: &Self) -> bool {
        let (a, b) = (self.channels(), other.channels());
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b))
    }

    /// The channels: one, or red, green and blue.
    pub fn channels(&self) -> &[Arc<Channel>] {
        match self {
            Self::Grey(channel) => std::slice::from_ref(channel),
            Self::Color(channels) => channels,
        }
    }
}

impl Pattern {
    /// A pattern of that name and image, which no file holds yet.
    pub fn of_image(file: impl Into<String>, image: Image) -> Self {
        Self { file: file.into(), image, contents: Contents::default() }
    }

    /// A pattern of that file, white until the file is read.
    pub fn unread(file: impl Into<String>) -> Self {
        Self::of_image(file, Image::white())
    }
}

written_as_file!(Pattern);
