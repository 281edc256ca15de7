//! Tests of [`super`]: where the light falls is found by shading the surface about the chosen point.

use glam::dvec2;

use super::*;
use crate::light::{Cap, Directional, Disk, Line, Point, Polygon, Shape, Sky, Sphere};
use crate::shading::{Lobe, Method, respond};

/// Where the eye is.
const EYE: DVec3 = DVec3::new(0.5, -5.0, 3.0);
/// A narrow lobe, of a half-width of 1.5°.
const EXPONENT: f64 = 2000.0;

/// A surface about a point, by two coordinates across it in metres.
struct Patch {
    p: DVec3,
    n: DVec3,
    /// Of a ball; none for a plane.
    radius: Option<f64>,
}

impl Patch {
    fn at(&self, x: f64, y: f64) -> ShadingPoint {
        let (u, v) = self.n.any_orthonormal_pair();
        let across = x * u + y * v;
        let (p, n) = match self.radius {
            Some(radius) => {
                let n = (self.n + across / radius).normalize();
                (self.p + radius * (n - self.n), n)
            }
            None => (self.p + across, self.n),
        };
        ShadingPoint { p, n, v: (EYE - p).normalize() }
    }

    /// How far from the chosen point `value` is greatest, metres, within `reach`.
    fn offset_of_peak(&self, reach: f64, value: impl Fn(&ShadingPoint) -> f64) -> f64 {
        let (mut best, mut step) = ((0.0, 0.0), reach / 12.0);
        for _ in 0..6 {
            let steps = (-12_i32..=12).map(|i| step * f64::from(i));
            let around: Vec<(f64, f64)> =
                steps.clone().flat_map(|dx| steps.clone().map(move |dy| (best.0 + dx, best.1 + dy))).collect();
            let at = |(x, y): (f64, f64)| value(&self.at(x, y));
            best = around.into_iter().max_by(|a, b| at(*a).total_cmp(&at(*b))).expect("steps");
            step /= 5.0;
        }
        best.0.hypot(best.1)
    }
}

/// Points of a floor and of a ball of radius 0.5.
fn patches() -> [Patch; 3] {
    let ball =
        |n: DVec3| Patch { p: DVec3::new(0.0, 0.0, 0.5) + 0.5 * n.normalize(), n: n.normalize(), radius: Some(0.5) };
    [
        Patch { p: DVec3::new(0.4, -0.6, 0.0), n: DVec3::Z, radius: None },
        ball(DVec3::new(0.3, -0.7, 0.6)),
        ball(DVec3::new(-0.5, -0.6, 0.2)),
    ]
}

fn panel() -> Shape {
    let vertices = vec![dvec2(-0.2, -0.1), dvec2(0.2, -0.1), dvec2(0.2, 0.1), dvec2(-0.2, 0.1)];
    Shape::Polygon(Polygon { vertices, two_sided: false })
}

/// Lights with a place.
fn near() -> Vec<Shape> {
    vec![
        panel(),
        Shape::Disk(Disk { radius: 0.15, two_sided: false }),
        Shape::Sphere(Sphere { radius: 0.1 }),
        Shape::Line(Line::isotropic(0.4)),
        Shape::Point(Point::default()),
    ]
}

/// Lights without.
fn far() -> Vec<Shape> {
    vec![Shape::Cap(Cap { half_angle_deg: 4.0 }), Shape::Directional(Directional {})]
}

fn light(shape: Shape) -> Light {
    let (position, rotation_deg) = (DVec3::new(1.0, 1.5, 2.5), DVec3::new(20.0, 10.0, 30.0));
    Light { position, rotation_deg, ..Light::new("light", shape) }
}

fn specular(light: &Light) -> impl Fn(&ShadingPoint) -> f64 {
    let (emitter, lobe) = (light.emitter(), Lobe::new(EXPONENT));
    move |at| respond(&emitter, Method::Exact, at, &lobe).specular
}

fn irradiance(light: &Light) -> impl Fn(&ShadingPoint) -> f64 {
    let (emitter, lobe) = (light.emitter(), Lobe::new(1.0));
    move |at| respond(&emitter, Method::Exact, at, &lobe).irradiance
}

#[track_caller]
fn check(what: &str, offset: f64, within: f64) {
    assert!(offset <= within, "{what}: the peak is {offset} m from the chosen point, not within {within}");
}

#[test]
fn the_highlight_is_where_it_was_asked_for() {
    for (i, patch) in patches().iter().enumerate() {
        for shape in near().into_iter().chain(far()) {
            let name = shape.name();
            let light = placed(&light(shape), Place::Highlight, &patch.at(0.0, 0.0), None);
            check(&format!("{name} on surface {i}"), patch.offset_of_peak(0.25, specular(&light)), 0.011);
        }
    }
}

