//! A disk light: exactly, and as a point light.

mod cone;
mod irradiance;
mod phong;

pub use irradiance::disk_irradiance;
pub use phong::{disk_phong, disk_phong_lobe_only, disk_solid_angle};

use super::{Method, PhongLobe, Response, ShadingPoint, cluster, point};
use crate::light::DiskEmitter;

/// Response to a disk of luminance 1 by a method.
pub fn respond(light: &DiskEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    if !shines_on(light, at) {
        return Response::default();
    }
    match method {
        Method::PointCluster(points) => cluster::disk_cluster(light, points, at, lobe),
        Method::Point => disk_point(light, at, lobe),
        _ => Response {
            irradiance: disk_irradiance(light, at.p, at.n),
            specular: disk_phong(light, at.p, at.n, at.mirror(), lobe.exponent()),
        },
    }
}

/// The disk as one point light at its centre, I = L·πr²·cos at the light.
pub fn disk_point(light: &DiskEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    let to_light = light.center - at.p;
    let facing = -to_light.normalize_or_zero().dot(light.normal);
    let intensity = light.area() * if light.two_sided { facing.abs() } else { facing.max(0.0) };
    point::point_response(to_light, intensity, at, lobe)
}

/// Whether a point is on a lit side.
fn shines_on(light: &DiskEmitter, at: &ShadingPoint) -> bool {
    light.two_sided || light.normal.dot(at.p - light.center) > 0.0
}
