//! Outlines that are made between two points: regular polygons, stars, letters and the like.

use std::f64::consts::TAU;

use glam::DVec2;

use super::letter;
use super::new_light::LEAST_SIZE;
use crate::light::Polygon;

/// What kind of outline is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum OutlineKind {
    /// Between two corners.
    #[default]
    Rectangle,
    /// With sides of equal length.
    Regular,
    /// A regular polygon of so many sides that it passes for a circle.
    Circle,
    /// A disk, which is round.
    Disk,
    /// A star.
    Star,
    /// Like an L, between two corners.
    Ell,
    /// Like a T, between two corners.
    Tee,
    /// A letter or a digit.
    Letter,
}

/// An outline to be made, with the numbers of every kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outline {
    /// Which kind.
    pub kind: OutlineKind,
    /// Sides of a regular polygon.
    pub sides: u32,
    /// Sides of a circle.
    pub segments: u32,
    /// Points of a star.
    pub points: u32,
    /// Inner radius of a star, as a share of the outer.
    pub inner: f64,
    /// Width of the strokes of an L or T, as a share of its shorter side.
    pub stroke: f64,
    /// Which letter.
    pub letter: char,
}

impl OutlineKind {
    /// All of them, in menu order.
    pub const ALL: [Self; 8] =
        [Self::Rectangle, Self::Regular, Self::Circle, Self::Disk, Self::Star, Self::Ell, Self::Tee, Self::Letter];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rectangle => "Rectangle",
            Self::Regular => "Regular polygon",
            Self::Circle => "Circle",
            Self::Disk => "Disk",
            Self::Star => "Star",
            Self::Ell => "L shape",
            Self::Tee => "T shape",
            Self::Letter => "Letter",
        }
    }

    /// What it is, and how it is drawn.
    pub fn hint(self) -> &'static str {
        match self {
            Self::Rectangle => "A rectangle, from corner to corner",
            Self::Regular => "Equal sides, from the centre to a corner",
            Self::Circle => "A polygon of many sides, from the centre to its rim",
            Self::Disk => "A round light, from the centre to its rim",
            Self::Star => "A star, from the centre to a point",
            Self::Ell => "Two strokes like an L, from corner to corner",
            Self::Tee => "Two strokes like a T, from corner to corner",
            Self::Letter => "A letter or digit, from its centre to half its height",
        }
    }

    /// Whether it lies between two corners; others are drawn from their centre.
    pub fn is_by_corners(self) -> bool {
        matches!(self, Self::Rectangle | Self::Ell | Self::Tee)
    }
}

impl Default for Outline {
    fn default() -> Self {
        let kind = OutlineKind::default();
        Self { kind, sides: 6, segments: 48, points: 5, inner: 0.45, stroke: 0.35, letter: 'A' }
    }
}

impl Outline {
    /// What a light of this outline is called.
    pub fn light_name(&self) -> String {
        match self.kind {
            OutlineKind::Regular => format!("{}-gon", self.sides),
            OutlineKind::Letter => format!("letter {}", self.letter),
            _ => self.kind.name().to_lowercase(),
        }
    }

    /// The outline between two points, or why there is none.
    pub fn vertices(&self, from: DVec2, to: DVec2) -> Result<Vec<DVec2>, String> {
        let span = to - from;
        let size = if self.kind.is_by_corners() { span.abs().min_element() } else { span.length() };
        if size.is_nan() || size < LEAST_SIZE {
            return Err(format!("{} without size: drag further", self.kind.name()));
        }
        let radius = span.length();
        let heading = span.y.atan2(span.x);
        let vertices = match self.kind {
            OutlineKind::Rectangle => unit_rectangle(from, to, &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]),
            OutlineKind::Regular => ring(from, self.sides, |_| radius, heading),
            OutlineKind::Circle | OutlineKind::Disk => ring(from, self.segments, |_| radius, heading),
            OutlineKind::Star => {
                ring(from, 2 * self.points, |i| if i % 2 == 0 { radius } else { self.inner * radius }, heading)
            }
            OutlineKind::Ell => {
                let DVec2 { x, y } = self.strokes(span);
                unit_rectangle(from, to, &[(0.0, 0.0), (1.0, 0.0), (1.0, y), (x, y), (x, 1.0), (0.0, 1.0)])
            }
            OutlineKind::Tee => {
                let DVec2 { x, y } = self.strokes(span);
                let [left, right, bar] = [0.5 - 0.5 * x, 0.5 + 0.5 * x, 1.0 - y];
                let stem = [(left, 0.0), (right, 0.0), (right, bar)];
                let bar = [(1.0, bar), (1.0, 1.0), (0.0, 1.0), (0.0, bar), (left, bar)];
                unit_rectangle(from, to, &[stem.as_slice(), &bar].concat())
            }
            OutlineKind::Letter => letter::outline(self.letter, from, 2.0 * radius)?,
        };
        let polygon = Polygon { vertices, two_sided: false };
        match polygon.check() {
            Ok(()) => Ok(polygon.vertices),
            Err(wrong) => Err(format!("{} cannot be made: {wrong}", self.kind.name())),
        }
    }

    /// Widths of an upright and a level stroke, as shares of width and height.
    fn strokes(&self, span: DVec2) -> DVec2 {
        let span = span.abs();
        self.stroke * span.min_element() / span
    }
}

