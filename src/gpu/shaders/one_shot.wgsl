// One-shot: a flat light as one point light a component. Lengths are in texels of the light's pattern.

struct OneShotLight {
    // The pattern's centre.
    center: vec3f,
    // A texel's side in metres.
    texel: f32,
    axis_u: vec3f,
    // Diffuse radius over |pt|.
    alpha: f32,
    axis_v: vec3f,
    // The light's own radius.
    radius: f32,
    // Of the lit side.
    normal: vec3f,
    two_sided: u32,
    // Binary logarithms of the specular radius over |pt| at the exponents 3/16, 3/4, 3, 12, 48, 192.
    shares: array<vec4f, 2>,
    // The pattern is the same all round its centre.
    is_round: u32,
}

@group(1) @binding(0) var<uniform> one_shot_light: OneShotLight;

// The table holds the disk kernel's sums, level by level for each sample; or the mipmap, level by level.

// Texels along a side of the pattern, and half of them.
const SIDE = 128u;
const HALF = 64.0;
// Samples along a side of the table, in a margin, and radii at each.
const TABLE_SIDE = 256u;
const MARGIN = 64u;
const LEVELS = 9u;
const REACH = 4160.0;
// Halvings of the mipmap.
const HALVINGS = 7u;
const LAST_KNOT = 5u;
const IN_PLANE = 1e-6;
const FARTHEST = 1e6;

const DISK = 0u;
const SQUARE = 1u;
const SIZED = 2u;

fn one_shot_respond(at: Shading) -> Response {
    return one_shot_response(at, DISK);
}

fn one_shot_respond_square(at: Shading) -> Response {
    return one_shot_response(at, SQUARE);
}

fn one_shot_respond_sized(at: Shading) -> Response {
    return one_shot_response(at, SIZED);
}

// The point of the plane that a component finds brightest.
struct Spot {
    place: vec2f,
    // From the shaded point to it.
    to_light: vec3f,
    distance: f32,
    // Cosine at the light over the squared distance.
    falloff: f32,
    // Cosine of its direction to the component's axis.
    cosine: f32,
}

// The shaded point as the light's plane sees it.
struct View {
    foot: vec2f,
    height: f32,
    // Unit direction from the point to the plane.
    ahead: vec3f,
}

fn one_shot_response(at: Shading, rule: u32) -> Response {
    let from_center = at.p - one_shot_light.center;
    let signed_height = dot(from_center, one_shot_light.normal);
    let foot = along_plane(from_center) / one_shot_light.texel;
    let height = abs(signed_height) / one_shot_light.texel;
    let lit = signed_height > 0.0 || one_shot_light.two_sided != 0u;
    if !lit || height <= IN_PLANE * (length(foot) + f32(SIDE)) {
        return Response(0.0, 0.0);
    }
    let view = View(foot, height, -one_shot_light.normal * sign(signed_height));
    let diffuse = brightest(view, at.n, 1.0);
    let diffuse_radius = one_shot_radius(diffuse.distance, one_shot_light.alpha, 1.0, one_shot_light.radius, rule);
    let irradiance = diffuse.falloff * max(diffuse.cosine, 0.0) * one_shot_sum(diffuse.place, diffuse_radius, rule);

    let m = lobes[at.lobe].cosine_exponent;
    let specular = brightest(view, at.r, m);
    if dot(at.n, specular.to_light) <= 0.0 {
        return Response(irradiance, 0.0);
    }
    var share = 0.0;
    if rule != SIZED {
        share = specular_share(m);
    }
    let radius = one_shot_radius(specular.distance, share, m, one_shot_light.radius * 7.0 / 6.0, rule);
    let density = lobe_density(at.lobe, at.n, at.r, specular.to_light / specular.distance);
    return Response(irradiance, specular.falloff * density * one_shot_sum(specular.place, radius, rule));
}

// The parts of a vector along the light's axes.
fn along_plane(v: vec3f) -> vec2f {
    return vec2f(dot(v, one_shot_light.axis_u), dot(v, one_shot_light.axis_v));
}

// The spot that maximises cos(ω, light's normal)·cosᵐ(ω, axis)/distance²; of falloff 0 where it runs to infinity.
fn brightest(view: View, axis: vec3f, m: f32) -> Spot {
    let parts = along_plane(axis);
    let tangential = length(parts);
    let away = -dot(axis, view.ahead);
    let t = brightest_step(tangential, away, m);
    let step = select(vec2f(), t * view.height * parts / tangential, tangential > 0.0);
    let to_light = step.x * one_shot_light.axis_u + step.y * one_shot_light.axis_v + view.height * view.ahead;
    let distance = view.height * sqrt(1.0 + t * t);
    let inverse = 1.0 / distance;
    let falloff = select(0.0, view.height * inverse * inverse * inverse, t < FARTHEST);
    let cosine = (t * tangential - away) * view.height * inverse;
    return Spot(view.foot + step, to_light, distance, falloff, cosine);
}

// How far the brightest spot is from the foot, in heights, at most FARTHEST.
fn brightest_step(tangential: f32, away: f32, m: f32) -> f32 {
    let b = (m + 3.0) * away;
    let root = sqrt(b * b + 12.0 * m * tangential * tangential);
    if away <= 0.0 {
        return 2.0 * m * tangential / max(root - b, 1e-30);
    }
    return min((b + root) / max(6.0 * tangential, 1e-30), FARTHEST);
}

// The neighbourhood's radius: a share of the distance, or by the light's own radius.
fn one_shot_radius(distance: f32, share: f32, m: f32, own: f32, rule: u32) -> f32 {
    if rule == SIZED {
        let near = distance * sqrt(2.0 / (m + 1.0));
        return near * own * inverseSqrt(own * own + near * near);
    }
    return share * distance;
}

