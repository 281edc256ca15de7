//! What must hold for every light and method, over random inputs.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};
use softbox::light::{Emitter, Line, LineEmitter, Polygon, Shape, Sphere, SphereEmitter};
use softbox::math::special::refined_panels;
use softbox::shading::cluster::polygon_points;
use softbox::shading::line::{line_irradiance, line_phong};
use softbox::shading::reference::reference;
use softbox::shading::{Method, PhongLobe, Response, ShadingPoint, respond};

use super::random::Random;

/// A light and a point that looks at it.
#[derive(Clone, Debug)]
struct Scene {
    emitter: Emitter,
    at: ShadingPoint,
    lobe: PhongLobe,
}

impl Scene {
    /// A line or a sphere, near or far, with a point that sees its surface from above.
    fn random(random: &mut Random) -> Self {
        let place = random.point(2.0) * random.magnitude(0.1, 20.0);
        let emitter = if random.within(0.0, 1.0) < 0.5 {
            let half = 0.5 * random.direction() * random.magnitude(1e-2, 20.0);
            let falloff = (random.within(0.0, 16.0).floor() / 2.0 - 4.0).clamp(0.0, 3.5);
            let falloff = if falloff == 0.0 { 2.0 } else { falloff - 0.5 };
            let tube = (random.within(0.0, 1.0) < 0.4).then(|| random.magnitude(1e-3, 1e-1));
            Emitter::Line(LineEmitter { a: place - half, b: place + half, falloff, tube })
        } else {
            Emitter::Sphere(SphereEmitter { center: place, radius: random.magnitude(1e-2, 10.0) })
        };
        let (n, mut v) = (random.direction(), random.direction());
        if v.dot(n) < 0.0 {
            v -= 2.0 * v.dot(n) * n;
        }
        let at = ShadingPoint { p: random.point(1.0), n, v };
        Self { emitter, at, lobe: PhongLobe::new(random.magnitude(1.0, 1000.0)) }
    }

    fn methods(&self) -> impl Iterator<Item = Method> {
        let shape = match &self.emitter {
            Emitter::Line(_) => Shape::Line(Line::isotropic(1.0)),
            _ => Shape::Sphere(Sphere { radius: 1.0 }),
        };
        Method::of(&shape).iter().copied().filter(|method| !matches!(method, Method::Reference | Method::Fit(_)))
    }

    fn respond(&self, method: Method) -> Response {
        respond(&self.emitter, method, &self.at, &self.lobe)
    }

    /// What no method's irradiance may exceed, and that for its specular part.
    fn bounds(&self) -> [f64; 2] {
        let m = self.lobe.exponent();
        match self.emitter {
            Emitter::Line(LineEmitter { a, b, falloff, tube }) => {
                let (a, along) = (a - self.at.p, b - a);
                let t = (-a.dot(along) / along.length_squared()).clamp(0.0, 1.0);
                let most =
                    tube.map_or(1.0, |radius| 2.0 * radius) * along.length() / (a + t * along).length().powf(falloff);
                [most, (m + 1.0) / TAU * most]
            }
            Emitter::Sphere(SphereEmitter { center, radius }) => {
                let point = PI * radius * radius / (center - self.at.p).length_squared();
                [point.max(PI), ((m + 1.0) / TAU * point).max((m + 1.0) * 1.01)]
            }
            _ => [f64::INFINITY; 2],
        }
    }
}

/// Lines and spheres.
const MODELS: usize = 2;

/// Random cases a model in an ordinary run; `SOFTBOX_PROPERTY_CASES` gives another number.
const CASES: usize = 100_000;

/// How many cases to try, of which `usual` would be tried in an ordinary run.
fn cases_wanted(usual: usize) -> usize {
    let asked = std::env::var("SOFTBOX_PROPERTY_CASES").ok().and_then(|count| count.parse::<usize>().ok());
    asked.map_or(usual, |asked| (asked * usual).div_ceil(CASES))
}

