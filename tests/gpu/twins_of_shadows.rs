//! The WGSL of what hides against `visibility`.

use glam::{DVec2, DVec3};
use softbox::gpu::twin::{self, Function, Row, Twin, rounded};
use softbox::surface::{Mesh, Placed, Shape, Surface, Triangle};
use softbox::visibility::line::visible_segments;
use softbox::visibility::{Objects, Structure};

use crate::CONTEXT;
use crate::twins::Random;

/// Rows of a surface.
const ROWS: usize = 200;

fn shapes(random: &mut Random) -> [Shape; 7] {
    let mut size = || random.within(0.3, 2.0);
    [
        Shape::Plane {},
        Shape::Sphere { radius: size() },
        Shape::Box { size: DVec3::new(size(), size(), size()) },
        Shape::Square { size: DVec2::new(size(), size()) },
        Shape::Disk { radius: size() },
        Shape::Cylinder { radius: size(), height: size() },
        Shape::Cone { radius: size(), height: size() },
    ]
}

fn triangles(random: &mut Random) -> [Shape; 7] {
    [(); 7].map(|()| {
        let corners = [(); 3].map(|()| random.point(1.0));
        let mut mesh = Mesh::unread("");
        mesh.triangles = [Triangle { corners, normals: None }].into();
        Shape::Mesh(mesh)
    })
}

fn placed_at_random(shape: Shape, random: &mut Random) -> Surface {
    Surface {
        name: String::new(),
        material: String::new(),
        position: random.point(3.0),
        rotation_deg: random.point(180.0),
        scale: DVec3::from_array([(); 3].map(|()| random.within(0.4, 1.6))),
        shape,
    }
}

/// A point, its normal, and a light's ends; whether the point is on the surface.
struct Case {
    p: DVec3,
    n: DVec3,
    a: DVec3,
    b: DVec3,
    is_on: bool,
}

/// Points about, inside and on a surface; half the lights are near it.
fn case(surface: &Surface, random: &mut Random) -> Case {
    let near = |random: &mut Random, extent| rounded(surface.position + random.point(extent));
    let (a, b) = (near(random, 2.0), near(random, 4.0));
    let extent = [0.3, 1.0, 4.0][(random.bits() % 3) as usize];
    let p = near(random, extent);
    let n = random.direction();
    let hit = Placed::parts(surface)[0].intersect(p, surface.position + random.point(0.5) - p);
    match hit {
        Some(hit) if random.bits().is_multiple_of(3) => {
            let n = if hit.n.dot(p - hit.p) < 0.0 { -hit.n } else { hit.n };
            Case { p: hit.p, n, a, b, is_on: true }
        }
        _ => Case { p, n, a, b, is_on: false },
    }
}

/// The part of the light above the point's horizon.
fn above(case: &Case) -> [f64; 2] {
    let [a, b] = [case.a, case.b].map(|end| case.n.dot(end - case.p));
    let crossing = a / (a - b);
    match (a > 0.0, b > 0.0) {
        (true, true) => [0.0, 1.0],
        (true, false) => [0.0, crossing],
        (false, true) => [crossing, 1.0],
        (false, false) => [0.0, 0.0],
    }
}

/// The length of what two sets of intervals do not have in common.
fn apart(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    let mut ends: Vec<f64> = one.iter().chain(other).flatten().copied().collect();
    ends.sort_by(f64::total_cmp);
    let holds = |set: &[[f64; 2]], t: f64| set.iter().any(|[low, high]| *low <= t && t <= *high);
    let length = |pair: &[f64]| {
        let t = 0.5 * (pair[0] + pair[1]);
        if holds(one, t) == holds(other, t) { 0.0 } else { pair[1] - pair[0] }
    };
    ends.windows(2).map(length).sum()
}

/// What of the light above the horizon a pair of intervals leaves.
fn left([first, last]: [f64; 2], hidden: &[f32]) -> Vec<[f64; 2]> {
    let mut seen = vec![[first, last]];
    for interval in hidden.chunks_exact(2) {
        let [low, high] = [interval[0], interval[1]].map(f64::from);
        if low < high {
            seen = seen.iter().flat_map(|&[a, b]| [[a, b.min(low)], [a.max(high), b]]).collect();
            seen.retain(|[a, b]| a < b);
        }
    }
    seen
}

/// The most that may be seen otherwise, as a share of the light.
const BOUND: f64 = 1e-4;

