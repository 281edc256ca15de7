//! The part of a light's plane that an occluder hides, as convex regions.
//!
//! A convex solid is the common part of half-spaces gᵢ ≤ 0. A point q is hidden from p outside it where some
//! x = p + t(q − p), 0 ≤ t ≤ 1, lies in all of them. Taking t out of these inequalities (Fourier and Motzkin) leaves linear
//! ones for q: gᵢ(q) ≤ 0 for each face in front, gᵢ(p) > 0, and gᵢ(p) gⱼ(q) ≤ gⱼ(p) gᵢ(q) for each edge of the silhouette, where a
//! face in front meets one behind: that is the plane through p and the edge. From inside, what lies beyond any face is hidden;
//! from a point on faces, only what lies below them besides.

use std::ops::Range;

use glam::{DMat3, DVec3};

use super::clip::{Clipper, Corner, HalfSpace, bounds, vector_area};
use super::round;
use crate::surface::{ON_SURFACE, Placed, Primitive, Triangle};
use crate::visibility::objects::AT_END;

/// The part of a light above the horizon, as seen from p.
pub(super) struct Light {
    pub(super) p: DVec3,
    pub(super) corners: Vec<Corner>,
    pub(super) area: f64,
    /// Unit normal of its plane, away from p.
    pub(super) normal: DVec3,
    /// From p to its plane.
    height: f64,
    /// A sphere about it, as seen from p.
    center: DVec3,
    radius: f64,
}

impl Light {
    /// None where nothing of the light is above the horizon, or p is in its plane.
    pub(super) fn above_horizon(p: DVec3, n: DVec3, polygon: &[DVec3], clipper: &mut Clipper) -> Option<Self> {
        let mut corners: Vec<Corner> = polygon.iter().copied().map(Corner::uncut).collect();
        clipper.cut(&mut corners, &HalfSpace::through_p(-n), 0);
        if clipper.is_sliver(&corners) {
            return None;
        }
        let area = vector_area(&corners);
        let normal = area.try_normalize()?;
        let center = corners.iter().map(|corner| corner.at - p).sum::<DVec3>() / corners.len() as f64;
        let height = normal.dot(center);
        let radius = corners.iter().map(|corner| (corner.at - p).distance(center)).fold(0.0, f64::max);
        (height != 0.0).then(|| Self {
            p,
            corners,
            area: area.length(),
            normal: normal * height.signum(),
            height: height.abs(),
            center,
            radius,
        })
    }

    /// Whether a part is between p and the light's plane, and spheres about both overlap as seen from p.
    pub(super) fn may_be_hidden_by(&self, part: &Placed) -> bool {
        let Some(bounds) = part.bounds() else { return true };
        let (center, radius) = (bounds.center() - self.p, 0.5 * bounds.min.distance(bounds.max));
        let height = self.normal.dot(center);
        if height - radius >= self.height || height + radius <= 0.0 {
            return false;
        }
        let (a, b) = (center.length(), self.center.length());
        let (sine_a, sine_b) = (radius / a, self.radius / b);
        if sine_a >= 1.0 || sine_b >= 1.0 {
            return true;
        }
        let (cosine_a, cosine_b) = ((1.0 - sine_a * sine_a).sqrt(), (1.0 - sine_b * sine_b).sqrt());
        center.dot(self.center) >= a * b * (cosine_a * cosine_b - sine_a * sine_b) * (1.0 - 1e-12)
    }

    /// How much larger a round thing appears than the light is wide on average, at least 1.
    ///
    /// It appears by its nearest point, be p outside it or in it; nearer than [`NEAREST`] radii it grows no more.
    fn magnification(&self, center: DVec3, radius: f64) -> f64 {
        let length = self.center.length();
        let width = 0.5 * self.area / self.radius * (self.height / length);
        let distance = (center.length() - radius).abs().max(NEAREST * radius);
        (radius * length / (width * distance)).max(1.0)
    }
}

/// How near to a round thing, in its radii, its outline still gains sides.
const NEAREST: f64 = 0.05;

/// What an occluder hides of the light.
#[derive(Clone, Debug)]
pub(super) struct Shadow {
    /// Its half-spaces, those that cut the light.
    planes: Range<usize>,
    /// The hidden part of the light.
    pub(super) outline: Vec<Corner>,
    area: f64,
}

/// What several occluders hide.
#[derive(Clone, Debug, Default)]
pub(super) struct Shadows {
    planes: Vec<HalfSpace>,
    shadows: Vec<Shadow>,
}

