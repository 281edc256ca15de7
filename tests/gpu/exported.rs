//! Exported shader functions against the layers of the preview.

use std::io::Cursor;
use std::ops::Range;

use glam::Vec3;
use image::{ImageBuffer, ImageFormat, Luma};
use softbox::export::{Exported, Job, Options, Target, export};
use softbox::gpu::{Context, layer_at};
use softbox::light::{Emitter, Light};
use softbox::render::{MethodChoice, Progress};
use softbox::scene::{self, Scene};
use softbox::shading::{Lobe, Method};

use crate::CONTEXT;

/// One light of each shape around the origin, where the eye is.
const SCENE: &str = r#"
format = 1
material = [{ name = "gloss", diffuse = [0.5, 0.5, 0.5], specular = [0.5, 0.5, 0.5], exponent = 24.0 }]
light = [
    { name = "window", position = [0.0, 0.5, 2.0], rotation_deg = [10.0, 20.0, 30.0], luminance = 900.0, shape = { polygon = { vertices = [[-1.0, -0.5], [1.0, -0.5], [0.2, 0.0], [1.0, 0.8], [-1.0, 0.5]], two_sided = true } } },
    { name = "line", position = [0.5, 0.0, 1.0], rotation_deg = [10.0, 20.0, 30.0], intensity_per_metre = 300.0, shape = { line = { length = 1.5 } } },
    { name = "decaying line", position = [0.5, 0.0, 1.0], intensity_per_metre = 300.0, shape = { line = { length = 1.5, falloff = 1.0 } } },
    { name = "tube", position = [0.5, 0.0, 1.0], luminance = 3000.0, shape = { line = { length = 1.5, emission = "tube", radius = 0.01 } } },
    { name = "ball", position = [-0.5, 0.3, 1.0], luminance = 700.0, shape = { sphere = { radius = 0.3 } } },
    { name = "disk", position = [-0.5, 0.3, 1.0], rotation_deg = [30.0, 0.0, 0.0], luminance = 700.0, shape = { disk = { radius = 0.5 } } },
    { name = "leaf", position = [0.2, -0.4, 1.5], rotation_deg = [20.0, 10.0, 50.0], luminance = 600.0, shape = { textured = { size = [1.2, 0.9], pattern = "leaf.png" } } },
    { name = "cap", rotation_deg = [30.0, 40.0, 0.0], luminance = 100.0, shape = { cap = { half_angle_deg = 25.0 } } },
    { name = "sky", luminance = 100.0, shape = { sky = { uniform = 0.3, cosine = 0.7 } } },
    { name = "lamp", position = [0.4, 0.4, 1.2], intensity = 50.0, shape = { point = {} } },
    { name = "spot", position = [0.4, 0.4, 1.2], rotation_deg = [10.0, 20.0, 30.0], intensity = 80.0, shape = { point = { ies = "spot.ies" } } },
    { name = "sun", rotation_deg = [30.0, 10.0, 0.0], illuminance = 800.0, shape = { directional = {} } },
]
"#;

/// Intensities at three angles from nadir in three half-planes.
const SPOT: &str = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 1 2 0 0 0\n1 1 10\n0 60 90\n0 90 180\n\
    100 80 20\n100 60 10\n100 90 30\n";

fn scene() -> Scene {
    let grey = ImageBuffer::from_fn(12, 9, |x, y| Luma([u8::try_from((x * 37 + y * 91) % 251).expect("below 251")]));
    let mut pattern = Cursor::new(Vec::new());
    grey.write_to(&mut pattern, ImageFormat::Png).expect("it can be written");
    let read = |name: &str| Ok(if name == "spot.ies" { SPOT.into() } else { pattern.get_ref().clone() });
    scene::parse_with(SCENE, "scene.toml", read).unwrap_or_else(|error| panic!("{error}"))
}

pub(crate) fn exported(scene: &Scene, lights: &[String], target: Target, method: Method) -> Exported {
    let options = Options { method: MethodChoice::Method(method), ..Options::default() };
    let job =
        Job { scene, scene_name: "scene.toml", stem: "out", target, lights: Some(lights), surfaces: false, options };
    export(&job, &Progress::default()).unwrap_or_else(|error| panic!("{lights:?}, {method}: {error}"))
}

