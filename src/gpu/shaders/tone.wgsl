// Exposure, the Khronos PBR Neutral tone curve and sRGB encoding, as `render::tone` does; running means over samples.

struct Tone {
    // 2^exposure / 100
    exposure: f32,
    // The sample's share of the mean; 1 starts it.
    share: f32,
}

@group(0) @binding(0) var sample_radiance: texture_2d<f32>;
@group(0) @binding(1) var radiance_before: texture_2d<f32>;
@group(0) @binding(2) var display_before: texture_2d<f32>;
@group(0) @binding(3) var<uniform> tone_settings: Tone;

struct Resolved {
    // Mean radiance.
    @location(0) radiance: vec4f,
    // Mean of what the tone curve makes of each sample, so that the edge of a bright light is smooth.
    @location(1) display: vec4f,
    // The same, encoded.
    @location(2) picture: vec4f,
}

@fragment
fn tone(@builtin(position) pixel: vec4f) -> Resolved {
    let at = vec2i(pixel.xy);
    var radiance = textureLoad(sample_radiance, at, 0).xyz;
    var display = pbr_neutral(tone_settings.exposure * radiance);
    if tone_settings.share < 1.0 {
        radiance = mix(textureLoad(radiance_before, at, 0).xyz, radiance, tone_settings.share);
        display = mix(textureLoad(display_before, at, 0).xyz, display, tone_settings.share);
    }
    return Resolved(vec4f(radiance, 1.0), vec4f(display, 1.0), vec4f(srgb_encode(display), 1.0));
}

fn pbr_neutral(color: vec3f) -> vec3f {
    let start = 0.8 - 0.04;
    let desaturation = 0.15;
    let least = min(color.x, min(color.y, color.z));
    let offset = select(0.04, least - 6.25 * least * least, least < 0.08);
    let shifted = color - offset;
    let peak = max(shifted.x, max(shifted.y, shifted.z));
    if peak < start {
        return shifted;
    }
    let d = 1.0 - start;
    let new_peak = 1.0 - d * d / (peak + d - start);
    let g = 1.0 - 1.0 / (desaturation * (peak - new_peak) + 1.0);
    return mix(shifted * (new_peak / peak), vec3f(new_peak), g);
}

fn srgb_encode(linear: vec3f) -> vec3f {
    let c = clamp(linear, vec3f(), vec3f(1.0));
    return select(1.055 * pow(max(c, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
}
