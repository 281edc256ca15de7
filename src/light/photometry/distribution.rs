//! Intensities over all directions, by C-planes.

use std::f64::consts::{PI, TAU};
use std::fmt;

use glam::DVec3;

/// Intensities of type C, bilinear between the angles of a table, as shares of the greatest.
///
/// γ is measured from nadir, −Z; C from +X towards +Y. Beyond the first and the last γ it is dark.
#[derive(Clone)]
pub struct Distribution {
    /// Increasing within [0, π].
    gammas: Vec<f64>,
    /// Increasing from 0, and 2π at the end; of a rotational symmetry, 0 alone.
    planes: Vec<f64>,
    /// By planes, each from the first γ to the last.
    shares: Vec<f64>,
    /// The greatest intensity, cd.
    peak: f64,
    /// Φ/I, I the greatest intensity, sr.
    flux_per_peak: f64,
}

impl fmt::Debug for Distribution {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Distribution({} x {}, {} cd)", self.planes.len(), self.gammas.len(), self.peak)
    }
}

impl PartialEq for Distribution {
    /// Number by number, but for copies that share them.
    fn eq(&self, other: &Self) -> bool {
        fn numbers(of: &Distribution) -> (f64, [&[f64]; 3]) {
            (of.peak, [&of.gammas, &of.planes, &of.shares])
        }
        std::ptr::eq(self, other) || numbers(self) == numbers(other)
    }
}

impl Distribution {
    /// The same in all directions, 1 cd.
    pub fn isotropic() -> Self {
        Self { gammas: vec![0.0, PI], planes: vec![0.0], shares: vec![1.0; 2], peak: 1.0, flux_per_peak: 4.0 * PI }
    }

    /// Of a table of candela by planes, with angles in degrees: γ increasing within [0, 180]; C increasing from 0 to
    /// 360, or 0 alone. `None` where they are not so, or a value is negative or not finite, or all are 0.
    pub fn of_table(gammas_deg: &[f64], planes_deg: &[f64], candela: &[f64]) -> Option<Self> {
        let increasing = |angles: &[f64]| angles.windows(2).all(|pair| pair[0] < pair[1]);
        let gammas_fit = *gammas_deg.first()? >= 0.0 && *gammas_deg.last()? <= 180.0 && increasing(gammas_deg);
        let round = planes_deg.len() > 1;
        let planes_fit = *planes_deg.first()? == 0.0 && (!round || *planes_deg.last()? == 360.0);
        let sound = candela.iter().all(|value| value.is_finite() && *value >= 0.0);
        let peak = candela.iter().copied().fold(0.0, f64::max);
        let fits = gammas_fit && planes_fit && increasing(planes_deg) && sound && peak > 0.0;
        if !fits || candela.len() != gammas_deg.len() * planes_deg.len() {
            return None;
        }
        let radians = |angles: &[f64]| angles.iter().map(|angle| angle.to_radians()).collect();
        let shares = candela.iter().map(|value| value / peak).collect();
        let mut of_table =
            Self { gammas: radians(gammas_deg), planes: radians(planes_deg), shares, peak, flux_per_peak: 0.0 };
        of_table.flux_per_peak = of_table.flux();
        Some(of_table)
    }

    /// The angles γ of the table, radians.
    pub fn gammas(&self) -> &[f64] {
        &self.gammas
    }

    /// The angles C of the table's planes, radians.
    pub fn planes(&self) -> &[f64] {
        &self.planes
    }

    /// The table: shares of the greatest intensity, by planes.
    pub fn shares(&self) -> &[f64] {
        &self.shares
    }

    /// The greatest intensity, cd.
    pub fn peak(&self) -> f64 {
        self.peak
    }

    /// Φ/I, I the greatest intensity, sr.
    pub fn flux_per_peak(&self) -> f64 {
        self.flux_per_peak
    }

    /// The share of the greatest intensity in a direction of any length, in the light's frame.
    pub fn share(&self, direction: DVec3) -> f64 {
        let gamma = direction.x.hypot(direction.y).atan2(-direction.z);
        let c = direction.y.atan2(direction.x);
        self.share_at(if c < 0.0 { c + TAU } else { c }, gamma)
    }

    /// The share at C from 0 to 2π and γ from 0 to π.
    pub fn share_at(&self, c: f64, gamma: f64) -> f64 {
        let (first, last) = (self.gammas[0], self.gammas[self.gammas.len() - 1]);
        if gamma < first || gamma > last {
            return 0.0;
        }
        let (row, along) = place(&self.gammas, gamma);
        let (plane, across) = place(&self.planes, c);
        let of_plane = |plane: usize| {
            let shares = &self.shares[plane * self.gammas.len()..][..self.gammas.len()];
            mixed(shares[row], shares[(row + 1).min(shares.len() - 1)], along)
        };
        mixed(of_plane(plane), of_plane((plane + 1).min(self.planes.len() - 1)), across)
    }