/// A point and its normal.
pub(crate) type Point = (Vec3, Vec3);

/// Points near the lights, with normals all around; the same each time.
fn points() -> Vec<Point> {
    points_about(Vec3::ZERO, 1.5, 0..2048)
}

/// Points of those numbers within so many metres of a place, which is itself number 0.
pub(crate) fn points_about(place: Vec3, reach: f32, numbers: Range<u16>) -> Vec<Point> {
    let golden = [0.819_172_5, 0.671_043_6, 0.549_700_5, 0.450_317_2, 0.368_891_3_f32];
    let unit = |i: u16, axis: usize| (f32::from(i) * golden[axis] + 0.5).fract();
    let point = |i: u16| {
        let p = Vec3::new(unit(i, 0) - 0.5, unit(i, 1) - 0.5, 5.0 / 6.0 * (unit(i, 2) - 0.5));
        let (z, turn) = (2.0 * unit(i, 3) - 1.0, std::f32::consts::TAU * unit(i, 4));
        let across = (1.0 - z * z).sqrt();
        (place + 2.0 * reach * p, Vec3::new(across * turn.cos(), across * turn.sin(), z).normalize())
    };
    numbers.map(point).collect()
}

/// An invocation calls one function only: llvmpipe gives up loops after 65,535 turns in each.
const HARNESS: &str = "
@group(0) @binding(0) var<storage, read> harness_points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> harness_results: array<vec2f>;

@compute @workgroup_size(64)
fn harness(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&harness_results) {
        let p = harness_points[2u * id.x].xyz;
        let n = harness_points[2u * id.x + 1u];
        let v = -normalize(p);
        switch id.x / COUNTu {
CASES            default: {}
        }
    }
}
";

/// Functions of a WGSL text, each over its points, seen from the origin: as many points for each, in whole workgroups. The
/// textures that they read are `exported`'s.
pub(crate) fn run(
    exported: &Exported,
    wgsl: &str,
    functions: &[(String, Vec<Point>)],
    exponent: f32,
) -> Vec<Vec<[f32; 2]>> {
    let Context { device, queue, .. } = &*CONTEXT;
    let case = |(i, (name, _)): (usize, &(String, Vec<Point>))| {
        format!("            case {i}: {{ harness_results[id.x] = {name}(p, n.xyz, v, n.w); }}\n")
    };
    let count = functions[0].1.len();
    let cases: String = functions.iter().enumerate().map(case).collect();
    let harness = HARNESS.replace("COUNT", &count.to_string()).replace("CASES", &cases);
    let points: Vec<Point> = functions.iter().flat_map(|(_, points)| points.iter().copied()).collect();
    let numbers: Vec<[f32; 4]> =
        points.iter().flat_map(|(p, n)| [p.extend(0.0).to_array(), n.extend(exponent).to_array()]).collect();
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(format!("{wgsl}{harness}").into()),
    });
    let storage = |binding, read_only| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let texture = |binding| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    };
    let textures: Vec<_> = exported.files[1..].iter().map(|file| texture_of(&file.bytes)).collect();
    let entries: Vec<_> = (0..).zip(&textures).map(|(binding, _)| texture(binding)).collect();
    let layout = |entries: &[wgpu::BindGroupLayoutEntry]| {
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries })
    };
    let layouts = [layout(&[storage(0, true), storage(1, false)]), layout(&entries)];
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &layouts.each_ref().map(Some),
            immediate_size: 0,
        })),
        module: &module,
        entry_point: Some("harness"),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        cache: None,
    });
    let size = (points.len() * size_of::<[f32; 2]>()) as u64;
    let buffer = |size, usage| {
        device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
    };
    let inputs =
        buffer(size_of_val(numbers.as_slice()) as u64, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST);
    queue.write_buffer(&inputs, 0, bytemuck::cast_slice(&numbers));
    let results = buffer(size, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC);
    let copy = buffer(size, wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
    let group = |layout: &wgpu::BindGroupLayout, resources: Vec<wgpu::BindingResource<'_>>| {
        let entries: Vec<_> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    };
    let groups = [
        group(&layouts[0], vec![inputs.as_entire_binding(), results.as_entire_binding()]),
        group(&layouts[1], textures.iter().map(wgpu::BindingResource::TextureView).collect()),
    ];
    let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    {
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &groups[0], &[]);
        pass.set_bind_group(1, &groups[1], &[]);
        pass.dispatch_workgroups(u32::try_from(points.len().div_ceil(64)).expect("few"), 1, 1);
    }
    encoder.copy_buffer_to_buffer(&results, 0, &copy, 0, size);
    queue.submit([encoder.finish()]);
    copy.slice(..).map_async(wgpu::MapMode::Read, |_| {});
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device works");
    let bytes = copy.slice(..).get_mapped_range().expect("it is mapped");
    let values: Vec<[f32; 2]> = bytemuck::pod_collect_to_vec(&bytes);
    values.chunks(count).map(<[_]>::to_vec).collect()
}

