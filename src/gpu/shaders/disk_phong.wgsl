// The Phong lobe over a disk: (m+1)/(2π) ∫ (r·ω)ᵐ dω where r·ω > 0 and n·ω > 0, as (1/2π) ∮ (c − zᵐ⁺¹) dψ.
//
// f32 knows where a horizon cuts a disk to 1e-7/sin β of its radius: what is left of a disk of 0.005 that the horizon cuts to a
// sliver of 7e-4 errs by 1.3e-6 of the scale.

// Longest panel of 10 nodes, times √(m+1), radians.
const DISK_PANEL = 4.4;

// Widest panel in asinh(δ/κ), δ the distance in t from the rim's bends.
const DISK_BEND_PANEL = 2.4;

// The boundary of what a lobe sees of a disk, in the cone's axes.
struct DiskContour {
    cone: DiskCone,
    r: vec3f,
    power: f32,
    // OFFSET_ONE, OFFSET_MIDDLE or OFFSET_ZERO.
    offset: u32,
    // c, and its logarithm where it is z₀ᵐ⁺¹.
    constant: f32,
    log_constant: f32,
    // zᵐ⁺¹ is negligible where z is below this.
    z_cut: f32,
}

// A point of a curve: its unit direction less the cone's axis, and ω × dω/du.
struct DiskNode {
    offset: vec3f,
    turning: vec3f,
}

// A curve: a quarter of the rim from its bend at t = ±π/2, or an arc of a great circle.
struct DiskCurve {
    is_rim: bool,
    // Rim: 1 at the bend t = π/2, −1 at −π/2.
    up: f32,
    // Great circle: its point at u = 0, and its direction there.
    middle: vec3f,
    along: vec3f,
}

fn disk_cone_phong(cone: DiskCone, n: vec3f, r: vec3f, m: f32) -> f32 {
    let local_r = disk_local(cone, r);
    let local_n = disk_local(cone, n);
    let lobe_cut = disk_cut(cone, local_r);
    var surface_cut = disk_cut(cone, local_n);
    if cone.sin_a == 0.0 || lobe_cut.kind == DISK_BELOW || surface_cut.kind == DISK_BELOW {
        return 0.0;
    }
    let both = cross(local_n, local_r);
    if dot(both, both) < 1e-12 {
        if dot(local_n, local_r) <= 0.0 {
            return 0.0;
        }
        surface_cut.kind = DISK_ABOVE;
    }
    if cone.sin_a < 0.2 * cone.sin_b && (m + 1.0) * cone.sin_a * cone.sin_b < 0.8 {
        return disk_area_phong(cone, local_n, surface_cut, local_r, lobe_cut, m);
    }
    let b = disk_contour(cone, local_r, m);
    let lobe = disk_rim_above(cone, lobe_cut);
    let surface = disk_rim_above(cone, surface_cut);
    var sum = 0.0;
    let whole = lobe_cut.kind == DISK_ABOVE && surface_cut.kind == DISK_ABOVE;
    for (var turn = select(-1.0, 0.0, whole); turn < select(1.5, 0.5, whole); turn += 1.0) {
        let start = max(lobe.x, surface.x + 2.0 * PI * turn);
        let stop = min(lobe.y, surface.y + 2.0 * PI * turn);
        sum += disk_rim(b, start, stop);
    }
    let crossed = lobe_cut.kind == DISK_ACROSS && surface_cut.kind == DISK_ACROSS;
    if surface_cut.kind == DISK_ACROSS {
        let arc = disk_arc(cone, surface_cut, local_n);
        let above = disk_arc_above(arc, crossed, cross(both, local_n));
        sum += disk_piece(b, arc.curve, above.x, above.y, 1.6, 1.0);
    }
    if lobe_cut.kind == DISK_ACROSS {
        let arc = disk_arc(cone, lobe_cut, local_r);
        let above = disk_arc_above(arc, crossed, cross(local_r, both));
        sum += b.constant * max(above.y - above.x, 0.0);
    }
    return max(sum / (2.0 * PI), 0.0);
}

fn disk_contour(cone: DiskCone, r: vec3f, m: f32) -> DiskContour {
    let power = m + 1.0;
    let sin_omega = length(r.xy);
    var offset = OFFSET_ZERO;
    var constant = 0.0;
    var log_constant = 0.0;
    if cone.sin_b >= 0.5 * sin_omega && r.z > -cone.sin_b {
        offset = OFFSET_ONE;
        constant = 1.0;
    } else if r.z > cone.sin_b {
        offset = OFFSET_MIDDLE;
        // From what of sine and cosine is the smaller, and so the one that has its digits.
        let near = 0.5 * log_one_plus(-min(sin_omega * sin_omega, 0.9));
        log_constant = power * select(near, log(r.z), r.z < 0.7);
        constant = exp(log_constant);
    }
    let inside = sin_omega <= cone.sin_b && r.z > 0.0;
    let highest = select(cone.cos_b * r.z + cone.sin_b * sin_omega, 1.0, inside);
    return DiskContour(cone, r, power, offset, constant, log_constant, highest * exp(-CAP_NEGLIGIBLE / power));
}

