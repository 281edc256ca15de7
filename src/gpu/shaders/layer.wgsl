// One light's layer: its unit-strength response at every pixel. `respond` is chosen when the shader is joined.

@group(0) @binding(0) var positions: texture_2d<f32>;
@group(0) @binding(1) var normals: texture_2d<f32>;

@fragment
fn layer(@builtin(position) pixel: vec4f) -> @location(0) vec2f {
    let position = textureLoad(positions, vec2i(pixel.xy), 0);
    if position.w == 0.0 {
        return vec2f();
    }
    return shade(position.xyz, textureLoad(normals, vec2i(pixel.xy), 0));
}

// As `layer`, but only where the lobe is no cosine.
@fragment
fn layer_of_other_lobes(@builtin(position) pixel: vec4f) -> @location(0) vec2f {
    let position = textureLoad(positions, vec2i(pixel.xy), 0);
    let normal = textureLoad(normals, vec2i(pixel.xy), 0);
    if position.w == 0.0 || lobes[u32(normal.w)].model <= LAFORTUNE {
        discard;
    }
    return shade(position.xyz, normal);
}

fn shade(p: vec3f, normal: vec4f) -> vec2f {
    let at = shading_at(p, normal);
    let response = respond(at);
    return vec2f(response.irradiance, lobe_factor(at) * response.specular);
}

// Of Lafortune's lobe; 1 of others.
fn lobe_factor(at: Shading) -> f32 {
    if lobes[at.lobe].model != LAFORTUNE {
        return 1.0;
    }
    let v = -normalize(at.p);
    let along_normal = dot(at.n, v) * at.n;
    let q = lafortune_axis(at.lobe, v - along_normal, along_normal);
    return power(max(dot(q, q), 1e-30), 0.5 * lobes[at.lobe].exponent);
}
