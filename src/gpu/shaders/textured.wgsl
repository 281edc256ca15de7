// Textured lights exactly: a walk through the pattern's parts, each opened until it is small where it stands.

struct TexturedLight {
    // Where the image's first texel is.
    corner: vec3f,
    two_sided: u32,
    // Along the first row, and along the first column, to their ends.
    row: vec3f,
    unused: u32,
    column: vec3f,
    // A part is small where its half diagonal is below this share of its distance.
    opening: f32,
    // Of the lit side.
    normal: vec3f,
    // What a part may add without being small, as a share of the whole.
    negligible: f32,
}

@group(1) @binding(0) var<uniform> textured_light: TexturedLight;

// The table holds the parts, each followed by its halves: where it starts and ends along the rows and the columns, which
// part follows when it is not opened, its flux; and its texels gathered on 4 × 4 Chebyshev nodes.

const PART = 24u;
const WEIGHTS = 8u;
// How often a texel is quartered where it is not small.
const DEEPEST = 10u;
// Below this share of its peak a lobe is nothing.
const FAINT = 1e-6;

const DARK = 0u;
const SMALL = 1u;
const OPEN = 2u;

fn textured_respond(at: Shading) -> Response {
    var light = textured_light;
    light.corner -= at.p;
    return textured_response(light, at.n, at.r, lobes[at.lobe].exponent);
}

// The rectangle about p, and what it is weighed with.
struct TexturedView {
    light: TexturedLight,
    // Of p above its plane.
    height: f32,
    area: f32,
    n: vec3f,
    r: vec3f,
    m: f32,
    // What may be neglected of the irradiance, and of the specular response.
    negligible: vec2f,
}

// Response at the origin. `light.corner` is about p.
fn textured_response(light: TexturedLight, n: vec3f, r: vec3f, m: f32) -> Response {
    var sum = Response(0.0, 0.0);
    let depth = -dot(light.normal, light.corner);
    let height = select(depth, abs(depth), light.two_sided == 1u);
    if height <= 0.0 {
        return sum;
    }
    let area = length(light.row) * length(light.column);
    let flux = table_number(5) * area;
    let centre = light.corner + 0.5 * (light.row + light.column);
    let distance = length(centre);
    // About what the whole gives where it faces, and no more than an endless light of its mean.
    let facing = min(flux * height / (distance * distance * distance), table_number(5));
    let peak = min(facing * lobe_normalization(m), table_number(5));
    let view = TexturedView(light, height, area, n, r, m, light.negligible * vec2f(facing, peak));
    let count = table_length() / PART;
    var i = 0u;
    while i < count {
        let first = i * PART;
        let low = vec2f(table_number(first), table_number(first + 1u));
        let high = vec2f(table_number(first + 2u), table_number(first + 3u));
        let next = u32(table_number(first + 4u));
        let state = part_state(view, low, high, table_number(first + 5u));
        i += 1u;
        if state == SMALL {
            sum = added(sum, gathered_response(view, low, high, first + WEIGHTS));
            i = next;
        } else if state == DARK {
            i = next;
        } else if i == next {
            sum = added(sum, even_response(view, low, high, table_number(first + 5u)));
        }
    }
    return sum;
}

fn added(a: Response, b: Response) -> Response {
    return Response(a.irradiance + b.irradiance, a.specular + b.specular);
}

fn place(view: TexturedView, at: vec2f) -> vec3f {
    return view.light.corner + at.x * view.light.row + at.y * view.light.column;
}

