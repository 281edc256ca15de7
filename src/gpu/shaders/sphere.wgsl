// A spherical light of unit luminance, which a point sees as a cap: the directions within σ ≤ π/2 of a centre.

struct SphereLight {
    center: vec3f,
    radius: f32,
    // Directions of a cluster.
    count: u32,
}

@group(1) @binding(0) var<uniform> sphere_light: SphereLight;

fn sphere_respond_exact(at: Shading) -> Response {
    let to_center = sphere_light.center - at.p;
    let irradiance = sphere_irradiance(to_center, sphere_light.radius, at.n);
    return Response(irradiance, sphere_specular(at, to_center));
}

fn sphere_respond_hermite_1(at: Shading) -> Response {
    let to_center = sphere_light.center - at.p;
    let irradiance = sphere_irradiance_hermite_1(to_center, sphere_light.radius, at.n);
    return Response(irradiance, sphere_specular(at, to_center));
}

fn sphere_respond_hermite_2(at: Shading) -> Response {
    let to_center = sphere_light.center - at.p;
    let irradiance = sphere_irradiance_hermite_2(to_center, sphere_light.radius, at.n);
    return Response(irradiance, sphere_specular(at, to_center));
}

fn sphere_respond_cluster(at: Shading) -> Response {
    let to_center = sphere_light.center - at.p;
    return sphere_cluster(to_center, sphere_light.radius, sphere_light.count, at.n, at.r, at.lobe);
}

fn sphere_specular(at: Shading, to_center: vec3f) -> f32 {
    return sphere_phong(to_center, sphere_light.radius, at.n, at.r, lobes[at.lobe].exponent);
}

// A sphere that the horizon does not cut is as a point light; the loops run once or not at all, which software
// rasterisers, unlike a condition, take as leave to skip.
fn sphere_irradiance(to_center: vec3f, radius: f32, n: vec3f) -> f32 {
    var irradiance = sphere_irradiance_uncut(to_center, radius, n);
    for (var is_cut = sphere_is_cut(to_center, radius, n); is_cut; is_cut = false) {
        irradiance = cap_irradiance(cap_of_sphere(to_center, radius, n), n);
    }
    return irradiance;
}

fn sphere_irradiance_hermite_1(to_center: vec3f, radius: f32, n: vec3f) -> f32 {
    var irradiance = sphere_irradiance_uncut(to_center, radius, n);
    for (var is_cut = sphere_is_cut(to_center, radius, n); is_cut; is_cut = false) {
        irradiance = cap_irradiance_hermite(cap_of_sphere(to_center, radius, n), n, false);
    }
    return irradiance;
}

fn sphere_irradiance_hermite_2(to_center: vec3f, radius: f32, n: vec3f) -> f32 {
    var irradiance = sphere_irradiance_uncut(to_center, radius, n);
    for (var is_cut = sphere_is_cut(to_center, radius, n); is_cut; is_cut = false) {
        irradiance = cap_irradiance_hermite(cap_of_sphere(to_center, radius, n), n, true);
    }
    return irradiance;
}

// Of a sphere wholly above or below the surface's plane.
fn sphere_irradiance_uncut(to_center: vec3f, radius: f32, n: vec3f) -> f32 {
    let inverse = inverseSqrt(max(dot(to_center, to_center), 1e-30));
    let sine = radius * inverse;
    return PI * sine * sine * max(dot(n, to_center) * inverse, 0.0);
}

// Or p may be inside.
fn sphere_is_cut(to_center: vec3f, radius: f32, n: vec3f) -> bool {
    return abs(dot(n, to_center)) <= radius || dot(to_center, to_center) <= 1.0001 * radius * radius;
}

fn sphere_phong(to_center: vec3f, radius: f32, n: vec3f, r: vec3f, m: f32) -> f32 {
    return cap_phong(cap_of_sphere(to_center, radius, n), n, r, m);
}

struct Cap {
    center: vec3f,
    sin_sigma: f32,
    cos_sigma: f32,
}

