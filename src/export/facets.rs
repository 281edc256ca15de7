//! Surfaces as triangles, for targets that do not hold their shapes.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::surface::{Placed, Primitive, Triangle};

/// Round surfaces have so many sides: a radius is off by at most 0.054 % of it.
pub(super) const SIDES: u32 = 96;

/// Half an edge, in metres, of the square that stands for an infinite plane.
pub(super) const PLANE_REACH: f64 = 1000.0;

/// Patches are followed within this share of their size.
pub(super) const PATCH_SHARE: f64 = 1e-4;

/// How much larger a part is in the world, where that is the same along all its axes.
pub(super) fn even_scale(placed: &Placed) -> Option<f64> {
    let axes = placed.world_from_local().matrix3;
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
    ((x - y).abs() <= 1e-12 * x && (x - z).abs() <= 1e-12 * x).then_some(x)
}

/// The triangles of a surface's part in the world, fronts outward.
pub(super) fn facets(placed: &Placed) -> Vec<Triangle> {
    let to_world = |triangle: &Triangle| triangle.transformed(placed.world_from_local());
    local_facets(placed.primitive()).iter().map(to_world).collect()
}

/// The triangles of a primitive in its own frame, fronts outward.
pub(super) fn local_facets(primitive: &Primitive) -> Vec<Triangle> {
    match *primitive {
        Primitive::Plane => square(DVec2::splat(PLANE_REACH)),
        Primitive::Square { size } => square(0.5 * size),
        Primitive::Box { size } => cuboid(0.5 * size),
        Primitive::Disk { radius } => revolved(&[Band::flat([radius, 0.0], 0.0)]),
        Primitive::Sphere { radius } => sphere(radius),
        Primitive::Cylinder { radius, height } => {
            let half = 0.5 * height;
            let side = Band { ends: [DVec2::new(radius, -half), DVec2::new(radius, half)], normals: [DVec2::X; 2] };
            revolved(&[Band::flat([0.0, radius], -half), side, Band::flat([radius, 0.0], half)])
        }
        Primitive::Cone { radius, height } => {
            let half = 0.5 * height;
            let normal = DVec2::new(height, radius).normalize_or_zero();
            let side = Band { ends: [DVec2::new(radius, -half), DVec2::new(0.0, half)], normals: [normal; 2] };
            revolved(&[Band::flat([0.0, radius], -half), side])
        }
        Primitive::Patch(ref patch) => patch.triangles(patch.fineness(PATCH_SHARE)),
        Primitive::Triangle(triangle) => vec![triangle],
    }
}

/// The halves of a parallelogram, counter-clockwise from its first corner.
fn halves([a, b, c, d]: [DVec3; 4]) -> [Triangle; 2] {
    [[a, b, c], [a, c, d]].map(|corners| Triangle { corners, normals: None })
}

fn square(half: DVec2) -> Vec<Triangle> {
    let corner = |x: f64, y: f64| (DVec2::new(x, y) * half).extend(0.0);
    halves([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]).to_vec()
}

