// What is hidden of a linear light from p, item by item, and together.
//
// A point of the light is to_a + t·along from p, 0 ≤ t ≤ 1, and of the triangle that p makes with it λ times that,
// 0 < λ ≤ 1. A convex item cuts a convex piece out of the triangle, whose shadow on the light is one interval of t: from
// p outside of it. Its ends are where the piece has a corner, or where a ray touches it ([POULIN_AMANATIDES_1990], §5).

// The part of the light that is so near to its end, as seen from p, that what is there only touches it.
const AT_END = 1e-5;
// Intervals of t that are no wider, and gaps between them, are none.
const GAP = 1e-6;
const UNHIDDEN = vec2f(2.0, -1.0);

// Parts of the light that are hidden: up to four intervals from low to high, apart from each other, and the t up to which
// they are all there is. A place without one has low = NOWHERE.
struct Covered {
    low: vec4f,
    high: vec4f,
    known: f32,
}

const NOWHERE = 8.0;

// What is hidden of the light between t.x and t.y. A light that is hidden in more than four pieces takes more than one call.
fn covered(p: vec3f, to_a: vec3f, along: vec3f, own: u32, t: vec2f) -> Covered {
    var covers = Covered(vec4f(NOWHERE), vec4f(NOWHERE), t.y);
    for (var i = 0u; i < occluders.always; i++) {
        let hidden = hidden_by_primitive(i, p, to_a, along, i == own);
        covers = with_interval(with_interval(covers, t.x, hidden.xy), t.x, hidden.zw);
    }
    let wedge = wedge_of(to_a + t.x * along, to_a + t.y * along);
    var at = 0u;
    while at < occluders.primitive_nodes && !is_all(covers, t) {
        var item = 0u;
        while at < occluders.primitive_nodes && item == 0u {
            let is_met = touches(nodes[at], p, wedge);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u {
            let hidden = hidden_by_primitive(item - 1u, p, to_a, along, item - 1u == own);
            covers = with_interval(with_interval(covers, t.x, hidden.xy), t.x, hidden.zw);
        }
    }
    at = occluders.primitive_nodes;
    while at < occluders.nodes && !is_all(covers, t) {
        var item = 0u;
        while at < occluders.nodes && item == 0u {
            let is_met = touches(nodes[at], p, wedge);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u && item - 1u != own {
            covers = with_interval(covers, t.x, hidden_by_triangle(item - 1u - occluders.primitives, p, to_a, along));
        }
    }
    return covers;
}

// Whether all between t.x and t.y is hidden.
fn is_all(covers: Covered, t: vec2f) -> bool {
    return any(covers.low <= vec4f(t.x + GAP) & covers.high >= vec4f(t.y - GAP));
}

// Another interval, of which what is before `first` does not matter. With four others, the farthest is forgotten.
fn with_interval(covers: Covered, first: f32, interval: vec2f) -> Covered {
    let is_some = interval.y > interval.x + GAP && interval.y > first + GAP;
    if !is_some {
        return covers;
    }
    let joins = covers.low <= vec4f(interval.y + GAP) & covers.high >= vec4f(interval.x - GAP);
    let least = select(vec4f(NOWHERE), covers.low, joins);
    let greatest = select(vec4f(-1.0), covers.high, joins);
    let low = min(interval.x, min(min(least.x, least.y), min(least.z, least.w)));
    let high = max(interval.y, max(max(greatest.x, greatest.y), max(greatest.z, greatest.w)));
    let kept_low = select(covers.low, vec4f(NOWHERE), joins);
    let kept_high = select(covers.high, vec4f(NOWHERE), joins);
    let farthest = max(max(kept_low.x, kept_low.y), max(kept_low.z, kept_low.w));
    if low >= farthest {
        return Covered(kept_low, kept_high, min(covers.known, low));
    }
    let is_farthest = kept_low == vec4f(farthest);
    let y = is_farthest.y && !is_farthest.x;
    let z = is_farthest.z && !is_farthest.x && !is_farthest.y;
    let w = is_farthest.w && !is_farthest.x && !is_farthest.y && !is_farthest.z;
    let place = vec4<bool>(is_farthest.x, y, z, w);
    return Covered(
        select(kept_low, vec4f(low), place),
        select(kept_high, vec4f(high), place),
        select(covers.known, min(covers.known, farthest), farthest < NOWHERE),
    );
}

// Where the light is hidden from t on, up to there; where it is not, t, and where it is next.
fn stretch_of_light(covers: Covered, t: f32) -> vec2f {
    let hides_it = covers.low <= vec4f(t + GAP) & covers.high > vec4f(t + GAP);
    let high = select(vec4f(t), covers.high, hides_it);
    let next = select(vec4f(covers.known), covers.low, covers.low > vec4f(t + GAP));
    let end = max(max(high.x, high.y), max(high.z, high.w));
    return vec2f(end, min(covers.known, min(min(next.x, next.y), min(next.z, next.w))));
}

// The triangle from p to a part of the light: its bounds, its plane, and the planes of its sides, about p.
struct Wedge {
    least: vec3f,
    greatest: vec3f,
    n: vec3f,
    // Normals into the triangle.
    beside_a: vec3f,
    beside_b: vec3f,
}

fn wedge_of(a: vec3f, b: vec3f) -> Wedge {
    let n = cross(a, b);
    return Wedge(min(min(a, b), vec3f()), max(max(a, b), vec3f()), n, cross(n, a), cross(b, n));
}

fn touches(node: Node, p: vec3f, wedge: Wedge) -> bool {
    let center = 0.5 * (node.least + node.greatest) - p;
    // Room for the rounding of the planes.
    let half = 0.5 * (node.greatest - node.least) + 2e-6 * abs(center);
    return all(center + half >= wedge.least) && all(center - half <= wedge.greatest)
        && abs(dot(wedge.n, center)) <= dot(abs(wedge.n), half)
        && dot(wedge.beside_a, center) + dot(abs(wedge.beside_a), half) >= 0.0
        && dot(wedge.beside_b, center) + dot(abs(wedge.beside_b), half) >= 0.0;
}

// The t at which k0 + k1·t ≤ 0, of each component that counts.
fn clipped(t: vec2f, k0: vec3f, k1: vec3f, counts: vec3<bool>) -> vec2f {
    let root = -k0 / select(k1, vec3f(1.0), k1 == vec3f());
    let level = select(vec3f(-1.0), vec3f(2.0), k0 > vec3f());
    let least = select(vec3f(-1.0), select(level, root, k1 < vec3f()), counts & (k1 <= vec3f()));
    let greatest = select(vec3f(2.0), root, counts & (k1 > vec3f()));
    return vec2f(
        max(t.x, max(least.x, max(least.y, least.z))),
        min(t.y, min(greatest.x, min(greatest.y, greatest.z))),
    );
}

// A triangle hides what is behind its plane and within the planes of p and its edges.
fn hidden_by_triangle(i: u32, p: vec3f, to_a: vec3f, along: vec3f) -> vec2f {
    let a = triangles[i].a - p;
    let b = triangles[i].b - p;
    let c = triangles[i].c - p;
    let ab = triangles[i].b - triangles[i].a;
    let bc = triangles[i].c - triangles[i].b;
    let ca = triangles[i].a - triangles[i].c;
    let n = cross(ab, bc);
    let height = dot(n, a);
    if abs(height) <= ROUNDING * dot(abs(n), abs(p) + abs(triangles[i].a)) {
        return UNHIDDEN;
    }
    let side = select(1.0, -1.0, height > 0.0);
    let beside_ab = side * cross(a, ab);
    let beside_bc = side * cross(b, bc);
    let beside_ca = side * cross(c, ca);
    let k0 = vec3f(dot(beside_ab, to_a), dot(beside_bc, to_a), dot(beside_ca, to_a));
    let k1 = vec3f(dot(beside_ab, along), dot(beside_bc, along), dot(beside_ca, along));
    let t = clipped(vec2f(0.0, 1.0), k0, k1, vec3<bool>(true));
    let behind = vec3f((1.0 + AT_END) * abs(height) + side * dot(n, to_a));
    return clipped(t, behind, vec3f(side * dot(n, along)), vec3<bool>(true));
}

// Up to two intervals: of what p is inside of, the light's parts that are not.
fn hidden_by_primitive(i: u32, p: vec3f, to_a: vec3f, along: vec3f, is_own: bool) -> vec4f {
    let half = primitives[i].half;
    let quadric = primitives[i].quadric;
    let to_b = to_a + along;
    let start = onto_faces(half, quadric, local_point(i, p), local_rounding(i, p), is_own);
    let o = start.p;
    let a = onto_faces(half, quadric, local_point(i, p + to_a), local_rounding(i, p + to_a), false).p;
    let b = onto_faces(half, quadric, local_point(i, p + to_b), local_rounding(i, p + to_b), false).p;
    let w = a - o;
    let e = b - a;
    let slabs = hidden_by_slabs(half, o, w, e);
    let is_inside = is_own || (all(abs(o) <= half) && (start.on_quadric || quadric_at(quadric, o) < 0.0));
    if is_inside {
        // What points out of the faces that p is on is not hidden, nor what is inside as p is.
        let gradient = quadric_gradient(quadric, o);
        let outward = vec3f(dot(gradient, w), -1.0, -1.0);
        let inward = clipped(slabs, outward, vec3f(dot(gradient, e), 0.0, 0.0), vec3<bool>(start.on_quadric));
        let inside = both(span_of_slabs(half * 1.000002, a, e), span_of_quadric(quadric, a, e, false));
        let hidden = select(inward, UNHIDDEN, half.z == 0.0);
        let is_none = inside.x > inside.y;
        return select(
            vec4f(hidden.x, min(hidden.y, inside.x), max(hidden.x, inside.y), hidden.y),
            vec4f(hidden, UNHIDDEN),
            is_none,
        );
    }
    return vec4f(both(slabs, hidden_by_quadric(half, quadric, o, w, e)), UNHIDDEN);
}

// The t whose rays meet all slabs, before the light, together.
//
// With μ = 1/λ a slab is |w + t·e + μo| ≤ μ·half: bounds of μ that are linear in t. Every lower one must be below every
// upper one. Towards p's side of the slab, s, the far face is a lower one, the near face an upper one where p is outside.
fn hidden_by_slabs(half: vec3f, o: vec3f, w: vec3f, e: vec3f) -> vec2f {
    let s = select(vec3f(-1.0), vec3f(1.0), o >= vec3f());
    let f0 = s * w;
    let f1 = s * e;
    let far = half + abs(o);
    let near = half - abs(o);
    let beyond = -near;
    let outside = near < vec3f();
    var t = clipped(vec2f(0.0, 1.0), f0 + (1.0 + AT_END) * beyond, f1, outside);
    t = clipped(t, f0, f1, near == vec3f());
    // Each axis against the next, and against the one after.
    t = clipped(t, f0 * far.yzx - f0.yzx * beyond, f1 * far.yzx - f1.yzx * beyond, outside);
    t = clipped(t, f0 * far.zxy - f0.zxy * beyond, f1 * far.zxy - f1.zxy * beyond, outside);
    t = clipped(t, f0.yzx * beyond + f0 * near.yzx, f1.yzx * beyond + f1 * near.yzx, outside & (near.yzx >= vec3f()));
    return clipped(t, f0.zxy * beyond + f0 * near.zxy, f1.zxy * beyond + f1 * near.zxy, outside & (near.zxy >= vec3f()));
}

// The t whose rays meet the common part of the slabs and the quadric, which p is outside of: the least interval about the
// corners of the piece, and the points where a ray touches it.
fn hidden_by_quadric(half: vec3f, quadric: vec4f, o: vec3f, to_light: vec3f, e_light: vec3f) -> vec2f {
    if quadric.x == 0.0 {
        return vec2f(0.0, 1.0);
    }
    let w = (1.0 - AT_END) * to_light;
    let e = (1.0 - AT_END) * e_light;
    let alpha = quadric.y;
    let c = vec3f(o.xy, o.z - quadric.w);
    // Where a ray touches: B² − AC = 0, by Lagrange's identity a sum of squares of the moments and of the direction.
    var t = UNHIDDEN;
    let tangents = zeros(
        vec3f(-alpha, -alpha, -1.0), cross(c, w), cross(c, e),
        -quadric.z * vec3f(1.0, 1.0, alpha), w, e,
    );
    t = with_tangent(t, tangents.x, half, alpha, o.z, c, w, e);
    t = with_tangent(t, tangents.y, half, alpha, o.z, c, w, e);
    // Where one passes through a rim.
    t = with_rim(t, half.z, quadric, o, w, e);
    t = with_rim(t, -half.z, quadric, o, w, e);
    // Where the light itself enters and leaves.
    let inside = both(span_of_slabs(half, o + w, e), span_of_quadric(quadric, o + w, e, false));
    let crosses = inside.x <= inside.y && inside.x <= 1.0 && inside.y >= 0.0;
    t = with_end(t, max(inside.x, 0.0), crosses);
    t = with_end(t, min(inside.y, 1.0), crosses);
    // The rays to its ends.
    t = with_end(t, 0.0, is_met_before(half, quadric, o, w));
    return with_end(t, 1.0, is_met_before(half, quadric, o, w + e));
}

fn is_met_before(half: vec3f, quadric: vec4f, o: vec3f, w: vec3f) -> bool {
    let span = both(span_of_slabs(half, o, w), span_of_quadric(quadric, o, w, false));
    return span.x <= span.y && span.x > 0.0 && span.x <= 1.0;
}

// The interval that holds t too.
fn with_end(interval: vec2f, t: f32, holds: bool) -> vec2f {
    let holds_in = holds && t >= 0.0 && t <= 1.0;
    return select(interval, vec2f(min(interval.x, t), max(interval.y, t)), holds_in);
}

fn with_tangent(
    interval: vec2f, t: f32, half: vec3f, alpha: f32, height: f32, c: vec3f, w0: vec3f, e: vec3f,
) -> vec2f {
    let w = w0 + t * e;
    let b = dot(c.xy, w.xy) + alpha * c.z * w.z;
    let a = dot(w.xy, w.xy) + alpha * w.z * w.z;
    let share = -b / select(a, 1e-30, abs(a) < 1e-30);
    return with_end(interval, t, share > 0.0 && share <= 1.0 && abs(height + share * w.z) <= half.z);
}

fn with_rim(interval: vec2f, rim: f32, quadric: vec4f, o: vec3f, w: vec3f, e: vec3f) -> vec2f {
    let above = rim - quadric.w;
    let square = -(quadric.y * above * above + quadric.z);
    let height = rim - o.z;
    let at = vec3f(o.xy * w.z + height * w.xy, w.z);
    let step = vec3f(o.xy * e.z + height * e.xy, e.z);
    let t = zeros(vec3f(1.0, 1.0, -max(square, 0.0)), at, step, vec3f(), vec3f(), vec3f());
    let bounded = abs(rim) < 1e14;
    let there = w.z + t * e.z;
    let share = height / select(there, vec2f(1e-30), abs(there) < vec2f(1e-30));
    let holds = share > vec2f() & share <= vec2f(1.0) & vec2<bool>(bounded);
    return with_end(with_end(interval, t.x, holds.x), t.y, holds.y);
}

// The zeros of Σ uᵢ(xᵢ + t·yᵢ)² + Σ vᵢ(zᵢ + t·rᵢ)²; 2 where there are none.
//
// From the t where it is least or greatest, so that zeros close together keep their distance.
fn zeros(u: vec3f, x: vec3f, y: vec3f, v: vec3f, z: vec3f, r: vec3f) -> vec2f {
    let a = dot(u * y, y) + dot(v * r, r);
    let flat = abs(a) < 1e-30;
    let middle = clamp(-(dot(u * x, y) + dot(v * z, r)) / select(a, 1.0, flat), 0.0, 1.0);
    let x_there = x + middle * y;
    let z_there = z + middle * r;
    let b = dot(u * x_there, y) + dot(v * z_there, r);
    let c = dot(u * x_there, x_there) + dot(v * z_there, z_there);
    let discriminant = b * b - a * c;
    let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(discriminant, 0.0)));
    let one = select(2.0, middle + c / select(q, 1.0, q == 0.0), q != 0.0);
    let other = select(middle + q / select(a, 1.0, flat), 2.0, flat);
    return select(vec2f(one, other), vec2f(2.0), discriminant < 0.0);
}
