//! OpenEXR pictures: linear radiance, 32-bit floats.

use std::io::Cursor;

use glam::DVec3;
use image::{ImageBuffer, ImageFormat, ImageResult, Rgb};

/// A picture of radiance in cd/m², linear Rec. 709 (OpenEXR's default primaries), without exposure.
pub fn radiance(size: [u32; 2], pixels: &[DVec3]) -> ImageResult<Vec<u8>> {
    let samples = pixels.iter().flat_map(|pixel| pixel.as_vec3().to_array()).collect();
    let picture: ImageBuffer<Rgb<f32>, Vec<f32>> =
        ImageBuffer::from_raw(size[0], size[1], samples).expect("a film has width times height pixels");
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::OpenExr)?;
    Ok(bytes.into_inner())
}
