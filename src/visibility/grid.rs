//! A uniform grid of voxels.

use std::cell::Cell;

use glam::DVec3;

use super::cull::{Hull, Ray, SLACK, padded};
use super::hierarchy::index;
use crate::surface::{Bounds, Placed, Primitive};

/// Voxels over the bounds of all objects, each with those in it.
#[derive(Clone, Debug)]
pub(super) struct Grid {
    bounds: Bounds,
    /// Voxels along each axis.
    voxels: usize,
    /// Edges of a voxel.
    size: DVec3,
    /// How far tests are widened.
    slack: f64,
    /// Where in `objects` each voxel's begin, and the end of the last.
    starts: Vec<u32>,
    objects: Vec<u32>,
    unbounded: Vec<u32>,
    count: usize,
}

type Voxel = [usize; 3];

impl Grid {
    /// Of these objects, with `voxels` along each axis.
    pub(super) fn new(objects: &[Placed], voxels: u32) -> Self {
        let voxels = voxels.max(1) as usize;
        let boxes: Vec<_> = objects.iter().map(|object| object.bounds().as_ref().and_then(padded)).collect();
        let bounds = boxes.iter().flatten().fold(Bounds::EMPTY, |all, bounds| all.union(*bounds));
        let bounds = if bounds == Bounds::EMPTY { Bounds { min: DVec3::ZERO, max: DVec3::ONE } } else { bounds };
        let widest = (bounds.max - bounds.min).max_element().max(f64::MIN_POSITIVE);
        let slack = SLACK * widest;
        let max = bounds.max.max(bounds.min + slack);
        let mut grid = Self {
            bounds: Bounds { max, ..bounds },
            voxels,
            size: (max - bounds.min) / voxels as f64,
            slack,
            starts: vec![0; voxels.pow(3) + 1],
            objects: Vec::new(),
            unbounded: Vec::new(),
            count: objects.len(),
        };
        grid.fill(objects, &boxes);
        grid
    }

    /// Two passes over objects and their voxels: count, then place.
    fn fill(&mut self, objects: &[Placed], boxes: &[Option<Bounds>]) {
        let mut overlaps = Vec::new();
        for (i, (object, bounds)) in objects.iter().zip(boxes).enumerate() {
            match bounds {
                Some(bounds) => self.overlapped(object, bounds, |voxel| overlaps.push((voxel, index(i)))),
                None => self.unbounded.push(index(i)),
            }
        }
        overlaps.sort_unstable();
        for &(voxel, _) in &overlaps {
            self.starts[voxel + 1] += 1;
        }
        for i in 1..self.starts.len() {
            self.starts[i] += self.starts[i - 1];
        }
        self.objects = overlaps.into_iter().map(|(_, object)| object).collect();
    }

    /// The voxels that an object may overlap: a triangle itself, all else its box.
    fn overlapped(&self, object: &Placed, bounds: &Bounds, mut found: impl FnMut(usize)) {
        let hull = match object.primitive() {
            Primitive::Triangle(triangle) => Some(Hull::triangle(triangle.corners)),
            _ => None,
        };
        self.within(bounds, |voxel| {
            if hull.as_ref().is_none_or(|hull| hull.touches(&self.bounds_of(voxel))) {
                found(self.place(voxel));
            }
        });
    }

    /// The voxel that holds a point, or the nearest to it.
    fn voxel_at(&self, p: DVec3) -> Voxel {
        let at = (p - self.bounds.min) / self.size;
        at.to_array().map(|at| self.clamped(at))
    }

    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to the voxels there are")]
    fn clamped(&self, at: f64) -> usize {
        at.clamp(0.0, (self.voxels - 1) as f64) as usize
    }

    fn place(&self, [x, y, z]: Voxel) -> usize {
        (z * self.voxels + y) * self.voxels + x
    }

    /// The lower face of a layer of voxels.
    fn face(&self, axis: usize, layer: usize) -> f64 {
        self.bounds.min[axis] + layer as f64 * self.size[axis]
    }

