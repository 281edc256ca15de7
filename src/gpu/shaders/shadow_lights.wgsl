// Points of a light as rays look for them: drawn at random, or met in a direction.

// Of a textured light the table holds columns and rows of its cells and of its texels, the cells' sums and the texels.

// A point of a light.
struct LightPoint {
    // From p; a unit direction where the light is infinitely far.
    to_light: vec3f,
    // Towards p. 0 where no light is.
    luminance: f32,
    // 1 over the density, by solid angle, of the points drawn there.
    solid_angle: f32,
}

fn no_light() -> LightPoint {
    return LightPoint(vec3f(0.0, 0.0, 1.0), 0.0, 0.0);
}

// Flat lights: a rectangle, and how bright it is at shares of its sides.

fn polygon_draw(at: Shading, u: vec2f) -> LightPoint {
    return flat_point(at.p, u, polygon_luminance(u), 1.0);
}

fn polygon_meet(at: Shading, w: vec3f) -> LightPoint {
    let share = share_met(at.p, w);
    return flat_met(at.p, share, polygon_luminance(share.xy), 1.0);
}

fn disk_draw(at: Shading, u: vec2f) -> LightPoint {
    return flat_point(at.p, u, disk_luminance(u), 1.0);
}

fn disk_meet(at: Shading, w: vec3f) -> LightPoint {
    let share = share_met(at.p, w);
    return flat_met(at.p, share, disk_luminance(share.xy), 1.0);
}

fn textured_draw(at: Shading, u: vec2f) -> LightPoint {
    let drawn = textured_share(u);
    return flat_point(at.p, drawn.xy, textured_luminance(drawn.xy), drawn.z);
}

fn textured_meet(at: Shading, w: vec3f) -> LightPoint {
    let share = share_met(at.p, w);
    return flat_met(at.p, share, textured_luminance(share.xy), textured_density(share.xy));
}

// As large as it can look from p.
fn flat_solid_angle(p: vec3f) -> f32 {
    let to_middle = shadow_light.place + 0.5 * (shadow_light.row + shadow_light.column) - p;
    let area = length(cross(shadow_light.row, shadow_light.column));
    return min(area / max(dot(to_middle, to_middle), 1e-30), 2.0 * PI);
}

// `density` is that of the shares.
fn flat_point(p: vec3f, share: vec2f, luminance: f32, density: f32) -> LightPoint {
    let to_light = shadow_light.place + share.x * shadow_light.row + share.y * shadow_light.column - p;
    let square = max(dot(to_light, to_light), 1e-30);
    let toward = -dot(shadow_light.normal, to_light) * inverseSqrt(square);
    let cosine = select(max(toward, 0.0), abs(toward), shadow_light.two_sided == 1u);
    let area = length(cross(shadow_light.row, shadow_light.column));
    return LightPoint(to_light, select(0.0, luminance, cosine > 0.0), area * cosine / (square * density));
}

// The shares at which a ray meets the rectangle; z is 0 where it does not.
fn share_met(p: vec3f, w: vec3f) -> vec3f {
    let toward = dot(shadow_light.normal, w);
    let to_corner = shadow_light.place - p;
    let t = dot(shadow_light.normal, to_corner) / select(toward, 1e-20, abs(toward) < 1e-20);
    let at = t * w - to_corner;
    let row = shadow_light.row;
    let column = shadow_light.column;
    let share = vec2f(dot(at, row) / dot(row, row), dot(at, column) / dot(column, column));
    let is_met = t > 0.0 && all(share >= vec2f()) && all(share < vec2f(1.0));
    return select(vec3f(), vec3f(share, 1.0), is_met);
}

fn flat_met(p: vec3f, share: vec3f, luminance: f32, density: f32) -> LightPoint {
    var point = flat_point(p, share.xy, luminance, max(density, 1e-20));
    point.luminance *= share.z;
    return point;
}

// 1 inside, by the even-odd rule.
fn polygon_luminance(share: vec2f) -> f32 {
    var inside = false;
    var a = vertices[shadow_light.count - 1u].xy - share;
    for (var i = 0u; i < shadow_light.count; i++) {
        let b = vertices[i].xy - share;
        if (a.y > 0.0) != (b.y > 0.0) {
            inside = inside != (a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0);
        }
        a = b;
    }
    return select(0.0, 1.0, inside);
}

fn disk_luminance(share: vec2f) -> f32 {
    return select(0.0, 1.0, length(2.0 * share - 1.0) <= 1.0);
}

fn textured_luminance(share: vec2f) -> f32 {
    let cells = vec2u(u32(table[0]), u32(table[1]));
    let texels = vec2u(u32(table[2]), u32(table[3]));
    let texel = min(vec2u(share * vec2f(texels)), texels - 1u);
    return table[4u + cells.y * (cells.x + 1u) + texel.y * texels.x + texel.x];
}

// Shares drawn by what is in the cells, and their density. Before the cells of a row stands the sum of the rows to its
// end, before each cell the sum of the row to its end, both as shares.
fn textured_share(u: vec2f) -> vec3f {
    let cells = vec2u(u32(table[0]), u32(table[1]));
    let row = first_beyond(u.y, 4u, cells.x + 1u, cells.y);
    let first = 4u + row.index * (cells.x + 1u) + 1u;
    let column = first_beyond(u.x, first, 1u, cells.x);
    let share = (vec2f(f32(column.index), f32(row.index)) + vec2f(column.part, row.part)) / vec2f(cells);
    return vec3f(share, row.share * column.share * f32(cells.x * cells.y));
}

