// A polygonal light of unit luminance. Its corners are `vertices[0 .. count]`, counter-clockwise seen from the lit side.
//
// Whatever is rarely wanted stands in a loop of its own that then ends at once: some drivers run both sides of every
// branch.

struct PolygonLight {
    normal: vec3f,
    count: u32,
    two_sided: u32,
}

@group(1) @binding(0) var<uniform> polygon_light: PolygonLight;

fn polygon_respond_exact(at: Shading) -> Response {
    let corners = Corners(0u, polygon_light.count, at.p, polygon_light.normal);
    if !polygon_shines_on(corners) {
        return Response(0.0, 0.0);
    }
    return polygon_exact(corners, at.n, at.r, lobes[at.lobe].exponent);
}

fn polygon_respond_nearest_point(at: Shading) -> Response {
    let corners = Corners(0u, polygon_light.count, at.p, polygon_light.normal);
    if !polygon_shines_on(corners) {
        return Response(0.0, 0.0);
    }
    let cosine = polygon_least_angle_cosine(corners, at.n, at.r);
    return Response(polygon_irradiance(corners, at.n), power(cosine, lobes[at.lobe].exponent));
}

fn polygon_respond_nearest_point_picott(at: Shading) -> Response {
    let corners = Corners(0u, polygon_light.count, at.p, polygon_light.normal);
    if !polygon_shines_on(corners) {
        return Response(0.0, 0.0);
    }
    let cosine = polygon_projected_edge_cosine(corners, at.n, at.r);
    return Response(polygon_irradiance(corners, at.n), power(cosine, lobes[at.lobe].exponent));
}

// Whether p is on a lit side, and not within rounding of the light's own plane.
fn polygon_shines_on(corners: Corners) -> bool {
    let to_corner = corner(corners, 0u);
    let height = -dot(polygon_light.normal, to_corner);
    let rounding = 1e-6 * length(to_corner);
    return height > rounding || (polygon_light.two_sided != 0u && height < -rounding);
}

fn polygon_irradiance(corners: Corners, n: vec3f) -> f32 {
    var walk = walk_around(corners, n, vec3f());
    var contour = Contour();
    while walks_on(walk) {
        add_arc(&contour, next_arc(&walk, false));
    }
    var irradiance = 0.5 * abs(dot(contour.vector, n));
    while walk.passes_near {
        walk = walk_around(corners, n, vec3f());
        contour = Contour();
        while walks_on(walk) {
            add_arc(&contour, next_arc(&walk, true));
        }
        irradiance = 0.5 * abs(dot(contour.vector, n));
        walk.passes_near = false;
    }
    var thin = is_thin(contour, 1.0);
    while thin {
        irradiance = thin_integral(corners, n, n, 1.0, irradiance);
        thin = false;
    }
    return irradiance;
}

fn polygon_phong(corners: Corners, n: vec3f, r: vec3f, m: f32) -> f32 {
    return polygon_exact(corners, n, r, m).specular;
}

// Whether a contour's integrals cancel, given its vector area, perimeter and the lobe: where its width times m + 1 is
// small beside what f32 leaves of terms as large as its length.
fn is_thin(contour: Contour, m: f32) -> bool {
    return (m + 1.0) * length(contour.vector) < 0.13 * sqrt(m) * contour.perimeter;
}

// Beyond it the series has lost digits that quadrature keeps.
const SERIES_LIMIT = 64.0;

fn polygon_exact(corners: Corners, n: vec3f, r: vec3f, m: f32) -> Response {
    let in_series = m <= SERIES_LIMIT && floor(m) == m;
    // z^(m+1) < e⁻¹⁶ below this.
    let cut = exp(-16.0 / (m + 1.0));
    let last = select(0.0, m - 1.0, in_series);
    var walk = walk_around(corners, n, vec3f());
    var contour = Contour();
    var sum = 0.0;
    var is_lit = false;
    while walks_on(walk) {
        let arc = next_arc(&walk, false);
        add_arc(&contour, arc);
        sum += arc_series(arc, r, last, cut);
        is_lit = is_lit || (arc.sine > 0.0 && max(dot(r, arc.begin), dot(r, arc.to)) > 0.0);
    }
    var again = !in_series || walk.passes_near;
    while again {
        walk = walk_around(corners, n, vec3f());
        contour = Contour();
        sum = 0.0;
        while walks_on(walk) {
            let arc = next_arc(&walk, true);
            add_arc(&contour, arc);
            sum += arc_quadrature(arc, r, m, cut);
        }
        again = false;
    }
    var response = Response(0.5 * abs(dot(contour.vector, n)), select(0.0, folded(sum, corners, r), is_lit));
    let last_thin = select(1u, 2u, is_thin(contour, 1.0));
    for (var lobe = select(1u, 0u, is_thin(contour, m)); lobe < last_thin; lobe++) {
        let diffuse = lobe == 1u;
        let before = select(response.specular / lobe_normalization(m), response.irradiance, diffuse);
        let value = thin_integral(corners, n, select(r, n, diffuse), select(m, 1.0, diffuse), before);
        if diffuse {
            response.irradiance = value;
        } else {
            response.specular = lobe_normalization(m) * value;
        }
    }
    return response;
}

