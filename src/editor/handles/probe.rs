//! The probe of a plot under the mouse: itself and the tip of its normal.

use glam::{DQuat, DVec3};

use super::aim::stepped;
use super::drag::Change;
use super::pull::Pull;
use super::subject::{Subject, tidied};
use super::{Handle, Outline, Spot};
use crate::editor::viewport::overlay::PROBE_NORMAL;
use crate::editor::viewport::pick::Solids;
use crate::editor::viewport::projection::Projection;
use crate::scene::Plot;

/// The tip of a normal that points at the eye is too near to the probe to be held by itself, points.
const LEAST_LENGTH: f32 = 14.0;

/// The handles on a probe: the tip of its normal, then itself.
pub(super) fn spots(plot: &Plot, projection: &Projection) -> Vec<Spot> {
    let tip = plot.position + reach(plot, projection) * plot.normal.normalize_or(DVec3::Z);
    let [at, tip] = [plot.position, tip].map(|p| projection.project(p));
    let apart = at.zip(tip).filter(|(at, tip)| at.distance(*tip) >= LEAST_LENGTH);
    let normal = apart.map(|(at, tip)| Spot { handle: Handle::Normal, outline: Outline::Pin([at, tip]) });
    let probe = at.map(|at| Spot { handle: Handle::Probe, outline: Outline::Dot(at) });
    normal.into_iter().chain(probe).collect()
}

/// Length of the normal's arrow, metres.
fn reach(plot: &Plot, projection: &Projection) -> f64 {
    PROBE_NORMAL * projection.metres_per_point(plot.position)
}

/// A probe moved to the surface under the pointer, with that surface's normal unless `keep_normal`; where there is none,
/// in the plane that faces the eye.
pub(super) fn moved(pull: &Pull<'_>, start: &Subject, solids: &Solids, keep_normal: bool) -> Option<Change> {
    let Subject::Probe(plot) = start else { return None };
    let mut plot = plot.clone();
    let ray = &pull.rays[1];
    if let Some((_, hit)) = solids.nearest(ray) {
        plot.position = tidied(hit.p);
        if !keep_normal {
            plot.normal = tidied(if hit.n.dot(ray.direction) > 0.0 { -hit.n } else { hit.n });
        }
    } else {
        plot.position = tidied(plot.position + pull.shift(plot.position, pull.projection.forward())?);
    }
    Some(Change::To(Subject::Probe(plot)))
}

/// A probe whose normal follows the pointer over a sphere about it.
pub(super) fn turned(pull: &Pull<'_>, start: &Subject) -> Option<Change> {
    let Subject::Probe(plot) = start else { return None };
    let mut plot = plot.clone();
    let axis = plot.normal.normalize_or(DVec3::Z);
    let [from, to] = pull.directions(plot.position, reach(&plot, pull.projection), axis);
    plot.normal = tidied(stepped(DQuat::from_rotation_arc(from, to) * axis, pull.snap.is_some()));
    Some(Change::To(Subject::Probe(plot)))
}
