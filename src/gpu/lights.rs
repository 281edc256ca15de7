//! Lights as the layer shaders read them, and which shader answers for which light and method.

use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use glam::DVec3;

use super::shader::{Module, Source};
use super::table::Table;
use super::textured::{STAGES, Stage};
use super::types::{
    CapLight, ClusterLight, DirectionalLight, DiskLight, FitLight, LineLight, OneShotLight, PointLight, PolygonLight,
    SkyLight, SphereLight, TexturedLight, WebLight, f32_of, u32_of, vec3_of, vec4_of,
};
use crate::light::{
    CapEmitter, DiskEmitter, Emitter, LineEmitter, PointEmitter, PolygonEmitter, SkyEmitter, SphereEmitter,
    TexturedEmitter, Web,
};
use crate::shading::cluster::{self, PointOfArea};
use crate::shading::fit::{Fit, Punctual};
use crate::shading::one_shot::{KNOTS, Kernel, OneShot, Radius};
use crate::shading::sphere::Cap;
use crate::shading::{Method, textured};

// How a cluster's points emit, in `cluster.wgsl`; isotropic is 0.
const ONE_SIDED: u32 = 1;
const TWO_SIDED: u32 = 2;
const TUBE: u32 = 3;
const DIRECTIONS: u32 = 4;

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
    const WEB: Self = Self { modules: &[Module::POINT, Module::WEB], function: "web_respond" };
    const DIRECTIONAL: Self = Self { modules: &[Module::POINT], function: "directional_respond" };
    const LINE_EXACT: Self = Self::line("line_respond_exact");
    const LINE_CHEBYSHEV: Self = Self::line("line_respond_chebyshev");
    const LINE_CHEBYSHEV_LONG: Self = Self::line("line_respond_chebyshev_long");
    const LINE_NEAREST_POINT: Self = Self::line("line_respond_nearest_point");
    const LINE_EXACT_DECAYING: Self = Self::line("line_respond_exact_decaying");
    const LINE_CHEBYSHEV_DECAYING: Self = Self::line("line_respond_chebyshev_decaying");
    const LINE_NEAREST_POINT_DECAYING: Self = Self::line("line_respond_nearest_point_decaying");
    const SPHERE_EXACT: Self = Self { modules: &[Module::POINT, Module::SPHERE], function: "sphere_respond_exact" };
    const SPHERE_HERMITE_1: Self =
        Self { modules: &[Module::POINT, Module::SPHERE], function: "sphere_respond_hermite_1" };
    const SPHERE_HERMITE_2: Self =
        Self { modules: &[Module::POINT, Module::SPHERE], function: "sphere_respond_hermite_2" };
    const SPHERE_CLUSTER: Self = Self { modules: &[Module::POINT, Module::SPHERE], function: "sphere_respond_cluster" };
    const POLYGON_EXACT: Self =
        Self { modules: &[Module::POINT, Module::CONTOUR, Module::POLYGON], function: "polygon_respond_exact" };
    const POLYGON_NEAREST_POINT: Self =
        Self { modules: &[Module::POINT, Module::CONTOUR, Module::POLYGON], function: "polygon_respond_nearest_point" };
    const POLYGON_NEAREST_POINT_PICOTT: Self = Self {
        modules: &[Module::POINT, Module::CONTOUR, Module::POLYGON],
        function: "polygon_respond_nearest_point_picott",
    };
    const ONE_SHOT: Self = Self { modules: &[Module::ONE_SHOT], function: "one_shot_respond" };
    const ONE_SHOT_SQUARE: Self = Self { modules: &[Module::ONE_SHOT], function: "one_shot_respond_square" };
    const ONE_SHOT_SIZED: Self = Self { modules: &[Module::ONE_SHOT], function: "one_shot_respond_sized" };
    const TEXTURED_EXACT: Self = Self { modules: &[Module::TEXTURED], function: "textured_respond" };
    const DISK_EXACT: Self = Self {
        modules: &[Module::POINT, Module::SPHERE, Module::DISK, Module::DISK_PHONG],
        function: "disk_respond_exact",
    };
    const CAP_EXACT: Self = Self::cap("cap_respond_exact");
    const CAP_HERMITE_1: Self = Self::cap("cap_respond_hermite_1");
    const CAP_HERMITE_2: Self = Self::cap("cap_respond_hermite_2");
    const CAP_CLUSTER: Self = Self::cap("cap_respond_cluster");
    const SKY_EXACT: Self =
        Self { modules: &[Module::POINT, Module::SPHERE, Module::SKY], function: "sky_respond_exact" };
    const CLUSTER: Self = Self { modules: &[Module::POINT, Module::CLUSTER], function: "cluster_respond" };
    const FIT: Self = Self { modules: &[Module::POINT, Module::FIT], function: "fit_respond" };

    /// Every one.
    #[cfg(test)]
    pub(crate) const ALL: &[Self] = &[
        Self::POINT,
        Self::WEB,
        Self::DIRECTIONAL,
        Self::CLUSTER,
        Self::FIT,
        Self::LINE_EXACT,
        Self::LINE_CHEBYSHEV,
        Self::LINE_CHEBYSHEV_LONG,
        Self::LINE_NEAREST_POINT,
        Self::LINE_EXACT_DECAYING,
        Self::LINE_CHEBYSHEV_DECAYING,
        Self::LINE_NEAREST_POINT_DECAYING,
        Self::SPHERE_EXACT,
        Self::SPHERE_HERMITE_1,
        Self::SPHERE_HERMITE_2,
        Self::SPHERE_CLUSTER,
        Self::POLYGON_EXACT,
        Self::POLYGON_NEAREST_POINT,
        Self::POLYGON_NEAREST_POINT_PICOTT,
        Self::DISK_EXACT,
        Self::CAP_EXACT,
        Self::CAP_HERMITE_1,
        Self::CAP_HERMITE_2,
        Self::CAP_CLUSTER,
        Self::SKY_EXACT,
        Self::ONE_SHOT,
        Self::ONE_SHOT_SQUARE,
        Self::ONE_SHOT_SIZED,
        Self::TEXTURED_EXACT,
    ];

    const fn line(function: &'static str) -> Self {
        Self { modules: &[Module::POINT, Module::LINE], function }
    }

    const fn cap(function: &'static str) -> Self {
        Self { modules: &[Module::POINT, Module::SPHERE, Module::CAP], function }
    }

    /// What answers for any exponent without the tables that are made of one.
    pub(crate) fn for_any_exponent(self) -> Self {
        if self == Self::LINE_EXACT { Self::LINE_EXACT_DECAYING } else { self }
    }

    /// Whether it has the lobe's Chebyshev fit.
    pub(crate) fn reads_fits(self) -> bool {
        matches!(self, Self::LINE_CHEBYSHEV | Self::LINE_CHEBYSHEV_LONG | Self::LINE_CHEBYSHEV_DECAYING)
    }

    /// The whole shader of a layer; of a matte scene, its specular part is 0, and what it would take is not computed.
    pub(crate) fn source(&self, matte: bool) -> Source {
        let modules = [&[Module::FULLSCREEN, Module::COMMON], self.modules, &[Module::LAYER]].concat();
        let response = format!("{}(at)", self.function);
        let response = if matte { format!("Response({response}.irradiance, 0.0)") } else { response };
        let respond = format!("fn respond(at: Shading) -> Response {{ return {response}; }}");
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
    /// Its table.
    pub(crate) table: Table,
    /// What answers for lobes that are no cosine, where this is a closed form and there are such lobes.
    pub(crate) other_lobes: Option<Box<Self>>,
}