// The part of the rim above a horizon, from and to an angle t of the rim's directions.
fn disk_rim_above(cone: DiskCone, cut: DiskCut) -> vec2f {
    if cut.kind == DISK_ABOVE {
        return vec2f(0.0, 2.0 * PI);
    }
    let ends = disk_ends(cut);
    let start = arctangent(ends.y * cone.cos_a, ends.x * cone.cos_b);
    var width = arctangent(ends.w * cone.cos_a, ends.z * cone.cos_b) - start;
    width = select(width, width + 2.0 * PI, width < 0.0);
    // Rounding must not make a whole rim of none.
    if cut.cos_gamma > 0.0 {
        width = select(width, 0.0, width > PI + 1e-3);
    } else {
        width = select(width, 2.0 * PI, width < PI - 1e-3);
    }
    return vec2f(start, start + width);
}

// cos and sin of τ − γ, and of τ + γ.
fn disk_ends(cut: DiskCut) -> vec4f {
    let a = cut.axis * cut.cos_gamma;
    let b = cut.axis * cut.sin_gamma;
    return vec4f(a.x + b.y, a.y - b.x, a.x - b.y, a.y + b.x);
}

// ∫ (c − zᵐ⁺¹) dψ over the rim from t = `start` to `stop`, quarter by quarter.
fn disk_rim(b: DiskContour, start: f32, stop: f32) -> f32 {
    let bend = b.cone.cos_b / b.cone.cos_a;
    var sum = 0.0;
    for (var quarter = floor(start / HALF_PI); quarter * HALF_PI < stop; quarter += 1.0) {
        let lo = max(start, quarter * HALF_PI);
        let hi = min(stop, (quarter + 1.0) * HALF_PI);
        // The rim bends at the start of odd quarters and at the end of even ones.
        let odd = quarter - 2.0 * floor(0.5 * quarter) > 0.5;
        let corner = select(quarter + 1.0, quarter, odd);
        let up = select(-1.0, 1.0, corner - 4.0 * floor(0.25 * corner) < 2.0);
        let near = abs(select(hi, lo, odd) - corner * HALF_PI);
        let far = abs(select(lo, hi, odd) - corner * HALF_PI);
        let ends = vec2f(disk_asinh(near / bend), disk_asinh(far / bend));
        let curve = DiskCurve(true, up, vec3f(), vec3f());
        if odd {
            sum += disk_piece(b, curve, ends.x, ends.y, DISK_BEND_PANEL, 1.9 * b.cone.sin_b);
        } else {
            sum += disk_piece(b, curve, -ends.y, -ends.x, DISK_BEND_PANEL, 1.9 * b.cone.sin_b);
        }
    }
    return sum;
}

// asinh x for x ≥ 0.
fn disk_asinh(x: f32) -> f32 {
    return log_one_plus(x + x * x / (1.0 + sqrt(1.0 + x * x)));
}

fn disk_node(b: DiskContour, curve: DiskCurve, u: f32) -> DiskNode {
    if !curve.is_rim {
        let angle = sine_cosine(u);
        let direction = angle.y * curve.middle + angle.x * curve.along;
        return DiskNode(disk_below_pole(direction), cross(curve.middle, curve.along));
    }
    let cone = b.cone;
    let bend = cone.cos_b / cone.cos_a;
    let growth = exp(abs(u));
    let sinh = select(0.5 * (growth - 1.0 / growth), abs(u) * (1.0 + u * u / 6.0 * (1.0 + u * u / 20.0)), abs(u) < 0.3);
    let angle = sine_cosine(min(bend * sinh, HALF_PI) * sign(u));
    let cos_t = -curve.up * angle.x;
    let sin_t = curve.up * angle.y;
    let x = cone.sin_a * cos_t;
    let y = cone.sin_b * sin_t;
    let z = max(length(vec2f(cone.cos_a * cos_t, cone.cos_b * sin_t)), 1e-18);
    let turning = vec3f(
        -cone.sin_b * cone.cos_a * (cone.cos_a * cos_t / z),
        -cone.sin_a * cone.cos_b * (cone.cos_b * sin_t / z),
        cone.sin_a * cone.sin_b,
    );
    return DiskNode(disk_below_pole(vec3f(x, y, z)), turning * (bend * 0.5 * (growth + 1.0 / growth)));
}

