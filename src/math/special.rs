//! Integrals of powers of the cosine, and panels of Gauss–Legendre quadrature.

use std::f64::consts::FRAC_PI_2;
use std::sync::LazyLock;

use super::quadrature::GaussLegendre;

/// The 24 nodes that all smooth integrals of `shading` use.
pub static GAUSS_24: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(24));

/// −ln of the fraction of a peak below which a power of the cosine is left out.
pub const NEGLIGIBLE_LN: f64 = 39.0;

/// ∫₀^φ cosᵐ t dt for a whole m ≥ 0, by recurrence upward in m.
///
/// I₀ = φ, I₁ = sin φ, I_k = (sin φ cosᵏ⁻¹φ + (k − 1) I_{k−2})/k
///
/// **Source:** [`crate::refs::SNYDER_1996`], §3.1, for the cosine. **Accuracy:** absolute ≤ 4e-15 to m = 1000.
pub fn cosine_power_integral(m: u32, phi: f64) -> f64 {
    let (sin, cos) = phi.sin_cos();
    let odd = m % 2 == 1;
    let (mut sum, mut power, mut k) = match m {
        0 => return phi,
        _ if odd => (sin, 1.0, 1.0),
        _ => (0.5 * (sin * cos + phi), cos, 2.0),
    };
    for _ in 0..(m - 1) / 2 {
        k += 2.0;
        power *= cos * cos;
        sum = (sin * power + (k - 1.0) * sum) / k;
    }
    sum
}

/// ∫ cosᵐ t dt over [from, to] for a whole m ≥ 1, by the recurrence of [`cosine_power_integral`] for both ends at once.
///
/// What is divided by k does not wait for the step before, so that a step takes a product and a sum.
fn cosine_power_difference(m: u32, from: f64, to: f64) -> f64 {
    let ((sin_from, cos_from), (sin_to, cos_to)) = (from.sin_cos(), to.sin_cos());
    let (mut sum, [mut power_from, mut power_to], mut k) = if m % 2 == 1 {
        (sin_to - sin_from, [1.0, 1.0], 1.0)
    } else {
        (0.5 * (sin_to * cos_to - sin_from * cos_from + (to - from)), [cos_from, cos_to], 2.0)
    };
    for _ in 0..(m - 1) / 2 {
        k += 2.0;
        power_from *= cos_from * cos_from;
        power_to *= cos_to * cos_to;
        sum = (sin_to * power_to - sin_from * power_from) / k + sum * ((k - 1.0) / k);
    }
    sum
}

/// The mean of cosᵐ over [from, from + length], which lies in [−π/2, π/2]; its value at `from` for no length.
///
/// Whole m ≤ 200 over more than 0.1: by recurrence. Otherwise 24 Gauss–Legendre nodes a panel: in the angle
/// where that is smooth, else a side from the peak, cut where cosᵐ falls below e⁻³⁹ of its peak there; for m < 24,
/// where the end of the lobe at π/2 is felt, in y with φ = gd y, cosᵐφ dφ = sechᵐ⁺¹y dy.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], eq. (3). **Domain:** any real m ≥ 1.
/// **Accuracy:** absolute ≤ 5e-14, relative ≤ 1e-12 where whole and real m can be compared
/// (`means_of_neighbouring_forms_agree`).
pub fn cosine_power_mean(m: f64, from: f64, length: f64) -> f64 {
    let to = from + length;
    if length > 0.1 && m <= 200.0 && m.fract() == 0.0 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of at most 200")]
        let m = m as u32;
        return cosine_power_difference(m.max(1), from, to) / length;
    }
    let gap = FRAC_PI_2 - from.abs().max(to.abs());
    if length * (m + 1.0).sqrt() <= 4.0 && gap >= 0.5 * length {
        return GAUSS_24.integrate(0.0, 1.0, |t| (from + t * length).cos().powf(m));
    }
    (cosine_power_side(m, (-to).max(0.0), (-from).max(0.0)) + cosine_power_side(m, from.max(0.0), to.max(0.0))) / length
}

/// ∫ cosᵐ over [from, to] in [0, π/2], by quadrature.
fn cosine_power_side(m: f64, from: f64, to: f64) -> f64 {
    if from >= to.min(FRAC_PI_2) {
        return 0.0;
    }
    let cut = from.cos() * (-NEGLIGIBLE_LN / m).exp();
    let to = to.min((1.0 - cut * cut).sqrt().atan2(cut));
    if m >= 24.0 {
        return GAUSS_24.integrate(from, to, |phi| phi.cos().powf(m));
    }
    let y = |phi: f64| phi.tan().asinh();
    let y_cut = y(from) + NEGLIGIBLE_LN / (m + 1.0) + 1.0;
    panels(y(from), y(to).min(y_cut), 3.2, |y| y.cosh().powf(-(m + 1.0)))
}

/// ∫ f over [lo, hi] in equal panels no wider than `width`, 24 Gauss–Legendre nodes each.
pub fn panels(lo: f64, hi: f64, width: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let count = ((hi - lo) / width).ceil().max(1.0);
    let step = (hi - lo) / count;
    let mut sum = 0.0;
    let mut i = 0.0;
    while i < count {
        sum += GAUSS_24.integrate(lo + i * step, lo + (i + 1.0) * step, &mut f);
        i += 1.0;
    }
    sum
}

