//! `softbox fit`: how near punctual lights come to each light of a scene.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;

use super::{Outcome, columns, files, progress};
use crate::light::Light;
use crate::render::Progress;
use crate::shading::fit::{COUNTS, Deviation, Fit, Punctual};

/// Fit points, spots and parallel lights to each light, and report how far they are off its exact illuminance.
///
/// The region is all places in the directions in which a light shines, from 7/8 of its size to eight times that, with
/// surfaces of every normal that sees all of it; of caps and skies, all normals. Errors are in per cent of the greatest
/// illuminance at the same distance, at other places than those that the fit was made for.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// How many lights to fit.
    #[arg(short, long, default_values_t = [1, 2, 4, 8, 16], value_delimiter = ',', value_name = "N,…",
          value_parser = clap::value_parser!(u32).range(i64::from(*COUNTS.start())..=i64::from(*COUNTS.end())))]
    lights: Vec<u32>,
}

/// Fit, and print a table.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let scene = files::load(&args.scene)?;
    let lights: Vec<_> = scene.lights.iter().filter(|light| !light.muted).collect();
    if lights.is_empty() {
        bail!("{}: has no light that shines", args.scene.display());
    }
    let progress = progress::until_interrupted()?;
    let heading = ["light", "shape", "N", "points", "spots", "parallel", "rms %", "worst %", "from m", "to m", "ms"];
    let mut lines = vec![heading.map(String::from)];
    for light in lights {
        for count in &args.lights {
            let Some(rows) = rows(light, *count, &progress) else { return Ok(Outcome::Interrupted) };
            lines.extend(rows);
        }
    }
    write!(std::io::stdout(), "{}", columns::aligned(&lines))?;
    Ok(Outcome::Done)
}

/// A row each part of a light; none when cancelled.
fn rows(light: &Light, count: u32, progress: &Progress) -> Option<Vec<[String; 11]>> {
    let row = |(emitter, _)| {
        let start = Instant::now();
        let fit = Fit::new(&emitter, count, Some(progress.cancelled()))?;
        let taken = start.elapsed();
        let Deviation { rms, worst } = fit.deviation(Some(progress.cancelled()))?;
        let of = |kind: fn(&Punctual) -> bool| fit.lights().iter().filter(|light| kind(light)).count().to_string();
        let [from, to] = fit.region().map_or_else(Default::default, |ends| ends.map(|end| format!("{end:.2}")));
        Some([
            light.name.clone(),
            light.shape.name().to_owned(),
            count.to_string(),
            of(|light| matches!(light, Punctual::Point { .. })),
            of(|light| matches!(light, Punctual::Spot { .. })),
            of(|light| matches!(light, Punctual::Directional { .. })),
            format!("{:.2}", 100.0 * rms),
            format!("{:.2}", 100.0 * worst),
            from,
            to,
            format!("{:.1}", 1e3 * taken.as_secs_f64()),
        ])
    };
    light.parts().into_iter().map(row).collect()
}
