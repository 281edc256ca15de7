//! Surfaces placed in the world, and rays against them.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use super::fractal::{sphereflake, tetrahedron};
use super::intersect::intersect;
use super::{Patch, Primitive, Shape, Surface, Triangle};

/// A primitive placed in the world, prepared for rays.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    primitive: Primitive,
    frame: Arc<Frame>,
}

/// The frame of a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    world_from_local: DAffine3,
    local_from_world: DAffine3,
    world_from_normal: DMat3,
}

impl Frame {
    fn new(world_from_local: DAffine3) -> Self {
        let local_from_world = world_from_local.inverse();
        Self { world_from_local, local_from_world, world_from_normal: local_from_world.matrix3.transpose() }
    }
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// Distance from the origin, in lengths of the direction.
    pub t: f64,
    /// The point, on the surface to rounding.
    pub p: DVec3,
    /// Unit normal: outward on a solid, along the local +Z on a plane, square or disk.
    pub n: DVec3,
}

/// A box along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Least coordinates.
    pub min: DVec3,
    /// Greatest coordinates.
    pub max: DVec3,
}

impl Placed {
    /// The primitives of a surface, in the world.
    pub fn parts(surface: &Surface) -> Vec<Self> {
        Self::parts_of(&surface.shape, surface.world_from_surface())
    }

    /// The primitives of a shape in a frame.
    fn parts_of(shape: &Shape, world_from_surface: DAffine3) -> Vec<Self> {
        let whole = |primitive| vec![Self::new(world_from_surface, primitive)];
        match *shape {
            Shape::Plane {} => whole(Primitive::Plane),
            Shape::Sphere { radius } => whole(Primitive::Sphere { radius }),
            Shape::Box { size } => whole(Primitive::Box { size }),
            Shape::Square { size } => whole(Primitive::Square { size }),
            Shape::Disk { radius } => whole(Primitive::Disk { radius }),
            Shape::Cylinder { radius, height } => whole(Primitive::Cylinder { radius, height }),
            Shape::Cone { radius, height } => whole(Primitive::Cone { radius, height }),
            Shape::Sphereflake { depth } => {
                let sphere = |(center, radius)| {
                    let world_from_sphere = world_from_surface * DAffine3::from_translation(center);
                    Self::new(world_from_sphere, Primitive::Sphere { radius })
                };
                sphereflake(depth).into_iter().map(sphere).collect()
            }
            Shape::Patch { ref control_points } => whole(Primitive::Patch(Arc::new(Patch::new(**control_points)))),
            Shape::Mesh(ref mesh) => Self::triangles(&world_from_surface, &mesh.triangles),
            Shape::Tetrahedron { depth } => Self::triangles(&world_from_surface, &tetrahedron(depth)),
        }
    }

    fn new(world_from_local: DAffine3, primitive: Primitive) -> Self {
        Self { primitive, frame: Arc::new(Frame::new(world_from_local)) }
    }

    /// Triangles, in the world; they share one frame.
    fn triangles(world_from_local: &DAffine3, triangles: &[Triangle]) -> Vec<Self> {
        let frame = Arc::new(Frame::new(DAffine3::IDENTITY));
        let placed = |triangle: &Triangle| {
            let primitive = Primitive::Triangle(triangle.transformed(world_from_local));
            Self { primitive, frame: Arc::clone(&frame) }
        };
        triangles.iter().map(placed).collect()
    }

    /// A patch as triangles no farther from it than `share` of its size; anything else as it is.
    pub fn in_triangles(self, share: f64) -> Vec<Self> {
        match &self.primitive {
            Primitive::Patch(patch) => {
                let triangles = patch.triangles(patch.fineness(share));
                Self::triangles(&self.frame.world_from_local, &triangles)
            }
            _ => vec![self],
        }
    }

    /// The primitive in its own frame.
    pub fn primitive(&self) -> &Primitive {
        &self.primitive
    }

    /// From the primitive's own frame to the world.
    pub fn world_from_local(&self) -> &DAffine3 {
        &self.frame.world_from_local
    }

    /// From the world to the primitive's own frame.
    pub fn local_from_world(&self) -> &DAffine3 {
        &self.frame.local_from_world
    }

