//! `softbox plot`: the plots of a scene.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::bail;

use super::{Outcome, files};
use crate::analysis::{self, Curves};
use crate::export;
use crate::scene::{Plot, Scene};

/// Points of a curve: half a degree apart over ±90°.
const SAMPLES: usize = 361;

/// Pixels of a PNG a unit of its SVG, which is 1000 wide.
const PNG_SCALE: f32 = 2.0;

/// Draw the plots of a scene, a curve a method, with errors and costs, or write them as CSV.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// The one plot of that name; all plots of the scene where it is not given.
    #[arg(short, long, value_name = "NAME")]
    plot: Option<String>,
    /// Picture to write, .svg or .png, or a .csv of plot,x,method,y,error,bound.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// What plots are written as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    Svg,
    Png,
    Csv,
}

/// Compute the curves and write them whole, or not at all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let formats = [("svg", Format::Svg), ("png", Format::Png), ("csv", Format::Csv)];
    let format = files::format(&args.output, &formats)?;
    let scene = files::load(&args.scene)?;
    let wanted = plots(&scene, args)?;
    files::check_writable(&args.output)?;
    let cancel = Arc::new(AtomicBool::new(false));
    let on_interrupt = Arc::clone(&cancel);
    ctrlc::set_handler(move || on_interrupt.store(true, Ordering::Relaxed))?;
    let Some(plots) = curves(&scene, &wanted, &cancel) else {
        return Ok(Outcome::Interrupted);
    };
    let bytes = match format {
        Format::Svg => export::svg::plots(&plots).into_bytes(),
        Format::Png => export::png::from_svg(&export::svg::plots(&plots), PNG_SCALE)?,
        Format::Csv => export::csv::plots(&plots)?,
    };
    files::write(&args.output, &bytes)?;
    Ok(Outcome::Done)
}

/// The plots asked for.
fn plots<'a>(scene: &'a Scene, args: &Args) -> anyhow::Result<Vec<&'a Plot>> {
    let file = args.scene.display();
    if scene.plots.is_empty() {
        bail!("{file}: has no plots; add one as [[plot]] with name, kind and range, or in the editor");
    }
    let Some(name) = &args.plot else {
        return Ok(scene.plots.iter().collect());
    };
    let Some(plot) = scene.plots.iter().find(|plot| plot.name == *name) else {
        let names: Vec<_> = scene.plots.iter().map(|plot| format!("`{}`", plot.name)).collect();
        bail!("{file}: has no plot `{name}`; it has {}", names.join(", "));
    };
    Ok(vec![plot])
}

/// Every plot by every method that one of the lights has; none when cancelled.
fn curves<'a>(scene: &Scene, plots: &[&'a Plot], cancel: &AtomicBool) -> Option<Vec<(&'a Plot, Curves)>> {
    let methods = analysis::methods_for(scene);
    plots.iter().map(|plot| Some((*plot, analysis::curves(scene, plot, &methods, SAMPLES, cancel)?))).collect()
}
