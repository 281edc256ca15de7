// The picture: sRGB-encoded, or numbers in false colour as `render::false_colour` has them.

struct Shown {
    mode: u32,
    // Difference: relative. Illuminance: on a logarithmic scale. Bands: of illuminance.
    option: u32,
    // Split: the first pixels' column of the second method.
    split: f32,
    // Of the scale.
    end: f32,
    // Isolines.
    level_count: u32,
    levels: array<vec4f, 3>,
}

const SPLIT = 1u;
const DIFFERENCE = 2u;
const ILLUMINANCE = 3u;
const BANDS = 4u;

// Places in the table of colours.
const CELLS = 256u;
const DIVERGING = 256u;
const BAND = 512u;
const NOTHING = 516u;

// As `light::luminance_of`.
const LUMINANCE = vec3f(0.21263901, 0.71516868, 0.07219232);
// Least value of a logarithmic scale, as a share of its end.
const LOGARITHMIC_SPAN = 1e-3;

// Means of the view's method and of the other one: see `tone.wgsl`.
@group(0) @binding(0) var radiance_mean: texture_2d<f32>;
@group(0) @binding(1) var display_mean: texture_2d<f32>;
@group(0) @binding(2) var other_radiance: texture_2d<f32>;
@group(0) @binding(3) var other_display: texture_2d<f32>;
// Through the pixels' centres.
@group(0) @binding(4) var positions: texture_2d<f32>;
@group(0) @binding(5) var normals: texture_2d<f32>;
@group(0) @binding(6) var<uniform> shown: Shown;
// Sequential, diverging, bands, nothing.
@group(0) @binding(7) var<storage, read> colors: array<vec4f>;
// Of each item that may be seen.
@group(0) @binding(8) var<storage, read> surfaces: array<u32>;

@fragment
fn display(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let at = vec2i(pixel.xy);
    let here = textureLoad(display_mean, at, 0);
    if shown.mode < DIFFERENCE {
        if shown.mode == SPLIT && pixel.x >= shown.split {
            return vec4f(srgb_encode(textureLoad(other_display, at, 0).xyz), 1.0);
        }
        return vec4f(srgb_encode(here.xyz), 1.0);
    }
    if here.w == 0.0 {
        return colors[NOTHING];
    }
    var color = false_color(at, here.w);
    let thing = thing_at(at);
    if thing != thing_at(at + vec2i(1, 0)) || thing != thing_at(at + vec2i(0, 1)) {
        color = 0.5 * (color + colors[NOTHING].xxxw);
    } else if shown.mode == BANDS {
        let band = band_of(at);
        if band != band_of(at + vec2i(1, 0)) || band != band_of(at + vec2i(0, 1)) {
            color = vec4f(0.4 * color.xyz, 1.0);
        }
    }
    return color;
}

fn false_color(at: vec2i, covered: f32) -> vec4f {
    switch shown.mode {
        case DIFFERENCE: {
            return color_at(DIVERGING, 0.5 + 0.5 * clamp(difference(at) / shown.end, -1.0, 1.0));
        }
        case BANDS: {
            return colors[BAND + band_of(at)];
        }
        default: {
            let illuminance = textureLoad(radiance_mean, at, 0).w / covered;
            let share = scale_share(illuminance);
            return on_isolines(at, illuminance, color_at(0u, share));
        }
    }
}

// Of luminance, by the view's method less the other one; relative: as a share of the other one.
fn difference(at: vec2i) -> f32 {
    let other = dot(LUMINANCE, textureLoad(other_radiance, at, 0).xyz);
    let apart = dot(LUMINANCE, textureLoad(radiance_mean, at, 0).xyz) - other;
    if shown.option == 0u {
        return apart;
    }
    return apart / max(other, 1e-30);
}

