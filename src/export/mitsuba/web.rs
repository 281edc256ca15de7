//! Measured intensities as Mitsuba's projectors: one for each side of a cube about the point.

use glam::{DMat3, DVec3};

use crate::light::photometry::Distribution;

/// Texels along a side: a third of a degree each.
pub(super) const TEXELS: u32 = 256;

/// The frames of the six sides, from the projector's own to the light's: it looks along +Z, with +Y up.
pub(super) fn sides() -> [DMat3; 6] {
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z].map(|forward| {
        let up = if forward.z == 0.0 { DVec3::Z } else { DVec3::X };
        DMat3::from_cols(up.cross(forward), up, forward)
    })
}

/// The illuminance of a side that is 1 m away, as a share of the greatest intensity, row by row from the top: I cos³ θ.
pub(super) fn irradiance(distribution: &Distribution, side: &DMat3) -> Vec<f64> {
    let place = |i: u32| 1.0 - 2.0 * (f64::from(i) + 0.5) / f64::from(TEXELS);
    let value = |(row, column): (u32, u32)| {
        let seen = DVec3::new(place(column), place(row), 1.0);
        distribution.share(*side * seen) * seen.length().powi(-3)
    };
    (0..TEXELS).flat_map(|row| (0..TEXELS).map(move |column| (row, column))).map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sides_are_turned_only_and_together_get_the_light_of_the_point() {
        let candela = [2.0, 3.0, 1.0, 2.0, 1.0, 1.0, 2.0, 3.0, 1.0];
        let distribution = Distribution::of_table(&[0.0, 45.0, 180.0], &[0.0, 90.0, 360.0], &candela).expect("a table");
        let area = (2.0 / f64::from(TEXELS)).powi(2);
        let mut flux = 0.0;
        for side in sides() {
            assert!((side.determinant() - 1.0).abs() < 1e-15, "{side} mirrors");
            flux += area * irradiance(&distribution, &side).iter().sum::<f64>();
        }
        let exact = distribution.flux_per_peak();
        assert!((flux / exact - 1.0).abs() < 1e-4, "{flux} instead of {exact}");
    }
}
