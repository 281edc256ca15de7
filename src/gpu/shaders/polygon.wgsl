// A polygonal light of unit luminance. Its corners are `vertices[0 .. count]`, counter-clockwise seen from the lit side.
//
// Loops are clipped to a horizon edge by edge, as `math::spherical::HorizonClip` does, without lists of vertices.

struct PolygonLight {
    normal: vec3f,
    count: u32,
    two_sided: u32,
}

@group(1) @binding(0) var<uniform> polygon_light: PolygonLight;

fn polygon_respond_exact(at: Shading) -> Response {
    if !polygon_shines_on(at.p) {
        return Response(0.0, 0.0);
    }
    let count = polygon_light.count;
    let m = lobes[at.lobe].exponent;
    return Response(polygon_irradiance(0u, count, at.p, at.n), polygon_phong(0u, count, at.p, at.n, at.r, m));
}

fn polygon_respond_nearest_point(at: Shading) -> Response {
    if !polygon_shines_on(at.p) {
        return Response(0.0, 0.0);
    }
    let count = polygon_light.count;
    let m = lobes[at.lobe].exponent;
    let specular = polygon_nearest_point(0u, count, polygon_light.normal, at.p, at.n, at.r, m);
    return Response(polygon_irradiance(0u, count, at.p, at.n), specular);
}

// Whether p is on a lit side, and not within rounding of the light's own plane.
fn polygon_shines_on(p: vec3f) -> bool {
    let to_corner = vertices[0].xyz - p;
    let height = -dot(polygon_light.normal, to_corner);
    let rounding = 1e-6 * length(to_corner);
    return height > rounding || (polygon_light.two_sided == 1u && height < -rounding);
}

// A directed segment that subtends an arc at p.
struct Edge {
    a: vec3f,
    b: vec3f,
    exists: bool,
}

fn polygon_edge(first: u32, count: u32, p: vec3f, i: u32) -> Edge {
    let next = select(i + 1u, 0u, i + 1u == count);
    return Edge(vertices[first + i].xyz - p, vertices[first + next].xyz - p, true);
}

// What is left of an edge above a horizon, and the piece of the horizon that its crossing adds.
struct Clipped {
    above: Edge,
    horizon: Edge,
}

struct HorizonClip {
    n: vec3f,
    start: vec3f,
    started: bool,
}

fn horizon_clip(n: vec3f) -> HorizonClip {
    return HorizonClip(n, vec3f(), false);
}

fn no_edge() -> Edge {
    return Edge(vec3f(), vec3f(), false);
}

fn clip_edge(clip: ptr<function, HorizonClip>, edge: Edge) -> Clipped {
    let above_a = dot((*clip).n, edge.a);
    let above_b = dot((*clip).n, edge.b);
    let leaves = above_a >= 0.0;
    if leaves == (above_b >= 0.0) {
        return Clipped(Edge(edge.a, edge.b, leaves), no_edge());
    }
    let x = edge.a + above_a / (above_a - above_b) * (edge.b - edge.a);
    if !(*clip).started {
        (*clip).started = true;
        (*clip).start = x;
    }
    let start = (*clip).start;
    if leaves {
        return Clipped(Edge(edge.a, x, true), Edge(x, start, true));
    }
    return Clipped(Edge(x, edge.b, true), Edge(start, x, true));
}

// Irradiance: ½ |Σ Θ (Γ · n)|.
//
// Of a light that is seen small these terms nearly cancel. There, with c the first corner, Θ Γ = (a × b)(1 + x)/c² with
// small x, and Σ a × b is taken about c: rounding is then in proportion to the solid angle, not to the width.
fn polygon_irradiance(first: u32, count: u32, p: vec3f, n: vec3f) -> f32 {
    let small = polygon_extent(first, count, p) < 0.25;
    let corner = vertices[first].xyz - p;
    var clip = horizon_clip(n);
    var sum = 0.0;
    for (var i = 0u; i < count; i++) {
        let clipped = clip_edge(&clip, polygon_edge(first, count, p, i));
        for (var piece = 0u; piece < 2u; piece++) {
            var edge = clipped.above;
            if piece == 1u {
                edge = clipped.horizon;
            }
            if edge.exists {
                if small {
                    sum += small_edge_irradiance(edge, corner, n);
                } else {
                    sum += edge_irradiance(edge, n);
                }
            }
        }
    }
    return 0.5 * abs(sum);
}

