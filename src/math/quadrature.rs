//! Numerical integration: fixed Gauss–Legendre rules, and adaptive Gauss–Kronrod with an error bound.

use std::collections::BinaryHeap;
use std::f64::consts::PI;
use std::ops::{Add, Mul};

/// Nodes and weights on [−1, 1] that integrate polynomials of degree 2N − 1 exactly.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    nodes: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// The rule of `order` nodes, by Newton's iteration on the Legendre polynomial.
    pub fn new(order: usize) -> Self {
        let nodes = (0..order)
            .map(|i| {
                // Tricomi's first guess is good enough for Newton to reach rounding in a few steps.
                let mut x = (PI * (i as f64 + 0.75) / (order as f64 + 0.5)).cos();
                for _ in 0..8 {
                    let (value, slope) = legendre(order, x);
                    x -= value / slope;
                }
                let (_, slope) = legendre(order, x);
                (x, 2.0 / ((1.0 - x * x) * slope * slope))
            })
            .collect();
        Self { nodes }
    }

    /// The (node, weight) pairs on [−1, 1].
    pub fn nodes(&self) -> &[(f64, f64)] {
        &self.nodes
    }

    /// ∫ f over [lo, hi].
    pub fn integrate(&self, lo: f64, hi: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
        let (middle, half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
        half * self.nodes.iter().map(|(x, weight)| weight * f(middle + half * x)).sum::<f64>()
    }
}

/// The Legendre polynomial of a degree ≥ 1 and its derivative at x in (−1, 1).
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=degree {
        let k = k as f64;
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, degree as f64 * (x * value - before) / (x * x - 1.0))
}

/// A number and a bound on how far it may be from the truth.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Estimate {
    /// The number.
    pub value: f64,
    /// |value − truth| is no more than this.
    pub error: f64,
}

impl Estimate {
    /// A number known to rounding.
    pub fn rounded(value: f64) -> Self {
        Self { value, error: 4.0 * f64::EPSILON * value.abs() }
    }
}

impl Add for Estimate {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, error: self.error + other.error }
    }
}

impl Mul<f64> for Estimate {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self { value: self.value * factor, error: self.error * factor.abs() }
    }
}

/// When adaptive integration stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Error sought, relative to the integral.
    pub relative: f64,
    /// Error that is small enough whatever the integral.
    pub absolute: f64,
    /// The integration stops after so many panels of 15 nodes, with whatever error is then left.
    pub panels: usize,
}

/// Positive abscissae of the 15-point Kronrod rule; every second one, from the second, belongs to the 7-point Gauss rule.
const KRONROD_NODES: [f64; 7] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
];
const KRONROD_WEIGHTS: [f64; 7] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_92,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
];
const KRONROD_MIDDLE: f64 = 0.209_482_141_084_727_82;
const GAUSS_WEIGHTS: [f64; 3] = [0.129_484_966_168_869_7, 0.279_705_391_489_276_64, 0.381_830_050_505_118_9];
const GAUSS_MIDDLE: f64 = 0.417_959_183_673_469_4;

/// Both rules may be off the same way, most of all at a kink: the bound is that many times their distance.
const CAUTION: f64 = 10.0;

/// A panel of the adaptive integration, ordered by its error.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Panel {
    lo: f64,
    hi: f64,
    estimate: Estimate,
    /// The part of the error that splitting can remove.
    removable: f64,
}

impl Eq for Panel {}

impl Ord for Panel {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.removable.total_cmp(&other.removable)
    }
}

