//! Pictures to start from.

use std::f64::consts::{PI, TAU};
use std::ops::RangeInclusive;

use glam::DVec2;

use super::super::code::single;
use super::{Canvas, Mask};

/// A kind of generated picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Panes between bars.
    #[default]
    Window,
    /// Light through foliage.
    Leaves,
    /// A ring light.
    Ring,
    /// A checkerboard.
    Checker,
    /// Stripes, such as a blind's.
    Stripes,
    /// From dark to bright.
    Gradient,
    /// Brightest in the middle.
    Softbox,
}

/// A number that a preset has.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// What it is called.
    pub name: &'static str,
    /// Its unit, with its space; empty for a share or a count.
    pub unit: &'static str,
    /// What it may be.
    pub range: RangeInclusive<f64>,
    /// What it is at first.
    pub default: f64,
    /// Whether it is a count.
    pub whole: bool,
}

/// Samples of a texel along each side.
const SAMPLES: u32 = 4;

/// Vertices of a side of a leaf.
const LEAF_VERTICES: u32 = 12;

impl Preset {
    /// All of them, in menu order.
    pub const ALL: [Self; 7] =
        [Self::Window, Self::Leaves, Self::Ring, Self::Checker, Self::Stripes, Self::Gradient, Self::Softbox];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Window => "Window",
            Self::Leaves => "Leaves",
            Self::Ring => "Ring",
            Self::Checker => "Checker",
            Self::Stripes => "Stripes",
            Self::Gradient => "Gradient",
            Self::Softbox => "Softbox falloff",
        }
    }

    /// Its numbers, at least one.
    pub fn parameters(self) -> Vec<Parameter> {
        let count = |name, default, most| Parameter { name, unit: "", range: 1.0..=most, default, whole: true };
        let share = |name, default| Parameter { name, unit: "", range: 0.0..=1.0, default, whole: false };
        let angle = |default| Parameter { name: "Angle", unit: "°", range: -180.0..=180.0, default, whole: false };
        match self {
            Self::Window => vec![count("Columns", 3.0, 32.0), count("Rows", 2.0, 32.0), share("Bar width", 0.12)],
            Self::Leaves => vec![count("Leaves", 90.0, 400.0), share("Leaf length", 0.22), count("Seed", 1.0, 9999.0)],
            Self::Ring => vec![share("Outer radius", 0.95), share("Inner radius", 0.6), share("Softness", 0.1)],
            Self::Checker => vec![count("Columns", 8.0, 256.0), count("Rows", 8.0, 256.0), share("Dark value", 0.0)],
            Self::Stripes => vec![count("Stripes", 8.0, 256.0), share("Bright share", 0.5), angle(0.0)],
            Self::Gradient => vec![angle(0.0), share("From", 0.0), share("To", 1.0)],
            Self::Softbox => vec![share("Edge value", 0.25), share("Plateau", 0.2)],
        }
    }

    /// The picture of that many texels for a light whose width is `aspect` times its height; `numbers` are those of
    /// [`Self::parameters`], of which missing ones have their defaults.
    pub fn canvas(self, size: [usize; 2], aspect: f64, numbers: &[f64]) -> Canvas {
        let parameters = self.parameters();
        let given = |i: usize| numbers.get(i).copied().filter(|number| number.is_finite());
        let number = |i: usize| {
            let Parameter { range, default, .. } = &parameters[i];
            given(i).unwrap_or(*default).clamp(*range.start(), *range.end())
        };
        if self == Self::Leaves {
            return leaves(size, aspect, [number(0), number(1), number(2)]);
        }
        let sides = DVec2::new(aspect, 1.0) / aspect.max(1.0);
        sampled(size, |at| {
            // From the middle, the longer side from −1 to 1.
            let place = (2.0 * at - 1.0) * sides;
            match self {
                Self::Window => {
                    let bar = number(2);
                    let inside = |x: f64, count: f64| {
                        let pane = (x * count).rem_euclid(1.0);
                        pane > 0.5 * bar && pane < 1.0 - 0.5 * bar
                    };
                    f64::from(u8::from(inside(at.x, number(0)) && inside(at.y, number(1))))
                }
                Self::Ring => {
                    let (outer, inner, soft) = (number(0).max(1e-3), number(1).min(number(0)), number(2).max(1e-3));
                    let r = place.length() / sides.min_element();
                    let edge = 0.5 * soft * outer;
                    step((outer - r) / edge) * if inner > 0.0 { step((r - inner) / edge) } else { 1.0 }
                }
                Self::Checker => {
                    let odd = (at * DVec2::new(number(0), number(1))).floor().element_sum().rem_euclid(2.0) >= 1.0;
                    if odd { number(2) } else { 1.0 }
                }
                Self::Stripes => {
                    let across = DVec2::from_angle(number(2).to_radians()).dot(place);
                    let phase = (0.5 * (across + 1.0) * number(0)).rem_euclid(1.0);
                    // A dark stripe's halves at both ends.
                    f64::from(u8::from((phase - 0.5).abs() < 0.5 * number(1)))
                }
                Self::Gradient => {
                    let along = DVec2::from_angle(number(0).to_radians());
                    let reach = along.abs().dot(sides);
                    let share = (0.5 * (along.dot(place) / reach + 1.0)).clamp(0.0, 1.0);
                    number(1) + share * (number(2) - number(1))
                }
                Self::Softbox => {
                    let from_middle = (2.0 * at - 1.0).abs();
                    // 0 on the plateau, 1 at the sides' middles.
                    let beyond = ((from_middle - number(1)).max(DVec2::ZERO) / (1.0 - number(1)).max(1e-3)).length();
                    let fall = 0.5 * (1.0 + (PI * beyond.min(1.0)).cos());
                    number(0) + (1.0 - number(0)) * fall
                }
                Self::Leaves => 1.0,
            }
        })
    }
}

