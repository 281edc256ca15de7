//! `point-cluster`: a light as N point lights spread evenly over it.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::point::{direction_response, falloff_response, point_response};
use super::sphere::{Cap, sphere_point};
use super::{PhongLobe, Response, ShadingPoint};
use crate::light::{DiskEmitter, LineEmitter, PolygonEmitter, SphereEmitter};

/// A line as N point lights at the middles of N equal parts.
pub fn line_cluster(light: &LineEmitter, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let (n, r) = (at.n, at.mirror());
    let part = light.length() / f64::from(points);
    let mut sum = Response::default();
    for position in line_points(light, points) {
        let to_light = position - at.p;
        sum += falloff_response(to_light, part * light.intensity_along(to_light), light.falloff, n, r, lobe);
    }
    sum
}

/// The points of [`line_cluster`].
pub fn line_points(light: &LineEmitter, points: u32) -> impl Iterator<Item = DVec3> {
    let (a, b) = (light.a, light.b);
    (0..points).map(move |i| a.lerp(b, (f64::from(i) + 0.5) / f64::from(points)))
}

/// A sphere as N lights in directions spread evenly over what the point sees of it, each of the same solid angle; as
/// [`sphere_point`] for N = 1.
pub fn sphere_cluster(light: &SphereEmitter, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    if points <= 1 {
        return sphere_point(light, at, lobe);
    }
    cap_cluster(&Cap::of_sphere(light, at.p, at.n), points, at, lobe)
}

/// A cap as N lights in directions spread evenly over it, each of the same solid angle.
///
/// The directions are a spiral by the golden angle about the centre: in the i-th, cos is 1 − (i+½)/N·(1 − cos σ).
pub fn cap_cluster(cap: &Cap, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let r = at.mirror();
    let part = cap.solid_angle() / f64::from(points);
    let mut sum = Response::default();
    for w in cap_directions(cap, points) {
        sum += direction_response(w, part, at.n, r, lobe);
    }
    sum
}

/// The directions of [`cap_cluster`].
pub fn cap_directions(cap: &Cap, points: u32) -> impl Iterator<Item = DVec3> {
    let (x_axis, y_axis) = cap.center().any_orthonormal_pair();
    let center = cap.center();
    let depth = cap.solid_angle() / TAU;
    let turn = DVec2::from_angle(GOLDEN_ANGLE);
    let mut azimuth = DVec2::X;
    (0..points).map(move |i| {
        let fall = depth * (f64::from(i) + 0.5) / f64::from(points);
        let across = (fall * (2.0 - fall)).sqrt() * azimuth;
        azimuth = azimuth.rotate(turn);
        (1.0 - fall) * center + across.x * x_axis + across.y * y_axis
    })
}

/// π(3 − √5).
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// A polygon as N Lambertian point lights on rows parallel to its first edge, each standing for its share of the area.
///
/// The rows are as far apart as the points on them; on a rectangle this is a regular grid. A point lies inside the
/// polygon, convex or not. The shares are of the row's height times its length inside, scaled to sum to the area.
pub fn polygon_cluster(light: &PolygonEmitter, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let mut sum = Response::default();
    for PointOfArea { position, area } in polygon_points(light, points) {
        let to_light = position - at.p;
        let facing = -to_light.normalize_or_zero().dot(light.normal);
        let cos_light = if light.two_sided { facing.abs() } else { facing.max(0.0) };
        sum += point_response(to_light, area * cos_light, at, lobe);
    }
    sum
}

/// A disk as N Lambertian point lights on a spiral by the golden angle, the i-th at √((i+½)/N) of the radius, each
/// standing for the same area.
pub fn disk_cluster(light: &DiskEmitter, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let mut sum = Response::default();
    for PointOfArea { position, area } in disk_points(light, points) {
        let to_light = position - at.p;
        let facing = -to_light.normalize_or_zero().dot(light.normal);
        let cos_light = if light.two_sided { facing.abs() } else { facing.max(0.0) };
        sum += point_response(to_light, area * cos_light, at, lobe);
    }
    sum
}

