//! Shadow layers: what share of each light is seen, at every pixel of a G-buffer, by rays that add up over passes.

use std::collections::HashMap;
use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::pass::{self, Binding, Target};
use super::shader::{Module, Source};
use super::table::Table;
use super::tables::Tables;
use super::types::{ShadowLight, ShadowPass as Rays, f32_of, u32_of, vec3_of};
use crate::light::{DiskEmitter, Emitter, LineEmitter, PolygonEmitter, TexturedEmitter};
use crate::surface::{Shape, Surface};

/// Sums of what is seen and of all, diffuse and specular.
pub(crate) const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// Rays to a light from a pixel's centre, after each stage.
const CENTRED: [u32; 3] = [4, 8, 16];
/// Rays to a light from each place off it.
const JITTERED: [u32; 1] = [8];
/// Rays to a light that is in one direction; exact shadows are made as fast.
const SINGLE: [u32; 1] = [1];

/// Whether any of these surfaces may cast a shadow that is seen: a single flat one does not.
pub(crate) fn are_cast(surfaces: &[Surface]) -> bool {
    match surfaces {
        [] => false,
        [only] => !matches!(only.shape, Shape::Plane {} | Shape::Square { .. } | Shape::Disk { .. }),
        _ => true,
    }
}

/// How it is found out what is seen of a kind of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Finder {
    /// By rays to its points.
    Rays(Points),
    /// By one ray; whether it is infinitely far.
    Ray {
        /// `fn (Shading, vec2f) -> LightPoint`.
        draw: &'static str,
        /// Infinitely far.
        is_distant: bool,
    },
    /// A line's seen parts, each shaded by this `fn (Shading, vec3f, vec3f) -> vec2f`.
    LineParts(&'static str),
}

/// How the points of a light are found, in `shadow_lights.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Points {
    /// `fn (Shading, vec2f) -> LightPoint`.
    draw: &'static str,
    /// `fn (Shading, vec3f) -> LightPoint`.
    meet: &'static str,
    /// `fn (vec3f) -> f32`.
    solid_angle: &'static str,
    /// Infinitely far.
    is_distant: bool,
}

impl Finder {
    const POLYGON: Self = Self::area("polygon_draw", "polygon_meet", "flat_solid_angle");
    const DISK: Self = Self::area("disk_draw", "disk_meet", "flat_solid_angle");
    const TEXTURED: Self = Self::area("textured_draw", "textured_meet", "flat_solid_angle");
    const SPHERE: Self = Self::area("sphere_draw", "sphere_meet", "sphere_solid_angle");
    const CAP: Self = Self::distant("cap_draw", "cap_meet", "cap_solid_angle");
    const SKY: Self = Self::distant("sky_draw", "sky_meet", "sky_solid_angle");
    const POINT: Self = Self::Ray { draw: "point_draw", is_distant: false };
    const DIRECTIONAL: Self = Self::Ray { draw: "directional_draw", is_distant: true };
    const LINE: Self = Self::LineParts("line_part_plain");
    const LINE_DECAYING: Self = Self::LineParts("line_part_decaying");
    const LINE_OF_OTHER_LOBES: Self = Self::LineParts("line_part_of_other_lobes");

    /// Every one.
    #[cfg(test)]
    pub(crate) const ALL: &[Self] = &[
        Self::POLYGON,
        Self::DISK,
        Self::TEXTURED,
        Self::SPHERE,
        Self::CAP,
        Self::SKY,
        Self::POINT,
        Self::DIRECTIONAL,
        Self::LINE,
        Self::LINE_DECAYING,
        Self::LINE_OF_OTHER_LOBES,
    ];

    const fn area(draw: &'static str, meet: &'static str, solid_angle: &'static str) -> Self {
        Self::Rays(Points { draw, meet, solid_angle, is_distant: false })
    }

    const fn distant(draw: &'static str, meet: &'static str, solid_angle: &'static str) -> Self {
        Self::Rays(Points { draw, meet, solid_angle, is_distant: true })
    }

    /// The whole shader.
    pub(crate) fn source(&self) -> Source {
        match *self {
            Self::Rays(points) => Self::by_rays(points),
            Self::Ray { draw, is_distant } => {
                let (meet, solid_angle) = ("nothing_to_meet", "no_solid_angle");
                Self::by_rays(Points { draw, meet, solid_angle, is_distant })
            }
            Self::LineParts(part) => {
                let modules = [
                    Module::FULLSCREEN,
                    Module::COMMON,
                    Module::PRIMITIVES,
                    Module::OCCLUSION,
                    Module::POINT,
                    Module::LINE,
                    Module::LINE_HIDDEN,
                    Module::SHADOWED,
                    Module::LINE_SHADOW,
                ];
                let chosen =
                    format!("fn line_part(at: Shading, a: vec3f, b: vec3f) -> vec2f {{ return {part}(at, a, b); }}");
                Source::join(&modules).with("finder", &chosen)
            }
        }
    }

