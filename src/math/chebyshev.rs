//! Chebyshev fits.

use std::f64::consts::PI;

/// A polynomial fit of cosᵐ between 0 and the angle where cosᵐ = ε, and 0 beyond.
///
/// The fit interpolates at the Chebyshev nodes and is kept as powers of t = φ/cut.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §4.1, where the degree is 6 and ε = 1/256.
/// **Accuracy:** with these, within 0.4/256 of cosᵐ for m in 1…1000 and up to the cut (`the_papers_bound_holds`).
#[derive(Clone, Debug, PartialEq)]
pub struct ChebyshevLobe {
    cut: f64,
    coefficients: Vec<f64>,
}

impl ChebyshevLobe {
    /// The degree of [`crate::refs::POULIN_AMANATIDES_1990`].
    pub const DEGREE: usize = 6;
    /// The ε of [`crate::refs::POULIN_AMANATIDES_1990`].
    pub const EPSILON: f64 = 1.0 / 256.0;

    /// Fits cosᵐ with a polynomial of a degree, cut at `epsilon`.
    pub fn new(exponent: f64, degree: usize, epsilon: f64) -> Self {
        let cos_cut = epsilon.powf(exponent.recip());
        let cut = (1.0 - cos_cut * cos_cut).sqrt().atan2(cos_cut);
        let count = degree + 1;
        let node = |j: usize| (PI * (j as f64 + 0.5) / count as f64).cos();
        let samples: Vec<f64> = (0..count).map(|j| (0.5 * cut * (1.0 + node(j))).cos().powf(exponent)).collect();
        let series = (0..count).map(|k| {
            let sum: f64 =
                (0..count).map(|j| samples[j] * (PI * k as f64 * (j as f64 + 0.5) / count as f64).cos()).sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / count as f64
        });
        Self { cut, coefficients: powers_from_chebyshev(series, count) }
    }

    /// The angle beyond which the fit is 0.
    pub fn cut(&self) -> f64 {
        self.cut
    }

    /// Coefficients of the powers of φ/cut, the constant first.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The fit at an angle of either sign.
    pub fn value(&self, phi: f64) -> f64 {
        let t = phi.abs() / self.cut;
        if t > 1.0 { 0.0 } else { self.coefficients.iter().rev().fold(0.0, |sum, c| sum * t + c) }
    }

    /// The mean of the fit over [from, from + length]; its value in the middle for lengths below 1e-4 of the cut.
    pub fn mean(&self, from: f64, length: f64) -> f64 {
        if length < 1e-4 * self.cut {
            return self.value(from + 0.5 * length);
        }
        (self.integral(from + length) - self.integral(from)) / length
    }

    /// The integral of the fit from 0 to an angle, odd in it.
    fn integral(&self, phi: f64) -> f64 {
        let t = (phi.abs() / self.cut).min(1.0);
        let mut order = self.coefficients.len() as f64;
        let mut sum = 0.0;
        for c in self.coefficients.iter().rev() {
            sum = (sum + c / order) * t;
            order -= 1.0;
        }
        (sum * self.cut).copysign(phi)
    }
}

/// Coefficients of the powers of t in [0, 1] from those of the Chebyshev polynomials T_k(2t − 1).
fn powers_from_chebyshev(series: impl Iterator<Item = f64>, count: usize) -> Vec<f64> {
    let mut before = vec![0.0; count];
    let mut polynomial = vec![0.0; count];
    let mut powers = vec![0.0; count];
    for (k, coefficient) in series.enumerate() {
        let next: Vec<f64> = match k {
            0 => (0..count).map(|i| if i == 0 { 1.0 } else { 0.0 }).collect(),
            _ => {
                let factor = if k == 1 { 1.0 } else { 2.0 };
                let shifted = |i: usize| if i == 0 { 0.0 } else { polynomial[i - 1] };
                (0..count).map(|i| factor * (2.0 * shifted(i) - polynomial[i]) - before[i]).collect()
            }
        };
        for (power, term) in powers.iter_mut().zip(&next) {
            *power += coefficient * term;
        }
        before = if k == 0 { vec![0.0; count] } else { polynomial };
        polynomial = next;
    }
    powers
}

#[cfg(test)]
mod tests {
    use super::*;

    fn worst(m: f64, degree: usize, epsilon: f64) -> f64 {
        let lobe = ChebyshevLobe::new(m, degree, epsilon);
        let deviation = |i: i32| {
            let phi = lobe.cut() * f64::from(i) / 2001.0;
            (lobe.value(phi) - phi.cos().powf(m)).abs()
        };
        (0..=2000).map(deviation).fold(0.0, f64::max)
    }

    #[test]
    fn the_papers_bound_holds() {
        for m in [1.0, 1.5, 2.0, 5.0, 10.0, 35.0, 100.0, 333.3, 1000.0] {
            let error = worst(m, ChebyshevLobe::DEGREE, ChebyshevLobe::EPSILON);
            assert!(error <= 0.4 / 256.0, "m = {m}: {error}");
        }
    }

    #[test]
    fn degree_12_serves_a_16_bit_picture() {
        for m in [1.0, 10.0, 100.0, 1000.0] {
            let error = worst(m, 12, 1.0 / 65536.0);
            assert!(error <= 1.0 / 65536.0, "m = {m}: {error}");
        }
    }

    #[test]
    fn means_follow_from_values() {
        let lobe = ChebyshevLobe::new(20.0, 6, 1.0 / 256.0);
        for (from, to) in [(-0.2, 0.4), (0.1, 0.3), (-2.0, 2.0), (0.5, 0.50001), (0.2, 0.200_05)] {
            let count = 200_000;
            let step = (to - from) / f64::from(count);
            let sum: f64 = (0..count).map(|i| lobe.value(from + (f64::from(i) + 0.5) * step)).sum();
            let (mean, expected) = (lobe.mean(from, to - from), sum / f64::from(count));
            assert!((mean - expected).abs() <= 1e-6, "{from}…{to}: {mean} for {expected}");
        }
    }
}
