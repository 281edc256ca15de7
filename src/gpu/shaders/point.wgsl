// A point light and a directional light.

struct PointLight {
    position: vec3f,
    unused: u32,
}

struct DirectionalLight {
    to_light: vec3f,
    unused: u32,
}

@group(1) @binding(0) var<uniform> point_light: PointLight;
@group(1) @binding(0) var<uniform> directional_light: DirectionalLight;

fn point_respond(at: Shading) -> Response {
    let m = lobes[at.lobe].exponent;
    let to_light = point_light.position - at.p;
    return Response(point_irradiance(to_light, at.n), point_phong(to_light, at.n, at.r, m));
}

fn directional_respond(at: Shading) -> Response {
    let l = directional_light.to_light;
    return Response(max(dot(at.n, l), 0.0), directional_phong(l, at.n, at.r, lobes[at.lobe].exponent));
}

// Irradiance from unit intensity at `to_light` from p: cos/r², 0 at the light itself.
fn point_irradiance(to_light: vec3f, n: vec3f) -> f32 {
    let square = dot(to_light, to_light);
    if square == 0.0 {
        return 0.0;
    }
    return max(dot(n, to_light), 0.0) / (square * sqrt(square));
}

// Specular response to unit intensity at `to_light` from p.
fn point_phong(to_light: vec3f, n: vec3f, r: vec3f, m: f32) -> f32 {
    let square = dot(to_light, to_light);
    if square == 0.0 {
        return 0.0;
    }
    return directional_phong(to_light * inverseSqrt(square), n, r, m) / square;
}

// Specular response to unit illuminance from the unit direction `l`.
fn directional_phong(l: vec3f, n: vec3f, r: vec3f, m: f32) -> f32 {
    return select(0.0, lobe_normalization(m) * power(dot(r, l), m), dot(n, l) > 0.0);
}
