// A polygonal light of unit luminance. Its corners are `vertices[0 .. count]`, counter-clockwise seen from the lit side.
//
// Edges stream through the clips one by one, with no list of clipped vertices, as in `shading::polygon`: a crossing adds
// the piece of the horizon between it and the first crossing, and what is covered twice cancels.

struct PolygonLight {
    normal: vec3f,
    count: u32,
    two_sided: u32,
}

@group(1) @binding(0) var<uniform> polygon_light: PolygonLight;

// A run of `vertices`, seen from p.
struct Corners {
    first: u32,
    count: u32,
    p: vec3f,
}

fn polygon_respond_exact(at: Shading) -> Response {
    let corners = Corners(0u, polygon_light.count, at.p);
    if !polygon_shines_on(corners) {
        return Response(0.0, 0.0);
    }
    let specular = polygon_phong(corners, at.n, at.r, lobes[at.lobe].exponent);
    return Response(polygon_irradiance(corners, at.n), specular);
}

fn polygon_respond_nearest_point(at: Shading) -> Response {
    let corners = Corners(0u, polygon_light.count, at.p);
    if !polygon_shines_on(corners) {
        return Response(0.0, 0.0);
    }
    let cosine = polygon_least_angle_cosine(corners, polygon_light.normal, at.n, at.r);
    return Response(polygon_irradiance(corners, at.n), power(cosine, lobes[at.lobe].exponent));
}

// Whether p is on a lit side, and not within rounding of the light's own plane.
fn polygon_shines_on(corners: Corners) -> bool {
    let to_corner = corner(corners, 0u);
    let height = -dot(polygon_light.normal, to_corner);
    let rounding = 1e-6 * length(to_corner);
    return height > rounding || (polygon_light.two_sided != 0u && height < -rounding);
}

// Corner i about p; the first again after the last.
fn corner(corners: Corners, i: u32) -> vec3f {
    return vertices[corners.first + select(i, 0u, i == corners.count)].xyz - corners.p;
}

struct Edge {
    a: vec3f,
    b: vec3f,
    exists: bool,
    // Unit normal of its plane through p, but for the sign.
    normal: vec3f,
}

const NO_EDGE = Edge(vec3f(), vec3f(), false, vec3f());

// The edge from corner i.
fn polygon_edge(corners: Corners, i: u32) -> Edge {
    let a = corner(corners, i);
    let b = corner(corners, i + 1u);
    let across = cross(a, b - a);
    let sine = length(across);
    return Edge(a, b, sine > 0.0, across / max(sine, 1e-37));
}

// A clip to the horizon of n, and where edges first crossed it.
struct HorizonClip {
    n: vec3f,
    crossing: vec3f,
    crossed: bool,
}

// An edge above a horizon, and along it.
struct Clipped {
    above: Edge,
    along: Edge,
}

fn clip_edge(clip: ptr<function, HorizonClip>, edge: Edge) -> Clipped {
    let above_a = dot((*clip).n, edge.a);
    let above_b = dot((*clip).n, edge.b);
    if !edge.exists || (above_a < 0.0 && above_b < 0.0) {
        return Clipped(NO_EDGE, NO_EDGE);
    }
    if above_a >= 0.0 && above_b >= 0.0 {
        return Clipped(edge, NO_EDGE);
    }
    let side = edge.b - edge.a;
    var x = edge.a + above_a / (above_a - above_b) * side;
    // Next to p the direction of the crossing is what matters; an edge along the horizon has none.
    let direction = cross((*clip).n, edge.normal);
    let square = dot(direction, direction);
    if square > 1e-10 && dot(x, x) < 1e-2 * dot(side, side) {
        x = direction * (dot(direction, x) / square);
    }
    if !(*clip).crossed {
        (*clip).crossing = x;
        (*clip).crossed = true;
    }
    if above_a >= 0.0 {
        return Clipped(Edge(edge.a, x, true, edge.normal), Edge(x, (*clip).crossing, true, (*clip).n));
    }
    return Clipped(Edge(x, edge.b, true, edge.normal), Edge((*clip).crossing, x, true, (*clip).n));
}

