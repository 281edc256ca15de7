//! `softbox difference`: where and by how much a method is off.

use std::io::Write;
use std::path::PathBuf;

use super::shadows::ShadowArgs;
use super::size::Size;
use super::{Outcome, columns, files, progress};
use crate::analysis::{Comparison, Summary, error_map};
use crate::export::{self, Origin};
use crate::render::MethodChoice;
use crate::shading::Method;

/// Most rays a pixel.
const MAX_SAMPLES: u32 = 1 << 16;

/// Draw the difference of two methods in false colour, with a scale, and print the worst and the RMS difference.
///
/// Differences are of luminance: blue where --of is too dark, red where it is too bright, white where both agree, grey
/// where no surface is seen. All figures are over the pixels that show a surface.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// Picture to write: .png, in false colour with its scale beneath, or .exr, the signed difference in cd/m².
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The method in question, as in `render`.
    #[arg(long, default_value = "approx", value_name = "METHOD")]
    of: MethodChoice,
    /// The method that it is measured against.
    #[arg(long, default_value_t = MethodChoice::Method(Method::Exact), value_name = "METHOD")]
    against: MethodChoice,
    /// Width and height of the map in pixels; the scale comes beneath.
    #[arg(short, long, default_value = "960x540", value_name = "WxH")]
    size: Size,
    /// Rays a pixel; 1 goes through its centre. Both methods shade the points of the same rays.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    /// End of the scale in cd/m², so that maps compare; the worst difference where it is not given.
    #[arg(long, value_name = "CD_PER_M2", value_parser = positive)]
    limit: Option<f64>,
    #[command(flatten)]
    shadows: ShadowArgs,
}

/// What a map is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "use a number above 0".to_owned())
}

/// Compute the map, write it whole or not at all, and print its summary.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let format = files::format(&args.output, &[("png", Format::Png), ("exr", Format::Exr)])?;
    let scene = files::load(&args.scene)?;
    files::check_writable(&args.output)?;
    let Args { of, against, size: Size(size), samples, .. } = *args;
    let comparison = Comparison { of, against, size, samples, shadows: args.shadows.shadows() };
    let progress = progress::until_interrupted()?;
    let pixels = comparison.size.map(u64::from).iter().product();
    let Some(map) = progress::with_bar(pixels, &progress, || error_map(&scene, &comparison, &progress)) else {
        return Ok(Outcome::Interrupted);
    };
    let what = format!("{} \u{2212} {}", args.of, args.against);
    let origin = Origin { scene: &files::name(&args.scene) };
    let bytes = match format {
        Format::Png => export::error_map::png(&map, &what, args.limit, origin)?,
        Format::Exr => export::error_map::exr(&map, origin)?,
    };
    files::write(&args.output, &bytes)?;
    write!(std::io::stdout(), "{}", told(&what, &map.summary()))?;
    Ok(Outcome::Done)
}

/// The summary in words.
fn told(what: &str, summary: &Summary) -> String {
    let Summary { worst, at: [x, y], rms, peak } = *summary;
    let percent = |value: f64| columns::percent(if peak > 0.0 { 100.0 * value / peak } else { 0.0 });
    format!(
        "{what}, luminance over the pixels that show a surface\n\
         max   {worst:+.4e} cd/m²  {} % of the peak  at pixel {x}, {y}\n\
         rms   {rms:.4e} cd/m²  {} % of the peak\n\
         peak  {peak:.4e} cd/m²\n",
        percent(worst),
        percent(rms),
    )
}
