//! Shadows by rays against what is known of them.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3, dvec2};

use super::*;
use crate::light::pattern::{Channel, Image, Pattern};
use crate::light::{Cap, Disk, Light, Polygon, Shape as LightShape, Sky, Sphere, Textured};
use crate::surface::{Shape, Surface};
use crate::visibility::Structure;

/// Uniform numbers from 0 to 1, reproducible.
struct Random(u64);

impl Random {
    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn next(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.bits() % count as u64).expect("it is below a usize")
    }

    fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    fn vector(&mut self, extent: f64) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| self.within(-extent, extent)))
    }

    fn direction(&mut self) -> DVec3 {
        let z: f64 = self.within(-1.0, 1.0);
        let (sin, cos) = self.within(0.0, TAU).sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cos, radius * sin, z)
    }
}

fn pattern() -> Pattern {
    let channel = Channel::of_shares(8, 6, |u, v| if (u - 0.3).hypot(v - 0.6) < 0.35 { 1.0 + 2.0 * u } else { 0.0 });
    Pattern::of_image("spot.png", Image::Grey(Arc::new(channel.expect("a pattern"))))
}

/// Every shape that rays sample, of everyday size.
fn shapes() -> Vec<(&'static str, LightShape)> {
    let l_shape = [[-0.5, -0.5], [0.7, -0.5], [0.7, 0.0], [0.0, 0.0], [0.0, 0.6], [-0.5, 0.6]].map(DVec2::from_array);
    vec![
        ("sphere", LightShape::Sphere(Sphere { radius: 0.4 })),
        ("disk", LightShape::Disk(Disk { radius: 0.6, two_sided: false })),
        ("textured", LightShape::Textured(Textured { size: dvec2(1.4, 0.9), pattern: pattern(), two_sided: false })),
        ("polygon", LightShape::Polygon(Polygon { vertices: l_shape.to_vec(), two_sided: false })),
        ("cap", LightShape::Cap(Cap { half_angle_deg: 20.0 })),
        ("wide cap", LightShape::Cap(Cap { half_angle_deg: 85.0 })),
        ("sky", LightShape::Sky(Sky::OVERCAST)),
    ]
}

fn emitter(shape: &LightShape, position: DVec3, rotation_deg: DVec3) -> Emitter {
    Light { position, rotation_deg, ..Light::new("light", shape.clone()) }.emitter()
}

fn surface(shape: Shape, position: DVec3, rotation_deg: DVec3) -> Surface {
    let (name, material) = ("s".to_owned(), "m".to_owned());
    Surface { name, material, position, rotation_deg, scale: DVec3::ONE, shape }
}

fn primitives() -> [Shape; 7] {
    [
        Shape::Plane {},
        Shape::Sphere { radius: 0.5 },
        Shape::Box { size: DVec3::new(0.8, 0.6, 0.5) },
        Shape::Square { size: DVec2::new(0.7, 0.9) },
        Shape::Disk { radius: 0.5 },
        Shape::Cylinder { radius: 0.4, height: 0.8 },
        Shape::Cone { radius: 0.5, height: 0.7 },
    ]
}

