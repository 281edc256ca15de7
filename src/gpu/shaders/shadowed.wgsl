// What a shadow is cast on, and by which light.

struct ShadowLight {
    // Flat: the corner of a rectangle about it. Sphere, point: centre. Line: its beginning. Cap, sky, directional: the unit
    // direction to the middle.
    place: vec3f,
    // Sphere: radius. Cap: 1 − cos σ. Sky: the uniform part. Line: falloff.
    size: f32,
    // Flat: along the rectangle's sides. Line: to its end.
    row: vec3f,
    // Sky: the cosine part. Line: diameter of a tube, else 0.
    part: f32,
    column: vec3f,
    // Of a flat light.
    two_sided: u32,
    normal: vec3f,
    // Corners of a polygon.
    count: u32,
}

@group(1) @binding(0) var<uniform> shadow_light: ShadowLight;

@group(0) @binding(0) var positions: texture_2d<f32>;
@group(0) @binding(1) var normals: texture_2d<f32>;
