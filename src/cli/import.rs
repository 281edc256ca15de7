//! `softbox import`: lights that other programs wrote.

use std::path::PathBuf;

use anyhow::Context;

use super::{Outcome, files};
use crate::import::usda;
use crate::scene;

/// Read the UsdLux lights of an OpenUSD text file (.usda) as a light preset.
///
/// What is not as it was there is told, each with its line.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// File to read: .usda.
    file: PathBuf,
    /// Preset to write: .toml. The pictures of its lights are put into `textures/` beside it.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Read, tell what is different, and write the preset whole or not at all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    files::format(&args.output, &[("toml", ())])?;
    let imported = usda::read_file(&args.file).with_context(|| args.file.display().to_string())?;
    files::check_writable(&args.output)?;
    for remark in &imported.remarks {
        eprintln!("{}:{remark}", args.file.display());
    }
    scene::save(&imported.scene, &args.output)?;
    Ok(Outcome::Done)
}
