//! `softbox verify`: reference cases through the f64 core, and through the preview's functions on the GPU.

mod cases;
#[cfg(feature = "gpu")]
mod gpu;
#[cfg(not(feature = "gpu"))]
#[path = "verify/no_gpu.rs"]
mod gpu;
mod table;
mod textured;

use std::path::PathBuf;

use anyhow::Context as _;

use self::cases::{Case, Check, ReferenceFile};
use self::gpu::Device;
use self::table::{Row, Verdict};
use super::Outcome;
use crate::shading::Method;

/// Judge every method by reference cases.
///
/// Prints a row a file and method. Exact methods must hold 1e-10 of the value (and 50 roundings of the inputs) plus
/// 1e-13 of the scale; the reference must hold its own bound, and that 1e-6 of the value plus 1e-9 of the scale, and so
/// must textured lights; approximations are only measured. Exit status 1 when a case is out of bounds or a model is not built.
///
/// Rows `exact (gpu)` run the preview's functions on inputs rounded to f32 about p; they must hold 1e-4 of what the f64
/// core makes of the same inputs, plus 1e-6 of the scale. Textured
/// lights have no such row: their layer is held to 1/1024 of its peak by the tests.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Reference files, JSON of the schema area-light-reference/1.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Only files of this model; may be given several times.
    #[arg(long = "model", value_name = "NAME")]
    models: Vec<String>,
    /// Fail where there is no graphics adapter, rather than leave the GPU's rows out.
    #[arg(long)]
    gpu: bool,
    /// Leave the GPU's rows out.
    #[arg(long, conflicts_with = "gpu")]
    no_gpu: bool,
}

/// A check, with its case and the case's name.
type Question<'a> = (&'a str, &'a Case, Check);

/// Runs the cases and prints the table.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let mut files = Vec::new();
    for path in &args.files {
        let file = ReferenceFile::read(path)?;
        if args.models.is_empty() || args.models.contains(&file.model) {
            files.push((path, file));
        }
    }
    if files.is_empty() {
        anyhow::bail!("none of the files has the model {}", args.models.join(" or "));
    }
    let mut asked = Vec::new();
    for (path, file) in &files {
        asked.push(questions(file).with_context(|| path.display().to_string())?);
    }
    let device = if asked.iter().any(Option::is_some) { device(args)? } else { None };
    let mut rows = Vec::new();
    for ((_, file), questions) in files.iter().zip(&asked) {
        let Some(questions) = questions else {
            rows.extend(textured::rows(file)?.unwrap_or_else(|| vec![Row::not_built(&file.model)]));
            continue;
        };
        rows.extend(judge(questions));
        if let Some(device) = &device {
            rows.extend(device.rows(questions)?);
        }
    }
    print!("{}", table::render(&rows));
    let passed = rows.iter().all(|row| matches!(row.verdict(), Verdict::Right | Verdict::Measured));
    Ok(if passed { Outcome::Done } else { Outcome::No })
}

/// The device, unless it is not wanted, or not needed and not there.
fn device(args: &Args) -> anyhow::Result<Option<Device>> {
    if args.no_gpu {
        return Ok(None);
    }
    match Device::new() {
        Ok(device) => Ok(Some(device)),
        Err(error) if args.gpu => Err(error),
        Err(error) => {
            eprintln!("softbox: the GPU's rows are left out: {error}");
            Ok(None)
        }
    }
}

/// What the cases of a file ask; `None` for a model that is not built.
fn questions(file: &ReferenceFile) -> anyhow::Result<Option<Vec<Question<'_>>>> {
    let mut questions = Vec::new();
    for case in &file.cases {
        let Some(checks) = cases::checks(&file.model, case).with_context(|| case.id.clone())? else {
            return Ok(None);
        };
        questions.extend(checks.into_iter().map(|check| (case.id.as_str(), case, check)));
    }
    Ok(Some(questions))
}

/// The rows of the f64 core.
fn judge(questions: &[Question<'_>]) -> Vec<Row> {
    let mut rows = Vec::new();
    for (id, case, check) in questions {
        judge_case(id, case.rounding(), check, &mut rows);
    }
    rows
}

/// Adds each method's answer to its row.
fn judge_case(id: &str, rounding: f64, check: &Check, rows: &mut Vec<Row>) {
    let (expected, scale) = (check.expected, check.scale);
    let rounding = 50.0 * rounding * expected.abs();
    for &method in check.methods() {
        let value = check.value(method);
        let row = row_of(rows, check.name, &method.to_string());
        if method == Method::Exact {
            row.judged(id, value, expected, 1e-10 * expected.abs() + rounding + 1e-13 * scale);
        } else {
            row.measured(id, value, expected);
        }
    }
    let estimate = check.estimate();
    // A bound that is too wide counts like an error that is.
    let allowed = 1e-6 * expected.abs() + 1e-9 * scale;
    let bound = if estimate.error <= allowed { estimate.error + rounding } else { 0.0 };
    row_of(rows, check.name, "reference").judged(id, estimate.value, expected, bound);
}

/// The row of a model and a method, made where there is none yet.
fn row_of<'a>(rows: &'a mut Vec<Row>, model: &str, method: &str) -> &'a mut Row {
    let place = rows.iter().position(|row| row.is(model, method)).unwrap_or_else(|| {
        rows.push(Row::new(model, method));
        rows.len() - 1
    });
    &mut rows[place]
}
