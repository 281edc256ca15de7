//! `softbox render`: a picture of a scene.

use std::path::PathBuf;

use anyhow::bail;

use super::shadows::ShadowArgs;
use super::size::Size;
use super::{Outcome, files, progress};
use crate::export::{self, Origin};
use crate::render::{Film, MethodChoice, Settings, render};
use crate::scene::Scene;

/// Most rays a pixel.
const MAX_SAMPLES: u32 = 1 << 16;

/// Render a picture of a scene, without display or GPU.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// Picture to write: .png, exposed and tone-mapped, or .exr, linear radiance in cd/m².
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// exact, chebyshev, nearest-point, nearest-point-picott, hermite-1, hermite-2, point-cluster[-N], fit-N, point, reference,
    /// or approx for each light's first approximation; lights that do not have it are shaded exactly.
    #[arg(short, long, default_value = "exact", value_name = "METHOD")]
    method: MethodChoice,
    /// Width and height in pixels.
    #[arg(short, long, default_value = "960x540", value_name = "WxH")]
    size: Size,
    /// Most rays a pixel, where something changes across it; 1 goes through its centre.
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_SAMPLES)))]
    samples: u32,
    #[command(flatten)]
    shadows: ShadowArgs,
    /// What renders: cpu in double precision, or gpu as the editor's preview does, with its own number of rays where
    /// --samples is above 1.
    #[arg(long, value_enum, default_value_t = Renderer::Cpu)]
    renderer: Renderer,
}

/// What renders a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Renderer {
    Cpu,
    Gpu,
}

/// What a picture is written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Png,
    Exr,
}

/// Render the picture and write it whole, or not at all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let format = files::format(&args.output, &[("png", Format::Png), ("exr", Format::Exr)])?;
    let scene = files::load(&args.scene)?;
    files::check_writable(&args.output)?;
    let settings =
        Settings { size: args.size.0, choice: args.method, samples: args.samples, shadows: args.shadows.shadows() };
    let film = match args.renderer {
        Renderer::Cpu => on_cpu(&scene, &settings)?,
        Renderer::Gpu => Some(on_gpu(&scene, &settings)?),
    };
    let Some(film) = film else { return Ok(Outcome::Interrupted) };
    let origin = Origin { scene: &files::name(&args.scene) };
    let bytes = match format {
        Format::Png => export::png::rgb(film.size(), film.srgb(), origin)?,
        Format::Exr => export::exr::radiance(film.size(), film.radiance(), origin)?,
    };
    files::write(&args.output, &bytes)?;
    Ok(Outcome::Done)
}

/// The picture by all cores; none after Ctrl-C.
fn on_cpu(scene: &Scene, settings: &Settings) -> anyhow::Result<Option<Film>> {
    let progress = progress::until_interrupted()?;
    let pixels = settings.size.map(u64::from).iter().product();
    Ok(progress::with_bar(pixels, &progress, || render(scene, settings, &progress)))
}

/// The picture as the editor's preview shows it.
#[cfg(feature = "gpu")]
fn on_gpu(scene: &Scene, settings: &Settings) -> anyhow::Result<Film> {
    use anyhow::Context as _;
    use glam::DVec3;

    use crate::gpu::{Context, Display, View, picture};
    use crate::shading::Method;

    let MethodChoice::Method(method) = settings.choice else {
        bail!("--renderer gpu needs one method for all lights in place of approx");
    };
    if method == Method::Reference {
        bail!("--renderer gpu has no reference; use --renderer cpu");
    }
    let context = Context::new()?;
    let longest = context.device.limits().max_texture_dimension_2d;
    if settings.size.iter().any(|side| *side > longest) {
        bail!("--renderer gpu makes pictures of up to {longest} pixels a side here; use --renderer cpu");
    }
    let view = View {
        camera: scene.camera,
        size: settings.size,
        method,
        exposure_ev: scene.display.exposure_ev,
        show_emitters: true,
        shadows: settings.shadows != crate::render::Shadows::None,
        refine: settings.samples > 1,
        display: Display::Picture,
    };
    let pixels = picture(&context, scene, &view)?;
    let radiance = pixels.radiance.iter().map(|rgb| DVec3::from(rgb.map(f64::from))).collect();
    let srgb = pixels.srgb.iter().map(|&[r, g, b, _]| [r, g, b]).collect();
    Film::from_pixels(pixels.size, radiance, srgb).context("the picture is not whole")
}

/// Say that there is no GPU renderer.
#[cfg(not(feature = "gpu"))]
fn on_gpu(_scene: &Scene, _settings: &Settings) -> anyhow::Result<Film> {
    bail!("this build has no GPU renderer; use --renderer cpu")
}
