// What the camera sees: rays against the primitives, in one full-screen pass.
//
// Positions are about the eye.

struct Camera {
    right: vec3f,
    // Tangent of half the vertical field of view.
    tan_half: f32,
    up: vec3f,
    width: f32,
    back: vec3f,
    height: f32,
    // From the pixel's centre, in pixels.
    jitter: vec2f,
    primitive_count: u32,
    unused: u32,
}

struct Primitive {
    local_from_world: mat3x3f,
    world_from_local: mat3x3f,
    // The eye in the primitive's frame, and its kind.
    eye_local: vec3f,
    kind: u32,
    // The primitive's origin about the eye, and its material.
    origin: vec3f,
    material: u32,
    // Half edges; or radius and half height.
    size: vec3f,
    unused: u32,
}

const PLANE = 0u;
const SPHERE = 1u;
const BOX = 2u;
const SQUARE = 3u;
const DISK = 4u;
const CYLINDER = 5u;
const CONE = 6u;

const MISS = -1.0;

@group(0) @binding(0) var<uniform> camera: Camera;
@group(0) @binding(1) var<storage, read> primitives: array<Primitive>;

// Distance along the ray in units of its direction, MISS where there is none; position and normal in the same frame.
struct Hit {
    t: f32,
    p: vec3f,
    n: vec3f,
}

struct GBuffer {
    // Position about the eye; surface + 1, 0 where nothing is seen.
    @location(0) position: vec4f,
    // Unit normal towards the eye; material.
    @location(1) normal: vec4f,
}

@fragment
fn gbuffer(@builtin(position) pixel: vec4f) -> GBuffer {
    let d = ray_direction(pixel.xy + camera.jitter);
    var nearest = Hit(MISS, vec3f(), vec3f());
    var surface = 0u;
    for (var i = 0u; i < camera.primitive_count; i++) {
        let hit = intersect_in_world(i, d);
        if hit.t > 0.0 && (nearest.t < 0.0 || hit.t < nearest.t) {
            nearest = hit;
            surface = i + 1u;
        }
    }
    if surface == 0u {
        // The direction stands in for the position: emitters behind everything are found by it.
        return GBuffer(vec4f(d, 0.0), vec4f());
    }
    let n = select(-nearest.n, nearest.n, dot(nearest.n, d) < 0.0);
    return GBuffer(vec4f(nearest.p, f32(surface)), vec4f(n, f32(primitives[surface - 1u].material)));
}

fn ray_direction(pixel: vec2f) -> vec3f {
    let x = (2.0 * pixel.x - camera.width) / camera.height * camera.tan_half;
    let y = (1.0 - 2.0 * pixel.y / camera.height) * camera.tan_half;
    return normalize(x * camera.right + y * camera.up - camera.back);
}

fn intersect_in_world(index: u32, direction: vec3f) -> Hit {
    let primitive = primitives[index];
    let hit = intersect(primitive.kind, primitive.size, primitive.eye_local, primitive.local_from_world * direction);
    return Hit(
        hit.t,
        primitive.world_from_local * hit.p + primitive.origin,
        normalize(hit.n * primitive.local_from_world),
    );
}

// Nearest hit in the primitive's frame.
fn intersect(kind: u32, size: vec3f, origin: vec3f, d: vec3f) -> Hit {
    if kind == PLANE || kind == SQUARE || kind == DISK {
        return intersect_flat(kind, size, origin, d);
    }
    // Start where the ray passes the primitive's centre: a far eye then costs no digits.
    let to_centre = -dot(origin, d) / dot(d, d);
    let o = origin + to_centre * d;
    var span = vec2f(1.0, -1.0);
    switch kind {
        case SPHERE: { span = span_of_sphere(size.x, o, d); }
        case BOX: { span = span_of_box(size, o, d); }
        case CYLINDER: { span = span_of_cylinder(size.x, size.y, o, d); }
        default: { span = span_of_cone(size.x, size.y, o, d); }
    }
    if span.x > span.y {
        return Hit(MISS, vec3f(), vec3f());
    }
    let t = select(span.y, span.x, to_centre + span.x > 0.0);
    let p = o + t * d;
    return Hit(to_centre + t, p, normal_at(kind, size, p));
}

fn intersect_flat(kind: u32, size: vec3f, origin: vec3f, d: vec3f) -> Hit {
    if d.z == 0.0 {
        return Hit(MISS, vec3f(), vec3f());
    }
    let t = -origin.z / d.z;
    let p = vec3f(origin.xy + t * d.xy, 0.0);
    let outside = (kind == SQUARE && (abs(p.x) > size.x || abs(p.y) > size.y))
        || (kind == DISK && dot(p.xy, p.xy) > size.x * size.x);
    return Hit(select(t, MISS, outside), p, vec3f(0.0, 0.0, 1.0));
}

