//! The pattern of a textured light: its image, and the file that it comes from.

use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// One channel of a pattern: luminance of each texel as a share of the light's, row by row, constant over a texel.
///
/// Values are finite and not negative. They are kept as images give them, in single precision.
#[derive(Clone, PartialEq)]
pub struct Channel {
    width: usize,
    height: usize,
    texels: Vec<f32>,
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

/// The bytes of a file; copies share them.
#[derive(Clone, Default, PartialEq, Eq)]
pub struct Contents(pub Arc<[u8]>);

impl fmt::Debug for Contents {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} bytes", self.0.len())
    }
}

impl Channel {
    /// The channel of those texels, `width` a row; `None` where they do not fill rows, or one is negative or not finite.
    pub fn new(width: usize, texels: Vec<f32>) -> Option<Self> {
        let height = texels.len().checked_div(width)?;
        let right = height > 0 && height * width == texels.len();
        let sound = texels.iter().all(|texel| texel.is_finite() && *texel >= 0.0);
        (right && sound).then_some(Self { width, height, texels })
    }

    /// One texel of value 1.
    pub fn white() -> Self {
        Self { width: 1, height: 1, texels: vec![1.0] }
    }

    /// Texels in a row.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.height
    }

    /// The texels, row by row.
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// Mean of the texels.
    pub fn mean(&self) -> f64 {
        let sum: f64 = self.texels.iter().map(|texel| f64::from(*texel)).sum();
        sum / (self.width * self.height) as f64
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

impl Serialize for Pattern {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.file.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Pattern {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        String::deserialize(deserializer).map(Self::unread)
    }
}

impl JsonSchema for Pattern {
    fn schema_name() -> Cow<'static, str> {
        String::schema_name()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        String::json_schema(generator)
    }
}
