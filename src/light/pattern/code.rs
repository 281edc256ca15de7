//! The codes of pictures whose samples are integers, which are sRGB-encoded.

use std::sync::LazyLock;

/// The linear value of every 16-bit code, in order. A code c of 8 bits is the 16-bit code 257 c.
static LINEAR: LazyLock<Vec<f32>> = LazyLock::new(|| (0..=u16::MAX).map(linear_from_code).collect());

/// The inverse of the sRGB encoding (IEC 61966-2-1).
pub fn linear_from_srgb(code: f64) -> f64 {
    if code <= 0.04045 { code / 12.92 } else { ((code + 0.055) / 1.055).powf(2.4) }
}

fn linear_from_code(code: u16) -> f32 {
    single(linear_from_srgb(f64::from(code) / f64::from(u16::MAX)))
}

/// A texel's value, which is kept in single precision.
#[expect(clippy::cast_possible_truncation, reason = "this is what it is for")]
pub fn single(value: f64) -> f32 {
    value as f32
}

/// The value of a 16-bit code.
pub fn value_of(code: u16) -> f32 {
    LINEAR[usize::from(code)]
}

/// The 16-bit code of exactly this value, if there is one.
pub fn code_of(value: f32) -> Option<u16> {
    let code = LINEAR.binary_search_by(|linear| linear.total_cmp(&value)).ok()?;
    u16::try_from(code).ok()
}

/// The nearest value that has a 16-bit code; what is above 1 stays as it is.
///
/// **Accuracy:** moves a value x by at most 1.8e-5 x^(7/12) + 6e-7.
pub fn nearest(value: f32) -> f32 {
    if value.is_nan() || value > 1.0 {
        return value;
    }
    let above = LINEAR.partition_point(|linear| *linear < value).min(LINEAR.len() - 1);
    let (low, high) = (LINEAR[above.saturating_sub(1)], LINEAR[above]);
    if value - low < high - value { low } else { high }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_has_a_value_of_its_own_and_is_found_by_it() {
        for code in 0..=u16::MAX {
            let value = value_of(code);
            assert_eq!((code_of(value), nearest(value)), (Some(code), value), "{code}");
        }
        assert_eq!((code_of(0.5), code_of(2.0), code_of(f32::NAN)), (None, None, None), "no code");
    }

    #[test]
    fn codes_of_8_bits_are_codes_of_16_bits() {
        for code in 0..=u8::MAX {
            let value = linear_from_srgb(f64::from(code) / f64::from(u8::MAX));
            assert_eq!(value_of(257 * u16::from(code)), single(value), "{code}");
        }
    }

    #[test]
    fn any_value_is_near_one_that_has_a_code() {
        for i in 0..=20_000_u16 {
            let value = f32::from(i) / 2e4;
            let error = (nearest(value) - value).abs();
            let bound = 1.8e-5 * value.powf(7.0 / 12.0) + 6e-7;
            assert!(error <= bound, "{value} is moved by {error}");
        }
        assert_eq!((nearest(1.5), nearest(-0.25)), (1.5, 0.0), "above and below");
    }
}