// Specular radius over |pt|: its logarithm is linear in that of the exponent between knots, and beyond the last falls by
// the half of it.
fn specular_share(m: f32) -> f32 {
    let place = 0.5 * log2(m / 3.0) + 2.0;
    let last = f32(LAST_KNOT);
    let clamped = clamp(place, 0.0, last);
    let first = min(u32(clamped), LAST_KNOT - 1u);
    let next = first + 1u;
    let low = one_shot_light.shares[first / 4u][first % 4u];
    let high = one_shot_light.shares[next / 4u][next % 4u];
    return exp2(mix(low, high, clamped - f32(first)) - max(place - last, 0.0));
}

fn one_shot_sum(place: vec2f, radius: f32, rule: u32) -> f32 {
    let at = select(place, vec2f(length(place), 0.0), one_shot_light.is_round != 0u);
    if rule == SQUARE {
        return square_sum(at, radius);
    }
    return disk_sum(at, radius);
}

// ∫ L dA over the disk of a radius about a point.
fn disk_sum(at: vec2f, radius: f32) -> f32 {
    let shrink = min(1.0, REACH / max(max(abs(at.x), abs(at.y)), 1.0));
    let x = disk_cell(at.x * shrink);
    let y = disk_cell(at.y * shrink);
    let square = radius * radius * shrink * shrink;
    let column = u32(x.x);
    let row = u32(y.x);
    let near = mix(disk_level(column, row, square), disk_level(column + 1u, row, square), x.y);
    let far = mix(disk_level(column, row + 1u, square), disk_level(column + 1u, row + 1u, square), x.y);
    return mix(near, far, y.y);
}

// The sum at a sample for a squared radius, in which it is linear between levels.
fn disk_level(column: u32, row: u32, square_radius: f32) -> f32 {
    let depth = max(disk_depth(column), disk_depth(row));
    let scale = max(depth * depth, 1.0);
    let square = square_radius / (scale * scale);
    let first = (row * TABLE_SIDE + column) * LEVELS;
    let level = min(half_exponent(square), LEVELS - 2u);
    let below = exp2(2.0 * f32(level));
    let share = clamp((square - below) / (3.0 * below), 0.0, 1.0);
    let sum = mix(table_number(first + level), table_number(first + level + 1u), share);
    return select(sum, square * table_number(first), square < 1.0);
}

// ⌊log₄ x⌋ for x ≥ 1, else 0.
fn half_exponent(x: f32) -> u32 {
    return ((bitcast<u32>(max(x, 1.0)) >> 23u) - 127u) >> 1u;
}

// How many samples into a margin, 0 for the central ones.
fn disk_depth(sample: u32) -> f32 {
    let place = f32(sample);
    return max(max(f32(MARGIN) - place, place - f32(MARGIN + SIDE - 1u)), 0.0);
}

// The sample at or before a place along an axis, and how far on the way to the next it is.
fn disk_cell(x: f32) -> vec2f {
    let from_first = x + HALF - 0.5;
    if abs(x) <= HALF - 0.5 {
        let first = min(floor(from_first), f32(SIDE - 2u));
        return vec2f(f32(MARGIN) + first, from_first - first);
    }
    let outside = abs(x) - HALF;
    let j = min(floor(sqrt(max(outside, 0.0))), f32(MARGIN - 1u));
    let near = select(j * j, -0.5, j == 0.0);
    let far = (j + 1.0) * (j + 1.0);
    let share = clamp((outside - near) / (far - near), 0.0, 1.0);
    if x > 0.0 {
        return vec2f(f32(MARGIN + SIDE - 1u) + j, share);
    }
    return vec2f(f32(MARGIN - 1u) - j, 1.0 - share);
}

// ∫ L dA over the square of a half side about a point.
fn square_sum(at: vec2f, radius: f32) -> f32 {
    let side = 2.0 * radius;
    if side >= f32(SIDE) {
        let covered = clamp((vec2f(radius + HALF) - abs(at)) / f32(SIDE), vec2f(), vec2f(1.0));
        return table_number(mipmap_offset(HALVINGS)) * f32(SIDE * SIDE) * covered.x * covered.y;
    }
    let square = side * side;
    let level = min(half_exponent(square), HALVINGS - 1u);
    let below = exp2(2.0 * f32(level));
    let mean = mipmap_mean(level, at);
    if square < 1.0 {
        return square * mean;
    }
    return mix(below * mean, 4.0 * below * mipmap_mean(level + 1u, at), (square - below) / (3.0 * below));
}

// Where a level begins: (4⁸ − 4^(8 − level))/3.
fn mipmap_offset(level: u32) -> u32 {
    return (65536u - (1u << (16u - 2u * level))) / 3u;
}

// The mean at a level, bilinear between its texels' centres and 0 outside.
fn mipmap_mean(level: u32, at: vec2f) -> f32 {
    let place = (at + HALF) * exp2(-f32(level)) - 0.5;
    let first = floor(place);
    let share = place - first;
    let near = mix(mipmap_texel(level, first), mipmap_texel(level, first + vec2f(1.0, 0.0)), share.x);
    let far = mix(mipmap_texel(level, first + vec2f(0.0, 1.0)), mipmap_texel(level, first + 1.0), share.x);
    return mix(near, far, share.y);
}

fn mipmap_texel(level: u32, place: vec2f) -> f32 {
    let side = SIDE >> level;
    let inside = all(place >= vec2f()) && all(place < vec2f(f32(side)));
    let texel = vec2u(clamp(place, vec2f(), vec2f(f32(side) - 1.0)));
    return select(0.0, table_number(mipmap_offset(level) + texel.y * side + texel.x), inside);
}