impl PartialOrd for Panel {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// The 15-point Kronrod estimate of ∫ f over [lo, hi].
///
/// Its error is [`CAUTION`] times the distance from the embedded 7-point Gauss rule, plus the integral of f's own errors and the rounding of the sum.
fn panel(lo: f64, hi: f64, f: &mut impl FnMut(f64) -> Estimate) -> Panel {
    let (middle, half) = (0.5 * (lo + hi), 0.5 * (hi - lo));
    let centre = f(middle);
    let mut kronrod = KRONROD_MIDDLE * centre.value;
    let mut gauss = GAUSS_MIDDLE * centre.value;
    let mut size = KRONROD_MIDDLE * centre.value.abs();
    let mut inherited = KRONROD_MIDDLE * centre.error;
    for (i, (node, weight)) in KRONROD_NODES.into_iter().zip(KRONROD_WEIGHTS).enumerate() {
        let (left, right) = (f(middle - half * node), f(middle + half * node));
        let sum = left.value + right.value;
        kronrod += weight * sum;
        size += weight * (left.value.abs() + right.value.abs());
        inherited += weight * (left.error + right.error);
        if i % 2 == 1 {
            gauss += GAUSS_WEIGHTS[i / 2] * sum;
        }
    }
    let removable = (half * (kronrod - gauss)).abs();
    let kept = half.abs() * (inherited + 16.0 * f64::EPSILON * size);
    Panel { lo, hi, estimate: Estimate { value: half * kronrod, error: CAUTION * removable + kept }, removable }
}

/// ∫ f over the intervals, halving the panel of the greatest error until the tolerance or the budget is met.
///
/// **Method:** globally adaptive Gauss–Kronrod (7, 15), with ten times the difference of the two rules as error.
/// **Domain:** f finite on the closed intervals; place interval ends where f or its derivatives jump, and about narrow
/// peaks, which no sampling can find by itself.
pub fn adaptive(
    intervals: impl IntoIterator<Item = (f64, f64)>,
    tolerance: Tolerance,
    mut f: impl FnMut(f64) -> Estimate,
) -> Estimate {
    let mut panels: BinaryHeap<Panel> =
        intervals.into_iter().filter(|(lo, hi)| lo < hi).map(|(lo, hi)| panel(lo, hi, &mut f)).collect();
    let mut total = panels.iter().fold(Estimate::default(), |sum, panel| sum + panel.estimate);
    let mut removable: f64 = panels.iter().map(|panel| panel.removable).sum();
    let mut used = panels.len();
    while removable > tolerance.absolute.max(tolerance.relative * total.value.abs()) && used < tolerance.panels {
        let Some(worst) = panels.pop() else { break };
        let middle = 0.5 * (worst.lo + worst.hi);
        if !(worst.lo < middle && middle < worst.hi) {
            // Nothing lies between the ends: this panel's error can be had no smaller.
            break;
        }
        panels.push(panel(worst.lo, middle, &mut f));
        panels.push(panel(middle, worst.hi, &mut f));
        used += 2;
        total = panels.iter().fold(Estimate::default(), |sum, panel| sum + panel.estimate);
        removable = panels.iter().map(|panel| panel.removable).sum();
    }
    total
}

/// As [`adaptive`], between consecutive `breaks` in increasing order, for functions whose derivative is infinite like a
/// square root's at the breaks: x = a + (b − a)(3t² − 2t³) makes them smooth.
pub fn adaptive_graded(breaks: &[f64], tolerance: Tolerance, mut f: impl FnMut(f64) -> Estimate) -> Estimate {
    let intervals = breaks.windows(2).enumerate().filter(|(_, ends)| ends[0] < ends[1]);
    let starts = intervals.map(|(i, _)| (i as f64, i as f64 + 1.0));
    adaptive(starts, tolerance, |t| {
        let i = t.floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "an index of `breaks`")]
        let (a, b) = (breaks[i as usize], breaks[i as usize + 1]);
        let t = t - i;
        f(a + (b - a) * t * t * (3.0 - 2.0 * t)) * ((b - a) * 6.0 * t * (1.0 - t))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOLERANCE: Tolerance = Tolerance { relative: 1e-10, absolute: 0.0, panels: 200 };

    #[test]
    fn gauss_legendre_integrates_polynomials_of_degree_2n_minus_1_exactly() {
        for order in [1, 2, 5, 12, 24, 48] {
            let rule = GaussLegendre::new(order);
            let degree = 2 * order - 1;
            let exact = 2_f64.powf(degree as f64 + 1.0) / (degree as f64 + 1.0);
            let value = rule.integrate(0.0, 2.0, |x| x.powf(degree as f64));
            assert!((value / exact - 1.0).abs() < 1e-13, "order {order}: {value} for {exact}");
        }
    }

    #[track_caller]
    fn check(estimate: Estimate, truth: f64) {
        let off = (estimate.value - truth).abs();
        assert!(off <= estimate.error, "off by {off:e}, bound {:e}", estimate.error);
        assert!(estimate.error <= 2e-9 * truth.abs(), "bound {:e} is too wide", estimate.error);
    }

    #[test]
    fn adaptive_bound_holds_for_smooth_and_kinked_functions() {
        check(adaptive([(0.0, 3.0)], TOLERANCE, |x| Estimate::rounded(x.exp())), 3_f64.exp() - 1.0);
        check(adaptive([(-1.0, 2.0)], TOLERANCE, |x| Estimate::rounded(x.abs())), 2.5);
    }

    #[test]
    fn grading_makes_square_root_ends_smooth() {
        let mut calls = 0;
        let half_disk = adaptive_graded(&[-1.0, 1.0], TOLERANCE, |x| {
            calls += 1;
            Estimate::rounded((1.0 - x * x).sqrt())
        });
        check(half_disk, 0.5 * PI);
        assert!(calls <= 105, "{calls} evaluations");
    }

    #[test]
    fn adaptive_integration_ends_at_its_budget_with_a_bound_that_holds() {
        let budget = Tolerance { relative: 0.0, absolute: 0.0, panels: 9 };
        let estimate = adaptive([(0.0, 1.0)], budget, |x| Estimate::rounded(x.sqrt()));
        assert!((estimate.value - 2.0 / 3.0).abs() <= estimate.error, "{estimate:?}");
        assert!(estimate.error > 1e-9, "{estimate:?} is narrower than nine panels allow");
    }
}
