//! POULIN's linear light buffer.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::cull::SLACK;
use super::hierarchy::index;
use crate::surface::{Bounds, Placed, Primitive};

/// An infinite cylinder about a linear light, cut in sections about its axis; each knows the objects in it that may lie
/// between the light and a point to the left of the light, beside it, and to its right.
///
/// All of a light triangle lies in the half-plane through the light and its point, so in one section, and along the
/// axis between the light's ends and the point.
///
/// **Source:** POULIN_AMANATIDES_1990, §6.1 and fig. 4. **Deviation:** the lists of a side and of the centre, which a
/// point on that side needs both, are joined beforehand.
#[derive(Clone, Debug)]
pub(super) struct LightBuffer {
    a: DVec3,
    /// Unit vector from the light's one end to the other, and its length.
    along: DVec3,
    length: f64,
    /// Unit vectors across.
    across: [DVec3; 2],
    sections: usize,
    /// Where in `objects` the list of each section and side begins, and the end of the last.
    starts: Vec<u32>,
    objects: Vec<u32>,
}

/// How far points of the light may lie beside it, of its coordinates: less than objects are widened by.
const ON_LINE: f64 = 0.1 * SLACK;

/// Left of the light, beside it, right of it.
const SIDES: usize = 3;

/// A ball about a part of an object, as seen along the light.
struct Blot {
    center: DVec2,
    /// Along the light.
    at: f64,
    radius: f64,
}

/// Which sections and sides an object is in.
struct Extent {
    /// From the one section, eastward to the other; as many as there are, at most.
    first: usize,
    count: usize,
    sides: [bool; SIDES],
}

impl LightBuffer {
    /// For the light from a to b, of objects in ascending order.
    pub(super) fn new(a: DVec3, b: DVec3, objects: &[Placed], sections: u32) -> Self {
        let along = (b - a).try_normalize().unwrap_or(DVec3::Z);
        let (u, v) = along.any_orthonormal_pair();
        let mut buffer = Self {
            a,
            along,
            length: (b - a).length(),
            across: [u, v],
            sections: sections.max(1) as usize,
            starts: Vec::new(),
            objects: Vec::new(),
        };
        let mut lists = vec![Vec::new(); buffer.sections * SIDES];
        for (i, object) in objects.iter().enumerate() {
            let Extent { first, count, sides } = buffer.extent(object);
            for section in (first..first + count).map(|section| section % buffer.sections) {
                for side in (0..SIDES).filter(|&side| sides[side]) {
                    lists[section * SIDES + side].push(index(i));
                }
            }
        }
        for list in lists {
            buffer.starts.push(index(buffer.objects.len()));
            buffer.objects.extend(list);
        }
        buffer.starts.push(index(buffer.objects.len()));
        buffer
    }

    /// Whether two points are points of the light.
    pub(super) fn is_along(&self, a: DVec3, b: DVec3) -> bool {
        [a, b].into_iter().all(|p| {
            let (across, at) = self.seen_along(p);
            let near = ON_LINE * (self.a.abs().max_element() + self.length);
            across.length_squared() <= near * near && (-near..=self.length + near).contains(&at)
        })
    }

    /// The objects that may touch the triangle of p and two points of the light, in ascending order.
    pub(super) fn objects(&self, p: DVec3) -> &[u32] {
        let (p, at) = self.seen_along(p);
        let side = if at < 0.0 {
            0
        } else if at <= self.length {
            1
        } else {
            2
        };
        let list = self.section(p.y.atan2(p.x)) * SIDES + side;
        &self.objects[self.starts[list] as usize..self.starts[list + 1] as usize]
    }

    /// A point across the light and along it.
    fn seen_along(&self, p: DVec3) -> (DVec2, f64) {
        let from_a = p - self.a;
        (DVec2::from(self.across.map(|axis| axis.dot(from_a))), self.along.dot(from_a))
    }

    /// The section of an angle from −π to π.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the number of sections")]
    fn section(&self, angle: f64) -> usize {
        let share = ((angle + PI) / TAU).clamp(0.0, 1.0);
        ((share * self.sections as f64) as usize).min(self.sections - 1)
    }

    fn extent(&self, object: &Placed) -> Extent {
        let everywhere = Extent { first: 0, count: self.sections, sides: [true; SIDES] };
        let Some(blots) = self.blots(object) else { return everywhere };
        let (low, high) = blots.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), blot| {
            (low.min(blot.at - blot.radius), high.max(blot.at + blot.radius))
        });
        let (before_end, after_start) = (low <= self.length, high >= 0.0);
        let sides = [before_end, before_end && after_start, after_start];
        match angles(&blots) {
            Some([low, high]) => {
                let first = self.section(wrapped(low));
                let last = self.section(wrapped(high));
                Extent { first, count: (last + self.sections - first) % self.sections + 1, sides }
            }
            None => Extent { sides, ..everywhere },
        }
    }

    /// Balls whose hull holds an object; none for what has no bounds.
    fn blots(&self, object: &Placed) -> Option<Vec<Blot>> {
        let bounds = object.bounds()?;
        let blot = |p: DVec3, radius: f64| {
            let (center, at) = self.seen_along(p);
            let slack = SLACK * (p.abs().max_element() + self.a.abs().max_element() + self.length + radius);
            Blot { center, at, radius: radius + slack }
        };
        let world_from_local = object.world_from_local();
        let in_world = |points: &[DVec3]| points.iter().map(|&p| world_from_local.transform_point3(p)).collect();
        let points: Vec<DVec3> = match object.primitive() {
            &Primitive::Sphere { radius } => {
                let m = world_from_local.matrix3;
                let widest = m.x_axis.length().max(m.y_axis.length()).max(m.z_axis.length());
                return Some(vec![blot(world_from_local.translation, radius * widest)]);
            }
            Primitive::Triangle(triangle) => in_world(&triangle.corners),
            Primitive::Patch(patch) => in_world(&patch.control_points),
            _ => corners(&bounds).to_vec(),
        };
        Some(points.into_iter().map(|p| blot(p, 0.0)).collect())
    }
}

/// The least and the greatest angle of blots about the axis, the greatest less than half a turn on; none where their
/// hull holds the axis.
///
/// Angles are taken from the middle of all, which the hull holds: where it does not hold the axis, none is farther from
/// the middle than half a turn, and all together span less.
fn angles(blots: &[Blot]) -> Option<[f64; 2]> {
    let middle = blots.iter().map(|blot| blot.center).sum::<DVec2>() / blots.len() as f64;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for Blot { center, radius, .. } in blots {
        let square = (center.length() - radius) * (center.length() + radius);
        if square.is_nan() || square <= 0.0 {
            return None;
        }
        let (angle, half) = (middle.perp_dot(*center).atan2(middle.dot(*center)), radius.atan2(square.sqrt()));
        low = low.min(angle - half);
        high = high.max(angle + half);
    }
    let from = middle.y.atan2(middle.x);
    (high - low + SLACK < PI).then_some([from + low - SLACK, from + high + SLACK])
}

/// The same angle between −π and π.
fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

/// The corners of a box.
fn corners(bounds: &Bounds) -> [DVec3; 8] {
    std::array::from_fn(|i| {
        let pick = |axis: usize| if i >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] };
        DVec3::new(pick(0), pick(1), pick(2))
    })
}
