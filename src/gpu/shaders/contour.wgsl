// A walk around what a horizon leaves of a polygon, which gives arcs one by one, with no list of clipped vertices.

// A run of `vertices`, seen from p, in a plane of that unit normal.
struct Corners {
    first: u32,
    count: u32,
    p: vec3f,
    normal: vec3f,
}

// Corner i about p; the first again after the last.
fn corner(corners: Corners, i: u32) -> vec3f {
    return light_vertex(corners.first + select(i, 0u, i == corners.count)).xyz - corners.p;
}

// A vector as scale·(whole/2²⁴ + rest), its greatest component from 1 to 2 times the scale, a power of two.
struct Fixed {
    scale: f32,
    unit: vec3f,
    whole: vec3i,
    rest: vec3f,
}

fn fixed(v: vec3f) -> Fixed {
    let greatest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    // From the exponent: a quotient need not be exact.
    let exponent = bitcast<u32>(clamp(greatest, 1e-30, 1e30)) & 0x7f800000u;
    let unit = v * bitcast<f32>(0x7f000000u - exponent);
    let whole = vec3i(unit * 16777216.0);
    return Fixed(bitcast<f32>(exponent), unit, whole, unit - vec3f(whole) * (1.0 / 16777216.0));
}

// a × b within 2⁻³⁸ |a||b|, where the plain product has 2⁻²⁴.
//
// Modulo 2⁻¹⁶ from products of integers, which wrap and so are exact, and which no driver reorders; which multiple of
// that is missing, the plain product knows.
fn precise_cross(a: Fixed, b: Fixed) -> vec3f {
    let whole = a.whole.yzx * b.whole.zxy - a.whole.zxy * b.whole.yzx;
    let rest = cross(a.rest, b.unit) + cross(a.unit - a.rest, b.rest);
    let low = vec3f(whole) * (1.0 / 281474976710656.0) + rest;
    let high = round((cross(a.unit, b.unit) - low) * 65536.0) * (1.0 / 65536.0);
    return a.scale * b.scale * (high + low);
}

// a · b likewise.
fn precise_dot(a: Fixed, b: Fixed) -> f32 {
    let product = a.whole * b.whole;
    let rest = dot(a.rest, b.unit) + dot(a.unit - a.rest, b.rest);
    let low = f32(product.x + product.y + product.z) * (1.0 / 281474976710656.0) + rest;
    let high = round((dot(a.unit, b.unit) - low) * 65536.0) * (1.0 / 65536.0);
    return a.scale * b.scale * (high + low);
}

// A unit vector along v.
fn direction_of(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1e-37));
}

// An arc of less than a half turn, right-handed about the unit normal of its plane.
struct Arc {
    begin: vec3f,
    to: vec3f,
    normal: vec3f,
    // Of the angle it subtends; 0 for no arc.
    sine: f32,
    // Whether it is a piece of the horizon.
    closes: bool,
    // The ends' heights above the walk's base, over their distances.
    latitude_from: f32,
    latitude_to: f32,
}

// What closes a contour along a horizon: crossings, joined two by two. Whichever are joined, what is covered twice
// cancels.
struct Closing {
    // The last crossing that has no partner yet, and whether the contour leaves there.
    open: bool,
    leaves: bool,
    crossing: vec3f,
    crossing_latitude: f32,
    // Two crossings to be joined.
    closes: bool,
    begin: vec3f,
    to: vec3f,
    latitude_from: f32,
    latitude_to: f32,
}

fn add_crossing(closing: ptr<function, Closing>, x: vec3f, latitude: f32, leaves: bool) {
    if (*closing).open {
        let first_leaves = (*closing).leaves;
        (*closing).open = false;
        (*closing).closes = true;
        (*closing).begin = select(x, (*closing).crossing, first_leaves);
        (*closing).to = select((*closing).crossing, x, first_leaves);
        (*closing).latitude_from = select(latitude, (*closing).crossing_latitude, first_leaves);
        (*closing).latitude_to = select((*closing).crossing_latitude, latitude, first_leaves);
    } else {
        (*closing).open = true;
        (*closing).leaves = leaves;
        (*closing).crossing = x;
        (*closing).crossing_latitude = latitude;
    }
}

// The piece of the horizon of n between two crossings, on the side of `ahead`.
fn closing_arc(closing: Closing, n: vec3f, ahead: vec3f) -> Arc {
    let begin = closing.begin;
    let to = closing.to;
    let turn = dot(n, cross(begin, to));
    let is_right = select(turn > 0.0, dot(cross(n, ahead), to - begin) > 0.0, dot(begin, to) < 0.0);
    let normal = select(-n, n, is_right);
    return Arc(begin, to, normal, abs(turn), true, closing.latitude_from, closing.latitude_to);
}

// A walk around what a horizon leaves of a polygon.
struct Walk {
    corners: Corners,
    n: vec3f,
    // A pole to measure latitudes from.
    base: Fixed,
    // The light's normal on the side away from p.
    ahead: vec3f,
    // The next edge, and where it starts.
    next: u32,
    a: vec3f,
    height: f32,
    latitude: f32,
    closing: Closing,
    // Whether an edge passes p by less than a fifth of its length.
    passes_near: bool,
}