/// ∫ f over [lo, hi] in equal panels no wider than `width`, each halved until halving changes it by no more than
/// `tolerance`, but 1000 times at most.
pub fn refined_panels(lo: f64, hi: f64, width: f64, tolerance: f64, mut f: impl FnMut(f64) -> f64) -> f64 {
    let mut pending = Vec::new();
    let count = ((hi - lo) / width).ceil().max(1.0);
    let step = (hi - lo) / count;
    let mut i = 0.0;
    while i < count {
        pending.push((lo + i * step, lo + (i + 1.0) * step, None));
        i += 1.0;
    }
    let mut budget = pending.len() + 1000;
    let mut sum = 0.0;
    while let Some((lo, hi, whole)) = pending.pop() {
        let whole: f64 = whole.unwrap_or_else(|| GAUSS_24.integrate(lo, hi, &mut f));
        let middle = 0.5 * (lo + hi);
        let halves = [GAUSS_24.integrate(lo, middle, &mut f), GAUSS_24.integrate(middle, hi, &mut f)];
        if budget == 0 || (halves[0] + halves[1] - whole).abs() <= tolerance {
            sum += halves[0] + halves[1];
        } else {
            budget -= 1;
            pending.push((lo, middle, Some(halves[0])));
            pending.push((middle, hi, Some(halves[1])));
        }
    }
    sum
}

/// (asin s − s)/s³ for 0 ≤ s ≤ 0.3, by its power series; truncated below 1e-17.
pub fn asin_excess(s: f64) -> f64 {
    let t = s * s;
    let mut coefficient = 0.5;
    let mut power = 1.0;
    let mut sum = 0.0;
    let mut k = 1.0;
    while k < 16.0 {
        sum += coefficient * power / (2.0 * k + 1.0);
        power *= t;
        coefficient *= (2.0 * k + 1.0) / (2.0 * k + 2.0);
        k += 1.0;
    }
    sum
}

/// δ − sin δ cos δ for δ ≥ 0 with its sine and cosine, by its power series below 0.3.
pub fn circular_segment(delta: f64, sin: f64, cos: f64) -> f64 {
    if delta >= 0.3 {
        return delta - sin * cos;
    }
    // ½(t − sin t) with t = 2δ, as nested ratios of neighbouring terms.
    let t = 4.0 * delta * delta;
    let mut nested = 1.0;
    for k in [16.0, 14.0, 12.0, 10.0, 8.0, 6.0, 4.0] {
        nested = 1.0 - t / (k * (k + 1.0)) * nested;
    }
    2.0 / 3.0 * delta * delta * delta * nested
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cosine_power_integrals_over_the_quadrant_are_walliss() {
        let mut wallis = [FRAC_PI_2, 1.0];
        for m in 2..=1000_u32 {
            let next = wallis[0] * f64::from(m - 1) / f64::from(m);
            wallis = [wallis[1], next];
            let x = cosine_power_integral(m, FRAC_PI_2);
            assert!((x - next).abs() <= 4e-15, "m = {m}: {x} for {next}");
        }
    }

    #[test]
    fn means_of_neighbouring_forms_agree() {
        for m in [1.0, 2.0, 3.0, 7.0, 16.0, 23.0, 24.0, 31.0, 64.0, 100.0, 199.0, 200.0] {
            for (from, to) in [
                (-FRAC_PI_2, FRAC_PI_2),
                (0.0, FRAC_PI_2),
                (-0.3, 1.2),
                (-1.4, -0.2),
                (0.5, 0.9),
                (1.2, 1.57),
                (-1.0, 0.01),
            ] {
                let length = to - from;
                let whole = cosine_power_mean(m, from, length);
                let real = cosine_power_mean(m * (1.0 + 1e-15), from, length);
                let deviation = (whole - real).abs();
                assert!(
                    deviation <= 5e-15 / length + 1e-12 * whole.min(1.0),
                    "m = {m} over {from}…{to}: {whole} and {real}"
                );
            }
        }
    }

    #[test]
    fn cosine_power_means_of_no_length_are_values() {
        for m in [1.0, 1.5, 33.3, 1000.0] {
            let value = 0.3_f64.cos().powf(m);
            let mean = cosine_power_mean(m, 0.3, 0.0);
            assert!((mean - value).abs() <= 1e-14, "m = {m}: {mean} for {value}");
        }
    }

    #[test]
    fn series_join_their_closed_forms() {
        for s in [0.05_f64, 0.2, 0.29, 0.3] {
            let closed = (s.asin() - s) / (s * s * s);
            assert!((asin_excess(s) - closed).abs() <= 1e-16 / (s * s * s), "asin excess at {s}");
        }
        for delta in [0.05_f64, 0.2, 0.299_999] {
            let closed = delta - delta.sin() * delta.cos();
            let series = circular_segment(delta, delta.sin(), delta.cos());
            assert!((series - closed).abs() <= 1e-16, "segment at {delta}: {series} for {closed}");
        }
    }
}
