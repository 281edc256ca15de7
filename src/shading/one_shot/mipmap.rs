//! The pattern averaged over squares: a mipmap.

use glam::DVec2;

use super::grid::{Grid, HALF, SIDE, index};

/// Halvings of the grid to one texel: 128 is 2⁷.
const HALVINGS: usize = 7;

/// The pattern at 128², 64² … 1² texels, each the mean of four of the level before.
///
/// **Source:** [`crate::refs::ONE_SHOT`], §2.
#[derive(Clone, Debug, PartialEq)]
pub struct Mipmap {
    levels: Vec<Vec<f64>>,
}

impl Mipmap {
    /// The mipmap of a pattern.
    pub fn new(grid: &Grid) -> Self {
        let mut levels = vec![grid.texels().to_vec()];
        for level in 0..HALVINGS {
            let (before, side) = (&levels[level], SIDE >> level);
            let mean = |i: usize, j: usize| {
                let corner = 2 * j * side + 2 * i;
                0.25 * (before[corner] + before[corner + 1] + before[corner + side] + before[corner + side + 1])
            };
            let half = side / 2;
            let next = (0..half).flat_map(|j| (0..half).map(move |i| (i, j))).map(|(i, j)| mean(i, j)).collect();
            levels.push(next);
        }
        Self { levels }
    }

    /// The levels, the finest first, each row by row.
    pub fn levels(&self) -> &[Vec<f64>] {
        &self.levels
    }

    /// ∫ L dA over the square about a point whose half side is `radius`, both in texels.
    ///
    /// Up to the size of the grid, two levels between which the integral is linear in r², each bilinear between its
    /// texels' centres and 0 outside. A larger square has what it covers of the last level's one texel.
    pub fn sum(&self, at: DVec2, radius: f64) -> f64 {
        let side = 2.0 * radius;
        if side >= SIDE as f64 {
            let covered = (radius + HALF - at.abs()).clamp(DVec2::ZERO, DVec2::splat(SIDE as f64)) / SIDE as f64;
            return self.levels[HALVINGS][0] * (SIDE * SIDE) as f64 * covered.x * covered.y;
        }
        let square = side * side;
        if square < 1.0 {
            return square * self.mean(0, at);
        }
        // ⌊log₄ square⌋, from the exponent of the number itself.
        let level = usize::try_from(((square.to_bits() >> 52) - 1023) >> 1).unwrap_or(HALVINGS).min(HALVINGS - 1);
        let below = (2.0 * level as f64).exp2();
        let share = (square - below) / (3.0 * below);
        (1.0 - share) * below * self.mean(level, at) + share * 4.0 * below * self.mean(level + 1, at)
    }

    /// The texel at a level, or the grid's for levels below 0, in which a place of the grid is.
    pub(super) fn texel(&self, level: i32, at: DVec2) -> f64 {
        let level = usize::try_from(level).unwrap_or(0).min(HALVINGS);
        let place = (at + HALF) / (level as f64).exp2();
        let side = SIDE >> level;
        self.levels[level][index(place.y.floor()).min(side - 1) * side + index(place.x.floor()).min(side - 1)]
    }

    /// The mean at a level, bilinear between its texels' centres.
    fn mean(&self, level: usize, at: DVec2) -> f64 {
        let side = SIDE >> level;
        let place = (at + HALF) / (level as f64).exp2() - 0.5;
        let first = place.floor();
        let share = place - first;
        let texel = |x: f64, y: f64| {
            let inside = (0.0..side as f64).contains(&x) && (0.0..side as f64).contains(&y);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number of 0…side")]
            if inside { self.levels[level][y as usize * side + x as usize] } else { 0.0 }
        };
        let row = |y: f64| (1.0 - share.x) * texel(first.x, y) + share.x * texel(first.x + 1.0, y);
        (1.0 - share.y) * row(first.y) + share.y * row(first.y + 1.0)
    }
}
