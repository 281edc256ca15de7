use std::sync::Arc;

use super::*;
use crate::light::pattern::{Channel, Image, Pattern};
use crate::light::{Directional, Light, Line, Point, Polygon, Quantity, QuantityKind, Textured, Tint};
use crate::surface::{Material, ReflectionModel};

fn light(shape: Shape, kind: QuantityKind, value: f64) -> Light {
    Light {
        name: shape.name().to_owned(),
        position: DVec3::new(0.0, 0.0, 2.0),
        rotation_deg: DVec3::ZERO,
        tint: Tint::Color(DVec3::new(1.0, 0.2, 0.0)),
        quantity: Quantity::new(kind, value),
        muted: false,
        group: None,
        only: None,
        shape,
    }
}

fn scene(lights: Vec<Light>) -> Scene {
    let diffuse = DVec3::splat(0.5);
    let materials = vec![Material {
        name: "m".to_owned(),
        diffuse,
        specular: DVec3::ONE,
        model: ReflectionModel::default(),
        exponent: 10.0,
    }];
    Scene { materials, lights, ..Scene::default() }
}

fn plot(kind: PlotKind, quantity: PlotQuantity, range: [f64; 2]) -> Plot {
    Plot {
        name: "p".to_owned(),
        kind,
        quantity,
        position: DVec3::ZERO,
        normal: DVec3::Z,
        view: None,
        axis: DVec3::X,
        range,
        material: None,
        normalise: false,
    }
}

fn sun() -> Scene {
    scene(vec![light(Shape::Directional(Directional {}), QuantityKind::Illuminance, 1000.0)])
}

fn bulb() -> Scene {
    scene(vec![light(Shape::Point(Point::default()), QuantityKind::Intensity, 100.0)])
}

fn run(scene: &Scene, plot: &Plot, samples: usize) -> Curves {
    curves(scene, plot, &methods_for(scene), samples, &AtomicBool::new(false)).unwrap()
}

#[track_caller]
fn check(curves: &Curves, expected: impl Fn(f64) -> f64) {
    for (x, y) in curves.x.iter().zip(&curves.exact) {
        assert!((y - expected(*x)).abs() < 1e-9, "at {x}: {y} is not {}", expected(*x));
    }
}

#[test]
fn tilting_under_the_sun_follows_the_cosine_whatever_its_tint() {
    let curves = run(&sun(), &plot(PlotKind::Tilt, PlotQuantity::Irradiance, [-120.0, 120.0]), 49);
    check(&curves, |deg| 1000.0 * deg.to_radians().cos().max(0.0));
    assert!(curves.x[0] == -120.0 && curves.x[48] == 120.0 && !curves.logarithmic_x, "{:?}", curves.x);
}

#[test]
fn turning_the_eye_under_the_sun_follows_the_lobe() {
    let curves = run(&sun(), &plot(PlotKind::View, PlotQuantity::Specular, [-80.0, 80.0]), 33);
    check(&curves, |deg| 1000.0 * 11.0 / std::f64::consts::TAU * deg.to_radians().cos().powi(10));
}

#[test]
fn moving_under_a_bulb_follows_the_point_law() {
    let curves = run(&bulb(), &plot(PlotKind::Line, PlotQuantity::Irradiance, [-3.0, 3.0]), 21);
    check(&curves, |x| 100.0 * 2.0 / (4.0 + x * x).powf(1.5));
}

#[test]
fn a_distance_plot_has_equal_ratios() {
    let mut plot = plot(PlotKind::Distance, PlotQuantity::Irradiance, [0.01, 1.0]);
    plot.axis = DVec3::NEG_Z;
    let curves = run(&bulb(), &plot, 5);
    assert!(curves.logarithmic_x, "logarithmic");
    for (x, expected) in curves.x.iter().zip([0.01, 0.031_622_776_601, 0.1, 0.316_227_766_016, 1.0]) {
        assert!((x - expected).abs() < 1e-9, "{x} is not {expected}");
    }
    check(&curves, |x| 100.0 / (2.0 + x).powi(2));
}

#[test]
fn normalising_makes_the_greatest_exact_value_1() {
    let mut plot = plot(PlotKind::Line, PlotQuantity::Radiance, [-3.0, 3.0]);
    plot.normalise = true;
    let curves = run(&bulb(), &plot, 21);
    assert_eq!(curves.exact.iter().copied().fold(0.0, f64::max), 1.0, "greatest");
}