/// Points given by shares of the rectangle between two corners; its first corner at the bottom left.
fn unit_rectangle(from: DVec2, to: DVec2, shares: &[(f64, f64)]) -> Vec<DVec2> {
    let (min, max) = (from.min(to), from.max(to));
    shares.iter().map(|(x, y)| DVec2::new(mix(min.x, max.x, *x), mix(min.y, max.y, *y))).collect()
}

/// Between a and b, exact at both.
fn mix(a: f64, b: f64, share: f64) -> f64 {
    (1.0 - share) * a + share * b
}

/// Points about a centre, evenly, the first at `heading`.
fn ring(center: DVec2, count: u32, radius: impl Fn(u32) -> f64, heading: f64) -> Vec<DVec2> {
    let at = |i: u32| center + radius(i) * DVec2::from_angle(heading + TAU * f64::from(i) / f64::from(count));
    (0..count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec2;

    fn made(kind: OutlineKind, from: DVec2, to: DVec2) -> Polygon {
        let vertices = Outline { kind, ..Outline::default() }.vertices(from, to);
        Polygon { vertices: vertices.unwrap_or_else(|why| panic!("{kind:?}: {why}")), two_sided: false }
    }

    #[test]
    fn every_outline_is_made_wherever_it_is_dragged_to_and_runs_counter_clockwise() {
        for kind in OutlineKind::ALL {
            for to in [dvec2(1.5, 0.9), dvec2(0.2, 1.1), dvec2(0.4, -0.5), dvec2(1.7, -0.3)] {
                let polygon = made(kind, dvec2(1.0, 0.5), to);
                assert!(polygon.signed_area() > 0.0, "{kind:?} to {to}");
            }
        }
    }

    #[test]
    fn areas_are_those_of_geometry() {
        let (from, to) = (dvec2(0.0, 0.0), dvec2(0.6, 0.8));
        for (kind, area) in [
            (OutlineKind::Rectangle, 0.48),
            // A hexagon of side 1.
            (OutlineKind::Regular, 1.5 * 3.0_f64.sqrt()),
            (OutlineKind::Circle, 24.0 * (TAU / 48.0).sin()),
            // Ten triangles with sides 1 and 0.45 and 36° between.
            (OutlineKind::Star, 5.0 * 0.45 * (TAU / 10.0).sin()),
            // Strokes 0.21 wide.
            (OutlineKind::Ell, 0.21 * (0.6 + 0.8 - 0.21)),
            (OutlineKind::Tee, 0.21 * (0.6 + 0.8 - 0.21)),
        ] {
            let found = made(kind, from, to).area();
            assert!((found - area).abs() < 1e-12, "{kind:?}: {found}, not {area}");
        }
    }

    #[test]
    fn a_corner_of_a_regular_polygon_and_a_point_of_a_star_lie_where_they_were_dragged_to() {
        let to = dvec2(1.3, -0.4);
        for kind in [OutlineKind::Regular, OutlineKind::Star] {
            let first = made(kind, dvec2(0.5, 0.5), to).vertices[0];
            assert!(first.distance(to) < 1e-12, "{kind:?}: {first}");
        }
    }

    #[test]
    fn without_size_nothing_is_made_and_that_is_said() {
        for kind in OutlineKind::ALL {
            let outline = Outline { kind, ..Outline::default() };
            let why = outline.vertices(DVec2::ONE, DVec2::ONE).expect_err("no size");
            assert!(why.contains(kind.name()), "{why}");
        }
        let flat = Outline::default().vertices(DVec2::ZERO, dvec2(1.0, 0.0));
        assert!(flat.is_err(), "a rectangle without height: {flat:?}");
    }
}
