//! Pictures in Radiance's own format, which shares an exponent between red, green and blue.

use glam::DVec3;

use crate::export::Origin;
use crate::light::luminance_of;

/// A picture, and what its samples are to be multiplied by, a channel.
pub(super) struct Picture {
    pub(super) bytes: Vec<u8>,
    pub(super) size: [u32; 2],
    pub(super) gain: DVec3,
}

/// A decoder adds a half to every mantissa, so that this is the largest sample with an exponent of 0.
const LARGEST: f64 = 255.5 / 256.0;

/// A picture of texels, the first row on top. A column or row alone is there twice, as Radiance asks for.
///
/// **Accuracy:** the greatest channel of a texel is off by at most 0.4 %, the mean of each channel by rounding: `gain`
/// sees to that.
pub(super) fn picture([columns, rows]: [u32; 2], texels: &[DVec3], origin: Origin) -> Picture {
    let most = texels.iter().map(|texel| texel.max_element()).fold(0.0, f64::max);
    let scale = if most > 0.0 { LARGEST / most } else { 1.0 };
    let [wide, high] = [columns, rows].map(|count| count.max(2));
    let head = format!("#?RADIANCE\nSOFTWARE={}\nFORMAT=32-bit_rle_rgbe\n", origin.line());
    let mut bytes = format!("{head}\n-Y {high} +X {wide}\n").into_bytes();
    let codes: Vec<_> = texels.iter().map(|texel| code_of(scale * *texel)).collect();
    for row in codes.chunks(columns as usize).cycle().take(high as usize) {
        bytes.extend(row.iter().cycle().take(wide as usize).flatten());
    }
    let sum: DVec3 = texels.iter().sum();
    let decoded: DVec3 = codes.iter().map(|code| value_of(*code)).sum();
    let gain = DVec3::from_array([0, 1, 2].map(|i| if decoded[i] > 0.0 { sum[i] / decoded[i] } else { 0.0 }));
    Picture { bytes, size: [wide, high], gain }
}

/// The code of a sample: mantissas and an exponent, of which the largest mantissa is at least 128.
#[expect(
    clippy::cast_possible_truncation,
    reason = "mantissas are below 256, and exponents are those of small numbers"
)]
fn code_of(sample: DVec3) -> [u8; 4] {
    let most = sample.max_element();
    if most < 1e-32 {
        return [0; 4];
    }
    let exponent = (most.log2().floor() as i32) + 1;
    let mantissa = |value: f64| (256.0 * value * 2.0_f64.powi(-exponent)).clamp(0.0, 255.0) as u8;
    let [red, green, blue] = sample.to_array().map(mantissa);
    [red, green, blue, (exponent + 128) as u8]
}

/// The sample of a code.
fn value_of([red, green, blue, exponent]: [u8; 4]) -> DVec3 {
    if exponent == 0 {
        return DVec3::ZERO;
    }
    let unit = 2.0_f64.powi(i32::from(exponent) - 136);
    DVec3::from_array([red, green, blue].map(|mantissa| (f64::from(mantissa) + 0.5) * unit))
}

/// The luminance that Radiance's own tools see in a colour, as a share of its own.
pub(super) fn seen_luminance(color: DVec3) -> f64 {
    color.dot(DVec3::new(0.265, 0.670, 0.065)) / luminance_of(color)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: Origin = Origin { scene: "s.toml" };

    #[test]
    fn texels_come_back_within_half_a_step_and_their_mean_exactly() {
        let texel = |i: u32| DVec3::new(1.0, 0.4, 0.1) * (0.001 + f64::from(i * 37 % 101)) * 20.0;
        let texels: Vec<_> = (0..12).map(texel).collect();
        let Picture { bytes, size, gain } = picture([4, 3], &texels, ORIGIN);
        assert_eq!(size, [4, 3], "size");
        let codes: Vec<[u8; 4]> = bytes[bytes.len() - 48..].chunks(4).map(|c| [c[0], c[1], c[2], c[3]]).collect();
        let found: Vec<_> = codes.into_iter().map(|code| gain * value_of(code)).collect();
        for (found, texel) in found.iter().zip(&texels) {
            assert!((found / texel - 1.0).x.abs() < 6e-3, "{found} is not {texel}");
        }
        let [sum, exact]: [DVec3; 2] = [found.iter().sum(), texels.iter().sum()];
        assert!((sum / exact - 1.0).abs().max_element() < 1e-14, "{sum} is not {exact}");
    }

    #[test]
    fn a_row_alone_is_there_twice() {
        let Picture { bytes, size, .. } = picture([3, 1], &[DVec3::ONE, DVec3::ZERO, DVec3::ONE], ORIGIN);
        assert_eq!(size, [3, 2], "rows of three");
        let texels = &bytes[bytes.len() - 24..];
        assert_eq!(texels[..12], texels[12..], "the same twice");
        assert_eq!(texels[..8], [255, 255, 255, 128, 0, 0, 0, 0], "white and black are as they are");
    }
}
