//! Lights as the layer shaders read them, and which shader answers for which light and method.

use glam::DVec3;

use super::shader::{Module, Source};
use super::types::{ClusterLight, DirectionalLight, Lobe, PointLight, f32_of, u32_of, vec3_of, vec4_of};
use crate::light::Emitter;
use crate::shading::{Method, PhongLobe};

/// The WGSL that answers for a light: one pipeline each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Responder {
    /// The modules that it needs beside [`Module::COMMON`].
    pub(crate) modules: &'static [Module],
    /// `fn (Shading) -> Response`.
    pub(crate) function: &'static str,
}

impl Responder {
    const POINT: Self = Self { modules: &[Module::POINT], function: "point_respond" };
    const DIRECTIONAL: Self = Self { modules: &[Module::POINT], function: "directional_respond" };
    const CLUSTER: Self = Self { modules: &[Module::POINT, Module::CLUSTER], function: "cluster_respond" };

    /// Every one.
    #[cfg(test)]
    pub(crate) const ALL: &[Self] = &[Self::POINT, Self::DIRECTIONAL, Self::CLUSTER];

    /// The whole shader of a layer.
    pub(crate) fn source(&self) -> Source {
        let modules = [&[Module::FULLSCREEN, Module::COMMON], self.modules, &[Module::LAYER]].concat();
        let respond = format!("fn respond(at: Shading) -> Response {{ return {}(at); }}", self.function);
        Source::join(&modules).with("respond", &respond)
    }
}

/// All that a layer's pixels depend on beside the G-buffer and the lobes. Equal data give equal layers.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LightData {
    /// The shader.
    pub(crate) responder: Responder,
    /// Its uniform.
    pub(crate) uniform: Vec<u8>,
    /// Its vertices; never empty, because a binding may not be.
    pub(crate) vertices: Vec<[f32; 4]>,
}

impl LightData {
    /// An emitter as `method` sees it, about the eye. `reference` has no shader: the closed form stands in.
    pub(crate) fn new(emitter: &Emitter, method: Method, eye: DVec3) -> Self {
        let _ = method;
        match emitter {
            Emitter::Point(point) => {
                let position = vec3_of(point.position - eye);
                Self::without_vertices(Responder::POINT, &PointLight { position, unused: 0 })
            }
            Emitter::Directional(directional) => {
                let to_light = vec3_of(directional.to_light);
                Self::without_vertices(Responder::DIRECTIONAL, &DirectionalLight { to_light, unused: 0 })
            }
            Emitter::Polygon(polygon) => {
                let area = polygon.vector_area().length();
                let emission = 1 + u32::from(polygon.two_sided);
                Self::cluster(&[(polygon.centroid() - eye, area)], polygon.normal, emission, 2.0)
            }
            Emitter::Line(line) => Self::cluster(&[(line.middle() - eye, line.length())], DVec3::ZERO, 0, line.falloff),
            Emitter::Sphere(sphere) => {
                let strength = std::f64::consts::PI * sphere.radius * sphere.radius;
                Self::cluster(&[(sphere.center - eye, strength)], DVec3::ZERO, 0, 2.0)
            }
        }
    }

    fn without_vertices<T: bytemuck::Pod>(responder: Responder, uniform: &T) -> Self {
        Self { responder, uniform: bytemuck::bytes_of(uniform).to_vec(), vertices: vec![[0.0; 4]] }
    }

    fn cluster(points: &[(DVec3, f64)], normal: DVec3, emission: u32, falloff: f64) -> Self {
        let uniform = ClusterLight {
            normal: vec3_of(normal),
            emission,
            falloff: f32_of(falloff),
            count: u32_of(points.len()),
            pad: [0; 2],
        };
        Self {
            responder: Responder::CLUSTER,
            uniform: bytemuck::bytes_of(&uniform).to_vec(),
            vertices: points.iter().map(|(position, strength)| vec4_of(*position, *strength)).collect(),
        }
    }
}

/// A lobe as the shaders read it.
pub(crate) fn lobe(lobe: &PhongLobe) -> Lobe {
    Lobe { exponent: f32_of(lobe.exponent()), ..Default::default() }
}
