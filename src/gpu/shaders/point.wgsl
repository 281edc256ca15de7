// A point light and a directional light.

struct PointLight {
    position: vec3f,
    unused: u32,
}

struct DirectionalLight {
    to_light: vec3f,
    // On a surface that faces it.
    illuminance: f32,
}

// Nearer than 1e-15 m a point touches the light, which then adds nothing: 1/r³ stays inside the range of f32.
// The core's own distance is smaller.
const CONTACT_SQUARED = 1e-30;

@group(1) @binding(0) var<uniform> point_light: PointLight;
@group(1) @binding(0) var<uniform> directional_light: DirectionalLight;

fn point_respond(at: Shading) -> Response {
    return falloff_response(point_light.position - at.p, 1.0, 2.0, at.n, at.r, at.lobe);
}

fn directional_respond(at: Shading) -> Response {
    return direction_response(directional_light.to_light, directional_light.illuminance, at.n, at.r, at.lobe);
}

// Response to a point light of `intensity` at `to_light` from the point, that falls off as 1/dⁿ.
fn falloff_response(to_light: vec3f, intensity: f32, falloff: f32, n: vec3f, r: vec3f, lobe: u32) -> Response {
    let square = dot(to_light, to_light);
    if square < CONTACT_SQUARED {
        return Response(0.0, 0.0);
    }
    let inverse = inverseSqrt(square);
    var attenuation = inverse * inverse;
    if falloff != 2.0 {
        attenuation = power(inverse, falloff);
    }
    return direction_response(to_light * inverse, intensity * attenuation, n, r, lobe);
}

// Response to parallel light of `illuminance` from the unit direction `w`.
fn direction_response(w: vec3f, illuminance: f32, n: vec3f, r: vec3f, lobe: u32) -> Response {
    let cos_n = dot(n, w);
    if cos_n <= 0.0 {
        return Response(0.0, 0.0);
    }
    return Response(illuminance * cos_n, illuminance * lobe_density(lobe, n, r, w));
}
