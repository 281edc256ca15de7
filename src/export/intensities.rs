//! Measured intensities on even angles, for programs that interpolate between them in their own way.

use crate::light::photometry::Distribution;

/// The widest steps from nadir and about it, in degrees.
const WIDEST: [f64; 2] = [1.0, 2.5];

/// The most steps of a turn.
const MOST_STEPS: f64 = 720.0;

/// Shares of the greatest intensity on even angles. Steps are narrow enough to meet the angles that they come from where
/// those are even themselves.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Intensities {
    /// From nadir, in degrees, from where it is not dark any more to where it is again.
    pub(super) gammas: Vec<f64>,
    /// About nadir from +X, in degrees: a whole turn, or 0 alone.
    pub(super) planes: Vec<f64>,
    /// By planes.
    pub(super) shares: Vec<f64>,
}

impl Intensities {
    /// Those of a photometric file.
    pub(super) fn of(distribution: &Distribution) -> Self {
        let gammas = even(distribution.gammas(), WIDEST[0]);
        let planes = even(distribution.planes(), WIDEST[1]);
        let shares = planes.iter().flat_map(|c| gammas.iter().map(|gamma| distribution.share_at(*c, *gamma))).collect();
        let degrees = |angles: Vec<f64>| angles.into_iter().map(f64::to_degrees).collect();
        Self { gammas: degrees(gammas), planes: degrees(planes), shares }
    }
}

/// Even steps from the first of increasing angles to the last, in radians, at most `widest` degrees apart.
fn even(angles: &[f64], widest: f64) -> Vec<f64> {
    let (first, last) = (angles[0], angles[angles.len() - 1]);
    let closest = angles.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    if !closest.is_finite() {
        return vec![first];
    }
    let between = (closest.to_degrees() / widest - 1e-9).ceil().max(1.0);
    let steps = ((last - first) / closest * between).round().clamp(1.0, MOST_STEPS);
    let at = |i: u32| if f64::from(i) < steps { first + (last - first) * f64::from(i) / steps } else { last };
    (0..).take_while(|i| f64::from(*i) <= steps).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_angles_are_met_and_others_are_between() {
        let degrees = |angles: &[f64]| even(&angles.iter().map(|a| a.to_radians()).collect::<Vec<_>>(), 1.0).len();
        assert_eq!(degrees(&[0.0, 2.5, 5.0, 7.5]), 10, "three steps each");
        assert_eq!(degrees(&[0.0, 30.0, 90.0]), 91, "a degree each");
        assert_eq!(degrees(&[0.0, 0.5, 90.0]), 181, "half a degree each");
        assert_eq!(degrees(&[0.0, 1e-3, 180.0]), 721, "no more");
        assert_eq!(degrees(&[0.0]), 1, "one alone");
    }

    #[test]
    fn the_table_comes_back() {
        let candela = [2.0, 3.0, 0.0, 2.0, 2.0, 1.0, 2.0, 1.0, 0.0];
        let distribution = Distribution::of_table(&[0.0, 45.0, 90.0], &[0.0, 90.0, 360.0], &candela).expect("a table");
        let Intensities { gammas, planes, shares } = Intensities::of(&distribution);
        assert_eq!([gammas.len(), planes.len(), shares.len()], [91, 145, 91 * 145], "counts");
        for (c, gamma, expected) in [(0, 45, 1.0), (36, 90, 1.0 / 3.0), (0, 0, 2.0 / 3.0), (144, 45, 1.0 / 3.0)] {
            let found = shares[c * 91 + gamma];
            assert!((found - expected).abs() < 1e-12, "{found} at {} and {}", planes[c], gammas[gamma]);
        }
    }
}
