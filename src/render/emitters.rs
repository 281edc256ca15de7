//! Lights as things that are seen.
//!
//! Polygons, disks and spheres are surfaces of their own luminance. A one-sided polygon or disk is seen from its lit
//! side only, and a sphere from outside: from behind and within, where they do not emit, they hide nothing; nor do
//! black texels. Caps and skies are seen behind everything else, and add up. Lines, points and directional lights have
//! no area, so that pictures of radiance do not show them.

use glam::{DVec2, DVec3};

use std::sync::Arc;

use crate::light::pattern::Image;
use crate::light::{DiskEmitter, Emitter, Light, PolygonEmitter, Shape, SphereEmitter, TexturedEmitter};

/// An emitter with an area, prepared for rays.
#[derive(Clone, Debug, PartialEq)]
pub enum PlacedEmitter {
    /// A polygon in its own plane.
    Polygon {
        /// A point of the plane.
        origin: DVec3,
        /// Unit axes of the plane, and the lit side's normal.
        axes: [DVec3; 3],
        /// Corners in the plane.
        vertices: Vec<DVec2>,
        /// Seen from both sides.
        two_sided: bool,
    },
    /// A sphere.
    Sphere(SphereEmitter),
    /// A rectangle with a pattern; a black texel hides nothing.
    Textured(TexturedEmitter, Image),
    /// A disk.
    Disk(DiskEmitter),
}

impl PlacedEmitter {
    /// A light for rays; none where its shape has no area.
    pub fn of_light(light: &Light) -> Option<Self> {
        match (&light.shape, light.emitter()) {
            (Shape::Textured(textured), Emitter::Textured(emitter)) => {
                Some(Self::Textured(emitter, textured.pattern.image.clone()))
            }
            (_, emitter) => Self::new(&emitter),
        }
    }

    /// The luminance of a point of it, as a share of the light's.
    pub fn luminance(&self, p: DVec3) -> DVec3 {
        match self {
            Self::Polygon { .. } | Self::Sphere(_) | Self::Disk(_) => DVec3::ONE,
            Self::Textured(light, image) => luminance(light, image, p),
        }
    }

    /// The emitter for rays; none where its shape has no area.
    pub fn new(emitter: &Emitter) -> Option<Self> {
        match emitter {
            Emitter::Polygon(polygon) => Self::polygon(polygon),
            Emitter::Sphere(sphere) => Some(Self::Sphere(*sphere)),
            Emitter::Disk(disk) => Some(Self::Disk(*disk)),
            Emitter::Textured(light) => Some(Self::Textured(light.clone(), Image::Grey(Arc::clone(&light.pattern)))),
            Emitter::Line(_) | Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Point(_) | Emitter::Directional(_) => None,
        }
    }

    fn polygon(polygon: &PolygonEmitter) -> Option<Self> {
        let origin = *polygon.vertices.first()?;
        let (x, y) = polygon.normal.any_orthonormal_pair();
        let vertices = polygon.vertices.iter().map(|v| DVec2::new((v - origin).dot(x), (v - origin).dot(y))).collect();
        Some(Self::Polygon { origin, axes: [x, y, polygon.normal], vertices, two_sided: polygon.two_sided })
    }
}

/// Distance to an emitter's lit side, in lengths of the direction.
pub fn intersect_emitter(emitter: &PlacedEmitter, origin: DVec3, direction: DVec3) -> Option<f64> {
    match emitter {
        PlacedEmitter::Polygon { origin: corner, axes: [x, y, normal], vertices, two_sided } => {
            let from_corner = origin - corner;
            let towards = direction.dot(*normal);
            if towards >= 0.0 && !two_sided {
                return None;
            }
            let t = -from_corner.dot(*normal) / towards;
            let p = from_corner + t * direction;
            (t > 0.0 && t.is_finite() && contains(vertices, DVec2::new(p.dot(*x), p.dot(*y)))).then_some(t)
        }
        PlacedEmitter::Sphere(sphere) => intersect_sphere(sphere, origin, direction),
        PlacedEmitter::Textured(light, image) => {
            let towards = direction.dot(light.normal);
            if towards >= 0.0 && !light.two_sided {
                return None;
            }
            let t = (light.corner - origin).dot(light.normal) / towards;
            let p = origin + t * direction;
            (t > 0.0 && t.is_finite() && luminance(light, image, p) != DVec3::ZERO).then_some(t)
        }
        PlacedEmitter::Disk(disk) => intersect_disk(disk, origin, direction),
    }
}

/// Distance to a disk's lit side.
fn intersect_disk(disk: &DiskEmitter, origin: DVec3, direction: DVec3) -> Option<f64> {
    let towards = direction.dot(disk.normal);
    if towards >= 0.0 && !disk.two_sided {
        return None;
    }
    let from_center = origin - disk.center;
    let t = -from_center.dot(disk.normal) / towards;
    (t > 0.0 && t.is_finite() && (from_center + t * direction).length() < disk.radius).then_some(t)
}