/// A table's picture on the device.
fn texture_of(picture: &[u8]) -> wgpu::TextureView {
    use exr::prelude::{FlatSamples, ReadChannels as _, ReadLayers as _};
    use wgpu::util::DeviceExt as _;
    let reader = exr::prelude::read().no_deep_data().largest_resolution_level().all_channels();
    let image = reader.first_valid_layer().all_attributes().from_buffered(Cursor::new(picture)).expect("OpenEXR");
    let [channel] = image.layer_data.channel_data.list.as_slice() else { panic!("one channel") };
    let FlatSamples::F32(numbers) = &channel.sample_data else { panic!("32-bit floats") };
    let side = |side: usize| u32::try_from(side).expect("a texture is small");
    let texture = CONTEXT.device.create_texture_with_data(
        &CONTEXT.queue,
        &wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d {
                width: side(image.layer_data.size.0),
                height: side(image.layer_data.size.1),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::default(),
        bytemuck::cast_slice(numbers),
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// GLSL functions in WGSL, by naga, which knows textures only apart from samplers.
fn wgsl_of_glsl(glsl: &str) -> String {
    use naga::valid::{Capabilities, ValidationFlags, Validator};
    let bound = |(i, part): (usize, &str)| match i {
        0 => part.to_owned(),
        _ => format!("layout(set = 1, binding = {}) uniform texture2D{part}", i - 1),
    };
    let text: String = glsl.split("uniform highp sampler2D").enumerate().map(bound).collect();
    let text = format!("#version 450\n{text}\nvoid main() {{}}\n");
    let options = naga::front::glsl::Options::from(naga::ShaderStage::Fragment);
    let module = naga::front::glsl::Frontend::default()
        .parse(&options, &text)
        .unwrap_or_else(|error| panic!("{}", error.emit_to_string(&text)));
    let info = Validator::new(ValidationFlags::all(), Capabilities::default()).validate(&module).expect("it is valid");
    naga::back::wgsl::write_string(&module, &info, naga::back::wgsl::WriterFlags::empty()).expect("it can be written")
}

/// How far a function's values are from the layer's.
#[derive(Debug)]
pub(crate) struct Difference {
    /// As shares of the value and a thousandth of the layer's peak.
    pub(crate) worst: f32,
    /// Numbers of which a bit differs, as a share.
    unequal: f64,
    /// Numbers that are not 0, as a share.
    pub(crate) lit: f64,
}

/// How far values at points are from a light's layer there.
pub(crate) fn difference(
    (emitter, strength): (&Emitter, f64),
    method: Method,
    exponent: f32,
    points: &[Point],
    values: &[[f32; 2]],
) -> Difference {
    let lobe = Lobe::new(f64::from(exponent));
    let layer = layer_at(&CONTEXT, (emitter, method), &lobe, points).expect("the layer comes back");
    #[expect(clippy::cast_possible_truncation, reason = "as in the file")]
    let strength = strength as f32;
    let expected: Vec<_> = layer.iter().map(|of_unit| of_unit.map(|x| strength * x)).collect();
    let peak: [f32; 2] = [0, 1].map(|i| expected.iter().map(|x| x[i]).fold(f32::MIN_POSITIVE, f32::max));
    let mut difference = Difference { worst: 0.0, unequal: 0.0, lit: 0.0 };
    let one = 0.5 / expected.len() as f64;
    for (x, e) in values.iter().zip(&expected) {
        for i in 0..2 {
            let error = (x[i] - e[i]).abs() / (e[i] + 1e-3 * peak[i]);
            difference.worst = if error.is_finite() { difference.worst.max(error) } else { f32::INFINITY };
            difference.unequal += if x[i].to_bits() == e[i].to_bits() { 0.0 } else { one };
            difference.lit += if e[i] > 0.0 { one } else { 0.0 };
        }
    }
    assert_eq!(values.len(), expected.len(), "a value each");
    difference
}

/// How far a function may be from its layer.
fn bound(light: &Light, method: Method) -> f32 {
    match (light.name.as_str(), method) {
        // The layer has a table of the lobe's exponent where the function integrates.
        ("line", Method::Exact) => 2e-5,
        // A last bit decides whether a part of the pattern is small.
        ("leaf", Method::Exact) => 5e-4,
        // A spot's edge is steep: what it makes of a last bit.
        (_, Method::Fit(_)) => 5e-6,
        // Near the horizon terms of a cap cancel: what they make of a last bit.
        ("cap", _) => 5e-5,
        _ => SAME,
    }
}

/// The bound on what is the very same text: what compilers make of it.
const SAME: f32 = 1e-6;

#[track_caller]
fn check(scene: &Scene, light: &Light, method: Method, target: Target) {
    let exported = exported(scene, std::slice::from_ref(&light.name), target, method);
    let text = std::str::from_utf8(&exported.files[0].bytes).expect("text");
    let wgsl = if target == Target::Glsl { wgsl_of_glsl(text) } else { text.to_owned() };
    let function = format!("softbox_{}", light.name.replace(' ', "_"));
    let points = points();
    let values = run(&exported, &wgsl, &[(function, points.clone())], 24.0);
    let found = difference((&light.emitter(), light.strength()), method, 24.0, &points, &values[0]);
    println!("{}, {method}, {target}: {found:?}", light.name);
    assert!(found.worst <= bound(light, method), "{}, {method}, {target}: {found:?}", light.name);
    assert!(found.lit > 0.1, "{}, {method}, {target}: the test is too dark: {found:?}", light.name);
}

#[test]
fn a_function_is_the_layer_of_its_light() {
    let scene = scene();
    // Others are the same functions with other numbers.
    let is_of_its_own = |method: &&Method| {
        let of_two = [Method::Hermite2, Method::OneShotSized, Method::NearestPointPicott];
        !matches!(method, Method::Point | Method::Reference) && !of_two.contains(method)
    };
    for light in &scene.lights {
        for method in Method::of(&light.shape).iter().filter(is_of_its_own) {
            check(&scene, light, *method, Target::Wgsl);
        }
    }
}

#[test]
fn a_function_is_the_same_in_glsl() {
    let scene = scene();
    for light in &scene.lights {
        check(&scene, light, Method::Exact, Target::Glsl);
    }
    for (name, method) in [("line", Method::CHEBYSHEV), ("leaf", Method::OneShot)] {
        let light = scene.lights.iter().find(|light| light.name == name).expect("it is there");
        check(&scene, light, method, Target::Glsl);
    }
}

#[test]
fn a_planted_error_is_seen() {
    let scene = scene();
    for (name, from, to) in [
        ("window", "0.5 * abs(dot(contour.vector, n))", "0.5001 * abs(dot(contour.vector, n))"),
        ("ball", "SOFTBOX_PI * sine * sine", "3.1417 * sine * sine"),
        ("lamp", "cos_n <= 0.0", "cos_n <= 0.01"),
    ] {
        let light = scene.lights.iter().find(|light| light.name == name).expect("it is there");
        let exported = exported(&scene, &[name.to_owned()], Target::Wgsl, Method::Exact);
        let wgsl = std::str::from_utf8(&exported.files[0].bytes).expect("text");
        let wrong = wgsl.replace(from, to);
        assert!(wrong != wgsl, "{name} has `{from}`");
        let points = points();
        let values = run(&exported, &wrong, &[(format!("softbox_{name}"), points.clone())], 24.0);
        let found = difference((&light.emitter(), light.strength()), Method::Exact, 24.0, &points, &values[0]);
        println!("{name}: {found:?}");
        assert!(found.worst > SAME, "{name}: {found:?}");
    }
}
