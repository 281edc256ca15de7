//! Polygonal lights.

use super::{Method, PhongLobe, Response, ShadingPoint, cluster, point};
use crate::light::PolygonEmitter;

/// Response to a polygon of luminance 1 by a method.
pub fn respond(light: &PolygonEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::PointCluster(points) => cluster::polygon_cluster(light, points, at, lobe),
        _ => polygon_point(light, at, lobe),
    }
}

/// The polygon as one point light at its centroid, I = L·A·cos at the light.
pub fn polygon_point(light: &PolygonEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let to_light = light.centroid() - at.p;
    let facing = -to_light.normalize_or_zero().dot(light.vector_area());
    let intensity = if light.two_sided { facing.abs() } else { facing.max(0.0) };
    point::point_response(to_light, intensity, at, lobe)
}
