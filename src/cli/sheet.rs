//! `softbox sheet`: a contact sheet of scenes and presets.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use rayon::prelude::*;

use super::size::Size;
use super::{Outcome, files, progress};
use crate::export::Origin;
use crate::export::sheet::{self, Entry};
use crate::render::thumbnail::thumbnail;

/// Most rays a pixel.
const SAMPLES: u32 = 16;

/// Draw small pictures of scenes and light presets on one sheet, each with its name.
///
/// Presets are shown over a floor with a ball. Needs neither display nor GPU.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene files, presets, or folders of them.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Picture to write: .png.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Width and height of each picture in pixels.
    #[arg(short, long, default_value = "256x160", value_name = "WxH")]
    size: Size,
    /// Pictures in a row.
    #[arg(short, long, default_value_t = 6, value_parser = clap::value_parser!(u32).range(1..=64))]
    columns: u32,
}

/// Render each, and write the sheet whole or not at all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    files::format(&args.output, &[("png", ())])?;
    let paths = paths(&args.files)?;
    let scenes: Vec<_> = paths.iter().map(|path| files::load(path)).collect::<Result<_, _>>()?;
    files::check_writable(&args.output)?;
    let progress = progress::until_interrupted()?;
    let pixels = args.size.0.map(u64::from).iter().product::<u64>();
    let picture = |(path, scene): (&PathBuf, &crate::scene::Scene)| {
        let name = if scene.name.is_empty() {
            path.file_stem().unwrap_or_default().to_string_lossy()
        } else {
            (&scene.name).into()
        };
        Some(Entry { name: name.into_owned(), picture: thumbnail(scene, args.size.0, SAMPLES, &progress)? })
    };
    let total = pixels * paths.len() as u64;
    let entries: Option<Vec<_>> =
        progress::with_bar(total, &progress, || paths.par_iter().zip(&scenes).map(picture).collect());
    let Some(entries) = entries else { return Ok(Outcome::Interrupted) };
    let names: Vec<_> = paths.iter().map(|path| files::name(path)).collect();
    let origin = Origin { scene: &names.join(", ") };
    files::write(&args.output, &sheet::png(&entries, args.size.0, args.columns, origin)?)?;
    Ok(Outcome::Done)
}

/// The files named, and the scenes in the folders named, in the order of their names.
fn paths(named: &[PathBuf]) -> anyhow::Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for path in named {
        if path.is_dir() {
            let before = paths.len();
            scenes_in(path, &mut paths)?;
            if paths.len() == before {
                bail!("{}: has no scene files (.toml)", path.display());
            }
        } else {
            paths.push(path.clone());
        }
    }
    Ok(paths)
}

/// The scenes in a folder and those below it.
fn scenes_in(folder: &Path, paths: &mut Vec<PathBuf>) -> anyhow::Result<()> {
    let cannot = || format!("{}: cannot be read", folder.display());
    let entries: Result<Vec<_>, _> = fs::read_dir(folder).with_context(cannot)?.collect();
    let mut entries: Vec<_> = entries.with_context(cannot)?.iter().map(fs::DirEntry::path).collect();
    entries.sort();
    for path in entries {
        // A link to a folder above would never end.
        if path.is_dir() && !path.is_symlink() {
            scenes_in(&path, paths)?;
        } else if path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml")) {
            paths.push(path);
        }
    }
    Ok(())
}