// (Θ/sin Θ)/(|a||b|) = (1 + h)(1 + q)/c², h from the distances and q from Θ/sin Θ.
fn small_edge_irradiance(edge: Edge, corner: vec3f, n: vec3f) -> f32 {
    let square = dot(corner, corner);
    let a = edge.a - corner;
    let b = edge.b - corner;
    let excess_a = (2.0 * dot(corner, a) + dot(a, a)) / square;
    let excess_b = (2.0 * dot(corner, b) + dot(b, b)) / square;
    let y = excess_a + excess_b + excess_a * excess_b;
    let root = sqrt(1.0 + y);
    let h = -y / (root * (1.0 + root));
    let across = cross(edge.a, edge.b - edge.a);
    let sine_squared = dot(across, across) / (square * square * (1.0 + y));
    let q = sine_squared * (1.0 / 6.0 + sine_squared * (3.0 / 40.0 + sine_squared * (15.0 / 336.0)));
    return (dot(cross(a, b), n) + dot(across, n) * (h + q + h * q)) / square;
}

// Θ (Γ · n)
fn edge_irradiance(edge: Edge, n: vec3f) -> f32 {
    let across = cross(edge.a, edge.b - edge.a);
    let sine = sqrt(dot(across, across));
    if sine == 0.0 {
        return 0.0;
    }
    return arctangent(sine, dot(edge.a, edge.b)) * dot(across, n) / sine;
}

// Seen under less than this, in radians over √(m + 1), a light is a point: the error is below 1e-4 of it.
const FAR = 0.034;

// The greatest distance from the first corner over that corner's distance.
fn polygon_extent(first: u32, count: u32, p: vec3f) -> f32 {
    let corner = vertices[first].xyz;
    var square = 0.0;
    for (var i = 1u; i < count; i++) {
        let along = vertices[first + i].xyz - corner;
        square = max(square, dot(along, along));
    }
    let to_corner = corner - p;
    return sqrt(square / max(dot(to_corner, to_corner), 1e-37));
}

// What of a light that is seen small lies above the horizon.
struct Patch {
    solid_angle: f32,
    // Unit, to the centre of area.
    direction: vec3f,
}

fn polygon_patch(first: u32, count: u32, p: vec3f, n: vec3f) -> Patch {
    let corner = vertices[first].xyz - p;
    var clip = horizon_clip(n);
    var area = vec3f();
    var weighed = vec3f();
    var axis = vec3f();
    for (var i = 0u; i < count; i++) {
        let clipped = clip_edge(&clip, polygon_edge(first, count, p, i));
        for (var piece = 0u; piece < 2u; piece++) {
            var edge = clipped.above;
            if piece == 1u {
                edge = clipped.horizon;
            }
            if edge.exists {
                let a = edge.a - corner;
                let b = edge.b - corner;
                let twice = cross(a, b);
                if dot(axis, axis) == 0.0 {
                    axis = twice;
                }
                area += 0.5 * twice;
                weighed += dot(twice, axis) * (a + b) / 6.0;
            }
        }
    }
    let weight = dot(area, axis);
    if weight == 0.0 {
        return Patch(0.0, n);
    }
    let centre = corner + weighed / weight;
    let inverse = inverseSqrt(dot(centre, centre));
    let direction = centre * inverse;
    return Patch(abs(dot(area, direction)) * inverse * inverse, direction);
}

// (m + 1)/2π ∫ (ω·r)ᵐ dω = (1/2π) |Σ ∫ (1 − z^(m+1)) dψ|; see `shading::polygon::phong`.
//
// ∫ dψ is 0 where r does not meet the polygon; where all of it is in the lobe's tail, z^(m+1) alone keeps the digits.
fn polygon_phong(first: u32, count: u32, p: vec3f, n: vec3f, r: vec3f, m: f32) -> f32 {
    let extent = polygon_extent(first, count, p);
    if extent * sqrt(m + 1.0) < FAR {
        let small = polygon_patch(first, count, p, n);
        if dot(small.direction, r) > extent {
            return lobe_normalization(m) * small.solid_angle * lobe_power(r, small.direction, m);
        }
    }
    let away = polygon_is_away(first, count, p, n, r, m);
    var above_surface = horizon_clip(n);
    var above_lobe = horizon_clip(r);
    var sum = 0.0;
    for (var i = 0u; i < count; i++) {
        let clipped = clip_edge(&above_surface, polygon_edge(first, count, p, i));
        for (var piece = 0u; piece < 2u; piece++) {
            var edge = clipped.above;
            if piece == 1u {
                edge = clipped.horizon;
            }
            if edge.exists {
                let lit = clip_edge(&above_lobe, edge);
                if lit.above.exists {
                    sum += arc_integral(lit.above, r, m, n, piece == 1u, away);
                }
                if lit.horizon.exists && !away {
                    sum += azimuth_between(r, lit.horizon.a, lit.horizon.b);
                }
            }
        }
    }
    return abs(sum) / (2.0 * PI);
}

