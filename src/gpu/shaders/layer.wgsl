// One light's layer: its unit-strength response at every pixel. `respond` is chosen when the shader is joined.

@group(0) @binding(0) var positions: texture_2d<f32>;
@group(0) @binding(1) var normals: texture_2d<f32>;

@fragment
fn layer(@builtin(position) pixel: vec4f) -> @location(0) vec2f {
    let position = textureLoad(positions, vec2i(pixel.xy), 0);
    if position.w == 0.0 {
        return vec2f();
    }
    let normal = textureLoad(normals, vec2i(pixel.xy), 0);
    let v = -normalize(position.xyz);
    let r = 2.0 * dot(normal.xyz, v) * normal.xyz - v;
    let response = respond(Shading(position.xyz, normal.xyz, r, u32(normal.w)));
    return vec2f(response.irradiance, response.specular);
}
