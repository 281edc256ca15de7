// A linear light of unit intensity per metre, or a tube of unit luminance.
// One file, though long: every method of a line, tubes too, shares its frame, its clipping and its lobe tables.
//
// Everything happens in the frame of the foot of the perpendicular from p to the light's line, as in `shading::line`:
// the light is the points foot + s·axis with s from a to b, at the distances √(d² + s²), d = ‖foot‖. A tube of
// diameter 2ϱ is 2ϱd times a line of falloff f + 1.

struct LineLight {
    a: vec3f,
    falloff: f32,
    b: vec3f,
    // Of a tube; 0 for a line that emits the same in all directions.
    diameter: f32,
}

@group(1) @binding(0) var<uniform> line_light: LineLight;

// The light of most scenes: isotropic, of falloff 2.
fn line_respond_exact(at: Shading) -> Response {
    let line = line_seen(at);
    let specular = line_phong_plain(line, at.r, at.lobe);
    let irradiance = line_irradiance_plain(line_light.a - at.p, line_light.b - at.p, at.n);
    return Response(irradiance, lobe_normalization(lobes[at.lobe].exponent) * specular);
}

fn line_respond_chebyshev(at: Shading) -> Response {
    return line_respond_fit(at, SHORT_FIT);
}

fn line_respond_chebyshev_long(at: Shading) -> Response {
    return line_respond_fit(at, LONG_FIT);
}

fn line_respond_fit(at: Shading, quads: u32) -> Response {
    let specular = line_chebyshev_plain(line_seen(at), at.r, at.lobe, quads);
    let irradiance = line_irradiance_plain(line_light.a - at.p, line_light.b - at.p, at.n);
    return Response(irradiance, lobe_normalization(lobes[at.lobe].exponent) * specular);
}

fn line_respond_nearest_point(at: Shading) -> Response {
    let line = line_seen(at);
    let intensity = distance(line_light.a, line_light.b);
    let specular = line_nearest_point_of(line, at.r, at.lobe, 2.0, intensity);
    return Response(line_irradiance_plain(line_light.a - at.p, line_light.b - at.p, at.n), specular);
}

// Lines of any falloff, and tubes.
fn line_respond_exact_decaying(at: Shading) -> Response {
    let line = line_seen(at);
    let decay = line_decay(line, line_light.falloff, line_light.diameter);
    let specular = decay.gain * line_phong_of(line, at.r, lobes[at.lobe].exponent, decay.falloff);
    return line_decaying_response(line, decay, at, specular);
}

fn line_respond_chebyshev_decaying(at: Shading) -> Response {
    let line = line_seen(at);
    let decay = line_decay(line, line_light.falloff, line_light.diameter);
    let specular = decay.gain * line_chebyshev_of(line, at.r, decay.falloff, at.lobe);
    return line_decaying_response(line, decay, at, specular);
}

fn line_respond_nearest_point_decaying(at: Shading) -> Response {
    let line = line_seen(at);
    let decay = line_decay(line, line_light.falloff, line_light.diameter);
    let intensity = distance(line_light.a, line_light.b);
    let specular = line_nearest_point_of(line, at.r, at.lobe, line_light.falloff, intensity);
    let irradiance = decay.gain * line_irradiance_of(line, at.n, decay.falloff);
    return Response(irradiance, specular * line_emission(line, at.r, line_light.diameter));
}

fn line_seen(at: Shading) -> LineFrame {
    return line_above(line_frame(line_light.a - at.p, line_light.b - at.p), at.n);
}

fn line_decaying_response(line: LineFrame, decay: LineDecay, at: Shading, specular: f32) -> Response {
    let irradiance = decay.gain * line_irradiance_of(line, at.n, decay.falloff);
    return Response(irradiance, lobe_normalization(lobes[at.lobe].exponent) * specular);
}

// The ends are relative to p in all that follows.
fn line_irradiance(a: vec3f, b: vec3f, n: vec3f, falloff: f32, diameter: f32) -> f32 {
    if falloff == 2.0 && diameter == 0.0 {
        return line_irradiance_plain(a, b, n);
    }
    let line = line_above(line_frame(a, b), n);
    let decay = line_decay(line, falloff, diameter);
    return decay.gain * line_irradiance_of(line, n, decay.falloff);
}

fn line_phong(a: vec3f, b: vec3f, n: vec3f, r: vec3f, falloff: f32, diameter: f32, lobe_index: u32) -> f32 {
    let line = line_above(line_frame(a, b), n);
    if falloff == 2.0 && diameter == 0.0 {
        return line_phong_plain(line, r, lobe_index);
    }
    let decay = line_decay(line, falloff, diameter);
    return decay.gain * line_phong_of(line, r, lobes[lobe_index].exponent, decay.falloff);
}

