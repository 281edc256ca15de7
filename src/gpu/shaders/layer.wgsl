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
    let n = normal.xyz;
    let lobe = u32(normal.w);
    let v = -normalize(p);
    let along_normal = dot(n, v) * n;
    var r = 2.0 * along_normal - v;
    var factor = 1.0;
    if lobes[lobe].model == LAFORTUNE {
        let factors = lobes[lobe].parameters;
        let q = factors.x * (v - along_normal) + factors.y * along_normal;
        let square = max(dot(q, q), 1e-30);
        r = q * inverseSqrt(square);
        factor = power(square, 0.5 * lobes[lobe].exponent);
    }
    let response = respond(Shading(p, n, r, lobe));
    return vec2f(response.irradiance, factor * response.specular);
}
