//! Tables that shaders look things up in: constants where they are small, else textures in files beside.

use std::io::Cursor;

use ::exr::prelude::{Encoding, Image, Layer, SpecificChannels, Vec2, WritableImage as _};

use super::constants::number;
use super::part::{Constant, Part};
use crate::export::{ExportError, File, Job, Origin, exr};

/// Numbers of a table that is written as a constant.
const MOST_NUMBERS: usize = 256;

/// Numbers in a row of a texture: rows of the sums over disks, and parts of patterns, are not cut.
const WIDTH: usize = 2304;

/// The bind group of the textures in WGSL.
pub(in crate::export) const GROUP: u32 = 1;

/// A light's table.
pub(super) struct Table {
    name: String,
    numbers: Vec<f32>,
}

/// A table that is a texture.
pub(in crate::export) struct TableFile {
    /// The texture's name.
    pub(in crate::export) name: String,
    /// Its place among the textures.
    pub(in crate::export) binding: u32,
    /// The picture.
    pub(in crate::export) file: File,
}

impl Table {
    pub(super) fn new(name: String, numbers: Vec<f32>) -> Self {
        Self { name, numbers }
    }

    fn is_small(&self) -> bool {
        self.numbers.len() <= MOST_NUMBERS
    }

    /// The constant, where it is one.
    pub(super) fn constant(&self) -> Option<Constant> {
        let numbers: Option<Vec<_>> = self.numbers.iter().filter(|_| self.is_small()).map(|x| number(*x)).collect();
        let numbers = numbers.filter(|numbers| !numbers.is_empty())?;
        let value = format!("array<f32, {}>({})", numbers.len(), numbers.join(", "));
        Some(Constant { name: self.name.to_uppercase(), value })
    }

    /// How number `i` is read.
    pub(super) fn number(&self) -> String {
        if self.is_small() {
            return format!("{}[i]", self.name.to_uppercase());
        }
        format!("textureLoad({}, vec2u(i % {WIDTH}u, i / {WIDTH}u), 0).x", self.name)
    }

    /// How many numbers there are.
    pub(super) fn length(&self) -> String {
        format!("{}u", self.numbers.len())
    }

    fn file(&self, job: &Job) -> Result<File, ExportError> {
        let bytes = picture(&self.numbers, job.origin()).map_err(|cause| ExportError::Encode {
            what: format!("the table {}", self.name),
            cause: Box::new(cause),
        })?;
        Ok(job.file_beside(&self.name.replace('_', "-"), "exr", bytes))
    }
}

impl TableFile {
    /// The textures of these parts.
    pub(super) fn all_of(job: &Job, parts: &[Part]) -> Result<Vec<Self>, ExportError> {
        let tables = parts.iter().filter_map(|part| part.table.as_ref()).filter(|table| !table.is_small());
        let file =
            |(binding, table): (u32, &Table)| Ok(Self { name: table.name.clone(), binding, file: table.file(job)? });
        (0..).zip(tables).map(file).collect()
    }

    /// What the texture holds, in a line of ASCII.
    pub(in crate::export) fn title(&self) -> String {
        format!("File \"{}\": channel R, 32-bit floats, row 0 at the top; read unfiltered.", self.file.name)
    }

    /// The texture in WGSL.
    pub(super) fn declaration(&self) -> String {
        let Self { name, binding, .. } = self;
        format!("// {}\n@group({GROUP}) @binding({binding})\nvar {name}: texture_2d<f32>;\n\n", self.title())
    }
}

/// Numbers one after the other as an OpenEXR picture of one channel, with zeros behind them.
fn picture(numbers: &[f32], origin: Origin) -> Result<Vec<u8>, ::exr::error::Error> {
    let size = (WIDTH, numbers.len().div_ceil(WIDTH));
    let value = |at: Vec2<usize>| (numbers.get(at.y() * WIDTH + at.x()).copied().unwrap_or(0.0),);
    let channels = SpecificChannels::build().with_channel("R").with_pixel_fn(value);
    let layer = Layer::new(size, exr::attributes(origin), Encoding::default(), channels);
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}