    /// The nearest hit in front of `origin`.
    ///
    /// The ray is taken to the surface's own frame, where the shape is plain; normals come back by the inverse
    /// transpose, so that non-uniform and negative scales hold. **Domain:** a flat face on which the origin lies is
    /// not hit, a round one only again at its far side: see `surface::intersect`. A scale with a zero is never hit.
    pub fn intersect(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        if let Primitive::Triangle(triangle) = &self.primitive {
            return triangle.intersect(origin, direction);
        }
        let o = self.frame.local_from_world.transform_point3(origin);
        let d = self.frame.local_from_world.transform_vector3(direction);
        let hit = intersect(&self.primitive, o, d)?;
        Some(Hit {
            t: hit.t,
            p: self.frame.world_from_local.transform_point3(hit.p),
            n: (self.frame.world_from_normal * hit.n).try_normalize()?,
        })
    }

    /// A box about the primitive; none for the infinite plane.
    pub fn bounds(&self) -> Option<Bounds> {
        let half = match &self.primitive {
            Primitive::Plane => return None,
            Primitive::Triangle(triangle) => return Some(Bounds::about(&triangle.corners)),
            Primitive::Patch(patch) => {
                return Some(Bounds::about(
                    &patch.control_points.map(|p| self.frame.world_from_local.transform_point3(p)),
                ));
            }
            &Primitive::Sphere { radius } => DVec3::splat(radius),
            &Primitive::Box { size } => 0.5 * size,
            &Primitive::Square { size } => 0.5 * size.extend(0.0),
            &Primitive::Disk { radius } => DVec3::new(radius, radius, 0.0),
            &Primitive::Cylinder { radius, height } | &Primitive::Cone { radius, height } => {
                DVec3::new(radius, radius, 0.5 * height)
            }
        };
        let m = self.frame.world_from_local.matrix3;
        let reach = m.x_axis.abs() * half.x + m.y_axis.abs() * half.y + m.z_axis.abs() * half.z;
        let center = self.frame.world_from_local.translation;
        Some(Bounds { min: center - reach, max: center + reach })
    }
}

impl Shape {
    /// A box about the shape in its own frame; none for the infinite plane.
    pub fn bounds(&self) -> Option<Bounds> {
        let parts = Placed::parts_of(self, DAffine3::IDENTITY);
        parts.iter().map(Placed::bounds).reduce(|a, b| Some(a?.union(b?))).flatten()
    }
}

