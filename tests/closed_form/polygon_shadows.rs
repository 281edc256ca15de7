//! What is seen of polygonal lights, against hand-made values and against rays.

use glam::{DVec2, DVec3};
use softbox::surface::{Shape, Surface};
use softbox::visibility::polygon::{Seen, visible_pieces};
use softbox::visibility::{Objects, Structure};

use crate::random::Random;

fn surface(shape: Shape, position: DVec3, rotation_deg: DVec3, scale: DVec3) -> Surface {
    Surface { name: "s".to_owned(), material: "m".to_owned(), position, rotation_deg, scale, shape }
}

fn at(shape: Shape, position: DVec3) -> Surface {
    surface(shape, position, DVec3::ZERO, DVec3::ONE)
}

fn objects(surfaces: &[Surface]) -> Objects {
    Objects::new(surfaces, Structure::Every)
}

/// A square light with sides of 2 at a height, over the origin.
fn square_light(height: f64) -> Vec<DVec3> {
    [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|xy| DVec2::from(xy).extend(height)).to_vec()
}

fn area(polygon: &[DVec3]) -> f64 {
    let doubled: DVec3 = polygon.windows(2).map(|e| (e[0] - polygon[0]).cross(e[1] - polygon[0])).sum();
    0.5 * doubled.length()
}

/// The share of a light's area that is seen.
fn share(seen: &Seen, light: &[DVec3]) -> f64 {
    let sum = |pieces: &[Vec<DVec3>]| pieces.iter().map(|piece| area(piece)).sum::<f64>() / area(light);
    match seen {
        Seen::All => 1.0,
        Seen::Nothing => 0.0,
        Seen::Pieces(pieces) => sum(pieces),
        Seen::AllBut(pieces) => 1.0 - sum(pieces),
        Seen::Unknown => panic!("nothing is known"),
    }
}

/// Whether a point of the light is in a polygon, which may run to and fro, by the parity of the edges crossed.
fn is_in(polygon: &[DVec3], q: DVec3, [x, y]: [DVec3; 2]) -> bool {
    let flat: Vec<DVec2> = polygon.iter().map(|v| DVec2::new(x.dot(v - q), y.dot(v - q))).collect();
    let next = flat.iter().cycle().skip(1);
    let crossed = flat.iter().zip(next).filter(|(a, b)| {
        (a.y > 0.0) != (b.y > 0.0) && {
            let turn = a.perp_dot(**b);
            (turn > 0.0) == (b.y > a.y)
        }
    });
    crossed.count() % 2 == 1
}

#[track_caller]
fn check(surfaces: &[Surface], p: DVec3, light: &[DVec3], expected: f64) {
    let n = (light[0] + light[2] - 2.0 * p).normalize();
    let seen = visible_pieces(&objects(surfaces), p, n, light);
    let share = share(&seen, light);
    assert!((share - expected).abs() < 1e-13, "{share} is seen, not {expected}: {seen:?}");
    assert_eq!(expected == 0.0, seen == Seen::Nothing, "{seen:?}");
    assert_eq!(expected == 1.0, seen == Seen::All, "{seen:?}");
}

fn square(side: f64) -> Shape {
    Shape::Square { size: DVec2::splat(side) }
}

fn cube(side: f64) -> Shape {
    Shape::Box { size: DVec3::splat(side) }
}

#[test]
fn squares_half_way_cast_twice_their_size() {
    let light = square_light(2.0);
    check(&[], DVec3::ZERO, &light, 1.0);
    check(&[at(square(0.5), DVec3::Z)], DVec3::ZERO, &light, 0.75);
    check(&[at(square(1.0), DVec3::Z)], DVec3::ZERO, &light, 0.0);
    check(&[at(square(1.0), DVec3::new(0.5, 0.0, 1.0))], DVec3::ZERO, &light, 0.5);
    check(&[at(square(1.0), DVec3::new(0.5, 0.5, 1.0))], DVec3::ZERO, &light, 0.75);
    check(&[at(square(1.0), DVec3::new(1.0, 0.0, 1.0))], DVec3::ZERO, &light, 1.0);
    // Behind the light, in its plane, and behind p.
    check(&[at(square(1.0), 3.0 * DVec3::Z)], DVec3::ZERO, &light, 1.0);
    check(&[at(square(1.0), 2.0 * DVec3::Z)], DVec3::ZERO, &light, 1.0);
    check(&[at(square(1.0), -DVec3::Z)], DVec3::ZERO, &light, 1.0);
}