// The share of the lobe from ∫ (1 − z^(m+1)) dψ: about an axis behind the light, ψ turns once more when −r is inside.
fn folded(sum: f32, corners: Corners, r: vec3f) -> f32 {
    let turn = abs(sum) / (2.0 * PI);
    let ahead = dot(corners.normal, corner(corners, 0u)) * dot(corners.normal, r) > 0.0;
    return select(turn, 1.0 - turn, !ahead && turn > 0.5);
}

// What an arc has above the lobe's horizon, about its middle.
struct Core {
    exists: bool,
    // Unit vectors in the arc's plane, to its middle and along it there.
    middle: vec3f,
    along: vec3f,
    // z there.
    z: f32,
    z_along: f32,
    // Of half the angle.
    half_sine: f32,
    half_cosine: f32,
    sine: f32,
    cosine: f32,
    // Whether it begins and ends with the arc, and its ends.
    starts: bool,
    ends: bool,
    begin: vec3f,
    to: vec3f,
}

fn core_of(arc: Arc, r: vec3f, whole: bool) -> Core {
    let z_from = dot(r, arc.begin);
    let z_to = dot(r, arc.to);
    let rises = !whole && z_from < 0.0 && z_to > 0.0;
    let sets = !whole && z_from > 0.0 && z_to < 0.0;
    let crossing = direction_of(cross(r, arc.normal));
    let begin = select(arc.begin, crossing, rises);
    let to = select(arc.to, -crossing, sets);
    let cosine = dot(begin, to);
    let sine = select(arc.sine, max(dot(arc.normal, cross(begin, to)), 0.0), rises || sets);
    let both = begin + to;
    let chord = to - begin;
    let is_wide = cosine < 0.0;
    let middle = select(direction_of(both), cross(direction_of(chord), arc.normal), is_wide);
    let half_cosine = 0.5 * length(both);
    let half_sine = select(0.5 * sine / max(half_cosine, 0.5), 0.5 * length(chord), is_wide);
    let along = cross(arc.normal, middle);
    let exists = arc.sine > 0.0 && (whole || z_from > 0.0 || z_to > 0.0);
    return Core(exists, middle, along, dot(r, middle), dot(r, along), half_sine, half_cosine, sine, cosine,
        !rises, !sets, begin, to);
}

// The greatest z of a core.
fn greatest_z(core: Core) -> f32 {
    let inside = abs(core.z_along) * core.half_cosine < core.z * core.half_sine;
    let ends = core.z * core.half_cosine + abs(core.z_along) * core.half_sine;
    return select(ends, sqrt(core.z * core.z + core.z_along * core.z_along), inside);
}

// u·v without their parts along the unit axis.
fn dot_across(axis: vec3f, u: vec3f, v: vec3f) -> f32 {
    return dot(cross(axis, u), cross(axis, v));
}

