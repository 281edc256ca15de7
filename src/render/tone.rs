//! From radiance to what a display shows. The GPU's composite does the same.

use glam::DVec3;

/// Luminance that is white at exposure 0, cd/m².
const WHITE: f64 = 100.0;

/// L_out/100·2^ev, a channel at a time.
pub fn expose(radiance: DVec3, exposure_ev: f64) -> DVec3 {
    radiance * (exposure_ev.exp2() / WHITE)
}

/// The Khronos PBR Neutral tone curve: linear Rec. 709 to linear Rec. 709 within 0…1.
///
/// Colours below 0.8 keep their hue and saturation but for a small toe (0.04, the reflection of a dielectric, is taken
/// off); above, the peak is compressed towards 1 and desaturated.
///
/// **Source:** Khronos Group, *PBR Neutral Tone Mapper*, specification, 2024. **Domain:** negative and NaN channels
/// count as 0; infinite ones give white.
pub fn pbr_neutral(color: DVec3) -> DVec3 {
    const TOE: f64 = 0.04;
    const COMPRESSION_START: f64 = 0.8 - TOE;
    const DESATURATION: f64 = 0.15;
    const HEADROOM: f64 = 1.0 - COMPRESSION_START;
    let color = color.map(|channel| channel.max(0.0));
    if !color.is_finite() {
        return DVec3::ONE;
    }
    let least = color.min_element();
    let offset = if least < 2.0 * TOE { least - least * least / (4.0 * TOE) } else { TOE };
    let color = color - offset;
    let peak = color.max_element();
    if peak < COMPRESSION_START {
        return color;
    }
    let compressed = 1.0 - HEADROOM * HEADROOM / (peak + HEADROOM - COMPRESSION_START);
    let keep = 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    DVec3::splat(compressed).lerp(color * (compressed / peak), keep)
}

/// Linear 0…1 to 8-bit sRGB (IEC 61966-2-1), rounded.
pub fn encode_srgb(linear: DVec3) -> [u8; 3] {
    linear.to_array().map(|channel| {
        let channel = channel.clamp(0.0, 1.0);
        let encoded = if channel <= 0.003_130_8 { 12.92 * channel } else { 1.055 * channel.powf(1.0 / 2.4) - 0.055 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "within 0…255")]
        let byte = (255.0 * encoded).round() as u8;
        byte
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exposure_0_makes_100_candela_white_and_each_step_doubles() {
        assert_eq!(expose(DVec3::splat(100.0), 0.0), DVec3::ONE, "white");
        assert_eq!(expose(DVec3::splat(100.0), 3.0), DVec3::splat(8.0), "three steps");
        assert_eq!(expose(DVec3::splat(100.0), -1.0), DVec3::splat(0.5), "a step down");
    }

    #[test]
    fn the_tone_curve_takes_4_percent_off_below_its_shoulder() {
        let color = DVec3::new(0.7, 0.5, 0.2);
        assert!((pbr_neutral(color) - (color - 0.04)).length() < 1e-15, "{}", pbr_neutral(color));
    }

    #[test]
    fn the_tone_curve_is_continuous_increasing_and_below_1() {
        let mut before = 0.0;
        for i in 0..4000 {
            let grey = pbr_neutral(DVec3::splat(f64::from(i) * 0.005)).x;
            assert!(grey >= before && grey - before <= 0.005 + 1e-12 && grey < 1.0, "{grey} after {before}");
            before = grey;
        }
    }

    #[test]
    fn the_tone_curve_holds_for_what_is_no_colour() {
        assert_eq!(pbr_neutral(DVec3::new(f64::NAN, -1.0, 0.0)), DVec3::ZERO, "NaN and negative");
        assert_eq!(pbr_neutral(DVec3::new(f64::INFINITY, 0.0, 0.0)), DVec3::ONE, "infinity");
    }

    #[test]
    fn srgb_encoding_has_its_known_values() {
        let encoded = |linear: f64| encode_srgb(DVec3::splat(linear))[0];
        for (linear, byte) in [(0.0, 0), (0.001, 3), (0.215_860_5, 128), (0.5, 188), (1.0, 255), (2.0, 255)] {
            assert_eq!(encoded(linear), byte, "{linear}");
        }
    }
}
