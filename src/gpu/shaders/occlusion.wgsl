// Whether something stands between a point and a light: `visibility::Objects::hides` in f32.
//
// A surface is a shell: it hides what lies on its other side. What p lies on is known from the G-buffer, and counts as
// exactly under it; so does what p or the light is as near to as f32 can tell. Such a surface hides only what is behind
// its far side.

// The rounding of a coordinate that went through a few sums, as a share of the numbers that went in.
const ROUNDING = 6e-7;

// Farther than everything.
const FAR = 1e7;

// Whether something stands strictly between p and p + to_light; `own` is the item that p lies on.
fn hides(p: vec3f, to_light: vec3f, own: u32) -> bool {
    return hidden_by_primitives(p, to_light, own) || hidden_by_triangles(p, to_light, own);
}

// Whether something stands in a unit direction.
fn hides_direction(p: vec3f, direction: vec3f, own: u32) -> bool {
    return hides(p, FAR * direction, own);
}

fn hidden_by_primitives(p: vec3f, d: vec3f, own: u32) -> bool {
    var is_hidden = false;
    for (var i = 0u; i < occluders.always && !is_hidden; i++) {
        is_hidden = primitive_hides(i, p, d, i == own);
    }
    let inverse = inverse_of(d);
    var at = 0u;
    while at < occluders.primitive_nodes && !is_hidden {
        var item = 0u;
        while at < occluders.primitive_nodes && item == 0u {
            let is_met = meets(nodes[at], p, inverse, 1.0);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u {
            is_hidden = primitive_hides(item - 1u, p, d, item - 1u == own);
        }
    }
    return is_hidden;
}

fn hidden_by_triangles(p: vec3f, d: vec3f, own: u32) -> bool {
    let inverse = inverse_of(d);
    let section = section_of(d);
    var is_hidden = false;
    var at = occluders.primitive_nodes;
    while at < occluders.nodes && !is_hidden {
        var item = 0u;
        while at < occluders.nodes && item == 0u {
            let is_met = meets(nodes[at], p, inverse, 1.0);
            item = select(0u, nodes[at].item, is_met);
            at = select(nodes[at].skip, at + 1u, is_met);
        }
        if item > 0u && item - 1u != own {
            is_hidden = triangle_hides(item - 1u - occluders.primitives, p, d, section);
        }
    }
    return is_hidden;
}

fn primitive_hides(i: u32, p: vec3f, to_light: vec3f, is_own: bool) -> bool {
    let quadric = primitives[i].quadric;
    let half = primitives[i].half;
    let start = onto_faces(half, quadric, local_point(i, p), local_rounding(i, p), is_own);
    let end = onto_faces(half, quadric, local_point(i, p + to_light), local_rounding(i, p + to_light), false);
    let d = end.p - start.p;
    let span = both(span_of_slabs(half, start.p, d), span_of_quadric(quadric, start.p, d, start.on_quadric));
    let crossing = select(span.y, span.x, span.x > 0.0);
    return span.x <= span.y && crossing > 0.0 && crossing < 1.0 - ROUNDING;
}

fn local_point(i: u32, p: vec3f) -> vec3f {
    return primitives[i].local_from_world * (p - primitives[i].origin);
}

// What may be wrong with a local point.
fn local_rounding(i: u32, p: vec3f) -> vec3f {
    let m = primitives[i].local_from_world;
    return ROUNDING * (mat3x3f(abs(m[0]), abs(m[1]), abs(m[2])) * (abs(p) + abs(primitives[i].origin)));
}

// A local point, on the faces that it is as near to as rounding can tell.
struct Snapped {
    p: vec3f,
    on_quadric: bool,
}

fn onto_faces(half: vec3f, quadric: vec4f, p: vec3f, rounding: vec3f, is_own: bool) -> Snapped {
    let depth = abs(half - abs(p));
    let least = min(depth.x, min(depth.y, depth.z));
    let round = 2.0 * least * length(quadric_gradient(quadric, p));
    let on_quadric = is_own && abs(quadric_at(quadric, p)) < round;
    // Of what p lies on, the nearest face is under it however far off rounding has it.
    let reach = select(rounding, max(rounding, vec3f(least)), is_own && !on_quadric);
    return Snapped(select(p, select(-half, half, p >= vec3f()), depth <= reach), on_quadric);
}

fn triangle_hides(i: u32, p: vec3f, d: vec3f, section: Section) -> bool {
    let a = triangles[i].a - p;
    let b = triangles[i].b - p;
    let c = triangles[i].c - p;
    let n = cross(triangles[i].b - triangles[i].a, triangles[i].c - triangles[i].a);
    let here = dot(n, a);
    let there = here - dot(n, d);
    let rounding = ROUNDING * dot(abs(n), abs(p) + abs(triangles[i].a));
    let is_between = min(abs(here), abs(there)) > rounding && (here > 0.0) != (there > 0.0);
    return is_between && one_sign(cut_areas(section, a, b, c));
}
