//! Reproducible random inputs.

use glam::DVec3;

/// SplitMix64 (G. Steele, D. Lea and C. Flood, OOPSLA 2014).
pub(crate) struct Random(u64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// Uniform between two numbers.
    pub(crate) fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A whole number below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % count as u64).expect("it is below a usize")
    }

    /// Uniform in the logarithm.
    pub(crate) fn magnitude(&mut self, from: f64, to: f64) -> f64 {
        self.within(from.ln(), to.ln()).exp()
    }

    /// A point of a cube about the origin.
    pub(crate) fn point(&mut self, extent: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.within(-extent, extent)))
    }

    /// A unit vector, uniform over the sphere.
    pub(crate) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.point(1.0);
            if v.length_squared() > 1e-4 && v.length_squared() < 1.0 {
                return v.normalize();
            }
        }
    }
}

/// How many random cases a property is held to: `SOFTBOX_PROPERTY_CASES`, else 100,000.
pub(crate) fn property_cases() -> u32 {
    std::env::var("SOFTBOX_PROPERTY_CASES").map_or(100_000, |count| count.parse().expect("a number of cases"))
}