#[track_caller]
fn same(what: &str, x: Response, y: Response, [irradiance, specular]: [f64; 2], scene: &Scene) {
    let close = |x: f64, y: f64, scale: f64| (x - y).abs() <= 1e-9 * (x.abs() + y.abs()) + 1e-12 * scale;
    assert!(
        close(x.irradiance, y.irradiance, irradiance) && close(x.specular, y.specular, specular),
        "{what}: {x:?} and {y:?} for {scene:?}"
    );
}

#[test]
fn responses_are_finite_and_not_negative_and_bounded() {
    let mut random = Random::new(11);
    for _ in 0..cases_wanted(MODELS * CASES) {
        let scene = Scene::random(&mut random);
        let [irradiance, specular] = scene.bounds();
        for method in scene.methods() {
            let x = scene.respond(method);
            assert!((0.0..=irradiance * 1.001).contains(&x.irradiance), "{method}: {x:?} for {scene:?}");
            assert!((0.0..=specular * 1.01).contains(&x.specular), "{method}: {x:?} for {scene:?}");
        }
    }
}

#[test]
fn turning_everything_changes_nothing() {
    let mut random = Random::new(12);
    for _ in 0..cases_wanted(MODELS * CASES) {
        let scene = Scene::random(&mut random);
        let turn = DMat3::from_axis_angle(random.direction(), random.within(0.0, TAU));
        let ShadingPoint { p, n, v } = scene.at;
        let turned = Scene {
            emitter: match scene.emitter {
                Emitter::Line(LineEmitter { a, b, falloff, tube }) => {
                    Emitter::Line(LineEmitter { a: turn * a, b: turn * b, falloff, tube })
                }
                Emitter::Sphere(SphereEmitter { center, radius }) => {
                    Emitter::Sphere(SphereEmitter { center: turn * center, radius })
                }
                ref other => other.clone(),
            },
            at: ShadingPoint { p: turn * p, n: turn * n, v: turn * v },
            lobe: scene.lobe.clone(),
        };
        // A sphere's cluster lies on a spiral whose start no turn can carry along.
        let turnable =
            |method: &Method| !matches!((method, &scene.emitter), (Method::PointCluster(_), Emitter::Sphere(_)));
        for method in scene.methods().filter(turnable) {
            same("turned", scene.respond(method), turned.respond(method), scene.bounds(), &scene);
        }
    }
}

#[test]
fn scaling_everything_follows_the_falloff() {
    let mut random = Random::new(13);
    for _ in 0..cases_wanted(MODELS * CASES) {
        let scene = Scene::random(&mut random);
        let scale = random.magnitude(0.01, 100.0);
        let (emitter, factor) = match scene.emitter {
            Emitter::Line(LineEmitter { a, b, falloff, tube }) => {
                let line = LineEmitter { a: scale * a, b: scale * b, falloff, tube: tube.map(|radius| scale * radius) };
                let per_metre = if tube.is_some() { falloff - 2.0 } else { falloff - 1.0 };
                (Emitter::Line(line), scale.powf(per_metre))
            }
            Emitter::Sphere(SphereEmitter { center, radius }) => {
                (Emitter::Sphere(SphereEmitter { center: scale * center, radius: scale * radius }), 1.0)
            }
            ref other => (other.clone(), 1.0),
        };
        let at = ShadingPoint { p: scale * scene.at.p, ..scene.at };
        let scaled = Scene { emitter, at, lobe: scene.lobe.clone() };
        for method in scene.methods() {
            let x = scaled.respond(method);
            let x = Response { irradiance: x.irradiance * factor, specular: x.specular * factor };
            same("scaled", scene.respond(method), x, scene.bounds(), &scene);
        }
    }
}

