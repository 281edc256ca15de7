//! The objects of a scene, and which of them to test.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

use super::Hierarchy;
use super::cull::{Axis, Hull, Ray};
use crate::surface::{Hit, Placed, Surface};

/// How the objects that may lie on a ray or in a light's shadow are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Structure {
    /// All of them are tested.
    Every,
    /// A hierarchy of bounding volumes.
    #[default]
    Hierarchy,
}

/// A name that no structure has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no structure; write every or hierarchy")]
pub struct UnknownStructure(String);

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Every => "every",
            Self::Hierarchy => "hierarchy",
        })
    }
}

impl FromStr for Structure {
    type Err = UnknownStructure;

    fn from_str(name: &str) -> Result<Self, UnknownStructure> {
        match name {
            "every" => Ok(Self::Every),
            "hierarchy" => Ok(Self::Hierarchy),
            _ => Err(UnknownStructure(name.to_owned())),
        }
    }
}

/// Everything that rays meet and that casts shadows: the parts of all surfaces.
#[derive(Clone, Debug)]
pub struct Objects {
    parts: Vec<Placed>,
    /// The surface that each is a part of.
    surfaces: Vec<usize>,
    finder: Finder,
}

/// What finds them.
#[derive(Clone, Debug)]
enum Finder {
    Every,
    Hierarchy(Hierarchy),
}

/// A hit nearer to a segment's end than this share of its length is the end's own surface.
pub(super) const AT_END: f64 = 1e-9;

impl Objects {
    /// The parts of these surfaces.
    pub fn new(surfaces: &[Surface], structure: Structure) -> Self {
        let parts = surfaces
            .iter()
            .enumerate()
            .flat_map(|(i, surface)| Placed::parts(surface).into_iter().map(move |part| (part, i)));
        let (parts, surfaces): (Vec<Placed>, _) = parts.unzip();
        let finder = match structure {
            Structure::Every => Finder::Every,
            Structure::Hierarchy => Finder::Hierarchy(Hierarchy::new(&parts)),
        };
        Self { parts, surfaces, finder }
    }

    /// The objects.
    pub fn parts(&self) -> &[Placed] {
        &self.parts
    }

    /// The index of the surface that an object is a part of.
    pub fn surface_of(&self, object: usize) -> usize {
        self.surfaces.get(object).copied().unwrap_or_default()
    }

    /// The nearest hit in front of `origin`, and its object; of those equally near, the first.
    pub fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<(usize, Hit)> {
        let mut nearest: Option<(usize, Hit)> = None;
        self.along(origin, direction, f64::INFINITY, |object, limit| {
            let Some(hit) = self.parts[object].intersect(origin, direction) else { return limit };
            if nearest.is_none_or(|(first, best)| hit.t < best.t || (hit.t == best.t && object < first)) {
                nearest = Some((object, hit));
            }
            limit.min(hit.t)
        });
        nearest
    }

    /// Whether something stands between `p` and `p + to_light`.
    pub fn hides(&self, p: DVec3, to_light: DVec3) -> bool {
        self.hides_within(p, to_light, 1.0 - AT_END)
    }

    /// Whether something stands in a direction, however far.
    pub fn hides_direction(&self, p: DVec3, direction: DVec3) -> bool {
        self.hides_within(p, direction, f64::INFINITY)
    }

    fn hides_within(&self, p: DVec3, direction: DVec3, end: f64) -> bool {
        let mut hidden = false;
        self.along(p, direction, end, |object, limit| {
            hidden = hidden || self.parts[object].intersect(p, direction).is_some_and(|hit| hit.t < end);
            if hidden { f64::NEG_INFINITY } else { limit }
        });
        hidden
    }

    /// The objects that a ray may meet no farther than a limit, which `visit` takes and gives.
    fn along(&self, origin: DVec3, direction: DVec3, limit: f64, mut visit: impl FnMut(usize, f64) -> f64) {
        match &self.finder {
            Finder::Every => {
                (0..self.parts.len()).fold(limit, |limit, object| visit(object, limit));
            }
            Finder::Hierarchy(hierarchy) => hierarchy.along(&Ray::new(origin, direction), limit, visit),
        }
    }

    /// The objects that may touch the triangle (p, a, b), in ascending order.
    pub fn in_triangle(&self, p: DVec3, a: DVec3, b: DVec3, found: &mut Vec<usize>) {
        self.in_hull(|| Hull::triangle([p, a, b]), found);
    }

    /// The objects that may touch the pyramid from p to a convex or non-convex polygon, in ascending order.
    pub fn in_pyramid(&self, p: DVec3, polygon: &[DVec3], found: &mut Vec<usize>) {
        self.in_hull(|| Hull::pyramid(p, polygon), found);
    }

    fn in_hull<A: AsRef<[Axis]>>(&self, hull: impl FnOnce() -> Hull<A>, found: &mut Vec<usize>) {
        found.clear();
        match &self.finder {
            Finder::Every => found.extend(0..self.parts.len()),
            Finder::Hierarchy(hierarchy) => {
                let hull = hull();
                hierarchy.visit(|bounds| hull.touches(bounds), |object| found.push(object));
                found.sort_unstable();
            }
        }
    }
}
