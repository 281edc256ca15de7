//! What a light does at a point: the methods, then one file a light shape.
//!
//! Every function here works on an [`Emitter`]: a light in the world at unit strength. Its [`Response`] times the
//! light's [`weight`](crate::light::Light::weight) and the material gives radiance.

pub mod cap;
pub mod cluster;
pub mod disk;
pub mod fit;
pub mod line;
mod lobe;
mod method;
pub mod one_shot;
pub mod point;
pub mod polygon;
mod prepared;
pub mod reference;
pub mod sky;
pub mod sphere;
pub mod textured;

pub use lobe::{Lobe, Lobe as PhongLobe, LobeModel};
pub use method::{Method, UnknownMethod};
pub use prepared::Prepared;
pub use reference::BoundedResponse;

use glam::DVec3;

use crate::light::Emitter;
use textured::quadrature::Sought;

/// A point to shade, and from where it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShadingPoint {
    /// Position in the world.
    pub p: DVec3,
    /// Unit surface normal.
    pub n: DVec3,
    /// Unit direction to the eye.
    pub v: DVec3,
}

impl ShadingPoint {
    /// The mirror direction r = 2(n·v)n − v, the axis of the specular lobe.
    pub fn mirror(&self) -> DVec3 {
        2.0 * self.n.dot(self.v) * self.n - self.v
    }
}

/// What a unit-strength emitter does at a point, before strength, tint and material.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Response {
    /// E = ∫ L(ω)(ω·n) dω over ω·n > 0. With unit luminance this is in lx per cd·m⁻².
    pub irradiance: f64,
    /// ∫ L(ω) ρ(ω) dω over ω·n > 0, ρ the lobe's density; Phong's is (m+1)/(2π)·max(0, ω·r)ᵐ.
    pub specular: f64,
}

/// The unit-strength response at a point by a method; methods that a shape does not have answer as
/// [`Method::Exact`] does (see [`Method::for_shape`]). Of lobes that are no power of a cosine, Blinn's and Cook and
/// Torrance's, methods but for point lights, clusters and one-shot have the specular part by quadrature. For more than one point, prepare the light: [`Prepared`].
pub fn respond(emitter: &Emitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    Prepared::new(emitter, method).respond(at, lobe)
}

/// The response by a method that needs nothing prepared.
fn answer(emitter: &Emitter, method: Method, at: &ShadingPoint, lobe: &Lobe, sought: Sought<'_>) -> Response {
    if method == Method::Reference {
        return reference::reference(emitter, at, lobe).response();
    }
    let (seen, factor) = lobe.seen(at);
    let Response { irradiance, specular } = answer_cosine(emitter, method, &seen, lobe, sought);
    let any_lobe = method.takes_any_lobe() || emitter.is_one_direction() || matches!(emitter, Emitter::Textured(_));
    if lobe.is_cosine() || any_lobe {
        return Response { irradiance, specular: factor * specular };
    }
    Response { irradiance, specular: reference::quick_specular(emitter, at, lobe).value }
}

/// The response of a shape's own module: its specular part is right for cosine lobes, and for all others by methods that
/// take any lobe.
fn answer_cosine(emitter: &Emitter, method: Method, at: &ShadingPoint, lobe: &Lobe, sought: Sought<'_>) -> Response {
    match emitter {
        Emitter::Polygon(light) => polygon::respond(light, method, at, lobe),
        Emitter::Line(light) => line::respond(light, method, at, lobe),
        Emitter::Sphere(light) => sphere::respond(light, method, at, lobe),
        Emitter::Disk(light) => disk::respond(light, method, at, lobe),
        Emitter::Textured(light) => textured::respond(light, method, at, lobe, sought),
        Emitter::Cap(light) => cap::respond(light, method, at, lobe),
        Emitter::Sky(light) => sky::respond(light, method, at, lobe),
        Emitter::Point(light) => point::respond(light, at, lobe),
        Emitter::Directional(light) => point::respond_directional(light, at, lobe),
    }
}