    fn by_rays(points: Points) -> Source {
        let modules = [
            Module::FULLSCREEN,
            Module::COMMON,
            Module::PRIMITIVES,
            Module::OCCLUSION,
            Module::SEQUENCE,
            Module::SHADOWED,
            Module::SHADOW_LIGHTS,
            Module::SHADOW,
        ];
        let Points { draw, meet, solid_angle, is_distant } = points;
        let hides = if is_distant { "hides_direction" } else { "hides" };
        let chosen = format!(
            "fn draw(at: Shading, u: vec2f) -> LightPoint {{ return {draw}(at, u); }}\n\
             fn meet(at: Shading, w: vec3f) -> LightPoint {{ return {meet}(at, w); }}\n\
             fn solid_angle(p: vec3f) -> f32 {{ return {solid_angle}(p); }}\n\
             fn is_hidden(p: vec3f, to_light: vec3f, own: u32) -> bool {{ return {hides}(p, to_light, own); }}\n"
        );
        Source::join(&modules).with("finder", &chosen)
    }
}

/// All that a light's shadow depends on beside the G-buffer, the surfaces and the lobes. Equal data give equal shadows.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ShadowData {
    finder: Finder,
    light: ShadowLight,
    /// A polygon's corners, as shares of the rectangle about it.
    corners: Vec<[f32; 4]>,
    table: Table,
}

impl ShadowData {
    /// An emitter about the eye, whatever the method that shades it; `other_lobes`: some lobes are no cosines.
    pub(crate) fn new(emitter: &Emitter, eye: DVec3, other_lobes: bool) -> Self {
        match emitter {
            Emitter::Polygon(light) => Self::polygon(light, eye),
            Emitter::Disk(light) => Self::disk(light, eye),
            Emitter::Textured(light) => Self::textured(light, eye),
            Emitter::Line(light) => Self::line(light, eye, other_lobes),
            Emitter::Sphere(light) => {
                let (place, size) = (vec3_of(light.center - eye), f32_of(light.radius));
                Self::plain(Finder::SPHERE, ShadowLight { place, size, ..Default::default() })
            }
            Emitter::Cap(light) => {
                let height = 2.0 * (0.5 * light.half_angle).sin().powi(2);
                let (place, size) = (vec3_of(light.to_center), f32_of(height));
                Self::plain(Finder::CAP, ShadowLight { place, size, ..Default::default() })
            }
            Emitter::Sky(light) => {
                let place = vec3_of(light.zenith);
                let (size, part) = (f32_of(light.uniform), f32_of(light.cosine));
                Self::plain(Finder::SKY, ShadowLight { place, size, part, ..Default::default() })
            }
            Emitter::Point(light) => {
                let place = vec3_of(light.position - eye);
                Self::plain(Finder::POINT, ShadowLight { place, ..Default::default() })
            }
            Emitter::Directional(light) => {
                let place = vec3_of(light.to_light);
                Self::plain(Finder::DIRECTIONAL, ShadowLight { place, ..Default::default() })
            }
        }
    }

    fn polygon(light: &PolygonEmitter, eye: DVec3) -> Self {
        let [corner, row, column] = rectangle_about(light);
        let share = |v: &DVec3| {
            let at = *v - corner;
            [row, column].map(|side| f32_of(at.dot(side) / side.length_squared()))
        };
        let shares = light.vertices.iter().map(share).map(|[u, v]| [u, v, 0.0, 0.0]);
        let flat = ShadowLight {
            count: u32_of(light.vertices.len()),
            ..flat([corner - eye, row, column], light.normal, light.two_sided)
        };
        Self { corners: shares.collect(), ..Self::plain(Finder::POLYGON, flat) }
    }

    fn disk(light: &DiskEmitter, eye: DVec3) -> Self {
        let (u, v) = light.normal.any_orthonormal_pair();
        let (row, column) = (2.0 * light.radius * u, 2.0 * light.radius * v);
        let corner = light.center - 0.5 * (row + column) - eye;
        Self::plain(Finder::DISK, flat([corner, row, column], light.normal, light.two_sided))
    }

    fn textured(light: &TexturedEmitter, eye: DVec3) -> Self {
        let flat = flat([light.corner - eye, light.row, light.column], light.normal, light.two_sided);
        Self { table: Table::Cells(Arc::clone(&light.pattern)), ..Self::plain(Finder::TEXTURED, flat) }
    }

    fn line(light: &LineEmitter, eye: DVec3, other_lobes: bool) -> Self {
        let finder = match light.tube {
            _ if other_lobes => Finder::LINE_OF_OTHER_LOBES,
            None if light.falloff == 2.0 => Finder::LINE,
            _ => Finder::LINE_DECAYING,
        };
        let line = ShadowLight {
            place: vec3_of(light.a - eye),
            size: f32_of(light.falloff),
            row: vec3_of(light.b - light.a),
            part: f32_of(2.0 * light.tube.unwrap_or_default()),
            ..Default::default()
        };
        Self::plain(finder, line)
    }

    fn plain(finder: Finder, light: ShadowLight) -> Self {
        Self { finder, light, corners: Vec::new(), table: Table::None }
    }

