//! Which objects may stand between a point and a light, and whether they hide it.

use glam::DVec3;

use super::source::{Hull, Seen};
use crate::surface::{Bounds, ON_SURFACE, Placed, Primitive};
use crate::visibility::{AT_END, Objects};

/// What may stand between a point and a light.
pub(super) enum Between {
    Nothing,
    /// Something that hides all of the light.
    Screen,
    /// These objects, and no others.
    These(Vec<usize>),
    Anything,
}

/// More objects are not tried one by one.
const FEW: usize = 24;

impl Between {
    /// What may stand between the point p, of unit normal n, and the part of a light above its horizon.
    ///
    /// Exact for convex objects wholly below one of the horizons, outside the [`Hull`] or beyond it; others are found in
    /// vain. `extent` is about all objects but planes.
    pub(super) fn new(objects: &Objects, extent: &Bounds, seen: &Seen, p: DVec3, n: DVec3) -> Self {
        let hull = seen.hull();
        let mut found = Vec::new();
        match &hull {
            Some(hull) => objects.in_pyramid(p, &hull.polygon(p, extent), &mut found),
            None if objects.parts().len() <= FEW => found.extend(0..objects.parts().len()),
            None => return Self::Anything,
        }
        let slopes = seen.horizons(n).chain(hull.iter().flat_map(Hull::slopes)).collect::<Vec<_>>();
        if found.len() > FEW {
            return Self::Anything;
        }
        found.retain(|&object| {
            let part = &objects.parts()[object];
            rises_above(part, p, &slopes)
                && hull.as_ref().is_none_or(|hull| hull.is_not_before(part, p))
                && reaches(part, seen, p)
        });
        let screens = |&object: &usize| hull.as_ref().is_some_and(|hull| hull.is_behind(&objects.parts()[object], p));
        if found.is_empty() {
            Self::Nothing
        } else if found.iter().any(screens) {
            Self::Screen
        } else {
            Self::These(found)
        }
    }

    /// Whether something hides what is at a distance in a unit direction.
    pub(super) fn hides(&self, objects: &Objects, p: DVec3, w: DVec3, distance: f64) -> bool {
        match self {
            Self::Nothing => false,
            Self::Screen => true,
            Self::Anything if distance == f64::INFINITY => objects.hides_direction(p, w),
            Self::Anything => objects.hides(p, distance * w),
            Self::These(few) => {
                let end = distance * (1.0 - AT_END);
                few.iter().any(|&object| objects.parts()[object].intersect(p, w).is_some_and(|hit| hit.t < end))
            }
        }
    }
}

/// Whether a part has points above all planes through p of these normals, by more than [`ON_SURFACE`] of its size.
fn rises_above(part: &Placed, p: DVec3, normals: &[DVec3]) -> bool {
    normals.iter().all(|&normal| {
        let (above, below) = (part.reach(p, normal), part.reach(p, -normal));
        above == f64::INFINITY || above > ON_SURFACE * (above.abs() + below.abs())
    })
}

/// Whether a plane may separate the light from p; all other primitives may.
fn reaches(part: &Placed, seen: &Seen, p: DVec3) -> bool {
    if *part.primitive() != Primitive::Plane {
        return true;
    }
    let local = part.local_from_world().transform_point3(p);
    let normal = part.local_from_world().matrix3.transpose() * DVec3::Z;
    let length = normal.length();
    local.z.abs() > ON_SURFACE * local.length()
        && seen.least_height(local.z.signum() * normal / length) * length < -local.z.abs()
}

impl Hull {
    /// The polygon in the world, so far from p that no part of the light, or of an object before it, is beyond.
    fn polygon(&self, p: DVec3, extent: &Bounds) -> Vec<DVec3> {
        let farthest = (p - extent.min).abs().max((p - extent.max).abs()).length();
        let depth = if self.depth.is_finite() {
            self.depth
        } else if farthest.is_finite() {
            2.0 * farthest.max(1.0) / self.corners.iter().map(|corner| corner.length()).fold(1.0, f64::min)
        } else {
            1.0
        };
        self.corners.iter().map(|corner| p + depth * corner).collect()
    }

    /// The inward normals of the pyramid's sides, where it is convex.
    fn slopes(&self) -> Vec<DVec3> {
        let next = self.corners.iter().cycle().skip(1);
        let slopes: Vec<_> = self.corners.iter().zip(next).map(|(a, b)| a.cross(*b)).collect();
        let middle: DVec3 = self.corners.iter().sum();
        let slopes: Vec<_> = slopes.iter().map(|slope| if slope.dot(middle) < 0.0 { -slope } else { *slope }).collect();
        let encloses = |slope: &DVec3| {
            let least = -ON_SURFACE * slope.length() * middle.length();
            self.corners.iter().all(|corner| slope.dot(*corner) >= least)
        };
        if slopes.iter().all(encloses) { slopes } else { Vec::new() }
    }

    /// Unit normal of the polygon, away from p.
    fn normal(&self) -> DVec3 {
        let next = self.corners.iter().cycle().skip(1);
        let normal: DVec3 = self.corners.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
        let normal = normal.normalize_or_zero();
        if self.corners.first().is_some_and(|corner| normal.dot(*corner) < 0.0) { -normal } else { normal }
    }

    /// Whether a part has points nearer than the light's end.
    fn is_not_before(&self, part: &Placed, p: DVec3) -> bool {
        let normal = self.normal();
        let end = self.depth * self.corners.first().map_or(0.0, |corner| normal.dot(*corner));
        -part.reach(p, -normal) < end || !end.is_finite()
    }

    /// Whether the polygon is wholly in the shadow of a convex part that p is outside of. What is hidden by such a part
    /// is convex, and with each point all beyond it.
    fn is_behind(&self, part: &Placed, p: DVec3) -> bool {
        let is_flat = match part.primitive() {
            Primitive::Plane | Primitive::Square { .. } | Primitive::Disk { .. } | Primitive::Triangle(_) => true,
            Primitive::Sphere { .. } | Primitive::Box { .. } | Primitive::Cylinder { .. } | Primitive::Cone { .. } => {
                false
            }
            Primitive::Patch(_) => return false,
        };
        let end = if self.depth.is_finite() { 1.0 - AT_END } else { f64::INFINITY };
        self.corners.iter().all(|&corner| {
            part.intersect(p, corner).is_some_and(|hit| hit.t < end && (is_flat || hit.n.dot(corner) < 0.0))
        })
    }
}