#[test]
fn far_lights_are_point_lights() {
    let mut random = Random::new(14);
    for _ in 0..cases_wanted(MODELS * CASES) {
        let mut scene = Scene::random(&mut random);
        let away = 1e5 * random.direction();
        match &mut scene.emitter {
            Emitter::Line(light) => *light = LineEmitter { a: light.a + away, b: light.b + away, ..*light },
            Emitter::Sphere(light) => light.center += away,
            _ => {}
        }
        let (middle, extent) = match &scene.emitter {
            Emitter::Line(light) => (light.middle(), light.length()),
            Emitter::Sphere(light) => (light.center, light.radius),
            _ => (DVec3::ZERO, 0.0),
        };
        if scene.at.n.dot(middle - scene.at.p).abs() <= extent {
            // The horizon parts the light, but never a point.
            continue;
        }
        let point = scene.respond(Method::Point);
        let exact = scene.respond(Method::Exact);
        // The light is 2e-4 of its distance wide at most, and its lobe changes m times as fast as that.
        let scale = match &scene.emitter {
            Emitter::Line(light) => {
                light.tube.map_or(1.0, |radius| 2.0 * radius) * light.length()
                    / light.middle().length().powf(light.falloff)
            }
            Emitter::Sphere(light) => PI * (light.radius / light.center.length()).powi(2),
            _ => 0.0,
        };
        let m = scene.lobe.exponent();
        let irradiance = (exact.irradiance - point.irradiance).abs() / scale;
        let specular = (exact.specular - point.specular).abs() / (scale * (m + 1.0) / TAU);
        assert!(irradiance <= 2e-4 && specular <= 4e-8 * m * m + 4e-4, "{exact:?}, {point:?} for {scene:?}");
    }
}

#[test]
fn tilting_a_surface_makes_no_jumps() {
    let mut random = Random::new(15);
    const STEPS: i32 = 2000;
    for _ in 0..60 {
        let mut scene = Scene::random(&mut random);
        scene.lobe = PhongLobe::new(random.magnitude(1.0, 30.0));
        let [irradiance, _] = scene.bounds();
        let (x, y) = (scene.at.n, scene.at.n.any_orthonormal_vector());
        for method in [Method::Exact, Method::Hermite1, Method::Hermite2, Method::CHEBYSHEV] {
            let mut before: Option<f64> = None;
            for i in 0..=STEPS {
                let (sin, cos) = (TAU * f64::from(i) / f64::from(STEPS)).sin_cos();
                scene.at.n = cos * x + sin * y;
                let now = scene.respond(method).irradiance;
                let step = before.map_or(0.0, |before| (now - before).abs());
                // No slope is steeper than twice that of all the light at right angles.
                let most = 2.0 * irradiance * TAU / f64::from(STEPS);
                assert!(step <= most, "{method}: a step of {step} > {most} at {i} for {scene:?}");
                before = Some(now);
            }
        }
    }
}

/// Vectors in whose horizons forms change over: a line's ends and foot; of a sphere, with the sine of the angle.
fn critical_directions(scene: &Scene) -> Vec<(DVec3, f64)> {
    match scene.emitter {
        Emitter::Line(LineEmitter { a, b, .. }) => {
            let (a, b) = (a - scene.at.p, b - scene.at.p);
            let axis = (b - a).normalize();
            [a, b, a - a.dot(axis) * axis].map(|v| (v.normalize(), 0.0)).to_vec()
        }
        Emitter::Sphere(SphereEmitter { center, radius }) => {
            let to_center = center - scene.at.p;
            let sine = radius / to_center.length();
            if sine < 1.0 { [sine, -sine, 0.0].map(|sine| (to_center.normalize(), sine)).to_vec() } else { Vec::new() }
        }
        _ => Vec::new(),
    }
}

