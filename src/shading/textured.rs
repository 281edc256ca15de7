//! Textured lights.

use super::{Method, PhongLobe, Response, ShadingPoint, polygon};
use crate::light::{PolygonEmitter, TexturedEmitter};

/// Response to a textured light of luminance 1 by a method.
pub fn respond(light: &TexturedEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let response = polygon::respond(&as_polygon(light), method, at, lobe);
    let mean = light.pattern.mean();
    Response { irradiance: mean * response.irradiance, specular: mean * response.specular }
}

/// The light's rectangle.
pub fn as_polygon(light: &TexturedEmitter) -> PolygonEmitter {
    PolygonEmitter { vertices: light.corners().to_vec(), normal: light.normal, two_sided: light.two_sided }
}
