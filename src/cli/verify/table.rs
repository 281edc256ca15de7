//! The table that `verify` prints.

use crate::cli::columns;

/// How a row came out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verdict {
    /// Every case is within its bound.
    Right,
    /// A case is not.
    Wrong,
    /// An approximation, which is not judged.
    Measured,
    /// The program has no such model.
    NotBuilt,
}

/// A file and a method.
#[derive(Debug)]
pub(super) struct Row {
    model: String,
    method: String,
    count: usize,
    verdict: Verdict,
    squares: f64,
    worst: Worst,
}

/// The case that deviates most: by share of the bound where there is one, else absolutely.
#[derive(Debug, Default)]
struct Worst {
    id: String,
    rank: f64,
    absolute: f64,
    relative: f64,
}

impl Row {
    pub(super) fn new(model: &str, method: &str) -> Self {
        let verdict = Verdict::Measured;
        Self { model: model.into(), method: method.into(), count: 0, verdict, squares: 0.0, worst: Worst::default() }
    }

    pub(super) fn not_built(model: &str) -> Self {
        Self { verdict: Verdict::NotBuilt, ..Self::new(model, "") }
    }

    pub(super) fn is(&self, model: &str, method: &str) -> bool {
        self.model == model && self.method == method
    }

    pub(super) fn verdict(&self) -> Verdict {
        self.verdict
    }

    /// Takes in a value that must be within `bound` of `expected`.
    pub(super) fn judged(&mut self, id: &str, value: f64, expected: f64, bound: f64) {
        let error = (value - expected).abs();
        // Not a number is infinitely wrong; no error needs no bound.
        let share = if error == 0.0 { 0.0 } else { error / bound };
        let share = if share.is_nan() { f64::INFINITY } else { share };
        self.take(id, share, error, expected);
        if share > 1.0 {
            self.verdict = Verdict::Wrong;
        } else if self.verdict == Verdict::Measured {
            self.verdict = Verdict::Right;
        }
    }

    /// Takes in the value of an approximation.
    pub(super) fn measured(&mut self, id: &str, value: f64, expected: f64) {
        let error = (value - expected).abs();
        self.take(id, error, error, expected);
    }

    fn take(&mut self, id: &str, rank: f64, error: f64, expected: f64) {
        self.count += 1;
        self.squares += error * error;
        if self.worst.id.is_empty() || rank > self.worst.rank {
            let relative = if expected == 0.0 { f64::NAN } else { error / expected.abs() };
            self.worst = Worst { id: id.to_owned(), rank, absolute: error, relative };
        }
    }

    fn cells(&self) -> [String; 8] {
        if self.verdict == Verdict::NotBuilt {
            let blank = String::new;
            return [self.model.clone(), blank(), "not built".into(), blank(), blank(), blank(), blank(), blank()];
        }
        let number = |x: f64| if x.is_nan() { "-".to_owned() } else { format!("{x:.1e}") };
        let (verdict, share) = match self.verdict {
            Verdict::Right => ("right", number(self.worst.rank)),
            Verdict::Wrong => ("WRONG", number(self.worst.rank)),
            Verdict::Measured | Verdict::NotBuilt => ("measured", "-".to_owned()),
        };
        let rms = (self.squares / self.count.max(1) as f64).sqrt();
        [
            self.model.clone(),
            self.method.clone(),
            verdict.to_owned(),
            self.count.to_string(),
            share,
            number(rms),
            format!("{} ({})", number(self.worst.absolute), number(self.worst.relative)),
            self.worst.id.clone(),
        ]
    }
}

/// Aligned columns with a heading.
pub(super) fn render(rows: &[Row]) -> String {
    let heading =
        ["model", "method", "verdict", "cases", "of bound", "rms", "worst (relative)", "worst case"].map(String::from);
    let lines: Vec<[String; 8]> = std::iter::once(heading).chain(rows.iter().map(Row::cells)).collect();
    columns::aligned(&lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_out_of_bounds_or_not_a_number_makes_a_row_wrong() {
        for bad in [1.1, f64::NAN, f64::INFINITY] {
            let mut row = Row::new("model", "exact");
            row.judged("fine", 1.0, 1.0, 0.01);
            row.judged("bad", bad, 1.0, 0.01);
            row.judged("fine", 1.001, 1.0, 0.01);
            assert_eq!(row.verdict(), Verdict::Wrong, "{bad}");
            assert!(render(&[row]).contains("bad"), "the worst case is named");
        }
    }
}
