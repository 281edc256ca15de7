//! The pattern files of a scene's lights: read and refused.

use std::io::{self, Cursor};
use std::path::Path;
use std::sync::Arc;

use image::{DynamicImage, ExtendedColorType, ImageDecoder, ImageFormat, ImageReader, ImageResult, Limits};

use super::beside::{self, Imported};
use super::{Problem, Scene};
use crate::contents::Contents;
use crate::light::pattern::code::{self, linear_from_srgb, single};
use crate::light::pattern::{Channel, Image, Pattern};

/// Patterns have at most this many columns, and as many rows.
pub const MAX_PATTERN_SIZE: u32 = 4096;

/// The patterns of a scene have together at most this many texels: four of the largest size.
const MAX_TEXELS: u64 = 4 * (MAX_PATTERN_SIZE as u64).pow(2);

/// Memory that a decoder may take for one pattern: four single-precision channels, twice over.
const MAX_DECODER_BYTES: u64 = 32 * (MAX_PATTERN_SIZE as u64).pow(2);

/// Read the patterns of a scene, each file once; `read` gives the bytes of the file of a name. What is wrong with them
/// is returned.
pub(super) fn read_all(scene: &mut Scene, mut read: impl FnMut(&str) -> io::Result<Vec<u8>>) -> Vec<Problem> {
    let mut texels_left = MAX_TEXELS;
    let patterns = beside::patterns_mut(scene).into_iter();
    beside::read_each(patterns, |pattern| &pattern.file, |name| read_pattern(name, &mut read, &mut texels_left))
}

fn read_pattern(
    name: &str,
    read: &mut impl FnMut(&str) -> io::Result<Vec<u8>>,
    texels_left: &mut u64,
) -> Result<Pattern, String> {
    let bytes = read(name).map_err(|cause| {
        format!(
            "`{name}` cannot be read: {cause}; write the name of a PNG, JPEG, EXR or HDR file in the scene's folder"
        )
    })?;
    let image = decode(&bytes, texels_left).map_err(|wrong| format!("`{name}` {wrong}"))?;
    Ok(Pattern { file: name.to_owned(), image, contents: Contents(bytes.into()) })
}

/// Read a picture from anywhere as a pattern for the scene whose file is `scene`, if it has one.
///
/// A file below the scene's folder keeps its place; any other is called `textures/` and its own name, numbered where the
/// folder has another file of that name, and is put there when the scene is saved. What is wrong with it is one line.
pub fn import_pattern(path: &Path, scene: Option<&Path>) -> Result<Pattern, String> {
    let imported = Imported::read(path)?;
    let image =
        decode(&imported.bytes, &mut { MAX_TEXELS }).map_err(|wrong| format!("`{}` {wrong}", imported.own_name))?;
    let file = imported.name(path, scene, "textures");
    Ok(Pattern { file, image, contents: Contents(imported.bytes.into()) })
}

/// The pattern of that name that the bytes of a picture file hold. What is wrong with them is one line.
pub fn pattern_of_bytes(file: &str, bytes: Vec<u8>) -> Result<Pattern, String> {
    let image = decode(&bytes, &mut { MAX_TEXELS }).map_err(|wrong| format!("`{file}` {wrong}"))?;
    Ok(Pattern { file: file.to_owned(), image, contents: Contents(bytes.into()) })
}