fn line_chebyshev(a: vec3f, b: vec3f, n: vec3f, r: vec3f, falloff: f32, diameter: f32, lobe_index: u32) -> f32 {
    let line = line_above(line_frame(a, b), n);
    if falloff == 2.0 && diameter == 0.0 {
        return line_chebyshev_plain(line, r, lobe_index, LONG_FIT);
    }
    let decay = line_decay(line, falloff, diameter);
    return decay.gain * line_chebyshev_of(line, r, decay.falloff, lobe_index);
}

// With (m + 1)/2π, and the line's whole intensity.
fn line_nearest_point(a: vec3f, b: vec3f, n: vec3f, r: vec3f, lobe: u32, falloff: f32, diameter: f32) -> f32 {
    let line = line_above(line_frame(a, b), n);
    let emission = line_emission(line, r, diameter);
    return emission * line_nearest_point_of(line, r, lobe, falloff, distance(a, b));
}

// The isotropic line that a light is `gain` times.
struct LineDecay {
    gain: f32,
    falloff: f32,
}

fn line_decay(line: LineFrame, falloff: f32, diameter: f32) -> LineDecay {
    if diameter > 0.0 {
        return LineDecay(diameter * line.d, falloff + 1.0);
    }
    return LineDecay(1.0, falloff);
}

struct LineFrame {
    foot: vec3f,
    axis: vec3f,
    // Across the plane of p and the line, of any length: zero on the line's axis.
    across: vec3f,
    d: f32,
    a: f32,
    b: f32,
    // b − a, which the difference does not give for short lines far away; 0 where there is no line.
    length: f32,
}

fn line_frame(to_a: vec3f, to_b: vec3f) -> LineFrame {
    let along = to_b - to_a;
    let length = length(along);
    let inverse = 1.0 / max(length, 1e-30);
    let axis = along * inverse;
    let from_a = dot(to_a, to_a) < dot(to_b, to_b);
    let near = select(to_b, to_a, from_a);
    let across = exact_moment(near, to_a, to_b) * inverse;
    let foot = cross(axis, across);
    let s = dot(near, axis);
    let a = select(s - length, s, from_a);
    return LineFrame(foot, axis, across, length_of(across), a, select(s, s + length, from_a), length);
}

// u × (b − a), of which nothing is lost where they are nearly parallel.
//
// Of u and of the difference, 12 bits are taken as whole numbers, whose products and differences are exact, and which no
// compiler takes for real numbers; what is left of them is small.
fn exact_moment(u: vec3f, a: vec3f, b: vec3f) -> vec3f {
    let v = b - a;
    let u_scale = whole_scale(u);
    let v_scale = whole_scale(v);
    let u_whole = round(u * u_scale);
    let v_whole = round(v * v_scale);
    let p = vec3i(u_whole);
    let q = vec3i(v_whole);
    let whole = vec3f(p.yzx * q.zxy - p.zxy * q.yzx) / (u_scale * v_scale);
    let u_near = u_whole / u_scale;
    let v_near = v_whole / v_scale;
    // b − a − v_near, from the greater of the two.
    let v_rest = select((b - v_near) - a, b - (a + v_near), abs(a) > abs(b));
    return whole + (cross(u - u_near, v) + cross(u_near, v_rest));
}

