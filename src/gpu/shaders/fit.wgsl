// Punctual lights fitted to a light.

struct FitLight {
    count: u32,
    // 1 where they are parallel light, 0 where they have places.
    is_far: u32,
}

@group(1) @binding(0) var<uniform> fit_light: FitLight;

// Two of `vertices` a light: its place and intensity, or its direction and illuminance; and the ramp of its cone.
fn fit_respond(at: Shading) -> Response {
    var sum = Response(0.0, 0.0);
    for (var i = 0u; i < fit_light.count; i++) {
        let light = light_vertex(2u * i);
        var response: Response;
        if fit_light.is_far == 1u {
            response = direction_response(light.xyz, light.w, at.n, at.r, at.lobe);
        } else {
            response = spot_response(light.xyz - at.p, light.w, light_vertex(2u * i + 1u), at.n, at.r, at.lobe);
        }
        sum.irradiance += response.irradiance;
        sum.specular += response.specular;
    }
    return sum;
}

// Response to a spot at `to_light` from the point. The ramp is the axis times the scale of the cosine, and its offset: 0 and
// 1 make it a point.
fn spot_response(to_light: vec3f, intensity: f32, ramp: vec4f, n: vec3f, r: vec3f, lobe: u32) -> Response {
    let w = to_light * inverseSqrt(max(dot(to_light, to_light), 1e-37));
    let share = clamp(ramp.w - dot(ramp.xyz, w), 0.0, 1.0);
    return falloff_response(to_light, share * share * intensity, 2.0, n, r, lobe);
}