    /// ∫ share dω, by pieces in which it is linear in γ: ∫ (a + bγ) sin γ dγ = b sin γ − (a + bγ) cos γ.
    fn flux(&self) -> f64 {
        let mean = |row: usize| {
            let at = |plane: usize| self.shares[plane * self.gammas.len() + row];
            if self.planes.len() == 1 {
                return at(0);
            }
            let pieces = self.planes.windows(2).enumerate();
            pieces.map(|(i, pair)| (pair[1] - pair[0]) * 0.5 * (at(i) + at(i + 1))).sum::<f64>() / TAU
        };
        let pieces = self.gammas.windows(2).enumerate().map(|(i, pair)| {
            let (low, high) = (mean(i), mean(i + 1));
            let slope = (high - low) / (pair[1] - pair[0]);
            slope * (pair[1].sin() - pair[0].sin()) + low * pair[0].cos() - high * pair[1].cos()
        });
        TAU * pieces.sum::<f64>().max(0.0)
    }
}

/// The piece between two of increasing `angles` that an angle is in, and its share of that piece.
pub(super) fn place(angles: &[f64], angle: f64) -> (usize, f64) {
    let last = angles.len().saturating_sub(2);
    let i = angles.partition_point(|at| *at <= angle).saturating_sub(1).min(last);
    match angles.get(i + 1) {
        Some(next) => (i, ((angle - angles[i]) / (next - angles[i])).clamp(0.0, 1.0)),
        None => (i, 0.0),
    }
}

/// Between a and b, both included.
pub(super) fn mixed(a: f64, b: f64, share: f64) -> f64 {
    (1.0 - share) * a + share * b
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two different sides: 3 cd at C = 0 and 1 cd at C = 180.
    fn lopsided() -> Distribution {
        let candela = [2.0, 3.0, 0.0, 2.0, 2.0, 0.0, 2.0, 1.0, 0.0, 2.0, 2.0, 0.0, 2.0, 3.0, 0.0];
        Distribution::of_table(&[0.0, 45.0, 90.0], &[0.0, 90.0, 180.0, 270.0, 360.0], &candela).expect("a table")
    }

    #[test]
    fn a_direction_is_met_at_its_plane_and_its_angle_from_nadir() {
        let lopsided = lopsided();
        let candela = |x: f64, y: f64, z: f64| 3.0 * lopsided.share(DVec3::new(x, y, z));
        for (direction, expected) in [
            ((0.0, 0.0, -5.0), 2.0),
            ((1.0, 0.0, -1.0), 3.0),
            ((-2.0, 0.0, -2.0), 1.0),
            ((0.0, 1.0, -1.0), 2.0),
            ((1.0, 0.0, 0.0), 0.0),
            ((1.0, 0.0, 0.1), 0.0),
            ((1.0, 1.0, -2.0_f64.sqrt()), 2.5),
            ((1.0, -1.0, -2.0_f64.sqrt()), 2.5),
        ] {
            let got = candela(direction.0, direction.1, direction.2);
            assert!((got - expected).abs() < 1e-14, "{got} cd towards {direction:?}, not {expected}");
        }
    }

    #[test]
    fn the_flux_is_the_integral_of_what_is_between_the_angles() {
        let lopsided = lopsided();
        let steps = 2000;
        let mut sum = 0.0;
        for i in 0..steps {
            let gamma = (i as f64 + 0.5) / steps as f64 * 0.5 * PI;
            for j in 0..40 {
                let c = (j as f64 + 0.5) / 40.0 * TAU;
                sum += lopsided.share_at(c, gamma) * gamma.sin();
            }
        }
        let expected = sum * (0.5 * PI / steps as f64) * (TAU / 40.0);
        let flux = lopsided.flux_per_peak();
        assert!((flux / expected - 1.0).abs() < 1e-6, "{flux} sr, not {expected}");
        let even = Distribution::of_table(&[0.0, 30.0, 180.0], &[0.0], &[7.0; 3]).expect("a table");
        assert!((even.flux_per_peak() / (4.0 * PI) - 1.0).abs() < 1e-15, "{} sr all around", even.flux_per_peak());
        assert_eq!(even.peak(), 7.0, "its greatest");
    }

    #[test]
    fn what_is_no_table_is_none() {
        let of_table = Distribution::of_table;
        assert!(of_table(&[0.0, 90.0], &[0.0], &[0.0, 0.0]).is_none(), "black");
        assert!(of_table(&[0.0, 90.0], &[0.0], &[1.0, f64::NAN]).is_none(), "no number");
        assert!(of_table(&[0.0, 90.0], &[0.0, 180.0], &[1.0; 4]).is_none(), "half a turn");
        assert!(of_table(&[90.0, 0.0], &[0.0], &[1.0; 2]).is_none(), "falling angles");
        assert!(of_table(&[0.0, 90.0], &[0.0], &[1.0; 3]).is_none(), "a value too many");
        assert!(of_table(&[], &[0.0], &[]).is_none(), "nothing");
    }
}
