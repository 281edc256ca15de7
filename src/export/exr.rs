//! OpenEXR pictures: linear radiance, 32-bit floats.

use std::io::Cursor;

use exr::error::Error;
use exr::meta::attribute::Text;
use exr::prelude::{Encoding, Image, Layer, LayerAttributes, SpecificChannels, Vec2, WritableImage as _};
use glam::DVec3;

use super::Origin;
use super::origin::PROGRAM;

/// A picture of radiance in cd/m², linear Rec. 709 (OpenEXR's default primaries), without exposure.
///
/// Its attributes `software` and `comments` have the origin, in UTF-8.
pub fn radiance(size: [u32; 2], pixels: &[DVec3], origin: Origin) -> Result<Vec<u8>, Error> {
    let [width, height] = size.map(|side| side as usize);
    let value = |at: Vec2<usize>| <(f32, f32, f32)>::from(pixels[at.y() * width + at.x()].as_vec3());
    let layer = Layer::new((width, height), attributes(origin), Encoding::default(), SpecificChannels::rgb(value));
    let mut bytes = Cursor::new(Vec::new());
    Image::from_layer(layer).write().non_parallel().to_buffered(&mut bytes)?;
    Ok(bytes.into_inner())
}

/// What a picture says of its origin.
pub(super) fn attributes(origin: Origin) -> LayerAttributes {
    let text = |text: &str| Some(Text::from_slice_unchecked(text.as_bytes()));
    LayerAttributes { software_name: text(PROGRAM), comments: text(&origin.line()), ..LayerAttributes::default() }
}
