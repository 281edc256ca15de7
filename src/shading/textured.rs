//! Textured lights: any pattern on a rectangle, and so any outline and any distribution.

pub mod quadrature;

use glam::DVec3;

use self::quadrature::{Sought, Weighing, integrate};
use super::cluster::PointOfArea;
use super::point::point_response;
use super::reference::BoundedResponse;
use super::{Lobe, Method, Response, ShadingPoint};
use crate::light::pattern::Span;
use crate::light::{PolygonEmitter, TexturedEmitter};
use crate::math::interpolation::CHEBYSHEV;

/// Response to a textured light of luminance 1 by a method; `sought` is for the exact one.
pub fn respond(
    light: &TexturedEmitter,
    method: Method,
    at: &ShadingPoint,
    lobe: &Lobe,
    sought: Sought<'_>,
) -> Response {
    match method {
        Method::PointCluster(points) => textured_cluster(light, points, at, lobe),
        Method::Point => textured_cluster(light, 1, at, lobe),
        _ => textured_exact(light, at, lobe, sought).response(),
    }
}

/// Irradiance and specular response by [`integrate`], with bounds on their errors.
///
/// **Accuracy:** as sought; by default the bounds are at most 1e-6 of the value, or 1e-9 of what the rectangle would
/// give at luminance 1.
/// **Cost:** follows what is in sight, not the number of texels.
pub fn textured_exact(light: &TexturedEmitter, at: &ShadingPoint, lobe: &Lobe, sought: Sought<'_>) -> BoundedResponse {
    BoundedResponse {
        irradiance: integrate(light, &*light.pattern, at.p, &cosine(at.n), sought),
        specular: integrate(light, &*light.pattern, at.p, &reflection(lobe, at), sought),
    }
}

/// Lambert's cosine about the normal n.
pub fn cosine(n: DVec3) -> Weighing<impl Fn(DVec3) -> f64> {
    Weighing {
        density: move |w: DVec3| n.dot(w),
        greatest: 1.0,
        peak: n,
        width: 1.0,
        fall: f64::INFINITY,
        horizons: [n, n],
    }
}

/// A material's lobe above the surface.
pub fn reflection(lobe: &Lobe, at: &ShadingPoint) -> Weighing<impl Fn(DVec3) -> f64> {
    let (n, r) = (at.n, at.mirror());
    let density = move |w: DVec3| lobe.density(n, r, w);
    let broad = lobe.cosine_exponent().max(0.25).sqrt().recip();
    if lobe.is_cosine() {
        // cosᵐ θ ≤ exp(−mθ²/2).
        let greatest = lobe.normalisation();
        return Weighing { density, greatest, peak: r, width: broad, fall: broad, horizons: [n, r] };
    }
    // A direction at θ from r has its half-vector at θ/2 or more from n; out of the plane of incidence at more, by up to
    // 1/(n·v). Cook and Torrance's shadowing may raise a grazing lobe by as much above its distribution's peak.
    let cos_eye = n.dot(at.v);
    let greatest = 4.0 * density(r).max(density(n)) / cos_eye.max(1e-3);
    let (width, fall) = (broad * cos_eye.max(0.1), 2.0 * broad);
    Weighing { density, greatest, peak: r, width, fall, horizons: [n, n] }
}

/// A textured light as N Lambertian point lights, each at the flux centroid of a part of it, and of the part's flux; with
/// N = 1, as the point light of its whole flux at its flux centroid.
pub fn textured_cluster(light: &TexturedEmitter, points: u32, at: &ShadingPoint, lobe: &Lobe) -> Response {
    let mut sum = Response::default();
    for PointOfArea { position, area } in textured_points(light, points) {
        let to_light = position - at.p;
        let facing = -to_light.normalize_or_zero().dot(light.normal);
        let cos_light = if light.two_sided { facing.abs() } else { facing.max(0.0) };
        sum += point_response(to_light, area * cos_light, at, lobe);
    }
    sum
}

/// The points of [`textured_cluster`], each with the area of luminance 1 that it stands for: the part of the greatest
/// flux is halved across its longer side, until there are as many parts.
pub fn textured_points(light: &TexturedEmitter, points: u32) -> Vec<PointOfArea> {
    let [columns, rows] = light.pattern.size().map(Span::whole);
    let mut parts = vec![gathered(light, columns, rows)];
    while parts.len() < points as usize {
        let greatest = parts.iter().enumerate().max_by(|(_, a), (_, b)| a.2.area.total_cmp(&b.2.area));
        let Some((i, (columns, rows, _))) = greatest.map(|(i, part)| (i, *part)) else { break };
        let is_wide = columns.length() * light.row.length() > rows.length() * light.column.length();
        let halves = if is_wide {
            columns.halves().map(|halves| halves.map(|half| gathered(light, half, rows)))
        } else {
            rows.halves().map(|halves| halves.map(|half| gathered(light, columns, half)))
        };
        let Some(halves) = halves else { break };
        parts.swap_remove(i);
        parts.extend(halves);
    }
    parts.into_iter().map(|(_, _, point)| point).collect()
}

/// A part of a light, and the point that stands for it.
fn gathered(light: &TexturedEmitter, columns: Span, rows: Span) -> (Span, Span, PointOfArea) {
    let weights = light.pattern.weights(&columns, &rows);
    let (mut flux, mut u, mut v) = (0.0, 0.0, 0.0);
    for (weights, y) in weights.iter().zip(CHEBYSHEV.nodes) {
        for (weight, x) in weights.iter().zip(CHEBYSHEV.nodes) {
            flux += weight;
            u += weight * columns.at(x);
            v += weight * rows.at(y);
        }
    }
    let position =
        if flux > 0.0 { light.point(u / flux, v / flux) } else { light.point(columns.at(0.0), rows.at(0.0)) };
    (columns, rows, PointOfArea { position, area: flux.max(0.0) * light.area() })
}

/// The light's rectangle.
pub fn as_polygon(light: &TexturedEmitter) -> PolygonEmitter {
    PolygonEmitter { vertices: light.corners().to_vec(), normal: light.normal, two_sided: light.two_sided }
}
