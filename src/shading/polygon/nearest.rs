//! The specular of a polygon from its point of least angle to the mirror direction.

use glam::DVec3;

use super::edges;
use crate::light::PolygonEmitter;
use crate::math::spherical::{Edge, HorizonClip, azimuth_between};

/// cos α of the polygon's point above the surface that makes the least angle α with r; `None` where α ≥ 90°.
///
/// 1 where r meets the polygon, else the best of each edge's end points and its stationary point where that is a
/// maximum.
///
/// **Source:** [`PICOTT_1992`](crate::refs::PICOTT_1992), §3.2, extended to any simple polygon. **Deviation:** the true
/// least angle, by his eq. 7 with a guard on each edge, where he projects r onto the light's plane: that is 7.6° off
/// on average with one coordinate out of range.
/// **Domain:** unit n and r with n·r ≥ 0, as for any eye above the surface.
pub fn polygon_least_angle_cosine(light: &PolygonEmitter, p: DVec3, n: DVec3, r: DVec3) -> Option<f64> {
    if is_met(light, p, r) && n.dot(r) > 0.0 {
        return Some(1.0);
    }
    let mut clip = HorizonClip::new(n);
    edges(&light.vertices, p)
        .filter_map(|edge| clip.clip(edge)[0])
        .map(|edge| greatest_cosine(edge, r))
        .max_by(f64::total_cmp)
        .filter(|cosine| *cosine > 0.0)
}

/// cos α of the point that [`PICOTT_1992`](crate::refs::PICOTT_1992) takes for the one of least angle α to r; `None` where
/// he takes none, or one below the surface.
///
/// 1 where r meets the polygon. Where it meets the plane outside, on each edge that has the meeting point on its outer
/// side: the edge's crossing with the projection of r onto the plane, or the end next to it; the best of these.
///
/// **Source:** §3.2 and appendix C, for parallelograms, where the edges with the meeting point outside are the axes whose
/// coordinate is out of range. **Deviation:** any polygon; each edge's sides from determinants about p, where his matrix
/// is singular when the light's plane meets the origin; no meeting point behind p.
/// **Method error:** over parallelograms with sides of up to 2 at a distance of 3, α is too great by 4.4° on average and 75°
/// at worst with one coordinate out of range, by 1.6° and 49° with both; where r points away from the plane, half of all
/// cases, nothing is found, though in 49 % of them some point has cos α > 0 (`closed_form::polygon`).
/// **Domain:** unit n and r.
/// **Twin:** `shaders/polygon.wgsl`.
pub fn polygon_projected_edge_cosine(light: &PolygonEmitter, p: DVec3, n: DVec3, r: DVec3) -> Option<f64> {
    let height = light.normal.dot(light.vertices.first()? - p);
    if height * light.normal.dot(r) <= 0.0 {
        return None;
    }
    if is_met(light, p, r) {
        return (n.dot(r) > 0.0).then_some(1.0);
    }
    // Perpendicular to the plane through p that holds r and its projection.
    let across = light.normal.cross(r);
    edges(&light.vertices, p)
        .filter(|(a, b)| height * r.dot(a.cross(b - a)) < 0.0)
        .map(|(a, b)| {
            let (from, to) = (across.dot(a), across.dot(b));
            let share = if from == to { 0.0 } else { (from / (from - to)).clamp(0.0, 1.0) };
            a + share * (b - a)
        })
        .filter(|x| n.dot(*x) >= 0.0)
        .map(|x| r.dot(x) / x.length().max(f64::MIN_POSITIVE))
        .max_by(f64::total_cmp)
        .filter(|cosine| *cosine > 0.0)
}

/// Whether the ray from p along r meets the polygon.
fn is_met(light: &PolygonEmitter, p: DVec3, r: DVec3) -> bool {
    let Some(corner) = light.vertices.first() else { return false };
    let in_front = light.normal.dot(corner - p) * light.normal.dot(r) > 0.0;
    let turn: f64 = edges(&light.vertices, p).map(|(a, b)| azimuth_between(r, a, b)).sum();
    in_front && turn.abs() > std::f64::consts::PI
}

/// The greatest cosine between r and the points of an edge.
fn greatest_cosine((a, b): Edge, r: DVec3) -> f64 {
    let cosine = |x: DVec3| r.dot(x) / x.length().max(f64::MIN_POSITIVE);
    let along = b - a;
    // Symbols as in the derivative of (r·a + t r·d)/|a + t d|, whose sign is that of `rise` − t·`bend`.
    let rise = r.dot(along) * a.length_squared() - r.dot(a) * a.dot(along);
    let bend = r.dot(a) * along.length_squared() - r.dot(along) * a.dot(along);
    let ends = cosine(a).max(cosine(b));
    if bend > 0.0 && 0.0 < rise && rise < bend { ends.max(cosine(a + rise / bend * along)).min(1.0) } else { ends }
}