// ω − Z without cancellation for ω near Z.
fn disk_below_pole(direction: vec3f) -> vec3f {
    let square = dot(direction.xy, direction.xy);
    return vec3f(direction.xy, select(direction.z - 1.0, -square / (1.0 + direction.z), direction.z > 0.0));
}

// ∫ (c − zᵐ⁺¹) dψ along a curve, along which ω moves no faster than `speed`.
fn disk_piece(b: DiskContour, curve: DiskCurve, start: f32, stop: f32, width: f32, speed: f32) -> f32 {
    if start >= stop {
        return 0.0;
    }
    let panels = max(ceil((stop - start) / min(width, DISK_PANEL / (sqrt(b.power) * speed))), 1.0);
    let half = 0.5 * (stop - start) / panels;
    let reach = min(half * speed, HALF_PI);
    let spread = sine_cosine(reach);
    var sum = 0.0;
    for (var panel = 0.0; panel < panels; panel += 1.0) {
        let middle = start + half * (2.0 * panel + 1.0);
        let height = dot(b.r, disk_node(b, curve, middle).offset) + b.r.z;
        // No more than half of the panel's length above the middle.
        var highest = 1.0;
        if height < spread.y {
            highest = height * spread.y + sqrt(max(1.0 - height * height, 0.0)) * spread.x;
        }
        if highest <= b.z_cut {
            sum += b.constant * disk_azimuth(b, disk_node(b, curve, middle - half), disk_node(b, curve, middle + half));
        } else {
            for (var i = 0u; i < 2u * CAP_HALF_NODES; i++) {
                let node = CAP_NODES[i >> 1u];
                let u = middle + half * select(-node.x, node.x, (i & 1u) == 0u);
                sum += half * node.y * disk_integrand(b, disk_node(b, curve, u));
            }
        }
    }
    return sum;
}

// (c − zᵐ⁺¹) dψ/du.
fn disk_integrand(b: DiskContour, node: DiskNode) -> f32 {
    let sines = cross(b.r, node.offset + vec3f(0.0, 0.0, 1.0));
    let square = dot(sines, sines);
    return disk_weight(b, square, dot(b.r, node.offset)) * dot(b.r, node.turning) / max(square, 1e-30);
}

// c − zᵐ⁺¹ from ρ² = 1 − z² and z − z₀.
fn disk_weight(b: DiskContour, square: f32, above_middle: f32) -> f32 {
    if b.offset == OFFSET_ONE {
        return -exp_minus_one(0.5 * b.power * log_one_plus(-min(square, 0.99999994)));
    }
    if b.offset == OFFSET_ZERO {
        return -power(b.r.z + above_middle, b.power);
    }
    let growth = b.power * log_one_plus(max(above_middle / b.r.z, -0.99999994));
    if abs(growth) < 0.5 {
        return -b.constant * exp_minus_one(growth);
    }
    return b.constant - exp(b.log_constant + growth);
}

// The change of ψ between points less than a half turn apart.
fn disk_azimuth(b: DiskContour, start: DiskNode, stop: DiskNode) -> f32 {
    let u = start.offset + vec3f(0.0, 0.0, 1.0);
    let v = stop.offset + vec3f(0.0, 0.0, 1.0);
    return arctangent(dot(b.r, cross(u, v)), dot(cross(b.r, u), cross(b.r, v)));
}

// The arc that a horizon cuts out of the disk, counter-clockwise about its part above the horizon.
struct DiskArc {
    curve: DiskCurve,
    // Half of its angle.
    half_angle: f32,
}

fn disk_arc(cone: DiskCone, cut: DiskCut, n: vec3f) -> DiskArc {
    let ends = disk_ends(cut);
    let stop = disk_direction(cone, ends.xy);
    let start = disk_direction(cone, ends.zw);
    let width = length(stop - start);
    let extent = length(stop + start);
    var along = (stop - start) / max(width, 1e-30);
    if width == 0.0 {
        along = normalize(cross(n, start));
    }
    // The sum loses its direction where the ends are nearly opposite.
    var middle = normalize(cross(along, n));
    if extent > 0.1 {
        middle = (stop + start) / extent;
    }
    return DiskArc(DiskCurve(false, 0.0, middle, along), arctangent(width, extent));
}

// The unit direction to a point of the unit circle that stands for the rim.
fn disk_direction(cone: DiskCone, at: vec2f) -> vec3f {
    let x = cone.sin_a * cone.cos_b * at.x;
    let y = cone.sin_b * cone.cos_a * at.y;
    let z = cone.cos_a * cone.cos_b;
    let greatest = max(max(abs(x), abs(y)), max(z, 1e-37));
    return normalize(vec3f(x, y, z) / greatest);
}

