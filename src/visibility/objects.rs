//! The objects of a scene, and which of them to test.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

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
}

/// A hit nearer to a segment's end than this share of its length is the end's own surface.
const AT_END: f64 = 1e-9;

impl Objects {
    /// The parts of these surfaces.
    pub fn new(surfaces: &[Surface], _structure: Structure) -> Self {
        let parts = surfaces
            .iter()
            .enumerate()
            .flat_map(|(i, surface)| Placed::parts(surface).into_iter().map(move |part| (part, i)));
        let (parts, surfaces) = parts.unzip();
        Self { parts, surfaces }
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
        let hits = self.parts.iter().enumerate().filter_map(|(i, part)| Some((i, part.intersect(origin, direction)?)));
        hits.min_by(|(_, a), (_, b)| a.t.total_cmp(&b.t))
    }

    /// Whether something stands between `p` and `p + to_light`.
    pub fn hides(&self, p: DVec3, to_light: DVec3) -> bool {
        self.parts.iter().any(|part| part.intersect(p, to_light).is_some_and(|hit| hit.t < 1.0 - AT_END))
    }

    /// Whether something stands in a direction, however far.
    pub fn hides_direction(&self, p: DVec3, direction: DVec3) -> bool {
        self.parts.iter().any(|part| part.intersect(p, direction).is_some())
    }

    /// The objects that may touch the triangle (p, a, b), in ascending order.
    pub fn in_triangle(&self, _p: DVec3, _a: DVec3, _b: DVec3, found: &mut Vec<usize>) {
        found.clear();
        found.extend(0..self.parts.len());
    }

    /// The objects that may touch the pyramid from p to a convex or non-convex polygon, in ascending order.
    pub fn in_pyramid(&self, _p: DVec3, _polygon: &[DVec3], found: &mut Vec<usize>) {
        found.clear();
        found.extend(0..self.parts.len());
    }
}
