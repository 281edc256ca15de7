// What the camera sees: rays against primitives and triangles, in one full-screen pass.
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
    unused: vec2u,
}

@group(0) @binding(0) var<uniform> camera: Camera;

struct GBuffer {
    // Position about the eye; item + 1, 0 where nothing is seen.
    @location(0) position: vec4f,
    // Unit normal towards the eye; material.
    @location(1) normal: vec4f,
}

// The nearest item so far: distance, and item + 1, 0 where there is none.
struct Nearest {
    t: f32,
    item: u32,
}

@fragment
fn gbuffer(@builtin(position) pixel: vec4f) -> GBuffer {
    let d = ray_direction(pixel.xy + camera.jitter);
    let nearest = nearest_triangle(d, nearest_primitive(d));
    if nearest.item == 0u {
        // The direction stands in for the position: emitters behind everything are found by it.
        return GBuffer(vec4f(d, 0.0), vec4f());
    }
    let seen = seen_at(d, nearest);
    let n = select(-seen.normal.xyz, seen.normal.xyz, dot(seen.normal.xyz, d) < 0.0);
    return GBuffer(vec4f(seen.position.xyz, f32(nearest.item)), vec4f(n, seen.normal.w));
}

fn ray_direction(pixel: vec2f) -> vec3f {
    let x = (2.0 * pixel.x - camera.width) / camera.height * camera.tan_half;
    let y = (1.0 - 2.0 * pixel.y / camera.height) * camera.tan_half;
    return normalize(x * camera.right + y * camera.up - camera.back);
}

fn nearest_primitive(d: vec3f) -> Nearest {
    var nearest = Nearest(HUGE, 0u);
    for (var i = 0u; i < occluders.always; i++) {
        nearest = nearer(nearest, distance_of_primitive(i, d), i + 1u);
    }
    let inverse = inverse_of(d);
    var at = 0u;
    while at < occluders.primitive_nodes {
        // To the next leaf, then what it holds: a device that runs several rays at once finds all their leaves first.
        var item = 0u;
        while at < occluders.primitive_nodes && item == 0u {
            let is_met = meets(nodes[at], vec3f(), inverse, nearest.t);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u {
            nearest = nearer(nearest, distance_of_primitive(item - 1u, d), item);
        }
    }
    return nearest;
}

fn nearest_triangle(d: vec3f, first: Nearest) -> Nearest {
    var nearest = first;
    let inverse = inverse_of(d);
    let section = section_of(d);
    var at = occluders.primitive_nodes;
    while at < occluders.nodes {
        var item = 0u;
        while at < occluders.nodes && item == 0u {
            let is_met = meets(nodes[at], vec3f(), inverse, nearest.t);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u {
            nearest = nearer(nearest, distance_of_triangle(item - 1u - occluders.primitives, d, section), item);
        }
    }
    return nearest;
}

fn nearer(nearest: Nearest, t: f32, item: u32) -> Nearest {
    if t > 0.0 && t < nearest.t {
        return Nearest(t, item);
    }
    return nearest;
}

// Negative where it is missed.
fn distance_of_primitive(i: u32, direction: vec3f) -> f32 {
    let d = primitives[i].local_from_world * direction;
    let o = primitives[i].eye_local;
    let span = both(span_of_slabs(primitives[i].half, o, d), span_of_quadric(primitives[i].quadric, o, d, false));
    return select(select(span.y, span.x, span.x > 0.0), -1.0, span.x > span.y);
}

fn distance_of_triangle(i: u32, d: vec3f, section: Section) -> f32 {
    let a = triangles[i].a;
    let b = triangles[i].b;
    let c = triangles[i].c;
    let areas = cut_areas(section, a, b, c);
    let sum = areas.x + areas.y + areas.z;
    let t = dot(areas, vec3f(dot(a, d), dot(b, d), dot(c, d))) / select(sum, 1.0, sum == 0.0);
    return select(-1.0, t, one_sign(areas));
}

// Position, and normal and material, of what is seen.
fn seen_at(d: vec3f, nearest: Nearest) -> GBuffer {
    let item = nearest.item - 1u;
    if item < occluders.primitives {
        let primitive = primitives[item];
        let local_d = primitive.local_from_world * d;
        // From where the ray passes the primitive's centre: a far eye then costs no digits.
        let to_center = -dot(primitive.eye_local, local_d) / dot(local_d, local_d);
        let p = (primitive.eye_local + to_center * local_d) + (nearest.t - to_center) * local_d;
        let face = face_at(primitive.half, primitive.quadric, p);
        let position = primitive.world_from_local * face.p + primitive.origin;
        return GBuffer(
            vec4f(position, 0.0),
            vec4f(normalize(face.n * primitive.local_from_world), f32(primitive.material)),
        );
    }
    let triangle = triangles[item - occluders.primitives];
    let areas = cut_areas(section_of(d), triangle.a, triangle.b, triangle.c);
    let shares = areas / (areas.x + areas.y + areas.z);
    let position = shares.x * triangle.a + shares.y * triangle.b + shares.z * triangle.c;
    let n = shares.x * triangle.normal_a + shares.y * triangle.normal_b + shares.z * triangle.normal_c;
    return GBuffer(vec4f(position, 0.0), vec4f(normalize(n), f32(triangle.material)));
}