// The part of an arc within a quarter turn of a direction where `cut`, in angles from its middle.
fn disk_arc_above(arc: DiskArc, cut: bool, toward: vec3f) -> vec2f {
    if !cut {
        return vec2f(-arc.half_angle, arc.half_angle);
    }
    let highest = arctangent(dot(toward, arc.curve.along), dot(toward, arc.curve.middle));
    return vec2f(max(highest - HALF_PI, -arc.half_angle), min(highest + HALF_PI, arc.half_angle));
}

// ∫ over a narrow cone's area, row by row; rows are great circles through the cone's X axis at an angle y from Z.
fn disk_area_phong(cone: DiskCone, n: vec3f, surface_cut: DiskCut, r: vec3f, lobe_cut: DiskCut, m: f32) -> f32 {
    let beta = arctangent(cone.sin_b, cone.cos_b);
    // The rows where a horizon enters or leaves the rim, or both cross, in order.
    var breaks = array<f32, 8>(-beta, -beta, -beta, -beta, -beta, -beta, -beta, beta);
    if surface_cut.kind == DISK_ACROSS {
        let ends = disk_ends(surface_cut);
        breaks[1] = arctangent(ends.y * cone.sin_b, cone.cos_b);
        breaks[2] = arctangent(ends.w * cone.sin_b, cone.cos_b);
    }
    if lobe_cut.kind == DISK_ACROSS {
        let ends = disk_ends(lobe_cut);
        breaks[3] = arctangent(ends.y * cone.sin_b, cone.cos_b);
        breaks[4] = arctangent(ends.w * cone.sin_b, cone.cos_b);
    }
    let both = cross(n, r);
    breaks[5] = clamp(arctangent(both.y, both.z), -beta, beta);
    breaks[6] = clamp(arctangent(-both.y, -both.z), -beta, beta);
    for (var i = 1u; i < 7u; i++) {
        for (var j = i; j > 1u && breaks[j] < breaks[j - 1u]; j--) {
            let lower = breaks[j];
            breaks[j] = breaks[j - 1u];
            breaks[j - 1u] = lower;
        }
    }
    let surface = select(n, vec3f(0.0, 0.0, 1.0), surface_cut.kind == DISK_ABOVE);
    var sum = 0.0;
    for (var i = 0u; i < 7u; i++) {
        let panels = ceil((breaks[i + 1u] - breaks[i]) * sqrt(m + 1.0) / DISK_PANEL);
        let step = (breaks[i + 1u] - breaks[i]) / max(panels, 1.0);
        for (var panel = 0.0; panel < panels; panel += 1.0) {
            for (var k = 0u; k < 2u * CAP_HALF_NODES; k++) {
                let node = CAP_NODES[k >> 1u];
                let t = 0.5 + 0.5 * select(-node.x, node.x, (k & 1u) == 0u);
                // t²(3 − 2t) makes both ends smooth.
                let y = breaks[i] + step * (panel + t * t * (3.0 - 2.0 * t));
                sum += 0.5 * node.y * step * 6.0 * t * (1.0 - t) * disk_row(cone, beta, y, surface, r, m);
            }
        }
    }
    return lobe_normalization(m) * sum;
}

// The positive ones of 6 nodes on [−1, 1] and their weights.
const DISK_ROW = array<vec2f, 3>(
    vec2f(0.23861918608319691, 0.46791393457269105),
    vec2f(0.66120938646626451, 0.36076157304813861),
    vec2f(0.93246951420315203, 0.17132449237917034),
);

// ∫ (r·ω)ᵐ cos x dx over a row.
fn disk_row(cone: DiskCone, beta: f32, y: f32, n: vec3f, r: vec3f, m: f32) -> f32 {
    let angle = sine_cosine(y);
    let product = max(sine_cosine(beta - y).x * sine_cosine(beta + y).x, 0.0);
    let reach = arctangent(sqrt(product) * cone.sin_a, cone.cos_a * cone.sin_b);
    let surface = arctangent(n.x, n.y * angle.x + n.z * angle.y);
    let lobe = arctangent(r.x, r.y * angle.x + r.z * angle.y);
    let start = max(-reach, max(surface, lobe) - HALF_PI);
    let stop = min(reach, min(surface, lobe) + HALF_PI);
    if start >= stop {
        return 0.0;
    }
    let half = 0.5 * (stop - start);
    var sum = 0.0;
    for (var i = 0u; i < 6u; i++) {
        let node = DISK_ROW[i >> 1u];
        let x = sine_cosine(0.5 * (start + stop) + half * select(-node.x, node.x, (i & 1u) == 0u));
        sum += half * node.y * x.y * lobe_power(r, vec3f(x.x, x.y * angle.x, x.y * angle.y), m);
    }
    return sum;
}
