//! What is seen of a convex polygonal light.
//!
//! [`PICOTT_1992`](crate::refs::PICOTT_1992), eq. 8b, after Nishita and Nakamae: the light is cut by the silhouettes of
//! the occluders as seen from p. A convex occluder hides a convex part of the light's plane, the common part of a few
//! half-spaces: see `shadow`. Their boundaries cut the light where it is, in space, so that nothing is projected and what
//! is level with p is no trouble. That is exact to rounding, 1e-16 of the coordinates, where the libraries that cut
//! polygons by sweeping work on a grid of integers.

mod clip;
mod round;
mod shadow;

use glam::DVec3;

use self::clip::{Clipper, Corner, vector_area};
use self::shadow::{Light, Shadows};
use super::Objects;

/// What is seen of a light.
#[derive(Clone, Debug, PartialEq)]
pub enum Seen {
    /// All of it.
    All,
    /// Nothing.
    Nothing,
    /// These pieces.
    Pieces(Vec<Vec<DVec3>>),
    /// All but these pieces, which do not overlap.
    AllBut(Vec<Vec<DVec3>>),
    /// What is not told here: a bicubic patch may hide some of it, or there are too many pieces or shadows.
    Unknown,
}

/// Up to this many shadows are freed of their overlaps, which leaves their own corners and few more to be shaded; more
/// are cut out of the light, which ends as soon as nothing is left of it.
const FEW: usize = 8;

/// With less of the light to be seen than this share, what is seen is cut out and not had as a difference.
const LEAST_SHARE: f64 = 1e-3;

/// Beyond this many pieces rays are as good, and cheaper.
const MOST_PIECES: usize = 256;

/// What is seen from p, above the horizon of n, of a planar convex polygon, in convex pieces.
///
/// **Accuracy:** to rounding for planes, boxes, squares and triangles; a round outline is a polygon (see `round`).
/// **Domain:** the polygon must be convex: of another, ask for each of its
/// [`convex_parts`](crate::math::triangulate::convex_parts), since only the half-spaces that bound what an occluder hides
/// are kept, and one that bounds nothing may still part another arm of the light from it. p in the light's plane sees all
/// of it. Pieces thinner than rounding are left out; an occluder that does not touch the light as seen from p changes
/// nothing.
pub fn visible_pieces(objects: &Objects, p: DVec3, n: DVec3, polygon: &[DVec3]) -> Seen {
    let mut clipper = Clipper::new(p, polygon);
    let Some(light) = Light::above_horizon(p, n, polygon, &mut clipper) else { return Seen::All };
    let mut found = Vec::new();
    objects.in_pyramid(p, polygon, &mut found);
    let mut shadows = Shadows::default();
    for part in found.into_iter().filter_map(|i| objects.parts().get(i)) {
        if light.may_be_hidden_by(part) && !shadows.add(part, &light, &mut clipper) {
            return Seen::Unknown;
        }
    }
    if shadows.is_empty() {
        return Seen::All;
    }
    shadows.sort();
    if shadows.len() <= FEW {
        let hidden = hidden_pieces(&shadows, &mut clipper);
        let area: f64 = hidden.iter().map(|piece| vector_area(piece).length()).sum();
        if light.area - area >= LEAST_SHARE * light.area {
            return Seen::AllBut(plain(hidden));
        }
    }
    match seen_pieces(&light, &shadows, &mut clipper) {
        None => Seen::Unknown,
        Some(pieces) if pieces.is_empty() => Seen::Nothing,
        Some(pieces) => Seen::Pieces(plain(pieces)),
    }
}

/// The shadows without their overlaps: each without those before it.
fn hidden_pieces(shadows: &Shadows, clipper: &mut Clipper) -> Vec<Vec<Corner>> {
    let mut hidden = Vec::new();
    for (i, shadow) in shadows.iter().enumerate() {
        let mut pieces = vec![shadow.outline.clone()];
        for before in shadows.iter().take(i) {
            pieces = without(pieces, shadows.region(before), clipper);
        }
        hidden.append(&mut pieces);
    }
    hidden
}

/// What the shadows leave of the light; none when there are too many pieces.
fn seen_pieces(light: &Light, shadows: &Shadows, clipper: &mut Clipper) -> Option<Vec<Vec<Corner>>> {
    let mut pieces = vec![light.corners.clone()];
    for shadow in shadows.iter() {
        pieces = without(pieces, shadows.region(shadow), clipper);
        if pieces.is_empty() {
            break;
        }
        if pieces.len() > MOST_PIECES {
            return None;
        }
    }
    Some(pieces)
}

/// What of pieces lies outside a region.
fn without(pieces: Vec<Vec<Corner>>, region: &[clip::HalfSpace], clipper: &mut Clipper) -> Vec<Vec<Corner>> {
    let mut rest = Vec::with_capacity(pieces.len());
    for piece in pieces {
        clipper.subtract(piece, region, &mut rest);
    }
    rest
}

fn plain(pieces: Vec<Vec<Corner>>) -> Vec<Vec<DVec3>> {
    pieces.into_iter().map(|piece| piece.into_iter().map(|corner| corner.at).collect()).collect()
}
