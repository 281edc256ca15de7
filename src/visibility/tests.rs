//! Every structure against testing all objects.

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::{Objects, Structure};
use crate::surface::{Shape, Surface};

const STRUCTURES: [Structure; 6] = [
    Structure::Hierarchy,
    Structure::Grid(1),
    Structure::Grid(4),
    Structure::Grid(15),
    Structure::LightBuffer(1),
    Structure::LightBuffer(36),
];

/// Points of a light that rays are sent to.
const RAYS: u32 = 24;

fn vector(range: std::ops::Range<f64>) -> impl Strategy<Value = DVec3> {
    [range.clone(), range.clone(), range].prop_map(DVec3::from_array)
}

fn shape() -> impl Strategy<Value = Shape> {
    (0usize..7, vector(0.05..0.8)).prop_map(|(shape, size)| match shape {
        0 => Shape::Plane {},
        1 => Shape::Sphere { radius: size.x },
        2 => Shape::Box { size },
        3 => Shape::Square { size: DVec2::new(size.x, size.y) },
        4 => Shape::Disk { radius: size.x },
        5 => Shape::Cylinder { radius: size.x, height: size.z },
        _ => Shape::Cone { radius: size.x, height: size.z },
    })
}

fn surface() -> impl Strategy<Value = Surface> {
    (shape(), vector(-2.0..2.0), vector(-180.0..180.0), vector(0.2..2.0)).prop_map(
        |(shape, position, rotation_deg, scale)| Surface {
            name: "s".to_owned(),
            material: "m".to_owned(),
            position,
            rotation_deg,
            scale,
            shape,
        },
    )
}

/// Scenes of anything, and of many small spheres along a row, with some in the same place.
fn scene() -> impl Strategy<Value = Vec<Surface>> {
    let row = (1usize..60, surface()).prop_map(|(count, surface)| {
        let position = |i: usize| surface.position + DVec3::new(0.1, 0.01, 0.0) * (i / 2) as f64;
        let shape = Shape::Sphere { radius: 0.06 };
        (0..count).map(|i| Surface { position: position(i), shape: shape.clone(), ..surface.clone() }).collect()
    });
    prop_oneof![prop::collection::vec(surface(), 0..24), row]
}

/// The objects between p and any of these points.
fn between(objects: &Objects, p: DVec3, points: impl Iterator<Item = DVec3> + Clone) -> Vec<usize> {
    let blocks =
        |i: &usize| points.clone().any(|q| objects.parts()[*i].intersect(p, q - p).is_some_and(|hit| hit.t < 1.0));
    (0..objects.parts().len()).filter(blocks).collect()
}

fn ascending_and_with(found: &[usize], needed: &[usize]) -> bool {
    found.is_sorted_by(|a, b| a < b) && needed.iter().all(|object| found.contains(object))
}

fn shares() -> impl Iterator<Item = f64> + Clone {
    (0..=RAYS).map(|i| f64::from(i) / f64::from(RAYS))
}

proptest! {
    #[test]
    fn a_ray_meets_the_same_however_it_is_found(
        scene in scene(), p in vector(-3.0..3.0), q in vector(-3.0..3.0), along_axis in prop::option::of(0usize..3),
    ) {
        let every = Objects::new(&scene, Structure::Every);
        let to_light = along_axis.map_or(q - p, |axis| DVec3::AXES[axis] * (q - p)[axis]);
        for structure in STRUCTURES {
            let objects = Objects::new(&scene, structure);
            prop_assert_eq!(objects.nearest(p, to_light), every.nearest(p, to_light), "{}", structure);
            prop_assert_eq!(objects.hides(p, to_light), every.hides(p, to_light), "{}", structure);
            prop_assert_eq!(objects.hides_direction(p, to_light), every.hides_direction(p, to_light), "{}", structure);
            // From a surface too.
            if let Some((_, hit)) = every.nearest(p, to_light) {
                prop_assert_eq!(objects.nearest(hit.p, q), every.nearest(hit.p, q), "{} from a surface", structure);
                prop_assert_eq!(objects.hides(hit.p, q), every.hides(hit.p, q), "{} from a surface", structure);
            }
        }
    }

    #[test]
    fn no_object_in_a_light_triangle_is_missed(
        scene in scene(), p in vector(-3.0..3.0), a in vector(-3.0..3.0), b in vector(-3.0..3.0),
    ) {
        let mut found = vec![99];
        for structure in STRUCTURES {
            let half = p.lerp(a, 0.5);
            let objects = Objects::new(&scene, structure).for_lines([[a, b], [a, half]].into_iter());
            let needed = between(&objects, p, shares().map(|s| a.lerp(b, s)));
            objects.in_triangle(p, a, b, &mut found);
            prop_assert!(ascending_and_with(&found, &needed), "{structure}: {found:?} of {needed:?}");
            // A part of it.
            let [from, to] = [a.lerp(b, 0.3), a.lerp(b, 0.4)];
            let needed = between(&objects, p, shares().map(|s| from.lerp(to, s)));
            objects.in_triangle(p, from, to, &mut found);
            prop_assert!(ascending_and_with(&found, &needed), "{structure}, a part: {found:?} of {needed:?}");
            // Seen end on.
            let needed = between(&objects, p, std::iter::once(a));
            objects.in_triangle(p, a, half, &mut found);
            prop_assert!(ascending_and_with(&found, &needed), "{structure}, end on: {found:?} of {needed:?}");
        }
    }

    #[test]
    fn no_object_in_a_light_pyramid_is_missed(
        scene in scene(), p in vector(-3.0..3.0), corner in vector(-3.0..3.0), u in vector(-2.0..2.0), v in vector(-2.0..2.0),
        bend in 0.05f64..0.9,
    ) {
        // A dart: not convex where its last corner lies within the others.
        let polygon = [corner, corner + u, corner + bend * (u + v), corner + v];
        let middle = polygon[2].lerp(corner, 0.5);
        let points = shares().flat_map(|s| polygon.map(|q| middle.lerp(q, s)));
        let mut found = Vec::new();
        for structure in STRUCTURES {
            let objects = Objects::new(&scene, structure);
            let needed = between(&objects, p, points.clone());
            objects.in_pyramid(p, &polygon, &mut found);
            prop_assert!(ascending_and_with(&found, &needed), "{structure}: {found:?} of {needed:?}");
        }
    }
}
