// A linear light of unit intensity per metre.

struct LineLight {
    a: vec3f,
    falloff: f32,
    b: vec3f,
    unused: u32,
}

@group(1) @binding(0) var<uniform> line_light: LineLight;
