//! Linear lights.
//!
//! Everything happens in the frame of the foot of the perpendicular from the point to the light's line: the light is
//! the points `foot + s·axis` with s from a to b, at the distances √(d² + s²), d = ‖foot‖. Written in a, b and their
//! distances, nothing cancels when the point comes near the line.

use glam::DVec3;

use super::point::{CONTACT, falloff_response};
use super::{Method, PhongLobe, Response, ShadingPoint, cluster};
use crate::light::LineEmitter;
use crate::math::special::{asin_excess, cosine_power_mean, panels, refined_panels};

/// Response to a line of intensity per metre 1 by a method.
pub fn respond(light: &LineEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::PointCluster(points) => return cluster::line_cluster(light, points, at, lobe),
        Method::Point => return line_point(light, at, lobe),
        _ => {}
    }
    let Some(visible) = LineFrame::new(light, at.p).and_then(|line| line.above(at.n)) else {
        return Response::default();
    };
    let r = at.mirror();
    let specular = match method {
        Method::Chebyshev => lobe.normalisation() * visible.chebyshev(r, light.falloff, lobe),
        Method::NearestPoint => {
            let nearest = visible.nearest(r);
            falloff_response(nearest, light.length(), light.falloff, nearest, r, lobe).specular
        }
        _ => lobe.normalisation() * visible.phong(r, lobe.exponent(), light.falloff),
    };
    Response { irradiance: visible.irradiance(at.n, light.falloff), specular }
}

/// Irradiance at `p` from a line of intensity per metre 1.
///
/// E = ∫ max(0, n·w)/rᶠ ds = (n·foot) J + (n·axis) K,  J = ∫ ds/rᶠ⁺¹,  K = ∫ s ds/rᶠ⁺¹,  over the part above n's horizon
///
/// For f = 2 that is L(n·A/r_a + n·B/r_b)/(r_a r_b + A·B) with A, B from p to the ends. J and K have closed forms for
/// f = 0, 1, 2, 3; for other f they are integrated over y with ds = r dy, where 1/rᶠ is entire, 24 Gauss–Legendre
/// nodes a panel of width 2: the remainder is below 1e-15.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §3; [`crate::refs::PICOTT_1992`], eq. (3) and app. A; the
/// forms derived here. **Units:** cd/m → lx for f = 2. **Domain:** unit `n`; 0 for a line of no length and for `p`
/// within [`CONTACT`] of the light; finite on the light's axis.
/// **Accuracy:** 2e-15 of |B−A|/dᶠ, relative 5e-14, with near, far, short, long and axial lights among the cases
/// (`closed_form::line`). **Twin:** `shaders/line.wgsl`.
pub fn line_irradiance(light: &LineEmitter, p: DVec3, n: DVec3) -> f64 {
    let by_ends = if light.falloff == 2.0 { irradiance_by_ends(light, p, n) } else { None };
    by_ends.unwrap_or_else(|| {
        let visible = LineFrame::new(light, p).and_then(|line| line.above(n));
        visible.map_or(0.0, |visible| visible.irradiance(n, light.falloff))
    })
}

/// [`line_irradiance`] for f = 2 without the foot, which a line seen under less than 168° does not need; none otherwise.
fn irradiance_by_ends(light: &LineEmitter, p: DVec3, n: DVec3) -> Option<f64> {
    let (mut a, mut b) = (light.a - p, light.b - p);
    let along = light.b - light.a;
    let (mut above_a, mut above_b) = (n.dot(a), n.dot(b));
    let mut visible = 1.0;
    if above_a.min(above_b) < 0.0 {
        if above_a.max(above_b) <= 0.0 {
            return Some(0.0);
        }
        visible = above_a.max(above_b) / (above_a - above_b).abs();
        if above_a < above_b {
            (a, above_a) = (b - visible * along, 0.0);
        } else {
            (b, above_b) = (a + visible * along, 0.0);
        }
    }
    let (r_a, r_b) = (a.length(), b.length());
    let product = r_a * r_b;
    let opening = product + a.dot(b);
    let sum = visible * along.length() * (above_a * r_b + above_b * r_a);
    (opening > 0.02 * product).then(|| sum / (product * opening))
}