/// The image in a file's bytes, or what is wrong with it. Sizes are checked before memory is taken for them, and what
/// the image has is taken from `texels_left`.
fn decode(bytes: &[u8], texels_left: &mut u64) -> Result<Image, String> {
    let format = image::guess_format(bytes).ok();
    let Some(format @ (ImageFormat::Png | ImageFormat::Jpeg | ImageFormat::OpenExr | ImageFormat::Hdr)) = format else {
        return Err("is no PNG, JPEG, EXR or HDR picture; save it as one of these".to_owned());
    };
    let damaged = |error: image::ImageError| {
        let error = error.to_string().replace(char::is_control, " ");
        format!("cannot be decoded: {error}; save it anew as PNG, JPEG, EXR or HDR")
    };
    if format == ImageFormat::OpenExr {
        check_exr(bytes)?;
    }
    if format == ImageFormat::Jpeg && !is_whole_jpeg(bytes) {
        return Err("cannot be decoded: its end is missing; save it anew as JPEG".to_owned());
    }
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_DECODER_BYTES);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let mut decoder = reader.into_decoder().map_err(damaged)?;
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into())?;
    *texels_left = texels_left
        .checked_sub(u64::from(width) * u64::from(height))
        .ok_or_else(|| format!("is too much: a scene's patterns have at most {MAX_TEXELS} texels; scale some down"))?;
    let orientation = decoder.orientation().map_err(damaged)?;
    let mut picture = DynamicImage::from_decoder(decoder).map_err(damaged)?;
    picture.apply_orientation(orientation);
    image_of(&picture)
}

fn check_size(width: u64, height: u64) -> Result<(), String> {
    let most = MAX_PATTERN_SIZE;
    if width == 0 || height == 0 {
        return Err("has no texels; save a picture of at least 1 x 1".to_owned());
    }
    if width.max(height) > most.into() {
        return Err(format!("is {width} x {height} texels; scale it to at most {most} x {most}"));
    }
    Ok(())
}

/// Whether the last scan of a JPEG file has an end; the decoder itself would make up what is missing.
fn is_whole_jpeg(bytes: &[u8]) -> bool {
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|window| window == marker);
    last([0xff, 0xd9]) > last([0xff, 0xda])
}

/// What the header of an EXR file says of its parts, which the decoder itself would believe.
fn check_exr(bytes: &[u8]) -> Result<(), String> {
    let metadata = exr::meta::MetaData::read_from_buffered(bytes, false)
        .map_err(|error| format!("cannot be decoded: {error}; save it anew as EXR"))?;
    for header in &metadata.headers {
        let exr::math::Vec2(width, height) = header.layer_size;
        check_size(width as u64, height as u64)?;
        if header.max_block_byte_size() as u64 > MAX_DECODER_BYTES {
            return Err("has blocks that are larger than a picture; save it anew as EXR".to_owned());
        }
    }
    Ok(())
}

/// The linear texels of a picture. Integers are sRGB-encoded, and times their alpha; floating-point colours are linear
/// and, by EXR's rule, already hold it.
fn image_of(picture: &DynamicImage) -> Result<Image, String> {
    let width = picture.width() as usize;
    let colors = if picture.color().has_color() { 3 } else { 1 };
    let stride = usize::from(picture.color().channel_count());
    let channels: Vec<Vec<f32>> = match picture {
        DynamicImage::ImageRgb32F(pixels) => split(pixels, stride, colors),
        DynamicImage::ImageRgba32F(pixels) => split(pixels, stride, colors),
        _ if picture.color().bytes_per_pixel() == picture.color().channel_count() => {
            decoded(picture.as_bytes(), stride, colors, u8::MAX.into())
        }
        _ => {
            let (pairs, _) = picture.as_bytes().as_chunks::<2>();
            let codes: Vec<u16> = pairs.iter().map(|pair| u16::from_ne_bytes(*pair)).collect();
            decoded(&codes, stride, colors, u16::MAX)
        }
    };
    if channels.iter().flatten().all(|value| *value == 0.0) {
        return Err("is black all over; give it at least one texel that shines".to_owned());
    }
    let arc = |values, name| channel(width, values, name).map(Arc::new);
    match <[Vec<f32>; 3]>::try_from(channels) {
        Ok([red, green, blue]) if red == green && green == blue => Ok(Image::Grey(arc(red, "value")?)),
        Ok([red, green, blue]) => Ok(Image::Color([arc(red, "red")?, arc(green, "green")?, arc(blue, "blue")?])),
        Err(grey) => Ok(Image::Grey(arc(grey.concat(), "value")?)),
    }
}

