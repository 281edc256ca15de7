use std::f64::consts::{FRAC_1_PI, PI};

use std::sync::Arc;

use super::*;
use crate::light::pattern::{Channel, Image, Pattern};
use crate::light::{
    Cap, Directional, Disk, Light, Line, Point, Polygon, Quantity, QuantityKind, Shape as LightShape, Sky, Sphere,
    Textured, Tint,
};
use crate::surface::{Material, ReflectionModel, Shape, Surface};
use crate::visibility::Structure;

const SIZE: [u32; 2] = [70, 50];

/// A sphere and a plane under a directional light of `illuminance` from above.
fn furnace(illuminance: f64, diffuse: DVec3) -> Scene {
    let surface = |name: &str, shape, position| Surface {
        name: name.to_owned(),
        material: "m".to_owned(),
        position,
        rotation_deg: DVec3::ZERO,
        scale: DVec3::ONE,
        shape,
    };
    Scene {
        materials: vec![Material {
            name: "m".to_owned(),
            diffuse,
            specular: DVec3::ZERO,
            model: ReflectionModel::default(),
            exponent: 1.0,
        }],
        surfaces: vec![
            surface("floor", Shape::Plane {}, DVec3::ZERO),
            surface("ball", Shape::Sphere { radius: 0.5 }, DVec3::new(0.0, 0.0, 0.5)),
        ],
        lights: vec![Light {
            name: "sun".to_owned(),
            position: DVec3::ZERO,
            rotation_deg: DVec3::ZERO,
            tint: Tint::default(),
            quantity: Quantity::new(QuantityKind::Illuminance, illuminance),
            muted: false,
            group: None,
            only: None,
            shape: LightShape::Directional(Directional {}),
        }],
        ..Scene::default()
    }
}

fn picture(scene: &Scene, samples: u32) -> Film {
    let settings = Settings { size: SIZE, choice: MethodChoice::default(), samples, shadows: Shadows::default() };
    render(scene, &settings, &Progress::default()).unwrap()
}

#[test]
fn every_pixel_of_a_lit_ball_and_floor_has_its_known_radiance() {
    let diffuse = DVec3::new(0.2, 0.5, 0.8);
    let scene = furnace(1000.0, diffuse);
    let film = picture(&scene, 1);
    let geometry = Geometry::new(&scene);
    let mut seen = [0; 3];
    for (i, radiance) in film.radiance().iter().enumerate() {
        let (x, y) = (i % 70, i / 70);
        let direction = scene.camera.ray_direction(x as f64 + 0.5, y as f64 + 0.5, 70.0, 50.0);
        let hit = geometry.nearest(scene.camera.eye, direction);
        // The shadow is right below the ball.
        let is_hidden = |hit: &Seen| hit.thing == Thing::Surface(0) && hit.p.truncate().length() < 0.5;
        let lit = hit.filter(|hit| !is_hidden(hit));
        let expected = lit.map_or(DVec3::ZERO, |hit| FRAC_1_PI * 1000.0 * hit.n.z.max(0.0) * diffuse);
        assert!((radiance - expected).length() < 1e-10, "pixel {x}, {y}: {radiance} is not {expected}");
        seen[hit.map_or(2, |hit| usize::from(hit.thing == Thing::Surface(1)))] += 1;
    }
    assert!(seen.iter().all(|&count| count > 50), "floor, ball and sky are all in view: {seen:?}");
}

#[test]
fn twice_the_light_is_twice_the_radiance_and_a_muted_one_is_none() {
    let once = picture(&furnace(500.0, DVec3::splat(0.5)), 4);
    let twice = picture(&furnace(1000.0, DVec3::splat(0.5)), 4);
    for (a, b) in once.radiance().iter().zip(twice.radiance()) {
        assert!((2.0 * a - b).length() <= 1e-12 * b.length(), "{a} and {b}");
    }
    let mut muted = furnace(500.0, DVec3::splat(0.5));
    muted.lights[0].muted = true;
    assert!(picture(&muted, 1).radiance().iter().all(|radiance| *radiance == DVec3::ZERO), "muted");
}

#[test]
fn a_linked_light_reaches_its_surfaces_only_and_the_others_still_shade_them() {
    let whole = picture(&furnace(1000.0, DVec3::ONE), 1);
    let mut scene = furnace(1000.0, DVec3::ONE);
    let geometry = Geometry::new(&scene);
    let mut check = |only: &[&str]| {
        scene.lights[0].only = Some(only.iter().map(|&name| name.to_owned()).collect());
        for (i, (linked, whole)) in picture(&scene, 1).radiance().iter().zip(whole.radiance()).enumerate() {
            let (x, y) = ((i % 70) as f64 + 0.5, (i / 70) as f64 + 0.5);
            let seen = geometry.nearest(scene.camera.eye, scene.camera.ray_direction(x, y, 70.0, 50.0));
            let is_linked = |seen: &Seen| match seen.thing {
                Thing::Surface(surface) => only.contains(&scene.surfaces[surface].name.as_str()),
                Thing::Light(_) => true,
            };
            let expected = if seen.as_ref().is_some_and(is_linked) { *whole } else { DVec3::ZERO };
            assert_eq!(*linked, expected, "pixel {x}, {y} of {only:?}");
        }
    };
    check(&["ball"]);
    // The ball's shadow stays on the floor.
    check(&["floor"]);
    check(&[]);
}