    /// The box of a voxel, widened.
    fn bounds_of(&self, voxel: Voxel) -> Bounds {
        let face = |add: usize| DVec3::from_array(std::array::from_fn(|axis| self.face(axis, voxel[axis] + add)));
        Bounds { min: face(0) - self.slack, max: face(1) + self.slack }
    }

    /// Every object in the voxels along a ray, once, up to a limit, which `visit` takes and gives.
    ///
    /// **Source:** J. Amanatides & A. Woo, *A fast voxel traversal algorithm for ray tracing*, Eurographics 1987.
    /// **Deviation:** a face's distance is computed where it is crossed and not summed up, which keeps it exact.
    pub(super) fn along(
        &self,
        origin: DVec3,
        direction: DVec3,
        mut limit: f64,
        mut visit: impl FnMut(usize, f64) -> f64,
    ) {
        for &object in &self.unbounded {
            limit = visit(object as usize, limit);
        }
        let Some(enter) = Ray::new(origin, direction).enter(&self.bounds, limit) else { return };
        let mut voxel = self.voxel_at(origin + enter.max(0.0) * direction);
        let crossing = |axis: usize, layer: usize| {
            let d = direction[axis];
            if d == 0.0 {
                return f64::INFINITY;
            }
            (self.face(axis, layer + usize::from(d > 0.0)) - origin[axis]) / d
        };
        let mut next: [f64; 3] = std::array::from_fn(|axis| crossing(axis, voxel[axis]));
        with_mailbox(self.count, |mailbox| {
            loop {
                for &object in self.in_voxel(self.place(voxel)) {
                    if mailbox.is_new(object) {
                        limit = visit(object as usize, limit);
                    }
                }
                let axis = (0..3).fold(0, |least, axis| if next[axis] < next[least] { axis } else { least });
                // What the voxel holds may be met a little beyond it.
                if next[axis] > limit * (1.0 + SLACK) {
                    return;
                }
                let on = if direction[axis] > 0.0 { voxel[axis] + 1 } else { voxel[axis].wrapping_sub(1) };
                if on >= self.voxels {
                    return;
                }
                voxel[axis] = on;
                next[axis] = crossing(axis, on);
            }
        });
    }

    fn in_voxel(&self, place: usize) -> &[u32] {
        &self.objects[self.starts[place] as usize..self.starts[place + 1] as usize]
    }

    /// Every object in the voxels that a triangle overlaps, once: scan-converted layer by layer and row by row, the
    /// rows along its greatest extent (POULIN_AMANATIDES_1990, §6.1).
    pub(super) fn in_triangle(&self, corners: [DVec3; 3], mut found: impl FnMut(usize)) {
        self.unbounded.iter().for_each(|&object| found(object as usize));
        let around = Bounds::about(&corners);
        let extent = (around.max - around.min) / self.size;
        let mut axes = [0, 1, 2];
        axes.sort_by(|&a, &b| extent[a].total_cmp(&extent[b]));
        let triangle = Outline::new(&corners);
        with_mailbox(self.count, |mailbox| {
            self.layers(&triangle, axes[0], |layer, slice| {
                self.layers(slice, axes[1], |row, strip| {
                    let Some((first, last)) = self.layers_of(strip, axes[2]) else { return };
                    for column in first..=last {
                        let mut voxel = [0; 3];
                        (voxel[axes[0]], voxel[axes[1]], voxel[axes[2]]) = (layer, row, column);
                        for &object in self.in_voxel(self.place(voxel)) {
                            if mailbox.is_new(object) {
                                found(object as usize);
                            }
                        }
                    }
                });
            });
        });
    }

    /// Every object in the voxels within `around` that pass a test, once.
    pub(super) fn visit(&self, around: &Bounds, touches: impl Fn(&Bounds) -> bool, mut found: impl FnMut(usize)) {
        self.unbounded.iter().for_each(|&object| found(object as usize));
        if around.max.cmplt(self.bounds.min).any() || around.min.cmpgt(self.bounds.max).any() {
            return;
        }
        with_mailbox(self.count, |mailbox| {
            self.within(around, |voxel| {
                if touches(&self.bounds_of(voxel)) {
                    let objects = self.in_voxel(self.place(voxel)).iter();
                    objects.filter(|&&object| mailbox.is_new(object)).for_each(|&object| found(object as usize));
                }
            });
        });
    }

