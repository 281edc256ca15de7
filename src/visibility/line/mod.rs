//! What is seen of a linear light ([`crate::refs::POULIN_AMANATIDES_1990`], §5).
//!
//! From p the light is a fan of directions W(t) = A + t(B − A), 0 ≤ t ≤ 1, with A and B from p to its ends. An affine map
//! leaves t as it is, so everything happens in an occluder's own frame, and ellipsoids come free. What a flat occluder
//! hides is where a few linear functions of t are positive; what a solid one hides lies between tangents from p and
//! points where its faces cross the sides of the light's triangle. A bicubic patch is divided until its edges are known.

mod fan;
mod flat;
mod patch;
mod round;
mod solid;

use std::cell::RefCell;

use glam::DVec3;

use super::Objects;
use super::interval::Segments;
use crate::surface::{Placed, Primitive};
use fan::{Fan, Range};
use round::Round;
use solid::Solid;

thread_local! {
    /// The objects found last, so that no point pays for a new list.
    static FOUND: RefCell<Vec<usize>> = const { RefCell::new(Vec::new()) };
}

/// The parts, as shares of its length, that a point of normal `n` sees of the light from `a` to `b`; none where nothing
/// stands between the point and what lies above its horizon.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §5; the forms derived here. **Domain:** a surface is a shell
/// (see [`crate::visibility`]); a light's point within 1e-9 of its distance behind a surface is seen.
/// **Accuracy:** rounding, but for patches: 1e-6 of its length at each end of a shadow.
pub fn visible_segments(objects: &Objects, p: DVec3, n: DVec3, [a, b]: [DVec3; 2]) -> Option<Segments> {
    let whole = Fan { p, a: a - p, b: b - p };
    let Some(above) = Range::ALL.where_positive(n.dot(whole.a), n.dot(whole.b)) else {
        return Some(Segments::nothing());
    };
    let fan = whole.between(above);
    let mut seen = Segments::whole();
    FOUND.with_borrow_mut(|found| {
        objects.in_triangle(p, p + fan.a, p + fan.b, found);
        let short = fan.short_of_the_light();
        for part in found.iter().filter_map(|&object| objects.parts().get(object)) {
            hide(part, &short, &mut seen);
            if seen.is_empty() {
                break;
            }
        }
    });
    if seen.is_whole() { None } else { Some(seen.within(above.from, above.to)) }
}

/// Takes from `seen` what an object hides.
fn hide(object: &Placed, fan: &Fan, seen: &mut Segments) {
    if let Primitive::Triangle(triangle) = object.primitive() {
        return hide_range(flat::triangle(&triangle.corners, fan), seen);
    }
    let Some(local) = fan.seen_from(object.local_from_world()) else { return };
    match *object.primitive() {
        Primitive::Plane => hide_range(flat::plane(&local), seen),
        Primitive::Square { size } => hide_range(flat::rectangle(0.5 * size, &local), seen),
        Primitive::Disk { radius } => hide_range(flat::disk(radius, &local), seen),
        Primitive::Box { size } => Solid::of_box(size).hide(&local, seen),
        Primitive::Sphere { radius } => Solid::of_round(Round::sphere(radius), f64::INFINITY).hide(&local, seen),
        Primitive::Cylinder { radius, height } => Solid::of_round(Round::tube(radius), height).hide(&local, seen),
        Primitive::Cone { radius, height } => Solid::of_round(Round::nap(radius, height), height).hide(&local, seen),
        Primitive::Patch(ref patch) => patch::hide(object, &patch.control_points, fan, &local, seen),
        Primitive::Triangle(_) => {}
    }
}

fn hide_range(range: Option<Range>, seen: &mut Segments) {
    if let Some(Range { from, to }) = range {
        seen.hide(from, to);
    }
}

#[cfg(test)]
mod tests;
