//! From which distance a luminaire is as good as a point.

use super::luminaire::Luminaire;
use super::text::rounded_up;
use super::web::{Web, direction};
use crate::render::Progress;

/// Directions of less than this share of the greatest intensity are not looked at: what is nearly dark may be off by any
/// factor at any distance.
pub(super) const FAINTEST: f64 = 0.1;

/// Radii at which the search begins; errors fall at least as 1/d.
const FARTHEST: f64 = 1e3;

/// The distances from which candela/d² is within 1 % and within 5 % of the exact illuminance, metres, from the photometric
/// centre; infinite where none was found.
///
/// The illuminance is that of a surface facing the centre, in directions every 15° of C and 10° of γ (and on the table's
/// planes that are nearest) of at least a tenth of the greatest intensity; the distance is the greatest at which the
/// worst of them misses the bound, to 1 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Field {
    pub(super) within_1: f64,
    pub(super) within_5: f64,
}

impl Field {
    /// None where it was cancelled.
    pub(super) fn of(luminaire: &Luminaire, web: &Web, progress: &Progress) -> Option<Self> {
        let radius = luminaire.radius();
        if radius == 0.0 {
            return Some(Self { within_1: 0.0, within_5: 0.0 });
        }
        let all =
            (0..24).flat_map(|c| (0..=18).map(move |gamma| direction(15.0 * f64::from(c), 10.0 * f64::from(gamma))));
        let seen = all.map(|direction| (direction, luminaire.intensity(direction)));
        let seen: Vec<_> = seen.filter(|(_, candela)| *candela >= FAINTEST * web.peak).collect();
        let misses = |distance: f64, bound: f64| -> Option<bool> {
            if progress.is_cancelled() {
                return None;
            }
            Some(seen.iter().any(|(direction, candela)| {
                let law = candela / (distance * distance);
                (luminaire.illuminance(*direction, distance) / law - 1.0).abs() > bound
            }))
        };
        // Nearer than that may be inside it.
        let within_1 = farthest([radius, FARTHEST * radius], |distance| misses(distance, 0.01))?;
        let within_5 = farthest([radius, within_1.min(FARTHEST * radius)], |distance| misses(distance, 0.05))?;
        Some(Self { within_1, within_5 })
    }

    /// Both, for people.
    pub(super) fn in_words(&self) -> String {
        format!("within 1 % from {} m, within 5 % from {} m", rounded_up(self.within_1), rounded_up(self.within_5))
    }
}

/// The greatest of the distances between two that misses, to 1 %; the nearer one where none does.
fn farthest([near, far]: [f64; 2], misses: impl Fn(f64) -> Option<bool>) -> Option<f64> {
    const STEP: f64 = 1.3;
    if misses(far)? {
        return Some(if far > near { f64::INFINITY } else { far });
    }
    let mut fits = far;
    let mut fails = loop {
        if fits <= near {
            return Some(near);
        }
        let next = (fits / STEP).max(near);
        if misses(next)? {
            break next;
        }
        fits = next;
    };
    while fits > 1.01 * fails {
        let between = (fits * fails).sqrt();
        if misses(between)? {
            fails = between;
        } else {
            fits = between;
        }
    }
    Some(fits)
}
