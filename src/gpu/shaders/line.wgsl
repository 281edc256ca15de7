// A linear light of unit intensity per metre.
//
// Everything happens in the frame of the foot of the perpendicular from p to the light's line, as in `shading::line`:
// the light is the points foot + s·axis with s from a to b, at the distances √(d² + s²), d = ‖foot‖.

struct LineLight {
    a: vec3f,
    falloff: f32,
    b: vec3f,
    unused: u32,
}

@group(1) @binding(0) var<uniform> line_light: LineLight;

fn line_respond_exact(at: Shading) -> Response {
    let m = lobes[at.lobe].exponent;
    let line = line_above(line_frame(line_light.a - at.p, line_light.b - at.p), at.n);
    return line_response(line, at, lobe_normalization(m) * line_phong_of(line, at.r, m, line_light.falloff));
}

fn line_respond_chebyshev(at: Shading) -> Response {
    let line = line_above(line_frame(line_light.a - at.p, line_light.b - at.p), at.n);
    let specular = line_chebyshev_of(line, at.r, line_light.falloff, at.lobe);
    return line_response(line, at, lobe_normalization(lobes[at.lobe].exponent) * specular);
}

fn line_respond_nearest_point(at: Shading) -> Response {
    let line = line_above(line_frame(line_light.a - at.p, line_light.b - at.p), at.n);
    let intensity = distance(line_light.a, line_light.b);
    let specular = line_nearest_point_of(line, at.r, lobes[at.lobe].exponent, line_light.falloff, intensity);
    return line_response(line, at, specular);
}

fn line_response(line: LineFrame, at: Shading, specular: f32) -> Response {
    if line.length <= 0.0 {
        return Response(0.0, 0.0);
    }
    return Response(line_irradiance_of(line, at.n, line_light.falloff), specular);
}

// The ends are relative to p in all that follows.
fn line_irradiance(a: vec3f, b: vec3f, n: vec3f, falloff: f32) -> f32 {
    return line_irradiance_of(line_above(line_frame(a, b), n), n, falloff);
}

fn line_phong(a: vec3f, b: vec3f, n: vec3f, r: vec3f, m: f32, falloff: f32) -> f32 {
    return line_phong_of(line_above(line_frame(a, b), n), r, m, falloff);
}

fn line_chebyshev(a: vec3f, b: vec3f, n: vec3f, r: vec3f, falloff: f32, lobe_index: u32) -> f32 {
    return line_chebyshev_of(line_above(line_frame(a, b), n), r, falloff, lobe_index);
}

// With (m + 1)/2π, and the line's whole intensity.
fn line_nearest_point(a: vec3f, b: vec3f, n: vec3f, r: vec3f, m: f32, falloff: f32) -> f32 {
    return line_nearest_point_of(line_above(line_frame(a, b), n), r, m, falloff, distance(a, b));
}

struct LineFrame {
    foot: vec3f,
    axis: vec3f,
    d: f32,
    a: f32,
    b: f32,
    // b − a, which the difference does not give for short lines far away; 0 where there is no line.
    length: f32,
}

fn line_frame(to_a: vec3f, to_b: vec3f) -> LineFrame {
    let along = to_b - to_a;
    let length = length(along);
    let axis = along / max(length, 1e-30);
    // The foot is found from the nearer end, so that its rounding is that of the shorter vector.
    let from_a = dot(to_a, to_a) < dot(to_b, to_b);
    let near = select(to_b, to_a, from_a);
    let s = dot(near, axis);
    let foot = near - s * axis;
    let a = select(s - length, s, from_a);
    return LineFrame(foot, axis, length_of(foot), a, select(s, s + length, from_a), length);
}

fn length_of(v: vec3f) -> f32 {
    return sqrt(dot(v, v));
}

// The part where n·w > 0.
fn line_above(line: LineFrame, n: vec3f) -> LineFrame {
    let base = dot(n, line.foot);
    let slope = dot(n, line.axis);
    let at_a = base + line.a * slope;
    let at_b = base + line.b * slope;
    var part = line;
    if at_a <= 0.0 && at_b <= 0.0 {
        part.length = 0.0;
    } else if at_a < 0.0 || at_b < 0.0 {
        part.length = line.length * (max(at_a, at_b) / abs(at_a - at_b));
        part.a = select(line.a, line.b - part.length, at_a < 0.0);
        part.b = select(line.b, line.a + part.length, at_b < 0.0);
    }
    return part;
}

