// What every light shader works with.
//
// Positions are about the eye, or about any origin near p: a shading function subtracts p first, so that f32 holds what
// matters. Directions are unit vectors. Functions have the name and the meaning of their Rust twins in `shading`.

const PI = 3.14159265358979323846;
const HALF_PI = 1.57079632679489661923;

// A point to shade: position, unit normal, unit mirror direction, and its entry in `lobes`.
struct Shading {
    p: vec3f,
    n: vec3f,
    r: vec3f,
    lobe: u32,
}

// What the eye, at the origin, sees: `normal` holds the unit normal and the lobe's place.
fn shading_at(p: vec3f, normal: vec4f) -> Shading {
    let n = normal.xyz;
    let lobe = u32(normal.w);
    let v = -normalize(p);
    if lobes[lobe].model == LAFORTUNE {
        let along_normal = dot(n, v) * n;
        let q = lafortune_axis(lobe, v - along_normal, along_normal);
        return Shading(p, n, q * inverseSqrt(max(dot(q, q), 1e-30)), lobe);
    }
    return Shading(p, n, mirrored(v, n), lobe);
}

// The direction into which the unit direction v is mirrored.
fn mirrored(v: vec3f, n: vec3f) -> vec3f {
    return 2.0 * dot(n, v) * n - v;
}

// The axis of Lafortune's lobe, whose length raised to the exponent is its factor.
fn lafortune_axis(lobe: u32, tangential: vec3f, along_normal: vec3f) -> vec3f {
    return lobes[lobe].parameters.x * tangential + lobes[lobe].parameters.y * along_normal;
}

// What a unit-strength light does at a point; see the Rust type of that name.
struct Response {
    irradiance: f32,
    specular: f32,
}

// A material's lobe: exponent m, and what `shading::Lobe` and `gpu::lobes` know of it.
struct Lobe {
    exponent: f32,
    // The angle beyond which the Chebyshev fit is 0, and its tangent.
    chebyshev_cut: f32,
    chebyshev_tan_cut: f32,
    // Cells of the table of ∫cosᵐφ dφ a unit of its u.
    cosine_cells: f32,
    // PHONG, LAFORTUNE, BLINN or COOK_TORRANCE.
    model: u32,
    // Of the cosine lobe that is as wide.
    cosine_exponent: f32,
    // Lafortune: tangential and normal factor. Blinn: norm. Cook and Torrance: slope and reflectance.
    parameters: vec2f,
    // Coefficients of the powers of 2φ/cut − 1, the constant first, of the fit's mean from 0.
    chebyshev_mean: array<vec4f, 4>,
    // Cubics in the part of a cell.
    cosine_integral: array<vec4f, 64>,
}

// The first two are cosines about an axis.
const PHONG = 0u;
const LAFORTUNE = 1u;
const BLINN = 2u;
const COOK_TORRANCE = 3u;

@group(0) @binding(2) var<storage, read> lobes: array<Lobe>;

// Vertices of the light, or its cluster's points.
@group(1) @binding(1) var<storage, read> vertices: array<vec4f>;

fn light_vertex(i: u32) -> vec4f {
    return vertices[i];
}

// What else there is to know of the light; `gpu::table` makes it.
@group(1) @binding(2) var<storage, read> table: array<f32>;

fn table_number(i: u32) -> f32 {
    return table[i];
}

fn table_length() -> u32 {
    return arrayLength(&table);
}

// (m + 1) / 2π: what makes the lobe's integral over its hemisphere 1.
fn lobe_normalization(m: f32) -> f32 {
    return (m + 1.0) / (2.0 * PI);
}

// xᵐ, 0 for x ≤ 0.
fn power(x: f32, m: f32) -> f32 {
    return select(0.0, exp2(m * log2(max(x, 1e-37))), x > 0.0);
}

