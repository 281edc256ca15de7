//! Linear lights.

use super::point::falloff_response;
use super::{Method, PhongLobe, Response, ShadingPoint, cluster};
use crate::light::LineEmitter;

/// Response to a line of intensity per metre 1 by a method.
pub fn respond(light: &LineEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::PointCluster(points) => cluster::line_cluster(light, points, at, lobe),
        _ => line_point(light, at, lobe),
    }
}

/// The line as one point light of its whole intensity at its middle.
pub fn line_point(light: &LineEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    falloff_response(light.middle() - at.p, light.length(), light.falloff, at.n, at.mirror(), lobe)
}
