//! What solids hide of a linear light. All are convex: from outside, one interval; from within, all that is outside.

use glam::{DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

use super::fan::{Fan, Range, Span};
use super::flat::Fall;
use super::round::{Place, Round};
use crate::surface::ON_SURFACE;
use crate::visibility::interval::Segments;

/// The common part of slabs |xᵢ| ≤ `half`ᵢ and of the inside of a curved face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Solid {
    half: DVec3,
    /// The first axis that has a slab; all after it have one.
    first: usize,
    round: Option<Round>,
    size: f64,
    /// The square of the radius of a ball about it.
    reach_squared: f64,
}

/// A corner of the fan's triangle, cut by slabs.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Its shares of A and B; its direction is t = y/(x + y).
    shares: DVec2,
    at: DVec3,
}

/// The triangle, cut by two planes at most.
type Cut = SmallVec<[Corner; 6]>;

/// How far beyond an edge a tangent may touch, relative to the sizes involved, and be taken for a touch at the edge.
const SLACK: f64 = 1e-12;

impl Solid {
    /// A box.
    pub(super) fn of_box(size: DVec3) -> Self {
        let half = 0.5 * size;
        Self { half, first: 0, round: None, size: half.max_element(), reach_squared: half.length_squared() }
    }

    /// The part of a round body of that height.
    pub(super) fn of_round(round: Round, height: f64) -> Self {
        let half = DVec3::new(f64::INFINITY, f64::INFINITY, 0.5 * height);
        let rise = if half.z.is_finite() { half.z } else { 0.0 };
        let reach_squared = round.radius * round.radius + rise * rise;
        let first = if half.z.is_finite() { 2 } else { 3 };
        Self { half, first, round: Some(round), size: round.radius.max(rise), reach_squared }
    }

    /// Takes away what it hides. A point on its surface is hidden what lies below the tangent planes, and outside.
    pub(super) fn hide(&self, fan: &Fan, seen: &mut Segments) {
        let mut fan = *fan;
        let mut outside = false;
        let mut below = Some(Range::ALL);
        let mut below_plane = |outward: DVec3| {
            below = below.and_then(|below| below.where_positive(-outward.dot(fan.a), -outward.dot(fan.b)));
        };
        for (axis, unit) in DVec3::AXES.into_iter().enumerate().skip(self.first) {
            let beyond = fan.p[axis].abs() - self.half[axis];
            if beyond.abs() <= ON_SURFACE * self.size {
                fan.p[axis] = self.half[axis].copysign(fan.p[axis]);
                below_plane(fan.p[axis].signum() * unit);
            } else {
                outside |= beyond > 0.0;
            }
        }
        match self.round.map(|round| round.place(fan.p)) {
            Some(Place::On(outward)) => below_plane(outward),
            Some(Place::Outside) => outside = true,
            Some(Place::Inside) | None => {}
        }
        if outside {
            let hidden = match &self.round {
                Some(round) => self.behind_round(round, &fan),
                None => self.behind_faces(&fan),
            };
            super::hide_range(hidden, seen);
        } else if let Some(below) = below {
            let within = self.chord(&fan).unwrap_or(Range { from: f64::INFINITY, to: f64::INFINITY });
            seen.hide(below.from, below.to.min(within.from));
            seen.hide(below.from.max(within.to), below.to);
        }
    }

    /// The range of a box that holds all it can hide together with what is inside.
    pub(super) fn may_hide(&self, fan: &Fan) -> Option<Range> {
        let outside = fan.p.abs().cmpgt(self.half).any();
        if outside { self.behind_faces(fan) } else { Some(Range::ALL) }
    }

    /// The part of the light inside, seen from p inside or on the surface.
    fn chord(&self, fan: &Fan) -> Option<Range> {
        let [a, b] = [fan.p + fan.a, fan.p + fan.b];
        let mut within = Range::ALL;
        for axis in self.first..3 {
            let half = self.half[axis];
            // What a point on a face sees of its own half-space is told by the directions alone.
            for side in [1.0, -1.0].into_iter().filter(|side| side * fan.p[axis] != half) {
                within = within.where_not_negative(half - side * a[axis], half - side * b[axis])?;
            }
        }
        within.and(match &self.round {
            Some(round) => round.chord([a, b])?,
            None => Range::ALL,
        })
    }