// The ends' distances, and r_a r_b + A·B.
struct LineEnds {
    r_a: f32,
    r_b: f32,
    opening: f32,
}

fn line_ends(line: LineFrame) -> LineEnds {
    let square = line.d * line.d;
    let r_a = sqrt(square + line.a * line.a);
    let r_b = sqrt(square + line.b * line.b);
    let product = r_a * r_b;
    let ab = line.a * line.b;
    var opening = product + square + ab;
    if ab < 0.0 {
        opening = square * (1.0 + (square + line.a * line.a + line.b * line.b) / (product - ab));
    }
    return LineEnds(r_a, r_b, opening);
}

// A line walked in y with ds = r dy: r = α eʸ + β e⁻ʸ, s = α eʸ − β e⁻ʸ from a at y = 0 to b at `end`.
struct LinePath {
    alpha: f32,
    beta: f32,
    end: f32,
}

fn line_path(line: LineFrame) -> LinePath {
    let square = line.d * line.d;
    let a = abs(line.a);
    let b = abs(line.b);
    let r_a = sqrt(square + a * a);
    let r_b = sqrt(square + b * b);
    let large = 0.5 * (r_a + a);
    let small = 0.25 * square / large;
    // r_a + r_b − L without cancellation.
    var excess = select(r_b + b + square / (r_a + a), r_a + a + square / (r_b + b), a < b);
    if line.a * line.b < 0.0 {
        excess = square / (r_a + a) + square / (r_b + b);
    }
    let end = log_one_plus(2.0 * line.length / max(excess, 1e-30));
    return LinePath(select(small, large, line.a >= 0.0), select(large, small, line.a >= 0.0), end);
}

// Gauss–Legendre on [−1, 1]: the positive nodes and their weights.
const LINE_HALF_NODES = 5u;
const LINE_NODES = array<vec2f, 5>(
    vec2f(0.14887433898163121088, 0.29552422471475287017),
    vec2f(0.43339539412924719080, 0.26926671930999635509),
    vec2f(0.67940956829902440623, 0.21908636251598204400),
    vec2f(0.86506336668898451073, 0.14945134915058059315),
    vec2f(0.97390652851717172008, 0.06667134430868813759),
);
// Panels are no wider, in y.
const LINE_PANEL = 2.0;

// E = ∫ max(0, n·w)/rᶠ ds; the frame is clipped already.
fn line_irradiance_of(line: LineFrame, n: vec3f, falloff: f32) -> f32 {
    if line.length <= 0.0 {
        return 0.0;
    }
    let base = dot(n, line.foot);
    let slope = dot(n, line.axis);
    if falloff == 2.0 {
        let ends = line_ends(line);
        let sum = (base + line.a * slope) / ends.r_a + (base + line.b * slope) / ends.r_b;
        return max(line.length * sum / max(ends.opening, 1e-37), 0.0);
    }
    let path = line_path(line);
    let panels = max(ceil(path.end / LINE_PANEL), 1.0);
    let half = 0.5 * path.end / panels;
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * LINE_HALF_NODES; i++) {
            let node = LINE_NODES[i >> 1u];
            let growth = exp(half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u)));
            let up = path.alpha * growth;
            let down = path.beta / growth;
            sum += node.y * (base + (up - down) * slope) * power(up + down, -falloff);
        }
    }
    return max(half * sum, 0.0);
}

// The lobe as the plane of p and the line sees it.
struct LineLobe {
    // Length of r projected on that plane.
    amplitude: f32,
    // The unit projection's parts towards the foot and along the axis.
    across: f32,
    along: f32,
}

fn line_lobe(line: LineFrame, r: vec3f) -> LineLobe {
    let along = dot(r, line.axis);
    var across = 0.0;
    if line.d > 0.0 {
        across = dot(r, line.foot) / line.d;
    }
    let amplitude = sqrt(across * across + along * along);
    let inverse = 1.0 / max(amplitude, 1e-30);
    return LineLobe(amplitude, across * inverse, along * inverse);
}

