// A polygonal light of unit luminance. Its corners are `vertices[0 .. count]`, counter-clockwise seen from the lit side.

struct PolygonLight {
    normal: vec3f,
    count: u32,
    two_sided: u32,
}

@group(1) @binding(0) var<uniform> polygon_light: PolygonLight;
