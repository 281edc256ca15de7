// A point light with a photometric file's intensities: bilinear in C and γ, as shares of the greatest.

struct WebLight {
    position: vec3f,
    // Angles γ, and planes C; 1 where all planes are alike.
    gammas: u32,
    // Axes of the light's frame, in the world.
    x_axis: vec3f,
    planes: u32,
    y_axis: vec3f,
    unused: u32,
    z_axis: vec3f,
    unused_too: u32,
}

@group(1) @binding(0) var<uniform> web_light: WebLight;

// The table holds the angles γ, then the planes C, radians; then the shares by planes.

fn web_respond(at: Shading) -> Response {
    let to_light = web_light.position - at.p;
    return falloff_response(to_light, web_intensity(-to_light), 2.0, at.n, at.r, at.lobe);
}

// The share in a direction away from the light, of any length.
fn web_intensity(direction: vec3f) -> f32 {
    let x = dot(web_light.x_axis, direction);
    let y = dot(web_light.y_axis, direction);
    let gamma = arctangent(length(vec2f(x, y)), -dot(web_light.z_axis, direction));
    let c = arctangent(y, x);
    return web_share(select(c, c + 2.0 * PI, c < 0.0), gamma);
}

fn web_share(c: f32, gamma: f32) -> f32 {
    let rows = web_light.gammas;
    if gamma < table_number(0) || gamma > table_number(rows - 1u) {
        return 0.0;
    }
    let row = web_place(0u, rows, gamma);
    let plane = web_place(rows, web_light.planes, c);
    let along = web_part(row, gamma);
    let first = rows + web_light.planes + (plane - rows) * rows + row;
    let here = mix(table_number(first), table_number(first + 1u), along);
    if web_light.planes == 1u {
        return here;
    }
    let next = mix(table_number(first + rows), table_number(first + rows + 1u), along);
    return mix(here, next, web_part(plane, c));
}

// Where in the table the piece begins that an angle is in, of `count` increasing angles from `first` on.
fn web_place(first: u32, count: u32, angle: f32) -> u32 {
    var low = first;
    var high = first + max(count, 2u) - 1u;
    while high - low > 1u {
        let middle = (low + high) / 2u;
        if table_number(middle) <= angle {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

// An angle's part of the piece that begins there.
fn web_part(place: u32, angle: f32) -> f32 {
    return clamp((angle - table_number(place)) / (table_number(place + 1u) - table_number(place)), 0.0, 1.0);
}
