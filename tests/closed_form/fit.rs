//! Fits of punctual lights, against the light that they stand for.

use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use glam::{DVec2, DVec3};
use softbox::light::pattern::{Channel, Image, Pattern};
use softbox::light::photometry::{Distribution, Photometry};
use softbox::light::{Cap, Disk, Light, Line, Point, Polygon, Shape, Sky, Sphere, Textured};
use softbox::shading::fit::{Budget, Deviation, Fit, Punctual};
use softbox::shading::{Method, PhongLobe, Prepared, ShadingPoint};

fn outline(corners: &[[f64; 2]], two_sided: bool) -> Shape {
    Shape::Polygon(Polygon { vertices: corners.iter().copied().map(DVec2::from_array).collect(), two_sided })
}

fn rectangle(two_sided: bool) -> Shape {
    outline(&[[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]], two_sided)
}

/// Bright in one corner, with two texels that are dark.
fn textured() -> Shape {
    let channel = Channel::new(3, vec![0.1, 0.0, 1.0, 0.2, 0.5, 0.0]).expect("two rows of three");
    let pattern = Pattern::of_image("corner.png", Image::Grey(Arc::new(channel)));
    Shape::Textured(Textured { size: DVec2::new(2.0, 1.2), pattern, two_sided: false })
}

/// Every shape that a fit stands for.
fn shapes() -> Vec<(&'static str, Shape)> {
    let l_shape = [[0.0, 0.0], [1.5, 0.0], [1.5, 0.4], [0.4, 0.4], [0.4, 1.2], [0.0, 1.2]];
    vec![
        ("polygon", rectangle(false)),
        ("polygon, two sides", rectangle(true)),
        ("L", outline(&l_shape, false)),
        ("disk", Shape::Disk(Disk { radius: 0.4, two_sided: false })),
        ("textured", textured()),
        ("line", Shape::Line(Line::isotropic(1.5))),
        ("line, 1/r", Shape::Line(Line { falloff: 1.0, ..Line::isotropic(1.5) })),
        ("tube", Shape::Line(Line::tube(1.5, 0.013))),
        ("sphere", Shape::Sphere(Sphere { radius: 0.3 })),
        ("cap of 30 degrees", Shape::Cap(Cap { half_angle_deg: 30.0 })),
        ("cap of 90 degrees", Shape::Cap(Cap { half_angle_deg: 90.0 })),
        ("overcast sky", Shape::Sky(Sky::OVERCAST)),
        ("measured point", measured()),
    ]
}

/// cos² γ downwards and a little all around, more of it to one side.
fn measured() -> Shape {
    let gammas: Vec<f64> = (0..=18).map(|i| 10.0 * f64::from(i)).collect();
    let planes = [0.0, 90.0, 180.0, 270.0, 360.0];
    let candela = |plane: f64, gamma: f64| {
        let down = gamma.to_radians().cos().max(0.0).powi(2);
        100.0 * down + 20.0 + 10.0 * gamma.to_radians().sin() * plane.to_radians().cos()
    };
    let table: Vec<f64> = planes.iter().flat_map(|c| gammas.iter().map(|gamma| candela(*c, *gamma))).collect();
    let distribution = Distribution::of_table(&gammas, &planes, &table).expect("a table");
    let photometry = Photometry { distribution: Arc::new(distribution), ..Photometry::unread("lamp.ies") };
    Shape::Point(Point { ies: Some(photometry) })
}

fn fit(shape: &Shape, count: u32) -> Fit {
    Fit::new(&Light::new("light", shape.clone()).emitter(), count, None).expect("nobody cancels")
}

fn deviation(fit: &Fit) -> Deviation {
    fit.deviation(None).expect("nobody cancels")
}

/// Numbers of lights of [`within`].
const COUNTS: [u32; 5] = [1, 2, 4, 8, 16];

/// RMS and worst errors in per cent of the fits of [`COUNTS`] lights are at most those, and RMS errors fall.
#[track_caller]
fn within(name: &str, bounds: [[f64; 2]; 5]) {
    let (_, shape) = shapes().into_iter().find(|(known, _)| *known == name).expect("a shape of that name");
    let found = COUNTS.map(|count| {
        let Deviation { rms, worst } = deviation(&fit(&shape, count));
        [rms, worst].map(|share| 100.0 * share)
    });
    println!("{name}: {found:.2?}");
    for ((count, found), bounds) in COUNTS.iter().zip(&found).zip(&bounds) {
        assert!(found[0] <= bounds[0] && found[1] <= bounds[1], "{name}, {count} lights: {found:?}, not {bounds:?}");
    }
    let rising = found.windows(2).find(|pair| pair[1][0] > 1.15 * pair[0][0] + 0.01);
    assert!(rising.is_none(), "{name}: more lights are worse: {rising:?}");
}

