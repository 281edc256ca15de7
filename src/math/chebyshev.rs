//! Chebyshev fits.

use std::f64::consts::PI;
use std::sync::OnceLock;

/// A polynomial fit of cosᵐ between 0 and the angle where cosᵐ = ε, and 0 beyond.
///
/// The fit is the lobe's Chebyshev series, cut off after the degree, and is kept as powers of x = 2φ/cut − 1, which do
/// not cancel.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §4.1, where the degree is 6 and ε = 1/256.
/// **Accuracy:** with these, at most 0.29/256 from cosᵐ for m in 1…1000 and up to the cut, and its integral within
/// 0.1 % of the whole lobe's (`the_papers_bound_holds`).
#[derive(Clone, Debug, PartialEq)]
pub struct ChebyshevLobe {
    cut: f64,
    coefficients: Vec<f64>,
    mean_coefficients: Vec<f64>,
}

impl ChebyshevLobe {
    /// Fits cosᵐ with a polynomial of a degree, cut where it falls below one of `levels` grey levels: ε = 1/levels.
    pub fn new(exponent: f64, degree: u32, levels: u32) -> Self {
        let cos_cut = f64::from(levels.max(2)).powf(-exponent.recip());
        let cut = (1.0 - cos_cut * cos_cut).sqrt().atan2(cos_cut);
        let count = degree as usize + 1;
        let nodes = 2 * count + 32;
        let angle = |j: usize| PI * (j as f64 + 0.5) / nodes as f64;
        let samples: Vec<f64> = (0..nodes).map(|j| (0.5 * cut * (1.0 + angle(j).cos())).cos().powf(exponent)).collect();
        let series = (0..count).map(|k| {
            let sum: f64 = samples.iter().enumerate().map(|(j, sample)| sample * (k as f64 * angle(j)).cos()).sum();
            sum * if k == 0 { 1.0 } else { 2.0 } / nodes as f64
        });
        let coefficients = powers_from_chebyshev(series, count);
        Self { cut, mean_coefficients: mean_from_start(&coefficients), coefficients }
    }

    /// The angle beyond which the fit is 0.
    pub fn cut(&self) -> f64 {
        self.cut
    }

    /// Coefficients of the powers of x, the constant first.
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// As [`Self::coefficients`], of the fit's mean between 0 and φ.
    pub fn mean_coefficients(&self) -> &[f64] {
        &self.mean_coefficients
    }

    /// The fit at an angle of either sign.
    pub fn value(&self, phi: f64) -> f64 {
        let t = phi.abs() / self.cut;
        if t > 1.0 { 0.0 } else { polynomial(&self.coefficients, 2.0 * t - 1.0) }
    }

    /// The integral of the fit from 0 to an angle, odd in it.
    pub fn integral(&self, phi: f64) -> f64 {
        let t = (phi.abs() / self.cut).min(1.0);
        (self.cut * t * polynomial(&self.mean_coefficients, 2.0 * t - 1.0)).copysign(phi)
    }
}

/// The fits of one exponent, each made when it is first asked for and then kept.
#[derive(Clone, Debug, Default)]
pub struct Fits(OnceLock<Box<Kept>>);

#[derive(Clone, Debug)]
struct Kept {
    degree: u32,
    levels: u32,
    fit: ChebyshevLobe,
    others: Fits,
}

impl Fits {
    /// The fit of that degree and cut; the exponent must be the same each time.
    pub fn get(&self, exponent: f64, degree: u32, levels: u32) -> &ChebyshevLobe {
        let make = || {
            let fit = ChebyshevLobe::new(exponent, degree, levels);
            Box::new(Kept { degree, levels, fit, others: Self::default() })
        };
        let kept = self.0.get_or_init(make);
        if (kept.degree, kept.levels) == (degree, levels) {
            &kept.fit
        } else {
            kept.others.get(exponent, degree, levels)
        }
    }
}

/// What is kept follows from the exponent.
impl PartialEq for Fits {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

fn polynomial(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}

/// Coefficients of the powers of x from those of the Chebyshev polynomials T_k(x).
fn powers_from_chebyshev(series: impl Iterator<Item = f64>, count: usize) -> Vec<f64> {
    let mut before = vec![0.0; count];
    let mut polynomial = vec![0.0; count];
    let mut powers = vec![0.0; count];
    for (k, coefficient) in series.enumerate() {
        // T₀ = 1, T₁ = x, T_k = 2x T_{k−1} − T_{k−2}.
        let next: Vec<f64> = (0..count)
            .map(|i| match k {
                0 => f64::from(u8::from(i == 0)),
                1 => f64::from(u8::from(i == 1)),
                _ => 2.0 * if i == 0 { 0.0 } else { polynomial[i - 1] } - before[i],
            })
            .collect();
        for (power, term) in powers.iter_mut().zip(&next) {
            *power += coefficient * term;
        }
        before = std::mem::replace(&mut polynomial, next);
    }
    powers
}

/// ∫₋₁ˣ f/(x + 1), by dividing the antiderivative that is 0 at −1.
fn mean_from_start(coefficients: &[f64]) -> Vec<f64> {
    let mut mean = vec![0.0; coefficients.len()];
    let mut above = 0.0;
    for (k, coefficient) in coefficients.iter().enumerate().rev() {
        above = coefficient / (k as f64 + 1.0) - above;
        mean[k] = above;
    }
    mean
}

/// How far a fit is from cosᵐ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitError {
    /// The most, up to the cut.
    pub value: f64,
    /// Of the integral between 0 and any angle to π/2, as a share of the whole lobe's.
    pub integral: f64,
}

