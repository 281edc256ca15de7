//! A picture of a scene, as an export.

use super::{ExportError, Exported, Fate, Job, Remark, Target, exr, png};
use crate::render::{Progress, Settings, Shadows, render};

/// Most rays a pixel.
const SAMPLES: u32 = 16;

/// The picture of the chosen lights and surfaces, with shadows.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, mut remarks) = job.chosen_scene()?;
    let settings =
        Settings { size: job.options.size, choice: job.options.method, samples: SAMPLES, shadows: Shadows::default() };
    let film = render(&scene, &settings, progress).ok_or(ExportError::Cancelled)?;
    let (bytes, what) = match job.target {
        Target::Exr => (
            exr::radiance(film.size(), film.radiance(), job.origin()).map_err(|cause| encoding(job, cause))?,
            "is in the picture, in single precision",
        ),
        _ => (
            png::rgb(film.size(), film.srgb(), job.origin()).map_err(|cause| encoding(job, cause))?,
            "is in the picture, exposed and tone-mapped",
        ),
    };
    remarks.extend(scene.lights.iter().map(|light| Remark::light(light, Fate::Changed, what)));
    remarks.extend(scene.surfaces.iter().map(|surface| Remark::surface(surface, Fate::Changed, what)));
    Ok(Exported { files: vec![job.main_file(bytes)], remarks })
}

fn encoding(job: &Job, cause: impl std::error::Error + Send + Sync + 'static) -> ExportError {
    ExportError::Encode { what: format!("the {} picture", job.target), cause: Box::new(cause) }
}
