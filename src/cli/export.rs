//! `softbox export`: what leaves the program.

use std::io::{self, Write as _};
use std::num::ParseFloatError;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::size::Size;
use super::{Outcome, files, progress};
use crate::export::{ExportError, Exported, Job, Options, Target, export, preflight};
use crate::render::MethodChoice;
use crate::scene::{self, Scene};
use crate::shading::fit::{Budget, COUNTS};

/// Write a scene, or some of its lights, for other programs, and say what becomes of each thing on the way.
///
/// Nothing is written while something would be lost, unless --allow-loss is given. Files beside the named one, such as
/// textures, begin with its name.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// What to write; what the output's extension says where it is not given.
    #[arg(short, long, value_name = "FORMAT", value_parser = targets())]
    to: Option<Target>,
    /// File to write.
    #[arg(short, long, value_name = "FILE", required_unless_present = "dry_run")]
    output: Option<PathBuf>,
    /// A light to write, by its name; may be given more than once. All that are not muted where it is not given.
    #[arg(short, long, value_name = "NAME")]
    light: Vec<String>,
    /// Leave out surfaces and materials.
    #[arg(long)]
    no_surfaces: bool,
    /// Print what would become of each thing, and write nothing.
    #[arg(long)]
    dry_run: bool,
    /// Write although something is lost.
    #[arg(long)]
    allow_loss: bool,
    /// Of pictures: how lights are shaded, as in `softbox render`.
    #[arg(short, long, default_value = "exact", value_name = "METHOD")]
    method: MethodChoice,
    /// Of pictures: width and height in pixels.
    #[arg(short, long, default_value = "960x540", value_name = "WxH")]
    size: Size,
    /// Of glTF: how many punctual lights stand for a light, at most.
    #[arg(long, default_value_t = 4, value_name = "N",
          value_parser = clap::value_parser!(u32).range(i64::from(*COUNTS.start())..=i64::from(*COUNTS.end())))]
    punctual: u32,
    /// Of glTF: take as few punctual lights as keep the worst error below so many per cent of the greatest illuminance.
    #[arg(long, value_name = "PERCENT", conflicts_with = "punctual", value_parser = percent)]
    punctual_error: Option<f64>,
}

/// A percentage above 0.
fn percent(text: &str) -> Result<f64, String> {
    let value: f64 =
        text.trim_end_matches('%').trim().parse().map_err(|cause: ParseFloatError| format!("`{text}`: {cause}"))?;
    if value > 0.0 && value.is_finite() { Ok(value) } else { Err("it must be above 0".to_owned()) }
}

/// Takes the names of targets.
fn targets() -> impl TypedValueParser<Value = Target> {
    PossibleValuesParser::new(Target::ALL.map(Target::name)).try_map(|name| name.parse::<Target>())
}

/// Export, and write all files or none.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let target = target(args)?;
    let scene = files::load(&args.scene)?;
    let output = args.output.as_deref().filter(|_| !args.dry_run);
    if let Some(output) = output {
        files::check_writable(output)?;
    }
    let progress = progress::until_interrupted()?;
    let result = exported(&scene, target, args, &progress);
    let exported = match result {
        Err(ExportError::Cancelled) => return Ok(Outcome::Interrupted),
        result => result.with_context(|| args.scene.display().to_string())?,
    };
    let lines = preflight::lines(&exported.remarks).join("\n");
    let Some(output) = output else {
        writeln!(io::stdout(), "{lines}")?;
        return Ok(Outcome::Done);
    };
    if !lines.is_empty() {
        eprintln!("{lines}");
    }
    if exported.has_losses() && !args.allow_loss {
        bail!("{}: not written, as something would be lost; --allow-loss writes the rest", output.display());
    }
    write(&exported, output)?;
    Ok(Outcome::Done)
}

/// What to write: as asked for, or as the output's extension says.
fn target(args: &Args) -> anyhow::Result<Target> {
    if let Some(target) = args.to {
        return Ok(target);
    }
    let Some(output) = &args.output else { bail!("without an output, --to must say what to write") };
    let targets = Target::ALL.map(|target| (target.extension(), target));
    files::format(output, &targets).context("without --to")
}

fn exported(
    scene: &Scene,
    target: Target,
    args: &Args,
    progress: &crate::render::Progress,
) -> Result<Exported, ExportError> {
    let stem = args.output.as_ref().unwrap_or(&args.scene).file_stem().unwrap_or_default().to_string_lossy();
    let scene_name = files::name(&args.scene);
    let punctual = args.punctual_error.map_or(Budget::Count(args.punctual), |percent| Budget::Worst(0.01 * percent));
    let job = Job {
        scene,
        scene_name: &scene_name,
        stem: &stem,
        target,
        lights: Some(args.light.as_slice()).filter(|names| !names.is_empty()),
        surfaces: !args.no_surfaces,
        options: Options { method: args.method, size: args.size.0, punctual },
    };
    let steps = match target {
        Target::Png | Target::Exr => args.size.0.map(u64::from).iter().product(),
        _ => 0,
    };
    progress::with_bar(steps, progress, || export(&job, progress))
}

/// The main file under the name asked for, and the others in its folder, all or none.
fn write(exported: &Exported, output: &Path) -> anyhow::Result<()> {
    scene::replace_files(&exported.placed(output))
        .map_err(|(path, cause)| anyhow::Error::new(cause).context(format!("{}: cannot be written", path.display())))
}