// ∫ (1 − z^(m+1)) dψ along an arc for integer m = `last` + 1, z = 0 below the lobe's horizon.
//
// γ(s₀ + s₂ + … + s₍ₘ₋₁₎) for odd m, Ω + γ(s₁ + s₃ + … + s₍ₘ₋₁₎) for even m, Ω the solid angle of the arc and r, and
// k sₖ = [−z′ z^(k−1)] + (k − 1) ρ² sₖ₋₂: from the last term down, as polynomials in z² at the ends, in differences.
fn arc_series(arc: Arc, r: vec3f, last: f32, cut: f32) -> f32 {
    let core = core_of(arc, r, false);
    let gamma = dot(r, arc.normal);
    let counts = core.exists && greatest_z(core) > cut;
    let is_even = last - 2.0 * floor(0.5 * last) > 0.5;
    let z_from = core.z * core.half_cosine - core.z_along * core.half_sine;
    let z_to = core.z * core.half_cosine + core.z_along * core.half_sine;
    let slope_from = core.z * core.half_sine + core.z_along * core.half_cosine;
    let rise = 2.0 * core.z_along * core.half_sine;
    let square_from = z_from * z_from;
    let square_to = z_to * z_to;
    let rho_square = core.z * core.z + core.z_along * core.z_along;
    var weight = 1.0;
    var value = 0.0;
    var difference = 0.0;
    for (var k = select(0.0, last, counts); k > 1.5; k -= 2.0) {
        let term = weight / k;
        difference = difference * square_from + value;
        value = value * square_to + term;
        weight = 1.0 + rho_square * (weight - term);
    }
    let core_angle = arctangent(core.sine, core.cosine);
    let product = (core.z * core.z - core.z_along * core.z_along) * core.sine;
    let first = select(core_angle, 2.0 * core.z * core.half_sine, is_even);
    let ends = select(product, product * z_to - slope_from * z_from * rise, is_even);
    let start = slope_from * select(z_from, square_from, is_even);
    let sum = weight * first + ends * value - start * rise * (z_from + z_to) * difference;
    let solid = 2.0 * arctangent(gamma * core.sine, 1.0 + z_from + z_to + core.cosine);
    let inside = select(0.0, gamma * sum + select(0.0, solid, is_even), counts);

    // The rest of the arc.
    let begin = select(arc.begin, core.to, counts && core.starts);
    let to = select(arc.to, core.begin, counts && !core.starts);
    let whole = counts && core.starts && core.ends;
    let sine = select(arc.sine, max(dot(arc.normal, cross(begin, to)), 0.0), counts);
    return inside + select(arctangent(gamma * sine, dot_across(r, begin, to)), 0.0, whole || arc.sine <= 0.0);
}

// ∫ (1 − z^(m+1)) dψ along an arc for real m: by quadrature where z^(m+1) counts.
fn arc_quadrature(arc: Arc, r: vec3f, m: f32, cut: f32) -> f32 {
    let core = core_of(arc, r, false);
    let gamma = dot(r, arc.normal);
    let window = window_of(core, cut);
    let counts = window.begin < window.to;
    // Positions across r at the middle and along the arc there.
    let x = direction_of(select(vec3f(0.0, -r.z, r.y), vec3f(-r.y, r.x, 0.0), abs(r.z) < 0.7));
    let y = cross(r, x);
    let middle = vec2f(dot(x, core.middle), dot(y, core.middle));
    let along = vec2f(dot(x, core.along), dot(y, core.along));
    let width = window.to - window.begin;
    // More of them for the branch point that a low broken power has at the horizon.
    let more = select(0.0, 3.0, m < 8.0 && floor(m) != m);
    let panels = clamp(ceil(width * sqrt(m + 1.0) / 2.0), 1.0, 4.0) + more;
    let half = 0.5 * width / panels;
    let h = 0.5 * (m + 1.0);
    var sum = 0.0;
    for (var i = select(panels, 0.0, counts); i < panels; i += 1.0) {
        let center = window.begin + (2.0 * i + 1.0) * half;
        let densities = arc_density(middle, along, h, center - half * GAUSS_8)
            + arc_density(middle, along, h, center + half * GAUSS_8);
        sum += dot(WEIGHTS_8, densities);
    }
    // The rest of the arc, on both sides.
    let begin = select(arc.to, at_half_tangent(core, window.begin), counts);
    let to = select(arc.to, at_half_tangent(core, window.to), counts);
    let from_sine = select(arc.sine, max(dot(arc.normal, cross(arc.begin, begin)), 0.0), counts);
    let to_sine = select(0.0, max(dot(arc.normal, cross(to, arc.to)), 0.0), counts);
    let before = vec2f(dot_across(r, arc.begin, begin), gamma * from_sine);
    let after = vec2f(dot_across(r, to, arc.to), gamma * to_sine);
    let starts = counts && core.starts && window.starts;
    let ends = !counts || (core.ends && window.ends);
    let first = select(before, vec2f(1.0, 0.0), starts);
    let second = select(after, vec2f(1.0, 0.0), ends);
    let rest = arctangent(first.x * second.y + first.y * second.x, first.x * second.x - first.y * second.y);
    return select(0.0, gamma * half * sum + rest, arc.sine > 0.0);
}

// Where z^(m+1) counts, in tan(φ/2), φ the angle from a core's middle.
struct Window {
    begin: f32,
    to: f32,
    starts: bool,
    ends: bool,
}