// From inside everything is light, of which a surface sees the half about its normal.
fn cap_of_sphere(to_center: vec3f, radius: f32, n: vec3f) -> Cap {
    let gap = gap_squared(to_center, radius);
    let distance = length(to_center);
    if gap <= 0.0 || distance < 1e-15 {
        return Cap(n, 1.0, 0.0);
    }
    return Cap(to_center / distance, min(radius / distance, 1.0), sqrt(gap) / distance);
}

// ‖v‖² − radius², which keeps its digits where both are nearly the same: scaled by a power of two to 12 bits before the
// point, the squares of the whole parts are subtracted as integers.
fn gap_squared(v: vec3f, radius: f32) -> f32 {
    let sides = abs(vec4f(v, radius));
    let greatest = max(max(sides.x, sides.y), max(sides.z, sides.w));
    let scale = 2048.0 / bitcast<f32>(max(bitcast<u32>(greatest) & 0x7f800000u, 0x10000000u));
    let scaled = sides * scale;
    let whole = floor(scaled);
    let rest = scaled - whole;
    let integers = vec4i(whole) * vec4i(whole);
    let parts = rest * (2.0 * whole + rest);
    let sum = f32(integers.x + integers.y + integers.z - integers.w) + (parts.x + parts.y + parts.z - parts.w);
    return sum / scale / scale;
}

// π times [SNYDER_1996], eq. (6), in terms that do not cancel for small σ.
fn cap_irradiance(cap: Cap, n: vec3f) -> f32 {
    let cos_omega = dot(n, cap.center);
    let square = cap.sin_sigma * cap.sin_sigma;
    if cos_omega >= cap.sin_sigma {
        return PI * square * cos_omega;
    }
    if cos_omega <= -cap.sin_sigma {
        return 0.0;
    }
    let q = sqrt((cap.sin_sigma - cos_omega) * (cap.sin_sigma + cos_omega));
    let hypotenuse = max(sqrt(q * q + cap.cos_sigma * cap.cos_sigma), 1e-30);
    let sin_delta = q / hypotenuse;
    let cos_delta = cap.cos_sigma / hypotenuse;
    let segment = circular_segment(arctangent(q, cap.cos_sigma), sin_delta, cos_delta);
    let beta = arctangent(q, -cap.cos_sigma * cos_omega);
    return max(segment + cos_omega * (cos_omega * sin_delta * cos_delta + square * beta), 0.0);
}

// δ − sin δ cos δ, by its power series for small δ.
fn circular_segment(delta: f32, sine: f32, cosine: f32) -> f32 {
    let t = 4.0 * delta * delta;
    let series = 1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0 * (1.0 - t / 110.0)));
    return select(delta - sine * cosine, 2.0 / 3.0 * delta * delta * delta * series, delta < 0.5);
}

// One or two cubic Hermite segments where the horizon cuts the cap ([SNYDER_1996], §2.2).
fn cap_irradiance_hermite(cap: Cap, n: vec3f, two: bool) -> f32 {
    let cos_omega = dot(n, cap.center);
    let square = cap.sin_sigma * cap.sin_sigma;
    if cos_omega >= cap.sin_sigma {
        return PI * square * cos_omega;
    }
    if cos_omega <= -cap.sin_sigma {
        return 0.0;
    }
    let sigma = arctangent(cap.sin_sigma, cap.cos_sigma);
    let elevation = arctangent(cos_omega, length(cross(n, cap.center)));
    let start = vec2f(cap.sin_sigma * square, -cap.cos_sigma * square);
    let middle = vec2f(circular_segment(sigma, cap.sin_sigma, cap.cos_sigma) / PI, -0.5 * square);
    if !two {
        return PI * max(hermite(start, vec2f(0.0), 2.0 * sigma, sigma - elevation), 0.0);
    }
    if elevation > 0.0 {
        return PI * max(hermite(start, middle, sigma, sigma - elevation), 0.0);
    }
    return PI * max(hermite(middle, vec2f(0.0), sigma, -elevation), 0.0);
}