// A sum along edges, and the sum of its terms' sizes.
struct EdgeSum {
    value: f32,
    size: f32,
}

fn add_term(sum: ptr<function, EdgeSum>, term: f32) {
    (*sum).value += term;
    (*sum).size += abs(term);
}

// Whether rounding matters both beside the value and beside `weight` times the light's solid angle.
fn sum_cancels(sum: EdgeSum, corners: Corners, weight: f32) -> bool {
    let noise = 2e-7 * sum.size;
    return noise > 3e-5 * abs(sum.value) && noise > 5e-7 * min(weight * polygon_solid_angle(corners), 2.0 * PI);
}

fn polygon_solid_angle(corners: Corners) -> f32 {
    let apex = corner(corners, 0u);
    var sum = 0.0;
    for (var i = 1u; i + 1u < corners.count; i++) {
        let v = corner(corners, i);
        let w = corner(corners, i + 1u);
        let lengths = vec3f(length(apex), length(v), length(w));
        let cosines = lengths.x * dot(v, w) + lengths.y * dot(w, apex) + lengths.z * dot(apex, v);
        sum += 2.0 * arctangent(determinant_of(apex, v, w), lengths.x * lengths.y * lengths.z + cosines);
    }
    return abs(sum);
}

// det(u, v, w) from the position of one corner and the two shortest sides.
fn determinant_of(u: vec3f, v: vec3f, w: vec3f) -> f32 {
    let sides = vec3f(dot(v - u, v - u), dot(w - v, w - v), dot(u - w, u - w));
    if sides.x >= max(sides.y, sides.z) {
        return dot(w, cross(u - w, v - w));
    }
    if sides.y >= sides.z {
        return dot(u, cross(v - u, w - u));
    }
    return dot(v, cross(w - v, u - v));
}

fn polygon_irradiance(corners: Corners, n: vec3f) -> f32 {
    var clip = HorizonClip(n, vec3f(), false);
    var sum = EdgeSum(0.0, 0.0);
    for (var i = 0u; i < corners.count; i++) {
        let clipped = clip_edge(&clip, polygon_edge(corners, i));
        add_term(&sum, lambert_term(clipped.above, n));
        add_term(&sum, lambert_term(clipped.along, n));
    }
    if sum_cancels(sum, corners, 2.0) {
        return polygon_area_integral(corners, n, n, 1.0);
    }
    return 0.5 * abs(sum.value);
}

// Θ (Γ · n) of an edge.
fn lambert_term(edge: Edge, n: vec3f) -> f32 {
    let across = cross(edge.a, edge.b - edge.a);
    let sine = length(across);
    if !edge.exists || sine <= 0.0 {
        return 0.0;
    }
    return arctangent(sine, dot(edge.a, edge.b)) * dot(across / sine, n);
}

fn polygon_phong(corners: Corners, n: vec3f, r: vec3f, m: f32) -> f32 {
    var above_surface = HorizonClip(n, vec3f(), false);
    var above_lobe = HorizonClip(r, vec3f(), false);
    var sum = EdgeSum(0.0, 0.0);
    for (var i = 0u; i < corners.count; i++) {
        let clipped = clip_edge(&above_surface, polygon_edge(corners, i));
        var edge = clipped.above;
        for (var piece = 0u; piece < 2u; piece++) {
            let lit = clip_edge(&above_lobe, edge);
            add_term(&sum, arc_term(lit.above, r, m));
            if lit.along.exists {
                add_term(&sum, azimuth_between(r, lit.along.a, lit.along.b));
            }
            edge = clipped.along;
        }
    }
    if sum_cancels(sum, corners, m + 1.0) {
        return lobe_normalization(m) * polygon_area_integral(corners, n, r, m);
    }
    return abs(sum.value) / (2.0 * PI);
}

// The angle from u to v about the unit axis.
fn azimuth_between(axis: vec3f, u: vec3f, v: vec3f) -> f32 {
    return arctangent(dot(axis, cross(u, v - u)), dot(cross(axis, u), cross(axis, v)));
}

