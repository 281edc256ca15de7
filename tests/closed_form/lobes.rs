//! The models of specular reflection: what each must hold, and how near one-shot comes to it.

use glam::DVec3;
use softbox::light::{DiskEmitter, Emitter, PolygonEmitter, SkyEmitter};
use softbox::shading::reference::{quick_specular, reference};
use softbox::shading::{Lobe, Method, Prepared, ShadingPoint, respond};

use super::random::Random;

const MODELS: [&str; 4] = ["Phong", "Blinn", "Cook-Torrance", "Lafortune"];

/// A lobe of a model by its place in [`MODELS`].
fn random_lobe(random: &mut Random, model: usize) -> Lobe {
    let m = random.magnitude(1.0, 300.0);
    match model {
        0 => Lobe::new(m),
        1 => Lobe::blinn(m),
        2 => Lobe::cook_torrance(random.magnitude(0.05, 1.0), random.within(0.0, 1.0)),
        _ => Lobe::lafortune(m, random.within(-1.0, 1.0), random.within(0.2, 1.0)),
    }
}

/// A direction above a surface.
fn above(random: &mut Random, n: DVec3) -> DVec3 {
    let direction = random.direction();
    if direction.dot(n) > 0.0 { direction } else { -direction }
}

/// The light of a sky of luminance 1 that a surface reflects: ∫ρ dω.
fn albedo(lobe: &Lobe, v: DVec3) -> f64 {
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v };
    let sky = Emitter::Sky(SkyEmitter { zenith: DVec3::Z, uniform: 1.0, cosine: 0.0 });
    if lobe.is_cosine() { reference(&sky, &at, lobe).specular.value } else { quick_specular(&sky, &at, lobe).value }
}

#[test]
fn no_model_reflects_more_than_it_gets() {
    let mut random = Random::new(51);
    for i in 0..160 {
        let lobe = random_lobe(&mut random, i % 4);
        let v = above(&mut random, DVec3::Z);
        let reflected = albedo(&lobe, v);
        assert!(
            (0.0..=1.0 + 1e-5).contains(&reflected),
            "{} reflects {reflected} of {lobe:?} towards {v}",
            MODELS[i % 4]
        );
    }
}

#[test]
fn blinn_and_phong_reflect_all_along_the_normal() {
    for m in [1.0, 2.5, 30.0, 1000.0] {
        for lobe in [Lobe::new(m), Lobe::blinn(m), Lobe::lafortune(m, -1.0, 1.0)] {
            let reflected = albedo(&lobe, DVec3::Z);
            assert!((reflected - 1.0).abs() < 1e-5, "{reflected} of {lobe:?}");
        }
    }
}

#[test]
fn light_and_eye_may_change_places() {
    let mut random = Random::new(52);
    for i in 0..4000 {
        let lobe = random_lobe(&mut random, i % 4);
        let n = random.direction();
        let (v, w) = (above(&mut random, n), above(&mut random, n));
        let mirrored = |v: DVec3| ShadingPoint { p: DVec3::ZERO, n, v };
        let there_and_back = [(v, w), (w, v)].map(|(v, w)| {
            let (seen, factor) = lobe.seen(&mirrored(v));
            // Cook and Torrance's density has the cosine at the surface in it.
            let cosine = if i % 4 == 2 { n.dot(w) } else { 1.0 };
            factor * lobe.density(n, seen.mirror(), w) / cosine
        });
        let [there, back] = there_and_back;
        let scale = (lobe.exponent() + 1.0) * 1e-12;
        assert!((there - back).abs() <= 1e-9 * (there + back) + scale, "{there} and {back} of {lobe:?}, {v}, {w}");
    }
}

/// A polygon or a disk, and a point that sees it from above.
fn random_view(random: &mut Random) -> (Emitter, ShadingPoint) {
    let normal = random.direction();
    let (u, v) = normal.any_orthonormal_pair();
    let center = random.point(1.0);
    let emitter = if random.within(0.0, 1.0) < 0.5 {
        Emitter::Disk(DiskEmitter { center, normal, radius: random.magnitude(0.1, 2.0), two_sided: true })
    } else {
        let corners = [(1.0, 0.5), (-1.0, 0.5), (-1.0, -0.5), (1.0, -0.5)].map(|(x, y)| center + x * u + y * v);
        Emitter::Polygon(PolygonEmitter { vertices: corners.to_vec(), normal, two_sided: true })
    };
    let p = center + random.direction() * random.magnitude(0.3, 5.0);
    // The surface looks at the light, more or less.
    let n = ((center - p).normalize() + 0.7 * random.direction()).normalize();
    (emitter, ShadingPoint { p, n, v: above(random, n) })
}

