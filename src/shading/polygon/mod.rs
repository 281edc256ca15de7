//! A polygonal light: exactly, from its nearest point, and as a point light.

mod area;
mod irradiance;
mod nearest;
mod phong;

pub use irradiance::polygon_irradiance;
pub use nearest::{polygon_least_angle_cosine, polygon_projected_edge_cosine};
pub use phong::{polygon_phong, polygon_phong_lobe_only};

use glam::DVec3;

use super::{Method, PhongLobe, Response, ShadingPoint, cluster, point};
use crate::light::PolygonEmitter;
use crate::math::spherical::Edge;

/// Response to a polygon of luminance 1 by a method; [`Method::NearestPoint`] and [`Method::NearestPointPicott`] have
/// their diffuse part from [`Method::Exact`].
pub fn respond(light: &PolygonEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    if !shines_on(light, at.p) {
        return Response::default();
    }
    match method {
        Method::PointCluster(points) => cluster::polygon_cluster(light, points, at, lobe),
        Method::Point => polygon_point(light, at, lobe),
        Method::NearestPoint | Method::NearestPointPicott => {
            let rule =
                if method == Method::NearestPoint { polygon_least_angle_cosine } else { polygon_projected_edge_cosine };
            let cosine = rule(light, at.p, at.n, at.mirror());
            Response {
                irradiance: polygon_irradiance(&light.vertices, at.p, at.n),
                specular: cosine.map_or(0.0, |cosine| cosine.powf(lobe.exponent())),
            }
        }
        _ => Response {
            irradiance: polygon_irradiance(&light.vertices, at.p, at.n),
            specular: polygon_phong(&light.vertices, at.p, at.n, at.mirror(), lobe.exponent()),
        },
    }
}

/// The polygon as one point light at its centroid, I = L·A·cos at the light.
pub fn polygon_point(light: &PolygonEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let to_light = light.centroid() - at.p;
    let facing = -to_light.normalize_or_zero().dot(light.vector_area());
    let intensity = if light.two_sided { facing.abs() } else { facing.max(0.0) };
    point::point_response(to_light, intensity, at, lobe)
}

/// Whether p is on a lit side, and not within rounding of the light's own plane.
fn shines_on(light: &PolygonEmitter, p: DVec3) -> bool {
    let Some(corner) = light.vertices.first() else { return false };
    let height = light.normal.dot(p - corner);
    let farthest = light.vertices.iter().map(|v| v.distance_squared(p)).fold(0.0, f64::max).sqrt();
    let rounding = 1e-14 * farthest;
    height > rounding || (light.two_sided && height < -rounding)
}

/// The closed loop of a polygon's edges, as seen from p.
fn edges(vertices: &[DVec3], p: DVec3) -> impl Iterator<Item = Edge> + Clone {
    let ends = vertices.iter().skip(1).chain(vertices.first());
    vertices.iter().zip(ends).map(move |(a, b)| (a - p, b - p))
}