// The cubic with values and slopes `start` at 0 and `stop` at `width`, at x.
fn hermite(start: vec2f, stop: vec2f, width: f32, x: f32) -> f32 {
    let y = x / width;
    let g_0 = width * start.y;
    let g_1 = width * stop.y;
    let rise = stop.x - start.x;
    return (((g_0 + g_1 - 2.0 * rise) * y + 3.0 * rise - g_1 - 2.0 * g_0) * y + g_0) * y + start.x;
}

// Directions spread evenly over the cap, each of the same solid angle.
fn sphere_cluster(to_center: vec3f, radius: f32, count: u32, n: vec3f, r: vec3f, lobe: u32) -> Response {
    return cap_cluster(cap_of_sphere(to_center, radius, n), count, n, r, lobe);
}

fn cap_cluster(cap: Cap, count: u32, n: vec3f, r: vec3f, lobe: u32) -> Response {
    let depth = cap.sin_sigma * cap.sin_sigma / (1.0 + cap.cos_sigma);
    let part = 2.0 * PI * depth / f32(count);
    let c = cap.center;
    let sign = select(-1.0, 1.0, c.z >= 0.0);
    let a = -1.0 / (sign + c.z);
    let x_axis = vec3f(1.0 + sign * c.x * c.x * a, sign * c.x * c.y * a, -sign * c.x);
    let y_axis = vec3f(c.x * c.y * a, sign + c.y * c.y * a, -c.y);
    var azimuth = vec2f(1.0, 0.0);
    var sum = Response(0.0, 0.0);
    for (var i = 0u; i < count; i++) {
        let fall = depth * (f32(i) + 0.5) / f32(count);
        let across = sqrt(fall * (2.0 - fall)) * azimuth;
        let response = direction_response((1.0 - fall) * c + across.x * x_axis + across.y * y_axis, part, n, r, lobe);
        sum.irradiance += response.irradiance;
        sum.specular += response.specular;
        // Cosine and sine of the golden angle π(3 − √5).
        azimuth = mat2x2f(-0.73736887807831963, 0.67549029426152364, -0.67549029426152364, -0.73736887807831963) * azimuth;
    }
    return sum;
}

// The constant c of `shading::sphere::cap_phong`: 1, z₀ᵐ⁺¹ or 0.
const OFFSET_ONE = 0u;
const OFFSET_MIDDLE = 1u;
const OFFSET_ZERO = 2u;

// −ln of the fraction of the peak below which zᵐ⁺¹ is left out.
const CAP_NEGLIGIBLE = 17.0;

// Widest panel of 10 Gauss–Legendre nodes, in radians.
const CAP_PANEL = 1.6;

// The positive nodes on [−1, 1] and their weights.
const CAP_HALF_NODES = 5u;
const CAP_NODES = array<vec2f, 5>(
    vec2f(0.14887433898163121088, 0.29552422471475287017),
    vec2f(0.43339539412924719080, 0.26926671930999635509),
    vec2f(0.67940956829902440623, 0.21908636251598204400),
    vec2f(0.86506336668898451073, 0.14945134915058059315),
    vec2f(0.97390652851717172008, 0.06667134430868813759),
);

// The boundary of the part of a cap that a lobe sees, with z along r and the cap's centre at y = 0.
struct Boundary {
    sin_sigma: f32,
    cos_sigma: f32,
    sin_omega: f32,
    cos_omega: f32,
    power: f32,
    offset: u32,
    // c, and its logarithm where it is z₀ᵐ⁺¹.
    constant: f32,
    log_constant: f32,
    // zᵐ⁺¹ is negligible where z is below this.
    z_cut: f32,
    // n in this frame.
    n: vec3f,
    // n's component perpendicular to r.
    amplitude: f32,
}

