//! Numbers as colours.

/// Colour of a signed share within −1…1 of a scale's end: blue below zero, near-white at zero, red above.
///
/// ColorBrewer's *RdBu*, which colour-blind readers can read: lightness tells how much, hue which way. Shares beyond
/// the ends have the ends' colours, and what is not a number is grey.
pub fn diverging(share: f64) -> [u8; 3] {
    if share.is_nan() {
        return NOTHING;
    }
    rgb(colorous::RED_BLUE.eval_continuous(0.5 - 0.5 * share.clamp(-1.0, 1.0)))
}

/// Colour of a share within 0…1 of a scale's end: *viridis*, from dark violet to yellow, even in lightness.
pub fn sequential(share: f64) -> [u8; 3] {
    if share.is_nan() {
        return NOTHING;
    }
    rgb(colorous::VIRIDIS.eval_continuous(share.clamp(0.0, 1.0)))
}

/// Colour of a place that has no number.
pub const NOTHING: [u8; 3] = [0x8a, 0x90, 0x98];

fn rgb(color: colorous::Color) -> [u8; 3] {
    [color.r, color.g, color.b]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rec. 709 luma, from 0 to 255.
    fn luma([r, g, b]: [u8; 3]) -> f64 {
        0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
    }

    #[test]
    fn the_sign_has_a_hue_and_the_size_a_darkness() {
        let [low, zero, high] = [-1.0, 0.0, 1.0].map(diverging);
        assert!(low[2] > low[0] && high[0] > high[2], "blue below, red above: {low:?}, {high:?}");
        assert!(zero.iter().all(|channel| *channel > 230), "near-white at zero: {zero:?}");
        for i in 0..10 {
            let [near, far] = [f64::from(i) * 0.1, f64::from(i + 1) * 0.1];
            for sign in [-1.0, 1.0] {
                let [near, far] = [near, far].map(|share| luma(diverging(sign * share)));
                assert!(far < near, "{sign}: {far} after {near}");
            }
        }
    }

    #[test]
    fn the_sequential_map_only_brightens() {
        let lumas: Vec<_> = (0..=20).map(|i| luma(sequential(f64::from(i) * 0.05))).collect();
        assert!(lumas.windows(2).all(|pair| pair[0] < pair[1]), "{lumas:?}");
    }

    #[test]
    fn what_lies_beyond_a_scale_has_its_ends_colour_and_no_number_none_of_its() {
        assert_eq!([diverging(7.0), diverging(-7.0)], [diverging(1.0), diverging(-1.0)], "diverging");
        assert_eq!([sequential(7.0), sequential(-7.0)], [sequential(1.0), sequential(0.0)], "sequential");
        assert_eq!([diverging(f64::NAN), sequential(f64::NAN)], [NOTHING; 2], "not a number");
    }
}