/// The most that is seen otherwise, as a share of the light.
fn difference(twin: &Twin, shapes: fn(&mut Random) -> [Shape; 7], numbers: u8) -> f64 {
    let mut random = Random(71);
    let mut worst = 0.0_f64;
    for _ in 0..6 {
        for shape in shapes(&mut random) {
            let surface = placed_at_random(shape, &mut random);
            let objects = Objects::new(std::slice::from_ref(&surface), Structure::Every);
            let cases: Vec<_> = (0..ROWS).map(|_| case(&surface, &mut random)).collect();
            let rows = cases.iter().flat_map(|case| {
                let row = Row::default().vector(case.p).vector(case.a - case.p).vector(case.b - case.a);
                let row = row.number(if case.is_on { 1.0 } else { 0.0 });
                (0..numbers).map(move |i| row.clone().number(i.into()))
            });
            let rows: Vec<_> = rows.collect();
            let results = twin.run_among(&rows, std::slice::from_ref(&surface)).expect("the device answers");
            for (case, hidden) in cases.iter().zip(results.chunks_exact(numbers.into())) {
                let whole = above(case);
                let seen = visible_segments(&objects, case.p, case.n, [case.a, case.b]);
                let expected = seen.map_or_else(|| vec![whole], |seen| seen.parts().to_vec());
                worst = worst.max(apart(&left(whole, hidden), &expected));
            }
        }
    }
    worst
}

#[track_caller]
fn check_hidden(function: &Function, shapes: fn(&mut Random) -> [Shape; 7], numbers: u8, errors: &[(&str, &str)]) {
    let worst = difference(&Twin::new(&CONTEXT, function), shapes, numbers);
    println!("{}: at most {worst:.1e} of a light is seen otherwise", function.name);
    assert!(worst <= BOUND, "{}: {worst} of a light is seen otherwise", function.name);
    for (text, error) in errors {
        let broken = Twin::with_error(&CONTEXT, function, text, error).expect("the text is there");
        let worst = difference(&broken, shapes, numbers);
        assert!(worst > BOUND, "with `{error}` for `{text}` only {worst} of a light is seen otherwise");
    }
}

#[test]
fn what_a_primitive_hides_of_a_line_matches() {
    let errors = [("b * b - a * c", "1.1 * b * b - a * c"), ("f0 * far.yzx", "f0 * half.yzx")];
    check_hidden(&twin::HIDDEN_BY_PRIMITIVE, shapes, 4, &errors);
}

#[test]
fn what_a_triangle_hides_of_a_line_matches() {
    check_hidden(&twin::HIDDEN_BY_TRIANGLE, triangles, 2, &[("side * cross(b, bc)", "side * cross(b, ab)")]);
}

/// Share of random segments on which `Objects::hides` disagrees; segments from a surface where `is_on`.
fn disagreement(twin: &Twin, is_on: bool) -> f64 {
    let mut random = Random(72);
    let (mut wrong, mut count) = (0.0, 0.0);
    for _ in 0..6 {
        let mut surfaces = shapes(&mut random).map(|shape| placed_at_random(shape, &mut random)).to_vec();
        if is_on {
            let which = (random.bits() % 7) as usize;
            surfaces = vec![surfaces.swap_remove(which)];
        }
        let objects = Objects::new(&surfaces, Structure::Hierarchy);
        let mut cases: Vec<_> = (0..10 * ROWS).map(|_| case(&surfaces[0], &mut random)).collect();
        cases.retain(|case| case.is_on == is_on);
        let rows: Vec<_> = cases.iter().map(|case| Row::default().vector(case.p).vector(case.a - case.p)).collect();
        let results = twin.run_among(&rows, &surfaces).expect("the device answers");
        for (case, hidden) in cases.iter().zip(&results) {
            wrong += f64::from((*hidden > 0.5) != objects.hides(case.p, case.a - case.p));
            count += 1.0;
        }
    }
    wrong / count
}

#[track_caller]
fn check_hides(function: &Function, is_on: bool, error: (&str, &str)) {
    const WRONG: f64 = 1e-4;
    let share = disagreement(&Twin::new(&CONTEXT, function), is_on);
    println!("hides: {share:.1e} of the segments are decided otherwise");
    assert!(share <= WRONG, "{share} of the segments are decided otherwise");
    let broken = Twin::with_error(&CONTEXT, function, error.0, error.1).expect("the text is there");
    let share = disagreement(&broken, is_on);
    assert!(share > WRONG, "with `{}` for `{}` only {share} are decided otherwise", error.1, error.0);
}

#[test]
fn what_hides_a_point_matches() {
    check_hides(&twin::HIDES, false, ("crossing < 1.0 - ROUNDING", "crossing < 0.97"));
}

#[test]
fn what_hides_a_point_from_its_own_surface_matches() {
    check_hides(&twin::HIDES_FROM_ITSELF, true, ("start.on_quadric)", "false)"));
}
