//! `point-cluster`: a light as N point lights spread evenly over it.

use glam::DVec3;

use super::point::{falloff_response, point_response};
use super::{PhongLobe, Response, ShadingPoint};
use crate::light::{LineEmitter, PolygonEmitter};

/// A line as N point lights at the middles of N equal parts.
pub fn line_cluster(light: &LineEmitter, points: u32, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let (n, r) = (at.n, at.mirror());
    let part = light.length() / f64::from(points);
    let mut sum = Response::default();
    for position in line_points(light, points) {
        sum += falloff_response(position - at.p, part, light.falloff, n, r, lobe);
    }
    sum
}

/// The points of [`line_cluster`].
pub fn line_points(light: &LineEmitter, points: u32) -> impl Iterator<Item = DVec3> {
    let (a, b) = (light.a, light.b);
    (0..points).map(move |i| a.lerp(b, (f64::from(i) + 0.5) / f64::from(points)))
}

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