#[test]
fn errors_are_differences_to_exact_and_their_maximum_and_rms() {
    let polygon = Polygon {
        vertices: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(Into::into).to_vec(),
        two_sided: false,
    };
    let scene = scene(vec![light(Shape::Polygon(polygon), QuantityKind::Luminance, 100.0)]);
    let curves = run(&scene, &plot(PlotKind::Line, PlotQuantity::Irradiance, [0.0, 2.0]), 11);
    let cluster = curves.series.iter().find(|series| matches!(series.method, Method::PointCluster(_))).unwrap();
    let differences: Vec<f64> = cluster.y.iter().zip(&curves.exact).map(|(y, exact)| y - exact).collect();
    assert_eq!(cluster.error, differences, "errors");
    let max = differences.iter().map(|d| d.abs()).fold(0.0, f64::max);
    let rms = (differences.iter().map(|d| d * d).sum::<f64>() / 11.0).sqrt();
    assert!((cluster.max_error - max).abs() < 1e-12 && (cluster.rms_error - rms).abs() < 1e-12, "{cluster:?}");
    assert!(cluster.max_error > 0.0 && cluster.rms_error < cluster.max_error && cluster.cost_ns > 0.0, "{cluster:?}");
    assert_eq!(curves.series[0].max_error, 0.0, "exact against itself");
}

#[test]
fn methods_are_those_of_the_lights_that_shine() {
    let line = Shape::Line(Line::isotropic(1.0));
    let mut scene = scene(vec![
        light(Shape::Point(Point::default()), QuantityKind::Intensity, 1.0),
        light(line, QuantityKind::IntensityPerMetre, 1.0),
    ]);
    let names = |scene: &Scene| methods_for(scene).iter().map(ToString::to_string).collect::<Vec<_>>();
    assert_eq!(
        names(&scene),
        ["exact", "chebyshev", "nearest-point", "point-cluster", "fit-4", "point", "reference"],
        "a line and a point"
    );
    scene.lights[1].muted = true;
    assert_eq!(names(&scene), ["exact"], "a muted line and a point");
}

#[test]
fn cancelled_curves_are_none() {
    let plot = plot(PlotKind::Tilt, PlotQuantity::Irradiance, [0.0, 90.0]);
    assert_eq!(curves(&sun(), &plot, &[Method::Exact], 10, &AtomicBool::new(true)), None, "cancelled");
}

#[test]
fn the_reference_has_a_band_and_the_exact_curve_lies_within_it() {
    let line = Shape::Line(Line::isotropic(3.0));
    let scene = scene(vec![light(line, QuantityKind::IntensityPerMetre, 50.0)]);
    let curves = run(&scene, &plot(PlotKind::Line, PlotQuantity::Radiance, [-4.0, 4.0]), 33);
    let reference = curves.series.iter().find(|series| series.method == Method::Reference).unwrap();
    let band = reference.band.as_ref().unwrap();
    for (i, bound) in band.iter().enumerate() {
        let slack = bound + 1e-12 * curves.exact[i];
        assert!(reference.error[i].abs() <= slack, "at {}: {} > {slack}", curves.x[i], reference.error[i]);
    }
    assert!(curves.series.iter().all(|series| (series.method == Method::Reference) == series.band.is_some()), "bands");
}

/// The reference looks at each of 2048 × 2048 texels: not cancelled while at work, this would take minutes.
#[test]
fn a_slow_point_is_given_up_in_the_middle() {
    let channel = Channel::of_shares(2048, 2048, |u, v| u + v).unwrap();
    let pattern = Pattern::of_image("large.png", Image::Grey(Arc::new(channel)));
    let textured = Textured { size: [1.0, 1.0].into(), pattern, two_sided: false };
    let large = light(Shape::Textured(textured), QuantityKind::Luminance, 100.0);
    let scene = scene(vec![large]);
    let plot = plot(PlotKind::Tilt, PlotQuantity::Irradiance, [-90.0, 90.0]);
    let cancel = AtomicBool::new(false);
    let sampling = Sampling::new(&scene, &plot, 241).coarse();
    let exact = sampling.exact(&cancel).unwrap();
    std::thread::scope(|threads| {
        let slow = threads.spawn(|| sampling.series(Method::Reference, &exact, &cancel));
        std::thread::sleep(std::time::Duration::from_millis(20));
        assert!(!slow.is_finished(), "it is not slow");
        cancel.store(true, Ordering::Relaxed);
        assert_eq!(slow.join().unwrap(), None, "cancelled");
    });
}
