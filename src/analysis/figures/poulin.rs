//! The degree that [`crate::refs::POULIN_AMANATIDES_1990`], §4.1, fits lobes with.

use crate::analysis::chart::Table;
use crate::math::chebyshev::fit_error;

/// Exponents of the table.
const EXPONENTS: [f64; 10] = [1.0, 5.0, 10.0, 16.0, 35.0, 64.0, 100.0, 200.0, 500.0, 1000.0];

/// Levels of intensity: the lobe is cut where it is below one of them, and the fit is to be within one.
const LEVELS: [u32; 3] = [256, 1024, 65_536];

/// The highest degree that is tried.
const MOST: u32 = 24;

/// By exponent: how far the paper's degree 6 is off, and the least degree that is within 1/256, 1/1024 and 1/65536.
pub fn chebyshev_degrees() -> Table {
    let heading =
        ["exponent", "error_of_6_x_256", "integral_error_of_6_percent", "degree_256", "degree_1024", "degree_65536"];
    let row = |m: f64| {
        let papers = fit_error(m, 6, 256);
        let figures =
            [format!("{m}"), format!("{:.3}", 256.0 * papers.value), format!("{:.3}", 100.0 * papers.integral)];
        let degrees =
            LEVELS.map(|levels| least_degree(m, levels).map_or_else(String::new, |degree| degree.to_string()));
        figures.into_iter().chain(degrees).collect()
    };
    Table { heading: heading.map(String::from).into(), rows: EXPONENTS.into_iter().map(row).collect() }
}

/// The least degree whose fit is within one level.
fn least_degree(m: f64, levels: u32) -> Option<u32> {
    (1..=MOST).find(|degree| fit_error(m, *degree, levels).value <= f64::from(levels).recip())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn degree_6_is_within_the_papers_bound_and_finer_levels_need_more() {
        let table = chebyshev_degrees();
        for row in &table.rows {
            let numbers: Vec<f64> = row.iter().map(|cell| cell.parse().unwrap()).collect();
            let [_, error, integral, degrees @ ..] = &numbers[..] else { panic!("{row:?}") };
            assert!(*error <= 1.0 && *integral <= 1.0, "{row:?}");
            assert!(degrees[0] <= 6.0 && degrees.is_sorted() && degrees[2] <= 12.0, "{row:?}");
        }
        let degree = |exponent: &str| table.rows.iter().find(|row| row[0] == exponent).unwrap()[3].clone();
        assert_eq!([degree("16"), degree("35")], ["4", "6"], "degree 5 is not enough at 35");
    }
}