/// A channel, or which of its texels is none.
fn channel(width: usize, texels: Vec<f32>, name: &str) -> Result<Channel, String> {
    let wrong = texels.iter().enumerate().find(|(_, value)| !(value.is_finite() && **value >= 0.0));
    if let Some((i, value)) = wrong {
        let (row, column) = (i / width, i % width);
        return Err(format!(
            "has {value} as {name} in row {row}, column {column}; texels must be finite and not negative"
        ));
    }
    Channel::new(width, texels).ok_or_else(|| "has incomplete rows; save it anew".to_owned())
}

/// The first `colors` of every `stride` samples, each in its own channel.
fn split(samples: &[f32], stride: usize, colors: usize) -> Vec<Vec<f32>> {
    (0..colors).map(|color| samples.iter().skip(color).step_by(stride).copied().collect()).collect()
}

/// [`split`] for sRGB codes from 0 to `white`, times alpha where there is a sample more.
fn decoded<T: Copy + Into<u16>>(codes: &[T], stride: usize, colors: usize, white: u16) -> Vec<Vec<f32>> {
    let share = |code: u16| f64::from(code) / f64::from(white);
    let linear: Vec<f64> = (0..=white).map(|code| linear_from_srgb(share(code))).collect();
    let value = |texel: &[T], color: usize| {
        let alpha = if stride > colors { share(texel[colors].into()) } else { 1.0 };
        single(linear[usize::from(texel[color].into())] * alpha)
    };
    (0..colors).map(|color| codes.chunks_exact(stride).map(|texel| value(texel, color)).collect()).collect()
}

/// A file that holds exactly an image's texels, and the extension that it should have: a PNG of 8 or of 16 bits if that
/// can, else an EXR.
pub(super) fn encode(image: &Image) -> ImageResult<(Vec<u8>, &'static str)> {
    let channels: Vec<&[f32]> = image.channels().iter().map(|channel| channel.texels()).collect();
    let [width, height] = image.channels()[0].size();
    let write = |samples: &[u8], color: ExtendedColorType, format: ImageFormat| -> ImageResult<Vec<u8>> {
        let mut file = Cursor::new(Vec::new());
        image::write_buffer_with_format(&mut file, samples, width, height, color, format)?;
        Ok(file.into_inner())
    };
    let values = (0..channels[0].len()).flat_map(|i| channels.iter().map(move |channel| channel[i]));
    let codes: Option<Vec<u16>> = values.map(code::code_of).collect();
    let is_grey = channels.len() == 1;
    let Some(codes) = codes else {
        // EXR files have three channels for the reader, whatever they show.
        let rgb = (0..channels[0].len()).flat_map(|i| (0..3).map(move |c| (i, c)));
        let samples: Vec<u8> = rgb.flat_map(|(i, c)| channels[c.min(channels.len() - 1)][i].to_ne_bytes()).collect();
        return Ok((write(&samples, ExtendedColorType::Rgb32F, ImageFormat::OpenExr)?, "exr"));
    };
    // A code c of 8 bits is the code 257 c of 16.
    let short: Option<Vec<u8>> =
        codes.iter().map(|code| if code % 257 == 0 { u8::try_from(code / 257).ok() } else { None }).collect();
    let file = match short {
        Some(samples) => {
            let color = if is_grey { ExtendedColorType::L8 } else { ExtendedColorType::Rgb8 };
            write(&samples, color, ImageFormat::Png)?
        }
        None => {
            let samples: Vec<u8> = codes.iter().flat_map(|code| code.to_ne_bytes()).collect();
            let color = if is_grey { ExtendedColorType::L16 } else { ExtendedColorType::Rgb16 };
            write(&samples, color, ImageFormat::Png)?
        }
    };
    Ok((file, "png"))
}
