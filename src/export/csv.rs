//! Tables as CSV, and plots as such, one row a point of a curve.
//!
//! The first line is a comment: gnuplot skips it, and so do pandas' `read_csv(file, comment="#")` and R's `read.csv(file,
//! comment.char = "#")`.

use csv::Writer;

use super::Origin;
use crate::analysis::Sheet;

/// The columns: `method` is the name of a pinned curve, too; `error` is empty for these, and `bound`, the reference's error
/// bound, for all but the reference.
const HEADER: [&str; 6] = ["plot", "x", "method", "y", "error", "bound"];

/// A table under its origin, which is a comment, and the names of its columns.
pub fn headed(columns: impl IntoIterator<Item: AsRef<[u8]>>, origin: Origin) -> csv::Result<Writer<Vec<u8>>> {
    let mut rows = Writer::from_writer(format!("# {}\n", origin.line()).into_bytes());
    rows.write_record(columns)?;
    Ok(rows)
}

/// The curves of plots, each number with the 17 digits that bring it back to the last bit.
///
/// # Errors
///
/// None but what the writer of CSV states.
pub fn plots(sheets: &[Sheet], origin: Origin) -> csv::Result<Vec<u8>> {
    let mut rows = headed(HEADER, origin)?;
    for Sheet { plot, curves, pins, .. } in sheets {
        for series in &curves.series {
            let method = series.method.to_string();
            for (i, x) in curves.x.iter().enumerate() {
                let bound = series.band.as_ref().map_or_else(String::new, |band| number(band[i]));
                let record = [&plot.name, &number(*x), &method, &number(series.y[i]), &number(series.error[i]), &bound];
                rows.write_record(record)?;
            }
        }
        for (_, pin) in pins {
            for (x, y) in pin.x.iter().zip(&pin.y) {
                rows.write_record([&plot.name, &number(*x), &pin.name, &number(*y), "", ""])?;
            }
        }
    }
    rows.into_inner().map_err(|error| error.into_error().into())
}

fn number(value: f64) -> String {
    format!("{value:.16e}")
}