/// Luminance of an emitter infinitely far away in a direction of any length, at unit strength; 0 of all others.
pub(super) fn distant_luminance(emitter: &Emitter, direction: DVec3) -> f64 {
    let direction = direction.normalize_or_zero();
    match emitter {
        Emitter::Cap(cap) => {
            let within = cap.to_center.cross(direction).length() <= cap.half_angle.sin();
            if within && cap.to_center.dot(direction) > 0.0 { 1.0 } else { 0.0 }
        }
        Emitter::Sky(sky) => sky.radiance(direction),
        _ => 0.0,
    }
}

/// The luminance of a textured light's texel at a point of its plane; black beside it.
fn luminance(light: &TexturedEmitter, image: &Image, p: DVec3) -> DVec3 {
    let from_corner = p - light.corner;
    let share = |side: DVec3| from_corner.dot(side) / side.length_squared();
    let (u, v) = (share(light.row), share(light.column));
    if !((0.0..1.0).contains(&u) && (0.0..1.0).contains(&v)) {
        return DVec3::ZERO;
    }
    image.value(u, v)
}

/// Distance to a sphere from outside.
fn intersect_sphere(sphere: &SphereEmitter, origin: DVec3, direction: DVec3) -> Option<f64> {
    let from_center = origin - sphere.center;
    let squared = direction.length_squared();
    let middle = -from_center.dot(direction) / squared;
    let nearest = (from_center + middle * direction).length();
    let half_chord_squared = (sphere.radius - nearest) * (sphere.radius + nearest) / squared;
    let t = middle - half_chord_squared.sqrt();
    (t > 0.0).then_some(t)
}

/// Whether a point lies in a simple polygon: an odd number of edges to its right, each edge with its lower end.
fn contains(vertices: &[DVec2], p: DVec2) -> bool {
    let Some(mut a) = vertices.last().copied() else { return false };
    let mut inside = false;
    for &b in vertices {
        if (a.y > p.y) != (b.y > p.y) && ((b - a).perp_dot(p - a) > 0.0) == (b.y > a.y) {
            inside = !inside;
        }
        a = b;
    }
    inside
}

#[cfg(test)]
mod tests {
    use super::*;

    fn emitter(two_sided: bool) -> PlacedEmitter {
        // An L, lit downwards, at z = 2.
        let corners = [[0.0, 0.0], [0.0, 2.0], [1.0, 2.0], [1.0, 1.0], [2.0, 1.0], [2.0, 0.0]];
        let vertices = corners.map(|[x, y]| DVec3::new(x, y, 2.0)).to_vec();
        PlacedEmitter::new(&Emitter::Polygon(PolygonEmitter { vertices, normal: DVec3::NEG_Z, two_sided })).unwrap()
    }

    #[test]
    fn a_polygon_is_seen_inside_its_outline_only() {
        for (x, y, seen) in
            [(0.5, 0.5, true), (1.5, 0.5, true), (0.5, 1.5, true), (1.5, 1.5, false), (-0.1, 0.5, false)]
        {
            let t = intersect_emitter(&emitter(false), DVec3::new(x, y, 0.0), DVec3::Z);
            assert_eq!(t, seen.then_some(2.0), "at {x}, {y}");
        }
    }

    #[test]
    fn the_unlit_side_hides_nothing_unless_two_sided() {
        let above = DVec3::new(0.5, 0.5, 5.0);
        assert_eq!(intersect_emitter(&emitter(false), above, DVec3::NEG_Z), None, "unlit side");
        assert_eq!(intersect_emitter(&emitter(true), above, DVec3::NEG_Z), Some(3.0), "two-sided");
    }

    #[test]
    fn a_polygon_behind_or_edge_on_is_not_seen() {
        assert_eq!(intersect_emitter(&emitter(true), DVec3::new(0.5, 0.5, 3.0), DVec3::Z), None, "behind");
        assert_eq!(intersect_emitter(&emitter(true), DVec3::new(-1.0, 0.5, 2.0), DVec3::X), None, "edge on");
    }

    #[test]
    fn a_sphere_is_seen_from_outside_only() {
        let sphere = PlacedEmitter::Sphere(SphereEmitter { center: DVec3::new(0.0, 0.0, 3.0), radius: 1.0 });
        for (origin, direction, t) in [
            (DVec3::ZERO, DVec3::Z, Some(2.0)),
            (DVec3::ZERO, 2.0 * DVec3::Z, Some(1.0)),
            (DVec3::new(0.0, 0.0, 3.0), DVec3::Z, None),
            (DVec3::ZERO, DVec3::NEG_Z, None),
            (DVec3::new(1.1, 0.0, 0.0), DVec3::Z, None),
        ] {
            assert_eq!(intersect_emitter(&sphere, origin, direction), t, "from {origin} along {direction}");
        }
    }
}
