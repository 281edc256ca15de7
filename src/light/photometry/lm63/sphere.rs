//! Tables of the photometric types A and B as tables of type C.
//!
//! Both look along the beam at V = H = 0, which is nadir here, with V up and H to the right as the luminaire sees them: up is
//! +Y and right is +X of the light. Type A turns by H about up and then rises by V; type B turns by V about right and then
//! moves by H towards it.
//!
//! **Source:** [`crate::refs::LM_63`]; that the three types share the direction V = H = γ = 0 is CIE 121's convention.

use glam::DVec3;

use crate::light::photometry::distribution::{mixed, place};

/// The widest step of the table of type C, in degrees.
const STEP: f64 = 1.0;

/// The photometric type of a table that is not of type C.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Type {
    /// Of car lamps: about the vertical.
    A,
    /// Of floodlights: about the horizontal.
    B,
}

/// A table by increasing angles V and H in degrees, all V of an H together. It is dark beyond them.
pub(super) struct Sphere {
    pub(super) kind: Type,
    pub(super) vertical: Vec<f64>,
    /// From 0 where the left is as the right.
    pub(super) horizontal: Vec<f64>,
    pub(super) candela: Vec<f64>,
}

/// A table of type C: angles γ, angles C from 0 to 360, and the intensities of all γ of a C together.
pub(super) type TypeC = (Vec<f64>, Vec<f64>, Vec<f64>);

impl Type {
    /// V and H of a direction, in degrees.
    fn angles(self, direction: DVec3) -> [f64; 2] {
        let DVec3 { x, y, z } = direction;
        let [vertical, horizontal] = match self {
            Self::A => [y.atan2(x.hypot(z)), x.atan2(-z)],
            Self::B => [y.atan2(-z), x.atan2(y.hypot(z))],
        };
        [vertical.to_degrees(), horizontal.to_degrees()]
    }
}

impl Sphere {
    /// The intensity in a direction, bilinear between the angles.
    fn candela(&self, direction: DVec3) -> f64 {
        let [vertical, horizontal] = self.kind.angles(direction);
        let is_symmetric = self.horizontal[0] == 0.0;
        let horizontal = if is_symmetric { horizontal.abs() } else { horizontal };
        let (Some((v, up)), Some((h, right))) =
            (within(&self.vertical, vertical), within(&self.horizontal, horizontal))
        else {
            return 0.0;
        };
        let at = |h: usize, v: usize| self.candela[h * self.vertical.len() + v];
        mixed(mixed(at(h, v), at(h, v + 1), up), mixed(at(h + 1, v), at(h + 1, v + 1), up), right)
    }

    /// As a table of type C that has all of its angles as γ, and steps of a degree.
    pub(super) fn type_c(&self) -> TypeC {
        let all = || self.vertical.iter().chain(&self.horizontal).map(|angle| angle.abs());
        let even = (0..).map(|i| STEP * f64::from(i)).take_while(|gamma| *gamma <= 90.0);
        let mut gammas: Vec<f64> = all().chain(even).collect();
        gammas.sort_by(f64::total_cmp);
        gammas.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        let planes: Vec<f64> = (0..=360).map(f64::from).collect();
        let direction = |c: f64, gamma: f64| {
            let ((sin_c, cos_c), (sin, cos)) = (c.to_radians().sin_cos(), gamma.to_radians().sin_cos());
            DVec3::new(sin * cos_c, sin * sin_c, -cos)
        };
        let candela =
            planes.iter().flat_map(|c| gammas.iter().map(|gamma| self.candela(direction(*c, *gamma)))).collect();
        (gammas, planes, candela)
    }
}

/// The piece that an angle is in, and its share of it; none beyond the ends, which a last bit does not reach.
fn within(angles: &[f64], angle: f64) -> Option<(usize, f64)> {
    let (first, last) = (angles[0], angles[angles.len() - 1]);
    (angle > first - 1e-9 && angle < last + 1e-9).then(|| place(angles, angle))
}