#[test]
fn shadows_that_overlap_count_once() {
    let light = square_light(2.0);
    let left = at(square(0.5), DVec3::new(-0.125, 0.0, 1.0));
    let right = at(square(0.5), DVec3::new(0.125, 0.0, 1.0));
    check(&[left.clone(), right.clone()], DVec3::ZERO, &light, 1.0 - 1.5 / 4.0);
    check(&[left.clone(), left.clone(), right.clone(), right], DVec3::ZERO, &light, 1.0 - 1.5 / 4.0);
    let halves = [-0.5, 0.5].map(|x| at(square(1.0), DVec3::new(x, 0.0, 1.0)));
    check(&halves, DVec3::ZERO, &light, 0.0);
}

#[test]
fn a_ring_of_many_squares_leaves_its_hole() {
    let cells = (0..5).flat_map(|i| (0..5).map(move |j| (f64::from(i) - 2.0, f64::from(j) - 2.0)));
    let ring = cells.filter(|cell| *cell != (0.0, 0.0));
    let surfaces: Vec<_> = ring.map(|(i, j)| at(square(0.2), DVec3::new(0.2 * i, 0.2 * j, 1.0))).collect();
    check(&surfaces, DVec3::ZERO, &square_light(2.0), 0.04);
}

#[test]
fn a_box_hides_by_its_silhouette_and_by_what_of_the_light_is_in_it() {
    // Seen from below, the near face counts, half way.
    check(&[at(cube(0.5), DVec3::new(0.0, 0.0, 1.25))], DVec3::ZERO, &square_light(2.0), 0.75);
    // The light passes through it: what is inside is hidden, and no more from straight below its middle but the cone
    // of the near face, at a height of 1.75: 0.5 wide there.
    let width = 0.5 * 2.0 / 1.75;
    check(&[at(cube(0.5), DVec3::new(0.0, 0.0, 2.0))], DVec3::ZERO, &square_light(2.0), 1.0 - width * width / 4.0);
    // It lies on the light.
    check(&[at(cube(0.5), DVec3::new(0.0, 0.0, 2.25))], DVec3::ZERO, &square_light(2.0), 1.0);
}

#[test]
fn in_a_room_its_walls_hide_what_is_outside() {
    let light = square_light(2.0);
    check(&[at(cube(6.0), DVec3::ZERO)], DVec3::ZERO, &light, 1.0);
    check(&[at(cube(4.0), DVec3::ZERO)], DVec3::ZERO, &light, 1.0);
    check(&[at(cube(3.9), DVec3::ZERO)], DVec3::ZERO, &light, 0.0);
    check(&[at(cube(5.0), DVec3::new(2.0, 0.0, 0.0))], DVec3::ZERO, &light, 0.75);
    // On its floor, on its roof, and on the roof of a box that the light reaches into.
    check(&[at(cube(6.0), 3.0 * DVec3::Z)], DVec3::ZERO, &light, 1.0);
    check(&[at(cube(6.0), -3.0 * DVec3::Z)], DVec3::ZERO, &light, 1.0);
    check(&[at(cube(1.0), 0.5 * DVec3::Z)], DVec3::ZERO, &light, 0.0);
    check(&[at(cube(3.0), DVec3::new(1.0, 0.0, 1.5))], DVec3::ZERO, &light, 0.75);
}

#[test]
fn a_sphere_hides_a_circle() {
    let p = DVec3::ZERO;
    let seen =
        visible_pieces(&objects(&[at(Shape::Sphere { radius: 0.25 }, DVec3::Z)]), p, DVec3::Z, &square_light(2.0));
    let sine: f64 = 0.25;
    let tangent = sine / (1.0 - sine * sine).sqrt();
    let circle = std::f64::consts::PI * (2.0 * tangent).powi(2);
    let share = share(&seen, &square_light(2.0));
    assert!((share - (1.0 - circle / 4.0)).abs() < 1e-14, "{share}");
}

