//! `softbox verify`: reference cases through the f64 core.

mod cases;
mod table;

use std::path::PathBuf;

use anyhow::Context as _;

use self::cases::{Case, Check, ReferenceFile};
use self::table::{Row, Verdict};
use super::Outcome;
use crate::shading::reference::reference;
use crate::shading::{Method, respond};

/// Judge every method by reference cases.
///
/// Prints a row a file and method. Exact methods must hold 1e-10 of the value (and 50 roundings of the inputs) plus
/// 1e-13 of the scale; the reference must hold its own bound, and that 1e-6 of the value plus 1e-9 of the scale;
/// approximations are only measured. Exit status 1 when a case is out of bounds or a model is not built.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Reference files, JSON of the schema area-light-reference/1.
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
    /// Only files of this model; may be given several times.
    #[arg(long = "model", value_name = "NAME")]
    models: Vec<String>,
}

/// Runs the cases and prints the table.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let mut rows = Vec::new();
    for path in &args.files {
        let file = ReferenceFile::read(path)?;
        if !args.models.is_empty() && !args.models.contains(&file.model) {
            continue;
        }
        rows.extend(judge(&file).with_context(|| path.display().to_string())?);
    }
    if rows.is_empty() {
        anyhow::bail!("none of the files has the model {}", args.models.join(" or "));
    }
    print!("{}", table::render(&rows));
    let passed = rows.iter().all(|row| matches!(row.verdict(), Verdict::Right | Verdict::Measured));
    Ok(if passed { Outcome::Done } else { Outcome::No })
}

/// The rows of a file.
fn judge(file: &ReferenceFile) -> anyhow::Result<Vec<Row>> {
    let mut rows: Vec<Row> = Vec::new();
    for case in &file.cases {
        let Some(checks) = cases::checks(&file.model, case).with_context(|| case.id.clone())? else {
            return Ok(vec![Row::not_built(&file.model)]);
        };
        for check in checks {
            judge_case(case, &check, &mut rows);
        }
    }
    Ok(rows)
}

/// Adds each method's answer to a case to its row.
fn judge_case(case: &Case, check: &Check, rows: &mut Vec<Row>) {
    let (expected, scale) = (check.expected, check.scale);
    for &method in check.methods() {
        let value = check.part.of(&respond(&check.emitter, method, &check.at, &check.lobe)) * check.factor;
        let row = row_of(rows, check.name, &method.to_string());
        if method == Method::Exact {
            let bound = (1e-10 + 50.0 * case.rounding()) * expected.abs() + 1e-13 * scale;
            row.judged(&case.id, value, expected, bound);
        } else {
            row.measured(&case.id, value, expected);
        }
    }
    let estimate = check.part.of_bounded(&reference(&check.emitter, &check.at, &check.lobe)) * check.factor;
    // A bound that is too wide counts like an error that is.
    let allowed = 1e-6 * expected.abs() + 1e-9 * scale;
    let rounding = 50.0 * case.rounding() * expected.abs();
    let bound = if estimate.error <= allowed { estimate.error + rounding } else { 0.0 };
    row_of(rows, check.name, "reference").judged(&case.id, estimate.value, expected, bound);
}

/// The row of a model and a method, made where there is none yet.
fn row_of<'a>(rows: &'a mut Vec<Row>, model: &str, method: &str) -> &'a mut Row {
    let place = rows.iter().position(|row| row.is(model, method)).unwrap_or_else(|| {
        rows.push(Row::new(model, method));
        rows.len() - 1
    });
    &mut rows[place]
}
