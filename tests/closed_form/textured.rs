//! Textured lights: exact quadrature against closed forms, sums of texels, laws and the reference.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DMat3, DVec3};
use softbox::light::pattern::{Channel, Span};
use softbox::light::{Emitter, TexturedEmitter};
use softbox::shading::reference::{BoundedResponse, reference};
use softbox::shading::textured::quadrature::Sought;
use softbox::shading::textured::{as_polygon, textured_exact, textured_points};
use softbox::shading::{Lobe, Method, Response, ShadingPoint, polygon, respond};

use super::random::Random;

/// A light of that pattern, the rows along X and the columns along Y, lit downwards.
fn light(row: f64, column: f64, pattern: Channel) -> TexturedEmitter {
    TexturedEmitter {
        corner: DVec3::new(0.5 * row, 0.5 * column, 0.0),
        row: -row * DVec3::X,
        column: -column * DVec3::Y,
        normal: DVec3::NEG_Z,
        two_sided: false,
        pattern: Arc::new(pattern),
    }
}

fn channel(width: usize, height: usize, value: impl Fn(f64, f64) -> f64) -> Channel {
    Channel::of_shares(width, height, value).expect("texels are finite and not negative")
}

/// Waves and specks: nothing that a polynomial would follow.
fn specks(width: usize, height: usize) -> Channel {
    channel(width, height, |u, v| ((12.9898 * u + 78.233 * v).sin() * 43758.5453).fract().abs())
}

fn any_turn(random: &mut Random) -> DMat3 {
    DMat3::from_axis_angle(random.direction(), random.within(0.0, TAU))
}

/// How many random inputs to try: `usual`, or as `SOFTBOX_PROPERTY_CASES` says.
fn cases_wanted(usual: usize) -> usize {
    std::env::var("SOFTBOX_PROPERTY_CASES").ok().and_then(|count| count.parse().ok()).unwrap_or(usual)
}

/// A light of random size, place and pattern, and a point near it or far away.
fn any_case(random: &mut Random) -> (TexturedEmitter, ShadingPoint, Lobe) {
    let sides = [0, 1].map(|_| random.magnitude(0.2, 5.0));
    let counts = [0, 1].map(|_| 1 + random.below(8));
    let seed = random.within(1.0, 2.0);
    let pattern = channel(counts[0], counts[1], |u, v| {
        let value = ((12.9898 * u + 78.233 * v) * seed).sin();
        if value > 0.6 { 0.0 } else { value.abs() }
    });
    let mut light = light(sides[0], sides[1], pattern);
    light.two_sided = random.within(0.0, 1.0) > 0.5;
    let turn = any_turn(random);
    for side in [&mut light.corner, &mut light.row, &mut light.column, &mut light.normal] {
        *side = turn * *side;
    }
    let height = random.magnitude(0.003, 10.0);
    let p = light.point(random.within(-1.0, 2.0), random.within(-1.0, 2.0)) + height * light.normal;
    let at = ShadingPoint { p, n: random.direction(), v: random.direction() };
    let v = if at.n.dot(at.v) < 0.0 { -at.v } else { at.v };
    (light, ShadingPoint { v, ..at }, Lobe::new(random.magnitude(1.0, 300.0)))
}

/// Whether two numbers with bounds may be the same.
#[track_caller]
fn check(what: &str, a: BoundedResponse, b: BoundedResponse) {
    for (part, a, b) in [("irradiance", a.irradiance, b.irradiance), ("specular", a.specular, b.specular)] {
        let apart = (a.value - b.value).abs();
        assert!(apart <= a.error + b.error + 1e-13, "{what}, {part}: {a:?} and {b:?} are {apart:e} apart");
    }
}

#[test]
fn exact_is_finite_not_negative_bounded_and_as_sure_as_it_says() {
    let mut random = Random::new(31);
    for case in 0..cases_wanted(5_000) {
        let (light, at, lobe) = any_case(&mut random);
        let answer = textured_exact(&light, &at, &lobe, Sought::default());
        let brightest =
            light.pattern.texels().iter().fold(0.0, |brightest: f64, texel| brightest.max(f64::from(*texel)));
        for (part, estimate, most) in [("irradiance", answer.irradiance, PI), ("specular", answer.specular, 1.0)] {
            let what = format!("case {case}, {part}: {estimate:?}");
            assert!(estimate.value.is_finite() && estimate.value >= 0.0, "{what} is no answer");
            assert!(estimate.value - estimate.error <= most * brightest, "{what} is above {most} of {brightest}");
            assert!(estimate.error <= 1e-6 * estimate.value + 1e-9 * most, "{what} is too wide");
        }
    }
}