impl Bounds {
    /// Of nothing.
    pub const EMPTY: Self = Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY };

    /// The box about points.
    pub fn about(points: &[DVec3]) -> Self {
        points.iter().fold(Self::EMPTY, |bounds, &p| Self { min: bounds.min.min(p), max: bounds.max.max(p) })
    }

    /// The box about two.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Its middle.
    pub fn center(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;
    use proptest::prelude::*;

    use super::*;
    use crate::surface::Shape;

    fn surface(shape: Shape, position: DVec3, rotation_deg: DVec3, scale: DVec3) -> Surface {
        Surface { name: "s".to_owned(), material: "m".to_owned(), position, rotation_deg, scale, shape }
    }

    /// A surface of one part.
    fn only(surface: &Surface) -> Placed {
        Placed::parts(surface).remove(0)
    }

    fn plain(shape: Shape) -> Placed {
        only(&surface(shape, DVec3::ZERO, DVec3::ZERO, DVec3::ONE))
    }

    /// Positive outside, negative inside, in the shape's own frame; solids only.
    fn implicit(shape: &Shape, p: DVec3) -> f64 {
        let across = DVec2::new(p.x, p.y).length();
        match *shape {
            Shape::Sphere { radius } => p.length() - radius,
            Shape::Box { size } => (p.abs() - 0.5 * size).max_element(),
            Shape::Cylinder { radius, height } => (across - radius).max(p.z.abs() - 0.5 * height),
            Shape::Cone { radius, height } => {
                (across - radius * (0.5 * height - p.z) / height).max(p.z.abs() - 0.5 * height)
            }
            _ => f64::NAN,
        }
    }

    fn solids() -> [Shape; 4] {
        [
            Shape::Sphere { radius: 0.7 },
            Shape::Box { size: DVec3::new(1.0, 1.6, 0.8) },
            Shape::Cylinder { radius: 0.5, height: 1.4 },
            Shape::Cone { radius: 0.8, height: 1.3 },
        ]
    }

    fn flats() -> [Shape; 3] {
        [Shape::Plane {}, Shape::Square { size: DVec2::new(2.0, 1.0) }, Shape::Disk { radius: 0.9 }]
    }

    /// First change of sign of the implicit function along the ray, by steps and bisection.
    fn march(shape: &Shape, placed: &Placed, origin: DVec3, direction: DVec3) -> Option<f64> {
        const STEPS: u32 = 20_000;
        const FAR: f64 = 20.0;
        let value = |t: f64| implicit(shape, placed.frame.local_from_world.transform_point3(origin + t * direction));
        let outside = value(0.0) > 0.0;
        let step = FAR / f64::from(STEPS);
        let i = (1..=STEPS).find(|&i| (value(f64::from(i) * step) > 0.0) != outside)?;
        let (mut low, mut high) = (f64::from(i - 1) * step, f64::from(i) * step);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if (value(middle) > 0.0) == outside { low = middle } else { high = middle }
        }
        Some(0.5 * (low + high))
    }

    fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
        [range.clone(), range.clone(), range].prop_map(DVec3::from_array)
    }

    fn scale() -> impl Strategy<Value = DVec3> {
        vector(0.4..2.0).prop_flat_map(|s| {
            [any::<bool>(), any::<bool>(), any::<bool>()]
                .prop_map(move |flip| s * DVec3::from_array(flip.map(|f| if f { -1.0 } else { 1.0 })))
        })
    }

    proptest! {
        #[test]
        fn a_hit_on_a_solid_agrees_with_marching_lies_on_it_and_faces_outward(
            solid in 0usize..4, position in vector(-1.0..1.0), rotation in vector(-180.0..180.0), scale in scale(),
            origin in vector(-3.0..3.0), aim in vector(-0.6..0.6),
        ) {
            let shape = solids()[solid].clone();
            let placed = only(&surface(shape.clone(), position, rotation, scale));
            let direction = (position + aim - origin).normalize();
            let (hit, marched) = (placed.intersect(origin, direction), march(&shape, &placed, origin, direction));
            match (hit, marched) {
                (Some(hit), Some(t)) => {
                    prop_assert!((hit.t - t).abs() < 1e-9, "{} against {t}", hit.t);
                    prop_assert!((origin + hit.t * direction - hit.p).length() < 1e-12, "{hit:?}");
                    prop_assert!((hit.n.length() - 1.0).abs() < 1e-14, "{hit:?}");
                    let local = placed.frame.local_from_world.transform_point3(hit.p);
                    prop_assert!(implicit(&shape, local).abs() < 1e-13, "{hit:?}");
                    let entering = implicit(&shape, placed.frame.local_from_world.transform_point3(origin)) > 0.0;
                    prop_assert!((hit.n.dot(direction) < 0.0) == entering, "{hit:?}");
                }
                (None, None) => {}
                // A chord shorter than a step is jumped over by marching.
                (Some(hit), None) => {
                    let after = placed.intersect(hit.p, direction).map_or(0.0, |exit| exit.t);
                    prop_assert!(after < 2e-3, "missed a chord of {after}");
                }
                (None, Some(t)) => prop_assert!(false, "marching found {t}"),
            }
        }

        #[test]
        fn a_hit_on_a_flat_shape_lies_within_it(
            flat in 0usize..3, position in vector(-1.0..1.0), rotation in vector(-180.0..180.0), scale in scale(),
            origin in vector(-3.0..3.0), aim in vector(-1.5..1.5),
        ) {
            let shape = flats()[flat].clone();
            let placed = only(&surface(shape.clone(), position, rotation, scale));
            let (through, normal) = (position, placed.frame.world_from_normal * DVec3::Z);
            let direction = (position + aim - origin).normalize();
            let t = (through - origin).dot(normal) / direction.dot(normal);
            let local = placed.frame.local_from_world.transform_point3(origin + t * direction);
            let within = match shape {
                Shape::Square { size } => local.x.abs() < 0.5 * size.x && local.y.abs() < 0.5 * size.y,
                Shape::Disk { radius } => local.x.hypot(local.y) < radius,
                _ => true,
            };
            let hit = placed.intersect(origin, direction);
            prop_assert_eq!(hit.is_some(), t > 0.0 && within, "{:?} at {}", local, t);
            if let Some(hit) = hit {
                prop_assert!((hit.t - t).abs() < 1e-9 * t.max(1.0), "{} against {t}", hit.t);
                prop_assert!(hit.n.cross(normal.normalize()).length() < 1e-12, "{hit:?}");
            }
        }

        #[test]
        fn leaving_a_surface_does_not_hit_where_it_starts(
            solid in 0usize..4, rotation in vector(-180.0..180.0), scale in scale(),
            origin in vector(-3.0..3.0), aim in vector(-0.4..0.4), along in vector(-1.0..1.0),
        ) {
            let placed = only(&surface(solids()[solid].clone(), DVec3::ONE, rotation, scale));
            let direction = (DVec3::ONE + aim - origin).normalize();
            if let Some(hit) = placed.intersect(origin, direction) {
                let outward = if hit.n.dot(direction) < 0.0 { hit.n } else { -hit.n };
                let tangent = along.reject_from_normalized(hit.n);
                let again = placed.intersect(hit.p, outward + 1e-3 * tangent);
                let outside = hit.n.dot(direction) < 0.0;
                prop_assert!(!outside || again.is_none(), "{again:?} from {hit:?}");
                let grazing = placed.intersect(hit.p, tangent);
                prop_assert!(!outside || grazing.is_none_or(|g| g.t > 1e-10), "{grazing:?} from {hit:?}");
            }
        }

        #[test]
        fn bounds_hold_every_hit(
            solid in 0usize..4, rotation in vector(-180.0..180.0), scale in scale(),
            origin in vector(-3.0..3.0), aim in vector(-0.6..0.6),
        ) {
            let placed = only(&surface(solids()[solid].clone(), DVec3::ZERO, rotation, scale));
            let bounds = placed.bounds().unwrap();
            if let Some(hit) = placed.intersect(origin, aim - origin) {
                let slack = DVec3::splat(1e-12);
                prop_assert!(hit.p.cmpge(bounds.min - slack).all() && hit.p.cmple(bounds.max + slack).all(), "{hit:?}");
            }
        }
    }

    #[test]
    fn known_hits() {
        let down = |x: f64, y: f64| (DVec3::new(x, y, 5.0), DVec3::NEG_Z);
        let cases = [
            (Shape::Plane {}, down(3.0, 4.0), 5.0, DVec3::Z),
            (Shape::Sphere { radius: 1.0 }, down(0.0, 0.0), 4.0, DVec3::Z),
            (Shape::Box { size: DVec3::splat(2.0) }, down(0.5, 0.5), 4.0, DVec3::Z),
            (Shape::Square { size: DVec2::splat(2.0) }, down(0.9, 0.9), 5.0, DVec3::Z),
            (Shape::Disk { radius: 1.0 }, down(0.6, 0.6), 5.0, DVec3::Z),
            (Shape::Cylinder { radius: 1.0, height: 2.0 }, down(0.6, 0.6), 4.0, DVec3::Z),
            (Shape::Cone { radius: 1.0, height: 2.0 }, down(0.5, 0.0), 5.0, DVec3::new(2.0, 0.0, 1.0).normalize()),
            (Shape::Cone { radius: 1.0, height: 2.0 }, down(0.0, 0.0), 4.0, DVec3::Z),
        ];
        for (shape, (origin, direction), t, n) in cases {
            let hit = plain(shape.clone()).intersect(origin, direction).unwrap();
            assert!((hit.t - t).abs() < 1e-14 && (hit.n - n).length() < 1e-14, "{shape:?}: {hit:?}");
        }
    }

    #[test]
    fn from_inside_the_far_wall_is_hit() {
        for shape in solids() {
            let hit = plain(shape.clone()).intersect(DVec3::ZERO, DVec3::NEG_Z).unwrap();
            assert!(hit.n == DVec3::NEG_Z && hit.t > 0.0, "{shape:?}: {hit:?}");
        }
    }

    #[test]
    fn the_infinite_plane_is_not_hit_along_itself_or_from_itself() {
        let plane = plain(Shape::Plane {});
        for (origin, direction) in [
            (DVec3::new(1.0, 2.0, 0.0), DVec3::X),
            (DVec3::new(1.0, 2.0, 0.0), DVec3::Z),
            (DVec3::new(1.0, 2.0, 1e-16), DVec3::new(1.0, 0.0, -1e-17)),
            (DVec3::new(1.0, 2.0, 1.0), DVec3::X),
        ] {
            assert_eq!(plane.intersect(origin, direction), None, "{origin} along {direction}");
        }
    }

    #[test]
    fn a_flattened_surface_is_never_hit() {
        for shape in solids().into_iter().chain(flats()) {
            let flat = only(&surface(shape.clone(), DVec3::ZERO, DVec3::ZERO, DVec3::new(1.0, 0.0, 1.0)));
            assert_eq!(flat.intersect(DVec3::new(0.1, 0.0, 5.0), DVec3::NEG_Z), None, "{shape:?}");
        }
    }
}
