//! The specular lobe of a material, prepared once.

use std::f64::consts::TAU;

use crate::math::chebyshev::ChebyshevLobe;

/// A Phong lobe cosᵐ, with what methods need to know of its exponent computed once.
#[derive(Clone, Debug, PartialEq)]
pub struct PhongLobe {
    exponent: f64,
    chebyshev: ChebyshevLobe,
}

impl PhongLobe {
    /// The lobe of exponent m, any real ≥ 1.
    pub fn new(exponent: f64) -> Self {
        let chebyshev = ChebyshevLobe::new(exponent, ChebyshevLobe::DEGREE, ChebyshevLobe::EPSILON);
        Self { exponent, chebyshev }
    }

    /// The exponent m.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// The fit of cosᵐ that the method `chebyshev` uses.
    pub fn chebyshev(&self) -> &ChebyshevLobe {
        &self.chebyshev
    }

    /// (m+1)/(2π), which makes the lobe's integral over its hemisphere 1 ([`crate::refs::SNYDER_1996`], eq. 10).
    pub fn normalisation(&self) -> f64 {
        (self.exponent + 1.0) / TAU
    }

    /// (m+1)/(2π)·max(0, cos α)ᵐ, 1/sr.
    pub fn density(&self, cos_alpha: f64) -> f64 {
        if cos_alpha > 0.0 { self.normalisation() * cos_alpha.powf(self.exponent) } else { 0.0 }
    }
}