fn window_of(core: Core, cut: f32) -> Window {
    let rho = max(sqrt(core.z * core.z + core.z_along * core.z_along), 1e-20);
    let peak = vec2f(core.z, core.z_along) / rho;
    let cosine = min(cut / rho, 1.0);
    let sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    let end = core.half_sine / (1.0 + core.half_cosine);
    let to = (peak.y * cosine + peak.x * sine) / max(1.0 + peak.x * cosine - peak.y * sine, 1e-20);
    let begin = (peak.y * cosine - peak.x * sine) / max(1.0 + peak.x * cosine + peak.y * sine, 1e-20);
    let counts = core.exists && cosine < 1.0;
    let all = cut <= 0.0;
    let window = Window(select(end, max(begin, -end), counts), select(end, min(to, end), counts), begin <= -end, to >= end);
    if all {
        return Window(-end, end, true, true);
    }
    return window;
}

fn at_half_tangent(core: Core, t: f32) -> vec3f {
    let scale = 1.0 / (1.0 + t * t);
    return (1.0 - t * t) * scale * core.middle + 2.0 * t * scale * core.along;
}

// Positive nodes of the 8-point Gauss–Legendre rule, and their weights.
const GAUSS_8 = vec4f(0.18343464249564980, 0.52553240991632899, 0.79666647741362674, 0.96028985649753623);
const WEIGHTS_8 = vec4f(0.36268378337836198, 0.31370664587788729, 0.22238103445337447, 0.10122853629037626);

// The 4-point Gauss–Legendre rule.
const GAUSS_4 = vec4f(-0.86113631159405258, -0.33998104358485626, 0.33998104358485626, 0.86113631159405258);
const WEIGHTS_4 = vec4f(0.34785484513745386, 0.65214515486254614, 0.65214515486254614, 0.34785484513745386);

// (1 − z^(2h))/(1 − z²) dφ/dt at four t = tan(φ/2).
fn arc_density(middle: vec2f, along: vec2f, h: f32, t: vec4f) -> vec4f {
    let scale = 1.0 / (1.0 + t * t);
    let c = (1.0 - t * t) * scale;
    let s = 2.0 * t * scale;
    let x = c * middle.x + s * along.x;
    let y = c * middle.y + s * along.y;
    let off_axis = min(x * x + y * y, vec4f(1.0));
    let mean = log_over(off_axis);
    let e = h * off_axis * mean;
    let series = 1.0 - e * (0.5 - e * (1.0 / 6.0 - e * (1.0 / 24.0 - e * (1.0 / 120.0))));
    let small = e < vec4f(0.2);
    let rise = select((1.0 - exp(-e)) / max(e, vec4f(0.1)), series, small);
    return 2.0 * scale * h * mean * rise;
}

// −ln(1 − x)/x for 0 ≤ x ≤ 1, cut at 1 − 1e-18 where the lobe is nothing.
//
// Below 1/2 the logarithm would lose the digits of small x.
fn log_over(x: vec4f) -> vec4f {
    let far = -log(max(1.0 - x, vec4f(1e-18))) / max(x, vec4f(0.25));
    return select(far, log_over_half(x), x < vec4f(0.5));
}

// The same for x ≤ 1/2, from 2 artanh(x/(2 − x)).
fn log_over_half(x: vec4f) -> vec4f {
    let t = x / (2.0 - x);
    let s = t * t;
    let tail = 1.0 / 9.0 + s * (1.0 / 11.0 + s * (1.0 / 13.0));
    return 2.0 * (1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * tail)))) / (2.0 - x);
}

