// A disk light of unit luminance, which a point sees as the directions within an elliptic cone.

struct DiskLight {
    center: vec3f,
    radius: f32,
    // Of the lit side.
    normal: vec3f,
    two_sided: u32,
}

@group(1) @binding(0) var<uniform> disk_light: DiskLight;

fn disk_respond_exact(at: Shading) -> Response {
    let to_center = disk_light.center - at.p;
    if disk_light.two_sided == 0u && dot(disk_light.normal, to_center) >= 0.0 {
        return Response(0.0, 0.0);
    }
    let cone = cone_of_disk(to_center, disk_light.normal, disk_light.radius);
    let specular = disk_cone_phong(cone, at.n, at.r, lobes[at.lobe].exponent);
    return Response(disk_cone_irradiance(cone, at.n), specular);
}

fn disk_irradiance(to_center: vec3f, normal: vec3f, radius: f32, n: vec3f) -> f32 {
    return disk_cone_irradiance(cone_of_disk(to_center, normal, radius), n);
}

fn disk_phong(to_center: vec3f, normal: vec3f, radius: f32, n: vec3f, r: vec3f, m: f32) -> f32 {
    return disk_cone_phong(cone_of_disk(to_center, normal, radius), n, r, m);
}

// The directions in (X/tan α)² + (Y/tan β)² < Z², Z > 0, in axes of its own; α ≤ β. In the disk's plane sin α is 0.
struct DiskCone {
    x_axis: vec3f,
    y_axis: vec3f,
    z_axis: vec3f,
    sin_a: f32,
    cos_a: f32,
    sin_b: f32,
    cos_b: f32,
}

fn cone_of_disk(to_center: vec3f, normal: vec3f, radius: f32) -> DiskCone {
    let signed_height = exact_dot(normal, to_center);
    let ahead = select(normal, -normal, signed_height < 0.0);
    let height = abs(signed_height);
    let rest = to_center - signed_height * normal;
    // Twice, because what is left near the axis has lost its direction.
    let lateral = rest - dot(rest, normal) * normal;
    let aside = length(lateral);
    let gap = gap_squared(to_center, radius);
    // aside − radius; near the plane, where p may be close to the rim, as what the height leaves of |to_center|² − radius².
    let beyond =
        select((gap - height * height) / (aside + radius), aside - radius, height > 0.1 * (aside + radius));
    let l_1 = sqrt(beyond * beyond + height * height);
    let l_2 = sqrt((aside + radius) * (aside + radius) + height * height);
    let product = l_1 * l_2;
    if height <= 1e-18 * l_2 || product == 0.0 {
        return DiskCone(vec3f(), vec3f(), ahead, 0.0, 1.0, 0.0, 1.0);
    }
    var across = lateral / max(aside, 1e-30);
    if aside < 1e-6 * l_2 {
        across = normalize(select(vec3f(0.0, ahead.z, -ahead.y), vec3f(-ahead.y, ahead.x, 0.0), abs(ahead.z) < 0.7));
    }
    let sin_2a = 2.0 * radius / l_1 * (height / l_2);
    let cos_2a = gap / product;
    let sum = vec2f(beyond / l_1 + (aside + radius) / l_2, height / l_1 + height / l_2);
    let difference = vec2f((aside + radius) / l_2 - beyond / l_1, height / l_2 - height / l_1);
    var sin_a = sqrt(0.5 * max(1.0 - cos_2a, 0.0));
    var cos_a = sqrt(0.5 * max(1.0 + cos_2a, 0.0));
    var z = vec2f();
    if cos_2a >= 0.0 {
        sin_a = 0.5 * sin_2a / cos_a;
        z = normalize(sum);
    } else {
        cos_a = 0.5 * sin_2a / sin_a;
        let x = normalize(difference);
        z = vec2f(-x.y, x.x);
    }
    let narrow = sqrt(product) * cos_a;
    let slant = sqrt(radius * radius + narrow * narrow);
    return DiskCone(
        z.y * across - z.x * ahead, cross(ahead, across), z.x * across + z.y * ahead,
        sin_a, cos_a, radius / slant, narrow / slant,
    );
}