#[test]
fn lafortune_with_the_factors_of_a_mirror_is_phong() {
    let mut random = Random::new(53);
    for _ in 0..400 {
        let (emitter, at) = random_view(&mut random);
        let m = random.magnitude(1.0, 300.0);
        for method in [Method::Exact, Method::OneShot, Method::PointCluster(7), Method::Point] {
            let [phong, lafortune] =
                [Lobe::new(m), Lobe::lafortune(m, -1.0, 1.0)].map(|lobe| respond(&emitter, method, &at, &lobe));
            let close = |x: f64, y: f64| (x - y).abs() <= 1e-10 * (x + y) + 1e-12;
            assert!(
                close(phong.specular, lafortune.specular) && phong.irradiance == lafortune.irradiance,
                "{method}: {phong:?} and {lafortune:?} for {m}, {at:?}, {emitter:?}"
            );
        }
    }
}

#[test]
fn exact_methods_are_within_references_bounds_for_every_model() {
    let mut random = Random::new(54);
    for i in 0..48 {
        let (emitter, at) = random_view(&mut random);
        let lobe = random_lobe(&mut random, i % 4);
        let exact = respond(&emitter, Method::Exact, &at, &lobe).specular;
        let judge = reference(&emitter, &at, &lobe).specular;
        let most = judge.error + 2e-5 * judge.value + 1e-9;
        assert!((exact - judge.value).abs() <= most, "{}: {exact}, not {judge:?} of {lobe:?}", MODELS[i % 4]);
    }
}

/// Mean |error| over the mean of the specular response itself.
fn relative_errors(model: usize, methods: &[Method]) -> Vec<f64> {
    let mut random = Random::new(55);
    let (mut truth, mut errors) = (0.0, vec![0.0; methods.len()]);
    for _ in 0..150 {
        let (emitter, at) = random_view(&mut random);
        let m = random.magnitude(3.0, 100.0);
        let lobe = match model {
            0 => Lobe::new(m),
            1 => Lobe::blinn(4.0 * m),
            2 => Lobe::cook_torrance((0.5 / m).sqrt(), 0.5),
            _ => Lobe::lafortune(m, -0.9, 0.95),
        };
        let exact = respond(&emitter, Method::Exact, &at, &lobe).specular;
        truth += exact;
        for (error, method) in errors.iter_mut().zip(methods) {
            *error += (Prepared::new(&emitter, *method).respond(&at, &lobe).specular - exact).abs();
        }
    }
    errors.iter().map(|error| error / truth).collect()
}

#[test]
fn one_shot_serves_every_model_as_it_serves_phong() {
    let methods = [Method::OneShot, Method::OneShotSquare, Method::OneShotSized, Method::Point];
    for (model, name) in MODELS.iter().enumerate() {
        let errors = relative_errors(model, &methods);
        println!("{name}: one-shot, square, sized, point: {errors:.3?}");
        assert!(errors[..3].iter().all(|error| *error < 0.6), "{name}: {errors:?}");
        assert!(errors[3] > 1.0, "{name}: the point light is far better than ever: {errors:?}");
    }
}

#[test]
fn densities_are_finite_at_grazing_and_opposite_directions() {
    let grazing = DVec3::new(1.0, 0.0, 1e-12).normalize();
    let directions = [DVec3::Z, grazing, -grazing, DVec3::X, -DVec3::X, DVec3::new(0.6, 0.0, 0.8)];
    let mut random = Random::new(56);
    for i in 0..400 {
        let lobe = random_lobe(&mut random, i % 4);
        for v in directions {
            for w in directions {
                let (seen, factor) = lobe.seen(&ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v });
                let density = factor * lobe.density(DVec3::Z, seen.mirror(), w);
                assert!(density.is_finite() && density >= 0.0, "{density} of {lobe:?} for {v}, {w}");
            }
        }
    }
}
