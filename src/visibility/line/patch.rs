//! What a bicubic patch hides of a linear light, by rays in two passes ([`crate::refs::POULIN_AMANATIDES_1990`], §5).
//!
//! The box about the control points holds the patch, and bounds what it can hide. A first, regular pass over that, of
//! more rays the wider it is seen, finds where the patch begins and ceases to hide; each such edge is then halved in.
//! No ray is random, so that edges are not noisy.
//!
//! **Accuracy:** [`EDGE`] of the light's length, of edges between which no part seen or hidden is narrower than the step
//! of the first pass; narrower ones may be missed.

use glam::DVec3;

use super::fan::{Fan, Range};
use super::solid::Solid;
use crate::surface::{Bounds, Placed};
use crate::visibility::interval::Segments;

/// Width to which an edge is narrowed, in lengths of the light.
const EDGE: f64 = 1e-6;

/// Rays of the first pass: so many at least, and so many more a radian.
const LEAST: f64 = 16.0;
const A_RADIAN: f64 = 32.0;

/// Takes away what the patch hides; `local` is the fan in its own frame.
pub(super) fn hide(placed: &Placed, control_points: &[DVec3; 16], fan: &Fan, local: &Fan, seen: &mut Segments) {
    let Some(Range { from, to }) = range(control_points, local) else { return };
    let hides = |t: f64| placed.intersect(fan.p, fan.at(t)).is_some_and(|hit| hit.t < 1.0);
    let (a, b) = (fan.at(from), fan.at(to));
    let angle = a.cross(b).length().atan2(a.dot(b));
    let steps = (LEAST + A_RADIAN * angle).ceil();
    let mut hidden_from = hides(from).then_some(from);
    let (mut i, mut before) = (0.0, from);
    while i < steps {
        i += 1.0;
        let after = from + (to - from) * (i / steps);
        match (hidden_from, hides(after)) {
            (Some(start), false) => {
                seen.hide(start, edge(&hides, before, after));
                hidden_from = None;
            }
            (None, true) => hidden_from = Some(edge(&hides, after, before)),
            _ => {}
        }
        before = after;
    }
    if let Some(start) = hidden_from {
        seen.hide(start, to);
    }
}

/// What the patch can hide.
fn range(control_points: &[DVec3; 16], local: &Fan) -> Option<Range> {
    let bounds = Bounds::about(control_points);
    // Wider than the patch, which may be flat.
    let size = 1.001 * (bounds.max - bounds.min);
    let size = size.max(DVec3::splat(1e-3 * size.max_element()));
    Solid::of_box(size).may_hide(&Fan { p: local.p - bounds.center(), ..*local })
}

/// The edge between t where the patch hides and t where it does not.
fn edge(hides: &impl Fn(f64) -> bool, mut hidden: f64, mut seen: f64) -> f64 {
    while (hidden - seen).abs() > EDGE {
        let middle = hidden.midpoint(seen);
        if hides(middle) { hidden = middle } else { seen = middle }
    }
    hidden.midpoint(seen)
}