// Whether a part of that flux is below the horizon, small, or to be opened.
fn part_state(view: TexturedView, low: vec2f, high: vec2f, flux: f32) -> u32 {
    let centre = place(view, 0.5 * (low + high));
    let extent = high - low;
    let radius = 0.5 * length(vec2f(extent.x * length(view.light.row), extent.y * length(view.light.column)));
    let distance = length(centre);
    let above = dot(view.n, centre);
    if above <= -radius {
        return DARK;
    }
    let spread = radius / distance;
    // Angles from the lobe's axis: the centre's, less the part's.
    let cosine = dot(view.r, centre) / distance;
    let sine = sqrt(max(1.0 - cosine * cosine, 0.0));
    let width = sqrt(max(1.0 - spread * spread, 0.0));
    let nearest_cosine = select(cosine * width + sine * spread, 1.0, spread >= sine && cosine > 0.0 || spread >= 1.0);
    let lobe = power(nearest_cosine, view.m);
    let narrow = spread * sqrt(view.m) > 2.0 * view.light.opening;
    let crossed = above < radius;
    if spread <= view.light.opening && !crossed && !(narrow && lobe > FAINT) {
        return SMALL;
    }
    let nearest = max(distance - radius, view.height);
    let greatest = flux * view.area * view.height / (nearest * nearest * nearest);
    let lit = greatest * min(max(above + radius, 0.0) / nearest, 1.0);
    let shining = greatest * lobe * lobe_normalization(view.m);
    return select(OPEN, SMALL, lit < view.negligible.x && shining < view.negligible.y);
}

// What a point of the rectangle adds: a share of the area seen from p, weighed.
fn point_of(view: TexturedView, at: vec2f, weight: f32) -> Response {
    let x = place(view, at);
    let square = dot(x, x);
    let w = x * inverseSqrt(square);
    let cosine = dot(view.n, w);
    if cosine <= 0.0 {
        return Response(0.0, 0.0);
    }
    let seen = weight * view.area * view.height * inverseSqrt(square) / square;
    return Response(seen * cosine, seen * lobe_normalization(view.m) * lobe_power(view.r, w, view.m));
}

// Chebyshev's nodes cos((k + ½)π/4), and Fejér's weights, which are halved: of shares, not of [−1, 1].
const NODES = array<f32, 4>(0.92387953251128674, 0.38268343236508977, -0.38268343236508977, -0.92387953251128674);
const FEJER = array<f32, 4>(0.13214886980224205, 0.36785113019775795, 0.36785113019775795, 0.13214886980224205);

// A part by its gathered texels.
fn gathered_response(view: TexturedView, low: vec2f, high: vec2f, first: u32) -> Response {
    var nodes = NODES;
    var sum = Response(0.0, 0.0);
    for (var k = 0u; k < 16u; k++) {
        let at = mix(low, high, 0.5 + 0.5 * vec2f(nodes[k & 3u], nodes[k >> 2u]));
        sum = added(sum, point_of(view, at, table_number(first + k)));
    }
    return sum;
}

// A part of one luminance.
fn even_part_response(view: TexturedView, low: vec2f, high: vec2f, flux: f32) -> Response {
    var nodes = NODES;
    var weights = FEJER;
    var sum = Response(0.0, 0.0);
    for (var k = 0u; k < 16u; k++) {
        let at = mix(low, high, 0.5 + 0.5 * vec2f(nodes[k & 3u], nodes[k >> 2u]));
        sum = added(sum, point_of(view, at, flux * weights[k & 3u] * weights[k >> 2u]));
    }
    return sum;
}

// A part of one luminance that is not small, quartered until its parts are: `path` holds two bits a level.
fn even_response(view: TexturedView, low: vec2f, high: vec2f, flux: f32) -> Response {
    var sum = Response(0.0, 0.0);
    var level = 1u;
    var path = 0u;
    while level > 0u {
        let side = exp2(-f32(level));
        let from_low = vec2f(vec2u(even_bits(path), even_bits(path >> 1u))) * side;
        let part_low = mix(low, high, from_low);
        let part_high = mix(low, high, from_low + side);
        let part_flux = flux * side * side;
        let state = part_state(view, part_low, part_high, part_flux);
        if state == OPEN && level < DEEPEST {
            level += 1u;
            path = path << 2u;
            continue;
        }
        if state != DARK {
            sum = added(sum, even_part_response(view, part_low, part_high, part_flux));
        }
        while level > 0u && (path & 3u) == 3u {
            level -= 1u;
            path = path >> 2u;
        }
        path += 1u;
    }
    return sum;
}

// Every second bit, from the lowest.
fn even_bits(x: u32) -> u32 {
    var bits = x & 0x55555555u;
    bits = (bits | (bits >> 1u)) & 0x33333333u;
    bits = (bits | (bits >> 2u)) & 0x0f0f0f0fu;
    bits = (bits | (bits >> 4u)) & 0x00ff00ffu;
    return (bits | (bits >> 8u)) & 0x0000ffffu;
}
