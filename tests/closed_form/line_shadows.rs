//! Lines behind things: what is shaded of them, against a sum over points that rays see.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use softbox::light::{Emitter, Light, Line, LineEmitter, Shape as LightShape};
use softbox::render::{Lighting, MethodChoice, Outgoing, Reflection};
use softbox::scene::Scene;
use softbox::shading::point::falloff_response;
use softbox::shading::{Lobe, Method, Response, ShadingPoint};
use softbox::surface::{Material, Shape, Surface};
use softbox::visibility::{Objects, Structure};

use crate::random::Random;

const EXPONENT: f64 = 20.0;

/// Points on a light.
const POINTS: u32 = 4000;

fn occluder(random: &mut Random) -> Surface {
    let mut size = || random.within(0.3, 1.2);
    let shapes = [
        Shape::Sphere { radius: 0.5 * size() },
        Shape::Box { size: DVec3::new(size(), size(), size()) },
        Shape::Square { size: DVec2::new(size(), size()) },
        Shape::Disk { radius: 0.5 * size() },
        Shape::Cylinder { radius: 0.5 * size(), height: size() },
        Shape::Cone { radius: 0.5 * size(), height: size() },
    ];
    Surface {
        name: "occluder".to_owned(),
        material: "any".to_owned(),
        position: DVec3::Z + random.point(1.0),
        rotation_deg: random.point(180.0),
        scale: DVec3::splat(1.1) + random.point(0.5),
        shape: shapes[random.below(shapes.len())].clone(),
    }
}

fn point(random: &mut Random) -> ShadingPoint {
    let n = (DVec3::Z + random.point(0.5)).normalize();
    let p = random.point(1.5) * DVec3::new(1.0, 1.0, 0.3);
    ShadingPoint { p, n, v: (n + random.point(0.8)).normalize() }
}

/// What a line does by a method at a point that objects hide it from.
fn shaded(light: &Light, method: Method, objects: &Arc<Objects>, at: &ShadingPoint) -> [f64; 2] {
    let scene = Scene { lights: vec![light.clone()], ..Scene::default() };
    let material = Material {
        name: "glossy".to_owned(),
        diffuse: DVec3::ZERO,
        specular: DVec3::ONE,
        model: Default::default(),
        exponent: EXPONENT,
    };
    let lighting = Lighting::new(&scene, MethodChoice::Method(method)).with_shadows(objects);
    let Outgoing { irradiance, radiance } = lighting.outgoing(&Reflection::new(&material), at);
    [irradiance.x, radiance.x]
}

/// The sum over its points, and the most that one of them adds.
fn summed(light: &LineEmitter, objects: &Objects, at: &ShadingPoint) -> ([f64; 2], [f64; 2]) {
    let lobe = Lobe::new(EXPONENT);
    let intensity = light.length() / f64::from(POINTS);
    let (mut sum, mut most) = ([0.0_f64; 2], [0.0_f64; 2]);
    for i in 0..POINTS {
        let to_light = light.a.lerp(light.b, (f64::from(i) + 0.5) / f64::from(POINTS)) - at.p;
        let Response { irradiance, specular } =
            falloff_response(to_light, intensity, light.falloff, at.n, at.mirror(), &lobe);
        let one = [irradiance, specular];
        most = [0, 1].map(|part| most[part].max(one[part]));
        if irradiance > 0.0 && !objects.hides(at.p, to_light) {
            sum = [0, 1].map(|part| sum[part] + one[part]);
        }
    }
    (sum, most)
}

#[test]
fn what_is_seen_of_a_line_is_shaded_as_the_points_are_that_rays_see() {
    let mut random = Random::new(11);
    let mut partly = 0;
    for _ in 0..300 {
        let surfaces: Vec<Surface> = (0..=random.below(4)).map(|_| occluder(&mut random)).collect();
        let objects = Arc::new(Objects::new(&surfaces, Structure::default()));
        let line = Line { falloff: if random.below(2) == 0 { 2.0 } else { 1.0 }, ..Line::isotropic(3.0) };
        let position = DVec3::new(0.0, 0.0, 2.5) + random.point(0.5);
        let light = Light { position, rotation_deg: random.point(90.0), ..Light::new("line", LightShape::Line(line)) };
        let Emitter::Line(emitter) = light.emitter() else { panic!("a line is a line") };
        let at = point(&mut random);
        let (sum, most) = summed(&emitter, &objects, &at);
        let strength = light.weight().x;
        let exact = shaded(&light, Method::Exact, &objects, &at);
        for part in [0, 1] {
            // Half a point at each end of a segment; faint highlights are exact to rounding of the brightest.
            let tolerance = strength * (3.0 * most[part] + 1e-12 * most[0]);
            let difference = (exact[part] - strength * sum[part]).abs();
            assert!(
                difference <= tolerance,
                "{difference:e} of {tolerance:e} in part {part} at {at:?}\nof {surfaces:?}"
            );
        }
        partly += u32::from(sum[0] > 0.0 && objects.hides(at.p, light.position - at.p));
    }
    assert!(partly > 30, "only {partly} lines are seen in part");
}

#[test]
fn methods_share_their_shadows() {
    let square = Surface {
        name: "half".to_owned(),
        material: "any".to_owned(),
        position: DVec3::new(5.0, 0.0, 1.0),
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape: Shape::Square { size: DVec2::splat(10.0) },
    };
    let light = Light { position: 2.0 * DVec3::Z, ..Light::new("line", LightShape::Line(Line::isotropic(2.0))) };
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    let half = Arc::new(Objects::new(&[square], Structure::Every));
    let open = Arc::new(Objects::new(&[], Structure::Every));
    for method in [Method::Exact, Method::Point, Method::NearestPoint, Method::PointCluster(7), Method::Reference] {
        let [seen, whole] = [&half, &open].map(|objects| shaded(&light, method, objects, &at));
        for part in [0, 1] {
            let share = seen[part] / whole[part];
            assert!((share - 0.5).abs() < 1e-8, "{method} sees {share} of part {part}");
        }
    }
}
