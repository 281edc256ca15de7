//! `softbox figures`: the figures and tables of the papers, from one command.

mod list;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};

use super::size::Size;
use super::{Outcome, files, progress};
use crate::analysis::chart::{Chart, Table};
use crate::export::{self, Origin};
use crate::render::{Progress, Settings, Shadows, render};
use crate::scene::Scene;
use list::{Content, FIGURES, Figure};

/// Most rays a pixel.
const SAMPLES: u32 = 16;

/// Pixels of a PNG a unit of its SVG.
const PNG_SCALE: f32 = 0.75;

/// What a chart or a table counts for in the progress, pixels.
const STEPS: u64 = 20_000;

/// Write the figures and tables of the four papers: pictures as PNG, charts as SVG and PNG, tables as CSV.
///
/// Pictures are of the scenes in presets/figures.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Names of figures, or how names begin, such as snyder or picott-1; all where none is given.
    names: Vec<String>,
    /// Folder to write to; it is made where it is missing.
    #[arg(short, long, value_name = "FOLDER", default_value = "figures")]
    output: PathBuf,
    /// Folder of the figures' scenes.
    #[arg(long, value_name = "FOLDER", default_value = "presets/figures")]
    scenes: PathBuf,
    /// Width and height of the pictures in pixels.
    #[arg(short, long, default_value = "480x360", value_name = "WxH")]
    size: Size,
    /// Print the names and what each figure shows, and write nothing.
    #[arg(long)]
    list: bool,
}

/// A figure with the scenes that it shows.
type Loaded = (&'static Figure, Vec<Scene>);

/// Write each figure as soon as it is made; those written stay when Ctrl-C ends the work.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let figures = chosen(&args.names)?;
    if args.list {
        for figure in figures {
            writeln!(std::io::stdout(), "{:<16} {}", figure.name, figure.shows)?;
        }
        return Ok(Outcome::Done);
    }
    let load = |figure: &'static Figure| -> anyhow::Result<Loaded> {
        let scenes = figure.content.scenes().iter().map(|scene| files::load(&args.scenes.join(scene)));
        Ok((figure, scenes.collect::<anyhow::Result<_>>()?))
    };
    let figures: Vec<Loaded> = figures.into_iter().map(load).collect::<anyhow::Result<_>>()?;
    fs::create_dir_all(&args.output).with_context(|| format!("{}: cannot be made", args.output.display()))?;
    files::check_writable(&args.output.join("figure"))?;
    let progress = progress::until_interrupted()?;
    let pixels: u64 = args.size.0.map(u64::from).iter().product();
    let steps = |content: &Content| if matches!(content, Content::Picture { .. }) { pixels } else { STEPS };
    let steps = figures.iter().map(|(figure, _)| steps(&figure.content)).sum();
    let written = progress::with_bar(steps, &progress, || -> anyhow::Result<Option<Vec<String>>> {
        let mut lines = Vec::new();
        for (figure, scenes) in &figures {
            let Some(outputs) = make(figure, scenes, args.size, &progress)? else { return Ok(None) };
            for (extension, bytes) in outputs {
                let file = format!("{}.{extension}", figure.name);
                files::write(&args.output.join(&file), &bytes)?;
                lines.push(format!("{:<28} {}", shown(&args.output, &file), figure.shows));
            }
        }
        Ok(Some(lines))
    })?;
    let Some(lines) = written else { return Ok(Outcome::Interrupted) };
    for line in lines {
        writeln!(std::io::stdout(), "{line}")?;
    }
    Ok(Outcome::Done)
}

fn shown(folder: &Path, file: &str) -> String {
    folder.join(file).display().to_string()
}

/// The figures that names choose.
fn chosen(names: &[String]) -> anyhow::Result<Vec<&'static Figure>> {
    // `snyder-2` begins `snyder-2a` but not `snyder-20`.
    let begins = |figure: &Figure, name: &str| {
        let rest = figure.name.strip_prefix(name);
        rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
    };
    if let Some(unknown) = names.iter().find(|name| !FIGURES.iter().any(|figure| begins(figure, name))) {
        bail!("there is no figure `{unknown}`; `softbox figures --list` names them");
    }
    Ok(FIGURES.iter().filter(|figure| names.is_empty() || names.iter().any(|name| begins(figure, name))).collect())
}

/// The files of a figure, by extension; none when cancelled.
type Outputs = Vec<(&'static str, Vec<u8>)>;

fn make(figure: &Figure, scenes: &[Scene], Size(size): Size, progress: &Progress) -> anyhow::Result<Option<Outputs>> {
    if progress.is_cancelled() {
        return Ok(None);
    }
    let origin = Origin { scene: figure.content.scenes().first().map_or(figure.name, |scene| scene) };
    let outputs = match figure.content {
        Content::Picture { choice, .. } => {
            let settings = Settings { size, choice, samples: SAMPLES, shadows: Shadows::default() };
            let film = scenes.first().and_then(|scene| render(scene, &settings, progress));
            let png = film.map(|film| export::png::rgb(film.size(), film.srgb(), origin)).transpose()?;
            return Ok(png.map(|png| vec![("png", png)]));
        }
        Content::Chart(chart) => chart(progress).map(|chart| drawn(&chart, origin)).transpose()?,
        Content::Table(table) => table(progress).map(|table| written(&table, origin)).transpose()?,
        Content::Lights { scenes: names, table } => {
            let names = names.iter().map(|name| name.trim_end_matches(".toml"));
            let scenes: Vec<_> = names.zip(scenes).collect();
            table(&scenes, progress).map(|table| written(&table, origin)).transpose()?
        }
    };
    progress.advance(STEPS);
    Ok(outputs)
}

fn drawn(chart: &Chart, origin: Origin) -> anyhow::Result<Outputs> {
    let svg = export::svg::chart(chart, origin);
    let png = export::png::from_svg(&svg, PNG_SCALE, origin)?;
    Ok(vec![("svg", svg.into_bytes()), ("png", png)])
}

fn written(table: &Table, origin: Origin) -> anyhow::Result<Outputs> {
    Ok(vec![("csv", csv(table, origin)?)])
}

fn csv(table: &Table, origin: Origin) -> anyhow::Result<Vec<u8>> {
    let mut rows = export::csv::headed(&table.heading, origin)?;
    for row in &table.rows {
        rows.write_record(row)?;
    }
    Ok(rows.into_inner().map_err(csv::IntoInnerError::into_error)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_chooses_all_figures_that_it_begins_but_no_other_number() {
        let names = |chosen_by: &str| -> Vec<_> {
            chosen(&[chosen_by.to_owned()]).unwrap().iter().map(|figure| figure.name).collect()
        };
        assert_eq!(names("snyder-2"), ["snyder-2"], "one");
        assert_eq!(names("picott-1"), ["picott-1a", "picott-1b", "picott-1c"], "a plate");
        assert!(chosen(&["snyder".to_owned()]).unwrap().len() > 5, "a paper");
        assert_eq!(chosen(&[]).unwrap().len(), FIGURES.len(), "all");
        assert!(chosen(&["guess".to_owned()]).is_err(), "no such figure");
    }

    #[test]
    fn every_figure_has_a_name_of_its_own() {
        for (i, figure) in FIGURES.iter().enumerate() {
            assert!(FIGURES[..i].iter().all(|other| other.name != figure.name), "{} twice", figure.name);
        }
    }
}