// Whether z^(m+1) is below 0.3 on the whole polygon.
fn polygon_is_away(first: u32, count: u32, p: vec3f, n: vec3f, r: vec3f, m: f32) -> bool {
    let corner = vertices[first].xyz - p;
    var turn = 0.0;
    var greatest = 0.0;
    for (var i = 0u; i < count; i++) {
        let edge = polygon_edge(first, count, p, i);
        let nearest = edge_nearest(edge, r);
        greatest = max(greatest, dot(r, nearest) * inverseSqrt(max(dot(nearest, nearest), 1e-37)));
        turn += azimuth_between(r, edge.a, edge.b);
    }
    return abs(turn) < 1.0 && power(greatest, m + 1.0) < 0.3;
}

fn azimuth_between(axis: vec3f, u: vec3f, v: vec3f) -> f32 {
    return arctangent(dot(axis, cross(u, v - u)), dot(cross(axis, u), cross(axis, v)));
}

// Gauss–Legendre on [−1, 1]: the positive nodes and their weights.
const POLYGON_HALF_NODES = 5u;
const POLYGON_NODES = array<vec2f, 5>(
    vec2f(0.14887433898163121088, 0.29552422471475287017),
    vec2f(0.43339539412924719080, 0.26926671930999635509),
    vec2f(0.67940956829902440623, 0.21908636251598204400),
    vec2f(0.86506336668898451073, 0.14945134915058059315),
    vec2f(0.97390652851717172008, 0.06667134430868813759),
);

// ∫ (1 − z^(m+1)) dψ along an edge within the lobe's hemisphere, z = ρ cos φ, φ from the point nearest to r.
//
// Where z^(m+1) < 1.2e-7 only ψ itself counts; elsewhere dψ = γ/(1 − z²) dφ, and (1 − z^(m+1))/(1 − z²) is smooth.
fn arc_integral(edge: Edge, r: vec3f, m: f32, n: vec3f, along_horizon: bool, away: bool) -> f32 {
    let across = cross(edge.a, edge.b - edge.a);
    let sine = sqrt(dot(across, across));
    if sine == 0.0 {
        return 0.0;
    }
    var normal = across / sine;
    if along_horizon {
        // The cross product loses its direction when the edge passes close by.
        normal = n * sign(dot(across, n));
    }
    let gamma = dot(r, normal);
    let off = cross(r, normal);
    let rho = sqrt(dot(off, off));
    let start = arctangent(dot(r, cross(edge.a, normal)), dot(r, edge.a));
    let end = start + arctangent(sine, dot(edge.a, edge.b));
    let reach = arc_reach(rho, m);
    let low = max(start, -reach);
    let high = min(end, reach);
    if low >= high {
        if away {
            return 0.0;
        }
        return azimuth_between(r, edge.a, edge.b);
    }
    let middle = clamp(0.0, low, high);
    var sum = gamma * (arc_core(gamma, rho, m, low, middle, away) + arc_core(gamma, rho, m, middle, high, away));
    if away {
        return sum;
    }
    if low > start {
        sum += arc_azimuth(gamma, start, low);
    }
    if high < end {
        sum += arc_azimuth(gamma, high, end);
    }
    return sum;
}

// |φ| beyond which z^(m+1) is negligible.
fn arc_reach(rho: f32, m: f32) -> f32 {
    let cosine = exp(-16.0 / (m + 1.0)) / max(rho, 1e-30);
    if cosine >= 1.0 {
        return 0.0;
    }
    return arctangent(sqrt((1.0 - cosine) * (1.0 + cosine)), cosine);
}

// The change of ψ from one φ to another, less than a half turn away.
fn arc_azimuth(gamma: f32, start: f32, end: f32) -> f32 {
    let sine_start = sine_of(start);
    let sine_end = sine_of(end);
    let cosines = sine_of(HALF_PI - abs(start)) * sine_of(HALF_PI - abs(end));
    let between = end - start;
    let sine = sine_of(min(between, PI - between));
    return arctangent(gamma * sine, sine_start * sine_end + gamma * gamma * cosines);
}

