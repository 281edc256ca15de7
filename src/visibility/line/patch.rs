//! What a bicubic patch hides of a linear light.
//!
//! In the affine coordinates (s, y, z) of x = p + s·A + y·(B − A) + z·(A × B) the light's plane, z = 0, cuts a patch in a
//! curve whose points hide t = y/s. The control points of a piece bound what it hides by the slice z = 0 of their convex
//! hull, and a curve that joins two sides of a piece hides all t between its ends. Pieces that may hide more than is
//! known to be hidden are divided into four. A ray is shot only where p lies on the light's own line.
//!
//! **Deviation:** [`crate::refs::POULIN_AMANATIDES_1990`], §5, shoots rays in two passes, which take forty times as long to
//! the same accuracy and may miss what is narrow. **Accuracy:** [`EDGE`] of the light's length at each end of a shadow.

use glam::DVec3;

use super::fan::{Fan, Range};
use super::solid::Solid;
use crate::surface::{Bounds, Placed};
use crate::visibility::interval::Segments;

/// Width to which the end of a shadow is narrowed, in lengths of the light.
const EDGE: f64 = 1e-6;

/// Nearer than this share of the distance to the light a piece is the point's own surface.
const OWN: f64 = 1e-7;

/// Pieces that are looked at before the rest is left as it is: some hundred are needed where a patch is crossed simply.
const MOST_PIECES: u32 = 20_000;

/// How often a patch is divided.
const MOST_DIVISIONS: u32 = 26;

/// Control points (s, y, z), in rows of four.
type Piece = [DVec3; 16];

/// The control points along the sides of a piece, in a ring.
const SIDES: [[usize; 4]; 4] = [[0, 1, 2, 3], [3, 7, 11, 15], [15, 14, 13, 12], [12, 8, 4, 0]];

/// Takes away what the patch hides; `local` is the fan in its own frame.
pub(super) fn hide(placed: &Placed, control_points: &[DVec3; 16], fan: &Fan, local: &Fan, seen: &mut Segments) {
    let bounds = Bounds::about(control_points);
    // Wider than the patch, which may be flat.
    let size = bounds.max - bounds.min;
    let wide = (1.001 * size).max(DVec3::splat(1e-3 * size.max_element()));
    let Some(possible) = Solid::of_box(wide).may_hide(&Fan { p: local.p - bounds.center(), ..*local }) else { return };
    let along = local.b - local.a;
    let across = local.a.cross(along);
    let square = across.length_squared();
    if square <= 1e-18 * local.a.length_squared() * along.length_squared().max(local.a.length_squared()) {
        return super::hide_range(behind_first_hit(placed, fan), seen);
    }
    let (to_s, to_y) = (along.cross(across) / square, across.cross(local.a) / square);
    let to_z = across / (square.sqrt() * size.length());
    let piece = control_points.map(|point| {
        let r = point - local.p;
        DVec3::new(to_s.dot(r), to_y.dot(r), to_z.dot(r))
    });
    let noise = 4.0 * f64::EPSILON * (1.0 + (local.p - bounds.center()).length() / size.length());
    let mut search = Search { noise, pieces: 0, seen: Segments::whole() };
    search.look(&piece, 0);
    let mut before = 0.0_f64;
    for &[from, to] in search.seen.parts() {
        seen.hide(before.max(possible.from), from.min(possible.to));
        before = to;
    }
    seen.hide(before.max(possible.from), 1.0_f64.min(possible.to));
}

/// What a patch hides of a light on whose line p lies.
fn behind_first_hit(placed: &Placed, fan: &Fan) -> Option<Range> {
    let farther = if fan.a.length_squared() > fan.b.length_squared() { fan.a } else { fan.b };
    let hit = placed.intersect(fan.p, farther)?;
    let reach = hit.t * farther.length_squared();
    Range::ALL.where_positive(fan.a.dot(farther) - reach, fan.b.dot(farther) - reach)
}

/// What is left of the light by the pieces so far.
struct Search {
    /// z within rounding of 0.
    noise: f64,
    pieces: u32,
    seen: Segments,
}

impl Search {
    /// Takes away what a piece hides.
    fn look(&mut self, piece: &Piece, divisions: u32) {
        self.pieces += 1;
        if self.pieces > MOST_PIECES {
            return;
        }
        let Bounds { min, max } = Bounds::about(piece);
        let x_max = piece.iter().fold(f64::NEG_INFINITY, |most, point| most.max(point.x - point.y));
        let is_beside = min.z >= -self.noise || max.z <= self.noise || max.y < 0.0 || x_max < 0.0;
        if is_beside || min.x >= 1.0 || max.x <= OWN {
            return;
        }
        let possible = if min.x > 0.0 { slice(piece) } else { Some(Range::ALL) };
        let Some(possible) = possible.filter(|possible| self.may_hide(*possible)) else { return };
        if min.x > 0.0 && max.x < 1.0 {
            if let Some([from, to]) = joined(piece) {
                self.seen.hide(from.min(to), from.max(to));
            }
            if !self.may_hide(possible) {
                return;
            }
        }
        if divisions < MOST_DIVISIONS {
            for quarter in quarters(piece) {
                self.look(&quarter, divisions + 1);
            }
        }
    }