fn lobes() -> [(&'static str, Lobe); 7] {
    [
        ("Phong 1", Lobe::new(1.0)),
        ("Phong 40.5", Lobe::new(40.5)),
        ("Phong 1000", Lobe::new(1000.0)),
        ("Blinn 60", Lobe::blinn(60.0)),
        ("Cook-Torrance 0.1", Lobe::cook_torrance(0.1, 0.3)),
        ("Cook-Torrance 0.4", Lobe::cook_torrance(0.4, 0.3)),
        ("Lafortune 30", Lobe::lafortune(30.0, -1.2, 0.7)),
    ]
}

fn casters(surfaces: &[Surface]) -> Casters {
    Casters::new(&Arc::new(Objects::new(surfaces, Structure::default())))
}

/// The shares of the exact response that are seen, if anything may be between.
fn shares_of(casters: &Casters, emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe) -> Option<Shares> {
    let source = Source::new(emitter).expect("rays sample it");
    casters.shares(&source, at, lobe, 1.0)
}

/// A point whose eye is in the mirror direction of `r`.
fn point_reflecting(p: DVec3, n: DVec3, r: DVec3) -> ShadingPoint {
    ShadingPoint { p, n, v: 2.0 * n.dot(r) * n - r }
}

/// The shares by `count` rays in random directions: over the light's points or
/// directions for E, and the same weighed by the lobe for S; and their own standard errors, at most.
fn dense_shares(casters: &Casters, emitter: &Emitter, at: &ShadingPoint, lobe: &Lobe, count: u32) -> [[f64; 2]; 2] {
    let mut random = Random(7);
    let (seen_by_lobe, _) = lobe.seen(at);
    let r = seen_by_lobe.mirror();
    let (mut all, mut seen, mut squares) = ([0.0; 2], [0.0; 2], [0.0; 2]);
    for _ in 0..count {
        let (to_light, weight, is_endless) = random_point(emitter, at.p, &mut random);
        let w = to_light.normalize_or_zero();
        if at.n.dot(w) <= 0.0 || weight == 0.0 {
            continue;
        }
        let hidden =
            if is_endless { casters.objects.hides_direction(at.p, w) } else { casters.objects.hides(at.p, to_light) };
        for (part, density) in [at.n.dot(w), lobe.density(at.n, r, w)].into_iter().enumerate() {
            all[part] += weight * density;
            seen[part] += if hidden { 0.0 } else { weight * density };
            squares[part] += (weight * density).powi(2);
        }
    }
    [0, 1].map(|part| [seen[part] / all[part], 0.5 * squares[part].sqrt() / all[part]])
}

/// A point of a light, seen from p, with L dω over its density; whether it is infinitely far.
fn random_point(emitter: &Emitter, p: DVec3, random: &mut Random) -> (DVec3, f64, bool) {
    let flat = |x: DVec3, normal: DVec3, luminance: f64| {
        let to_light = x - p;
        (to_light, luminance * (-normal.dot(to_light)).max(0.0) / to_light.length().powi(3), false)
    };
    match emitter {
        Emitter::Sphere(light) => {
            let normal = random.direction();
            flat(light.center + light.radius * normal, normal, 1.0)
        }
        Emitter::Disk(light) => {
            let (x, y) = light.normal.any_orthonormal_pair();
            let (sin, cos) = random.within(0.0, TAU).sin_cos();
            let radius = light.radius * random.next().sqrt();
            flat(light.center + radius * (cos * x + sin * y), light.normal, 1.0)
        }
        Emitter::Textured(light) => {
            let (u, v) = (random.next(), random.next());
            flat(light.point(u, v), light.normal, light.pattern.value(u, v))
        }
        Emitter::Polygon(light) => {
            // A fan from the first corner; triangles that turn the other way count as taken off.
            let first = light.vertices[0];
            let fan = light.vertices.windows(2).map(|pair| [pair[0] - first, pair[1] - first]);
            let area = |[a, b]: [DVec3; 2]| light.normal.dot(a.cross(b));
            let whole: f64 = fan.clone().map(|triangle| area(triangle).abs()).sum();
            let mut left = random.next() * whole;
            let chosen = fan.into_iter().find(|&triangle| {
                left -= area(triangle).abs();
                left < 0.0
            });
            let [a, b] = chosen.unwrap_or_default();
            let (u, v) = (random.next().sqrt(), random.next());
            flat(first + u * (1.0 - v) * a + u * v * b, light.normal, area([a, b]).signum())
        }
        Emitter::Cap(light) => {
            let w = random.direction();
            (w, f64::from(u8::from(w.dot(light.to_center) >= light.half_angle.cos())), true)
        }
        Emitter::Sky(light) => {
            let w = random.direction();
            (w, light.radiance(w), true)
        }
        other => panic!("rays do not sample {other:?}"),
    }
}

/// A random scene with a light that shines on a point, and things between them.
fn scene(shape: &LightShape, random: &mut Random) -> (Casters, Emitter, ShadingPoint) {
    let primitive = |random: &mut Random| {
        let shapes = primitives();
        let shape = shapes[1 + random.below(6)].clone();
        surface(shape, DVec3::Z + random.vector(0.9), random.vector(180.0))
    };
    let surfaces: Vec<_> =
        (0..2).map(|_| primitive(random)).chain([surface(Shape::Plane {}, DVec3::ZERO, DVec3::ZERO)]).collect();
    let light = emitter(shape, DVec3::new(0.0, 0.0, 2.4) + random.vector(0.5), random.vector(40.0));
    let n = (DVec3::Z + random.vector(0.5)).normalize();
    let r = (DVec3::Z + random.vector(0.6)).normalize();
    let p = random.vector(0.8) * DVec3::new(1.0, 1.0, 0.0);
    (casters(&surfaces), light, point_reflecting(p, n, r))
}

#[test]
fn a_light_that_a_wall_halves_gives_half() {
    // The wall's edge is right above the point, and so is the light's middle.
    let wall = surface(Shape::Square { size: DVec2::splat(40.0) }, DVec3::new(20.0, 0.0, 1.0), DVec3::ZERO);
    let halved = casters(&[wall]);
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    let symmetric = shapes().into_iter().filter(|(name, _)| !["textured", "polygon", "wide cap", "sky"].contains(name));
    for (name, shape) in symmetric {
        let light = emitter(&shape, DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO);
        for (lobe_name, lobe) in lobes() {
            let Shares { shares, errors, .. } = shares_of(&halved, &light, &at, &lobe).expect("something is between");
            for part in 0..2 {
                let off = (shares[part] - 0.5).abs();
                assert!(off < 4.0 * errors[part], "{name}, {lobe_name}: {shares:?} ± {errors:?}");
            }
        }
    }
}

#[test]
fn a_wall_takes_from_a_uniform_sky_what_its_plane_cuts_off() {
    // A plane that leans by an angle over the point leaves a lune, of which E is π(1 + sin)/2.
    let sky = emitter(&LightShape::Sky(Sky { uniform: 1.0, cosine: 0.0 }), DVec3::ZERO, DVec3::ZERO);
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    for lean_deg in [-60.0, -20.0, 0.0_f64, 35.0, 70.0] {
        let lean = lean_deg.to_radians();
        // Towards the point its normal is (−cos, 0, sin).
        let wall = surface(Shape::Plane {}, DVec3::X, DVec3::new(0.0, 90.0 + lean_deg, 0.0));
        let found = shares_of(&casters(&[wall]), &sky, &at, &Lobe::new(1.0)).expect("something is between");
        let expected = 0.5 * (1.0 + lean.sin());
        let off = (found.shares[0] - expected).abs();
        assert!(off < 4.0 * found.errors[0], "{lean_deg}°: {found:?} is not {expected}");
    }
}

#[test]
fn the_stated_error_is_what_dense_rays_find() {
    const DENSE: u32 = 1 << 18;
    const SOUGHT: f64 = 0.02;
    let mut random = Random(1);
    let (mut within, mut count, mut worst) = ([0.0; 3], 0.0_f64, 0.0_f64);
    let lobe = Lobe::new(10.0);
    for (name, shape) in shapes() {
        for _ in 0..12 {
            let (casters, light, at) = scene(&shape, &mut random);
            let source = Source::new(&light).expect("rays sample it");
            let casters = casters.with_precision(Precision { error: SOUGHT, points: 1 << 16 });
            let Some(found) = casters.shares(&source, &at, &lobe, 1.0) else { continue };
            let dense = dense_shares(&casters, &light, &at, &lobe, DENSE);
            for (part, [share, own_error]) in dense.into_iter().enumerate() {
                let off = ((found.shares[part] - share).abs() - 2.0 * own_error).max(0.0);
                assert!(found.errors[part] <= SOUGHT, "{name}: as sought: {found:?}");
                (0..3_u8).zip(&mut within).for_each(|(i, within)| {
                    *within += f64::from(u8::from(off <= f64::from(i + 1) * found.errors[part]));
                });
                worst = worst.max(off);
                count += 1.0;
            }
        }
    }
    let shares = within.map(|within| within / count);
    assert!(
        shares[0] >= 0.85 && shares[1] >= 0.97 && shares[2] >= 0.99 && worst < 2.5 * SOUGHT,
        "{shares:?} of {count}, worst {worst}"
    );
}

/// The response to a light, by rays, with and without things in between.
fn with_and_without(surfaces: &[Surface], shape: &LightShape, at: &ShadingPoint, lobe: &Lobe) -> [Response; 2] {
    let light = emitter(shape, DVec3::new(0.3, -0.2, 2.5), DVec3::new(10.0, 5.0, 0.0));
    let prepared = Prepared::new(&light, Method::Exact);
    let shadow = Shadow::new(&light);
    let casters = casters(surfaces).with_precision(Precision::PICTURE);
    [casters.by_rays(&prepared, &shadow, at, lobe, [0.3, 1.0]), prepared.respond(at, lobe)]
}

#[test]
fn a_convex_surface_alone_casts_no_shadow_on_itself() {
    let mut random = Random(3);
    let lobe = Lobe::new(20.0);
    for (name, shape) in shapes() {
        for primitive in primitives() {
            let placed = surface(primitive.clone(), random.vector(0.3), random.vector(180.0));
            let objects = Objects::new(std::slice::from_ref(&placed), Structure::Every);
            let mut lit = 0;
            for _ in 0..40 {
                let origin = 4.0 * random.direction();
                let Some((_, hit)) = objects.nearest(origin, random.vector(0.5) - origin) else { continue };
                let v = (origin - hit.p).normalize();
                let at = ShadingPoint { p: hit.p, n: if hit.n.dot(v) < 0.0 { -hit.n } else { hit.n }, v };
                let [with, without] = with_and_without(std::slice::from_ref(&placed), &shape, &at, &lobe);
                assert_eq!(with, without, "{name} on {primitive:?} at {at:?}");
                lit += u32::from(with.irradiance > 0.0);
            }
            assert!(lit > 2, "{name} shines on {primitive:?} {lit} times");
        }
    }
}

#[test]
fn what_stands_aside_or_behind_changes_nothing_to_the_last_bit() {
    let at = point_reflecting(DVec3::ZERO, DVec3::Z, DVec3::new(0.1, 0.2, 1.0).normalize());
    // Below the horizon, beyond lights that end, beside all cones, and a ceiling far above.
    let below = surface(Shape::Sphere { radius: 1.0 }, DVec3::new(0.5, 0.0, -1.001), DVec3::ZERO);
    let floor = surface(Shape::Plane {}, DVec3::ZERO, DVec3::ZERO);
    let aside = surface(Shape::Box { size: DVec3::splat(0.5) }, DVec3::new(3.0, 0.0, 0.5), DVec3::new(20.0, 30.0, 5.0));
    let beyond = surface(Shape::Square { size: DVec2::splat(9.0) }, DVec3::new(0.0, 0.0, 3.3), DVec3::ZERO);
    for (name, shape) in shapes() {
        let is_wide = ["sky", "wide cap"].contains(&name);
        let is_endless = is_wide || name == "cap";
        let mut surfaces = vec![below.clone(), floor.clone()];
        surfaces.extend((!is_wide).then(|| aside.clone()));
        surfaces.extend((!is_endless).then(|| beyond.clone()));
        for (lobe_name, lobe) in lobes() {
            let [with, without] = with_and_without(&surfaces, &shape, &at, &lobe);
            assert_eq!(with, without, "{name}, {lobe_name}");
            assert!(with.irradiance > 0.0, "{name} shines");
        }
    }
}

#[test]
fn behind_a_screen_it_is_dark() {
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    let lid = surface(Shape::Square { size: DVec2::splat(500.0) }, DVec3::new(0.0, 0.0, 0.5), DVec3::ZERO);
    // Two halves, neither of which hides a light alone.
    let halves = [-6.0, 6.0]
        .map(|x| surface(Shape::Box { size: DVec3::new(12.5, 60.0, 0.1) }, DVec3::new(x, 0.0, 0.4), DVec3::ZERO));
    let room = surface(Shape::Box { size: DVec3::splat(1.0) }, DVec3::ZERO, DVec3::ZERO);
    for (name, shape) in shapes() {
        for (lobe_name, lobe) in lobes() {
            let mut screens = vec![std::slice::from_ref(&room)];
            if !["sky", "wide cap"].contains(&name) {
                screens.extend([std::slice::from_ref(&lid), &halves]);
            }
            for (i, screen) in screens.into_iter().enumerate() {
                let [with, without] = with_and_without(screen, &shape, &at, &lobe);
                assert_eq!(with, Response::default(), "{name}, {lobe_name}, screen {i}");
                assert!(without.irradiance > 0.0, "{name} would shine");
            }
        }
    }
}

#[test]
fn a_room_hides_nothing_of_what_is_in_it() {
    let room = surface(Shape::Box { size: DVec3::splat(6.0) }, DVec3::new(0.0, 0.0, 3.0), DVec3::ZERO);
    let in_room = shapes().into_iter().filter(|(name, _)| !["sky", "cap", "wide cap"].contains(name));
    for (name, shape) in in_room {
        for p in [DVec3::new(0.5, 0.2, 1.0), DVec3::new(1.0, -0.5, 0.0)] {
            let at = ShadingPoint { p, n: DVec3::Z, v: DVec3::Z };
            let [with, without] = with_and_without(std::slice::from_ref(&room), &shape, &at, &Lobe::new(5.0));
            assert_eq!(with, without, "{name} from {p}");
        }
    }
}

#[test]
fn inside_a_spherical_light_what_is_in_it_casts_shadows() {
    let light = emitter(&LightShape::Sphere(Sphere { radius: 2.0 }), DVec3::ZERO, DVec3::ZERO);
    let at = ShadingPoint { p: DVec3::new(0.0, 0.0, -0.5), n: DVec3::Z, v: DVec3::Z };
    // E of a disk of half-angle 45° about the normal is half of π.
    let disk = |z: f64| surface(Shape::Disk { radius: z + 0.5 }, DVec3::new(0.0, 0.0, z), DVec3::ZERO);
    let found = shares_of(&casters(&[disk(0.5)]), &light, &at, &Lobe::new(1.0)).expect("something is between");
    assert!((found.shares[0] - 0.5).abs() < 4.0 * found.errors[0], "{found:?}");
    let outside = shares_of(&casters(&[disk(2.5)]), &light, &at, &Lobe::new(1.0));
    assert_eq!(outside.map(|found| found.shares), Some([1.0, 1.0]), "outside of the light nothing is in its way");
}

#[test]
fn what_finds_the_objects_changes_nothing_to_the_last_bit() {
    let mut random = Random(5);
    for (name, shape) in shapes() {
        let light = emitter(&shape, DVec3::new(0.2, 0.1, 2.5), DVec3::new(5.0, 10.0, 0.0));
        let surfaces: Vec<_> = (0..40)
            .map(|i| surface(primitives()[1 + i % 6].clone(), DVec3::Z + random.vector(2.0), random.vector(180.0)))
            .collect();
        for _ in 0..4 {
            let at = point_reflecting(random.vector(1.0) * DVec3::new(1.0, 1.0, 0.0), DVec3::Z, DVec3::Z);
            let [every, hierarchy] = [Structure::Every, Structure::Hierarchy].map(|structure| {
                let casters = Casters::new(&Arc::new(Objects::new(&surfaces, structure)));
                let casters = casters.with_precision(Precision::PICTURE);
                let found = shares_of(&casters, &light, &at, &Lobe::new(9.0));
                found.map_or([1.0, 1.0], |found| found.shares)
            });
            assert_eq!(every, hierarchy, "{name} at {at:?}");
        }
    }
}