impl Shadows {
    pub(super) fn is_empty(&self) -> bool {
        self.shadows.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.shadows.len()
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Shadow> {
        self.shadows.iter()
    }

    pub(super) fn region(&self, shadow: &Shadow) -> &[HalfSpace] {
        self.planes.get(shadow.planes.clone()).unwrap_or_default()
    }

    /// The largest first, so that the others find little left.
    pub(super) fn sort(&mut self) {
        self.shadows.sort_by(|a, b| b.area.total_cmp(&a.area));
    }

    /// Adds what a part hides of the light; false where that is not known.
    pub(super) fn add(&mut self, part: &Placed, light: &Light, clipper: &mut Clipper) -> bool {
        let view = View::new(part, light);
        if !view.p.is_finite() {
            // A flattened surface is never hit.
            return true;
        }
        let mut regions = Regions::default();
        match part.primitive() {
            Primitive::Plane => flat(view.p, &[], &mut regions),
            Primitive::Square { size } => {
                let half = 0.5 * size;
                let sides = [(DVec3::X, half.x), (DVec3::NEG_X, half.x), (DVec3::Y, half.y), (DVec3::NEG_Y, half.y)];
                flat(view.p, &sides, &mut regions);
            }
            Primitive::Disk { radius } => flat(view.p, &round::disk(*radius, view.sides(*radius)), &mut regions),
            Primitive::Triangle(triangle) => self::triangle(triangle, view.p, &mut regions),
            Primitive::Box { size } => solid(&box_faces(0.5 * size, view.p), &BOX_EDGES, &mut regions),
            Primitive::Sphere { radius } => round::sphere(*radius, &view, &mut regions),
            Primitive::Cylinder { radius, height } => {
                let (faces, edges) = round::cylinder(*radius, *height, view.p, view.sides(*radius));
                solid(&faces, &edges, &mut regions);
            }
            Primitive::Cone { radius, height } => {
                let (faces, edges) = round::cone(*radius, *height, view.p, view.sides(*radius));
                solid(&faces, &edges, &mut regions);
            }
            Primitive::Patch(_) => return self.leaves_alone(part, light, clipper),
        }
        let to_world = part.local_from_world().matrix3.transpose();
        for half_space in &mut regions.planes {
            half_space.normal = to_world * half_space.normal;
        }
        for region in regions.iter() {
            self.add_region(region, light, clipper);
        }
        true
    }

    /// Whether the box about a part hides nothing of the light.
    fn leaves_alone(&self, part: &Placed, light: &Light, clipper: &mut Clipper) -> bool {
        let Some(bounds) = part.bounds() else { return false };
        let mut regions = Regions::default();
        let faces = box_faces(0.5 * (bounds.max - bounds.min), light.p - bounds.center());
        if faces.iter().all(|face| face.at_p <= 0.0) {
            return false;
        }
        solid(&faces, &BOX_EDGES, &mut regions);
        regions.iter().all(|region| !clipper.intersect(&mut light.corners.clone(), region))
    }

    /// Keeps a region's half-spaces that bound what it hides of the light, if it hides any.
    fn add_region(&mut self, region: &[HalfSpace], light: &Light, clipper: &mut Clipper) {
        let mut outline = light.corners.clone();
        if !clipper.intersect(&mut outline, region) {
            return;
        }
        let start = self.planes.len();
        self.planes.extend(region.iter().enumerate().filter(|(i, _)| bounds(&outline, *i)).map(|(_, plane)| plane));
        let area = vector_area(&outline).length();
        self.shadows.push(Shadow { planes: start..self.planes.len(), outline, area });
    }
}

/// p and the light in the frame of an occluder.
pub(super) struct View<'a> {
    pub(super) p: DVec3,
    part: &'a Placed,
    light: &'a Light,
}

impl<'a> View<'a> {
    fn new(part: &'a Placed, light: &'a Light) -> Self {
        Self { p: part.local_from_world().transform_point3(light.p), part, light }
    }

    /// The light's plane: unit normal, and distance of the origin below it.
    pub(super) fn plane(&self) -> (DVec3, f64) {
        let m: DMat3 = self.part.world_from_local().matrix3;
        let normal = m.transpose() * self.light.normal;
        let length = normal.length();
        (normal / length, (self.light.height + normal.dot(self.p)) / length)
    }

    /// How many sides a circle of a radius, about the origin, is given.
    pub(super) fn sides(&self, radius: f64) -> usize {
        let m = self.part.world_from_local();
        let stretch = m.matrix3.x_axis.length().max(m.matrix3.y_axis.length()).max(m.matrix3.z_axis.length());
        round::sides(self.light.magnification(m.translation - self.light.p, stretch * radius))
    }
}

