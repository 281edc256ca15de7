//! Round outlines as polygons.
//!
//! A circle of radius r becomes a polygon of the same area: its sides are at c·r from the centre, c² = x/tan x for sides
//! of the angle 2x, up to r·x²/6 inside the circle with corners up to r·x²/3 outside. Along each side that cancels, so
//! that only where the light's outline ends a side some of it is left, of the third order in x.
//!
//! **Accuracy:** 1e-4 of random points of lights, seen past one to four random solids, lie between the two outlines
//! (`closed_form::polygon_shadows`). The share of E that is seen past one of them is within 7e-5 of that by 32 times as
//! many sides, over 200 points each of `benches/shadows.rs` with a rectangle and with a narrow light.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::clip::HalfSpace;
use super::shadow::{Face, Regions, View};
use crate::surface::ON_SURFACE;

/// Sides of the outline of something that appears as large as the light is wide.
const SIDES: f64 = 48.0;

/// Sides of the outline of the largest.
const MOST_SIDES: f64 = 256.0;

/// How many sides an outline is given that appears `magnification` ≥ 1 times as large as the light is wide: its corners are
/// within 0.0015 of that width, up to 28 times it.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 48 to 256")]
pub(super) fn sides(magnification: f64) -> usize {
    (SIDES * magnification.sqrt()).clamp(SIDES, MOST_SIDES) as usize
}

/// Distance of the sides, each of the angle 2x, of the polygon that has the area of the unit circle.
fn apothem(x: f64) -> f64 {
    (x / x.tan()).sqrt()
}

/// Directions in the plane of two axes, `count` about the full turn.
fn turn(count: usize, x: DVec3, y: DVec3) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |k| {
        let (sine, cosine) = (TAU * k as f64 / count as f64).sin_cos();
        cosine * x + sine * y
    })
}

/// The sides of a disk: outward normals and distances.
pub(super) fn disk(radius: f64, count: usize) -> Vec<(DVec3, f64)> {
    let distance = radius * apothem(PI / count as f64);
    turn(count, DVec3::X, DVec3::Y).map(|normal| (normal, distance)).collect()
}

/// What a sphere hides.
///
/// From outside: what is in the cone of its tangents beyond the circle where they touch it; and, of a light that passes
/// through the sphere, what is inside it on the near side of that circle. The cone's polygon is that of the circle.
pub(super) fn sphere(radius: f64, view: &View, regions: &mut Regions) {
    let distance = view.p.length();
    let out = view.p.try_normalize().unwrap_or(DVec3::Z);
    let excess = (distance - radius) * (distance + radius);
    let on_surface = excess.abs() <= ON_SURFACE * radius * radius;
    let count = view.sides(radius);
    if on_surface || excess < 0.0 {
        let below = on_surface.then_some(HalfSpace::through_p(out));
        match section(radius, view, count) {
            Some(section) => section.iter().for_each(|side| regions.push(below.into_iter().chain([side.complement()]))),
            None => regions.push(below),
        }
        return;
    }
    let tangent = excess.sqrt();
    let rim = radius * apothem(PI / count as f64);
    let (x, y) = out.any_orthonormal_pair();
    let cone = turn(count, x, y).map(|u| HalfSpace::through_p(tangent * u + rim * out));
    let beyond = HalfSpace::new(out, excess / distance);
    regions.push(cone.chain([beyond]));
    if let Some(section) = section(radius, view, count) {
        regions.push(section.into_iter().chain([beyond.complement()]));
    }
}

/// The light's plane inside a sphere; none where it passes by.
fn section(radius: f64, view: &View, count: usize) -> Option<Vec<HalfSpace>> {
    let (normal, height) = view.plane();
    let excess = (radius - height) * (radius + height);
    if excess <= 0.0 {
        return None;
    }
    let reach = excess.sqrt();
    let (x, y) = normal.any_orthonormal_pair();
    let distance = reach * apothem(PI / count as f64);
    let from_center = view.p - height * normal;
    Some(turn(count, x, y).map(|u| HalfSpace::new(u, u.dot(from_center) - distance)).collect())
}

/// A prism about a closed cylinder.
pub(super) fn cylinder(radius: f64, height: f64, p: DVec3, count: usize) -> (Vec<Face>, Vec<(usize, usize)>) {
    let half = 0.5 * height;
    let size = radius.max(half);
    let mut faces = about_axis(radius, p, count, |u, c| Face::new(u, c * radius, p, size));
    let sides = faces.len();
    faces.extend([DVec3::Z, DVec3::NEG_Z].map(|normal| Face::new(normal, half, p, size)));
    let edges = ring(sides).chain((0..sides).flat_map(|i| [(i, sides), (i, sides + 1)])).collect();
    (faces, edges)
}

/// A pyramid about a closed cone.
pub(super) fn cone(radius: f64, height: f64, p: DVec3, count: usize) -> (Vec<Face>, Vec<(usize, usize)>) {
    let half = 0.5 * height;
    let (size, slope) = (radius.max(half), radius / height);
    let mut faces = about_axis(slope * (half - p.z), p, count, |u, c| {
        Face::new(u + DVec3::Z * (c * slope), c * slope * half, p, size)
    });
    let sides = faces.len();
    faces.push(Face::new(DVec3::NEG_Z, half, p, size));
    let edges = ring(sides).chain((0..sides).map(|i| (i, sides))).collect();
    (faces, edges)
}

/// The pairs of neighbours in a ring.
fn ring(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).map(move |i| (i, (i + 1) % count))
}

/// The sides of a solid of revolution about Z, whose radius at the level of p is `radius`, below 0 above a cone's apex.
///
/// `face` makes the side of a direction and of a distance as a share of the radius. Where tangents from p touch, both
/// are sides themselves, exactly, and the front and the back between them are divided evenly; from inside, the side next
/// to p is one, so that p stays inside.
fn about_axis(radius: f64, p: DVec3, count: usize, face: impl Fn(DVec3, f64) -> Face) -> Vec<Face> {
    let across = p.truncate();
    let x = across.try_normalize().unwrap_or(glam::DVec2::X).extend(0.0);
    let y = DVec3::Z.cross(x);
    let side = |angle: f64, c: f64| face(angle.cos() * x + angle.sin() * y, c);
    let distance = across.length();
    let excess = (distance - radius.abs()) * (distance + radius.abs());
    if excess <= 0.0 {
        let step = TAU / count as f64;
        let c = apothem(0.5 * step);
        // All sides face p above a cone, none does inside.
        let next = if radius > 0.0 { 1.0 } else { c };
        return (0..count).map(|k| side(k as f64 * step, if k == 0 { next } else { c })).collect();
    }
    let half_front = excess.sqrt().atan2(radius);
    let mut faces = Vec::with_capacity(count + 4);
    for (from, angle) in [(-half_front, 2.0 * half_front), (half_front, TAU - 2.0 * half_front)] {
        let segments = divisions(angle, count);
        let step = angle / segments;
        let c = apothem(0.5 * step);
        faces.push(Face { at_p: 0.0, ..side(from, 1.0) });
        let mut k = 1.0;
        while k < segments {
            faces.push(side(from + k * step, c));
            k += 1.0;
        }
    }
    faces
}

/// Into how many steps an angle is divided, at least one a quarter turn and two in all.
fn divisions(angle: f64, count: usize) -> f64 {
    (count as f64 * angle / TAU).ceil().max((angle / FRAC_PI_2).ceil()).max(2.0)
}
