//! Polar axes: an angle as an angle, zero upwards and positive to the right, and a value as a distance from a pole.

use super::axis::Axis;

/// Angles are marked in steps of this many degrees where there is room, and of [`WIDE_STEP`] where there is less.
const STEP: f64 = 15.0;
const WIDE_STEP: f64 = 30.0;

/// The radius from which there is room for marks each [`STEP`], in the picture's units.
const ROOMY: f64 = 110.0;

/// Room for the angles' numbers outside the outermost ring, in the picture's units.
pub const MARGIN: f64 = 18.0;

/// Angles beyond ±90° by less than this are rounding.
const SLACK: f64 = 1e-9;

/// Polar axes in a picture whose ordinate points down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dial {
    /// The pole.
    pub pole: [f64; 2],
    /// From the pole, at 0, to the outermost ring.
    pub axis: Axis,
    /// Whether only the upper half is shown.
    pub half: bool,
}

impl Dial {
    /// The pole and the radius of the largest dial in a frame of left, right, bottom and top, for angles within `range`.
    pub fn fitted([left, right, bottom, top]: [f64; 4], range: [f64; 2]) -> ([f64; 2], f64, bool) {
        let half = range.iter().all(|angle| angle.abs() <= 90.0 + SLACK);
        let (width, height) = (right - left - 2.0 * MARGIN, bottom - top - 2.0 * MARGIN);
        let radius = (0.5 * width).min(if half { height } else { 0.5 * height }).max(1.0);
        let middle = f64::midpoint(bottom, top);
        let below = if half { middle + 0.5 * radius } else { middle };
        ([f64::midpoint(left, right), below], radius, half)
    }

    /// The outermost ring.
    pub fn radius(&self) -> f64 {
        self.axis.sides[1]
    }

    /// Where an angle in degrees and a distance from the pole lie.
    pub fn place(&self, degrees: f64, distance: f64) -> [f64; 2] {
        let (sine, cosine) = degrees.to_radians().sin_cos();
        [self.pole[0] + distance * sine, self.pole[1] - distance * cosine]
    }

    /// The angle of a place, degrees, −180…180.
    pub fn angle_of(&self, [x, y]: [f64; 2]) -> f64 {
        (x - self.pole[0]).atan2(self.pole[1] - y).to_degrees()
    }

    /// Angles that are marked.
    pub fn marks(&self) -> Vec<f64> {
        let step = if self.radius() >= ROOMY { STEP } else { WIDE_STEP };
        let (first, last) = if self.half { (-90.0, 90.0) } else { (-180.0 + step, 180.0) };
        let mut marks = vec![first];
        while marks.last().is_some_and(|mark| *mark + 0.5 * step < last) {
            marks.extend(marks.last().map(|mark| mark + step));
        }
        marks
    }

    /// A curve in pieces, each through places; it is cut where it leaves the outermost ring, and is at the pole where its
    /// value is below the axis.
    pub fn pieces(&self, degrees: &[f64], values: &[f64]) -> Vec<Vec<[f64; 2]>> {
        let distance = |value: f64| match self.axis.at(value) {
            Some(at) if at.is_finite() => Some(at.max(0.0)),
            None if value.is_finite() => Some(0.0),
            _ => None,
        };
        let points: Vec<_> = degrees.iter().zip(values).map(|(x, y)| Some((*x, distance(*y)?))).collect();
        let radius = self.radius() * (1.0 + SLACK);
        let mut pieces = Vec::new();
        let mut piece: Vec<[f64; 2]> = Vec::new();
        let mut before: Option<(f64, f64)> = None;
        for point in points {
            if let (Some(a), Some(b)) = (before, point)
                && (a.1 > radius) != (b.1 > radius)
            {
                let share = (self.radius() - a.1) / (b.1 - a.1);
                piece.push(self.place(a.0 + share * (b.0 - a.0), self.radius()));
            }
            match point {
                Some((degrees, distance)) if distance <= radius => piece.push(self.place(degrees, distance)),
                _ => pieces.push(std::mem::take(&mut piece)),
            }
            before = point;
        }
        pieces.push(piece);
        pieces.retain(|piece| piece.len() > 1);
        pieces
    }
}

#[cfg(test)]
mod tests {
    use super::super::axis::Steps;
    use super::*;

    fn dial(half: bool) -> Dial {
        Dial { pole: [100.0, 100.0], axis: Axis::new([0.0, 2.0], [0.0, 50.0], Steps::Decimal), half }
    }

    #[track_caller]
    fn check(place: [f64; 2], expected: [f64; 2]) {
        let apart = (place[0] - expected[0]).hypot(place[1] - expected[1]);
        assert!(apart < 1e-9, "{place:?} is not {expected:?}");
    }

    #[test]
    fn zero_is_up_and_angles_turn_to_the_right() {
        let dial = dial(true);
        check(dial.place(0.0, 50.0), [100.0, 50.0]);
        check(dial.place(90.0, 25.0), [125.0, 100.0]);
        for angle in [-170.0, -90.0, 0.0, 33.0, 179.0] {
            assert!((dial.angle_of(dial.place(angle, 7.0)) - angle).abs() < 1e-9, "{angle} from its place");
        }
    }

    #[test]
    fn a_half_is_shown_where_that_is_enough_and_fills_its_frame() {
        let (pole, radius, half) = Dial::fitted([0.0, 400.0, 150.0, 0.0], [-90.0, 90.0]);
        assert!(half && pole[0] == 200.0, "{pole:?}");
        assert!((radius + 2.0 * MARGIN - 150.0).abs() < 1e-9, "{radius}");
        let (_, radius, half) = Dial::fitted([0.0, 400.0, 150.0, 0.0], [-120.0, 90.0]);
        assert!(!half && (radius + MARGIN - 75.0).abs() < 1e-9, "{radius}");
    }

    #[test]
    fn marks_go_around_once() {
        assert_eq!(dial(true).marks(), [-90.0, -60.0, -30.0, 0.0, 30.0, 60.0, 90.0], "half");
        let whole = dial(false).marks();
        assert_eq!((whole.len(), whole[0], whole[11]), (12, -150.0, 180.0), "whole");
    }

    #[test]
    fn a_curve_is_cut_where_it_leaves_the_rings() {
        let pieces = dial(true).pieces(&[-60.0, -30.0, 0.0, 30.0, 60.0], &[1.0, 1.0, 3.0, 1.0, -1.0]);
        assert_eq!(pieces.len(), 2, "{pieces:?}");
        let [first, second] = [&pieces[0], &pieces[1]].map(|piece| piece.as_slice());
        check(*first.last().expect("places"), dial(true).place(-15.0, 50.0));
        check(second[0], dial(true).place(15.0, 50.0));
        check(*second.last().expect("places"), [100.0, 100.0]);
    }

    #[test]
    fn what_is_no_number_is_left_out() {
        let pieces = dial(true).pieces(&[0.0, 10.0, 20.0, 30.0, 40.0], &[1.0, 1.0, f64::NAN, 1.0, 1.0]);
        assert_eq!(pieces.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2], "{pieces:?}");
    }
}