#[test]
fn nothing_jumps_where_a_horizon_meets_a_light() {
    const STEP: f64 = 1e-10;
    let mut random = Random::new(18);
    for _ in 0..cases_wanted(MODELS * CASES / 4) {
        let scene = Scene::random(&mut random);
        let [irradiance, specular] = scene.bounds();
        for (direction, sine) in critical_directions(&scene) {
            let across = random.direction().cross(direction).normalize();
            let turned = |by: f64| (1.0 - (sine + by) * (sine + by)).max(0.0).sqrt() * across + (sine + by) * direction;
            for method in [Method::Exact, Method::CHEBYSHEV, Method::Hermite1, Method::Hermite2] {
                // The surface's horizon, then the lobe's, which is the surface's too for an eye along the normal.
                let [before, after] = [-STEP, STEP].map(|by| {
                    let at = ShadingPoint { n: turned(by), v: turned(by), ..scene.at };
                    respond(&scene.emitter, method, &at, &scene.lobe)
                });
                let r = [-STEP, STEP].map(turned);
                let [lobe_before, lobe_after] = r.map(|r| {
                    let at = ShadingPoint { v: 2.0 * scene.at.n.dot(r) * scene.at.n - r, ..scene.at };
                    respond(&scene.emitter, method, &at, &scene.lobe)
                });
                let jumps = [
                    (before.irradiance - after.irradiance) / irradiance,
                    (before.specular - after.specular) / specular,
                    (lobe_before.specular - lobe_after.specular) / specular,
                ];
                // A cap's irradiance turns with the square root of nothing steeper than its sine.
                assert!(jumps.iter().all(|jump| jump.abs() <= 1e-8), "{method}: {jumps:?} for {scene:?}, {direction}");
            }
        }
    }
}

#[test]
fn a_line_has_one_irradiance_whichever_form_finds_it() {
    let mut random = Random::new(19);
    for _ in 0..cases_wanted(CASES) {
        let scene = Scene::random(&mut random);
        let Emitter::Line(light) = &scene.emitter else { continue };
        let [scale, _] = scene.bounds();
        let (alone, whole) = (line_irradiance(light, scene.at.p, scene.at.n), scene.respond(Method::Exact).irradiance);
        assert!((alone - whole).abs() <= 1e-14 * scale + 1e-12 * whole, "{alone} and {whole} for {scene:?}");
    }
}

#[test]
fn exact_lies_in_the_band_of_the_reference() {
    let mut random = Random::new(20);
    for _ in 0..cases_wanted(400) {
        let scene = Scene::random(&mut random);
        let exact = scene.respond(Method::Exact);
        let band = reference(&scene.emitter, &scene.at, &scene.lobe);
        for (x, band) in [(exact.irradiance, band.irradiance), (exact.specular, band.specular)] {
            let off = (x - band.value).abs();
            assert!(off <= band.error + 1e-13 + 1e-10 * x, "{x:e} is {off:e} off {band:?} for {scene:?}");
        }
    }
}

#[test]
fn degenerate_places_give_finite_numbers() {
    let (a, b) = (DVec3::new(-1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0));
    let lines = [(a, b), (a, a), (a, a + 1e-300 * DVec3::X), (a, a + 1e12 * DVec3::X)];
    let spheres = [1e-300, 1e-9, 1.0, 1e9];
    let mut emitters = Vec::new();
    for falloff in [0.0, 0.5, 1.0, 2.0, 2.5, 3.0] {
        for tube in [None, Some(1e-3)] {
            emitters.extend(lines.map(|(a, b)| Emitter::Line(LineEmitter { a, b, falloff, tube })));
        }
    }
    emitters.extend(spheres.map(|radius| Emitter::Sphere(SphereEmitter { center: a, radius })));
    let offsets = [0.0, 1e-300, 1e-60, 1e-30, 1e-12, 1e-6, 1.0];
    let directions = [DVec3::X, -DVec3::X, DVec3::Y, DVec3::Z, -DVec3::Z];
    for emitter in &emitters {
        for base in [a, b, a.midpoint(b), 3.0 * b - 2.0 * a, DVec3::ZERO] {
            for (offset, n) in offsets.iter().flat_map(|offset| directions.map(|n| (offset, n))) {
                let scene = Scene {
                    emitter: emitter.clone(),
                    at: ShadingPoint { p: base + *offset * DVec3::Z, n, v: n },
                    lobe: PhongLobe::new(20.5),
                };
                for method in scene.methods() {
                    let x = scene.respond(method);
                    assert!(x.irradiance.is_finite() && x.irradiance >= 0.0, "{method}: {x:?} for {scene:?}");
                    assert!(x.specular.is_finite() && x.specular >= 0.0, "{method}: {x:?} for {scene:?}");
                }
            }
        }
    }
}