// ∫ max(0, r·w)ᵐ/rᶠ ds, without (m + 1)/2π; the frame is clipped by n already.
fn line_phong_of(line: LineFrame, r: vec3f, m: f32, falloff: f32) -> f32 {
    let lit = line_above(line, r);
    if lit.length <= 0.0 {
        return 0.0;
    }
    let lobe = line_lobe(lit, r);
    // cosᵐφ < e^(−mφ²/2), which is below 1.2e-7 from here on.
    let cut = min(sqrt(32.0 / m), 1.5);
    let part = line_within(lit, lobe, select(1e6, tan(cut), cut < 1.5));
    if part.length <= 0.0 {
        return 0.0;
    }
    let peak = clamp(line.d * lobe.along / max(lobe.across, 1e-30), part.a, part.b);
    let before = LineFrame(line.foot, line.axis, line.d, part.a, peak, select(peak - part.a, part.length, peak == part.b));
    let after = LineFrame(line.foot, line.axis, line.d, peak, part.b, select(part.b - peak, part.length, peak == part.a));
    return power(lobe.amplitude, m)
        * (line_cosine_power(before, lobe, m, falloff) + line_cosine_power(after, lobe, m, falloff));
}

// The part within an angle, of tangent `t`, of the lobe's projection.
fn line_within(line: LineFrame, lobe: LineLobe, t: f32) -> LineFrame {
    if line.d == 0.0 {
        return line;
    }
    let low = lobe.across + t * lobe.along;
    let high = lobe.across - t * lobe.along;
    var part = line;
    if low > 0.0 {
        part.a = max(line.a, line.d * (lobe.along - t * lobe.across) / low);
    } else if lobe.along > 0.0 {
        part.length = 0.0;
    }
    if high > 0.0 {
        part.b = min(line.b, line.d * (lobe.along + t * lobe.across) / high);
    } else if lobe.along < 0.0 {
        part.length = 0.0;
    }
    if part.a != line.a || part.b != line.b {
        part.length = select(part.b - part.a, 0.0, part.length == 0.0);
    }
    return part;
}

// ∫ cosᵐφ/rᶠ ds over y, φ from the lobe's projection, cosᵐφ = (1 − sin²φ)^(m/2).
fn line_cosine_power(line: LineFrame, lobe: LineLobe, m: f32, falloff: f32) -> f32 {
    if line.length <= 0.0 {
        return 0.0;
    }
    let path = line_path(line);
    let panels = max(ceil(path.end / LINE_PANEL), 1.0);
    let half = 0.5 * path.end / panels;
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * LINE_HALF_NODES; i++) {
            let node = LINE_NODES[i >> 1u];
            let growth = exp(half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u)));
            let up = path.alpha * growth;
            let down = path.beta / growth;
            let r = up + down;
            let sine = (lobe.across * (up - down) - lobe.along * line.d) / r;
            let value = exp(0.5 * m * log_one_plus(-min(sine * sine, 0.9999999)));
            sum += node.y * value * line_attenuation(r, falloff);
        }
    }
    return half * sum;
}

// r^(1−f)
fn line_attenuation(r: f32, falloff: f32) -> f32 {
    if falloff == 2.0 {
        return 1.0 / r;
    }
    return power(r, 1.0 - falloff);
}

// `line_phong_of` with cosᵐφ replaced by the lobe's Chebyshev fit.
fn line_chebyshev_of(line: LineFrame, r: vec3f, falloff: f32, lobe_index: u32) -> f32 {
    let lit = line_above(line, r);
    if lit.length <= 0.0 {
        return 0.0;
    }
    let lobe = line_lobe(lit, r);
    let m = lobes[lobe_index].exponent;
    let scale = power(min(lobe.amplitude, 1.0), m);
    if falloff != 2.0 {
        return max(scale * line_chebyshev_sum(lit, lobe, falloff, lobe_index), 0.0);
    }
    let square = lit.d * lit.d;
    let angle = arctangent(lit.d * lit.length, square + lit.a * lit.b);
    let ends = line_ends(lit);
    let angle_over_d = select(lit.length / (ends.r_a * ends.r_b), angle / lit.d, lit.d > 0.0);
    let from_angle = arctangent(
        lobe.across * lit.a - lobe.along * lit.d,
        lobe.across * lit.d + lobe.along * lit.a,
    );
    return max(scale * angle_over_d * chebyshev_mean(lobe_index, from_angle, angle), 0.0);
}