// ∫ (1 − z^(m+1)) dψ along an edge above the lobe's horizon: by quadrature where z^(m+1) counts, else in closed form.
fn arc_term(edge: Edge, r: vec3f, m: f32) -> f32 {
    let across = cross(edge.a, edge.b - edge.a);
    let sine = length(across);
    if !edge.exists || sine <= 0.0 {
        return 0.0;
    }
    let normal = select(-edge.normal, edge.normal, dot(across, edge.normal) > 0.0);
    let gamma = dot(r, normal);
    let rho = length(cross(r, normal));
    let lo = arctangent(dot(r, cross(edge.a, normal)), dot(r, edge.a));
    let theta = arctangent(sine, dot(edge.a, edge.b));
    let hi = lo + theta;
    // z^(m+1) < e⁻²⁰ where |φ| is beyond this.
    let cosine = exp(-20.0 / (m + 1.0)) / max(rho, 1e-20);
    if cosine >= 1.0 {
        return azimuth_between(r, edge.a, edge.b);
    }
    let reach = arctangent(sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
    if lo > reach || hi < -reach {
        return azimuth_between(r, edge.a, edge.b);
    }
    let core_lo = max(lo, -reach);
    let core_hi = min(hi, reach);
    let outside = arc_azimuth(gamma, lo, core_lo) + arc_azimuth(gamma, core_hi, hi);
    // Not core_hi − core_lo, which has lost the digits of a short arc.
    let width = theta - (core_lo - lo) - (hi - core_hi);
    return outside + arc_core(gamma, rho, m, core_lo, width);
}

// The change of ψ from φ = `lo` to φ = `hi`, both within a right angle.
fn arc_azimuth(gamma: f32, lo: f32, hi: f32) -> f32 {
    if lo >= hi {
        return 0.0;
    }
    let s = sine_of(vec4f(lo, hi, HALF_PI - abs(lo), HALF_PI - abs(hi)));
    return arctangent(gamma * (s.y * s.z - s.x * s.w), s.x * s.y + gamma * gamma * s.z * s.w);
}

// Positive nodes of the 16-point Gauss–Legendre rule, and their weights.
const GAUSS_16_INNER = vec4f(0.09501250983763744, 0.2816035507792589, 0.45801677765722737, 0.6178762444026438);
const GAUSS_16_OUTER = vec4f(0.755404408355003, 0.8656312023878318, 0.9445750230732326, 0.9894009349916499);
const WEIGHTS_16_INNER = vec4f(0.1894506104550685, 0.18260341504492358, 0.16915651939500254, 0.14959598881657674);
const WEIGHTS_16_OUTER = vec4f(0.12462897125553388, 0.09515851168249279, 0.062253523938647894, 0.027152459411754096);

// ∫ (1 − z^(m+1)) dψ over [lo, lo + width].
fn arc_core(gamma: f32, rho: f32, m: f32, lo: f32, width: f32) -> f32 {
    let half = 0.5 * width;
    let middle = lo + half;
    let inner = half * GAUSS_16_INNER;
    let outer = half * GAUSS_16_OUTER;
    let h = 0.5 * (m + 1.0);
    let sum = WEIGHTS_16_INNER * (arc_density(gamma, rho, h, middle - inner) + arc_density(gamma, rho, h, middle + inner))
        + WEIGHTS_16_OUTER * (arc_density(gamma, rho, h, middle - outer) + arc_density(gamma, rho, h, middle + outer));
    return gamma * half * dot(sum, vec4f(1.0));
}

// (1 − z^(2h))/(1 − z²) at four places of an arc.
fn arc_density(gamma: f32, rho: f32, h: f32, phi: vec4f) -> vec4f {
    let s = rho * sine_of(phi);
    let off_axis = min(gamma * gamma + s * s, vec4f(1.0));
    let mean = log_over(off_axis);
    let y = h * off_axis * mean;
    let series = 1.0 - y * (0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0 - y * (1.0 / 120.0))));
    let small = y < vec4f(0.2);
    let rise = select((1.0 - exp(-y)) / max(y, vec4f(0.1)), series, small);
    return h * mean * rise;
}