#[test]
fn a_sphere_light_is_seen_with_its_luminance() {
    let mut scene = furnace(0.0, DVec3::ONE);
    scene.lights[0].shape = LightShape::Sphere(Sphere { radius: 0.5 });
    scene.lights[0].quantity = Quantity::new(QuantityKind::Flux, 4.0 * PI * PI * 0.25 * 300.0);
    scene.lights[0].position = DVec3::new(0.0, -1.0, 0.5);
    let film = picture(&scene, 1);
    let middle = film.radiance()[25 * 70 + 35];
    assert!((middle - 300.0).length() < 1e-10, "{middle}");
}

#[test]
fn the_picture_does_not_depend_on_the_number_of_threads() {
    let scene = furnace(1000.0, DVec3::splat(0.5));
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    assert!(one.install(|| picture(&scene, 5)) == three.install(|| picture(&scene, 5)), "pictures differ");
}

#[test]
fn a_cancelled_picture_is_none() {
    let progress = Progress::default();
    progress.cancel();
    let settings = Settings { size: SIZE, choice: MethodChoice::default(), samples: 1, shadows: Shadows::default() };
    assert_eq!(render(&furnace(1.0, DVec3::ONE), &settings, &progress), None, "cancelled before it began");
    assert_eq!(progress.done(), 0, "nothing was done");
}

#[test]
fn progress_counts_every_pixel() {
    let progress = Progress::default();
    let settings = Settings { size: SIZE, choice: MethodChoice::default(), samples: 1, shadows: Shadows::default() };
    assert!(render(&furnace(1.0, DVec3::ONE), &settings, &progress).is_some(), "not cancelled");
    assert_eq!(progress.done(), 70 * 50, "all pixels");
}

#[test]
fn samples_of_a_pixel_are_stratified_and_one_is_its_centre() {
    assert_eq!(pixel_offsets(1), [DVec2::splat(0.5)], "one sample");
    for samples in [2_u32, 4, 16, 64] {
        let n = samples as usize;
        for axis in 0..2 {
            let mut strata: Vec<_> =
                pixel_offsets(samples).iter().map(|offset| (offset[axis] * f64::from(samples)).floor()).collect();
            strata.sort_by(f64::total_cmp);
            assert!(strata.iter().enumerate().all(|(i, s)| *s == i as f64), "axis {axis} of {n}: {strata:?}");
        }
    }
}

#[test]
fn the_first_rays_of_a_pixel_lie_in_different_quarters_both_ways() {
    for axis in 0..2 {
        let mut quarters: Vec<_> =
            pixel_offsets(16)[..SCOUTS].iter().map(|offset| (4.0 * offset[axis]).floor()).collect();
        quarters.sort_by(f64::total_cmp);
        assert_eq!(quarters, [0.0, 1.0, 2.0, 3.0], "axis {axis}");
    }
}

#[test]
fn a_pixel_with_an_edge_has_all_its_rays_and_an_even_one_a_few() {
    let mut scene = furnace(0.0, DVec3::ONE);
    scene.lights[0].shape = LightShape::Sphere(Sphere { radius: 0.5 });
    scene.lights[0].quantity = Quantity::new(QuantityKind::Luminance, 100.0);
    scene.surfaces.clear();
    // Black or 100 cd/m²: a mean over 16 rays is a multiple of 6.25, one over 4 a multiple of 25.
    let shares: Vec<_> = picture(&scene, 16).radiance().iter().map(|radiance| radiance.x / 6.25).collect();
    assert!(shares.iter().all(|share| (share - share.round()).abs() < 1e-9), "{shares:?}");
    assert!(shares.iter().any(|share| share.round() % 4.0 != 0.0), "no edge had all its rays");
    assert!(shares.iter().filter(|share| share.round() == 16.0).count() > 20, "the light is in view");
}

/// The furnace under a ball of light that stands behind its own, and its shadow's share of every pixel.
fn shadow_of_a_ball() -> Vec<f64> {
    let mut scene = furnace(0.0, DVec3::splat(0.5));
    scene.camera = Camera { eye: DVec3::new(0.0, -4.0, 4.0), target: DVec3::new(0.0, -0.6, 0.0), fov_deg: 40.0 };
    scene.lights[0].shape = LightShape::Sphere(Sphere { radius: 0.35 });
    scene.lights[0].quantity = Quantity::new(QuantityKind::Luminance, 1000.0);
    scene.lights[0].position = DVec3::new(0.0, 2.0, 2.5);
    let [with, without] = [Shadows::default(), Shadows::None].map(|shadows| {
        let settings = Settings { size: SIZE, choice: MethodChoice::default(), samples: 1, shadows };
        render(&scene, &settings, &Progress::default()).unwrap()
    });
    let pixels = with.radiance().iter().zip(without.radiance());
    pixels.map(|(with, without)| if without.x > 0.0 { with.x / without.x } else { 1.0 }).collect()
}