/// The error of the fit of a degree for an exponent, found by a scan of 2000 angles.
///
/// [`crate::refs::POULIN_AMANATIDES_1990`], §4.1, claims 1/256 for degree 6 and 256 levels.
pub fn fit_error(exponent: f64, degree: u32, levels: u32) -> FitError {
    const STEPS: u32 = 2000;
    let fit = ChebyshevLobe::new(exponent, degree, levels);
    let value = (0..=STEPS)
        .map(|i| fit.cut() * (1.0 - 1e-12) * f64::from(i) / f64::from(STEPS))
        .map(|phi| (fit.value(phi) - phi.cos().powf(exponent)).abs())
        .fold(0.0, f64::max);
    // By Simpson's rule in steps that follow the lobe's width.
    let step = (4.0 * fit.cut()).min(0.5 * PI) / f64::from(STEPS);
    let (mut exact, mut off) = (0.0, 0.0_f64);
    for i in 0..STEPS {
        let power = |part: f64| (step * (f64::from(i) + part)).cos().max(0.0).powf(exponent);
        exact += step / 6.0 * (power(0.0) + 4.0 * power(0.5) + power(1.0));
        off = off.max((fit.integral(step * (f64::from(i) + 1.0)) - exact).abs());
    }
    FitError { value, integral: off / exact }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXPONENTS: [f64; 10] = [1.0, 1.5, 2.0, 5.0, 10.0, 35.0, 100.0, 333.3, 700.0, 1000.0];

    #[test]
    fn the_papers_bound_holds() {
        let errors = EXPONENTS.map(|m| fit_error(m, 6, 256));
        let value = errors.iter().map(|error| 256.0 * error.value).fold(0.0, f64::max);
        let integral = errors.iter().map(|error| error.integral).fold(0.0, f64::max);
        assert!(value <= 0.291, "{value}/256");
        assert!(integral <= 1e-3, "{integral} of the lobe's integral");
    }

    #[test]
    fn fits_are_kept() {
        let fits = Fits::default();
        let degrees = [6, 12, 6, 3, 12].map(|degree| fits.get(20.0, degree, 256));
        assert!(std::ptr::eq(degrees[0], degrees[2]) && std::ptr::eq(degrees[1], degrees[4]), "the same ones");
        assert_eq!(degrees.map(|fit| fit.coefficients().len()), [7, 13, 7, 4, 13], "of the degrees asked for");
    }

    /// Whether a degree serves a picture of so many levels.
    fn serves(m: f64, degree: u32, levels: u32) -> bool {
        fit_error(m, degree, levels).value <= f64::from(levels).recip()
    }

    #[test]
    fn less_than_the_papers_degree_does_not_do() {
        assert!(serves(34.0, 5, 256) && !serves(35.0, 5, 256), "degree 5 fails from m = 35");
        assert!(serves(5.0, 6, 1024) && !serves(14.0, 6, 1024), "degree 6 fails at 1/1024 from between m = 5 and 14");
        for m in EXPONENTS {
            assert!(serves(m, 7, 1024), "degree 7 serves 1024 levels at m = {m}");
            // A low real power has no smooth end at π/2, where so many levels still see it.
            assert_eq!(serves(m, 12, 65536), m != 1.5, "degree 12 serves 65536 levels at m = {m}");
        }
        assert!(!serves(1000.0, 11, 65536), "degree 11 does not");
    }

    #[test]
    fn integrals_follow_from_values() {
        let fit = ChebyshevLobe::new(20.0, 6, 256);
        for (from, to) in [(-0.2, 0.4), (0.1, 0.3), (-2.0, 2.0), (0.5, 0.50001), (0.2, 0.200_05)] {
            let count = 200_000;
            let step = (to - from) / f64::from(count);
            let expected = step * (0..count).map(|i| fit.value(from + (f64::from(i) + 0.5) * step)).sum::<f64>();
            let integral = fit.integral(to) - fit.integral(from);
            assert!((integral - expected).abs() <= 1e-6 * (to - from), "{from}…{to}: {integral} for {expected}");
        }
    }
}
