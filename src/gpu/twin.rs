//! WGSL functions over tables of rows, to be compared with their f64 twins on the same inputs.

pub mod cases;

use std::fmt;
use std::sync::Arc;

use glam::DVec3;

use super::context::Context;
use super::lobes;
use super::occluders::{self, Items};
use super::pass;
use super::read_back::{self, ReadBackError};
use super::shader::{Module, Source};
use super::table;
use super::types::{TwinRow, f32_of, u32_of, vec4_of};
use crate::shading::one_shot::{Kernel, Prefiltered};
use crate::shading::{Method, PhongLobe};
use crate::surface::Surface;

/// A WGSL function that has a twin of the same name in `shading`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Function {
    /// Its name in Rust and in WGSL.
    pub name: &'static str,
    /// The modules that it needs beside [`Module::COMMON`].
    modules: &'static [Module],
    /// How it is called on a row: `f(i)` is number i of the row, `v(i)` the vector that begins there; the row's
    /// vertices are `vertices[row.first_vertex ..][.. row.vertex_count]`, and `lobes[lobe]` is its lobe.
    call: &'static str,
}

macro_rules! functions {
    ($($(#[$doc:meta])* $constant:ident = $name:literal in $modules:expr, $call:literal;)*) => {
        $($(#[$doc])* pub const $constant: Function =
            Function { name: $name, modules: $modules, call: concat!($name, $call) };)*

        /// Every function.
        pub const FUNCTIONS: &[Function] = &[$($constant),*];
    };
}

const DISK: &[Module] = &[Module::POINT, Module::SPHERE, Module::DISK, Module::DISK_PHONG];
const SKY: &[Module] = &[Module::POINT, Module::SPHERE, Module::SKY];

functions! {
    /// Row: normal, mirror direction, direction; and the lobe. Its twin is [`crate::shading::Lobe::density`].
    LOBE_DENSITY = "lobe_density" in &[], "(lobe, v(0), v(3), v(6))";
    /// Row: vector to the light, intensity, falloff, normal, mirror direction; and the lobe.
    FALLOFF_IRRADIANCE = "falloff_response" in &[Module::POINT], "(v(0), f(3), f(4), v(5), v(8), lobe).irradiance";
    /// Row: vector to the light, intensity, falloff, normal, mirror direction; and the lobe.
    FALLOFF_SPECULAR = "falloff_response" in &[Module::POINT], "(v(0), f(3), f(4), v(5), v(8), lobe).specular";
    /// Row: vector to the light, intensity, axis times scale and offset of the cone, normal, mirror direction; and the
    /// lobe. Its twin is [`crate::shading::fit::Punctual::respond`].
    SPOT_RESPONSE = "spot_response" in &[Module::POINT, Module::FIT],
        "(v(0), f(3), vec4f(v(4), f(7)), v(8), v(11), lobe).specular";
    /// Row: ends, normal, falloff, diameter.
    LINE_IRRADIANCE = "line_irradiance" in &[Module::POINT, Module::LINE], "(v(0), v(3), v(6), f(9), f(10))";
    /// Row: ends, normal, falloff, diameter, mirror direction; and the lobe.
    LINE_PHONG = "line_phong" in &[Module::POINT, Module::LINE], "(v(0), v(3), v(6), v(11), f(9), f(10), lobe)";
    /// Row: ends, normal, falloff, diameter, mirror direction; and the lobe.
    LINE_CHEBYSHEV = "line_chebyshev" in &[Module::POINT, Module::LINE],
        "(v(0), v(3), v(6), v(11), f(9), f(10), lobe)";
    /// Row: ends, normal, falloff, diameter, mirror direction; and the lobe.
    LINE_NEAREST_POINT = "line_nearest_point" in &[Module::POINT, Module::LINE],
        "(v(0), v(3), v(6), v(11), lobe, f(9), f(10))";
    /// Row: p, the light's normal, normal; and the corners.
    POLYGON_IRRADIANCE = "polygon_irradiance" in &[Module::CONTOUR, Module::POLYGON],
        "(Corners(row.first_vertex, row.vertex_count, v(0), v(3)), v(6))";
    /// Row: p, the light's normal, normal, mirror direction, exponent; and the corners.
    POLYGON_PHONG = "polygon_phong" in &[Module::CONTOUR, Module::POLYGON],
        "(Corners(row.first_vertex, row.vertex_count, v(0), v(3)), v(6), v(9), f(12))";
    /// Row: p, the light's normal, normal, mirror direction; and the corners.
    POLYGON_LEAST_ANGLE_COSINE = "polygon_least_angle_cosine" in &[Module::CONTOUR, Module::POLYGON],
        "(Corners(row.first_vertex, row.vertex_count, v(0), v(3)), v(6), v(9))";
    /// Row: p, the light's normal, normal, mirror direction; and the corners.
    POLYGON_PROJECTED_EDGE_COSINE = "polygon_projected_edge_cosine" in &[Module::CONTOUR, Module::POLYGON],
        "(Corners(row.first_vertex, row.vertex_count, v(0), v(3)), v(6), v(9))";
    /// Row: vector to the centre, radius, normal.
    SPHERE_IRRADIANCE = "sphere_irradiance" in &[Module::POINT, Module::SPHERE], "(v(0), f(3), v(4))";
    /// Row: vector to the centre, radius, normal.
    SPHERE_IRRADIANCE_HERMITE_1 = "sphere_irradiance_hermite_1" in &[Module::POINT, Module::SPHERE],
        "(v(0), f(3), v(4))";
    /// Row: vector to the centre, radius, normal.
    SPHERE_IRRADIANCE_HERMITE_2 = "sphere_irradiance_hermite_2" in &[Module::POINT, Module::SPHERE],
        "(v(0), f(3), v(4))";
    /// Row: vector to the centre, radius, normal, mirror direction, exponent.
    SPHERE_PHONG = "sphere_phong" in &[Module::POINT, Module::SPHERE], "(v(0), f(3), v(4), v(7), f(10))";
    /// Row: vector to the centre, radius, number of directions, normal, mirror direction; and the lobe.
    SPHERE_CLUSTER = "sphere_cluster" in &[Module::POINT, Module::SPHERE],
        "(v(0), f(3), u32(f(4)), v(5), v(8), lobe).specular";
    /// Row: an axis' parts along a plane and away from it, exponent.
    BRIGHTEST_STEP = "brightest_step" in &[Module::ONE_SHOT], "(f(0), f(1), f(2))";
    /// Row: place, radius; and a disk table. Its twin is [`crate::shading::one_shot::DiskTable::sum`].
    DISK_SUM = "disk_sum" in &[Module::ONE_SHOT], "(vec2f(f(0), f(1)), f(2))";
    /// Row: place, radius; and a mipmap. Its twin is [`crate::shading::one_shot::Mipmap::sum`].
    SQUARE_SUM = "square_sum" in &[Module::ONE_SHOT], "(vec2f(f(0), f(1)), f(2))";
    /// Row: vector to the centre, the disk's normal, radius, normal.
    DISK_IRRADIANCE = "disk_irradiance" in DISK, "(v(0), v(3), f(6), v(7))";
    /// Row: vector to the centre, the disk's normal, radius, normal, mirror direction, exponent.
    DISK_PHONG = "disk_phong" in DISK, "(v(0), v(3), f(6), v(7), v(10), f(13))";
    /// Row: centre, sine and cosine of the half-angle, normal.
    CAP_IRRADIANCE = "cap_irradiance" in &[Module::POINT, Module::SPHERE], "(Cap(v(0), f(3), f(4)), v(5))";
    /// Row: centre, sine and cosine of the half-angle, normal, mirror direction, exponent.
    CAP_PHONG = "cap_phong" in &[Module::POINT, Module::SPHERE], "(Cap(v(0), f(3), f(4)), v(5), v(8), f(11))";
    /// Row: zenith, uniform and cosine part, normal.
    SKY_IRRADIANCE = "sky_irradiance" in SKY, "(v(0), vec2f(f(3), f(4)), v(5))";
    /// Row: zenith, uniform and cosine part, normal, mirror direction, exponent.
    SKY_PHONG = "sky_phong" in SKY, "(v(0), vec2f(f(3), f(4)), v(5), v(8), f(11))";
    /// Row: p, to the light; among surfaces, p on none. Its twin is [`crate::visibility::Objects::hides`].
    HIDES = "hides" in &[Module::PRIMITIVES, Module::OCCLUSION], "(v(0), v(3), 0xffffffffu)";
    /// Row: p, to the light; p on the only surface. Its twin is [`crate::visibility::Objects::hides`].
    HIDES_FROM_ITSELF = "hides" in &[Module::PRIMITIVES, Module::OCCLUSION], "(v(0), v(3), 0u)";
    /// Row: p, to the light's beginning, along it, whether p is on the only surface, which of four numbers: two
    /// intervals. Its twin is [`crate::visibility::line::visible_segments`].
    HIDDEN_BY_PRIMITIVE = "hidden_by_primitive" in &[Module::PRIMITIVES, Module::OCCLUSION, Module::LINE_HIDDEN],
        "(0u, v(0), v(3), v(6), f(9) > 0.0)[u32(f(10))]";
    /// The same of a triangle: one interval.
    HIDDEN_BY_TRIANGLE = "hidden_by_triangle" in &[Module::PRIMITIVES, Module::OCCLUSION, Module::LINE_HIDDEN],
        "(0u, v(0), v(3), v(6))[u32(f(10))]";
    /// Row: y, x. Its twin is `f64::atan2`.
    ARCTANGENT = "arctangent" in &[], "(f(0), f(1))";
}

/// The inputs of one call. They should be rounded already ([`rounded`]), so that the f64 twin gets the same.
#[derive(Clone, Debug)]
pub struct Row {
    numbers: Vec<f32>,
    vertices: Vec<[f32; 4]>,
    lobe: PhongLobe,
    /// Whose Chebyshev fit the lobe has.
    method: Method,
    table: table::Table,
}

impl Default for Row {
    fn default() -> Self {
        let (numbers, vertices) = (Vec::new(), Vec::new());
        Self { numbers, vertices, lobe: PhongLobe::new(1.0), method: Method::CHEBYSHEV, table: table::Table::None }
    }
}

impl Row {
    /// Adds a number.
    #[must_use]
    pub fn number(mut self, x: f64) -> Self {
        self.numbers.push(f32_of(x));
        self
    }

    /// Adds the three numbers of a vector.
    #[must_use]
    pub fn vector(self, v: DVec3) -> Self {
        self.number(v.x).number(v.y).number(v.z)
    }

    /// Sets the vertices.
    #[must_use]
    pub fn vertices(mut self, vertices: &[DVec3]) -> Self {
        self.vertices = vertices.iter().map(|vertex| vec4_of(*vertex, 0.0)).collect();
        self
    }

    /// Sets the method whose Chebyshev fit the lobe has.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Sets the lobe.
    #[must_use]
    pub fn lobe(mut self, lobe: PhongLobe) -> Self {
        self.lobe = lobe;
        self
    }
}

impl Row {
    /// Sets the table; one run has that of its first row.
    #[must_use]
    pub fn pattern(mut self, pattern: &Arc<Prefiltered>, kernel: Kernel) -> Self {
        self.table = table::Table::Pattern(Arc::clone(pattern), kernel);
        self
    }
}

impl fmt::Display for Row {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.numbers)?;
        for [x, y, z, _] in &self.vertices {
            write!(f, " ({x}, {y}, {z})")?;
        }
        Ok(())
    }
}

/// A vector rounded once to f32, as the shaders get it.
pub fn rounded(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

/// A number rounded once to f32, as the shaders get it.
pub fn rounded_number(x: f64) -> f64 {
    f32_of(x).into()
}

/// The error that is allowed on the GPU: 1e-4·|expected| + 1e-6·scale.
pub fn bound(expected: f64, scale: f64) -> f64 {
    1e-4 * expected.abs() + 1e-6 * scale
}

/// How much of its [`bound`] an answer's error uses up.
///
/// At most 1 is right; not finite is infinitely wrong.
pub fn share_of_bound(x: f32, expected: f64, scale: f64) -> f64 {
    let error = (f64::from(x) - expected).abs();
    if !error.is_finite() {
        f64::INFINITY
    } else if error > 0.0 {
        error / bound(expected, scale)
    } else {
        0.0
    }
}

/// A function, ready to run on a device.
#[derive(Debug)]
pub struct Twin {
    context: Context,
    pipeline: wgpu::ComputePipeline,
    layouts: [wgpu::BindGroupLayout; 4],
    /// It reads what rays meet.
    among: bool,
}

impl Twin {
    /// The function as it is.
    pub fn new(context: &Context, function: &Function) -> Self {
        Self::compile(context, &source(function), function)
    }

    /// The function with an error in it: every `from` in its text is `to`. A comparison that can fail must then fail.
    ///
    /// None where its text does not have `from`.
    pub fn with_error(context: &Context, function: &Function, from: &str, to: &str) -> Option<Self> {
        let (source, count) = source(function).replaced(from, to);
        (count > 0).then(|| Self::compile(context, &source, function))
    }

    fn compile(context: &Context, source: &Source, function: &Function) -> Self {
        let module = source.compile(&context.device, "twin");
        let among = function.modules.contains(&Module::PRIMITIVES);
        let layouts = layouts(&context.device, among);
        let layout = context.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &layouts.each_ref().map(Some),
            immediate_size: 0,
        });
        let pipeline = context.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some("twin"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
        Self { context: context.clone(), pipeline, layouts, among }
    }

    /// The function's value on each row.
    ///
    /// # Errors
    ///
    /// [`ReadBackError`] where the device was lost.
    pub fn run(&self, rows: &[Row]) -> Result<Vec<f32>, ReadBackError> {
        self.run_among(rows, &[])
    }

    /// The same, among surfaces about the eye.
    ///
    /// # Errors
    ///
    /// [`ReadBackError`] where the device was lost.
    pub fn run_among(&self, rows: &[Row], surfaces: &[Surface]) -> Result<Vec<f32>, ReadBackError> {
        let Some(first) = rows.first() else { return Ok(Vec::new()) };
        let device = &self.context.device;
        let table = Table::new(rows);
        let size = (rows.len() * size_of::<f32>()) as u64;
        let make = |usage| {
            device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
        };
        let results = make(wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
        let copy = make(wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let lobes = pass::storage(device, &table.lobes);
        let vertices = pass::storage(device, &table.vertices);
        let places = pass::storage(device, &table.rows);
        let numbers = pass::storage(device, &table.numbers);
        let large = pass::storage(device, &first.table.numbers());
        let mut of_light = vec![(1, &vertices), (2, &large)];
        of_light.truncate(if self.among { 1 } else { 2 });
        let group = |layout: &wgpu::BindGroupLayout, buffers: &[(u32, &wgpu::Buffer)]| {
            let entries: Vec<_> = buffers
                .iter()
                .map(|(binding, buffer)| wgpu::BindGroupEntry {
                    binding: *binding,
                    resource: buffer.as_entire_binding(),
                })
                .collect();
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
        };
        let occluders = if self.among {
            Items::new(surfaces).about(DVec3::ZERO, &[]).group(device, &self.layouts[2])
        } else {
            group(&self.layouts[2], &[])
        };
        let groups = [
            group(&self.layouts[0], &[(2, &lobes)]),
            group(&self.layouts[1], &of_light),
            occluders,
            group(&self.layouts[3], &[(0, &places), (1, &numbers), (2, &results)]),
        ];

        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&self.pipeline);
            for (index, group) in (0..).zip(&groups) {
                pass.set_bind_group(index, group, &[]);
            }
            pass.dispatch_workgroups(u32_of(rows.len().div_ceil(64)), 1, 1);
        }
        encoder.copy_buffer_to_buffer(&results, 0, &copy, 0, size);
        self.context.queue.submit([encoder.finish()]);
        Ok(bytemuck::pod_collect_to_vec(&read_back::mapped(device, &copy)?))
    }
}

/// The whole shader.
pub(crate) fn source(function: &Function) -> Source {
    let modules = [&[Module::COMMON], function.modules, &[Module::TWIN]].concat();
    Source::join(&modules).with("evaluate", &format!("fn evaluate() -> f32 {{ return f32({}); }}", function.call))
}

/// Lobes, vertices and what rays meet where the light shaders have them, and the rows. A stage has eight storage buffers:
/// among what rays meet there is none for a table.
fn layouts(device: &wgpu::Device, among: bool) -> [wgpu::BindGroupLayout; 4] {
    let layout = |bindings: &[(u32, bool)]| {
        let entries: Vec<_> = bindings
            .iter()
            .map(|&(binding, read_only)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Storage { read_only },
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            })
            .collect();
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries })
    };
    let rows = layout(&[(0, true), (1, true), (2, false)]);
    if among {
        return [
            layout(&[(2, true)]),
            layout(&[(1, true)]),
            pass::bind_group_layout(device, &occluders::BINDINGS),
            rows,
        ];
    }
    [layout(&[(2, true)]), layout(&[(1, true), (2, true)]), layout(&[]), rows]
}

/// Rows in the layout of `twin.wgsl`.
#[derive(Default)]
struct Table {
    rows: Vec<TwinRow>,
    numbers: Vec<f32>,
    vertices: Vec<[f32; 4]>,
    lobes: Vec<super::types::Lobe>,
}

impl Table {
    fn new(rows: &[Row]) -> Self {
        let mut table = Self::default();
        for row in rows {
            table.rows.push(TwinRow {
                first_number: u32_of(table.numbers.len()),
                first_vertex: u32_of(table.vertices.len()),
                vertex_count: u32_of(row.vertices.len()),
                unused: 0,
            });
            table.numbers.extend_from_slice(&row.numbers);
            table.vertices.extend_from_slice(&row.vertices);
            table.lobes.push(lobes::lobe(&row.lobe, row.method));
        }
        table
    }
}