// ln(1 + x) for x > −1, as 2·artanh(x/(2 + x)) near 0.
fn log_one_plus(x: f32) -> f32 {
    let z = x / (2.0 + x);
    let s = z * z;
    let series = 2.0 * z * (1.0 + s * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s / 9.0))));
    return select(log(max(1.0 + x, 1e-37)), series, abs(x) < 0.4);
}

// max(0, r·w)ᵐ of unit vectors: near the peak from the sine, where the cosine has lost what a large m needs.
fn lobe_power(r: vec3f, w: vec3f, m: f32) -> f32 {
    let cosine = dot(r, w);
    if cosine < 0.7 {
        return power(cosine, m);
    }
    let sine = cross(r, w);
    return exp(0.5 * m * log_one_plus(-dot(sine, sine)));
}

// Arctangent of y/x in the right quadrant, within 3e-7 of itself; 0 where both are 0.
//
// atan(t) = π/8 + atan((t − tan π/8)/(1 + t·tan π/8)) brings t into |t| ≤ tan π/8, where Taylor's series to t¹³ leaves
// less than 1.3e-7.
fn arctangent(y: f32, x: f32) -> f32 {
    let ax = abs(x);
    let ay = abs(y);
    let greatest = max(ax, ay);
    if greatest == 0.0 {
        return 0.0;
    }
    let tan_eighth = 0.41421356237309504880;
    let t = min(ax, ay) / greatest;
    let steep = t > 0.25;
    let u = select(t, (t - tan_eighth) / (1.0 + t * tan_eighth), steep);
    let s = u * u;
    let tail = 1.0 / 7.0 - s * (1.0 / 9.0 - s * (1.0 / 11.0 - s * (1.0 / 13.0)));
    let series = u - u * s * (1.0 / 3.0 - s * (0.2 - s * tail));
    var angle = select(series, series + 0.39269908169872415481, steep);
    angle = select(angle, HALF_PI - angle, ay > ax);
    angle = select(angle, PI - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}

// Phong's ρ in the unit direction w, 1/sr.
fn phong_density(m: f32, r: vec3f, w: vec3f) -> f32 {
    return lobe_normalization(m) * lobe_power(r, w, m);
}

// ρ in the unit direction w, 1/sr; of Lafortune's lobe about its axis r, without its factor.
fn lobe_density(lobe: u32, n: vec3f, r: vec3f, w: vec3f) -> f32 {
    let m = lobes[lobe].exponent;
    let model = lobes[lobe].model;
    if model <= LAFORTUNE {
        return phong_density(m, r, w);
    }
    let sum = 2.0 * dot(n, r) * n - r + w;
    let h = sum * inverseSqrt(max(dot(sum, sum), 1e-30));
    let parameters = lobes[lobe].parameters;
    if model == BLINN {
        return parameters.x * lobe_power(n, h, m);
    }
    return cook_torrance(parameters.x, parameters.y, n, r, w, h);
}

// D·G·F/(4 n·v).
fn cook_torrance(slope: f32, reflectance: f32, n: vec3f, r: vec3f, w: vec3f, h: vec3f) -> f32 {
    let cos_h = dot(n, h);
    let cos_v = dot(n, r);
    let cos_w = dot(n, w);
    let cos_half = dot(w, h);
    if min(min(cos_h, cos_v), min(cos_w, cos_half)) <= 1e-15 {
        return 0.0;
    }
    let sine = cross(n, h);
    let square = cos_h * cos_h;
    let slope_square = slope * slope;
    let distribution = exp(-dot(sine, sine) / (square * slope_square)) / (PI * slope_square * square * square);
    let groove = 2.0 * cos_h / cos_half;
    let shadowing = min(min(1.0 / cos_v, groove), groove * cos_w / cos_v);
    let part = max(1.0 - cos_half, 0.0);
    let part_square = part * part;
    let fresnel = reflectance + (1.0 - reflectance) * part_square * part_square * part;
    return 0.25 * distribution * shadowing * fresnel;
}