// ∫ (ω·r)ᵐ dω over a polygon that is narrow beside the lobe's width: the integral across it from a great circle along
// it, by two nodes, is summed along its edges, so that nothing cancels. `otherwise` where it is not narrow.
fn thin_integral(corners: Corners, n: vec3f, r: vec3f, m: f32, otherwise: f32) -> f32 {
    let apex = direction_of(corner(corners, 0u));
    var base = vec3f();
    var whole = Contour();
    for (var i = 0u; i < corners.count; i++) {
        let a = direction_of(corner(corners, i));
        let b = direction_of(corner(corners, i + 1u));
        let edge = cross(a, b - a);
        let sine = length(edge);
        let angle = arctangent(sine, dot(a, b));
        let across = cross(apex, a - apex);
        base = select(base, across, dot(across, across) > dot(base, base));
        whole.vector += angle / max(sine, 1e-20) * edge;
        whole.perimeter += angle;
    }
    base = direction_of(base);
    var widest = 0.0;
    for (var i = 0u; i < corners.count; i++) {
        widest = max(widest, abs(dot(base, direction_of(corner(corners, i)))));
    }
    let x = direction_of(select(vec3f(0.0, -r.z, r.y), vec3f(-r.y, r.x, 0.0), abs(r.z) < 0.7));
    let y = cross(r, x);
    let pole = vec3f(dot(x, base), dot(y, base), dot(r, base));
    let cut = exp(-16.0 / m) - widest;
    var walk = walk_around(corners, n, base);
    // More of them for the branch point that a low broken power has at the horizon.
    let more = select(0.0, 6.0, m < 8.0 && floor(m) != m);
    let is_surface = all(n == r);
    var is_narrow = true;
    var lit = Closing();
    var sum = 0.0;
    while walks_on(walk) || lit.closes {
        var arc: Arc;
        if lit.closes {
            lit.closes = false;
            arc = closing_arc(lit, r, walk.ahead);
        } else {
            arc = next_arc(&walk, true);
            if !is_surface {
                arc = lit_part(arc, r, &lit);
            }
        }
        let core = core_of(arc, r, cut <= 0.0);
        let window = window_of(core, cut);
        let middle = vec3f(dot(x, core.middle), dot(y, core.middle), core.z);
        let along = vec3f(dot(x, core.along), dot(y, core.along), core.z_along);
        let width = window.to - window.begin;
        let panels = clamp(ceil(1.4 * width * sqrt(m + 1.0)), 1.0, 12.0) + more;
        let half = 0.5 * width / panels;
        let latitudes = latitudes_of(arc, core);
        var part = 0.0;
        for (var i = select(panels, 0.0, arc.sine > 0.0 && window.begin < window.to); i < panels; i += 1.0) {
            let center = window.begin + (2.0 * i + 1.0) * half;
            part += dot(WEIGHTS_4, thin_density(middle, along, pole, latitudes, m, center + half * GAUSS_4));
        }
        sum += dot(base, arc.normal) * half * part;
        is_narrow = is_narrow && (core.half_cosine > 0.05 || arc.sine <= 0.0);
    }
    return select(otherwise, abs(sum), is_narrow && widest * sqrt(m) < 0.5 && (m + 1.0) * length(whole.vector) < 0.3 * sqrt(m) * whole.perimeter);
}

// sin λ = x cos φ + y sin φ along an arc, φ from its core's middle.
fn latitudes_of(arc: Arc, core: Core) -> vec2f {
    let whole = core.starts && core.ends;
    let sum = 0.5 * (arc.latitude_from + arc.latitude_to) / max(core.half_cosine, 1e-6);
    let difference = 0.5 * (arc.latitude_to - arc.latitude_from) / max(core.half_sine, 1e-20);
    // From the arc's ends where the core is a part of it.
    let begin = vec2f(dot(core.middle, arc.begin), dot(core.along, arc.begin));
    let to = vec2f(dot(core.middle, arc.to), dot(core.along, arc.to));
    let determinant = max(arc.sine, 1e-20);
    let part = vec2f(
        arc.latitude_from * to.y - arc.latitude_to * begin.y,
        arc.latitude_to * begin.x - arc.latitude_from * to.x,
    ) / determinant;
    return select(part, vec2f(sum, difference), whole);
}