#[test]
fn the_diffuse_peak_is_where_it_was_asked_for() {
    for (i, patch) in patches().iter().enumerate() {
        // A light infinitely far away is the same all over a plane.
        let shapes =
            if patch.radius.is_some() { [near(), far(), vec![Shape::Sky(Sky::OVERCAST)]].concat() } else { near() };
        for shape in shapes {
            let name = shape.name();
            let light = placed(&light(shape), Place::Diffuse, &patch.at(0.0, 0.0), None);
            check(&format!("{name} on surface {i}"), patch.offset_of_peak(0.25, irradiance(&light)), 1e-5);
        }
    }
}

/// The point of the ball where the line of sight meets it at an angle, on its right and a little up.
fn at_angle(grazing_deg: f64) -> Patch {
    let center = DVec3::new(0.0, 0.0, 0.5);
    // Seen from far enough the line of sight is the same all over the ball, up to this iteration.
    let mut n = DVec3::X;
    for _ in 0..50 {
        let v = (EYE - (center + 0.5 * n)).normalize();
        let out = (DVec3::new(1.0, 0.0, 0.3) - DVec3::new(1.0, 0.0, 0.3).dot(v) * v).normalize();
        let (sin, cos) = grazing_deg.to_radians().sin_cos();
        n = (sin * v + cos * out).normalize();
    }
    Patch { p: center + 0.5 * n, n, radius: Some(0.5) }
}

#[test]
fn a_rim_is_where_it_was_asked_for_and_comes_from_behind() {
    for grazing_deg in [4.0, 12.0, 25.0] {
        let patch = at_angle(grazing_deg);
        let at = patch.at(0.0, 0.0);
        for shape in near().into_iter().chain(far()) {
            let what = format!("{} at {grazing_deg}°", shape.name());
            let light = placed(&light(shape), Place::Rim, &at, None);
            check(&what, patch.offset_of_peak(0.1, specular(&light)), 0.003);
            let to_light = Place::Rim.direction(&at);
            assert!(to_light.dot(at.v) < -0.5, "{what}: from behind: {}", to_light.dot(at.v));
            assert!(to_light.dot(at.n) > 0.0, "{what}: above the surface");
        }
    }
}

#[test]
fn a_rim_at_the_silhouette_or_facing_the_eye_is_kept_within_its_angles() {
    for (asked_deg, expected_deg) in [(0.5, 3.0), (12.0, 12.0), (50.0, 30.0)] {
        let at = at_angle(asked_deg).at(0.0, 0.0);
        let half =
            0.5 * (-at.v).cross(Place::Rim.direction(&at)).length().atan2((-at.v).dot(Place::Rim.direction(&at)));
        assert!((half.to_degrees() - expected_deg).abs() < 1e-6, "{asked_deg}°: {}°", half.to_degrees());
    }
    let facing = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    assert!(Place::Rim.direction(&facing).is_normalized(), "it has a direction even where there is no edge");
}

#[test]
fn a_light_keeps_its_distance_or_takes_the_one_typed_and_faces_the_point() {
    let patch = &patches()[0];
    let at = patch.at(0.0, 0.0);
    let start = light(panel());
    let distance = aim::center(&start).distance(at.p);
    for place in Place::ALL {
        for (typed, expected) in [(None, distance), (Some(1.25), 1.25)] {
            let placed = placed(&start, place, &at, typed);
            let found = aim::center(&placed).distance(at.p);
            assert!((found - expected).abs() < 1e-5, "{place:?}: {found} m, not {expected}");
            let faces = -placed.world_from_light().matrix3.z_axis;
            let to_point = (at.p - placed.position).normalize();
            assert!(faces.cross(to_point).length().atan2(faces.dot(to_point)) < 1e-5, "{place:?}: {faces}");
        }
    }
}

#[test]
fn a_light_infinitely_far_away_is_turned_where_it_is() {
    let at = patches()[1].at(0.0, 0.0);
    for shape in far() {
        let start = light(shape);
        let placed = placed(&start, Place::Highlight, &at, Some(3.0));
        assert_eq!(placed.position, start.position, "its symbol stays");
        let comes_from = placed.world_from_light().matrix3.z_axis;
        assert!(comes_from.distance(at.mirror()) < 1e-7, "{comes_from} is not {}", at.mirror());
    }
}

#[test]
fn a_point_light_on_the_point_itself_is_moved_off_it() {
    let at = ShadingPoint { p: DVec3::ZERO, n: DVec3::Z, v: DVec3::Z };
    let start = Light { position: DVec3::ZERO, ..light(Shape::Point(Point::default())) };
    let placed = placed(&start, Place::Diffuse, &at, None);
    assert_eq!(placed.position, LEAST_DISTANCE * DVec3::Z, "it stands over it");
}