// The power of two that brings the greatest component between 2048 and 4096.
fn whole_scale(v: vec3f) -> f32 {
    let greatest = max(max(abs(v.x), abs(v.y)), max(abs(v.z), 1e-15));
    return 2048.0 / bitcast<f32>(bitcast<u32>(greatest) & 0x7f800000u);
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
        let crossing = clamp(-base / slope, line.a, line.b);
        part.a = select(line.a, crossing, at_a < 0.0);
        part.b = select(line.b, crossing, at_b < 0.0);
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
    let wide = square * (1.0 + (square + line.a * line.a + line.b * line.b) / max(product - ab, 1e-37));
    return LineEnds(r_a, r_b, select(product + square + ab, wide, ab < 0.0));
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

// E = ∫ max(0, n·w)/r² ds = L(n·A/r_a + n·B/r_b)/(r_a r_b + A·B), A and B the ends of the part above n's horizon.
fn line_irradiance_plain(to_a: vec3f, to_b: vec3f, n: vec3f) -> f32 {
    let along = to_b - to_a;
    let above_a = dot(n, to_a);
    let above_b = dot(n, to_b);
    // Shares of the line that are below the horizon at either end.
    let rise = 1.0 / max(abs(above_b - above_a), 1e-37);
    let a = to_a + min(max(-above_a, 0.0) * rise, 1.0) * along;
    let b = to_b - min(max(-above_b, 0.0) * rise, 1.0) * along;
    let visible = select(1.0, max(above_a, above_b) * rise, min(above_a, above_b) < 0.0);
    let square_a = dot(a, a);
    let square_b = dot(b, b);
    let r_a = sqrt(square_a);
    let r_b = sqrt(square_b);
    let product = max(r_a * r_b, 1e-37);
    let ab = dot(a, b);
    // r_a r_b + A·B as |A × B|²/(r_a r_b − A·B) where the latter is the greater.
    let moment = visible * cross(select(b, a, square_a < square_b), along);
    let opening = select(product + ab, dot(moment, moment) / max(product - ab, 1e-37), ab < 0.0);
    let sum = max(above_a, 0.0) * r_b + max(above_b, 0.0) * r_a;
    let is_seen = max(above_a, above_b) > 0.0;
    return select(0.0, visible * length(along) * (sum / product) / max(opening, 1e-37), is_seen);
}

// E = ∫ max(0, n·w)/rᶠ ds; the frame is clipped already.
fn line_irradiance_of(line: LineFrame, n: vec3f, falloff: f32) -> f32 {
    if line.length <= 0.0 {
        return 0.0;
    }
    let base = dot(n, line.foot);
    let slope = dot(n, line.axis);
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
    toward: f32,
    along: f32,
    // ln amplitude², from the part of r that is not in the plane.
    log_square: f32,
}

fn line_lobe(line: LineFrame, r: vec3f) -> LineLobe {
    let along = dot(r, line.axis);
    let inverse_d = 1.0 / max(line.d, 1e-30);
    let toward = dot(r, line.foot) * inverse_d;
    let amplitude = sqrt(toward * toward + along * along);
    let inverse = 1.0 / max(amplitude, 1e-30);
    let off = dot(r, line.across) * inverse_d;
    let beside = cross(r, line.axis);
    let sine_squared = select(dot(beside, beside), off * off, line.d > 0.0);
    return LineLobe(amplitude, toward * inverse, along * inverse, log_one_plus(-min(sine_squared, 0.9999999)));
}

// A lit line's ends as the lobe sees them: sine and cosine of the angles from its projection.
struct LineAngles {
    a: vec2f,
    b: vec2f,
    // Of the angle between the ends.
    sine: f32,
    // ∫ ds/r² where that angle is small.
    narrow: f32,
    is_below_right_angle: bool,
}

fn line_angles(line: LineFrame, lobe: LineLobe) -> LineAngles {
    let square = line.d * line.d;
    let inverse_a = inverseSqrt(max(square + line.a * line.a, 1e-37));
    let inverse_b = inverseSqrt(max(square + line.b * line.b, 1e-37));
    let a = vec2f(lobe.toward * line.a - lobe.along * line.d, lobe.toward * line.d + lobe.along * line.a) * inverse_a;
    let b = vec2f(lobe.toward * line.b - lobe.along * line.d, lobe.toward * line.d + lobe.along * line.b) * inverse_b;
    let chord = line.length * inverse_a * inverse_b;
    let sine = line.d * chord;
    let narrow = chord * (1.0 + sine * sine * (1.0 / 6.0 + sine * sine * (3.0 / 40.0)));
    return LineAngles(a, b, sine, narrow, square + line.a * line.b > 0.0);
}

// Sine and cosine of the middle between two angles.
fn line_middle(a: vec2f, b: vec2f) -> vec2f {
    let sum = a + b;
    return sum * inverseSqrt(max(dot(sum, sum), 1e-37));
}

// ∫ max(0, r·w)ᵐ/r² ds, without (m + 1)/2π; the frame is clipped by n already.
//
// It is ampᵐ/d times the difference of ∫cosᵐφ dφ between the ends, from the lobe's table; where they are close together,
// the value in the middle and what cosᵐ bends about it.
fn line_phong_plain(line: LineFrame, r: vec3f, lobe_index: u32) -> f32 {
    let lit = line_above(line, r);
    let m = lobes[lobe_index].exponent;
    let lobe = line_lobe(lit, r);
    let angles = line_angles(lit, lobe);
    let between = cosine_integral(lobe_index, angles.b) - cosine_integral(lobe_index, angles.a);
    let middle = line_middle(angles.a, angles.b);
    let sine_squared = min(middle.x * middle.x, 0.9999999);
    let square = angles.sine * angles.sine;
    let is_narrow = angles.is_below_right_angle && square * (m + 1.0) < 0.04;
    let log_value = lobe.log_square + select(0.0, log_one_plus(-sine_squared), is_narrow);
    let bend = m * ((m - 1.0) * sine_squared / (1.0 - sine_squared) - 1.0);
    let narrow = angles.narrow * max(1.0 + square * bend / 24.0, 0.0);
    let sum = select(between / max(lit.d, 1e-37), narrow, is_narrow);
    return select(0.0, exp(0.5 * m * log_value) * max(sum, 0.0), lit.length > 0.0);
}

// ∫ cosᵐφ dφ from 0 to the angle of this sine and cosine, by the cubics of the lobe's table.
fn cosine_integral(lobe_index: u32, angle: vec2f) -> f32 {
    let near = 1.0 + max(angle.y, 0.0);
    let u = abs(angle.x) / (near + sqrt(2.0 * max(angle.y, 0.0) * near));
    let t = min(u * lobes[lobe_index].cosine_cells, 63.99999);
    let i = u32(t);
    let c = lobes[lobe_index].cosine_integral[i];
    let x = t - f32(i);
    let value = c.x + x * (c.y + x * (c.z + x * c.w));
    return select(value, -value, angle.x < 0.0);
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
    let peak = clamp(line.d * lobe.along / max(lobe.toward, 1e-30), part.a, part.b);
    var before = part;
    before.b = peak;
    before.length = select(peak - part.a, part.length, peak == part.b);
    var after = part;
    after.a = peak;
    after.length = select(part.b - peak, part.length, peak == part.a);
    return exp(0.5 * m * lobe.log_square)
        * (line_cosine_power(before, lobe, m, falloff) + line_cosine_power(after, lobe, m, falloff));
}

// The part within an angle, of tangent `t`, of the lobe's projection.
fn line_within(line: LineFrame, lobe: LineLobe, t: f32) -> LineFrame {
    if line.d == 0.0 {
        return line;
    }
    let low = lobe.toward + t * lobe.along;
    let high = lobe.toward - t * lobe.along;
    var part = line;
    if low > 0.0 {
        part.a = max(line.a, line.d * (lobe.along - t * lobe.toward) / low);
    } else if lobe.along > 0.0 {
        part.length = 0.0;
    }
    if high > 0.0 {
        part.b = min(line.b, line.d * (lobe.along + t * lobe.toward) / high);
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
            let sine = (lobe.toward * (up - down) - lobe.along * line.d) / r;
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

// How many fours of coefficients a fit has: those of the usual degrees, up to 7, and of any.
const SHORT_FIT = 2u;
const LONG_FIT = 4u;

// `line_phong_plain` with cosᵐφ replaced by the lobe's Chebyshev fit. A line that is seen under less than a thousandth of
// the lobe's width fades to the lobe's value in the middle.
fn line_chebyshev_plain(line: LineFrame, r: vec3f, lobe_index: u32, quads: u32) -> f32 {
    let lit = line_above(line, r);
    let m = lobes[lobe_index].exponent;
    let lobe = line_lobe(lit, r);
    let angles = line_angles(lit, lobe);
    let inverse_cut = 1.0 / lobes[lobe_index].chebyshev_cut;
    let t_a = arctangent(angles.a.x, angles.a.y) * inverse_cut;
    let t_b = arctangent(angles.b.x, angles.b.y) * inverse_cut;
    let between = chebyshev_integral(lobe_index, quads, t_b) - chebyshev_integral(lobe_index, quads, t_a);
    let middle = line_middle(angles.a, angles.b);
    let peak = exp(0.5 * m * log_one_plus(-min(middle.x * middle.x, 0.9999999)));
    // Gauss–Legendre with 2 nodes, where the difference of the integrals would cancel.
    let width = angles.sine * inverse_cut;
    let t = 0.5 * (t_a + t_b);
    let node = 0.28867513459481288225 * width;
    let value = max(0.5 * (chebyshev_value(lobe_index, quads, t - node) + chebyshev_value(lobe_index, quads, t + node)), 0.0);
    let narrow = angles.narrow * mix(peak, value, min(1e3 * width, 1.0));
    let is_whole = max(abs(t_a), abs(t_b)) < 1.0 || width < 1e-3;
    let is_narrow = angles.is_below_right_angle && width < 0.02 && is_whole;
    let sum = select(between / max(lit.d, 1e-37), narrow, is_narrow);
    return select(0.0, exp(0.5 * m * lobe.log_square) * max(sum, 0.0), lit.length > 0.0);
}

// `line_phong_of` with cosᵐφ replaced by the lobe's Chebyshev fit.
fn line_chebyshev_of(line: LineFrame, r: vec3f, falloff: f32, lobe_index: u32) -> f32 {
    let lit = line_above(line, r);
    if lit.length <= 0.0 {
        return 0.0;
    }
    let lobe = line_lobe(lit, r);
    let angles = line_angles(lit, lobe);
    let trust = select(1.0, min(1e3 * angles.sine / lobes[lobe_index].chebyshev_cut, 1.0), angles.is_below_right_angle);
    var sum = 0.0;
    if trust > 0.0 {
        sum += trust * line_chebyshev_sum(lit, lobe, falloff, lobe_index);
    }
    if trust < 1.0 {
        let middle = line_middle(angles.a, angles.b);
        let m = lobes[lobe_index].exponent;
        let peak = exp(0.5 * m * log_one_plus(-min(middle.x * middle.x, 0.9999999)));
        sum += (1.0 - trust) * peak * line_cosine_power(lit, lobe, 0.0, falloff);
    }
    return max(exp(0.5 * lobes[lobe_index].exponent * lobe.log_square) * sum, 0.0);
}

// The fit's integral from 0 to t·cut.
fn chebyshev_integral(lobe_index: u32, quads: u32, t: f32) -> f32 {
    let x = 2.0 * min(abs(t), 1.0) - 1.0;
    var sum = 0.0;
    for (var i = quads; i > 0u; i--) {
        let c = lobes[lobe_index].chebyshev_mean[i - 1u];
        sum = (((sum * x + c.w) * x + c.z) * x + c.y) * x + c.x;
    }
    return sum * clamp(t, -1.0, 1.0) * lobes[lobe_index].chebyshev_cut;
}

// The fit at t·cut: the mean, and its slope times what it is the mean over.
fn chebyshev_value(lobe_index: u32, quads: u32, t: f32) -> f32 {
    let x = 2.0 * abs(t) - 1.0;
    var mean = 0.0;
    var slope = 0.0;
    for (var i = quads; i > 0u; i--) {
        let c = lobes[lobe_index].chebyshev_mean[i - 1u];
        slope = slope * x + mean;
        mean = mean * x + c.w;
        slope = slope * x + mean;
        mean = mean * x + c.z;
        slope = slope * x + mean;
        mean = mean * x + c.y;
        slope = slope * x + mean;
        mean = mean * x + c.x;
    }
    return select(mean + (x + 1.0) * slope, 0.0, x > 1.0);
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
    let inverse_cut = 1.0 / lobes[lobe_index].chebyshev_cut;
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * LINE_HALF_NODES; i++) {
            let node = LINE_NODES[i >> 1u];
            let growth = exp(half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u)));
            let up = path.alpha * growth;
            let down = path.beta / growth;
            let s = up - down;
            let phi = arctangent(lobe.toward * s - lobe.along * line.d, lobe.toward * line.d + lobe.along * s);
            sum += node.y * chebyshev_value(lobe_index, LONG_FIT, phi * inverse_cut) * line_attenuation(up + down, falloff);
        }
    }
    return half * sum;
}