// ∫ (ω·r)ᵐ d(sin λ′) from 0 to λ, dβ/dφ and dφ/dt at four t = tan(φ/2).
fn thin_density(middle: vec3f, along: vec3f, pole: vec3f, latitudes: vec2f, m: f32, t: vec4f) -> vec4f {
    let scale = 1.0 / (1.0 + t * t);
    let c = (1.0 - t * t) * scale;
    let s = 2.0 * t * scale;
    let x = c * middle.x + s * along.x;
    let y = c * middle.y + s * along.y;
    let z = c * middle.z + s * along.z;
    let sine = c * latitudes.x + s * latitudes.y;
    let cosine_square = 1.0 - sine * sine;
    // Where z nears 0, zᵐ dx is integrated over z, with dx/dz linear in between: |z|^(m+1) knows its kink.
    let cosine = sqrt(cosine_square);
    let bottom = (z - sine * pole.z) / cosine;
    let rise = z - bottom;
    let kinks = (min(abs(z), abs(bottom)) < abs(rise)) & vec4<bool>(floor(m) != m);
    let top_power = exp((m + 1.0) * log(max(abs(z), vec4f(1e-30))));
    let bottom_power = exp((m + 1.0) * log(max(abs(bottom), vec4f(1e-30))));
    let slope_bottom = 1.0 / select(1.0, pole.z, pole.z != 0.0);
    let slope_top = 1.0 / select(vec4f(1.0), pole.z - bottom * sine / cosine, kinks);
    let bend = (slope_top - slope_bottom) / select(vec4f(1.0), rise, kinks);
    let is_straight = abs(slope_top - slope_bottom) < 0.5 * vec4f(abs(slope_bottom));
    let across_kink = (slope_bottom - bend * bottom) * (top_power - bottom_power) / (m + 1.0)
        + bend * (z * top_power - bottom * bottom_power) / (m + 2.0);
    let is_even = m == 2.0 * floor(0.5 * m);
    var mean = vec4f();
    for (var node = 0u; node < 2u; node++) {
        let place = select(0.21132486540518713, 0.78867513459481287, node == 1u) * sine;
        let stretch = sqrt((1.0 - place * place) / cosine_square);
        let shift = place - stretch * sine;
        let off_x = stretch * x + shift * pole.x;
        let off_y = stretch * y + shift * pole.y;
        let toward = stretch * z + shift * pole.z;
        // Near the axis the sine knows more than the cosine.
        let off_axis = min(off_x * off_x + off_y * off_y, vec4f(0.5));
        let far = log(max(abs(toward), vec4f(1e-30)));
        let logarithm = select(-0.5 * off_axis * log_over_half(off_axis), far, abs(toward) < vec4f(0.75));
        let power = exp(m * logarithm);
        mean += 0.5 * select(power, sign(toward) * power, vec4<bool>(!is_even));
    }
    return 2.0 * scale / cosine_square * select(sine * mean, across_kink, kinks & is_straight);
}

// cos α of the polygon's point above the surface that makes the least angle α with r; 0 where α ≥ 90°.
fn polygon_least_angle_cosine(corners: Corners, n: vec3f, r: vec3f) -> f32 {
    var walk = walk_around(corners, n, vec3f());
    var best = 0.0;
    while walks_on(walk) {
        let arc = next_arc(&walk, true);
        let core = core_of(arc, r, false);
        best = max(best, select(0.0, greatest_z(core), core.exists && !arc.closes));
    }
    return select(min(best, 1.0), 1.0, is_met(corners, r) && dot(n, r) > 0.0);
}

// Whether the ray from p along r meets the polygon.
fn is_met(corners: Corners, r: vec3f) -> bool {
    var turn = 0.0;
    for (var i = 0u; i < corners.count; i++) {
        let a = corner(corners, i);
        let b = corner(corners, i + 1u);
        turn += arctangent(dot(r, cross(a, b - a)), dot_across(r, a, b));
    }
    let in_front = dot(corners.normal, corner(corners, 0u)) * dot(corners.normal, r) > 0.0;
    return in_front && abs(turn) > PI;
}

// cos α of the point that Picott takes for the one of least angle α with r; 0 where he takes none.
fn polygon_projected_edge_cosine(corners: Corners, n: vec3f, r: vec3f) -> f32 {
    let height = dot(corners.normal, corner(corners, 0u));
    if height * dot(corners.normal, r) <= 0.0 {
        return 0.0;
    }
    // Perpendicular to the plane through p that holds r and its projection.
    let across = cross(corners.normal, r);
    var best = 0.0;
    for (var i = 0u; i < corners.count; i++) {
        let a = corner(corners, i);
        let side = corner(corners, i + 1u) - a;
        let run = dot(across, side);
        let share = select(clamp(-dot(across, a) / run, 0.0, 1.0), 0.0, run == 0.0);
        let x = a + share * side;
        let is_outside = height * dot(r, cross(a, side)) < 0.0;
        best = max(best, select(0.0, cosine_to(r, x), is_outside && dot(n, x) >= 0.0));
    }
    return select(min(best, 1.0), select(0.0, 1.0, dot(n, r) > 0.0), is_met(corners, r));
}

// The cosine of x to the unit r, from the sine where that is small.
fn cosine_to(r: vec3f, x: vec3f) -> f32 {
    let square = max(dot(x, x), 1e-37);
    let across = cross(r, x);
    let off_axis = dot(across, across) / square;
    let cosine = dot(r, x) * inverseSqrt(square);
    return select(cosine, sqrt(max(1.0 - off_axis, 0.0)), cosine > 0.0 && off_axis < 0.5);
}