#[test]
fn a_white_pattern_is_a_polygon() {
    let mut random = Random::new(32);
    for case in 0..2000 {
        let (mut light, at, lobe) = any_case(&mut random);
        let [width, height] = light.pattern.size().map(|side| side as usize);
        light.pattern = Arc::new(channel(width, height, |_, _| 1.0));
        let exact = textured_exact(&light, &at, &lobe, Sought::default());
        let closed = polygon::respond(&as_polygon(&light), Method::Exact, &at, &lobe);
        for (part, estimate, closed) in
            [("irradiance", exact.irradiance, closed.irradiance), ("specular", exact.specular, closed.specular)]
        {
            let apart = (estimate.value - closed).abs();
            assert!(
                apart <= estimate.error + 1e-9 * closed + 1e-11,
                "case {case}, {part}: {estimate:?} is not {closed}"
            );
        }
    }
}

#[test]
fn a_pattern_is_the_sum_of_its_texels() {
    let mut random = Random::new(33);
    for case in 0..200 {
        let (light, at, lobe) = any_case(&mut random);
        let [width, height] = light.pattern.size();
        let mut sum = BoundedResponse::default();
        for (i, texel) in (0..).zip(light.pattern.texels()) {
            let (row, column) = (light.row / f64::from(width), light.column / f64::from(height));
            let corner = light.corner + f64::from(i % width) * row + f64::from(i / width) * column;
            let pattern = Arc::new(Channel::white());
            let texel_light = TexturedEmitter { corner, row, column, pattern, ..light.clone() };
            let part = textured_exact(&texel_light, &at, &lobe, Sought::default());
            sum.irradiance = sum.irradiance + part.irradiance * f64::from(*texel);
            sum.specular = sum.specular + part.specular * f64::from(*texel);
        }
        check(&format!("case {case}"), textured_exact(&light, &at, &lobe, Sought::default()), sum);
    }
}

#[test]
fn exact_is_within_the_reference() {
    let mut random = Random::new(34);
    for case in 0..100 {
        let (light, at, lobe) = any_case(&mut random);
        let exact = textured_exact(&light, &at, &lobe, Sought::default());
        check(&format!("case {case}"), exact, reference(&Emitter::Textured(light), &at, &lobe));
    }
}

#[test]
fn pictures_are_as_sure_as_they_show() {
    let mut random = Random::new(36);
    for case in 0..1000 {
        let (light, at, lobe) = any_case(&mut random);
        let [exact, shown] =
            [Sought::default(), Sought::PICTURE].map(|sought| textured_exact(&light, &at, &lobe, sought));
        check(&format!("case {case}"), shown, exact);
        for (part, estimate, most) in [("irradiance", shown.irradiance, PI), ("specular", shown.specular, 1.0)] {
            let allowed = 1e-4 * estimate.value + 1e-4 * most;
            assert!(estimate.error <= allowed, "case {case}, {part}: {estimate:?} is too wide");
        }
    }
}

#[test]
fn turning_and_scaling_everything_changes_nothing() {
    let mut random = Random::new(35);
    for case in 0..1000 {
        let (light, at, lobe) = any_case(&mut random);
        let turn = any_turn(&mut random);
        let scale = random.magnitude(1e-3, 1e3);
        let moved = TexturedEmitter {
            corner: scale * (turn * light.corner),
            row: scale * (turn * light.row),
            column: scale * (turn * light.column),
            normal: turn * light.normal,
            ..light.clone()
        };
        let at_moved = ShadingPoint { p: scale * (turn * at.p), n: turn * at.n, v: turn * at.v };
        let [before, after] =
            [(&light, &at), (&moved, &at_moved)].map(|(light, at)| textured_exact(light, at, &lobe, Sought::default()));
        check(&format!("case {case}"), before, after);
    }
}

#[test]
fn what_is_gathered_of_large_patterns_is_what_their_texels_are() {
    for (width, height) in [(300, 200), (517, 64), (1000, 3), (65, 129)] {
        let pattern = specks(width, height);
        let sum: f64 = pattern.texels().iter().map(|texel| f64::from(*texel)).sum();
        let [columns, rows] = pattern.size().map(Span::whole);
        let total = |columns: &Span, rows: &Span| pattern.weights(columns, rows).iter().flatten().sum::<f64>();
        let whole = total(&columns, &rows);
        assert!((whole * (width * height) as f64 / sum - 1.0).abs() < 1e-12, "{width} x {height}: {whole} of {sum}");
        let mut spans = (columns, rows);
        for step in 0..12 {
            let halves = if step % 2 == 0 { spans.0.halves() } else { spans.1.halves() }.expect("halves");
            let part = |half| if step % 2 == 0 { (half, spans.1) } else { (spans.0, half) };
            let [first, second] = halves.map(part);
            let (parts, whole) = (total(&first.0, &first.1) + total(&second.0, &second.1), total(&spans.0, &spans.1));
            assert!((parts / whole - 1.0).abs() < 1e-12, "{width} x {height}, step {step}: {parts} of {whole}");
            let flux = pattern.flux(&first.0, &first.1);
            let gathered = total(&first.0, &first.1);
            assert!((flux / gathered - 1.0).abs() < 1e-12, "{width} x {height}, step {step}: {flux} of {gathered}");
            spans = if step % 3 == 0 { second } else { first };
        }
    }
}