// The light's `intensity` at its point of least angle to r.
fn line_nearest_point_of(line: LineFrame, r: vec3f, lobe: u32, falloff: f32, intensity: f32) -> f32 {
    let nearest = line_nearest_of(line, r);
    let specular = falloff_response(nearest, intensity, falloff, nearest, r, lobe).specular;
    return select(0.0, specular, line.length > 0.0);
}

// The point of least angle to r ([PICOTT_1992], eq. 7), where it is a maximum between the ends.
fn line_nearest_of(line: LineFrame, r: vec3f) -> vec3f {
    let base = dot(r, line.foot);
    let slope = dot(r, line.axis);
    let ends = line_ends(line);
    let at_a = (base + line.a * slope) * ends.r_b;
    let at_b = (base + line.b * slope) * ends.r_a;
    // Of ends that look the same, as those of a line seen end on, the nearer.
    let same = abs(at_a - at_b) <= 1e-6 * abs(at_a);
    let a_is_best = select(at_a > at_b, ends.r_a <= ends.r_b, same);
    let best = slope * line.d * line.d / max(base, 1e-37);
    let is_between = base > 0.0 && line.a < best && best < line.b;
    let s = select(select(line.b, line.a, a_is_best), best, is_between);
    return line.foot + s * line.axis;
}

// What a tube emits towards p from there, for 1 of an isotropic line.
fn line_emission(line: LineFrame, r: vec3f, diameter: f32) -> f32 {
    if diameter == 0.0 {
        return 1.0;
    }
    let nearest = line_nearest_of(line, r);
    return diameter * line.d / max(length_of(nearest), 1e-37);
}
