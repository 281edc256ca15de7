//! The specular lobe of a material, prepared once.

use std::f64::consts::TAU;

/// A Phong lobe cosᵐ, with what methods need to know of its exponent computed once.
#[derive(Clone, Debug, PartialEq)]
pub struct PhongLobe {
    exponent: f64,
}

impl PhongLobe {
    /// The lobe of exponent m, any real ≥ 1.
    pub fn new(exponent: f64) -> Self {
        Self { exponent }
    }

    /// The exponent m.
    pub fn exponent(&self) -> f64 {
        self.exponent
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