#[test]
fn fits_are_as_near_as_the_documentation_states() {
    within("polygon", [[12.0, 32.0], [6.4, 22.0], [2.7, 8.5], [1.2, 4.0], [0.6, 4.3]]);
    within("polygon, two sides", [[30.0, 60.0], [12.0, 32.0], [6.5, 22.1], [2.7, 9.5], [1.2, 5.4]]);
    within("L", [[11.4, 28.3], [6.2, 20.4], [2.6, 14.3], [1.1, 6.6], [0.6, 3.9]]);
    within("disk", [[12.8, 26.2], [7.8, 21.2], [4.6, 25.9], [1.9, 8.7], [0.9, 3.9]]);
    within("textured", [[11.1, 30.7], [5.7, 17.6], [2.2, 9.0], [1.0, 4.3], [0.6, 3.8]]);
    within("line", [[7.5, 32.3], [0.8, 5.0], [0.02, 0.09], [0.01, 0.01], [0.01, 0.01]]);
    within("line, 1/r", [[54.1, 84.6]; 5]);
    within("tube", [[20.5, 73.6], [20.5, 73.6], [20.5, 73.6], [8.2, 59.1], [6.1, 39.4]]);
    within("cap of 30 degrees", [[3.6, 11.7], [2.1, 10.5], [0.6, 1.8], [0.3, 1.0], [0.2, 0.7]]);
    within("cap of 90 degrees", [[27.1, 50.2], [15.6, 45.2], [3.9, 10.0], [1.6, 5.1], [0.7, 1.9]]);
    within("measured point", [[14.7, 25.3], [3.3, 8.3], [2.0, 6.2], [2.3, 6.1], [1.5, 17.3]]);
    within("overcast sky", [[20.3, 39.9], [11.9, 37.8], [3.3, 7.6], [1.4, 4.9], [0.6, 2.1]]);
}

#[test]
fn a_sphere_is_one_point_exactly() {
    let sphere = fit(&Shape::Sphere(Sphere { radius: 0.3 }), 8);
    let [Punctual::Point { position, intensity }] = sphere.lights() else { panic!("{sphere:?}") };
    assert!(*position == DVec3::ZERO && (intensity / (PI * 0.09) - 1.0).abs() < 1e-9, "{sphere:?}");
    assert!(deviation(&sphere).worst < 1e-9, "{:?}", deviation(&sphere));
}

#[test]
fn lights_lie_on_the_light_and_a_one_sided_one_stays_dark_behind() {
    for (name, shape) in shapes() {
        let fit = fit(&shape, 8);
        assert!(!fit.lights().is_empty() && fit.lights().len() <= 8, "{name}: {fit:?}");
        for light in fit.lights() {
            assert!(light.strength() > 0.0 && light.strength().is_finite(), "{name}: {light:?}");
            let Some(position) = light.position() else { continue };
            let extent = [DVec3::new(1.0, 0.6, 0.0), DVec3::new(1.5, 1.2, 0.0)][usize::from(name == "L")];
            assert!(position.abs().cmple(extent + 1e-9).all(), "{name}: {light:?} is off the light");
        }
        let is_one_sided = ["polygon", "L", "disk", "textured"].contains(&name);
        let behind = ShadingPoint { p: DVec3::new(0.3, 0.2, 1.0), n: DVec3::NEG_Z, v: DVec3::NEG_Z };
        let lit = fit.respond(&behind, &PhongLobe::new(8.0)).irradiance;
        assert!(!is_one_sided || lit == 0.0, "{name}: {lit} behind");
    }
}

#[test]
fn a_fit_goes_where_its_light_goes() {
    for (name, shape) in shapes() {
        let still = Light::new("light", shape.clone());
        let (position, rotation_deg) = (DVec3::new(3.0, -2.0, 1.5), DVec3::new(20.0, -70.0, 130.0));
        let moved = Light { position, rotation_deg, ..still.clone() };
        let [still_fit, moved_fit] =
            [&still, &moved].map(|light| Fit::new(&light.emitter(), 4, None).expect("nobody cancels"));
        let strength = |fit: &Fit| fit.lights().iter().map(Punctual::strength).sum::<f64>();
        let apart = strength(&still_fit) - strength(&moved_fit);
        assert!(apart.abs() <= 1e-9 * strength(&still_fit), "{name}: {apart} cd are gone");
        // What is the same all about an axis has no first axis across it, and its fit may lie any way round.
        let is_round = ["disk", "tube", "overcast sky"].contains(&name) || name.starts_with("cap");
        let frame = moved.world_from_light();
        let lobe = PhongLobe::new(5.0);
        for (p, n) in [(DVec3::new(0.4, 0.3, -2.0), DVec3::Z), (DVec3::new(-1.0, 2.0, -1.0), DVec3::new(0.6, 0.0, 0.8))]
        {
            let at = ShadingPoint { p, n, v: DVec3::Z };
            let turned = ShadingPoint {
                p: frame.transform_point3(p),
                n: frame.transform_vector3(n),
                v: frame.transform_vector3(DVec3::Z),
            };
            let [a, b] = [still_fit.respond(&at, &lobe), moved_fit.respond(&turned, &lobe)];
            let off = (a.irradiance - b.irradiance).abs() + (a.specular - b.specular).abs();
            let bound = if is_round { f64::INFINITY } else { 1e-9 * a.irradiance };
            assert!(off <= bound, "{name}: {a:?} became {b:?}");
        }
    }
}