fn textured_density(share: vec2f) -> f32 {
    let cells = vec2u(u32(table[0]), u32(table[1]));
    let cell = min(vec2u(share * vec2f(cells)), cells - 1u);
    let first = 4u + cell.y * (cells.x + 1u) + 1u;
    let row = share_of(4u, cells.x + 1u, cell.y);
    return row * share_of(first, 1u, cell.x) * f32(cells.x * cells.y);
}

struct Drawn {
    index: u32,
    // Where in it, 0…1.
    part: f32,
    share: f32,
}

// The first of `count` rising sums, `stride` apart, that is beyond x.
fn first_beyond(x: f32, first: u32, stride: u32, count: u32) -> Drawn {
    var low = 0u;
    var high = count - 1u;
    while low < high {
        let middle = (low + high) / 2u;
        if table[first + middle * stride] > x {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    let share = share_of(first, stride, low);
    let before = table[first + low * stride] - share;
    return Drawn(low, clamp((x - before) / max(share, 1e-20), 0.0, 0.999999), share);
}

fn share_of(first: u32, stride: u32, index: u32) -> f32 {
    let before = select(0.0, table[first + (max(index, 1u) - 1u) * stride], index > 0u);
    return table[first + index * stride] - before;
}

// A sphere: all directions of the cone about it, or of the whole sphere from within.

fn sphere_draw(at: Shading, u: vec2f) -> LightPoint {
    let height = sphere_cone(at.p);
    let w = about(normalize(shadow_light.place - at.p + vec3f(0.0, 0.0, 1e-30)), height * u.x, u.y);
    return sphere_point(at.p, w, height);
}

fn sphere_meet(at: Shading, w: vec3f) -> LightPoint {
    return sphere_point(at.p, w, sphere_cone(at.p));
}

fn sphere_solid_angle(p: vec3f) -> f32 {
    return 2.0 * PI * sphere_cone(p);
}

// 1 − cos of the cone's half-angle.
fn sphere_cone(p: vec3f) -> f32 {
    let to_center = shadow_light.place - p;
    let sine_square = shadow_light.size * shadow_light.size / max(dot(to_center, to_center), 1e-30);
    return select(sine_square / (1.0 + sqrt(max(1.0 - sine_square, 0.0))), 2.0, sine_square >= 1.0);
}

fn sphere_point(p: vec3f, w: vec3f, height: f32) -> LightPoint {
    let to_center = shadow_light.place - p;
    let middle = dot(to_center, w);
    let apart = to_center - middle * w;
    let half_square = shadow_light.size * shadow_light.size - dot(apart, apart);
    let half = sqrt(max(half_square, 0.0));
    let t = select(middle - half, middle + half, height == 2.0);
    // The cone's own rim is met, however it rounds.
    let is_met = t > 0.0 && half_square > -1e-5 * shadow_light.size * shadow_light.size;
    return LightPoint(t * w, select(0.0, 1.0, is_met), 2.0 * PI * height);
}

// Infinitely far.

fn cap_draw(at: Shading, u: vec2f) -> LightPoint {
    return LightPoint(about(shadow_light.place, shadow_light.size * u.x, u.y), 1.0, 2.0 * PI * shadow_light.size);
}

fn cap_meet(at: Shading, w: vec3f) -> LightPoint {
    let apart = w - shadow_light.place;
    // 1 − cos of the angle between.
    let height = 0.5 * dot(apart, apart);
    return LightPoint(w, select(0.0, 1.0, height <= shadow_light.size), 2.0 * PI * shadow_light.size);
}

// By the cosine to the normal.
fn sky_draw(at: Shading, u: vec2f) -> LightPoint {
    return sky_meet(at, about(at.n, 1.0 - sqrt(1.0 - u.x), u.y));
}

fn sky_meet(at: Shading, w: vec3f) -> LightPoint {
    let cosine = dot(w, shadow_light.place);
    let luminance = select(0.0, shadow_light.size + shadow_light.part * cosine, cosine > 0.0);
    return LightPoint(w, luminance, PI / max(dot(w, at.n), 1e-6));
}

// Lights of no area.

fn point_draw(at: Shading, u: vec2f) -> LightPoint {
    return LightPoint(shadow_light.place - at.p, 1.0, 1.0);
}

fn directional_draw(at: Shading, u: vec2f) -> LightPoint {
    return LightPoint(shadow_light.place, 1.0, 1.0);
}

fn cap_solid_angle(p: vec3f) -> f32 {
    return 2.0 * PI * shadow_light.size;
}

fn sky_solid_angle(p: vec3f) -> f32 {
    return 2.0 * PI;
}

fn nothing_to_meet(at: Shading, w: vec3f) -> LightPoint {
    return no_light();
}

fn no_solid_angle(p: vec3f) -> f32 {
    return 0.0;
}

// The unit vector whose cosine to a unit axis is 1 − height, a share u of a turn about it.
fn about(axis: vec3f, height: f32, u: f32) -> vec3f {
    // [DUFF_2017], listing 3.
    let side = select(-1.0, 1.0, axis.z >= 0.0);
    let a = -1.0 / (side + axis.z);
    let b = axis.x * axis.y * a;
    let first = vec3f(1.0 + side * axis.x * axis.x * a, side * b, -side * axis.x);
    let second = vec3f(b, side + axis.y * axis.y * a, -axis.y);
    let sine = sqrt(max(height * (2.0 - height), 0.0));
    let turn = 2.0 * PI * u;
    return sine * (cos(turn) * first + sin(turn) * second) + (1.0 - height) * axis;
}