// a·b, which keeps its digits where the terms cancel: as `gap_squared`, with the whole parts' products as integers.
fn exact_dot(a: vec3f, b: vec3f) -> f32 {
    let scale_a = twelve_bits(max(abs(a.x), max(abs(a.y), abs(a.z))));
    let scale_b = twelve_bits(max(abs(b.x), max(abs(b.y), abs(b.z))));
    let whole_a = floor(a * scale_a);
    let whole_b = floor(b * scale_b);
    let rest_a = a * scale_a - whole_a;
    let rest_b = b * scale_b - whole_b;
    let integers = vec3i(whole_a) * vec3i(whole_b);
    let parts = dot(whole_a, rest_b) + dot(rest_a, whole_b + rest_b);
    return (f32(integers.x + integers.y + integers.z) + parts) / scale_a / scale_b;
}

// The power of two that brings numbers up to `greatest` within 12 bits before the point.
fn twelve_bits(greatest: f32) -> f32 {
    return 2048.0 / bitcast<f32>(max(bitcast<u32>(greatest) & 0x7f800000u, 0x10000000u));
}

fn disk_local(cone: DiskCone, v: vec3f) -> vec3f {
    return vec3f(dot(v, cone.x_axis), dot(v, cone.y_axis), dot(v, cone.z_axis));
}

const DISK_ABOVE = 0u;
const DISK_BELOW = 1u;
const DISK_ACROSS = 2u;

// How a horizon lies to the rim: where it cuts it, along the chord cos(t − τ) = cos γ of the unit disk.
struct DiskCut {
    kind: u32,
    // cos τ and sin τ.
    axis: vec2f,
    amplitude: f32,
    // sin γ and cos γ.
    sin_gamma: f32,
    cos_gamma: f32,
}

fn disk_cut(cone: DiskCone, n: vec3f) -> DiskCut {
    let across = vec2f(cone.sin_a * cone.cos_b * n.x, cone.cos_a * cone.sin_b * n.y);
    let z = cone.cos_a * cone.cos_b * n.z;
    // Scaled, so that its square stays inside the range of f32.
    let greatest = max(max(abs(across.x), abs(across.y)), 1e-30);
    let amplitude = greatest * length(across / greatest);
    if z >= amplitude {
        return DiskCut(DISK_ABOVE, vec2f(), amplitude, 0.0, -1.0);
    }
    if z <= -amplitude {
        return DiskCut(DISK_BELOW, vec2f(), amplitude, 0.0, 1.0);
    }
    let ratio = -z / amplitude;
    return DiskCut(DISK_ACROSS, across / amplitude, amplitude, sqrt((1.0 - ratio) * (1.0 + ratio)), ratio);
}

fn disk_cone_irradiance(cone: DiskCone, n: vec3f) -> f32 {
    let local = disk_local(cone, n);
    let cut = disk_cut(cone, local);
    if cone.sin_a == 0.0 || cut.kind == DISK_BELOW {
        return 0.0;
    }
    if cut.kind == DISK_ABOVE {
        return PI * cone.sin_a * cone.sin_b * local.z;
    }
    return max(disk_clipped_irradiance(cone, local, cut), 0.0);
}