// The mean of the fit over [start, start + width], a side of 0 at a time.
fn chebyshev_mean(lobe_index: u32, start: f32, width: f32) -> f32 {
    let cut = lobes[lobe_index].chebyshev_cut;
    let low = max(start, -cut);
    let high = min(start + width, cut);
    if low > high {
        return 0.0;
    }
    if low == start && high == start + width && (low >= 0.0 || high <= 0.0) {
        return chebyshev_side_mean(lobe_index, start, width);
    }
    let middle = clamp(0.0, low, high);
    let before = (middle - low) * chebyshev_side_mean(lobe_index, low, middle - low);
    let after = (high - middle) * chebyshev_side_mean(lobe_index, middle, high - middle);
    return (before + after) / width;
}

// Gauss–Legendre with 4 nodes is exact for the fit's degree, 6 (and 7), and does not cancel where the light is small.
fn chebyshev_side_mean(lobe_index: u32, start: f32, width: f32) -> f32 {
    let inner = 0.5 * 0.33998104358485626480;
    let outer = 0.5 * 0.86113631159405257522;
    let sum_inner = chebyshev_value(lobe_index, start + (0.5 - inner) * width)
        + chebyshev_value(lobe_index, start + (0.5 + inner) * width);
    let sum_outer = chebyshev_value(lobe_index, start + (0.5 - outer) * width)
        + chebyshev_value(lobe_index, start + (0.5 + outer) * width);
    return 0.5 * (0.65214515486254614263 * sum_inner + 0.34785484513745385737 * sum_outer);
}

fn chebyshev_coefficient(lobe_index: u32, i: u32) -> f32 {
    return lobes[lobe_index].chebyshev[i >> 2u][i & 3u];
}

fn chebyshev_value(lobe_index: u32, phi: f32) -> f32 {
    let t = abs(phi) / lobes[lobe_index].chebyshev_cut;
    var sum = 0.0;
    for (var i = lobes[lobe_index].chebyshev_count; i > 0u; i--) {
        sum = sum * t + chebyshev_coefficient(lobe_index, i - 1u);
    }
    return select(sum, 0.0, t > 1.0);
}

// ∫ fit(φ)/rᶠ ds over y.
fn line_chebyshev_sum(line: LineFrame, lobe: LineLobe, falloff: f32, lobe_index: u32) -> f32 {
    let part = line_within(line, lobe, lobes[lobe_index].chebyshev_tan_cut);
    if part.length <= 0.0 {
        return 0.0;
    }
    let path = line_path(part);
    let panels = max(ceil(path.end / (0.25 * LINE_PANEL)), 1.0);
    let half = 0.5 * path.end / panels;
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * LINE_HALF_NODES; i++) {
            let node = LINE_NODES[i >> 1u];
            let growth = exp(half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u)));
            let up = path.alpha * growth;
            let down = path.beta / growth;
            let s = up - down;
            let phi = arctangent(lobe.across * s - lobe.along * line.d, lobe.across * line.d + lobe.along * s);
            sum += node.y * chebyshev_value(lobe_index, phi) * line_attenuation(up + down, falloff);
        }
    }
    return half * sum;
}

// The light's `intensity` at its point of least angle to r.
fn line_nearest_point_of(line: LineFrame, r: vec3f, m: f32, falloff: f32, intensity: f32) -> f32 {
    if line.length <= 0.0 {
        return 0.0;
    }
    let nearest = line_nearest_of(line, r);
    return falloff_response(nearest, intensity, falloff, nearest, r, m).specular;
}

// The point of least angle to r ([PICOTT_1992], eq. 7), where it is a maximum between the ends.
fn line_nearest_of(line: LineFrame, r: vec3f) -> vec3f {
    let base = dot(r, line.foot);
    let slope = dot(r, line.axis);
    let ends = line_ends(line);
    let at_a = (base + line.a * slope) * ends.r_b;
    let at_b = (base + line.b * slope) * ends.r_a;
    // Seen end on, both are the same: then it is a, whatever the rounding.
    let a_is_nearer = at_a >= at_b - 1e-6 * abs(at_b);
    var s = select(line.b, line.a, a_is_nearer);
    if base > 0.0 {
        let best = slope * line.d * line.d / base;
        if line.a < best && best < line.b {
            s = best;
        }
    }
    return line.foot + s * line.axis;
}
