//! The objects of a scene, and which of them to test.
//!
//! What is found never changes an answer, only how soon it is there.

use std::sync::Arc;

use glam::DVec3;

use super::cull::{Axis, Hull, Ray};
use super::grid::Grid;
use super::light_buffer::LightBuffer;
use super::{Hierarchy, Structure, Structures};
use crate::surface::{Hit, Placed, Surface};

/// Everything that rays meet and that casts shadows: the parts of all surfaces.
#[derive(Clone, Debug)]
pub struct Objects {
    parts: Vec<Placed>,
    /// The surface that each is a part of.
    surfaces: Vec<usize>,
    rays: Arc<Finder>,
    shadows: Arc<Finder>,
    /// Sections of light buffers, where those find what is between a point and a line.
    sections: Option<u32>,
    buffers: Vec<LightBuffer>,
}

/// What finds them.
#[derive(Debug)]
enum Finder {
    Every,
    Grid(Grid),
    Hierarchy(Hierarchy),
}

/// So few objects are tested faster than a hierarchy of them is walked.
const FEW: usize = 4;

/// A hit nearer to a segment's end than this share of its length is the end's own surface.
pub(crate) const AT_END: f64 = 1e-9;

impl Objects {
    /// The parts of these surfaces.
    pub fn new(surfaces: &[Surface], structures: impl Into<Structures>) -> Self {
        let parts = surfaces
            .iter()
            .enumerate()
            .flat_map(|(i, surface)| Placed::parts(surface).into_iter().map(move |part| (part, i)));
        let (parts, surfaces): (Vec<Placed>, _) = parts.unzip();
        let Structures { rays, shadows } = structures.into();
        let finder = |structure| {
            Arc::new(match structure {
                Structure::Every => Finder::Every,
                Structure::Hierarchy if parts.len() <= FEW => Finder::Every,
                Structure::Grid(voxels) => Finder::Grid(Grid::new(&parts, voxels)),
                Structure::LightBuffer(_) | Structure::Hierarchy => Finder::Hierarchy(Hierarchy::new(&parts)),
            })
        };
        let sections = if let Structure::LightBuffer(sections) = shadows { Some(sections) } else { None };
        let for_rays = finder(rays);
        let for_shadows = if rays == shadows { Arc::clone(&for_rays) } else { finder(shadows) };
        Self { parts, surfaces, rays: for_rays, shadows: for_shadows, sections, buffers: Vec::new() }
    }

    /// The same, prepared for linear lights between these ends.
    pub fn for_lines(self, lines: impl Iterator<Item = [DVec3; 2]>) -> Self {
        let Some(sections) = self.sections else { return self };
        let buffers = lines.map(|[a, b]| LightBuffer::new(a, b, &self.parts, sections)).collect();
        Self { buffers, ..self }
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
        self.along(&self.rays, origin, direction, f64::INFINITY, |object, limit| {
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
        self.along(&self.shadows, p, direction, end, |object, limit| {
            hidden = hidden || self.parts[object].intersect(p, direction).is_some_and(|hit| hit.t < end);
            if hidden { f64::NEG_INFINITY } else { limit }
        });
        hidden
    }

    /// The objects that a ray may meet no farther than a limit, which `visit` takes and gives.
    fn along(
        &self,
        finder: &Finder,
        origin: DVec3,
        direction: DVec3,
        limit: f64,
        mut visit: impl FnMut(usize, f64) -> f64,
    ) {
        match finder {
            Finder::Every => {
                (0..self.parts.len()).fold(limit, |limit, object| visit(object, limit));
            }
            Finder::Grid(grid) => grid.along(origin, direction, limit, visit),
            Finder::Hierarchy(hierarchy) => hierarchy.along(&Ray::new(origin, direction), limit, visit),
        }
    }

    /// The objects that may touch the triangle (p, a, b), in ascending order.
    pub fn in_triangle(&self, p: DVec3, a: DVec3, b: DVec3, found: &mut Vec<usize>) {
        found.clear();
        if let Some(buffer) = self.buffers.iter().find(|buffer| buffer.is_along(a, b)) {
            found.extend(buffer.objects(p).iter().map(|&object| object as usize));
        } else if let Finder::Grid(grid) = &*self.shadows {
            grid.in_triangle([p, a, b], |object| found.push(object));
            found.sort_unstable();
        } else {
            self.in_hull(|| Hull::triangle([p, a, b]), found);
        }
    }

    /// The objects that may touch the pyramid from p to a convex or non-convex polygon, in ascending order.
    pub fn in_pyramid(&self, p: DVec3, polygon: &[DVec3], found: &mut Vec<usize>) {
        self.in_hull(|| Hull::pyramid(p, polygon), found);
    }

    fn in_hull<A: AsRef<[Axis]>>(&self, hull: impl FnOnce() -> Hull<A>, found: &mut Vec<usize>) {
        found.clear();
        match &*self.shadows {
            Finder::Every => found.extend(0..self.parts.len()),
            Finder::Grid(grid) => {
                let hull = hull();
                grid.visit(hull.bounds(), |bounds| hull.touches(bounds), |object| found.push(object));
            }
            Finder::Hierarchy(hierarchy) => {
                let hull = hull();
                hierarchy.visit(|bounds| hull.touches(bounds), |object| found.push(object));
            }
        }
        found.sort_unstable();
    }
}