/// 0 below 0, 1 above 1, smooth between.
fn step(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// The means over texels of a function of the shares of the width and the height.
fn sampled(size: [usize; 2], value: impl Fn(DVec2) -> f64) -> Canvas {
    let scale = DVec2::new(size[0].max(1) as f64, size[1].max(1) as f64);
    Canvas::of_texels(size, |x, y| {
        let mut sum = 0.0;
        for i in 0..SAMPLES * SAMPLES {
            let within = DVec2::new(f64::from(i % SAMPLES), f64::from(i / SAMPLES)) + 0.5;
            sum += value((DVec2::new(x as f64, y as f64) + within / f64::from(SAMPLES)) / scale);
        }
        [single(sum / f64::from(SAMPLES * SAMPLES)); 3]
    })
}

/// Dark leaves before a bright sky, of lengths around a share of the shorter side.
fn leaves(size: [usize; 2], aspect: f64, [count, length, seed]: [f64; 3]) -> Canvas {
    let mut canvas = Canvas::filled(size, [1.0; 3]);
    let texels = DVec2::new(size[0] as f64, size[1] as f64);
    // Texels of a length of 1 along the light's shorter side.
    let unit = texels / (DVec2::new(aspect, 1.0) / aspect.min(1.0));
    let mut random = Random(seed.to_bits());
    let mut mask = Mask::new(size);
    let mut left = count.round();
    while left > 0.0 {
        left -= 1.0;
        let middle = random.point() * texels;
        let along = DVec2::from_angle(TAU * random.share());
        let half = 0.5 * length * (0.6 + 0.8 * random.share());
        let width = half * (0.25 + 0.2 * random.share());
        let side = |i: u32, sign: f64| {
            let x = 2.0 * f64::from(i) / f64::from(LEAF_VERTICES) - 1.0;
            middle + (half * x * along + sign * width * (1.0 - x * x) * along.perp()) * unit
        };
        let upper = (0..LEAF_VERTICES).map(|i| side(i, 1.0));
        let lower = (1..=LEAF_VERTICES).rev().map(|i| side(i, -1.0));
        mask.add_convex(&upper.chain(lower).collect::<Vec<_>>());
    }
    let area = mask.area();
    let sky = canvas.clone();
    canvas.paint(&sky, &mask, 1.0, &area, |_, _| [0.0; 3]);
    canvas
}

/// SplitMix64 (G. L. Steele et al., "Fast splittable pseudorandom number generators", 2014).
struct Random(u64);

impl Random {
    /// From 0 to below 1.
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        // 53 bits are exact.
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn point(&mut self) -> DVec2 {
        DVec2::new(self.share(), self.share())
    }
}

#[cfg(test)]
mod tests {
    use super::super::adjust;
    use super::*;

    #[track_caller]
    fn mean(preset: Preset, aspect: f64, numbers: &[f64], expected: f64, tolerance: f64) {
        let mean = preset.canvas([96, 64], aspect, numbers).mean()[0];
        assert!((mean - expected).abs() <= tolerance, "{preset:?} {numbers:?}: {mean}, not {expected}");
    }

    #[test]
    fn means_are_those_of_the_shapes() {
        mean(Preset::Window, 1.5, &[3.0, 2.0, 0.25], 0.75 * 0.75, 2e-2);
        mean(Preset::Checker, 1.5, &[8.0, 8.0, 0.5], 0.75, 1e-6);
        mean(Preset::Stripes, 1.5, &[8.0, 0.25, 0.0], 0.25, 1e-2);
        mean(Preset::Gradient, 1.5, &[0.0, 0.2, 0.8], 0.5, 1e-6);
        // A hard ring on a light of 3 to 2: radii are shares of half the shorter side.
        mean(Preset::Ring, 1.5, &[1.0, 0.5, 0.0], PI * (1.0 - 0.25) / 6.0, 2e-3);
    }

    #[test]
    fn every_preset_shines_within_0_and_1_and_is_its_own_for_any_numbers() {
        for preset in Preset::ALL {
            let defaults = preset.canvas([48, 32], 1.5, &[]);
            let within = defaults.texels().iter().flatten().all(|value| (0.0..=1.0).contains(value));
            assert!(within && !defaults.is_black(), "{preset:?}");
            for extreme in [f64::NEG_INFINITY, -1.0, 0.0, 1e9, f64::NAN] {
                let canvas = preset.canvas([16, 8], 2.0, &[extreme; 3]);
                assert!(
                    canvas.texels().iter().flatten().all(|value| (0.0..=1.0).contains(value)),
                    "{preset:?} {extreme}"
                );
            }
            assert!(!preset.parameters().is_empty(), "{preset:?} has numbers");
        }
    }

    #[test]
    fn a_ring_is_round_on_a_light_that_is_not_square_and_leaves_follow_their_seed() {
        let ring = Preset::Ring.canvas([60, 20], 3.0, &[]);
        let turned = adjust::turned(&Preset::Ring.canvas([20, 60], 1.0 / 3.0, &[]));
        let worst = ring.texels().iter().zip(turned.texels()).map(|(a, b)| (a[0] - b[0]).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-6, "off by {worst}");
        let [one, same, other] = [1.0, 1.0, 2.0].map(|seed| Preset::Leaves.canvas([32, 32], 1.0, &[40.0, 0.3, seed]));
        assert_eq!(one, same, "the same seed");
        assert_ne!(one, other, "another seed");
    }
}