// The solids are convex: each is the ray's span between entry and exit, empty where entry > exit.
const EMPTY = vec2f(1.0, -1.0);
const HUGE = 1e30;

// The sphere's closest approach to the ray is at t = 0.
fn span_of_sphere(radius: f32, o: vec3f, d: vec3f) -> vec2f {
    let half_squared = radius * radius - dot(o, o);
    if half_squared < 0.0 {
        return EMPTY;
    }
    let half = sqrt(half_squared / dot(d, d));
    return vec2f(-half, half);
}

fn span_of_slab(half: f32, o: f32, d: f32) -> vec2f {
    if abs(d) < 1e-20 {
        return select(EMPTY * HUGE, vec2f(-HUGE, HUGE), abs(o) <= half);
    }
    let a = (-half - o) / d;
    let b = (half - o) / d;
    return vec2f(min(a, b), max(a, b));
}

fn both(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(max(a.x, b.x), min(a.y, b.y));
}

fn span_of_box(half: vec3f, o: vec3f, d: vec3f) -> vec2f {
    return both(both(span_of_slab(half.x, o.x, d.x), span_of_slab(half.y, o.y, d.y)), span_of_slab(half.z, o.z, d.z));
}

fn span_of_cylinder(radius: f32, half_height: f32, o: vec3f, d: vec3f) -> vec2f {
    let a = dot(d.xy, d.xy);
    let c = dot(o.xy, o.xy) - radius * radius;
    var side = vec2f(-HUGE, HUGE);
    if a < 1e-20 {
        if c > 0.0 {
            return EMPTY;
        }
    } else {
        let b = dot(o.xy, d.xy);
        let discriminant = b * b - a * c;
        if discriminant < 0.0 {
            return EMPTY;
        }
        let root = sqrt(discriminant);
        side = vec2f(-b - root, -b + root) / a;
    }
    return both(side, span_of_slab(half_height, o.z, d.z));
}

// Between base and apex only the lower nappe of x² + y² = k²(h − z)² counts.
fn span_of_cone(radius: f32, half_height: f32, o: vec3f, d: vec3f) -> vec2f {
    let k = radius / (2.0 * half_height);
    let w = half_height - o.z;
    let a = dot(d.xy, d.xy) - k * k * d.z * d.z;
    let b = dot(o.xy, d.xy) + k * k * w * d.z;
    let c = dot(o.xy, o.xy) - k * k * w * w;
    let slab = span_of_slab(half_height, o.z, d.z);
    let discriminant = b * b - a * c;
    if discriminant < 0.0 {
        return EMPTY;
    }
    // Roots without cancellation: q/a and c/q.
    let q = -(b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant));
    if abs(q) < 1e-30 {
        return EMPTY;
    }
    let near = c / q;
    let far = select(HUGE, q / a, abs(a) > 1e-20);
    let roots = vec2f(min(near, far), max(near, far));
    if a > 0.0 {
        return both(roots, slab);
    }
    // A ray steeper than the side is inside before the first root and after the second, one of each nappe.
    let lower = select(vec2f(-HUGE, roots.x), vec2f(roots.y, HUGE), d.z < 0.0);
    return both(lower, slab);
}

// Outward normal, of any length, at a point on the surface of a solid.
fn normal_at(kind: u32, size: vec3f, p: vec3f) -> vec3f {
    if kind == SPHERE {
        return p;
    }
    if kind == BOX {
        // The face that the point is nearest to.
        let depth = abs(p) - size;
        let x = depth.x >= depth.y && depth.x >= depth.z;
        let y = !x && depth.y >= depth.z;
        return sign(p) * vec3f(f32(x), f32(y), f32(!x && !y));
    }
    let cap = abs(p.z) - size.y;
    if kind == CYLINDER {
        return select(vec3f(p.xy, 0.0), vec3f(0.0, 0.0, sign(p.z)), cap > length(p.xy) - size.x);
    }
    let k = size.x / (2.0 * size.y);
    let side = (length(p.xy) - k * (size.y - p.z)) / sqrt(1.0 + k * k);
    let slant = vec3f(p.xy, k * k * (size.y - p.z));
    return select(slant, vec3f(0.0, 0.0, -1.0), -p.z - size.y > side);
}
