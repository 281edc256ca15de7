//! Disk lights.

use super::{Method, PhongLobe, Response, ShadingPoint, polygon};
use crate::light::{DiskEmitter, PolygonEmitter};

/// Response to a disk of luminance 1 by a method.
pub fn respond(light: &DiskEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    polygon::respond(&as_polygon(light), method, at, lobe)
}

/// The regular polygon of 64 corners on the rim.
pub fn as_polygon(light: &DiskEmitter) -> PolygonEmitter {
    PolygonEmitter { vertices: light.rim(64).collect(), normal: light.normal, two_sided: light.two_sided }
}
