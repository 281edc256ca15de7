// What only exported functions have.

// The lobe at work.
var<private> lobes: array<Lobe, 1>;

// Which light's arrays are read.
var<private> source: u32;

// The point as the shaders of lights see it. Of exponents below 1 the lobe is that of 1.
fn shading_of(p: vec3f, n: vec3f, v: vec3f, exponent: f32) -> Shading {
    lobes[0].exponent = max(exponent, 1.0);
    lobes[0].cosine_exponent = max(exponent, 1.0);
    return Shading(p, n, mirrored(v, n), 0u);
}

// What replaces Phong's lobe of an exponent along a line; see `Lobe`.
struct Fit {
    exponent: f32,
    cut: f32,
    tan_cut: f32,
    mean: array<vec4f, 4>,
}

// The same with the fit of the nearest exponent that there is one of.
fn fitted_shading_of(p: vec3f, n: vec3f, v: vec3f, exponent: f32) -> Shading {
    var fit = FITS[0];
    for (var i = 1u; i < FIT_COUNT; i++) {
        if exponent * exponent > fit.exponent * FITS[i].exponent {
            fit = FITS[i];
        }
    }
    lobes[0].chebyshev_cut = fit.cut;
    lobes[0].chebyshev_tan_cut = fit.tan_cut;
    lobes[0].chebyshev_mean = fit.mean;
    return shading_of(p, n, v, fit.exponent);
}

fn lobe_density(lobe: u32, n: vec3f, r: vec3f, w: vec3f) -> f32 {
    return phong_density(lobes[lobe].exponent, r, w);
}

fn plus_tinted(sum: SoftboxLights, light: vec2f, tint: vec3f) -> SoftboxLights {
    return SoftboxLights(sum.irradiance + light.x * tint, sum.specular + light.y * tint);
}
