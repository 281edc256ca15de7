// Exposure and the Khronos PBR Neutral tone curve, as `render::tone` has them; running means over samples.

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
    // Mean radiance; w: mean of the illuminance, 0 counted where no surface is seen.
    @location(0) radiance: vec4f,
    // Mean of what the tone curve makes of each sample, so that the edge of a bright light is smooth; w: the share of the
    // samples that see a surface.
    @location(1) display: vec4f,
}

@fragment
fn tone(@builtin(position) pixel: vec4f) -> Resolved {
    let at = vec2i(pixel.xy);
    let sample = textureLoad(sample_radiance, at, 0);
    var radiance = vec4f(sample.xyz, max(sample.w, 0.0));
    var display = vec4f(pbr_neutral(tone_settings.exposure * sample.xyz), select(0.0, 1.0, sample.w >= 0.0));
    if tone_settings.share < 1.0 {
        radiance = mix(textureLoad(radiance_before, at, 0), radiance, tone_settings.share);
        display = mix(textureLoad(display_before, at, 0), display, tone_settings.share);
    }
    return Resolved(radiance, display);
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
