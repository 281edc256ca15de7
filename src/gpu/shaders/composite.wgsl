// Light layers, weighed and summed to radiance and illuminance, with the emitters that are seen.

// As `light::luminance_of`.
const LUMINANCE = vec3f(0.21263901, 0.71516868, 0.07219232);

struct Composite {
    // Not the first batch: it adds to `before`, where the emitters are drawn already.
    adds: u32,
    emitter_count: u32,
    unused: vec2u,
    // Strength times tint of each layer; w is 1 where it has a shadow.
    weights: array<vec4f, 6>,
}

struct Reflectance {
    diffuse_over_pi: vec3f,
    specular: vec3f,
}

struct VisibleEmitter {
    // Polygon, disk: unit normal. Sphere: centre about the eye. Cap, sky: unit direction to its middle.
    vector: vec3f,
    // Sphere, disk: radius. Cap: sine of the half-angle.
    radius: f32,
    radiance: vec3f,
    two_sided: u32,
    // Among the vertices: the polygon's corners, the disk's centre, the sky's uniform and cosine parts.
    first: u32,
    count: u32,
    // Of a textured light, whose texels follow its corners; else 0.
    columns: u32,
    rows: u32,
    kind: u32,
}

const POLYGON = 0u;
const SPHERE = 1u;
const DISK = 2u;
const CAP = 3u;
const SKY = 4u;

@group(0) @binding(0) var positions: texture_2d<f32>;
@group(0) @binding(1) var normals: texture_2d<f32>;
@group(0) @binding(2) var<storage, read> reflectances: array<Reflectance>;
@group(0) @binding(3) var<storage, read> emitters: array<VisibleEmitter>;
@group(0) @binding(4) var<storage, read> emitter_vertices: array<vec4f>;
// Of each item that may be seen.
@group(0) @binding(5) var<storage, read> surfaces: array<u32>;

@group(1) @binding(0) var<uniform> composite_batch: Composite;
@group(1) @binding(1) var before: texture_2d<f32>;
@group(1) @binding(2) var layer_0: texture_2d<f32>;
@group(1) @binding(3) var layer_1: texture_2d<f32>;
@group(1) @binding(4) var layer_2: texture_2d<f32>;
@group(1) @binding(5) var layer_3: texture_2d<f32>;
@group(1) @binding(6) var layer_4: texture_2d<f32>;
@group(1) @binding(7) var layer_5: texture_2d<f32>;
@group(1) @binding(8) var shadow_0: texture_2d<f32>;
@group(1) @binding(9) var shadow_1: texture_2d<f32>;
@group(1) @binding(10) var shadow_2: texture_2d<f32>;
@group(1) @binding(11) var shadow_3: texture_2d<f32>;
@group(1) @binding(12) var shadow_4: texture_2d<f32>;
@group(1) @binding(13) var shadow_5: texture_2d<f32>;
// Of each surface, a bit for each layer that lights it.
@group(1) @binding(14) var<storage, read> reached: array<u32>;

// Radiance; w is the illuminance of the surface that is seen, -1 where none is.
@fragment
fn composite(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let at = vec2i(pixel.xy);
    let position = textureLoad(positions, at, 0);
    let emitter = emitter_seen(position);
    if emitter.w > 0.0 {
        return vec4f(emitter.xyz, -1.0);
    }
    if position.w == 0.0 {
        return vec4f(radiance_of_distant(normalize(position.xyz)), -1.0);
    }
    let reflectance = reflectances[u32(textureLoad(normals, at, 0).w)];
    let light = sum_of_layers(at);
    let radiance = reflectance.diffuse_over_pi * light.irradiance + reflectance.specular * light.specular;
    let sum = vec4f(radiance, dot(LUMINANCE, light.irradiance));
    return sum + select(vec4f(), textureLoad(before, at, 0), composite_batch.adds == 1u);
}

struct ColoredResponse {
    irradiance: vec3f,
    specular: vec3f,
}

fn sum_of_layers(at: vec2i) -> ColoredResponse {
    let linked = reached[surfaces[u32(textureLoad(positions, at, 0).w) - 1u]];
    let none = ColoredResponse(vec3f(), vec3f());
    let a = weighed(0u, linked, textureLoad(layer_0, at, 0), textureLoad(shadow_0, at, 0), none);
    let b = weighed(1u, linked, textureLoad(layer_1, at, 0), textureLoad(shadow_1, at, 0), a);
    let c = weighed(2u, linked, textureLoad(layer_2, at, 0), textureLoad(shadow_2, at, 0), b);
    let d = weighed(3u, linked, textureLoad(layer_3, at, 0), textureLoad(shadow_3, at, 0), c);
    let e = weighed(4u, linked, textureLoad(layer_4, at, 0), textureLoad(shadow_4, at, 0), d);
    return weighed(5u, linked, textureLoad(layer_5, at, 0), textureLoad(shadow_5, at, 0), e);
}

fn weighed(index: u32, linked: u32, response: vec4f, shadow: vec4f, sum: ColoredResponse) -> ColoredResponse {
    let weight = composite_batch.weights[index];
    let color = select(vec3f(), weight.xyz, ((linked >> index) & 1u) == 1u);
    let seen = response.xy * select(vec2f(1.0), share_seen(shadow), weight.w == 1.0);
    return ColoredResponse(sum.irradiance + color * seen.x, sum.specular + color * seen.y);
}

