// What rays meet: primitives and triangles about the eye, and the hierarchies of boxes about them.
//
// A primitive is convex in its own frame: three slabs |x| ≤ half, and one quadric Q = ρ(x² + y²) + α(z − z₀)² + γ ≤ 0.
// A sphere has no slabs, a box no quadric; a cylinder and a cone have one slab across Z; flat ones are slabs of no
// thickness. One piece of code so does for all of them, where a device would run every branch of a choice.
//
// Items are counted primitives first, then triangles; the first `always` primitives are in no hierarchy.

struct Occluders {
    // Primitives that are always tested.
    always: u32,
    primitives: u32,
    // Nodes of the primitives' hierarchy; the triangles' follow.
    primitive_nodes: u32,
    nodes: u32,
}

struct Node {
    least: vec3f,
    // The node to go on with where this box is missed.
    skip: u32,
    greatest: vec3f,
    // Of a leaf, the item + 1; else 0.
    item: u32,
}

struct Primitive {
    local_from_world: mat3x3f,
    world_from_local: mat3x3f,
    // The eye in the primitive's frame.
    eye_local: vec3f,
    material: u32,
    // The primitive's origin about the eye.
    origin: vec3f,
    unused: u32,
    // Half the slabs' thickness.
    half: vec3f,
    unused_too: u32,
    // ρ, α, γ, z₀
    quadric: vec4f,
}

struct Triangle {
    a: vec3f,
    material: u32,
    b: vec3f,
    unused_0: u32,
    c: vec3f,
    unused_1: u32,
    // Unit normals at the corners.
    normal_a: vec3f,
    unused_2: u32,
    normal_b: vec3f,
    unused_3: u32,
    normal_c: vec3f,
    unused_4: u32,
}

@group(2) @binding(0) var<uniform> occluders: Occluders;
@group(2) @binding(1) var<storage, read> nodes: array<Node>;
@group(2) @binding(2) var<storage, read> primitives: array<Primitive>;
@group(2) @binding(3) var<storage, read> triangles: array<Triangle>;

// The parts of a ray, in lengths of its direction, that are inside: from entry to exit, empty where entry > exit.
const NONE = vec2f(1.0, -1.0);
const HUGE = 1e30;
const ALL = vec2f(-HUGE, HUGE);

fn both(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(max(a.x, b.x), min(a.y, b.y));
}

// 1/d, large where d is 0.
fn inverse_of(d: vec3f) -> vec3f {
    return 1.0 / select(d, vec3f(1e-20), abs(d) < vec3f(1e-20));
}

// Whether a ray from p meets a node's box before `reach`.
fn meets(node: Node, p: vec3f, inverse: vec3f, reach: f32) -> bool {
    let a = (node.least - p) * inverse;
    let b = (node.greatest - p) * inverse;
    let near = min(a, b);
    let far = max(a, b);
    let entry = max(max(near.x, near.y), max(near.z, 0.0));
    let exit = min(min(far.x, far.y), min(far.z, reach));
    // What a quotient's rounding may take.
    return entry <= exit * 1.000001;
}

// Inside |x| ≤ half of three slabs. A ray in the plane of a flat one is never inside.
fn span_of_slabs(half: vec3f, o: vec3f, d: vec3f) -> vec2f {
    let inverse = inverse_of(d);
    let a = (-half - o) * inverse;
    let b = (half - o) * inverse;
    let along = abs(d) < vec3f(1e-20);
    let within = abs(o) < half;
    let near = select(min(a, b), select(vec3f(HUGE), vec3f(-HUGE), within), along);
    let far = select(max(a, b), select(vec3f(-HUGE), vec3f(HUGE), within), along);
    return vec2f(max(near.x, max(near.y, near.z)), min(far.x, min(far.y, far.z)));
}

fn quadric_at(quadric: vec4f, p: vec3f) -> f32 {
    let z = p.z - quadric.w;
    return quadric.x * dot(p.xy, p.xy) + quadric.y * z * z + quadric.z;
}