#[test]
fn large_patterns_are_within_the_reference() {
    let at = ShadingPoint { p: DVec3::new(0.1, -0.2, -0.7), n: DVec3::Z, v: DVec3::new(0.6, 0.0, 0.8) };
    for (width, height) in [(96, 80), (130, 33)] {
        let light = light(1.3, 0.9, specks(width, height));
        let tilted = ShadingPoint { n: DVec3::new(0.8, 0.0, 0.6), ..at };
        for at in [at, tilted] {
            let exact = textured_exact(&light, &at, &Lobe::new(40.0), Sought::default());
            check(
                &format!("{width} x {height}"),
                exact,
                reference(&Emitter::Textured(light.clone()), &at, &Lobe::new(40.0)),
            );
        }
    }
}

#[test]
fn the_limits_far_away_and_close_by_are_a_point_light_and_the_texel() {
    let light = light(1.0, 1.0, channel(2, 2, |u, v| if u > 0.5 && v > 0.5 { 0.75 } else { 0.25 }));
    let lobe = Lobe::new(5.0);
    let far = ShadingPoint { p: DVec3::new(300.0, 200.0, -1000.0), n: DVec3::Z, v: DVec3::Z };
    let [exact, point] =
        [Method::Exact, Method::Point].map(|method| respond(&Emitter::Textured(light.clone()), method, &far, &lobe));
    assert!((point.irradiance / exact.irradiance - 1.0).abs() < 1e-6, "{point:?} and {exact:?}");
    assert!((point.specular / exact.specular - 1.0).abs() < 1e-5, "{point:?} and {exact:?}");
    // The last texel is at −X, −Y.
    for (x, y, level) in [(-0.25, -0.25, 0.75), (0.25, 0.25, 0.25), (-0.25, 0.25, 0.25)] {
        let near = ShadingPoint { p: DVec3::new(x, y, -1e-6), n: DVec3::Z, v: DVec3::Z };
        let Response { irradiance, specular } = respond(&Emitter::Textured(light.clone()), Method::Exact, &near, &lobe);
        assert!((irradiance / (PI * level) - 1.0).abs() < 1e-5, "E over texel {level} is {irradiance}");
        assert!((specular / level - 1.0).abs() < 1e-5, "specular over texel {level} is {specular}");
    }
    let behind = ShadingPoint { p: DVec3::Z, n: DVec3::NEG_Z, v: DVec3::NEG_Z };
    let dark = respond(&Emitter::Textured(light), Method::Exact, &behind, &lobe);
    assert_eq!(dark, Response::default(), "behind a one-sided light");
}

#[test]
fn clusters_have_the_patterns_flux_where_it_is() {
    let bright_corner = |u: f64, v: f64| if u < 0.25 && v < 0.25 { 1.0 } else { 0.0 };
    let light = light(2.0, 1.0, channel(16, 16, bright_corner));
    for points in [1, 2, 7, 16, 100] {
        let cluster = textured_points(&light, points);
        let total: f64 = cluster.iter().map(|point| point.area).sum();
        assert_eq!(cluster.len(), points as usize, "points");
        assert!((total / (2.0 * light.pattern.mean()) - 1.0).abs() < 1e-12, "{total} of {points}");
        for point in cluster.iter().filter(|point| point.area > 1e-12) {
            let DVec3 { x, y, .. } = point.position;
            assert!((0.5..=1.0).contains(&x) && (0.25..=0.5).contains(&y), "{} is in the dark", point.position);
        }
    }
}

#[test]
fn what_no_horizon_or_contact_can_break() {
    let lobe = Lobe::new(30.0);
    let light = light(1.0, 1.0, specks(8, 8));
    for (what, p, n) in [
        ("in the plane", DVec3::new(0.2, 0.1, 0.0), DVec3::Z),
        ("at a corner", DVec3::new(0.5, 0.5, 0.0), DVec3::Z),
        ("beside it, in the plane", DVec3::new(2.0, 0.1, 0.0), DVec3::Z),
        ("just below", DVec3::new(0.2, 0.1, -1e-9), DVec3::Z),
        ("edge on", DVec3::new(0.0, 0.0, -1.0), DVec3::X),
        ("with its back to it", DVec3::new(0.0, 0.0, -1.0), DVec3::NEG_Z),
        ("far away", DVec3::new(0.0, 0.0, -1e9), DVec3::Z),
    ] {
        let answer = textured_exact(&light, &ShadingPoint { p, n, v: n }, &lobe, Sought::default());
        for estimate in [answer.irradiance, answer.specular] {
            assert!(estimate.value.is_finite() && estimate.value >= 0.0, "{what}: {estimate:?}");
            assert!(estimate.error <= 1e-3 * estimate.value + 1e-9, "{what}: {estimate:?} is too wide");
        }
    }
}