// (m+1)/(2π) ∫ (r·ω)ᵐ dω over a cap where r·ω > 0 and n·ω > 0, as (1/2π) ∮ (c − zᵐ⁺¹) dψ.
fn cap_phong(cap: Cap, n: vec3f, r: vec3f, m: f32) -> f32 {
    let across = cross(r, cap.center);
    let sin_omega = length(across);
    let cos_omega = dot(r, cap.center);
    let elevation = dot(n, cap.center);
    if cos_omega <= -cap.sin_sigma || elevation <= -cap.sin_sigma {
        return 0.0;
    }
    var y_axis = across / max(sin_omega, 1e-30);
    if sin_omega == 0.0 {
        y_axis = normalize(select(vec3f(0.0, r.z, -r.y), vec3f(-r.y, r.x, 0.0), abs(r.z) < 0.7));
    }
    let n_local = vec3f(dot(n, cross(y_axis, r)), dot(n, y_axis), dot(n, r));
    let amplitude = length(n_local.xy);
    if amplitude < 1e-6 && n_local.z < 0.0 {
        return 0.0;
    }
    let power = m + 1.0;
    let middle = cap.cos_sigma * cos_omega;
    var offset = OFFSET_ONE;
    var constant = 1.0;
    var log_constant = 0.0;
    if cap.sin_sigma < 0.5 * sin_omega {
        offset = OFFSET_ZERO;
        constant = 0.0;
        if cos_omega > cap.sin_sigma {
            offset = OFFSET_MIDDLE;
            let sines = log_one_plus(-sin_omega * sin_omega) + log_one_plus(-cap.sin_sigma * cap.sin_sigma);
            log_constant = 0.5 * power * sines;
            constant = exp(log_constant);
        }
    }
    let inside = sin_omega <= cap.sin_sigma && cos_omega >= 0.0;
    let highest = select(middle + cap.sin_sigma * sin_omega, 1.0, inside);
    let boundary = Boundary(
        cap.sin_sigma, cap.cos_sigma, sin_omega, cos_omega, power, offset, constant, log_constant,
        highest * exp(-CAP_NEGLIGIBLE / power), n_local, amplitude,
    );
    var sum = cap_circle(boundary, elevation) + cap_lobe_horizon(boundary);
    // From inside the sphere the cap is all that is above n's horizon.
    if elevation < cap.sin_sigma && cap.cos_sigma > 0.0 {
        sum += cap_horizon(boundary, elevation);
    }
    return max(sum / (2.0 * PI), 0.0);
}

// The arcs of the cap's circle above both horizons.
fn cap_circle(b: Boundary, elevation: f32) -> f32 {
    let end = cut_half_angle(b.sin_sigma, b.cos_sigma, b.cos_omega);
    let slope = b.sin_sigma * b.sin_omega;
    let cut = cut_angle(b.z_cut - b.cos_sigma * b.cos_omega, slope);
    let half = cut_half_angle(b.sin_sigma, b.cos_sigma, elevation);
    // A horizon that is r's own, up to rounding, cuts nothing off that r's does not.
    if half >= PI || b.cos_sigma == 0.0 || b.amplitude < 1e-6 {
        let nodes = cap_circle_nodes(b);
        if end >= PI && nodes <= CAP_CIRCLE_NODES {
            return cap_whole_circle(b, nodes);
        }
        return 2.0 * cap_piece(b, true, 0.0, end, cut);
    }
    let middle = arctangent(b.n.y, b.n.z * b.sin_omega - b.n.x * b.cos_omega);
    var sum = 0.0;
    for (var i = 0u; i < 6u; i++) {
        let place = select(middle, -middle, i < 3u) + 2.0 * PI * (f32(i % 3u) - 1.0);
        sum += cap_piece(b, true, max(place - half, 0.0), min(place + half, end), cut);
    }
    return sum;
}

// ln of how much greater the integrand may be off the real line, and most nodes on half of a circle.
const CAP_CIRCLE_GROWTH = 8.0;
const CAP_CIRCLE_NODES = 12.0;

