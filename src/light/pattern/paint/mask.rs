//! How far each texel is covered by what is painted.

use std::ops::Range;

use glam::DVec2;

use super::super::code::single;
use super::Area;
use super::brush::Brush;

/// Strips that a texel's row is cut into to find how far a slanting edge covers it.
const STRIPS: usize = 8;

/// Covered shares of a picture's texels, from 0 to 1. Points are in texels from the picture's upper left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    width: usize,
    height: usize,
    covers: Vec<f32>,
    area: Area,
}

impl Mask {
    /// Nothing covered.
    pub fn new([width, height]: [usize; 2]) -> Self {
        Self { width, height, covers: vec![0.0; width * height], area: Area::default() }
    }

    /// All covered.
    pub fn whole(size: [usize; 2]) -> Self {
        Self { covers: vec![1.0; size[0] * size[1]], area: Area::whole(size), ..Self::new([size[0], size[1]]) }
    }

    /// The covered share of a texel.
    pub fn cover(&self, column: usize, row: usize) -> f32 {
        self.covers[row * self.width + column]
    }

    /// The shares, row by row.
    pub fn covers(&self) -> &[f32] {
        &self.covers
    }

    /// Outside of it nothing is covered.
    pub fn area(&self) -> Area {
        self.area.clone()
    }

    /// Cover whole texels.
    pub fn add_texels(&mut self, texels: impl IntoIterator<Item = usize>) {
        for i in texels {
            self.covers[i] = 1.0;
        }
        self.area = Area::whole([self.width, self.height]);
    }

    /// What a brush covers on its way from a to b, as if it were set down at every point between: the greatest cover
    /// of all. The area that may have changed.
    pub fn add_segment(&mut self, brush: &Brush, a: DVec2, b: DVec2) -> Area {
        let reach = DVec2::splat(brush.reach());
        let area = self.area_between(a.min(b) - reach, a.max(b) + reach);
        for row in area.rows.clone() {
            for column in area.columns.clone() {
                let center = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                let cover = brush.cover(distance_to_segment(center, a, b));
                let known = &mut self.covers[row * self.width + column];
                *known = known.max(single(cover));
            }
        }
        self.area = self.area.union(&area);
        area
    }

    /// The share of each texel that lies in a convex polygon, on top of what was covered before.
    ///
    /// **Accuracy:** exact for sides along rows and columns; a slanting side's cover is within 1/500.
    pub fn add_convex(&mut self, vertices: &[DVec2]) -> Area {
        let corner = |pick: fn(DVec2, DVec2) -> DVec2| vertices.iter().copied().reduce(pick).unwrap_or_default();
        let area = self.area_between(corner(DVec2::min), corner(DVec2::max));
        let mut shares = vec![0.0; area.columns.len()];
        for row in area.rows.clone() {
            shares.fill(0.0);
            for (y, height) in strips(vertices, row) {
                let Some((left, right)) = ends(vertices, y) else { continue };
                for (share, column) in shares.iter_mut().zip(area.columns.clone()) {
                    let inside = right.min(column as f64 + 1.0) - left.max(column as f64);
                    *share += height * inside.clamp(0.0, 1.0);
                }
            }
            let covers = &mut self.covers[row * self.width..][area.columns.clone()];
            for (cover, share) in covers.iter_mut().zip(&shares) {
                *cover = (*cover + single(*share)).min(1.0);
            }
        }
        self.area = self.area.union(&area);
        area
    }

    fn area_between(&self, low: DVec2, high: DVec2) -> Area {
        let range = |low: f64, high: f64, count: usize| -> Range<usize> {
            index(low.floor(), count)..index(high.ceil(), count)
        };
        Area { columns: range(low.x, high.x, self.width), rows: range(low.y, high.y, self.height) }
    }
}

/// A rectangle by two opposite corners.
pub fn rectangle(a: DVec2, b: DVec2) -> Vec<DVec2> {
    vec![a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)]
}

/// Vertices of an ellipse.
const ELLIPSE_VERTICES: u32 = 256;

