//! Specular lobes as the layer shaders read them.

use super::types::{Lobe, f32_of};
use crate::math::special::GAUSS_24;
use crate::shading::{self, LobeModel, Method};

/// Cells of a lobe's table of ∫cosᵐφ dφ.
const CELLS: u8 = 64;

/// −ln of the share of a lobe's peak at which its table ends; it is a tenth of what f32 can add to the whole.
const TABLE_END_LN: f64 = 19.0;

// The models in `common.wgsl`; a twin of each lobe's density holds them against it.
const PHONG: u32 = 0;
const LAFORTUNE: u32 = 1;
const BLINN: u32 = 2;
const COOK_TORRANCE: u32 = 3;

/// Whether a lobe is no cosine about an axis.
pub(crate) fn is_other(lobe: &Lobe) -> bool {
    lobe.model > LAFORTUNE
}

/// A lobe with its table and its Chebyshev fit: `method`'s, else the usual one.
pub(crate) fn lobe(lobe: &shading::Lobe, method: Method) -> Lobe {
    let fit = match method {
        Method::Chebyshev { degree, levels } => lobe.chebyshev(degree, levels),
        _ => lobe.chebyshev(6, 256),
    };
    let (cosine_cells, cosine_integral) = cosine_table(lobe.exponent().max(1.0));
    let (model, parameters) = match lobe.model() {
        LobeModel::Phong => (PHONG, [0.0; 2]),
        LobeModel::Lafortune { tangential, normal } => (LAFORTUNE, [tangential, normal]),
        LobeModel::Blinn { norm } => (BLINN, [norm, 0.0]),
        LobeModel::CookTorrance { slope, reflectance } => (COOK_TORRANCE, [slope, reflectance]),
    };
    Lobe {
        exponent: f32_of(lobe.exponent()),
        chebyshev_cut: f32_of(fit.cut()),
        chebyshev_tan_cut: f32_of(fit.cut().tan()),
        cosine_cells,
        model,
        cosine_exponent: f32_of(lobe.cosine_exponent()),
        parameters: parameters.map(f32_of),
        chebyshev_mean: quads(fit.mean_coefficients()),
        cosine_integral,
    }
}

/// Coefficients in fours, with zeros behind them.
fn quads(coefficients: &[f64]) -> [[f32; 4]; 4] {
    let mut quads = [[0.0; 4]; 4];
    for (rounded, coefficient) in quads.iter_mut().flatten().zip(coefficients) {
        *rounded = f32_of(*coefficient);
    }
    quads
}

/// Cells a unit of u, and for each cell the cubic in its part that has the values and slopes of ∫₀cosᵐφ dφ at its ends.
///
/// tan(φ/2) = 2u/(1 + u²) makes the integral smooth in u to φ = π/2 for every m ≥ 1. In cells of h the cubics are
/// within h⁴/384 of the greatest fourth derivative; rounded to f32, they are within 8e-7 of the whole lobe's integral.
fn cosine_table(m: f64) -> (f32, [[f32; 16]; 16]) {
    let end = table_end(m);
    let width = end / f64::from(CELLS);
    let mut cubics = [[0.0; 16]; 16];
    let mut value = 0.0;
    for (i, cubic) in (0..CELLS).zip(cubics.as_flattened_mut().chunks_exact_mut(4)) {
        let (from, to) = (f64::from(i) * width, (f64::from(i) + 1.0) * width);
        let rise = GAUSS_24.integrate(from, to, |u| slope(m, u));
        let (slope_0, slope_1) = (width * slope(m, from), width * slope(m, to));
        let terms = [value, slope_0, 3.0 * rise - 2.0 * slope_0 - slope_1, slope_0 + slope_1 - 2.0 * rise];
        for (coefficient, term) in cubic.iter_mut().zip(terms) {
            *coefficient = f32_of(term);
        }
        value += rise;
    }
    (f32_of(width.recip()), cubics)
}

/// d/du ∫cosᵐφ dφ.
fn slope(m: f64, u: f64) -> f64 {
    let square = u * u;
    let divisor = (1.0 + square) * (1.0 + square) + 4.0 * square;
    let cosine = (1.0 - square) * (1.0 - square) / divisor;
    cosine.powf(m) * 4.0 * (1.0 - square) / divisor
}

/// u where cosᵐφ is e^−[`TABLE_END_LN`].
fn table_end(m: f64) -> f64 {
    let cosine = (-TABLE_END_LN / m).exp();
    let near = 1.0 + cosine;
    ((1.0 - cosine) * near).sqrt() / (near + (2.0 * cosine * near).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::special::cosine_power_mean;

    #[test]
    fn the_table_is_the_integral_of_the_lobe() {
        let mut worst = 0.0_f64;
        for m in [1.0, 1.5, 2.0, 7.3, 31.0, 200.0, 1000.0, 10_000.0] {
            let (cells, cubics) = cosine_table(m);
            let whole = std::f64::consts::FRAC_PI_2 * cosine_power_mean(m, 0.0, std::f64::consts::FRAC_PI_2);
            for i in 0..640_u16 {
                let t = f64::from(i) / 10.0;
                let u = t / f64::from(cells);
                let phi = 2.0 * (2.0 * u / (1.0 + u * u)).atan();
                let cubic = &cubics.as_flattened()[4 * usize::from(i / 10)..][..4];
                let x = t.fract();
                let value = cubic.iter().rev().fold(0.0, |sum, c| sum * x + f64::from(*c));
                worst = worst.max((value - phi * cosine_power_mean(m, 0.0, phi)).abs() / whole);
            }
        }
        println!("the table is off by {worst:.1e} of the lobe");
        assert!(worst <= 8e-7, "{worst:e}");
    }
}
