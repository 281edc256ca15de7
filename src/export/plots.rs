//! A scene's plots, all on one sheet.

use super::plot::SAMPLES;
use super::{ExportError, Exported, Fate, Job, Remark, Target, csv, svg};
use crate::analysis::{self, Curves, Series, Sheet};
use crate::render::Progress;
use crate::scene::{Plot, Scene};

/// The plots of the chosen lights by every method that one of them has, without their costs, which differ from run to run.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, mut remarks) = job.chosen_scene()?;
    if scene.plots.is_empty() {
        let message = "has no plots; add one as [[plot]] with name, kind and range, or in the editor";
        return Err(ExportError::Nothing(message.to_owned()));
    }
    let methods = analysis::methods_for(&scene);
    let sheet = |plot: &Plot| {
        let curves = analysis::curves(&scene, plot, &methods, SAMPLES, progress.cancelled())?;
        Some(Sheet::new(plot, without_costs(curves)))
    };
    let sheets: Option<Vec<_>> = scene.plots.iter().map(sheet).collect();
    let sheets = sheets.ok_or(ExportError::Cancelled)?;
    let encode = |cause| ExportError::Encode { what: "the plots".to_owned(), cause: Box::new(cause) };
    remarks.extend(remarks_on(&scene));
    let bytes = match job.target {
        Target::Csv => csv::plots(&sheets, job.origin()).map_err(encode)?,
        _ => svg::plots(&sheets, job.origin()).into_bytes(),
    };
    Ok(Exported { files: vec![job.main_file(bytes)], remarks })
}

fn remarks_on(scene: &Scene) -> Vec<Remark> {
    let light = |light| Remark::light(light, Fate::Changed, "is in the curves, and cannot be taken out of them again");
    let surface = |surface| Remark::surface(surface, Fate::Changed, "is not in the curves, which have no shadows");
    scene.lights.iter().map(light).chain(scene.surfaces.iter().map(surface)).collect()
}

/// The same curves, with nothing measured in them.
fn without_costs(curves: Curves) -> Curves {
    let series = curves.series.into_iter().map(|series| Series { cost_ns: f64::NAN, ..series });
    Curves { series: series.collect(), ..curves }
}