#[test]
fn a_balls_shadow_has_a_dark_core_and_grows_lighter_outward_on_both_sides_alike() {
    let allowed = 4.0 * Precision::PICTURE.error;
    let shares = shadow_of_a_ball();
    let width = SIZE[0] as usize;
    assert!(shares.iter().all(|share| (0.0..=1.0).contains(share)), "shares");
    assert!(shares.contains(&0.0) && shares.contains(&1.0), "there is a core, and there is full light");
    let mut penumbra = 0;
    // In front of the ball there is nothing but its shadow on the floor.
    for (y, row) in shares.chunks(width).enumerate().skip(24) {
        let (left, right) = row.split_at(width / 2);
        for (x, (a, b)) in left.iter().rev().zip(right).enumerate() {
            assert!((a - b).abs() < allowed, "row {y}, {x} from the middle: {a} and {b}");
        }
        for (x, pair) in right.windows(2).enumerate() {
            assert!(pair[1] > pair[0] - allowed, "row {y}, {x} from the middle: {pair:?}");
            penumbra += u32::from(pair[0] > 0.0 && pair[0] < 1.0);
        }
    }
    assert!(penumbra > 30, "{penumbra} pixels are half in shadow");
}

#[test]
fn a_soft_shadow_does_not_depend_on_the_number_of_threads() {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let three = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
    assert!(one.install(shadow_of_a_ball) == three.install(shadow_of_a_ball), "pictures differ");
}

/// One of each light, above a flake, a tetrahedron, a box and a floor.
fn everything() -> Scene {
    let mut scene = furnace(1000.0, DVec3::splat(0.5));
    let surface = |name: &str, position, shape| Surface {
        name: name.to_owned(),
        rotation_deg: DVec3::new(10.0, 20.0, 30.0),
        position,
        shape,
        ..scene.surfaces[0].clone()
    };
    let solids = [
        surface("flake", DVec3::new(-1.0, 0.0, 0.8), Shape::Sphereflake { depth: 1 }),
        surface("tetrahedron", DVec3::new(1.0, 0.0, 0.5), Shape::Tetrahedron { depth: 2 }),
        surface("box", DVec3::new(0.0, 1.0, 0.5), Shape::Box { size: DVec3::new(0.5, 0.7, 1.2) }),
    ];
    scene.surfaces.extend(solids);
    let square = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]].map(DVec2::from).to_vec();
    let checks = Channel::new(2, vec![1.0, 0.2, 0.2, 1.0]).expect("four texels");
    let pattern = Pattern::of_image("checks.png", Image::Grey(Arc::new(checks)));
    let shapes = [
        LightShape::Line(Line::isotropic(2.0)),
        LightShape::Line(Line::tube(1.0, 0.01)),
        LightShape::Polygon(Polygon { vertices: square, two_sided: false }),
        LightShape::Disk(Disk { radius: 0.5, two_sided: false }),
        LightShape::Sphere(Sphere { radius: 0.2 }),
        LightShape::Textured(Textured { size: DVec2::ONE, pattern, two_sided: false }),
        LightShape::Cap(Cap { half_angle_deg: 10.0 }),
        LightShape::Sky(Sky::OVERCAST),
        LightShape::Point(Point::default()),
    ];
    let lights = shapes.into_iter().enumerate().map(|(i, shape)| Light {
        position: DVec3::new(i as f64 - 4.0, 0.5, 3.0),
        rotation_deg: DVec3::new(15.0, 0.0, 10.0 * i as f64),
        ..Light::new(format!("{i}"), shape)
    });
    scene.lights.extend(lights);
    scene
}

#[test]
fn whatever_finds_the_objects_the_picture_is_the_same_to_the_last_bit() {
    let scene = everything();
    let picture = |structures: Structures| {
        let shadows = Shadows::Cast(structures);
        let settings = Settings { size: [24, 16], choice: MethodChoice::Approx, samples: 1, shadows };
        render(&scene, &settings, &Progress::default()).unwrap()
    };
    let every = picture(Structure::Every.into());
    for name in
        ["hierarchy", "grid-1", "grid-7", "grid-30", "light-buffer-1", "light-buffer-72", "grid-5/light-buffer-9"]
    {
        let film = picture(name.parse().unwrap());
        assert!(film == every, "{name} shows what testing every object shows");
    }
    let settings = Settings { size: [24, 16], choice: MethodChoice::Approx, samples: 1, shadows: Shadows::None };
    let unshadowed = render(&scene, &settings, &Progress::default()).unwrap();
    assert!(every != unshadowed, "something is in shadow");
}