// Into the colours of bands.
fn band_of(at: vec2i) -> u32 {
    let mine = textureLoad(radiance_mean, at, 0);
    let other = textureLoad(other_radiance, at, 0);
    let values = select(vec2f(dot(LUMINANCE, mine.xyz), dot(LUMINANCE, other.xyz)), vec2f(mine.w, other.w), shown.option == 1u);
    let apart = abs(values.x - values.y);
    if apart <= 0.01 * values.y {
        return 0u;
    }
    if apart <= 0.05 * values.y {
        return 1u;
    }
    return select(3u, 2u, apart <= 0.1 * values.y);
}

// As `false_colour::Scale::share`.
fn scale_share(value: f32) -> f32 {
    if shown.option == 0u {
        return value / shown.end;
    }
    let least = LOGARITHMIC_SPAN * shown.end;
    return log(max(value, least) / least) / -log(LOGARITHMIC_SPAN);
}

fn color_at(table: u32, share: f32) -> vec4f {
    let x = clamp(share, 0.0, 1.0) * f32(CELLS - 1u);
    let cell = min(u32(x), CELLS - 2u);
    return mix(colors[table + cell], colors[table + cell + 1u], x - f32(cell));
}

// Lines about 1.5 pixels wide where the illuminance passes a level: white on dark colours, dark on bright ones.
fn on_isolines(at: vec2i, illuminance: f32, color: vec4f) -> vec4f {
    if shown.level_count == 0u {
        return color;
    }
    let slope = length(vec2f(slope_along(at, vec2i(1, 0), illuminance), slope_along(at, vec2i(0, 1), illuminance)));
    var nearest = shown.levels[0].x;
    for (var i = 1u; i < shown.level_count; i++) {
        let level = shown.levels[i / 4u][i % 4u];
        nearest = select(nearest, level, abs(illuminance - level) < abs(illuminance - nearest));
    }
    let strength = clamp(1.25 - abs(illuminance - nearest) / max(slope, 1e-30), 0.0, 1.0);
    let line = select(vec3f(1.0), vec3f(0.05), scale_share(nearest) > 0.65);
    return vec4f(mix(color.xyz, line, 0.85 * strength), 1.0);
}

// Change of the illuminance a pixel, from neighbours on the same piece of surface.
fn slope_along(at: vec2i, step: vec2i, here: f32) -> f32 {
    let ahead = illuminance_beside(at, at + step);
    let behind = illuminance_beside(at, at - step);
    if ahead.y == 0.0 {
        return behind.y * (here - behind.x);
    }
    return select(ahead.x - here, 0.5 * (ahead.x - behind.x), behind.y == 1.0);
}

// Of a pixel beside `at`; y is 1 where it shows the same piece of surface.
fn illuminance_beside(at: vec2i, other: vec2i) -> vec2f {
    let covered = textureLoad(display_mean, clamped(other), 0).w;
    if covered == 0.0 || any(other != clamped(other)) || is_apart(at, other) {
        return vec2f();
    }
    return vec2f(textureLoad(radiance_mean, other, 0).w / covered, 1.0);
}

// Whether two pixels beside each other show different pieces of surface: different surfaces, or an edge or a step of one.
fn is_apart(at: vec2i, other: vec2i) -> bool {
    if thing_at(at) != thing_at(other) {
        return true;
    }
    let p = textureLoad(positions, at, 0).xyz;
    let n = textureLoad(normals, at, 0).xyz;
    let q = textureLoad(positions, other, 0).xyz;
    return dot(n, textureLoad(normals, other, 0).xyz) < 0.5 || abs(dot(n, q - p)) > 0.01 * length(p);
}

// The surface that is seen, from 1; 0 where none is.
fn thing_at(at: vec2i) -> u32 {
    let item = u32(textureLoad(positions, clamped(at), 0).w);
    if item == 0u {
        return 0u;
    }
    return surfaces[item - 1u] + 1u;
}

fn clamped(at: vec2i) -> vec2i {
    return clamp(at, vec2i(), vec2i(textureDimensions(positions)) - 1);
}

fn srgb_encode(linear: vec3f) -> vec3f {
    let c = clamp(linear, vec3f(), vec3f(1.0));
    return select(1.055 * pow(max(c, vec3f(1e-8)), vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308));
}
