// A spherical light of unit luminance.

struct SphereLight {
    center: vec3f,
    radius: f32,
}

@group(1) @binding(0) var<uniform> sphere_light: SphereLight;