/// Points of the cluster that stands for a closed form's light where the lobe is no cosine.
const OTHER_LOBES_POINTS: u32 = 256;

impl LightData {
    /// How many stages its layer is made in.
    pub(crate) fn stages(&self) -> usize {
        if self.responder == Responder::TEXTURED_EXACT { STAGES.len() } else { 1 }
    }

    /// The uniform of a stage.
    pub(crate) fn uniform_at(&self, stage: usize) -> Cow<'_, [u8]> {
        if self.responder != Responder::TEXTURED_EXACT {
            return Cow::Borrowed(&self.uniform);
        }
        let Stage { opening, negligible } = STAGES[stage.min(STAGES.len() - 1)];
        let light: TexturedLight = bytemuck::pod_read_unaligned(&self.uniform);
        Cow::Owned(bytemuck::bytes_of(&TexturedLight { opening, negligible, ..light }).to_vec())
    }

    /// An emitter as `method` sees it, about the eye. `reference` has no shader: the closed form stands in.
    pub(crate) fn new(emitter: &Emitter, method: Method, eye: DVec3) -> Self {
        if let Some(one_shot) = OneShot::new(emitter, method) {
            return Self::one_shot(&one_shot, eye);
        }
        if let Method::Fit(count) = method
            && let Some(fit) = Fit::new(emitter, count, None)
        {
            return Self::fit(fit.lights(), eye);
        }
        match emitter {
            Emitter::Point(light) => Self::point(light, eye),
            Emitter::Directional(light) => Self::directional(light.to_light, 1.0),
            Emitter::Disk(light) => Self::disk(light, method, eye),
            Emitter::Textured(light) => Self::textured(light, method, eye),
            Emitter::Cap(light) => Self::cap(light, method),
            Emitter::Sky(light) => Self::sky(light, method),
            Emitter::Polygon(light) => Self::polygon(light, method, eye),
            Emitter::Line(light) => Self::line(light, method, eye),
            Emitter::Sphere(light) => Self::sphere(light, method, eye),
        }
    }

    /// With a cluster for lobes that are no cosine, if the method needs one for them.
    pub(crate) fn with_other_lobes(self, emitter: &Emitter, method: Method, eye: DVec3) -> Self {
        let needed = !method.takes_any_lobe() && !emitter.is_one_direction();
        let cluster = || match emitter {
            Emitter::Sky(light) => Self::sky_cluster(light),
            _ => Self::new(emitter, Method::PointCluster(OTHER_LOBES_POINTS), eye),
        };
        Self { other_lobes: needed.then(|| Box::new(cluster())), ..self }
    }

    /// A sky as so many lights infinitely far, each of the same solid angle.
    fn sky_cluster(light: &SkyEmitter) -> Self {
        let part = TAU / f64::from(OTHER_LOBES_POINTS);
        let dome = Cap::new(light.zenith, FRAC_PI_2);
        let directions = cluster::cap_directions(&dome, OTHER_LOBES_POINTS);
        let luminance = |w: DVec3| light.uniform + light.cosine * w.dot(light.zenith);
        let points = directions.map(|w| vec4_of(w, part * luminance(w))).collect();
        Self::cluster(points, ClusterLight { emission: DIRECTIONS, falloff: 2.0, ..Default::default() })
    }

    fn point(light: &PointEmitter, eye: DVec3) -> Self {
        let position = vec3_of(light.position - eye);
        let Some(Web { light_from_world, distribution }) = &light.web else {
            return Self::without_vertices(Responder::POINT, &PointLight { position, unused: 0 });
        };
        let axes = light_from_world.transpose();
        let uniform = WebLight {
            position,
            gammas: u32_of(distribution.gammas().len()),
            x_axis: vec3_of(axes.x_axis),
            planes: u32_of(distribution.planes().len()),
            y_axis: vec3_of(axes.y_axis),
            z_axis: vec3_of(axes.z_axis),
            ..Default::default()
        };
        let table = Table::Web(Arc::clone(distribution));
        Self { table, ..Self::without_vertices(Responder::WEB, &uniform) }
    }

    fn directional(to_light: DVec3, illuminance: f64) -> Self {
        let (to_light, illuminance) = (vec3_of(to_light), f32_of(illuminance));
        Self::without_vertices(Responder::DIRECTIONAL, &DirectionalLight { to_light, illuminance })
    }

    fn disk(light: &DiskEmitter, method: Method, eye: DVec3) -> Self {
        let count = match method {
            Method::PointCluster(points) => points,
            Method::Point => 1,
            _ => {
                let uniform = DiskLight {
                    center: vec3_of(light.center - eye),
                    radius: f32_of(light.radius),
                    normal: vec3_of(light.normal),
                    two_sided: u32::from(light.two_sided),
                };
                return Self::without_vertices(Responder::DISK_EXACT, &uniform);
            }
        };
        let points: Vec<_> = cluster::disk_points(light, count).collect();
        Self::area_cluster(light.normal, light.two_sided, &points, eye)
    }

    fn cap(light: &CapEmitter, method: Method) -> Self {
        let (responder, count) = match method {
            Method::Point | Method::PointCluster(0 | 1) => {
                return Self::directional(light.to_center, light.illuminance());
            }
            Method::PointCluster(count) => (Responder::CAP_CLUSTER, count),
            Method::Hermite1 => (Responder::CAP_HERMITE_1, 0),
            Method::Hermite2 => (Responder::CAP_HERMITE_2, 0),
            _ => (Responder::CAP_EXACT, 0),
        };
        let (sin, cos) = light.half_angle.sin_cos();
        let uniform = CapLight {
            to_center: vec3_of(light.to_center),
            sin_sigma: f32_of(sin),
            cos_sigma: f32_of(cos),
            count,
            ..Default::default()
        };
        Self::without_vertices(responder, &uniform)
    }

    fn sky(light: &SkyEmitter, method: Method) -> Self {
        if method == Method::Point {
            return Self::directional(light.zenith, light.illuminance());
        }
        let uniform = SkyLight {
            zenith: vec3_of(light.zenith),
            even: f32_of(light.uniform),
            cosine: f32_of(light.cosine),
            ..Default::default()
        };
        Self::without_vertices(Responder::SKY_EXACT, &uniform)
    }

    fn polygon(light: &PolygonEmitter, method: Method, eye: DVec3) -> Self {
        let responder = match method {
            Method::PointCluster(points) => {
                let points = cluster::polygon_points(light, points);
                return Self::area_cluster(light.normal, light.two_sided, &points, eye);
            }
            Method::Point => {
                let whole = PointOfArea { position: light.centroid(), area: light.vector_area().length() };
                return Self::area_cluster(light.normal, light.two_sided, &[whole], eye);
            }
            Method::NearestPoint => Responder::POLYGON_NEAREST_POINT,
            Method::NearestPointPicott => Responder::POLYGON_NEAREST_POINT_PICOTT,
            _ => Responder::POLYGON_EXACT,
        };
        let uniform = PolygonLight {
            normal: vec3_of(light.normal),
            count: u32_of(light.vertices.len()),
            two_sided: u32::from(light.two_sided),
            ..Default::default()
        };
        Self {
            responder,
            uniform: bytemuck::bytes_of(&uniform).to_vec(),
            vertices: light.vertices.iter().map(|vertex| vec4_of(*vertex - eye, 0.0)).collect(),
            table: Table::None,
            other_lobes: None,
        }
    }

    fn textured(light: &TexturedEmitter, method: Method, eye: DVec3) -> Self {
        let points = match method {
            Method::PointCluster(points) => points,
            Method::Point => 1,
            _ => {
                let uniform = TexturedLight {
                    corner: vec3_of(light.corner - eye),
                    two_sided: u32::from(light.two_sided),
                    row: vec3_of(light.row),
                    column: vec3_of(light.column),
                    normal: vec3_of(light.normal),
                    ..Default::default()
                };
                let table = Table::Parts(Arc::clone(&light.pattern));
                return Self { table, ..Self::without_vertices(Responder::TEXTURED_EXACT, &uniform) };
            }
        };
        Self::area_cluster(light.normal, light.two_sided, &textured::textured_points(light, points), eye)
    }

    fn area_cluster(normal: DVec3, two_sided: bool, points: &[PointOfArea], eye: DVec3) -> Self {
        let points = points.iter().map(|point| vec4_of(point.position - eye, point.area)).collect();
        let emission = if two_sided { TWO_SIDED } else { ONE_SIDED };
        Self::cluster(points, ClusterLight { normal: vec3_of(normal), emission, falloff: 2.0, ..Default::default() })
    }

    fn line(light: &LineEmitter, method: Method, eye: DVec3) -> Self {
        let plain = light.falloff == 2.0 && light.tube.is_none();
        let responder = match method {
            Method::PointCluster(points) => return Self::line_cluster(light, points, eye),
            Method::Point => return Self::line_cluster(light, 1, eye),
            Method::Chebyshev { degree: ..=7, .. } if plain => Responder::LINE_CHEBYSHEV,
            Method::Chebyshev { .. } if plain => Responder::LINE_CHEBYSHEV_LONG,
            Method::Chebyshev { .. } => Responder::LINE_CHEBYSHEV_DECAYING,
            Method::NearestPoint if plain => Responder::LINE_NEAREST_POINT,
            Method::NearestPoint => Responder::LINE_NEAREST_POINT_DECAYING,
            _ if plain => Responder::LINE_EXACT,
            _ => Responder::LINE_EXACT_DECAYING,
        };
        let (a, b) = (vec3_of(light.a - eye), vec3_of(light.b - eye));
        let diameter = f32_of(light.tube.map_or(0.0, |radius| 2.0 * radius));
        Self::without_vertices(responder, &LineLight { a, falloff: f32_of(light.falloff), b, diameter })
    }

    fn line_cluster(light: &LineEmitter, points: u32, eye: DVec3) -> Self {
        let part = light.length() / f64::from(points) * light.tube.map_or(1.0, |radius| 2.0 * radius);
        let points = cluster::line_points(light, points).map(|position| vec4_of(position - eye, part)).collect();
        let emission = if light.tube.is_some() { TUBE } else { 0 };
        let normal = vec3_of((light.b - light.a).normalize_or_zero());
        Self::cluster(points, ClusterLight { normal, emission, falloff: f32_of(light.falloff), ..Default::default() })
    }

    fn sphere(light: &SphereEmitter, method: Method, eye: DVec3) -> Self {
        let (responder, count) = match method {
            Method::Point | Method::PointCluster(0 | 1) => return Self::sphere_point(light, eye),
            Method::PointCluster(count) => (Responder::SPHERE_CLUSTER, count),
            Method::Hermite1 => (Responder::SPHERE_HERMITE_1, 0),
            Method::Hermite2 => (Responder::SPHERE_HERMITE_2, 0),
            _ => (Responder::SPHERE_EXACT, 0),
        };
        let (center, radius) = (vec3_of(light.center - eye), f32_of(light.radius));
        Self::without_vertices(responder, &SphereLight { center, radius, count, ..Default::default() })
    }

    fn sphere_point(light: &SphereEmitter, eye: DVec3) -> Self {
        let intensity = PI * light.radius * light.radius;
        let points = vec![vec4_of(light.center - eye, intensity)];
        Self::cluster(points, ClusterLight { falloff: 2.0, ..Default::default() })
    }

    fn one_shot(light: &OneShot, eye: DVec3) -> Self {
        let (frame, pattern, kernel) = (light.frame(), light.pattern(), light.radius().kernel());
        let fitted = light.radius() != Radius::Sized;
        let mut shares = [[0.0; 4]; 2];
        for (i, share) in shares.iter_mut().flatten().take(KNOTS).enumerate().filter(|_| fitted) {
            *share = f32_of(pattern.specular_knot(kernel, i).log2());
        }
        let uniform = OneShotLight {
            center: vec3_of(frame.center - eye),
            texel: f32_of(frame.texel),
            axis_u: vec3_of(frame.axis_u),
            alpha: if fitted { f32_of(pattern.alpha(kernel)) } else { 0.0 },
            axis_v: vec3_of(frame.axis_v),
            radius: f32_of(pattern.radius()),
            normal: vec3_of(frame.normal),
            two_sided: u32::from(frame.two_sided),
            shares,
            is_round: u32::from(frame.is_round),
            ..Default::default()
        };
        let responder = match light.radius() {
            Radius::Fitted(Kernel::Disk) => Responder::ONE_SHOT,
            Radius::Fitted(Kernel::Square) => Responder::ONE_SHOT_SQUARE,
            Radius::Sized => Responder::ONE_SHOT_SIZED,
        };
        let table = Table::Pattern(Arc::clone(pattern), kernel);
        Self { table, ..Self::without_vertices(responder, &uniform) }
    }

    fn fit(lights: &[Punctual], eye: DVec3) -> Self {
        let vertices = |light: &Punctual| match *light {
            Punctual::Point { position, intensity } => [vec4_of(position - eye, intensity), vec4_of(DVec3::ZERO, 1.0)],
            Punctual::Spot { position, intensity, axis, cone } => {
                let [scale, offset] = cone.ramp();
                [vec4_of(position - eye, intensity), vec4_of(scale * axis, offset)]
            }
            Punctual::Directional { to_light, illuminance } => [vec4_of(to_light, illuminance), [0.0; 4]],
        };
        let is_far = u32::from(lights.iter().all(|light| light.position().is_none()));
        let none = Self::without_vertices(Responder::FIT, &FitLight { count: u32_of(lights.len()), is_far });
        let vertices: Vec<_> = lights.iter().flat_map(vertices).collect();
        if vertices.is_empty() { none } else { Self { vertices, ..none } }
    }

    fn without_vertices<T: bytemuck::Pod>(responder: Responder, uniform: &T) -> Self {
        Self {
            responder,
            uniform: bytemuck::bytes_of(uniform).to_vec(),
            vertices: vec![[0.0; 4]],
            table: Table::None,
            other_lobes: None,
        }
    }

    fn cluster(points: Vec<[f32; 4]>, uniform: ClusterLight) -> Self {
        let uniform = ClusterLight { count: u32_of(points.len()), ..uniform };
        let uniform = bytemuck::bytes_of(&uniform).to_vec();
        Self { responder: Responder::CLUSTER, uniform, vertices: points, table: Table::None, other_lobes: None }
    }
}