// How many nodes the midpoint rule needs on half of the whole circle; see `circle_nodes` in `shading::sphere`.
fn cap_circle_nodes(b: Boundary) -> f32 {
    let slope = max(b.sin_sigma * b.sin_omega, 1e-30);
    let middle = b.cos_sigma * b.cos_omega;
    var height = 1.0 + CAP_CIRCLE_GROWTH * (middle + slope) / (b.power * slope);
    if b.offset != OFFSET_ONE {
        height = min(height, (1.0 - middle) / slope);
    }
    if b.power <= 24.0 && fract(b.power) != 0.0 {
        height = min(height, middle / slope);
    }
    height = clamp(height, 1.0, 1e6);
    let reach = log(height + sqrt((height - 1.0) * (height + 1.0)));
    return max(ceil(0.5 * (CAP_NEGLIGIBLE + CAP_CIRCLE_GROWTH) / max(reach, 1e-3)), 3.0);
}

// ∫ (c − zᵐ⁺¹) dψ over the whole circle by the midpoint rule, by symmetry on half of it.
fn cap_whole_circle(b: Boundary, nodes: f32) -> f32 {
    let turn = sine_cosine(PI / nodes);
    var angle = sine_cosine(0.5 * PI / nodes);
    var sum = 0.0;
    for (var i = 0.0; i < nodes; i += 1.0) {
        sum += cap_integrand(b, true, angle);
        angle = vec2f(angle.x * turn.y + angle.y * turn.x, angle.y * turn.y - angle.x * turn.x);
    }
    return 2.0 * PI / nodes * sum;
}

// The arc of n's horizon within the cap and above r's horizon.
fn cap_horizon(b: Boundary, elevation: f32) -> f32 {
    if b.amplitude < 1e-6 {
        return 0.0;
    }
    let ahead = b.amplitude * b.cos_omega - b.n.x * b.n.z / b.amplitude * b.sin_omega;
    let middle = arctangent(b.n.y / b.amplitude * b.sin_omega, ahead);
    let half = arctangent(sqrt((b.sin_sigma - elevation) * (b.sin_sigma + elevation)), b.cos_sigma);
    let cut = cut_angle(b.z_cut, b.amplitude);
    var sum = 0.0;
    for (var turn = -1.0; turn < 1.5; turn += 1.0) {
        let place = middle + 2.0 * PI * turn;
        let start = max(place - half, -HALF_PI);
        let stop = min(place + half, HALF_PI);
        if start < stop {
            sum += cap_piece(b, false, max(-stop, 0.0), -start, cut) + cap_piece(b, false, max(start, 0.0), stop, cut);
        }
    }
    return sum;
}

// c Δψ over the arc of r's horizon within the cap and above n's horizon.
fn cap_lobe_horizon(b: Boundary) -> f32 {
    if b.cos_omega >= b.sin_sigma {
        return 0.0;
    }
    let half = arctangent(sqrt((b.sin_sigma - b.cos_omega) * (b.sin_sigma + b.cos_omega)), b.cos_sigma);
    if b.amplitude < 1e-6 {
        return 2.0 * half * b.constant;
    }
    let middle = arctangent(b.n.y, b.n.x);
    var sum = 0.0;
    for (var turn = -1.0; turn < 1.5; turn += 1.0) {
        let place = middle + 2.0 * PI * turn;
        sum += max(min(place + HALF_PI, half) - max(place - HALF_PI, -half), 0.0);
    }
    return sum * b.constant;
}

// ∫ (c − zᵐ⁺¹) dψ from `start` to `stop` ≥ 0 on the circle or on n's horizon, zᵐ⁺¹ being negligible beyond `cut`.
fn cap_piece(b: Boundary, on_circle: bool, start: f32, stop: f32, cut: f32) -> f32 {
    if start >= stop {
        return 0.0;
    }
    let middle = clamp(cut, start, stop);
    let panels = ceil((middle - start) / CAP_PANEL);
    let half = 0.5 * (middle - start) / max(panels, 1.0);
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        for (var i = 0u; i < 2u * CAP_HALF_NODES; i++) {
            let node = CAP_NODES[i >> 1u];
            let x = half * (2.0 * panel + 1.0 + select(-node.x, node.x, (i & 1u) == 0u));
            sum += half * node.y * cap_integrand(b, on_circle, sine_cosine(start + x));
        }
    }
    if middle < stop {
        sum += b.constant * (cap_azimuth(b, on_circle, stop) - cap_azimuth(b, on_circle, middle));
    }
    return sum;
}

