//! Symmetries that what is painted has.

use std::f64::consts::TAU;

use glam::{DAffine2, DMat2, DVec2};

/// Where what is painted is repeated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Symmetry {
    /// Nowhere.
    #[default]
    Off,
    /// Left is right.
    X,
    /// Top is bottom.
    Y,
    /// Both.
    Both,
    /// So many times around the middle.
    Radial(u32),
}

impl Symmetry {
    /// From what is painted to each of its images in a picture of that size, itself the first.
    pub fn maps(self, [width, height]: [usize; 2]) -> Vec<DAffine2> {
        let size = DVec2::new(width as f64, height as f64);
        let mirror = |signs: DVec2| DAffine2 {
            matrix2: DMat2::from_diagonal(signs),
            translation: size * 0.5 * (DVec2::ONE - signs),
        };
        let [x, y] = [DVec2::new(-1.0, 1.0), DVec2::new(1.0, -1.0)];
        match self {
            Self::Off => vec![DAffine2::IDENTITY],
            Self::X => vec![DAffine2::IDENTITY, mirror(x)],
            Self::Y => vec![DAffine2::IDENTITY, mirror(y)],
            Self::Both => vec![DAffine2::IDENTITY, mirror(x), mirror(y), mirror(x * y)],
            Self::Radial(count) => {
                let turn = |i: u32| {
                    let matrix2 = DMat2::from_angle(TAU * f64::from(i) / f64::from(count.max(1)));
                    DAffine2 { matrix2, translation: 0.5 * size - matrix2 * (0.5 * size) }
                };
                (0..count.max(1)).map(turn).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Brush, Canvas, Stroke, adjust};
    use super::*;

    fn painted(symmetry: Symmetry) -> Canvas {
        let mut stroke = Stroke::new(Brush::new(7.0, 0.5), symmetry, [32, 32]);
        for point in [DVec2::new(4.25, 6.5), DVec2::new(13.75, 9.0), DVec2::new(11.5, 20.0)] {
            stroke.to(point);
        }
        Canvas::filled([32, 32], [0.25; 3]).painted(stroke.mask(), 0.75, |_, _| [1.0, 0.5, 0.0])
    }

    #[test]
    fn mirrored_strokes_are_equal_texel_by_texel() {
        let [off, x, y, both] = [Symmetry::Off, Symmetry::X, Symmetry::Y, Symmetry::Both].map(painted);
        assert_eq!(adjust::mirrored(&x), x, "left and right");
        assert_eq!(adjust::flipped(&y), y, "top and bottom");
        assert_eq!((adjust::mirrored(&both), adjust::flipped(&both)), (both.clone(), both), "both");
        assert_ne!(adjust::mirrored(&off), off, "without symmetry they are not");
    }

    #[test]
    fn four_times_around_is_the_same_after_a_quarter_turn() {
        let around = painted(Symmetry::Radial(4));
        let turned = adjust::turned(&around);
        let differences = around.texels().iter().flatten().zip(turned.texels().iter().flatten());
        let worst = differences.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max);
        assert!(worst < 1e-6, "off by {worst}");
    }
}