    /// The voxels that a box may overlap.
    fn within(&self, bounds: &Bounds, mut each: impl FnMut(Voxel)) {
        let (first, last) = (self.voxel_at(bounds.min - self.slack), self.voxel_at(bounds.max + self.slack));
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                for x in first[0]..=last[0] {
                    each([x, y, z]);
                }
            }
        }
    }

    /// The layers of voxels across an axis that an outline overlaps, each with what of it lies there.
    fn layers(&self, outline: &Outline, axis: usize, mut each: impl FnMut(usize, &Outline)) {
        let Some((first, last)) = self.layers_of(outline, axis) else { return };
        if first == last {
            return each(first, outline);
        }
        for layer in first..=last {
            let (low, high) = (self.face(axis, layer) - self.slack, self.face(axis, layer + 1) + self.slack);
            each(layer, &outline.clipped(axis, 1.0, low).clipped(axis, -1.0, -high));
        }
    }

    /// The first and the last layer across an axis that an outline overlaps.
    fn layers_of(&self, outline: &Outline, axis: usize) -> Option<(usize, usize)> {
        let (low, high) = outline.extent(axis);
        let (low, high) = (low - self.slack, high + self.slack);
        if !(low <= self.bounds.max[axis] && high >= self.bounds.min[axis]) {
            return None;
        }
        let layer = |x: f64| self.clamped((x - self.bounds.min[axis]) / self.size[axis]);
        Some((layer(low), layer(high)))
    }
}

/// A convex polygon: a triangle cut by up to four planes.
#[derive(Clone, Copy)]
struct Outline {
    corners: [DVec3; 7],
    count: usize,
}

impl Outline {
    fn new(points: &[DVec3; 3]) -> Self {
        let mut corners = [DVec3::ZERO; 7];
        corners[..3].copy_from_slice(points);
        Self { corners, count: 3 }
    }

    fn corners(&self) -> &[DVec3] {
        &self.corners[..self.count]
    }

    /// From least to greatest coordinate; of nothing, from infinity to minus infinity.
    fn extent(&self, axis: usize) -> (f64, f64) {
        let along = self.corners().iter().map(|corner| corner[axis]);
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
    }

    /// What lies where sign·x ≥ least.
    fn clipped(&self, axis: usize, sign: f64, least: f64) -> Self {
        let mut kept = Self { corners: [DVec3::ZERO; 7], count: 0 };
        let Some(mut last) = self.corners().last().copied() else { return kept };
        for &corner in self.corners() {
            let (before, now) = (sign * last[axis] - least, sign * corner[axis] - least);
            if (before < 0.0) != (now < 0.0) {
                kept.push(last + before / (before - now) * (corner - last));
            }
            if now >= 0.0 {
                kept.push(corner);
            }
            last = corner;
        }
        kept
    }

    /// A plane adds one corner to a convex polygon at most, so that there is room.
    fn push(&mut self, corner: DVec3) {
        if let Some(place) = self.corners.get_mut(self.count) {
            *place = corner;
            self.count += 1;
        }
    }
}

/// Which objects a query has come upon.
#[derive(Default)]
struct Mailbox {
    query: u32,
    seen: Vec<u32>,
}

thread_local! {
    static MAILBOX: Cell<Mailbox> = Cell::default();
}

/// Do a query over this many objects with an empty mailbox.
fn with_mailbox(count: usize, query: impl FnOnce(&mut Mailbox)) {
    let mut mailbox = MAILBOX.take();
    if mailbox.seen.len() < count || mailbox.query == u32::MAX {
        mailbox.seen.clear();
        mailbox.seen.resize(count, 0);
        mailbox.query = 0;
    }
    mailbox.query += 1;
    query(&mut mailbox);
    MAILBOX.set(mailbox);
}

impl Mailbox {
    fn is_new(&mut self, object: u32) -> bool {
        std::mem::replace(&mut self.seen[object as usize], self.query) != self.query
    }
}