// −ln(1 − x)/x for 0 ≤ x ≤ 1, cut at 1 − 1e-18 where the lobe is nothing.
//
// From 2 artanh(x/(2 − x)) below 1/2, so that small x keep their digits.
fn log_over(x: vec4f) -> vec4f {
    let t = x / (2.0 - x);
    let s = t * t;
    let tail = 1.0 / 9.0 + s * (1.0 / 11.0 + s * (1.0 / 13.0));
    let series = 2.0 * (1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * tail)))) / (2.0 - x);
    return select(-log(max(1.0 - x, vec4f(1e-18))) / max(x, vec4f(0.25)), series, x < vec4f(0.5));
}

// sin x for |x| ≤ π/2, within 1e-7: Taylor's series to x¹¹.
fn sine_of(x: vec4f) -> vec4f {
    let s = x * x;
    let tail = 1.0 / 5040.0 - s * (1.0 / 362880.0 - s * (1.0 / 39916800.0));
    return x * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * tail)));
}

// sin x for 0 ≤ x ≤ π.
fn sine_within_pi(x: vec4f) -> vec4f {
    return sine_of(min(x, PI - x));
}

// ∫ (ω·r)ᵐ dω over the polygon above both horizons, for polygons whose sums along edges cancel: a fan of triangles
// with a product rule on parts smaller than the lobe.
fn polygon_area_integral(corners: Corners, n: vec3f, r: vec3f, m: f32) -> f32 {
    var above_surface = HorizonClip(n, vec3f(), false);
    var above_lobe = HorizonClip(r, vec3f(), false);
    var apex = vec3f();
    var has_apex = false;
    var sum = 0.0;
    for (var i = 0u; i < corners.count; i++) {
        let clipped = clip_edge(&above_surface, polygon_edge(corners, i));
        var edge = clipped.above;
        for (var piece = 0u; piece < 2u; piece++) {
            let lit = clip_edge(&above_lobe, edge);
            var part = lit.above;
            for (var side = 0u; side < 2u; side++) {
                if part.exists && !has_apex {
                    apex = part.a;
                    has_apex = true;
                }
                if part.exists {
                    sum += triangle_integral(apex, part.a, part.b, r, m);
                }
                part = lit.along;
            }
            edge = clipped.along;
        }
    }
    return abs(sum);
}

// Abscissae and weights of the 4-point Gauss–Legendre rule on [0, 1].
const GAUSS_4 = vec4f(0.06943184420297371, 0.33000947820757187, 0.6699905217924281, 0.9305681557970263);
const WEIGHTS_4 = vec4f(0.17392742256872692, 0.3260725774312731, 0.3260725774312731, 0.17392742256872692);

// Parts a side of a triangle, at most.
const MAX_PARTS = 64.0;

// ∫ (ω·r)ᵐ dω over a triangle, signed by its sense: a collapsed square whose sharp corner faces the shortest side.
fn triangle_integral(a: vec3f, b: vec3f, c: vec3f, r: vec3f, m: f32) -> f32 {
    let lengths = vec3f(length(a), length(b), length(c));
    let weight = determinant_of(a, b, c) / max(lengths.x * lengths.y * lengths.z, 1e-37);
    if weight == 0.0 {
        return 0.0;
    }
    var u = a / lengths.x;
    var v = b / lengths.y;
    var w = c / lengths.z;
    // Turn the corners until the side from v to w is the shortest.
    let sides = vec3f(distance(v, w), distance(w, u), distance(u, v));
    if sides.y < min(sides.x, sides.z) {
        let corner = u;
        u = v;
        v = w;
        w = corner;
    } else if sides.z < sides.x {
        let corner = w;
        w = v;
        v = u;
        u = corner;
    }
    let resolution = min(0.5, 1.2 * inverseSqrt(m));
    // Along its length the triangle is cut by angle, in case it passes close by p.
    let far = v + w;
    let angle = arctangent(length(cross(u, far)), dot(u, far));
    let angle_sine = sine_within_pi(vec4f(angle)).x;
    let long_parts = clamp(ceil(angle / resolution), 1.0, MAX_PARTS);
    let short_parts = clamp(ceil(distance(v, w) / resolution), 1.0, MAX_PARTS);
    var sum = 0.0;
    for (var i = 0.0; i < long_parts; i += 1.0) {
        for (var k = 0u; k < 4u; k++) {
            let share = (i + GAUSS_4[k]) / long_parts;
            let sines = sine_within_pi(vec4f(share * angle, (1.0 - share) * angle, 0.0, 0.0));
            let both = sines.x + sines.y;
            let t = sines.x / both;
            let slope = angle * angle_sine / (both * both);
            var row = 0.0;
            for (var j = 0.0; j < short_parts; j += 1.0) {
                row += dot(WEIGHTS_4, triangle_density(u, v, w, t, (j + GAUSS_4) / short_parts, r, m));
            }
            sum += WEIGHTS_4[k] * t * slope * row;
        }
    }
    return weight * sum / (long_parts * short_parts);
}