// Of E and of S, from the sums of `shadow.wgsl`. Where no ray says anything of S, it is as E; where none says anything
// at all, the light is seen.
fn share_seen(sums: vec4f) -> vec2f {
    let diffuse = select(1.0, sums.x / sums.y, sums.y > 0.0);
    return vec2f(diffuse, select(diffuse, sums.z / sums.w, sums.w > 0.0));
}

// Radiance of the nearest emitter in front of the surface; w is 1 where there is one. As `render::emitters`: what does
// not emit hides nothing, which is a one-sided polygon's back and a sphere's inside.
fn emitter_seen(position: vec4f) -> vec4f {
    let d = normalize(position.xyz);
    var nearest = select(3e38, length(position.xyz), position.w > 0.0);
    var seen = vec4f();
    for (var i = 0u; i < composite_batch.emitter_count; i++) {
        let emitter = emitters[i];
        var t = 0.0;
        switch emitter.kind {
            case SPHERE: {
                t = distance_to_sphere(emitter.vector, emitter.radius, d);
            }
            case DISK: {
                t = distance_to_disk(emitter, d);
            }
            case CAP, SKY: {}
            default: {
                t = distance_to_polygon(emitter, d);
            }
        }
        if t > 0.0 && t < nearest {
            let luminance = luminance_seen(emitter, t * d);
            if any(luminance > vec3f()) {
                nearest = t;
                seen = vec4f(emitter.radiance * luminance, 1.0);
            }
        }
    }
    return seen;
}

// The texel of a textured light at a point about the eye; 1 on any other emitter.
fn luminance_seen(emitter: VisibleEmitter, p: vec3f) -> vec3f {
    if emitter.columns == 0u {
        return vec3f(1.0);
    }
    // The corners run down the first column, then along the last row.
    let corner = emitter_vertices[emitter.first].xyz;
    let column = emitter_vertices[emitter.first + 1u].xyz - corner;
    let row = emitter_vertices[emitter.first + 3u].xyz - corner;
    let share = vec2f(dot(p - corner, row) / dot(row, row), dot(p - corner, column) / dot(column, column));
    let count = vec2u(emitter.columns, emitter.rows);
    let texel = min(vec2u(max(share, vec2f()) * vec2f(count)), count - 1u);
    return emitter_vertices[emitter.first + emitter.count + texel.y * count.x + texel.x].xyz;
}

fn distance_to_sphere(centre: vec3f, radius: f32, d: vec3f) -> f32 {
    let b = dot(centre, d);
    let apart = centre - b * d;
    let half_squared = radius * radius - dot(apart, apart);
    if half_squared < 0.0 {
        return 0.0;
    }
    return max(b - sqrt(half_squared), 0.0);
}

fn distance_to_disk(emitter: VisibleEmitter, d: vec3f) -> f32 {
    let toward = dot(emitter.vector, d);
    if abs(toward) < 1e-12 || (toward > 0.0 && emitter.two_sided == 0u) {
        return 0.0;
    }
    let center = emitter_vertices[emitter.first].xyz;
    let t = dot(emitter.vector, center) / toward;
    return select(0.0, t, length(t * d - center) < emitter.radius);
}

// Radiance of caps and skies in a direction in which nothing is nearer.
fn radiance_of_distant(d: vec3f) -> vec3f {
    var radiance = vec3f();
    for (var i = 0u; i < composite_batch.emitter_count; i++) {
        let emitter = emitters[i];
        let cosine = dot(emitter.vector, d);
        if emitter.kind == CAP && cosine > 0.0 && length(cross(emitter.vector, d)) <= emitter.radius {
            radiance += emitter.radiance;
        }
        if emitter.kind == SKY && cosine >= 0.0 {
            let parts = emitter_vertices[emitter.first];
            radiance += emitter.radiance * (parts.x + parts.y * cosine);
        }
    }
    return radiance;
}

// Even-odd rule in the polygon's plane, with its steepest axis left out.
fn distance_to_polygon(emitter: VisibleEmitter, d: vec3f) -> f32 {
    let toward = dot(emitter.vector, d);
    if abs(toward) < 1e-12 || (toward > 0.0 && emitter.two_sided == 0u) {
        return 0.0;
    }
    let t = dot(emitter.vector, emitter_vertices[emitter.first].xyz) / toward;
    let n = abs(emitter.vector);
    var inside = false;
    var a = planar(emitter_vertices[emitter.first + emitter.count - 1u].xyz - t * d, n);
    for (var i = 0u; i < emitter.count; i++) {
        let b = planar(emitter_vertices[emitter.first + i].xyz - t * d, n);
        if (a.y > 0.0) != (b.y > 0.0) {
            let x = a.x - a.y * (b.x - a.x) / (b.y - a.y);
            inside = inside != (x > 0.0);
        }
        a = b;
    }
    return select(0.0, t, inside);
}

fn planar(v: vec3f, n: vec3f) -> vec2f {
    if n.x >= n.y && n.x >= n.z {
        return v.yz;
    }
    return select(v.xy, v.xz, n.y >= n.z);
}
