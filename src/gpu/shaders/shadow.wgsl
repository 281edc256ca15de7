// One light's shadow: at every pixel the share that is seen of what it does, of E and of S.
//
// With f the integrand and V whether a point of the light is seen, the share is ∫fV/∫f, and both integrals are sums over
// the same rays: all is exactly 1 where nothing is in the way, and 0 where nothing is seen. Rays go to points of the
// light, and along the lobe too where that is narrower than the light; each is weighed by the density of both [VEACH_GUIBAS_1995].
// `draw`, `meet`, `solid_angle` and `is_hidden` are chosen when the shader is joined.

struct ShadowPass {
    // Number of the first ray, and how many.
    first: u32,
    count: u32,
    // Nothing was cast before.
    starts: u32,
    // No material has a specular part.
    matte: u32,
}

@group(1) @binding(3) var<uniform> shadow_pass: ShadowPass;
// The sums over the rays before.
@group(1) @binding(4) var before: texture_2d<f32>;

// Sums of fV and of f, for E and for S.
@fragment
fn shadow(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let place = vec2i(pixel.xy);
    let position = textureLoad(positions, place, 0);
    if position.w == 0.0 {
        return vec4f(1.0);
    }
    let at = shading_at(position.xyz, textureLoad(normals, place, 0));
    let own = u32(position.w) - 1u;
    let m = lobes[at.lobe].cosine_exponent;
    let peak = lobe_normalization(m);
    let is_narrow = shadow_pass.matte == 0u && peak * solid_angle(at.p) > 1.0;
    let of_light = hash(vec3u(vec2u(place), 0u)).xy;
    let of_lobe = hash(vec3u(vec2u(place), 1u)).xy;
    var sums = vec4f();
    if shadow_pass.starts == 0u {
        sums = textureLoad(before, place, 0);
    }
    for (var i = shadow_pass.first; i < shadow_pass.first + shadow_pass.count; i++) {
        let point = draw(at, scrambled_point(i, of_light));
        let w = normalize(point.to_light);
        let cosine = dot(at.n, w);
        if cosine > 0.0 && point.luminance > 0.0 {
            let diffuse = point.luminance * cosine * point.solid_angle;
            let specular = specular_part(at, point, w, is_narrow);
            let seen = select(1.0, 0.0, is_hidden(at.p, point.to_light, own));
            sums += vec4f(diffuse * seen, diffuse, specular * seen, specular);
        }
        if is_narrow {
            let u = scrambled_point(i, of_lobe);
            // cosᵐ⁺¹ is even over the lobe.
            let along = about(at.r, -expm1_2(log2(1.0 - u.x) / (m + 1.0)), u.y);
            let met = meet(at, along);
            if met.luminance > 0.0 && dot(at.n, along) > 0.0 {
                let specular = specular_part(at, met, along, true);
                let seen = select(1.0, 0.0, is_hidden(at.p, met.to_light, own));
                sums += vec4f(0.0, 0.0, specular * seen, specular);
            }
        }
    }
    return sums;
}

// The specular integrand over the densities by which its rays are drawn.
fn specular_part(at: Shading, point: LightPoint, w: vec3f, is_narrow: bool) -> f32 {
    if shadow_pass.matte == 1u {
        return 0.0;
    }
    let m = lobes[at.lobe].cosine_exponent;
    let density = select(0.0, lobe_normalization(m) * lobe_power(at.r, w, m), is_narrow);
    let share = point.solid_angle / (1.0 + density * point.solid_angle);
    return point.luminance * lobe_density(at.lobe, at.n, at.r, w) * share;
}

// 2ˣ − 1.
fn expm1_2(x: f32) -> f32 {
    let y = x * 0.69314718055994530942;
    return select(exp2(x) - 1.0, y * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y / 24.0))), abs(y) < 0.05);
}
