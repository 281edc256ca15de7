//! The colour of a light, apart from its quantity.

use glam::DVec3;

/// Colour only: scaled so that its luminance is 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tint {
    /// Linear Rec. 709 RGB, of any luminance above 0.
    Color(DVec3),
    /// A black body's colour, kelvin.
    TemperatureK(f64),
}

impl Default for Tint {
    fn default() -> Self {
        Self::Color(DVec3::ONE)
    }
}

impl Tint {
    /// Linear Rec. 709 RGB of luminance 1.
    pub fn rgb(self) -> DVec3 {
        let color = match self {
            Self::Color(color) => color,
            Self::TemperatureK(kelvin) => temperature_color(kelvin),
        };
        let luminance = luminance_of(color);
        if luminance > 0.0 { color / luminance } else { DVec3::ONE }
    }
}

/// Luminance of linear Rec. 709 RGB.
pub fn luminance_of(rgb: DVec3) -> f64 {
    rgb.dot(DVec3::new(0.212_639_005_871_510, 0.715_168_678_767_756, 0.072_192_315_360_734))
}

/// Linear Rec. 709 RGB of a black body at `kelvin`, any luminance.
///
/// The chromaticity comes from the Planckian locus in CIE 1960 by J. Krystek, *An algorithm to calculate correlated
/// colour temperature*, Color Research and Application 10(1), 1985: rational functions in T, within 9e-5 in u and v
/// over 1000 K…15000 K. Arguments are clamped to 1000 K…40000 K, and components outside the gamut to 0.
pub fn temperature_color(kelvin: f64) -> DVec3 {
    let t = kelvin.clamp(1000.0, 40_000.0);
    let u = (0.860_117_757 + 1.541_182_54e-4 * t + 1.286_412_12e-7 * t * t)
        / (1.0 + 8.424_202_35e-4 * t + 7.081_451_63e-7 * t * t);
    let v = (0.317_398_726 + 4.228_062_45e-5 * t + 4.204_816_91e-8 * t * t)
        / (1.0 - 2.897_418_16e-5 * t + 1.614_560_53e-7 * t * t);
    let denominator = 2.0 * u - 8.0 * v + 4.0;
    let (x, y) = (3.0 * u / denominator, 2.0 * v / denominator);
    let xyz = DVec3::new(x / y, 1.0, (1.0 - x - y) / y);
    DVec3::new(
        xyz.dot(DVec3::new(3.240_969_941_904_523, -1.537_383_177_570_094, -0.498_610_760_293_003)),
        xyz.dot(DVec3::new(-0.969_243_636_280_880, 1.875_967_501_507_721, 0.041_555_057_407_176)),
        xyz.dot(DVec3::new(0.055_630_079_696_994, -0.203_976_958_888_977, 1.056_971_514_242_879)),
    )
    .max(DVec3::ZERO)
}