    /// Stages that it is made in, for a sample of that number: the centred one is 0.
    pub(crate) fn stages(&self, sample: u16) -> usize {
        self.ends(sample).len()
    }

    fn ends(&self, sample: u16) -> &'static [u32] {
        match (self.finder, sample) {
            (Finder::Ray { .. } | Finder::LineParts(_), _) => &SINGLE,
            (Finder::Rays(_), 0) => &CENTRED,
            (Finder::Rays(_), _) => &JITTERED,
        }
    }

    /// The rays of a stage. Those of all samples together are one run of the sequence.
    fn rays(&self, sample: u16, stage: usize) -> Range<u32> {
        let before = match sample {
            0 => 0,
            _ => CENTRED[CENTRED.len() - 1] + u32::from(sample - 1) * JITTERED[0],
        };
        let ends = self.ends(sample);
        let stage = stage.min(ends.len() - 1);
        let first = if stage == 0 { 0 } else { ends[stage - 1] };
        before + first..before + ends[stage]
    }
}

fn flat([corner, row, column]: [DVec3; 3], normal: DVec3, two_sided: bool) -> ShadowLight {
    ShadowLight {
        place: vec3_of(corner),
        row: vec3_of(row),
        column: vec3_of(column),
        normal: vec3_of(normal),
        two_sided: u32::from(two_sided),
        ..Default::default()
    }
}

/// Corner and sides of the smallest rectangle about a polygon with a side along one of its edges.
fn rectangle_about(light: &PolygonEmitter) -> [DVec3; 3] {
    let edges = light.vertices.iter().zip(light.vertices.iter().cycle().skip(1));
    let axes = edges.filter_map(|(a, b)| (b - a).try_normalize()).map(|u| (u, light.normal.cross(u)));
    let rectangles = axes.map(|(u, v)| {
        let places = light.vertices.iter().map(|p| DVec2::new(p.dot(u), p.dot(v)));
        let (least, greatest) = places
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(least, greatest), at| (least.min(at), greatest.max(at)));
        let size = greatest - least;
        let depth = light.vertices.first().map_or(0.0, |p| p.dot(light.normal));
        (size.x * size.y, [least.x * u + least.y * v + depth * light.normal, size.x * u, size.y * v])
    });
    rectangles.min_by(|(a, _), (b, _)| a.total_cmp(b)).map_or([DVec3::ZERO; 3], |(_, rectangle)| rectangle)
}

/// What casts shadow rays: one pipeline a kind of light, made when first needed.
#[derive(Debug)]
pub(crate) struct ShadowPass {
    light_layout: wgpu::BindGroupLayout,
    pipelines: HashMap<Finder, wgpu::RenderPipeline>,
    tables: Tables,
}

/// Layouts and bind groups of what all shadows of a sample read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Common<'a> {
    /// Of the G-buffer and the lobes.
    pub(crate) gbuffer: (&'a wgpu::BindGroupLayout, &'a wgpu::BindGroup),
    /// Of what rays meet.
    pub(crate) occluders: (&'a wgpu::BindGroupLayout, &'a wgpu::BindGroup),
    /// No material has a specular part.
    pub(crate) matte: bool,
    /// The sample's number.
    pub(crate) sample: u16,
}

impl ShadowPass {
    pub(crate) fn new(device: &wgpu::Device) -> Self {
        use Binding::{Storage, Texture, Uniform};
        Self {
            light_layout: pass::bind_group_layout(device, &[Uniform, Storage, Storage, Uniform, Texture]),
            pipelines: HashMap::new(),
            tables: Tables::default(),
        }
    }

    /// Adds the rays of a stage to the sums `before`, and writes a part of the sums to `after`.
    pub(crate) fn draw(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        common: Common<'_>,
        (shadow, stage): (&ShadowData, usize),
        [before, after]: [&Target; 2],
        part: [u32; 4],
    ) {
        let layouts = [common.gbuffer.0, &self.light_layout, common.occluders.0];
        let pipeline = self
            .pipelines
            .entry(shadow.finder)
            .or_insert_with(|| pass::pipeline(device, &shadow.finder.source(), "shadow", &layouts, &[FORMAT]));
        let rays = shadow.rays(common.sample, stage);
        let rays = Rays {
            first: rays.start,
            count: rays.end - rays.start,
            starts: u32::from(stage == 0),
            matte: u32::from(common.matte),
        };
        let uniform = pass::uniform(device, &shadow.light);
        let corners = pass::storage(device, &shadow.corners);
        let table = self.tables.buffer(device, &shadow.table);
        let rays = pass::uniform(device, &rays);
        let resources = [
            uniform.as_entire_binding(),
            corners.as_entire_binding(),
            table.as_entire_binding(),
            rays.as_entire_binding(),
            wgpu::BindingResource::TextureView(&before.view),
        ];
        let group = pass::bind_group(device, &self.light_layout, &resources);
        let groups = [common.gbuffer.1, &group, common.occluders.1];
        pass::run_over(encoder, pipeline, &groups, &[&after.view], wgpu::LoadOp::Load, Some(part));
    }
}