/// Convex regions of half-spaces, in an occluder's own frame, relative to p.
#[derive(Clone, Debug, Default)]
pub(super) struct Regions {
    planes: Vec<HalfSpace>,
    ends: Vec<usize>,
}

impl Regions {
    /// Adds the common part of half-spaces.
    pub(super) fn push(&mut self, planes: impl IntoIterator<Item = HalfSpace>) {
        self.planes.extend(planes);
        self.ends.push(self.planes.len());
    }

    fn iter(&self) -> impl Iterator<Item = &[HalfSpace]> {
        let starts = std::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).filter_map(|(&start, &end)| self.planes.get(start..end))
    }
}

/// A face of a convex solid: the outward normal and the value at p of its linear function g.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) normal: DVec3,
    pub(super) at_p: f64,
}

impl Face {
    /// The face normal·x = d of a solid of this size.
    pub(super) fn new(normal: DVec3, d: f64, p: DVec3, size: f64) -> Self {
        let at_p = normal.dot(p) - d;
        Self { normal, at_p: if at_p.abs() <= ON_SURFACE * size { 0.0 } else { at_p } }
    }

    /// The half-space behind it. What goes through it by no more than [`AT_END`] of the way from p only touches it.
    fn behind(&self) -> HalfSpace {
        HalfSpace { normal: self.normal, offset: self.at_p, slack: AT_END * self.at_p.abs() }
    }
}

/// What a convex solid hides; `edges` are the pairs of faces that meet.
pub(super) fn solid(faces: &[Face], edges: &[(usize, usize)], regions: &mut Regions) {
    let in_front = |face: &&Face| face.at_p > 0.0;
    if faces.iter().any(|face| in_front(&face)) {
        let silhouette = edges.iter().filter_map(|&(i, j)| {
            let (a, b) = (faces.get(i)?, faces.get(j)?);
            let (front, back) = if in_front(&a) { (a, b) } else { (b, a) };
            (in_front(&front) && !in_front(&back)).then(|| silhouette_plane(front, back))
        });
        regions.push(silhouette.chain(faces.iter().filter(in_front).map(Face::behind)));
        return;
    }
    let touched = || faces.iter().filter(|face| face.at_p == 0.0).map(Face::behind);
    for face in faces.iter().filter(|face| face.at_p < 0.0) {
        regions.push(touched().chain([face.behind().complement()]));
    }
}

/// What the plane through p and the edge of two faces leaves on the solid's side.
fn silhouette_plane(front: &Face, back: &Face) -> HalfSpace {
    HalfSpace::through_p(front.at_p * back.normal - back.at_p * front.normal)
}

/// What a flat shape in z = 0 hides, given the outward normals and distances of its sides.
fn flat(p: DVec3, sides: &[(DVec3, f64)], regions: &mut Regions) {
    if p.z.abs() <= ON_SURFACE * p.length() {
        return;
    }
    let front = Face { normal: DVec3::Z * p.z.signum(), at_p: p.z.abs() };
    let side = |&(normal, d): &(DVec3, f64)| silhouette_plane(&front, &Face { normal, at_p: normal.dot(p) - d });
    regions.push(sides.iter().map(side).chain([front.behind()]));
}

/// What a triangle hides. Triangles that share an edge share its plane to the last bit, so that light finds no slit.
fn triangle(triangle: &Triangle, p: DVec3, regions: &mut Regions) {
    let [a, b, c] = triangle.corners.map(|corner| corner - p);
    let n = (b - a).cross(c - a);
    let height = a.dot(n);
    if height.abs() <= ON_SURFACE * n.length() * a.length().max(b.length()).max(c.length()) {
        return;
    }
    let side = -height.signum();
    let edge = |(a, b): (DVec3, DVec3)| HalfSpace::through_p(side * a.cross(b));
    let front = Face { normal: side * n, at_p: height.abs() };
    regions.push([(a, b), (b, c), (c, a)].map(edge).into_iter().chain([front.behind()]));
}

/// The faces of a box about the origin.
fn box_faces(half: DVec3, p: DVec3) -> [Face; 6] {
    [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::NEG_Y, DVec3::Z, DVec3::NEG_Z]
        .map(|normal| Face::new(normal, normal.abs().dot(half), p, half.max_element()))
}

/// Its edges: the faces that are not opposite.
const BOX_EDGES: [(usize, usize); 12] =
    [(0, 2), (0, 3), (0, 4), (0, 5), (1, 2), (1, 3), (1, 4), (1, 5), (2, 4), (2, 5), (3, 4), (3, 5)];