    /// Whether more than [`EDGE`] of a range is still seen.
    fn may_hide(&self, Range { from, to }: Range) -> bool {
        self.seen.parts().iter().any(|&[start, end]| end.min(to) - start.max(from) > EDGE)
    }
}

/// The range of t = y/s in [0, 1] over the slice z = 0 of the convex hull of points with s > 0.
fn slice(piece: &Piece) -> Option<Range> {
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for above in piece.iter().filter(|point| point.z >= 0.0) {
        for below in piece.iter().filter(|point| point.z <= 0.0) {
            let (s, y) = (above.z * below.x - below.z * above.x, above.z * below.y - below.z * above.y);
            let t = y / s;
            least = least.min(t);
            most = most.max(t);
        }
    }
    let range = Range { from: least.max(0.0), to: most.min(1.0) };
    (range.from < range.to).then_some(range)
}

/// The t of the ends of the curve z = 0 that joins two sides of a piece, where the control points tell that it is the
/// only one: by Descartes' rule of signs it meets two sides once, and the others not.
fn joined(piece: &Piece) -> Option<[f64; 2]> {
    let mut ends = [0.0; 2];
    let mut found = 0;
    for side in SIDES.map(|side| side.map(|i| piece[i])) {
        let changes = side.windows(2).filter(|pair| (pair[0].z > 0.0) != (pair[1].z > 0.0)).count();
        if changes > 0 {
            if changes > 1 || found == 2 {
                return None;
            }
            ends[found] = end(&side);
            found += 1;
        }
    }
    (found == 2).then_some(ends)
}

/// t where the z of a cubic changes its sign, once.
fn end(side: &[DVec3; 4]) -> f64 {
    let rising = side[3].z > side[0].z;
    let (mut low, mut high) = (0.0, 1.0);
    let mut u = side[0].z / (side[0].z - side[3].z);
    for _ in 0..60 {
        let [before, after] = halves_at(side, u);
        let point = before[3];
        if (point.z > 0.0) == rising {
            high = u
        } else {
            low = u
        }
        // Newton's step, or half way where that leaves the bracket.
        let slope = 3.0 * (after[1].z - before[2].z);
        let next = u - point.z / slope;
        let next = if next > low && next < high { next } else { low.midpoint(high) };
        if (next - u).abs() <= 2.0 * f64::EPSILON {
            break;
        }
        u = next;
    }
    let point = halves_at(side, u)[0][3];
    point.y / point.x
}

/// A cubic divided at u, by de Casteljau.
fn halves_at([a, b, c, d]: &[DVec3; 4], u: f64) -> [[DVec3; 4]; 2] {
    let (ab, bc, cd) = (a.lerp(*b, u), b.lerp(*c, u), c.lerp(*d, u));
    let (abc, bcd) = (ab.lerp(bc, u), bc.lerp(cd, u));
    let middle = abc.lerp(bcd, u);
    [[*a, ab, abc, middle], [middle, bcd, cd, *d]]
}

/// A piece divided in both directions.
fn quarters(piece: &Piece) -> [Piece; 4] {
    let [low, high] = halves(piece);
    let [[a, b], [c, d]] = [halves(&transposed(&low)), halves(&transposed(&high))];
    [a, b, c, d]
}

/// Each row divided in the middle.
fn halves(piece: &Piece) -> [Piece; 2] {
    let mut both = [[DVec3::ZERO; 16]; 2];
    for row in 0..4 {
        let [a, b, c, d] = [0, 1, 2, 3].map(|i| piece[4 * row + i]);
        let (ab, bc, cd) = (a.midpoint(b), b.midpoint(c), c.midpoint(d));
        let (abc, bcd) = (ab.midpoint(bc), bc.midpoint(cd));
        let middle = abc.midpoint(bcd);
        both[0][4 * row..4 * row + 4].copy_from_slice(&[a, ab, abc, middle]);
        both[1][4 * row..4 * row + 4].copy_from_slice(&[middle, bcd, cd, d]);
    }
    both
}

fn transposed(piece: &Piece) -> Piece {
    std::array::from_fn(|i| piece[4 * (i % 4) + i / 4])
}
