//! Lines behind each primitive: known values, and rays.

use glam::{DVec2, DVec3};
use proptest::prelude::*;

use super::*;
use crate::surface::{Shape, Surface};
use crate::visibility::Structure;

fn surface(shape: Shape, position: DVec3, rotation_deg: DVec3, scale: DVec3) -> Surface {
    Surface { name: "s".to_owned(), material: "m".to_owned(), position, rotation_deg, scale, shape }
}

fn at(shape: Shape, position: [f64; 3], rotation_deg: [f64; 3]) -> Surface {
    surface(shape, position.into(), rotation_deg.into(), DVec3::ONE)
}

/// What is seen of a light without any horizon: what lies on either side of a plane through p.
fn seen_all_round(objects: &Objects, p: DVec3, light: [DVec3; 2]) -> Vec<[f64; 2]> {
    let across = (light[0] - p).cross(light[1] - p);
    let upright = (light[0] - p).normalize_or_zero() + (light[1] - p).normalize_or_zero();
    let n = if upright.length() > 1e-3 { upright } else { across };
    visible_segments(objects, p, n, light).map_or(vec![[0.0, 1.0]], |segments| segments.parts().to_vec())
}

#[track_caller]
fn check(surface: Surface, p: [f64; 3], light: [[f64; 3]; 2], expected: &[[f64; 2]]) {
    let objects = Objects::new(std::slice::from_ref(&surface), Structure::Every);
    let seen = seen_all_round(&objects, p.into(), light.map(DVec3::from));
    let close = seen.len() == expected.len()
        && seen.iter().flatten().zip(expected.iter().flatten()).all(|(t, expected)| (t - expected).abs() < 3e-9);
    assert!(close, "{surface:?}\nis seen {seen:?}\ninstead of {expected:?}");
}

/// Two metres wide, two metres over the origin.
const ABOVE: [[f64; 3]; 2] = [[-1.0, 0.0, 2.0], [1.0, 0.0, 2.0]];
const ORIGIN: [f64; 3] = [0.0; 3];
const MIDWAY: [f64; 3] = [0.0, 0.0, 1.0];

/// All but the middle, of that half width.
fn but(half: f64) -> [[f64; 2]; 2] {
    [[0.0, 0.5 - half], [0.5 + half, 1.0]]
}

