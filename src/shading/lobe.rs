//! The specular lobe of a material, prepared once.

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
}
