// The exact shadow of a linear light: what is seen of it, shaded by the closed forms. `line_part` is chosen when the shader
// is joined.

// What is seen and what there is: of E, then of S.
@fragment
fn shadow(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let place = vec2i(pixel.xy);
    let position = textureLoad(positions, place, 0);
    if position.w == 0.0 {
        return vec4f(1.0);
    }
    let at = shading_at(position.xyz, textureLoad(normals, place, 0));
    return line_shadow(at, shadow_light.place - at.p, shadow_light.row, u32(position.w) - 1u);
}

fn line_shadow(at: Shading, to_a: vec3f, along: vec3f, own: u32) -> vec4f {
    // What is above the horizon.
    let above_a = dot(at.n, to_a);
    let slope = dot(at.n, along);
    if max(above_a, above_a + slope) <= 0.0 {
        return vec4f();
    }
    let crossing = clamp(-above_a / select(slope, 1.0, slope == 0.0), 0.0, 1.0);
    let first = select(0.0, crossing, above_a < 0.0);
    let last = select(1.0, crossing, above_a + slope < 0.0);
    var seen = vec2f();
    var t = first;
    while t < last {
        let covers = covered(at.p, to_a, along, own, vec2f(t, last));
        while t < covers.known {
            let stretch = stretch_of_light(covers, t);
            if stretch.x == t {
                seen += line_part(at, to_a + t * along, to_a + stretch.y * along);
                t = stretch.y;
            } else {
                t = stretch.x;
            }
        }
    }
    let whole = line_part(at, to_a + first * along, to_a + last * along);
    return vec4f(seen.x, whole.x, seen.y, whole.y);
}

// E and S, without (m + 1)/2π, of a part of a line of falloff 2, above the horizon.
fn line_part_plain(at: Shading, a: vec3f, b: vec3f) -> vec2f {
    let part = line_above(line_frame(a, b), at.n);
    return vec2f(line_irradiance_plain(a, b, at.n), line_phong_plain(part, at.r, at.lobe));
}

// Of one of any falloff, or of a tube.
fn line_part_decaying(at: Shading, a: vec3f, b: vec3f) -> vec2f {
    let part = line_above(line_frame(a, b), at.n);
    let decay = line_decay(part, shadow_light.size, shadow_light.part);
    let specular = line_phong_of(part, at.r, lobes[at.lobe].exponent, decay.falloff);
    return decay.gain * vec2f(line_irradiance_of(part, at.n, decay.falloff), specular);
}

// Of any line, where some lobes are no cosines: S by points.
fn line_part_of_other_lobes(at: Shading, a: vec3f, b: vec3f) -> vec2f {
    let part = line_above(line_frame(a, b), at.n);
    let decay = line_decay(part, shadow_light.size, shadow_light.part);
    let path = line_path(part);
    var specular = 0.0;
    if part.length > 0.0 {
        for (var i = 0u; i < 2u * LINE_HALF_NODES; i++) {
            let node = LINE_NODES[i >> 1u];
            let growth = exp(0.5 * path.end * (1.0 + select(-node.x, node.x, (i & 1u) == 0u)));
            let up = path.alpha * growth;
            let down = path.beta / growth;
            let to_light = part.foot + (up - down) * part.axis;
            let density = lobe_density(at.lobe, at.n, at.r, normalize(to_light));
            specular += node.y * path.end * density * line_attenuation(up + down, decay.falloff);
        }
    }
    return decay.gain * vec2f(line_irradiance_of(part, at.n, decay.falloff), specular);
}