#[test]
fn real_falloffs_match_quadrature_along_the_line() {
    let mut random = Random::new(16);
    for _ in 0..300 {
        let (a, b) = (random.point(2.0), random.point(2.0));
        let (n, r, m) = (random.direction(), random.direction(), random.magnitude(1.0, 300.0));
        let tube = (random.within(0.0, 1.0) < 0.5).then_some(0.5);
        let light = LineEmitter { a, b, falloff: random.within(0.0, 3.0), tube };
        let length = light.length();
        let axis = (b - a) / length;
        let integrate = |f: &dyn Fn(DVec3) -> f64| {
            let g = |t: f64| {
                let x = a.lerp(b, t);
                let emitted = if tube.is_some() { axis.cross(x.normalize()).length() } else { 1.0 };
                emitted * f(x.normalize()) / x.length().powf(light.falloff)
            };
            length * refined_panels(0.0, 1.0, 0.01, 1e-13, g)
        };
        let irradiance = integrate(&|w| n.dot(w).max(0.0));
        let specular = integrate(&|w| if n.dot(w) > 0.0 { r.dot(w).max(0.0).powf(m) } else { 0.0 });
        let x = [line_irradiance(&light, DVec3::ZERO, n), line_phong(&light, DVec3::ZERO, n, r, m)];
        let near = |x: f64, y: f64| (x - y).abs() <= 1e-8 * y + 1e-9;
        assert!(near(x[0], irradiance) && near(x[1], specular), "{x:?} for {irradiance}, {specular} of {light:?}");
    }
}

#[test]
fn points_of_a_polygons_cluster_share_its_area_inside() {
    let concave = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (3.0, 3.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)];
    let polygon = Polygon { vertices: concave.map(|(x, y)| DVec2::new(x, y)).to_vec(), two_sided: false };
    let light = polygon.place(&glam::DAffine3::IDENTITY);
    for count in [1, 2, 7, 16, 100] {
        let points = polygon_points(&light, count);
        assert_eq!(points.len(), count as usize, "as many points as asked for");
        let area: f64 = points.iter().map(|point| point.area).sum();
        assert!((area - 8.0).abs() < 1e-12, "{count} points share {area} of 8");
        for point in points {
            let DVec3 { x, y, .. } = point.position;
            let inside = (0.0..=4.0).contains(&x) && (0.0..=3.0).contains(&y) && (y <= 1.0 || x <= 1.0 || x >= 3.0);
            assert!(inside, "{} is outside", point.position);
        }
    }
}

#[test]
fn large_clusters_tend_to_the_exact_answer() {
    let mut random = Random::new(17);
    for _ in 0..200 {
        let mut scene = Scene::random(&mut random);
        scene.lobe = PhongLobe::new(random.magnitude(1.0, 50.0));
        let [irradiance, specular] = scene.bounds();
        let (x, y) = (scene.respond(Method::Exact), scene.respond(Method::PointCluster(2000)));
        let off = [(x.irradiance - y.irradiance) / irradiance, (x.specular - y.specular) / specular];
        assert!(off[0].abs() <= 1e-3 && off[1].abs() <= 1e-3, "{x:?}, {y:?} for {scene:?}");
    }
}
