//! A round brush, and a stroke of it.

use glam::{DAffine2, DVec2};

use super::{Area, Mask, Symmetry};

/// Half the width of the least edge, texels: an edge of less would show steps.
const LEAST_HALF_EDGE: f64 = 0.5;

/// A round brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Diameter, texels.
    pub size: f64,
    /// From 0, falling off from the middle, to 1, hard to the edge.
    pub hardness: f64,
}

impl Brush {
    /// A brush of that diameter and hardness.
    pub fn new(size: f64, hardness: f64) -> Self {
        Self { size: size.max(0.0), hardness: hardness.clamp(0.0, 1.0) }
    }

    /// How much it covers at a distance from its middle: smoothstep over the edge, which lies between hardness·r and r
    /// but is at least a texel wide.
    ///
    /// Set down once, it covers π(μ² + e²/5) texels, μ the edge's middle and e half its width.
    pub fn cover(&self, distance: f64) -> f64 {
        let (middle, half) = self.edge();
        let t = ((middle + half - distance) / (2.0 * half)).clamp(0.0, 1.0);
        t * t * (3.0 - 2.0 * t)
    }

    /// Beyond it nothing is covered.
    pub fn reach(&self) -> f64 {
        let (middle, half) = self.edge();
        middle + half
    }

    /// The distance of the edge's middle, and half its width.
    fn edge(&self) -> (f64, f64) {
        let radius = 0.5 * self.size;
        (0.5 * radius * (1.0 + self.hardness), (0.5 * radius * (1.0 - self.hardness)).max(LEAST_HALF_EDGE))
    }
}

/// A stroke of a brush, with its images in the symmetry. However often it crosses itself, it covers once.
#[derive(Clone, Debug)]
pub struct Stroke {
    brush: Brush,
    maps: Vec<DAffine2>,
    mask: Mask,
    last: Option<DVec2>,
}

impl Stroke {
    /// A stroke that has not touched the picture yet.
    pub fn new(brush: Brush, symmetry: Symmetry, size: [usize; 2]) -> Self {
        Self { brush, maps: symmetry.maps(size), mask: Mask::new(size), last: None }
    }

    /// Set the brush down at a point, or lead it there from the last one. The area that may have changed.
    pub fn to(&mut self, point: DVec2) -> Area {
        let from = self.last.replace(point).unwrap_or(point);
        let mut changed = Area::default();
        for map in &self.maps {
            let [a, b] = [from, point].map(|point| map.transform_point2(point));
            changed = changed.union(&self.mask.add_segment(&self.brush, a, b));
        }
        changed
    }

    /// What it covers.
    pub fn mask(&self) -> &Mask {
        &self.mask
    }

    /// Where it is.
    pub fn last(&self) -> Option<DVec2> {
        self.last
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn total(stroke: &Stroke) -> f64 {
        stroke.mask().covers().iter().map(|cover| f64::from(*cover)).sum()
    }

    #[test]
    fn a_brush_set_down_covers_what_its_profile_integrates_to() {
        for (size, hardness) in [(16.0, 1.0), (16.0, 0.5), (21.5, 0.0), (5.0, 0.8)] {
            let brush = Brush::new(size, hardness);
            let mut stroke = Stroke::new(brush, Symmetry::Off, [40, 40]);
            stroke.to(DVec2::new(20.3, 19.6));
            let (middle, half) = brush.edge();
            let expected = PI * (middle * middle + half * half / 5.0);
            let error = total(&stroke) - expected;
            assert!(error.abs() < 0.6, "size {size}, hardness {hardness}: off by {error} of {expected} texels");
        }
    }

    #[test]
    fn a_straight_stroke_is_a_bar_with_two_half_disks() {
        let mut stroke = Stroke::new(Brush::new(10.0, 1.0), Symmetry::Off, [80, 40]);
        for x in [20.0, 31.0, 60.0] {
            stroke.to(DVec2::new(x, 20.0));
        }
        let expected = 40.0 * 10.0 + PI * (25.0 + 0.05);
        assert!((total(&stroke) / expected - 1.0).abs() < 2e-3, "{} of {expected}", total(&stroke));
    }

    #[test]
    fn crossing_itself_covers_once() {
        let brush = Brush::new(9.0, 0.4);
        let [mut once, mut twice] =
            [Stroke::new(brush, Symmetry::Off, [40, 40]), Stroke::new(brush, Symmetry::Off, [40, 40])];
        once.to(DVec2::new(10.0, 20.0));
        once.to(DVec2::new(30.0, 20.0));
        for x in [10.0, 30.0, 10.0] {
            twice.to(DVec2::new(x, 20.0));
        }
        assert_eq!(once.mask(), twice.mask(), "there and back");
    }
}