// ∫ (1 − z^(m+1))/(1 − z²) dφ; `away`, ∫ z^(m+1)/(1 − z²) dφ.
fn arc_core(gamma: f32, rho: f32, m: f32, low: f32, high: f32, away: bool) -> f32 {
    let half = 0.5 * (high - low);
    if half <= 0.0 {
        return 0.0;
    }
    let middle = 0.5 * (low + high);
    let half_power = 0.5 * (m + 1.0);
    var sum = 0.0;
    for (var i = 0u; i < 2u * POLYGON_HALF_NODES; i++) {
        let node = POLYGON_NODES[i >> 1u];
        let s = rho * sine_of(middle + select(-half, half, (i & 1u) == 0u) * node.x);
        let off_axis = gamma * gamma + s * s;
        let shrunk = half_power * log_one_plus(-min(off_axis, 0.9999999));
        let share = select(one_minus_exp(shrunk), exp(shrunk), away);
        sum += node.y * select(half_power, share / off_axis, off_axis > 1e-12);
    }
    return half * sum;
}

// 1 − eˣ for x ≤ 0.
fn one_minus_exp(x: f32) -> f32 {
    let series = -x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0)))));
    return select(1.0 - exp(x), series, x > -0.1);
}

// Taylor's series to x¹¹: within 6e-8 for |x| ≤ π/2.
fn sine_of(x: f32) -> f32 {
    let s = x * x;
    let tail = 1.0 / 5040.0 - s * (1.0 / 362880.0 - s * (1.0 / 39916800.0));
    return x * (1.0 - s * (1.0 / 6.0 - s * (1.0 / 120.0 - s * tail)));
}

// cosᵐα at the least angle α that r makes with a point of the polygon above the surface ([PICOTT_1992], §3.2).
fn polygon_nearest_point(first: u32, count: u32, normal: vec3f, p: vec3f, n: vec3f, r: vec3f, m: f32) -> f32 {
    if dot(n, r) > 0.0 && polygon_is_met(first, count, normal, p, r) {
        return 1.0;
    }
    var clip = horizon_clip(n);
    var best = vec3f();
    var greatest = 0.0;
    for (var i = 0u; i < count; i++) {
        let edge = clip_edge(&clip, polygon_edge(first, count, p, i)).above;
        if edge.exists {
            let candidate = edge_nearest(edge, r);
            let cosine = dot(r, candidate) * inverseSqrt(max(dot(candidate, candidate), 1e-37));
            if cosine > greatest {
                greatest = cosine;
                best = candidate;
            }
        }
    }
    return select(0.0, lobe_power(r, normalize(best), m), greatest > 0.0);
}

// Even-odd rule in the polygon's plane, with its steepest axis left out.
fn polygon_is_met(first: u32, count: u32, normal: vec3f, p: vec3f, r: vec3f) -> bool {
    let toward = dot(normal, r);
    let t = dot(normal, vertices[first].xyz - p) / select(toward, 1e-30, toward == 0.0);
    if toward == 0.0 || t <= 0.0 {
        return false;
    }
    var inside = false;
    var a = in_plane(vertices[first + count - 1u].xyz - p - t * r, abs(normal));
    for (var i = 0u; i < count; i++) {
        let b = in_plane(vertices[first + i].xyz - p - t * r, abs(normal));
        if (a.y > 0.0) != (b.y > 0.0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0 {
            inside = !inside;
        }
        a = b;
    }
    return inside;
}

fn in_plane(v: vec3f, n: vec3f) -> vec2f {
    if n.x >= n.y && n.x >= n.z {
        return v.yz;
    }
    return select(v.xy, v.xz, n.y >= n.z);
}

// The point of an edge that makes the least angle with r: the stationary point where it is a maximum, else an end.
fn edge_nearest(edge: Edge, r: vec3f) -> vec3f {
    let along = edge.b - edge.a;
    let rise = dot(r, along) * dot(edge.a, edge.a) - dot(r, edge.a) * dot(edge.a, along);
    let bend = dot(r, edge.a) * dot(along, along) - dot(r, along) * dot(edge.a, along);
    if bend > 0.0 && rise > 0.0 && rise < bend {
        return edge.a + rise / bend * along;
    }
    let at_a = dot(r, edge.a) * inverseSqrt(max(dot(edge.a, edge.a), 1e-37));
    let at_b = dot(r, edge.b) * inverseSqrt(max(dot(edge.b, edge.b), 1e-37));
    return select(edge.b, edge.a, at_a >= at_b);
}