/// The points of [`disk_cluster`]; a single one is the centre.
pub fn disk_points(light: &DiskEmitter, points: u32) -> impl Iterator<Item = PointOfArea> {
    let DiskEmitter { center, normal, radius, .. } = *light;
    let (u, v) = normal.any_orthonormal_pair();
    let area = light.area() / f64::from(points);
    let turn = DVec2::from_angle(GOLDEN_ANGLE);
    let mut azimuth = DVec2::X;
    (0..points).map(move |i| {
        let share = if points == 1 { 0.0 } else { (f64::from(i) + 0.5) / f64::from(points) };
        let offset = radius * share.sqrt() * azimuth;
        azimuth = azimuth.rotate(turn);
        PointOfArea { position: center + offset.x * u + offset.y * v, area }
    })
}

/// A point on a light, and the area that it stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointOfArea {
    /// In the world.
    pub position: DVec3,
    /// In m².
    pub area: f64,
}

/// The points of [`polygon_cluster`].
pub fn polygon_points(light: &PolygonEmitter, points: u32) -> Vec<PointOfArea> {
    let total = light.vector_area().length();
    let [first, second, ..] = light.vertices[..] else { return Vec::new() };
    let axis_u = (second - first).normalize_or_zero();
    let axis_v = light.normal.cross(axis_u);
    let flat: Vec<[f64; 2]> =
        light.vertices.iter().map(|x| [(x - first).dot(axis_u), (x - first).dot(axis_v)]).collect();
    let extent = |axis: usize| {
        flat.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x[axis]), high.max(x[axis])])
    };
    let ([left, right], [bottom, top]) = (extent(0), extent(1));
    let count = f64::from(points);
    let rows = (count * (top - bottom) / (right - left)).sqrt().round().clamp(1.0, count);
    let row_height = (top - bottom) / rows;

    let mut cluster = Vec::with_capacity(points as usize);
    let mut placed = 0.0;
    let mut row = 0.0;
    while row < rows {
        let v = bottom + (row + 0.5) * row_height;
        let chords = chords_at(&flat, v);
        let length: f64 = chords.iter().map(|[from, to]| to - from).sum();
        let wanted = (count * (row + 1.0) / rows).floor() - placed;
        placed += wanted;
        let mut i = 0.0;
        while i < wanted {
            let u = along(&chords, (i + 0.5) / wanted * length);
            let position = first + u * axis_u + v * axis_v;
            cluster.push(PointOfArea { position, area: row_height * length / wanted });
            i += 1.0;
        }
        row += 1.0;
    }
    let covered: f64 = cluster.iter().map(|point| point.area).sum();
    let scale = if covered > 0.0 { total / covered } else { 0.0 };
    for point in &mut cluster {
        point.area *= scale;
    }
    cluster
}

/// The parts of the horizontal at height `v` that lie inside a plane polygon, left to right.
fn chords_at(polygon: &[[f64; 2]], v: f64) -> Vec<[f64; 2]> {
    let next = polygon.iter().cycle().skip(1);
    let mut crossings: Vec<f64> = polygon
        .iter()
        .zip(next)
        .filter(|(from, to)| (from[1] > v) != (to[1] > v))
        .map(|(from, to)| from[0] + (v - from[1]) / (to[1] - from[1]) * (to[0] - from[0]))
        .collect();
    crossings.sort_by(f64::total_cmp);
    crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect()
}

/// The place at `distance` along a row of chords, gaps not counted.
fn along(chords: &[[f64; 2]], mut distance: f64) -> f64 {
    for [from, to] in chords {
        if distance <= to - from {
            return from + distance;
        }
        distance -= to - from;
    }
    chords.last().map_or(0.0, |[_, to]| *to)
}