/// The corners of a box's faces, each counter-clockwise from outside.
pub(super) fn box_faces(half: DVec3) -> [[DVec3; 4]; 6] {
    let face = |axis: usize, sign: f64| {
        let [mut normal, mut u, mut v] = [DVec3::ZERO; 3];
        (normal[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (sign, sign, 1.0);
        [-u - v, u - v, u + v, v - u].map(|across| (normal + across) * half)
    };
    [face(0, -1.0), face(0, 1.0), face(1, -1.0), face(1, 1.0), face(2, -1.0), face(2, 1.0)]
}

fn cuboid(half: DVec3) -> Vec<Triangle> {
    box_faces(half).into_iter().flat_map(halves).collect()
}

/// A part of a profile, (distance from the axis, z), that turns about Z; outside lies to its right.
struct Band {
    ends: [DVec2; 2],
    normals: [DVec2; 2],
}

impl Band {
    /// Across the axis at a height; outward is up where it runs inwards.
    fn flat([from, to]: [f64; 2], z: f64) -> Self {
        let up = if to < from { DVec2::Y } else { DVec2::NEG_Y };
        Self { ends: [DVec2::new(from, z), DVec2::new(to, z)], normals: [up; 2] }
    }
}

fn sphere(radius: f64) -> Vec<Triangle> {
    let rings = SIDES / 2;
    let at = |ring: u32| {
        let (sin, cos) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
        // Exactly on the axis at the poles.
        DVec2::new(if ring.is_multiple_of(rings) { 0.0 } else { sin }, -cos)
    };
    let bands: Vec<_> = (0..rings)
        .map(|ring| {
            let normals = [at(ring), at(ring + 1)];
            Band { ends: normals.map(|n| radius * n), normals }
        })
        .collect();
    revolved(&bands)
}

/// Bands about Z, with their normals; triangles with two corners on the axis are left out.
fn revolved(bands: &[Band]) -> Vec<Triangle> {
    let around = |side: u32| DVec2::from_angle(TAU * f64::from(side % SIDES) / f64::from(SIDES));
    let mut triangles = Vec::new();
    for Band { ends, normals } in bands {
        for side in 0..SIDES {
            let turned = |at: DVec2, side: u32| (at.x * around(side)).extend(at.y);
            let corner = |end: usize, side: u32| (turned(ends[end], side), turned(normals[end], side));
            let [a, b, c, d] = [corner(0, side), corner(0, side + 1), corner(1, side + 1), corner(1, side)];
            let triangle = |corners: [(DVec3, DVec3); 3]| Triangle {
                corners: corners.map(|(p, _)| p),
                normals: Some(corners.map(|(_, n)| n)),
            };
            if ends[0].x > 0.0 {
                triangles.push(triangle([a, b, c]));
            }
            if ends[1].x > 0.0 {
                triangles.push(triangle([a, c, d]));
            }
        }
    }
    triangles
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::{Shape, Surface};

    /// The surface's volume by the divergence theorem, and its area, both as a share of those expected.
    #[track_caller]
    fn check(shape: Shape, scale: DVec3, volume: f64, area: f64) {
        let (name, position, rotation_deg) = ("s".to_owned(), DVec3::new(1.0, 2.0, 3.0), DVec3::new(20.0, 30.0, 40.0));
        let surface = Surface { material: name.clone(), name, position, rotation_deg, scale, shape };
        let triangles: Vec<_> = Placed::parts(&surface).iter().flat_map(facets).collect();
        let sum = |of: fn(&Triangle) -> f64| triangles.iter().map(of).sum::<f64>();
        let found = sum(|t| {
            let [a, b, c] = t.corners.map(|p| p - DVec3::new(1.0, 2.0, 3.0));
            a.dot(b.cross(c)) / 6.0
        });
        let name = surface.shape.name();
        assert!((found - volume).abs() <= 3e-3 * volume.max(1.0), "{name}: a volume of {found}, not {volume}");
        let found = sum(Triangle::area);
        assert!((found - area).abs() <= 3e-3 * area, "{name}: an area of {found}, not {area}");
        for triangle in &triangles {
            let [a, b, c] = triangle.corners;
            let front = (b - a).cross(c - a).normalize();
            let normals = triangle.normals.unwrap_or([front; 3]);
            assert!(normals.iter().all(|n| n.dot(front) > 0.8), "normals are on the front's side: {triangle:?}");
        }
    }

    #[test]
    fn facets_face_outward_and_hold_volume_and_area() {
        let one = DVec3::ONE;
        check(Shape::Sphere { radius: 0.7 }, one, 4.0 / 3.0 * PI * 0.343, 4.0 * PI * 0.49);
        check(Shape::Sphere { radius: 1.0 }, DVec3::splat(-1.0), 4.0 / 3.0 * PI, 4.0 * PI);
        check(Shape::Box { size: DVec3::new(1.0, 2.0, 3.0) }, one, 6.0, 22.0);
        check(Shape::Box { size: one }, DVec3::new(1.0, -2.0, 3.0), 6.0, 22.0);
        check(Shape::Cylinder { radius: 0.5, height: 2.0 }, one, PI * 0.5, PI * 2.5);
        check(Shape::Cone { radius: 3.0, height: 4.0 }, one, 12.0 * PI, 24.0 * PI);
        check(Shape::Square { size: DVec2::new(2.0, 1.0) }, one, 0.0, 2.0);
        check(Shape::Disk { radius: 2.0 }, one, 0.0, 4.0 * PI);
        check(Shape::Tetrahedron { depth: 0 }, one, 2.0_f64.sqrt() / 12.0, 3.0_f64.sqrt());
    }
}