/// A star-shaped polygon, convex or not.
fn random_light(random: &mut Random) -> ([DVec3; 2], Vec<DVec3>) {
    let (x, y) = random.direction().any_orthonormal_pair();
    let center = random.point(1.5);
    let corners = 3 + random.below(6);
    let spread = random.within(0.0, 0.8);
    let vertices = (0..corners).map(|i| {
        let angle = std::f64::consts::TAU * i as f64 / corners as f64;
        center + random.within(1.0 - spread, 1.0) * (angle.cos() * x + angle.sin() * y)
    });
    (([x, y]), vertices.collect())
}

const EXACT: [usize; 3] = [0, 1, 2];
const ROUND: [usize; 4] = [3, 4, 5, 6];

fn random_surface(random: &mut Random, kinds: &[usize]) -> Surface {
    let shape = match kinds[random.below(kinds.len())] {
        0 => Shape::Plane {},
        1 => Shape::Square { size: DVec2::new(random.within(0.2, 2.0), random.within(0.2, 2.0)) },
        2 => Shape::Box { size: random.point(0.8).abs() + 0.2 },
        3 => Shape::Disk { radius: random.within(0.2, 1.0) },
        4 => Shape::Sphere { radius: random.within(0.2, 1.0) },
        5 => Shape::Cylinder { radius: random.within(0.2, 1.0), height: random.within(0.2, 2.0) },
        _ => Shape::Cone { radius: random.within(0.2, 1.0), height: random.within(0.2, 2.0) },
    };
    let scale = DVec3::from_array([(); 3].map(|()| random.magnitude(0.5, 2.0) * random.within(-1.0, 1.0).signum()));
    surface(shape, random.point(1.0), 180.0 * random.point(1.0), scale)
}

/// A point anywhere, or on one of the surfaces.
fn random_point(random: &mut Random, objects: &Objects) -> DVec3 {
    let p = random.point(2.5);
    let hit = objects.nearest(p, random.direction());
    hit.filter(|_| random.below(3) == 0).map_or(p, |(_, hit)| hit.p)
}

/// Points of random lights that are not seen past random surfaces of these kinds as rays see them, and how many were
/// tried.
fn mismatches(seed: u64, kinds: &[usize], scenes: usize, points: usize) -> (Vec<String>, usize) {
    let mut random = Random::new(seed);
    let (mut wrong, mut tried) = (Vec::new(), 0);
    for scene in 0..scenes {
        let surfaces: Vec<_> = (0..1 + random.below(4)).map(|_| random_surface(&mut random, kinds)).collect();
        let objects = objects(&surfaces);
        let (axes, light) = random_light(&mut random);
        let p = random_point(&mut random, &objects);
        let n = random.direction();
        let seen = visible_pieces(&objects, p, n, &light);
        let inside = |q: DVec3, pieces: &[Vec<DVec3>]| pieces.iter().filter(|piece| is_in(piece, q, axes)).count();
        let center = light.iter().sum::<DVec3>() / light.len() as f64;
        for _ in 0..points {
            let q = center + random.within(-1.0, 1.0) * axes[0] + random.within(-1.0, 1.0) * axes[1];
            if !is_in(&light, q, axes) || n.dot(q - p) <= 0.0 {
                continue;
            }
            let count = match &seen {
                Seen::All => 1,
                Seen::Nothing => 0,
                Seen::Pieces(pieces) => inside(q, pieces),
                Seen::AllBut(pieces) => match inside(q, pieces) {
                    0 => 1,
                    1 => 0,
                    more => panic!("{more} hidden pieces over each other in scene {scene}"),
                },
                Seen::Unknown => panic!("nothing is known in scene {scene}"),
            };
            tried += 1;
            if objects.hides(p, q - p) == (count == 1) {
                wrong.push(format!("{q} of {light:?} from {p} with {n} past {surfaces:?}"));
            }
        }
    }
    (wrong, tried)
}

#[test]
fn flat_and_square_things_hide_the_very_points_that_rays_find_hidden() {
    let (wrong, tried) = mismatches(41, &EXACT, 20_000, 20);
    assert!(wrong.is_empty() && tried > 50_000, "{} of {tried}, such as {:?}", wrong.len(), wrong.first());
}

#[test]
fn round_things_hide_what_rays_find_hidden_but_for_their_outline() {
    for kind in ROUND {
        let (wrong, tried) = mismatches(42, &[kind], 20_000, 20);
        let share = wrong.len() as f64 / tried as f64;
        assert!(share < 2e-4 && tried > 50_000, "{share:e} of {tried} with kind {kind}, such as {:?}", wrong.first());
    }
}
