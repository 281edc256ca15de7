// Exposure, the Khronos PBR Neutral tone curve and sRGB encoding, as `render::tone` does.

struct Tone {
    // 2^exposure / 100
    exposure: f32,
}

@group(0) @binding(0) var radiance: texture_2d<f32>;
@group(0) @binding(1) var<uniform> tone_settings: Tone;

@fragment
fn tone(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let exposed = tone_settings.exposure * textureLoad(radiance, vec2i(pixel.xy), 0).xyz;
    return vec4f(srgb_encode(pbr_neutral(exposed)), 1.0);
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