// Half of it.
fn quadric_gradient(quadric: vec4f, p: vec3f) -> vec3f {
    return vec3f(quadric.x * p.xy, quadric.y * (p.z - quadric.w));
}

// Inside the quadric; `on`: its surface holds o. A cone's upper nappe counts as outside of rays that are in both.
fn span_of_quadric(quadric: vec4f, o: vec3f, d: vec3f, on: bool) -> vec2f {
    let a = quadric.x * dot(d.xy, d.xy) + quadric.y * d.z * d.z;
    if on {
        let b = dot(quadric_gradient(quadric, o), d);
        let other = select(-HUGE * sign(b), -2.0 * b / a, abs(a) > 1e-30);
        return nappe(a, d, vec2f(min(other, 0.0), max(other, 0.0)));
    }
    // From where the ray passes the centre: a far origin then costs no digits.
    let shift = -dot(o, d) / max(dot(d, d), 1e-30);
    let p = o + shift * d;
    let b = dot(quadric_gradient(quadric, p), d);
    let c = quadric_at(quadric, p);
    let discriminant = b * b - a * c;
    // Roots without cancellation: q/a and c/q.
    let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(discriminant, 0.0)));
    if abs(q) < 1e-30 {
        return select(NONE, ALL, c < 0.0);
    }
    let one = c / q;
    let other = select(HUGE, q / a, abs(a) > 1e-30);
    let span = nappe(a, d, vec2f(min(one, other), max(one, other)));
    return select(span + shift, NONE, discriminant < 0.0);
}

// A ray steeper than a cone is inside before the first root and after the second, one of each nappe.
fn nappe(a: f32, d: vec3f, roots: vec2f) -> vec2f {
    return select(roots, select(vec2f(-HUGE, roots.x), vec2f(roots.y, HUGE), d.z < 0.0), a < 0.0);
}

// A point of a primitive's surface, and the outward normal there, of any length, in the primitive's frame.
struct Face {
    p: vec3f,
    n: vec3f,
}

// The face that is nearest to p, and p on it.
fn face_at(half: vec3f, quadric: vec4f, p: vec3f) -> Face {
    let gradient = quadric_gradient(quadric, p);
    let round = abs(quadric_at(quadric, p)) / max(2.0 * length(gradient), 1e-30);
    let depth = abs(half - abs(p));
    let x = depth.x <= depth.y && depth.x <= depth.z;
    let y = !x && depth.y <= depth.z;
    let axis = vec3<bool>(x, y, !x && !y);
    let side = select(vec3f(-1.0), vec3f(1.0), p >= vec3f());
    if min(depth.x, min(depth.y, depth.z)) > round {
        return Face(p, gradient);
    }
    return Face(select(p, side * half, axis), select(vec3f(), side, axis));
}

// A ray's cross-section plane: what it meets is found there, where edges that triangles share are the very same.
struct Section {
    right: vec3f,
    up: vec3f,
}

fn section_of(d: vec3f) -> Section {
    let w = normalize(d);
    let right = normalize(select(vec3f(-w.z, 0.0, w.x), vec3f(0.0, w.z, -w.y), abs(w.y) + abs(w.z) > abs(w.x)));
    return Section(right, cross(w, right));
}

// Twice the areas that the ray through the section's origin cuts off a triangle, opposite a, b, c; all of one sign
// where it passes through. The corners are about the ray's origin.
fn cut_areas(section: Section, a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    let p = vec2f(dot(a, section.right), dot(a, section.up));
    let q = vec2f(dot(b, section.right), dot(b, section.up));
    let r = vec2f(dot(c, section.right), dot(c, section.up));
    return vec3f(q.x * r.y - q.y * r.x, r.x * p.y - r.y * p.x, p.x * q.y - p.y * q.x);
}

fn one_sign(areas: vec3f) -> bool {
    let least = min(areas.x, min(areas.y, areas.z));
    let greatest = max(areas.x, max(areas.y, areas.z));
    return (least >= 0.0 || greatest <= 0.0) && least != greatest;
}