// (c − zᵐ⁺¹) dψ/dangle.
fn cap_integrand(b: Boundary, on_circle: bool, angle: vec2f) -> f32 {
    if on_circle {
        let x = b.sin_omega * b.cos_sigma - b.cos_omega * b.sin_sigma * angle.y;
        let y = b.sin_sigma * angle.x;
        let square = x * x + y * y;
        let turning = b.sin_sigma * (b.sin_sigma * b.cos_omega - b.cos_sigma * b.sin_omega * angle.y);
        return cap_weight(b, square, b.sin_sigma * b.sin_omega * angle.y) * turning / max(square, 1e-30);
    }
    let x = b.n.z * angle.y;
    let square = angle.x * angle.x + x * x;
    let height = b.amplitude * angle.y - b.cos_sigma * b.cos_omega;
    return cap_weight(b, square, height) * b.n.z / max(square, 1e-30);
}

fn cap_azimuth(b: Boundary, on_circle: bool, x: f32) -> f32 {
    let angle = sine_cosine(x);
    if on_circle {
        return -arctangent(b.sin_sigma * angle.x, b.sin_omega * b.cos_sigma - b.cos_omega * b.sin_sigma * angle.y);
    }
    return arctangent(angle.x, b.n.z * angle.y);
}

// c − zᵐ⁺¹ from ρ² = 1 − z² and z − cos σ cos ω.
fn cap_weight(b: Boundary, square: f32, above_middle: f32) -> f32 {
    if b.offset == OFFSET_ONE {
        return -exp_minus_one(0.5 * b.power * log_one_plus(-min(square, 1.0)));
    }
    let middle = b.cos_sigma * b.cos_omega;
    if b.offset == OFFSET_ZERO {
        return -power(middle + above_middle, b.power);
    }
    let growth = b.power * log_one_plus(max(above_middle / middle, -1.0));
    if abs(growth) < 0.5 {
        return -b.constant * exp_minus_one(growth);
    }
    return b.constant - exp(b.log_constant + growth);
}

// The half-angle of the part of a cap's circle above a horizon at which its centre's elevation has the given sine.
fn cut_half_angle(sin_sigma: f32, cos_sigma: f32, elevation: f32) -> f32 {
    if elevation >= sin_sigma {
        return PI;
    }
    if elevation <= -sin_sigma {
        return 0.0;
    }
    return arctangent(sqrt((sin_sigma - elevation) * (sin_sigma + elevation)), -cos_sigma * elevation);
}

// The angle whose cosine is height/slope, 0 and π beyond.
fn cut_angle(height: f32, slope: f32) -> f32 {
    if height >= slope {
        return 0.0;
    }
    if height <= -slope {
        return PI;
    }
    return arctangent(sqrt((slope - height) * (slope + height)), height);
}

// eˣ − 1, by its power series near 0.
fn exp_minus_one(x: f32) -> f32 {
    let series = x * (1.0 + x / 2.0 * (1.0 + x / 3.0 * (1.0 + x / 4.0 * (1.0 + x / 5.0 * (1.0 + x / 6.0 * (1.0 + x / 7.0))))));
    return select(exp(x) - 1.0, series, abs(x) < 0.5);
}

// Sine and cosine of |x| ≤ π within 3e-7, which WGSL's own need not be: power series of a quarter, doubled twice.
fn sine_cosine(x: f32) -> vec2f {
    let q = 0.25 * x;
    let t = q * q;
    let sine = q * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0))));
    let cosine = 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0)));
    let half = vec2f(2.0 * sine * cosine, 1.0 - 2.0 * sine * sine);
    return vec2f(2.0 * half.x * half.y, 1.0 - 2.0 * half.x * half.x);
}