fn walk_around(corners: Corners, n: vec3f, base: vec3f) -> Walk {
    let pole = fixed(base);
    let a = corner(corners, 0u);
    let ahead = select(-corners.normal, corners.normal, dot(corners.normal, a) > 0.0);
    let latitude = precise_dot(pole, fixed(a));
    return Walk(corners, n, pole, ahead, 0u, a, dot(n, a), latitude, Closing(), false);
}

fn walks_on(walk: Walk) -> bool {
    return walk.next < walk.corners.count || walk.closing.closes;
}

// The next arc.
fn next_arc(walk: ptr<function, Walk>, exactly: bool) -> Arc {
    if (*walk).closing.closes {
        (*walk).closing.closes = false;
        return closing_arc((*walk).closing, (*walk).n, (*walk).ahead);
    }
    let n = (*walk).n;
    let a = (*walk).a;
    let b = corner((*walk).corners, (*walk).next + 1u);
    let height_a = (*walk).height;
    let height_b = dot(n, b);
    let latitude_a = (*walk).latitude;
    let latitude_b = precise_dot((*walk).base, fixed(b));
    (*walk).next += 1u;
    (*walk).a = b;
    (*walk).height = height_b;
    (*walk).latitude = latitude_b;

    let side = b - a;
    let is_short = dot(side, side) < 0.25 * dot(a, a);
    var across = cross(a, side);
    if exactly {
        across = precise_cross(fixed(a), fixed(select(b, side, is_short)));
    }
    let square = dot(across, across);
    let reach = 0.2 * dot(side, side);
    (*walk).passes_near = (*walk).passes_near || square < reach * reach;
    let normal = direction_of(across);
    let inverse_a = inverseSqrt(max(dot(a, a), 1e-37));
    let inverse_b = inverseSqrt(max(dot(b, b), 1e-37));
    let above_a = height_a >= 0.0;
    let above_b = height_b >= 0.0;
    let exists = square > 0.0 && (above_a || above_b);
    let area = select(0.0, sqrt(square), exists);
    if above_a == above_b {
        let sine = area * inverse_a * inverse_b;
        return Arc(a * inverse_a, b * inverse_b, normal, sine, false, latitude_a * inverse_a, latitude_b * inverse_b);
    }
    // Next to p the crossing's direction is what matters, not its place.
    let share = height_a / (height_a - height_b);
    let place = a + share * side;
    var toward = direction_of(cross(n, normal));
    if exactly {
        toward = direction_of(precise_cross(fixed(n), fixed(normal)));
    }
    let is_near = dot(place, place) < 1e-2 * dot(side, side);
    let inverse_x = inverseSqrt(max(dot(place, place), 1e-37));
    let x = select(place * inverse_x, select(toward, -toward, above_a), is_near);
    let latitude = select(mix(latitude_a, latitude_b, share) * inverse_x, precise_dot((*walk).base, fixed(x)), is_near);
    var closing = (*walk).closing;
    add_crossing(&closing, x, latitude, above_a);
    (*walk).closing = closing;
    let begin = select(x, a * inverse_a, above_a);
    let to = select(b * inverse_b, x, above_a);
    let inverse = select((1.0 - share) * inverse_b, share * inverse_a, above_a) * inverse_x;
    let sine = select(area * inverse, max(dot(normal, cross(begin, to)), 0.0), is_near && exists);
    let latitude_from = select(latitude, latitude_a * inverse_a, above_a);
    let latitude_to = select(latitude_b * inverse_b, latitude, above_a);
    return Arc(begin, to, normal, sine, false, latitude_from, latitude_to);
}

// The part of an arc above the horizon of r.
fn lit_part(arc: Arc, r: vec3f, closing: ptr<function, Closing>) -> Arc {
    let z_from = dot(r, arc.begin);
    let z_to = dot(r, arc.to);
    let above_from = z_from >= 0.0;
    let above_to = z_to >= 0.0;
    if above_from == above_to || arc.sine <= 0.0 {
        var part = arc;
        part.sine = select(0.0, arc.sine, above_from);
        return part;
    }
    let share = z_from / (z_from - z_to);
    let place = mix(arc.begin, arc.to, share);
    let inverse = inverseSqrt(max(dot(place, place), 1e-37));
    let x = place * inverse;
    let latitude = mix(arc.latitude_from, arc.latitude_to, share) * inverse;
    add_crossing(closing, x, latitude, above_from);
    let sine = arc.sine * inverse * select(1.0 - share, share, above_from);
    return Arc(select(x, arc.begin, above_from), select(arc.to, x, above_from), arc.normal, sine, arc.closes,
        select(latitude, arc.latitude_from, above_from), select(arc.latitude_to, latitude, above_from));
}

fn angle_of(arc: Arc) -> f32 {
    return select(0.0, arctangent(arc.sine, dot(arc.begin, arc.to)), arc.sine > 0.0);
}

// A closed contour: the sum of its arcs' angles times their normals, and of their angles.
struct Contour {
    vector: vec3f,
    perimeter: f32,
}

fn add_arc(contour: ptr<function, Contour>, arc: Arc) {
    let angle = angle_of(arc);
    (*contour).vector += angle * arc.normal;
    (*contour).perimeter += angle;
}
