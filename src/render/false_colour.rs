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

/// Shares by which two methods may differ: a place belongs to the first that it is within.
pub const TOLERANCES: [f64; 3] = [0.01, 0.05, 0.1];

/// Colours of the places within each of [`TOLERANCES`], brightest first, and of those beyond all.
pub fn bands() -> [[u8; 3]; 4] {
    [0.96, 0.68, 0.42, 0.08].map(sequential)
}

/// Least value of a logarithmic [`Scale`], as a share of its end: three decades.
const LOGARITHMIC_SPAN: f64 = 1e-3;

/// The values that [`sequential`] colours stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    /// The greatest, above 0.
    pub end: f64,
    /// Over three decades up to `end`, else from 0.
    pub logarithmic: bool,
}

impl Scale {
    /// Where on the scale a value is: 0 at its beginning, 1 at its end.
    pub fn share(&self, value: f64) -> f64 {
        if !self.logarithmic {
            return value / self.end;
        }
        let least = LOGARITHMIC_SPAN * self.end;
        (value.max(least) / least).ln() / LOGARITHMIC_SPAN.recip().ln()
    }

    /// Round values for ticks and isolines, ascending: four to ten or so, never more than [`Self::MOST_LEVELS`].
    pub fn levels(&self) -> Vec<f64> {
        let slack = 1.0 + 1e-9;
        if self.logarithmic {
            let first = (LOGARITHMIC_SPAN * self.end).log10().floor();
            let decades = (0..5).map(|decade| 10.0_f64.powf(first + f64::from(decade)));
            let levels = decades.flat_map(|decade| [1.0, 2.0, 5.0].map(|digit| digit * decade));
            levels.filter(|level| (LOGARITHMIC_SPAN * self.end * slack..=self.end * slack).contains(level)).collect()
        } else {
            let step = round_up(0.1 * self.end, &[1.0, 2.0, 5.0]);
            (1..=10).map(|i| f64::from(i) * step).filter(|level| *level <= self.end * slack).collect()
        }
    }

    /// Levels, at most.
    pub const MOST_LEVELS: usize = 12;
}

/// The least round number that is not below `x` > 0: one of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten.
pub fn round_end(x: f64) -> f64 {
    round_up(x, &[1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0])
}

/// The least of `digits` times a power of ten that is not below `x`, but for rounding; 1 where `x` is not above 0.
fn round_up(x: f64, digits: &[f64]) -> f64 {
    if !(x > 0.0 && x.is_finite()) {
        return 1.0;
    }
    let power = 10.0_f64.powf(x.log10().floor());
    let fits = digits.iter().map(|digit| digit * power).find(|round| *round >= x * (1.0 - 1e-9));
    fits.unwrap_or(10.0 * power)
}

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
    fn a_scale_has_its_ends_and_a_dozen_round_levels_at_most() {
        let linear = Scale { end: 300.0, logarithmic: false };
        assert_eq!([0.0, 150.0, 300.0].map(|value| linear.share(value)), [0.0, 0.5, 1.0], "linear");
        assert_eq!(linear.levels(), [50.0, 100.0, 150.0, 200.0, 250.0, 300.0], "linear");
        let decades = Scale { end: 1000.0, logarithmic: true };
        for (value, share) in [(0.0, 0.0), (1.0, 0.0), (10.0, 1.0 / 3.0), (1000.0, 1.0)] {
            assert!((decades.share(value) - share).abs() < 1e-12, "{value} is at {}", decades.share(value));
        }
        assert_eq!(decades.levels(), [2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0], "three decades");
        for i in 0..2000 {
            let end = 10.0_f64.powf(f64::from(i) * 0.01 - 10.0);
            for logarithmic in [false, true] {
                let levels = Scale { end, logarithmic }.levels();
                let count = levels.len();
                assert!((4..=Scale::MOST_LEVELS).contains(&count), "{count} levels up to {end}: {levels:?}");
                assert!(levels.windows(2).all(|pair| pair[0] < pair[1]), "ascending: {levels:?}");
                assert!(levels.iter().all(|level| *level <= end * 1.001), "within: {levels:?} of {end}");
            }
        }
    }

    #[test]
    fn an_end_is_rounded_up_to_the_next_round_number() {
        for (x, end) in [(0.011, 0.015), (1.0, 1.0), (6.1, 8.0), (8.1, 10.0), (99.0, 100.0), (0.0, 1.0)] {
            assert!((round_end(x) - end).abs() <= 1e-12 * end, "{x} became {}", round_end(x));
        }
        assert_eq!([f64::NAN, f64::INFINITY, -3.0].map(round_end), [1.0; 3], "no number to round");
    }

    #[test]
    fn bands_are_the_brighter_the_nearer_methods_agree() {
        let lumas = bands().map(luma);
        assert!(lumas.windows(2).all(|pair| pair[0] > pair[1] + 20.0), "{lumas:?}");
    }

    #[test]
    fn what_lies_beyond_a_scale_has_its_ends_colour_and_no_number_none_of_its() {
        assert_eq!([diverging(7.0), diverging(-7.0)], [diverging(1.0), diverging(-1.0)], "diverging");
        assert_eq!([sequential(7.0), sequential(-7.0)], [sequential(1.0), sequential(0.0)], "sequential");
        assert_eq!([diverging(f64::NAN), sequential(f64::NAN)], [NOTHING; 2], "not a number");
    }
}