// (ω·r)ᵐ/|x|³ at four places x = u + t((v − u) + s(w − v)).
fn triangle_density(u: vec3f, v: vec3f, w: vec3f, t: f32, s: vec4f, r: vec3f, m: f32) -> vec4f {
    let start = u + t * (v - u);
    let side = t * (w - v);
    let x = start.x + s * side.x;
    let y = start.y + s * side.y;
    let z = start.z + s * side.z;
    let inverse_square = 1.0 / (x * x + y * y + z * z);
    let inverse = sqrt(inverse_square);
    let cosine = max(x * r.x + y * r.y + z * r.z, vec4f(0.0)) * inverse;
    // Near the axis the sine knows more than the cosine.
    let i = y * r.z - z * r.y;
    let j = z * r.x - x * r.z;
    let k = x * r.y - y * r.x;
    let off_axis = min((i * i + j * j + k * k) * inverse_square, vec4f(1.0));
    let near = exp(-0.5 * m * off_axis * log_over(off_axis));
    let far = exp2(m * log2(max(cosine, vec4f(1e-37))));
    return select(far, near, off_axis < vec4f(0.5)) * inverse_square * inverse;
}

// cos α of the polygon's point above the surface that makes the least angle α with r; 0 where α ≥ 90°.
fn polygon_least_angle_cosine(corners: Corners, normal: vec3f, n: vec3f, r: vec3f) -> f32 {
    var clip = HorizonClip(n, vec3f(), false);
    var turn = 0.0;
    var best = 0.0;
    for (var i = 0u; i < corners.count; i++) {
        let edge = polygon_edge(corners, i);
        turn += azimuth_between(r, edge.a, edge.b);
        let clipped = clip_edge(&clip, edge);
        if clipped.above.exists {
            best = max(best, greatest_cosine(clipped.above, r));
        }
    }
    let in_front = dot(normal, corner(corners, 0u)) * dot(normal, r) > 0.0;
    return select(best, 1.0, in_front && abs(turn) > PI && dot(n, r) > 0.0);
}

// The greatest cosine between r and the points of an edge.
fn greatest_cosine(edge: Edge, r: vec3f) -> f32 {
    let along = edge.b - edge.a;
    let rise = dot(r, along) * dot(edge.a, edge.a) - dot(r, edge.a) * dot(edge.a, along);
    let bend = dot(r, edge.a) * dot(along, along) - dot(r, along) * dot(edge.a, along);
    let ends = max(cosine_to(r, edge.a), cosine_to(r, edge.b));
    if 0.0 < rise && rise < bend {
        return min(max(ends, cosine_to(r, edge.a + rise / bend * along)), 1.0);
    }
    return ends;
}

// The cosine of x to the unit r, from the sine where that is small.
fn cosine_to(r: vec3f, x: vec3f) -> f32 {
    let square = max(dot(x, x), 1e-37);
    let across = cross(r, x);
    let off_axis = dot(across, across) / square;
    let cosine = dot(r, x) * inverseSqrt(square);
    return select(cosine, sqrt(max(1.0 - off_axis, 0.0)), cosine > 0.0 && off_axis < 0.5);
}