    /// What a box hides from outside: the span of what its faces do that are turned to p.
    fn behind_faces(&self, fan: &Fan) -> Option<Range> {
        let mut span = Span::EMPTY;
        for axis in 0..3 {
            if fan.p[axis].abs() > self.half[axis] {
                let face = Fall::new(fan, axis, self.half[axis].copysign(fan.p[axis]));
                let half = DVec2::new(self.half[(axis + 1) % 3], self.half[(axis + 2) % 3]);
                if let Some(Range { from, to }) = face.through_rectangle(half) {
                    span.add(from);
                    span.add(to);
                }
            }
        }
        span.range()
    }

    /// What a round body hides from outside: the span of its tangents that touch it before the light, and of the points
    /// where the sides of the triangle, cut by its flat faces, enter and leave it.
    fn behind_round(&self, round: &Round, fan: &Fan) -> Option<Range> {
        if self.is_beside(fan) {
            return None;
        }
        let tangents = round.tangents(fan)?;
        let mut span = Span::EMPTY;
        let ends = [tangents.from, tangents.to];
        let touches = ends.map(|t| t > 0.0 && t < 1.0 && self.touches(round, fan, t));
        for (t, _) in ends.into_iter().zip(touches).filter(|&(_, touches)| touches) {
            span.add(t);
        }
        if touches == [true, true] {
            return span.range();
        }
        let cut = self.cut(fan)?;
        for (i, from) in cut.iter().enumerate() {
            let to = &cut[(i + 1) % cut.len()];
            if let Some(inside) = round.chord([from.at, to.at]) {
                for s in [inside.from, inside.to] {
                    let shares = from.shares.lerp(to.shares, s);
                    span.add(shares.y / (shares.x + shares.y));
                }
            }
        }
        span.range()
    }

    /// Whether the plane of the fan misses the ball about the body, by more than the rounding of its normal, which may be
    /// all there is of it where p lies on the light's own line.
    fn is_beside(&self, fan: &Fan) -> bool {
        let across = fan.a.cross(fan.b);
        let height = across.dot(fan.p);
        let noise = 1e-26 * fan.a.length_squared() * fan.b.length_squared() * fan.p.length_squared();
        height * height > 1.01 * self.reach_squared * across.length_squared() + noise
    }

    /// Whether a tangent touches the body between p and the light.
    fn touches(&self, round: &Round, fan: &Fan, t: f64) -> bool {
        let w = fan.at(t);
        let s = round.touch(fan.p, w);
        let z = fan.p.z + s * w.z;
        s > 0.0 && s <= 1.0 && z.abs() <= self.half.z + SLACK * (self.size + fan.p.length())
    }

    /// The triangle between the flat faces; none when nothing of it lies there.
    fn cut(&self, fan: &Fan) -> Option<Cut> {
        let corner = |shares: DVec2, at: DVec3| Corner { shares, at };
        let triangle: Cut =
            smallvec![corner(DVec2::ZERO, fan.p), corner(DVec2::X, fan.p + fan.a), corner(DVec2::Y, fan.p + fan.b),];
        if self.half.z.is_infinite() {
            return Some(triangle);
        }
        let least = SLACK * self.size;
        let below = cut(&triangle, |at| self.half.z - at.z, least)?;
        cut(&below, |at| self.half.z + at.z, least)
    }
}

/// The part of a convex polygon where a linear function is ≥ 0; none where it is nowhere above `least`.
fn cut(polygon: &Cut, value: impl Fn(DVec3) -> f64, least: f64) -> Option<Cut> {
    if !polygon.iter().any(|corner| value(corner.at) > least) {
        return None;
    }
    let mut inside = Cut::new();
    for (i, from) in polygon.iter().enumerate() {
        let to = &polygon[(i + 1) % polygon.len()];
        let (at_from, at_to) = (value(from.at), value(to.at));
        if at_from >= 0.0 {
            inside.push(*from);
        }
        if (at_from > 0.0 && at_to < 0.0) || (at_from < 0.0 && at_to > 0.0) {
            let s = at_from / (at_from - at_to);
            inside.push(Corner { shares: from.shares.lerp(to.shares, s), at: from.at.lerp(to.at, s) });
        }
    }
    Some(inside)
}