// The two forms of `shading::disk::disk_irradiance` where the horizon cuts the disk.
fn disk_clipped_irradiance(cone: DiskCone, n: vec3f, cut: DiskCut) -> f32 {
    let sin_a = cone.sin_a;
    let cos_a = cone.cos_a;
    let sin_b = cone.sin_b;
    let cos_b = cone.cos_b;
    let tau = abs(cut.axis);
    let sine = cut.sin_gamma;
    let square = sine * sine;
    var e_squared = (sin_b - sin_a) * (sin_b + sin_a);
    if cos_a < sin_a {
        e_squared = (cos_a - cos_b) * (cos_a + cos_b);
    }
    let e = max(sqrt(max(e_squared, 0.0)), 1e-10);
    let wide = sin_b * cos_a;
    let narrow = sin_a * cos_b;
    let cosines = cos_a * cos_b;
    let foot = cosines * cosines + narrow * narrow * tau.x * tau.x + wide * wide * tau.y * tau.y;
    let chord_dot = foot - (narrow * narrow + wide * wide) * square;
    let u_dot = foot - e_squared * square;
    let w_dot = foot + e_squared * square;
    var delta = arctangent(2.0 * cosines * sine * cut.cos_gamma, foot - (cos_a * cos_a + cos_b * cos_b) * square);
    delta = select(delta, delta + 2.0 * PI, delta < 0.0);
    let swept = sin_a * sin_b * n.z * delta;
    let chord_cross = sin_a * sin_b * cosines * (cosines / cut.amplitude);
    let u_cross = 2.0 * e * cos_b * tau.x * sine;
    let w = min(2.0 * e * cos_a * tau.y * sine / w_dot, 1.0 - 1e-7);
    let u_factor = wide * cos_a * abs(n.x) / e;
    let w_factor = narrow * cos_b * abs(n.y) / e;
    if sin_b * wide < narrow * cos_b {
        let cubic = cut.cos_gamma * cut.cos_gamma
            + 2.0 * square * cosines * cosines * (tau.x * tau.x / u_dot + tau.y * tau.y / w_dot);
        let linear = 2.0 * sin_a * sin_b * cut.amplitude * sine * cubic / chord_dot;
        let excess = u_factor * atan_deficit(u_cross / u_dot) - atan_deficit(2.0 * chord_cross * sine / chord_dot);
        return 0.5 * (linear + swept + excess - w_factor * artanh_excess(w));
    }
    let apart = narrow * narrow
        * (cosines * cosines + wide * wide * cut.cos_gamma * cut.cos_gamma - e_squared * tau.x * tau.x)
        / (chord_cross + e * cos_b * tau.x);
    let numerator = 2.0 * sine * (2.0 * chord_cross * narrow * narrow * square + chord_dot * apart);
    let difference = arctangent(numerator, chord_dot * u_dot + 2.0 * chord_cross * sine * u_cross);
    let e_chord = e * sin_a * sin_b / cut.amplitude;
    let across = cos_b * tau.y;
    let up = sin_b * cut.cos_gamma;
    let q = wide * wide * (wide - cos_b) * (wide + cos_b) * tau.x * tau.x + e_squared * (across * across + up * up);
    let rest = sin_a * sin_a * q / (cos_a * cos_a * cos_b * e_chord * (e_chord * cos_b + wide * wide * tau.x));
    return 0.5 * (difference + rest * arctangent(u_cross, u_dot) + swept - w_factor * artanh(w));
}

fn artanh(x: f32) -> f32 {
    return 0.5 * log_one_plus(2.0 * x / (1.0 - x));
}

// x − atan x.
fn atan_deficit(x: f32) -> f32 {
    return select(disk_cubic_series(x, -x * x), x - arctangent(x, 1.0), abs(x) > 0.5);
}

// artanh x − x.
fn artanh_excess(x: f32) -> f32 {
    return select(disk_cubic_series(x, x * x), artanh(x) - x, abs(x) > 0.5);
}

// ±x³(1/3 + s/5 + s²/7 + …) with s = ±x².
fn disk_cubic_series(x: f32, s: f32) -> f32 {
    let tail = 1.0 / 11.0 + s * (1.0 / 13.0 + s * (1.0 / 15.0 + s * (1.0 / 17.0 + s / 19.0)));
    return x * x * x * (1.0 / 3.0 + s * (0.2 + s * (1.0 / 7.0 + s * (1.0 / 9.0 + s * tail))));
}