#[test]
fn flat_shapes_hide_what_they_project_to() {
    check(at(Shape::Plane {}, MIDWAY, ORIGIN), ORIGIN, ABOVE, &[]);
    check(at(Shape::Plane {}, MIDWAY, [0.0, 90.0, 0.0]), ORIGIN, ABOVE, &[[0.0, 1.0]]);
    check(at(Shape::Plane {}, [0.25, 0.0, 0.0], [0.0, 90.0, 0.0]), ORIGIN, ABOVE, &[[0.0, 0.625]]);
    check(at(Shape::Plane {}, ORIGIN, ORIGIN), ORIGIN, ABOVE, &[[0.0, 1.0]]);
    let square = Shape::Square { size: DVec2::new(0.5, 0.2) };
    check(at(square.clone(), MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(0.25));
    check(at(square.clone(), MIDWAY, [0.0, 0.0, 90.0]), ORIGIN, ABOVE, &but(0.1));
    check(at(square, [0.0, 0.2, 1.0], ORIGIN), ORIGIN, ABOVE, &[[0.0, 1.0]]);
    check(at(Shape::Disk { radius: 0.25 }, MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(0.25));
    check(at(Shape::Disk { radius: 0.25 }, [0.0, 0.15, 1.0], ORIGIN), ORIGIN, ABOVE, &but(0.2));
}

#[test]
fn solids_hide_what_lies_between_their_tangents() {
    let tangent = 0.3 / (1.0_f64 - 0.09).sqrt();
    check(at(Shape::Sphere { radius: 0.3 }, MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(tangent));
    let tube = Shape::Cylinder { radius: 0.3, height: 0.5 };
    check(at(tube.clone(), MIDWAY, [90.0, 0.0, 0.0]), ORIGIN, ABOVE, &but(tangent));
    check(at(tube, MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(0.3 / 0.75));
    let block = Shape::Box { size: DVec3::splat(0.5) };
    check(at(block.clone(), MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(0.25 / 0.75));
    let corner = 0.5_f64.sqrt();
    check(at(block, MIDWAY, [0.0, 45.0, 0.0]), ORIGIN, ABOVE, &but(0.5 * corner));
    let cone = Shape::Cone { radius: 0.1, height: 1.0 };
    check(at(cone.clone(), MIDWAY, ORIGIN), ORIGIN, ABOVE, &but(0.1 / 0.5));
    check(at(cone, MIDWAY, [180.0, 0.0, 0.0]), ORIGIN, ABOVE, &but(0.1 / 1.5));
    // Lying, from the rim of its base to its apex.
    let lying = at(Shape::Cone { radius: 0.1, height: 0.5 }, MIDWAY, [0.0, 90.0, 0.0]);
    check(lying, ORIGIN, ABOVE, &[[0.0, 0.5 - 0.25 / 0.9], [0.75, 1.0]]);
}

#[test]
fn a_room_hides_what_is_outside() {
    let wide = [[-2.0, 0.0, 0.5], [2.0, 0.0, 0.5]];
    let half = 0.75_f64.sqrt() / 4.0;
    check(at(Shape::Sphere { radius: 1.0 }, ORIGIN, ORIGIN), ORIGIN, wide, &[[0.5 - half, 0.5 + half]]);
    check(at(Shape::Box { size: DVec3::splat(2.0) }, ORIGIN, ORIGIN), ORIGIN, wide, &[[0.25, 0.75]]);
    check(at(Shape::Cylinder { radius: 1.0, height: 2.0 }, ORIGIN, ORIGIN), ORIGIN, wide, &[[0.25, 0.75]]);
    check(at(Shape::Cone { radius: 1.0, height: 2.0 }, ORIGIN, ORIGIN), ORIGIN, wide, &[[0.4375, 0.5625]]);
    check(at(Shape::Box { size: DVec3::splat(2.0) }, ORIGIN, ORIGIN), ORIGIN, ABOVE, &[]);
}

#[test]
fn from_the_surface_of_a_solid_only_what_is_below_is_hidden() {
    let block = || at(Shape::Box { size: DVec3::splat(2.0) }, ORIGIN, ORIGIN);
    let down_the_side = [[2.0, 0.0, 2.0], [2.0, 0.0, -2.0]];
    check(block(), [0.0, 0.0, 1.0], down_the_side, &[[0.0, 0.25]]);
    // From the floor of the room, through its wall.
    check(block(), [0.0, 0.0, -1.0], [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]], &[[0.0, 0.5]]);
    let ball = || at(Shape::Sphere { radius: 1.0 }, ORIGIN, ORIGIN);
    check(ball(), [0.0, 0.0, 1.0], down_the_side, &[[0.0, 0.25]]);
    check(at(Shape::Cylinder { radius: 1.0, height: 2.0 }, ORIGIN, ORIGIN), [1.0, 0.0, 0.0], ABOVE, &[]);
    check(ball(), [0.0, 0.0, 1.0], ABOVE, &[[0.0, 1.0]]);
}

#[test]
fn lights_that_touch_a_surface_are_seen_on_its_side() {
    let block = || at(Shape::Box { size: DVec3::splat(2.0) }, ORIGIN, ORIGIN);
    let on_top = [[-0.5, 0.0, 1.0], [0.5, 0.0, 1.0]];
    check(block(), [0.0, 3.0, 2.0], on_top, &[[0.0, 1.0]]);
    check(block(), ORIGIN, on_top, &[[0.0, 1.0]]);
    check(block(), [0.0, 3.0, 0.0], on_top, &[]);
    let through = [[0.0, 0.0, 0.5], [0.0, 0.0, 1.5]];
    check(block(), [0.0, 0.0, 3.0], [[0.2, 0.0, 0.5], [0.2, 0.0, 1.5]], &[[0.5, 1.0]]);
    check(block(), [0.0, 3.0, 3.0], through, &[[0.5, 1.0]]);
}

#[test]
fn on_its_own_line_a_point_sees_a_light_as_far_as_the_first_surface() {
    let ahead = [[0.0, 0.0, 1.0], [0.0, 0.0, 3.0]];
    for shape in [Shape::Plane {}, Shape::Square { size: DVec2::ONE }, Shape::Disk { radius: 1.0 }] {
        check(at(shape.clone(), [0.0, 0.0, 2.0], ORIGIN), ORIGIN, ahead, &[[0.0, 0.5]]);
        check(at(shape, [0.0, 0.0, 0.5], ORIGIN), ORIGIN, ahead, &[]);
    }
    for shape in [
        Shape::Sphere { radius: 0.5 },
        Shape::Box { size: DVec3::ONE },
        Shape::Cylinder { radius: 0.5, height: 1.0 },
        Shape::Cone { radius: 0.5, height: 1.0 },
    ] {
        check(at(shape.clone(), [0.0, 0.0, 2.5], ORIGIN), ORIGIN, ahead, &[[0.0, 0.5]]);
        check(at(shape.clone(), [0.0, 0.0, 0.6], ORIGIN), [0.0, 0.0, 0.05], ahead, &[]);
        check(at(shape.clone(), [0.0, 0.0, 0.0], ORIGIN), ORIGIN, ahead, &[]);
        check(at(shape, [5.0, 0.0, 2.0], ORIGIN), ORIGIN, ahead, &[[0.0, 1.0]]);
    }
}

fn shapes() -> impl Strategy<Value = Shape> {
    let size = || 0.2..1.5_f64;
    prop_oneof![
        Just(Shape::Plane {}),
        size().prop_map(|radius| Shape::Sphere { radius }),
        [size(), size(), size()].prop_map(|size| Shape::Box { size: size.into() }),
        [size(), size()].prop_map(|size| Shape::Square { size: size.into() }),
        size().prop_map(|radius| Shape::Disk { radius }),
        [size(), size()].prop_map(|[radius, height]| Shape::Cylinder { radius, height }),
        [size(), size()].prop_map(|[radius, height]| Shape::Cone { radius, height }),
    ]
}

fn vector(extent: f64) -> impl Strategy<Value = DVec3> {
    [-extent..extent, -extent..extent, -extent..extent].prop_map(DVec3::from_array)
}

fn scale() -> impl Strategy<Value = DVec3> {
    [0.3..2.0_f64, 0.3..2.0, -2.0..-0.3].prop_map(DVec3::from_array)
}

fn surfaces(count: std::ops::Range<usize>) -> impl Strategy<Value = Vec<Surface>> {
    let any = (shapes(), vector(1.5), vector(180.0), scale());
    proptest::collection::vec(any.prop_map(|(shape, p, turn, scale)| surface(shape, p, turn, scale)), count)
}

/// A place: free, or where a ray from there first meets a surface.
fn place(objects: &Objects, from: DVec3, direction: DVec3, on_surface: bool) -> DVec3 {
    let hit = if on_surface { objects.nearest(from, direction) } else { None };
    hit.map_or(from, |(_, hit)| hit.p)
}

/// Whether all t of a light are seen that rays say are seen, but at the ends of what is seen.
fn agrees(objects: &Objects, p: DVec3, light: [DVec3; 2], margin: f64) -> Result<(), TestCaseError> {
    const RAYS: u32 = 50;
    let seen = seen_all_round(objects, p, light);
    let ends: Vec<f64> = seen.iter().flatten().copied().collect();
    prop_assert!(ends.is_sorted_by(|a, b| a < b), "{ends:?}");
    prop_assert!(ends.iter().all(|t| (0.0..=1.0).contains(t)), "{ends:?}");
    for i in 0..RAYS {
        let t = (f64::from(i) + 0.5) / f64::from(RAYS);
        let by_ray = !objects.hides(p, light[0].lerp(light[1], t) - p);
        let exact = seen.iter().any(|&[from, to]| from <= t && t <= to);
        let at_an_end = ends.iter().any(|end| (end - t).abs() < margin);
        prop_assert!(by_ray == exact || at_an_end, "at {t} rays say {by_ray}, in {seen:?}");
    }
    Ok(())
}

proptest! {
    #[test]
    fn what_is_seen_is_what_rays_see(
        surfaces in surfaces(1..6), p in vector(2.5), a in vector(3.0), b in vector(3.0),
    ) {
        let objects = Objects::new(&surfaces, Structure::Every);
        agrees(&objects, p, [a, b], 1e-7)?;
    }

    #[test]
    fn on_surfaces_and_of_lights_that_touch_them_too(
        surfaces in surfaces(1..6), p in vector(2.5), a in vector(3.0), b in vector(3.0),
        to_p in vector(1.0), to_a in vector(1.0), on in any::<[bool; 2]>(),
    ) {
        let objects = Objects::new(&surfaces, Structure::Every);
        let p = place(&objects, p, to_p, on[0]);
        let a = place(&objects, a, to_a, on[1]);
        agrees(&objects, p, [a, b], 1e-6)?;
    }

    #[test]
    fn the_structure_changes_nothing(
        surfaces in surfaces(5..12), p in vector(2.5), a in vector(3.0), b in vector(3.0), n in vector(1.0),
    ) {
        let seen = |structure| {
            let objects = Objects::new(&surfaces, structure).for_lines([[a, b]].into_iter());
            visible_segments(&objects, p, n, [a, b])
        };
        let every = seen(Structure::Every);
        for structure in [Structure::Hierarchy, Structure::Grid(8), Structure::LightBuffer(16)] {
            prop_assert_eq!(&every, &seen(structure), "by {}", structure);
        }
    }

    #[test]
    fn whatever_the_sizes_parts_are_ascending_and_within_the_light(
        surfaces in surfaces(1..6), p in vector(2.0), a in vector(2.0), b in vector(2.0), n in vector(1.0),
        powers in [-150.0..150.0_f64, -150.0..150.0, -150.0..150.0], same in 0..4,
    ) {
        let surfaces: Vec<Surface> = surfaces.into_iter().map(|surface| {
            let size = 10_f64.powf(powers[0]);
            Surface { position: surface.position * size, scale: surface.scale * size, ..surface }
        }).collect();
        let [p, a, b] = [p * 10_f64.powf(powers[1]), a * 10_f64.powf(powers[2]), b * 10_f64.powf(powers[2])];
        let [p, a, b] = match same { 0 => [a, a, b], 1 => [p, a, a], 2 => [p, p + a, p + 2.0 * a], _ => [p, a, b] };
        for structure in [Structure::Every, Structure::Hierarchy] {
            let seen = visible_segments(&Objects::new(&surfaces, structure), p, n, [a, b]);
            let ends: Vec<f64> = seen.iter().flat_map(|seen| seen.parts()).flatten().copied().collect();
            prop_assert!(ends.is_sorted(), "{ends:?}");
            prop_assert!(ends.iter().all(|t| (0.0..=1.0).contains(t)), "{ends:?}");
        }
    }
}

/// A patch that is bent at random.
fn patches() -> impl Strategy<Value = Shape> {
    proptest::collection::vec(vector(0.5), 16).prop_map(|bends| {
        let point = |i: usize| {
            let (row, column) = ((i / 4) as f64, (i % 4) as f64);
            DVec3::new(column / 1.5 - 1.0, row / 1.5 - 1.0, 0.0) + bends[i]
        };
        Shape::Patch { control_points: Box::new(std::array::from_fn(point)) }
    })
}

proptest! {
    #[test]
    fn what_is_seen_past_patches_is_what_rays_see(
        shapes in proptest::collection::vec(patches(), 1..3), at_patch in vector(0.5), turn in vector(180.0),
        p in vector(2.5), a in vector(3.0), b in vector(3.0), to_p in vector(1.0), to_a in vector(1.0),
        on in any::<[bool; 2]>(),
    ) {
        let surfaces: Vec<Surface> =
            shapes.into_iter().map(|shape| surface(shape, at_patch, turn, DVec3::ONE)).collect();
        let objects = Objects::new(&surfaces, Structure::Every);
        let p = place(&objects, p, to_p, on[0]);
        let a = place(&objects, a, to_a, on[1]);
        agrees(&objects, p, [a, b], 3e-6)?;
    }

    #[test]
    fn meshes_hide_what_rays_do_not_pass(
        depth in 0..3_u32, turn in vector(180.0), scale in scale(), p in vector(2.0), a in vector(2.0), b in vector(2.0),
        to_p in vector(1.0), on in any::<bool>(),
    ) {
        for shape in [Shape::Tetrahedron { depth }, Shape::Sphereflake { depth: depth.min(1) }] {
            let objects = Objects::new(&[surface(shape, DVec3::ZERO, turn, scale)], Structure::Every);
            let p = place(&objects, p, to_p, on);
            agrees(&objects, p, [a, b], 1e-6)?;
        }
    }
}