/// The specular integral ∫ max(0, r·w)ᵐ/rᶠ ds over the part of a line above n's horizon, without (m+1)/(2π).
///
/// For f = 2 it is ampᵐ·(x/d)·mean of cosᵐφ over the angle x that the visible part subtends, amp being the length of r
/// projected on the plane of p and the line. For other f it is integrated over y with ds = r dy.
///
/// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], eq. (3); clipping by n from [`crate::refs::SNYDER_1996`], eq. 9.
/// **Domain:** unit `n` and `r`, any real m ≥ 1; as [`line_irradiance`] otherwise. **Units:** cd/m → cd/m².
/// **Accuracy:** f = 2: 1e-14 of |B−A|/d², relative 2e-12 (`closed_form::line`). **Twin:** `shaders/line.wgsl`.
pub fn line_phong(light: &LineEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> f64 {
    LineFrame::new(light, p).and_then(|line| line.above(n)).map_or(0.0, |visible| visible.phong(r, m, light.falloff))
}

/// [`line_phong`] over r·w > 0 only, the domain of [`crate::refs::POULIN_AMANATIDES_1990`].
pub fn line_phong_lobe_only(light: &LineEmitter, p: DVec3, r: DVec3, m: f64) -> f64 {
    LineFrame::new(light, p).map_or(0.0, |line| line.phong(r, m, light.falloff))
}

/// The line as one point light of its whole intensity at its middle.
pub fn line_point(light: &LineEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    falloff_response(light.middle() - at.p, light.length(), light.falloff, at.n, at.mirror(), lobe)
}

/// A line as seen from a point: `foot + s·axis`, a ≤ s ≤ b.
#[derive(Clone, Copy, Debug)]
pub struct LineFrame {
    foot: DVec3,
    axis: DVec3,
    d: f64,
    a: f64,
    b: f64,
    /// b − a, which the difference does not give for short lines far away.
    length: f64,
}

impl LineFrame {
    /// The frame of a light about `p`; none for a line of no length and where `p` touches it.
    pub fn new(light: &LineEmitter, p: DVec3) -> Option<Self> {
        let (to_a, to_b) = (light.a - p, light.b - p);
        let along = light.b - light.a;
        let length = along.length();
        if length < CONTACT {
            return None;
        }
        let axis = along / length;
        // The foot is found from the nearer end, so that its rounding is that of the shorter vector.
        let (foot, a, b) = if to_a.length_squared() < to_b.length_squared() {
            let a = to_a.dot(axis);
            (to_a - a * axis, a, a + length)
        } else {
            let b = to_b.dot(axis);
            (to_b - b * axis, b - length, b)
        };
        let d = foot.length();
        let beside = a <= 0.0 && b >= 0.0;
        let beyond = if beside { 0.0 } else { a.abs().min(b.abs()) };
        let distance = (d * d + beyond * beyond).sqrt();
        (distance >= CONTACT).then_some(Self { foot, axis, d, a, b, length })
    }

    /// The part where n·w > 0.
    pub fn above(self, n: DVec3) -> Option<Self> {
        let (base, slope) = (n.dot(self.foot), n.dot(self.axis));
        let (at_a, at_b) = (base + self.a * slope, base + self.b * slope);
        if at_a <= 0.0 && at_b <= 0.0 {
            return None;
        }
        if at_a >= 0.0 && at_b >= 0.0 {
            return Some(self);
        }
        let length = self.length * (at_a.max(at_b) / (at_a - at_b).abs());
        let clipped = if at_a < 0.0 {
            Self { a: self.b - length, length, ..self }
        } else {
            Self { b: self.a + length, length, ..self }
        };
        (length > 0.0).then_some(clipped)
    }

    /// See [`line_irradiance`]; the frame is already clipped.
    fn irradiance(&self, n: DVec3, falloff: f64) -> f64 {
        let (base, slope) = (n.dot(self.foot), n.dot(self.axis));
        let ends = Ends::of(self);
        let sum = if falloff == 2.0 {
            ends.length * ((base + self.a * slope) / ends.r_a + (base + self.b * slope) / ends.r_b) / ends.opening
        } else if falloff == 0.0 {
            base * ends.asinh_difference(self) + slope * ends.length * (self.a + self.b) / (ends.r_a + ends.r_b)
        } else if falloff == 1.0 {
            base * ends.angle_over_d(self) + slope * ends.log_ratio(self)
        } else if falloff == 3.0 {
            let square = ends.r_a * ends.r_a * ends.r_b * ends.r_b;
            base * ends.fourth_power_integral(self) + 0.5 * slope * ends.length * (self.a + self.b) / square
        } else {
            let path = Path::of(self, &ends);
            panels(0.0, path.end, 2.0, |y| {
                let (r, s) = path.at(y);
                (base + s * slope) * r.powf(-falloff)
            })
        };
        sum.max(0.0)
    }

    /// ∫ max(0, r·w)ᵐ/rᶠ ds; see [`line_phong`].
    fn phong(&self, r: DVec3, m: f64, falloff: f64) -> f64 {
        let Some(lit) = self.above(r) else { return 0.0 };
        if falloff == 2.0 {
            let seen = lit.seen_from_lobe(r);
            return seen.amplitude.powf(m) * seen.angle_over_d * cosine_power_mean(m, seen.from, seen.angle);
        }
        lit.lobe_integral(r, falloff, |cos| cos.max(0.0).powf(m))
    }

    /// [`Self::phong`] with cosᵐ in the plane of p and the line replaced by its Chebyshev fit.
    ///
    /// **Source:** [`crate::refs::POULIN_AMANATIDES_1990`], §4.1. **Method error:** at most 0.001 of ∫ ds/r² for m in
    /// 1…1000 (`closed_form::line`).
    fn chebyshev(&self, r: DVec3, falloff: f64, lobe: &PhongLobe) -> f64 {
        let Some(lit) = self.above(r) else { return 0.0 };
        let seen = lit.seen_from_lobe(r);
        let fit = lobe.chebyshev();
        let power = seen.amplitude.powf(lobe.exponent());
        let sum = if falloff == 2.0 {
            seen.angle_over_d * fit.mean(seen.from, seen.angle)
        } else {
            lit.lobe_integral(r, falloff, |cos| {
                let cos = (cos / seen.amplitude).min(1.0);
                fit.value(((1.0 - cos) * (1.0 + cos)).sqrt().atan2(cos))
            })
        };
        (power * sum).max(0.0)
    }

    /// ∫ g(r·w)/rᶠ ds over y, ds = r dy, halving panels until 1e-14 of the whole stands.
    fn lobe_integral(&self, r: DVec3, falloff: f64, g: impl Fn(f64) -> f64) -> f64 {
        let (base, slope) = (r.dot(self.foot), r.dot(self.axis));
        let ends = Ends::of(self);
        let path = Path::of(self, &ends);
        let nearest = if self.a <= 0.0 && self.b >= 0.0 { self.d } else { ends.r_a.min(ends.r_b) };
        let scale = ends.length * nearest.powf(-falloff);
        refined_panels(0.0, path.end, 0.5, 1e-15 * scale, |y| {
            let (distance, s) = path.at(y);
            g((base + s * slope) / distance) * distance.powf(1.0 - falloff)
        })
    }

    /// The angles at which a part wholly in the lobe is seen, from r projected on the plane of p and the line.
    fn seen_from_lobe(&self, r: DVec3) -> Seen {
        let toward_foot = if self.d > 0.0 { self.foot / self.d } else { self.axis.any_orthonormal_vector() };
        let (across, along) = (r.dot(toward_foot), r.dot(self.axis));
        let ends = Ends::of(self);
        Seen {
            amplitude: across.hypot(along).min(1.0),
            from: (across * self.a - along * self.d).atan2(across * self.d + along * self.a),
            angle: ends.angle(self),
            angle_over_d: ends.angle_over_d(self),
        }
    }

    /// The point of least angle to r, relative to p.
    ///
    /// **Source:** [`crate::refs::PICOTT_1992`], eq. (7) and app. B, taken only where it is a maximum between the ends.
    pub fn nearest(&self, r: DVec3) -> DVec3 {
        let (base, slope) = (r.dot(self.foot), r.dot(self.axis));
        // cos = (base + s·slope)/√(d² + s²) is stationary at s = slope·d²/base, a maximum for base > 0.
        let at = |s: f64| self.foot + s * self.axis;
        let cos = |s: f64| (base + s * slope) / self.d.hypot(s);
        let end = if cos(self.a) >= cos(self.b) { self.a } else { self.b };
        if base > 0.0 {
            let s = slope * self.d * self.d / base;
            if self.a < s && s < self.b {
                return at(s);
            }
        }
        at(end)
    }
}

/// What a lobe sees of a line.
struct Seen {
    /// Length of r projected on the plane of p and the line.
    amplitude: f64,
    /// Angle from the projected r to the end a.
    from: f64,
    /// Angle from the end a to the end b.
    angle: f64,
    /// That angle over the distance to the line, its limit on the line.
    angle_over_d: f64,
}

/// The ends of a [`LineFrame`].
struct Ends {
    length: f64,
    r_a: f64,
    r_b: f64,
    /// r_a r_b + A·B = r_a r_b (1 + cos x), x the angle between the ends.
    opening: f64,
}

impl Ends {
    fn of(line: &LineFrame) -> Self {
        let (d_squared, a, b) = (line.d * line.d, line.a, line.b);
        let r_a = (d_squared + a * a).sqrt();
        let r_b = (d_squared + b * b).sqrt();
        let (product, ab) = (r_a * r_b, a * b);
        let opening = if ab >= 0.0 {
            product + d_squared + ab
        } else {
            d_squared * (1.0 + (d_squared + a * a + b * b) / (product - ab))
        };
        Self { length: line.length, r_a, r_b, opening }
    }

    /// x between the ends.
    fn angle(&self, line: &LineFrame) -> f64 {
        (line.d * self.length).atan2(line.d * line.d + line.a * line.b)
    }

    /// ∫ ds/r² = x/d.
    fn angle_over_d(&self, line: &LineFrame) -> f64 {
        if line.d > 0.0 { self.angle(line) / line.d } else { self.length / (self.r_a * self.r_b) }
    }

    /// ∫ ds/r = asinh(b/d) − asinh(a/d) = ln((r_a + r_b + L)/(r_a + r_b − L)).
    fn asinh_difference(&self, line: &LineFrame) -> f64 {
        let (a, b, d_squared) = (line.a.abs(), line.b.abs(), line.d * line.d);
        let excess = if line.a * line.b < 0.0 {
            d_squared / (self.r_a + a) + d_squared / (self.r_b + b)
        } else if a < b {
            self.r_a + a + d_squared / (self.r_b + b)
        } else {
            self.r_b + b + d_squared / (self.r_a + a)
        };
        (2.0 * self.length / excess).ln_1p()
    }

    /// ∫ s ds/r² = ln(r_b/r_a).
    fn log_ratio(&self, line: &LineFrame) -> f64 {
        let difference = self.length * (line.a + line.b);
        if difference >= 0.0 {
            0.5 * (difference / (self.r_a * self.r_a)).ln_1p()
        } else {
            -0.5 * (-difference / (self.r_b * self.r_b)).ln_1p()
        }
    }

    /// ∫ ds/r⁴ = ½[(x − sin x)/d³ + t(1/r_a + 1/r_b)²/(1 + cos x)], t = sin x/d = L/(r_a r_b).
    fn fourth_power_integral(&self, line: &LineFrame) -> f64 {
        let product = self.r_a * self.r_b;
        let t = self.length / product;
        let sin = t * line.d;
        let excess = if sin < 0.3 && line.d * line.d + line.a * line.b > 0.0 {
            t * t * t * asin_excess(sin)
        } else {
            (self.angle(line) - sin) / (line.d * line.d * line.d)
        };
        let sum = (self.r_a + self.r_b) / product;
        0.5 * (excess + t * sum * sum * product / self.opening)
    }
}

/// A line walked in y with ds = r dy: r = α eʸ + β e⁻ʸ, s = α eʸ − β e⁻ʸ from a at y = 0 to b at `end`.
struct Path {
    alpha: f64,
    beta: f64,
    end: f64,
}

impl Path {
    fn of(line: &LineFrame, ends: &Ends) -> Self {
        let large = 0.5 * (ends.r_a + line.a.abs());
        let small = 0.25 * line.d * line.d / large;
        let (alpha, beta) = if line.a >= 0.0 { (large, small) } else { (small, large) };
        Self { alpha, beta, end: ends.asinh_difference(line) }
    }

    /// Distance and place on the line.
    fn at(&self, y: f64) -> (f64, f64) {
        let growth = y.exp();
        let (up, down) = (self.alpha * growth, self.beta / growth);
        (up + down, up - down)
    }
}