#[test]
fn the_same_light_has_the_same_fit_whatever_was_fitted_before() {
    let shape = outline(&[[0.0, 0.0], [1.0, 0.1], [0.8, 0.9]], false);
    let first = fit(&shape, 5);
    for i in 0..70 {
        fit(&Shape::Line(Line { falloff: 1.0 + 0.01 * f64::from(i), ..Line::isotropic(1.0) }), 1);
    }
    assert_eq!(first.lights(), fit(&shape, 5).lights(), "made again, after others had taken its place");
}

#[test]
fn a_bound_takes_as_many_lights_as_it_needs() {
    let emitter = Light::new("light", rectangle(false)).emitter();
    let within = |worst| Fit::within(&emitter, Budget::Worst(worst), None).expect("nobody cancels");
    let (coarse, fine) = (within(0.25), within(0.1));
    assert!(deviation(&coarse).worst <= 0.25 && deviation(&fine).worst <= 0.1, "{coarse:?}, {fine:?}");
    assert_eq!((coarse.lights().len(), fine.lights().len()), (2, 4), "as few as do");
    let least = within(0.0);
    assert!(deviation(&least).worst < 0.1, "the best where none is good enough: {:?}", deviation(&least));
}

#[test]
fn a_cancelled_fit_is_none() {
    let emitter = Light::new("light", outline(&[[0.0, 0.0], [2.0, 0.0], [0.0, 1.7]], false)).emitter();
    let cancel = AtomicBool::new(true);
    assert!(Fit::new(&emitter, 6, Some(&cancel)).is_none(), "a new one");
    let at = ShadingPoint { p: DVec3::new(0.0, 0.0, -2.0), n: DVec3::Z, v: DVec3::Z };
    let prepared = Prepared::new(&emitter, Method::Fit(6));
    assert!(prepared.respond_unless(&at, &PhongLobe::new(4.0), &cancel).is_none(), "by its method");
}

#[test]
fn the_method_is_the_sum_of_the_fits_lights() {
    for (name, shape) in shapes() {
        let emitter = Light::new("light", shape.clone()).emitter();
        let at = ShadingPoint { p: DVec3::new(0.4, -0.7, -1.9), n: DVec3::Z, v: DVec3::new(0.6, 0.0, 0.8) };
        let lobe = PhongLobe::new(7.0);
        let method = Prepared::new(&emitter, Method::Fit(3)).respond(&at, &lobe);
        let lights = fit(&shape, 3);
        let sum = lights.lights().iter().map(|light| light.respond(&at, &lobe));
        let [irradiance, specular] = sum.fold([0.0; 2], |[e, s], one| [e + one.irradiance, s + one.specular]);
        assert_eq!([method.irradiance, method.specular], [irradiance, specular], "{name}");
    }
}

/// A rectangle of 2 m by 1 m and 1000 nit, 2 m above the ground.
#[test]
fn eight_spots_light_the_ground_as_a_rectangle_does() {
    let light = Light { position: DVec3::new(0.0, 0.0, 2.0), ..Light::new("light", rectangle(false)) };
    let lobe = PhongLobe::new(1.0);
    let illuminance = |method, x: f64, y: f64| {
        let at = ShadingPoint { p: DVec3::new(x, y, 0.0), n: DVec3::Z, v: DVec3::Z };
        1000.0 * Prepared::new(&light.emitter(), method).respond(&at, &lobe).irradiance
    };
    let mut worst = 0.0_f64;
    for (x, y) in (0..=12).flat_map(|x| (0..=12).map(move |y| (0.5 * f64::from(x), 0.5 * f64::from(y)))) {
        worst = worst.max((illuminance(Method::Fit(8), x, y) - illuminance(Method::Exact, x, y)).abs());
    }
    let peak = illuminance(Method::Exact, 0.0, 0.0);
    println!("off by {worst} lx at most, {:.2} % of {peak} lx", 100.0 * worst / peak);
    assert!((peak - 415.838).abs() < 1e-3 && worst < 0.03 * peak, "off by {worst} lx of {peak} lx");
}
