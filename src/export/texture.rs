//! Patterns as pictures for programs that blend between texels.

use glam::DVec3;

use super::{ExportError, Origin, exr};
use crate::light::pattern::{Image, Pattern};

/// Pictures get at least so many texels along their longer side, by repeating each: blending then reaches a small part of
/// one only.
const LEAST_SIDE: u32 = 256;

/// How often a texel of that image is repeated each way.
pub(super) fn repeats(image: &Image) -> u32 {
    let [width, height] = size_of(image);
    if width * height == 1 { 1 } else { LEAST_SIDE.div_ceil(width.max(height)) }
}

/// An OpenEXR picture of a pattern, which is linear wherever it is read; bottom row first where `upside_down`.
pub(super) fn picture(pattern: &Pattern, upside_down: bool, origin: Origin) -> Result<Vec<u8>, ExportError> {
    let image = &pattern.image;
    let [width, height] = size_of(image);
    let repeats = repeats(image);
    let size = [width, height].map(|count| count * repeats);
    let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count);
    let row = |row: u32| if upside_down { size[1] - 1 - row } else { row };
    let texels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
    let texels: Vec<DVec3> = texels.map(|(x, y)| image.value(share(x, size[0]), share(row(y), size[1]))).collect();
    exr::radiance(size, &texels, origin)
        .map_err(|cause| ExportError::Encode { what: format!("the pattern {}", pattern.file), cause: Box::new(cause) })
}

fn size_of(image: &Image) -> [u32; 2] {
    image.channels().first().map_or([1; 2], |channel| channel.size())
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::light::pattern::Channel;

    #[test]
    fn every_texel_is_a_block_of_its_value() {
        let channel = Channel::new(3, vec![0.0, 0.25, 0.5, 1.0, 3.0, 0.125]).expect("two rows of three");
        let pattern = Pattern::of_image("p.png", Image::Grey(Arc::new(channel)));
        for upside_down in [false, true] {
            let bytes = picture(&pattern, upside_down, Origin { scene: "s.toml" }).expect("it is encoded");
            let read = image::load_from_memory(&bytes).expect("a picture").into_rgb32f();
            let repeats = repeats(&pattern.image);
            assert_eq!((repeats, read.width(), read.height()), (86, 258, 172), "its size");
            for (x, y, pixel) in read.enumerate_pixels() {
                let row = if upside_down { 1 - y / repeats } else { y / repeats };
                let expected = pattern.image.value(f64::from(x / repeats) / 3.0 + 0.1, f64::from(row) / 2.0 + 0.1);
                assert_eq!(pixel.0.map(f64::from), expected.to_array(), "the texel at {x}, {y}");
            }
        }
    }
}
