// A sky: the hemisphere about a zenith l, of radiance u + c·cos.

struct SkyLight {
    zenith: vec3f,
    // u.
    even: f32,
    // c.
    cosine: f32,
}

@group(1) @binding(0) var<uniform> sky_light: SkyLight;

fn sky_respond_exact(at: Shading) -> Response {
    let sky = vec2f(sky_light.even, sky_light.cosine);
    let specular = sky_phong(sky_light.zenith, sky, at.n, at.r, lobes[at.lobe].exponent);
    return Response(sky_irradiance(sky_light.zenith, sky, at.n), specular);
}

// [SNYDER_1996], eq. (4) and (5), times π; `sky` is (u, c).
fn sky_irradiance(zenith: vec3f, sky: vec2f, n: vec3f) -> f32 {
    let cosine = dot(zenith, n);
    let sine = length(cross(zenith, n));
    let falling = 2.0 / 3.0 * max(sine + arctangent(sine, -cosine) * cosine, 0.0);
    return sky.x * 0.5 * PI * max(1.0 + cosine, 0.0) + sky.y * falling;
}

// What the boundary integrals of a lobe under a sky have in common; see `shading::sky::sky_phong`.
struct SkyContour {
    zenith: vec3f,
    r: vec3f,
    m: f32,
    // u, and c (m+1)/(m+2).
    parts: vec2f,
    // r·l.
    facing: f32,
}

fn sky_phong(zenith: vec3f, sky: vec2f, n: vec3f, r: vec3f, m: f32) -> f32 {
    let facing = dot(r, zenith);
    let b = SkyContour(zenith, r, m, vec2f(sky.x, sky.y * (m + 1.0) / (m + 2.0)), facing);
    let n_r = cross(n, r);
    let l_r = cross(zenith, r);
    let n_l = cross(n, zenith);
    // Horizons within 1e-6 of each other are one.
    let n_is_r = dot(n_r, n_r) < 1e-12;
    let l_is_r = dot(l_r, l_r) < 1e-12;
    let n_is_l = dot(n_l, n_l) < 1e-12;
    if (n_is_r && dot(n, r) < 0.0) || (l_is_r && facing < 0.0) || (n_is_l && dot(n, zenith) < 0.0) {
        return 0.0;
    }
    let has_n = !(n_is_r || n_is_l);
    let has_l = !l_is_r;
    var sum = 0.0;
    if has_l {
        sum += sky_arc(b, zenith, cross(l_r, zenith), has_n, cross(zenith, n_l));
    }
    if has_n {
        sum += sky_arc(b, n, cross(n_r, n), has_l, cross(n_l, n));
    }
    var lobe_horizon = select(2.0 * PI, PI, has_n || has_l);
    if has_n && has_l {
        let toward_l = cross(r, l_r);
        let toward_n = cross(r, n_r);
        lobe_horizon = PI - abs(arctangent(dot(r, cross(toward_l, toward_n)), dot(toward_l, toward_n)));
    }
    sum += (b.parts.x + b.parts.y * facing) * lobe_horizon;
    return max(sum / (2.0 * PI), 0.0);
}

// The integrals along the part of the circle of normal `g` within a quarter turn of `toward_r` and, if there is one, of
// another direction.
fn sky_arc(b: SkyContour, g: vec3f, toward_r: vec3f, is_cut: bool, other: vec3f) -> f32 {
    let peak = normalize(toward_r);
    let turn = select(0.0, arctangent(dot(cross(g, peak), other), dot(peak, other)), is_cut);
    let start = max(turn, 0.0) - HALF_PI;
    let stop = min(turn, 0.0) + HALF_PI;
    return sky_side(b, g, max(-stop, 0.0), -start) + sky_side(b, g, max(start, 0.0), stop);
}

// From `start` to `stop` in [0, π/2], either side of the peak: closed where zᵐ is negligible.
fn sky_side(b: SkyContour, g: vec3f, start: f32, stop: f32) -> f32 {
    if start >= stop {
        return 0.0;
    }
    let gamma = dot(b.r, g);
    let across = cross(b.r, g);
    let rho_squared = dot(across, across);
    let middle = clamp(cut_angle(exp(-CAP_NEGLIGIBLE / b.m), sqrt(rho_squared)), start, stop);
    let lambertian = b.parts.y * dot(b.zenith, g);
    let panels = ceil((middle - start) / CAP_PANEL);
    let half = 0.5 * (middle - start) / max(panels, 1.0);
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * CAP_HALF_NODES; i++) {
            let node = CAP_NODES[i >> 1u];
            let phi = start + half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u));
            let sine = sine_cosine(phi).x;
            // 1 − z², whose smallness (1 − zᵐ)/(1 − z²) survives.
            let square = clamp(gamma * gamma + rho_squared * sine * sine, 1e-30, 0.9999999);
            let logarithm = 0.5 * log_one_plus(-square);
            let lower = -exp_minus_one(b.m * logarithm);
            let upper = -exp_minus_one((b.m + 1.0) * logarithm);
            let missing = (b.parts.x * upper + b.parts.y * b.facing * lower) / square;
            sum += half * node.y * (gamma * missing + lambertian * (1.0 - lower));
        }
    }
    if middle < stop {
        let from_angle = sine_cosine(middle);
        let to_angle = sine_cosine(stop);
        let turned = gamma * (to_angle.x * from_angle.y - to_angle.y * from_angle.x);
        let dots = from_angle.x * to_angle.x + gamma * gamma * from_angle.y * to_angle.y;
        sum += (b.parts.x + b.parts.y * b.facing) * arctangent(turned, dots);
    }
    return sum;
}