/// The ellipse in a rectangle of two opposite corners, as a polygon whose area is the ellipse's to 1e-4.
pub fn ellipse(a: DVec2, b: DVec2) -> Vec<DVec2> {
    let (center, half) = (0.5 * (a + b), 0.5 * (b - a));
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(ELLIPSE_VERTICES);
    (0..ELLIPSE_VERTICES).map(|i| center + half * DVec2::from_angle(angle(i))).collect()
}

/// Strips of a texel's row: the height of a point in each, and the strip's share of the row. None has a vertex inside.
fn strips(vertices: &[DVec2], row: usize) -> Vec<(f64, f64)> {
    let top = row as f64;
    let mut ends: Vec<f64> = (0..=STRIPS).map(|i| top + i as f64 / STRIPS as f64).collect();
    ends.extend(vertices.iter().map(|vertex| vertex.y).filter(|y| *y > top && *y < top + 1.0));
    ends.sort_by(f64::total_cmp);
    ends.windows(2).map(|ends| (0.5 * (ends[0] + ends[1]), ends[1] - ends[0])).collect()
}

/// Where a horizontal line enters and leaves a convex polygon.
fn ends(vertices: &[DVec2], y: f64) -> Option<(f64, f64)> {
    let next = vertices.iter().cycle().skip(1);
    let crossings = vertices.iter().zip(next).filter(|(a, b)| (a.y <= y) != (b.y <= y));
    let at = crossings.map(|(a, b)| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    at.fold(None, |ends, x| {
        let (left, right) = ends.unwrap_or((x, x));
        Some((x.min(left), x.max(right)))
    })
}

fn distance_to_segment(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = if along == DVec2::ZERO { 0.0 } else { ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0) };
    p.distance(a + share * along)
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a count of texels")]
fn index(place: f64, count: usize) -> usize {
    place.clamp(0.0, count as f64) as usize
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn total(mask: &Mask) -> f64 {
        mask.covers().iter().map(|cover| f64::from(*cover)).sum()
    }

    #[test]
    fn a_rectangle_covers_exactly_its_area() {
        let mut mask = Mask::new([20, 16]);
        mask.add_convex(&rectangle(DVec2::new(2.25, 3.5), DVec2::new(11.75, 9.125)));
        assert!((total(&mask) - 9.5 * 5.625).abs() < 1e-5, "{}", total(&mask));
        assert!((f64::from(mask.cover(2, 3)) - 0.75 * 0.5).abs() < 1e-7, "a corner has {}", mask.cover(2, 3));
        assert_eq!((mask.cover(5, 5), mask.cover(12, 5)), (1.0, 0.0), "inside and outside");
    }

    #[test]
    fn an_ellipse_and_a_turned_square_cover_their_areas() {
        let mut mask = Mask::new([64, 64]);
        mask.add_convex(&ellipse(DVec2::new(3.3, 10.7), DVec2::new(60.1, 50.2)));
        let area = PI * 28.4 * 19.75;
        assert!((total(&mask) / area - 1.0).abs() < 2e-4, "{} of {area}", total(&mask));
        let mut mask = Mask::new([64, 64]);
        let corner = |i: u32| DVec2::new(31.7, 32.2) + 20.0 * DVec2::from_angle(0.3 + 0.5 * PI * f64::from(i));
        mask.add_convex(&[0, 1, 2, 3].map(corner));
        assert!((total(&mask) / 800.0 - 1.0).abs() < 1e-4, "{} of 800", total(&mask));
    }

    #[test]
    fn shapes_beyond_the_picture_are_cut_off() {
        let mut mask = Mask::new([10, 10]);
        mask.add_convex(&rectangle(DVec2::new(-50.0, -3.0), DVec2::new(4.0, 300.0)));
        assert!((total(&mask) - 40.0).abs() < 1e-5, "{}", total(&mask));
        let far = mask.add_segment(&Brush::new(4.0, 1.0), DVec2::splat(-90.0), DVec2::new(-90.0, 200.0));
        assert!(far.is_empty(), "{far:?}");
    }
}
