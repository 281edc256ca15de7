//! `softbox report`: what each method of each light gets wrong, and what it costs.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, bail};

use super::shadows::ShadowArgs;
use super::{Outcome, columns, files, progress};
use crate::analysis::{Deviation, Entry, Ground, report, subjects};

/// Most points on the ground.
const MAX_POINTS: u32 = 1 << 20;

/// Report, for each light and method, RMS and worst error over the ground, and the cost of a point.
///
/// The ground is the scene's first plane, or z = 0, as far as the camera sees it, or near the lights where it sees too
/// little. Errors are against exact, for each light alone, with the shadows that it casts; percentages are of the light's greatest
/// exact value there. E is illuminance, S the specular luminance for k_s = 1. Costs are of diffuse and specular
/// together on one thread: the fastest of several runs, in ns and as a multiple of a point light's in the same runs.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene file.
    scene: PathBuf,
    /// Print CSV with 17 digits in place of the table.
    #[arg(long)]
    csv: bool,
    /// Most points on the ground.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=i64::from(MAX_POINTS)))]
    points: u32,
    #[command(flatten)]
    shadows: ShadowArgs,
}

/// Measure, and print it all.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let scene = files::load(&args.scene)?;
    let file = args.scene.display();
    let steps: usize = subjects(&scene).iter().map(|(_, methods)| methods.len()).sum();
    if steps == 0 {
        bail!("{file}: has no light that shines");
    }
    let ground = Ground::new(&scene, args.points as usize);
    let ground = ground.with_context(|| format!("{file}: has no material for the ground"))?;
    let progress = progress::until_interrupted()?;
    let Some(entries) =
        progress::with_bar(steps as u64, &progress, || report(&scene, &ground, args.shadows.shadows(), &progress))
    else {
        return Ok(Outcome::Interrupted);
    };
    let text = if args.csv { csv(&entries)? } else { format!("Ground: {ground}.\n\n{}", table(&entries)) };
    write!(std::io::stdout(), "{text}")?;
    Ok(Outcome::Done)
}

/// Columns for people.
fn table(entries: &[Entry]) -> String {
    let heading = [
        "light",
        "method",
        "E rms lx",
        "%",
        "E worst lx",
        "%",
        "at x, y, z",
        "S rms cd/m²",
        "%",
        "S worst cd/m²",
        "%",
        "at x, y, z",
        "ns",
        "x point",
    ];
    let lines = entries.iter().map(|entry| {
        let [e, s] = [entry.diffuse, entry.specular].map(cells);
        let costs = [format!("{:.0}", entry.cost_ns), format!("{:.1}", entry.cost_in_point_lights)];
        let mut cells = [entry.light.clone(), entry.method.to_string()].into_iter().chain(e).chain(s).chain(costs);
        std::array::from_fn(|_| cells.next().unwrap_or_default())
    });
    columns::aligned::<14>(&std::iter::once(heading.map(String::from)).chain(lines).collect::<Vec<_>>())
}

/// RMS and worst error, each with its percentage, and where the worst is; nothing where there is no error.
fn cells(deviation: Deviation) -> [String; 5] {
    if deviation.worst == 0.0 {
        return ["0", "", "0", "", ""].map(String::from);
    }
    let [rms, worst] = deviation.relative().map(|share| columns::percent(100.0 * share));
    let at = deviation.at.to_array().map(|x| format!("{x:.2}")).join(", ");
    [format!("{:.2e}", deviation.rms), rms, format!("{:+.2e}", deviation.worst), worst, at]
}

/// Columns for programs.
fn csv(entries: &[Entry]) -> anyhow::Result<String> {
    let mut rows = csv::Writer::from_writer(Vec::new());
    let quantity = |name: &str| {
        ["peak", "rms", "rms_relative", "worst", "worst_relative", "worst_x", "worst_y", "worst_z"]
            .map(|column| format!("{name}_{column}"))
    };
    let names = ["light", "shape", "method"].map(String::from).into_iter();
    let costs = ["cost_ns", "cost_in_point_lights"].map(String::from);
    rows.write_record(names.chain(quantity("diffuse")).chain(quantity("specular")).chain(costs))?;
    for entry in entries {
        let numbers = |deviation: Deviation| {
            let [rms, worst] = deviation.relative();
            let [x, y, z] = deviation.at.to_array();
            [deviation.peak, deviation.rms, rms, deviation.worst, worst, x, y, z]
        };
        let names = [entry.light.clone(), entry.shape.to_owned(), entry.method.to_string()].into_iter();
        let costs = [entry.cost_ns, entry.cost_in_point_lights];
        let numbers = numbers(entry.diffuse).into_iter().chain(numbers(entry.specular)).chain(costs);
        rows.write_record(names.chain(numbers.map(|number| format!("{number:.16e}"))))?;
    }
    Ok(String::from_utf8(rows.into_inner().map_err(csv::IntoInnerError::into_error)?)?)
}
