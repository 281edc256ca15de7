//! `softbox plot`: the plots of a scene.

use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::bail;

use super::{Outcome, files};
use crate::analysis::{self, Sheet};
use crate::export::Origin;
use crate::export::plot::{PlotFormat, SAMPLES};
use crate::scene::{Plot, Scene};

/// Draw the plots of a scene, a curve a method, with errors and costs, or write them as CSV.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// The one plot of that name; all plots of the scene where it is not given.
    #[arg(short, long, value_name = "NAME")]
    plot: Option<String>,
    /// Picture to write, .svg or .png, or a .csv of plot,x,method,y,error,bound under a comment.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// Compute the curves and write them whole, or not at all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let formats = PlotFormat::ALL.map(|format| (format.extension(), format));
    let format = files::format(&args.output, &formats)?;
    let scene = files::load(&args.scene)?;
    let wanted = plots(&scene, args)?;
    files::check_writable(&args.output)?;
    let cancel = Arc::new(AtomicBool::new(false));
    let on_interrupt = Arc::clone(&cancel);
    ctrlc::set_handler(move || on_interrupt.store(true, Ordering::Relaxed))?;
    let Some(plots) = sheets(&scene, &wanted, &cancel) else {
        return Ok(Outcome::Interrupted);
    };
    files::write(&args.output, &format.write(&plots, Origin { scene: &files::name(&args.scene) })?)?;
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
fn sheets(scene: &Scene, plots: &[&Plot], cancel: &AtomicBool) -> Option<Vec<Sheet>> {
    let methods = analysis::methods_for(scene);
    let sheet = |plot: &Plot| Some(Sheet::new(plot, analysis::curves(scene, plot, &methods, SAMPLES, cancel)?));
    plots.iter().map(|plot| sheet(plot)).collect()
}
