//! PNG pictures, marked as sRGB.

use png::{BitDepth, ColorType, Compression, Encoder, EncodingError, SrgbRenderingIntent};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Options, Tree};

use super::Origin;
use super::job::one_line;
use super::origin::PROGRAM;

/// Why a plot could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// The SVG is not understood.
    #[error(transparent)]
    Svg(#[from] usvg::Error),
    /// The picture has no pixels, or too many.
    #[error("no picture of {0} × {1} pixels")]
    Size(u32, u32),
    /// The picture could not be encoded.
    #[error(transparent)]
    Encode(#[from] EncodingError),
}

/// A picture of 8-bit sRGB pixels, row by row from the top. Its texts `Software` and `Source` have the origin.
pub fn rgb(size: [u32; 2], pixels: &[[u8; 3]], origin: Origin) -> Result<Vec<u8>, EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, size[0], size[1]);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_source_srgb(SrgbRenderingIntent::Perceptual);
    encoder.set_compression(Compression::High);
    encoder.add_itxt_chunk("Software".to_owned(), PROGRAM.to_owned())?;
    encoder.add_itxt_chunk("Source".to_owned(), one_line(origin.scene))?;
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// An opaque SVG picture at `scale` pixels a unit.
pub fn from_svg(svg: &str, scale: f32, origin: Origin) -> Result<Vec<u8>, DrawError> {
    let (size, pixels) = draw(svg, scale)?;
    Ok(rgb(size, &pixels, origin)?)
}

/// Size and pixels of an opaque SVG picture at `scale` pixels a unit.
///
/// Text is set in the font that comes with the program, so that the picture is the same on every machine.
pub fn draw(svg: &str, scale: f32) -> Result<([u32; 2], Vec<[u8; 3]>), DrawError> {
    let mut options = Options::default();
    options.fontdb_mut().load_font_source(usvg::fontdb::Source::Binary(std::sync::Arc::new(FONT)));
    options.fontdb_mut().set_sans_serif_family(FONT_FAMILY);
    let tree = Tree::from_str(svg, &options)?;
    let size = tree.size().to_int_size().scale_by(scale).ok_or(DrawError::Size(0, 0))?;
    let (width, height) = (size.width(), size.height());
    let mut pixmap = Pixmap::new(width, height).ok_or(DrawError::Size(width, height))?;
    resvg::render(&tree, Transform::from_scale(scale, scale), &mut pixmap.as_mut());
    let pixels = pixmap.pixels().iter().map(|p| [p.red(), p.green(), p.blue()]).collect();
    Ok(([width, height], pixels))
}

/// A sans-serif face with the signs that plots need.
const FONT: &[u8] = epaint_default_fonts::UBUNTU_LIGHT;

/// The family that [`FONT`] names itself.
const FONT_FAMILY: &str = "Ubuntu";
