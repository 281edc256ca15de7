//! Skies: hemispheres of light infinitely far away.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::point::direction_response;
use super::{Method, PhongLobe, Response, ShadingPoint};
use crate::light::SkyEmitter;
use crate::math::angle::angle_between;
use crate::math::special::{NEGLIGIBLE_LN, panels};

/// Response to a sky of unit luminance by a method.
pub fn respond(light: &SkyEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::Point => sky_point(light, at, lobe),
        _ => Response {
            irradiance: sky_irradiance(light, at.n),
            specular: sky_phong(light, at.n, at.mirror(), lobe.exponent()),
        },
    }
}

/// The sky as a directional light from its zenith, of the sky's illuminance π(u + 2c/3) on a surface that faces it.
pub fn sky_point(light: &SkyEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    direction_response(light.zenith, light.illuminance(), at.n, at.mirror(), lobe)
}

/// Irradiance on a surface of normal `n` from a sky u + c cos of unit luminance.
///
/// E = u π (1 + cos ω)/2 + c ⅔ (sin ω + (π − ω) cos ω), ω the angle from the zenith to n.
///
/// **Source:** [`crate::refs::SNYDER_1996`], eq. (4) and (5), times π. **Domain:** unit `n`. **Units:** lx per cd·m⁻².
/// **Accuracy:** 5e-16 of π (`closed_form::sky`). **Twin:** `shaders/sky.wgsl`.
pub fn sky_irradiance(light: &SkyEmitter, n: DVec3) -> f64 {
    let omega = angle_between(light.zenith, n);
    let (sin, cos) = omega.sin_cos();
    let cosine = 2.0 / 3.0 * (sin + (PI - omega) * cos).max(0.0);
    light.uniform * 0.5 * PI * (1.0 + cos) + light.cosine * cosine
}

/// (m+1)/(2π) ∫ (u + c l·ω)(r·ω)ᵐ dω over the directions with r·ω > 0 and n·ω > 0 above the sky's own horizon, l·ω > 0.
///
/// The region's boundary is made of great circles, on which z = r·ω = ρ cos φ and dψ = γ dφ/(1 − z²), ψ the azimuth about
/// r and γ = r·g for the circle's inward normal g. Stokes' theorem for (1 − zᵐ⁺¹) dψ gives the uniform part. For the
/// cosine part the field zᵐ(l − (l·ω)ω), whose divergence is m (r·l) zᵐ⁻¹ − (m+2) zᵐ (l·ω), leaves
///
/// (m+1)/(m+2) [(r·l) (1/2π) ∮ (1 − zᵐ) dψ + (1/2π) Σ (l·g) ∫ zᵐ dφ]
///
/// with one integral an arc for both parts: closed where zᵐ is negligible, 24 Gauss–Legendre nodes elsewhere.
///
/// **Source:** derived here, after J. Arvo's double-axis moments (1995); over r·ω > 0 only it is
/// [`crate::refs::SNYDER_1996`], eq. (14) and (15). **Domain:** unit `n`, `r`; any real m ≥ 1.
/// **Accuracy:** 1e-15, relative 1e-11 for more than a millionth (`closed_form::sky`). **Twin:** `shaders/sky.wgsl`.
pub fn sky_phong(light: &SkyEmitter, n: DVec3, r: DVec3, m: f64) -> f64 {
    Contour::new(light, r, m).integral(n)
}

/// [`sky_phong`] over r·ω > 0 only, the domain of [`crate::refs::SNYDER_1996`], eq. (14) and (15).
pub fn sky_phong_lobe_only(light: &SkyEmitter, r: DVec3, m: f64) -> f64 {
    Contour::new(light, r, m).integral(r)
}

/// What the boundary integrals of a lobe under a sky have in common.
struct Contour {
    zenith: DVec3,
    r: DVec3,
    m: f64,
    /// u.
    uniform: f64,
    /// c (m+1)/(m+2).
    cosine: f64,
    /// r·l.
    facing: f64,
}

impl Contour {
    fn new(light: &SkyEmitter, r: DVec3, m: f64) -> Self {
        let cosine = light.cosine * (m + 1.0) / (m + 2.0);
        Self { zenith: light.zenith, r, m, uniform: light.uniform, cosine, facing: r.dot(light.zenith) }
    }

    /// The integral over what is above all three horizons. A horizon of the same normal as another is left out.
    fn integral(&self, n: DVec3) -> f64 {
        let (l, r) = (self.zenith, self.r);
        let (n_r, l_r, n_l) = (n.cross(r), l.cross(r), n.cross(l));
        let same = |cross: DVec3, cosine: f64| cross == DVec3::ZERO && cosine > 0.0;
        let opposite = |cross: DVec3, cosine: f64| cross == DVec3::ZERO && cosine <= 0.0;
        if opposite(n_r, n.dot(r)) || opposite(l_r, self.facing) || opposite(n_l, n.dot(l)) {
            return 0.0;
        }
        let leaves_n_out = same(n_r, n.dot(r)) || same(n_l, n.dot(l));
        let leaves_l_out = same(l_r, self.facing);
        // On the circle of a, k × a with k = a × b points to b, and so does on b's circle b × k to a. Both halves of two
        // circles that are nearly one come from the same k, so that they add up to a whole.
        let toward_n = |axis: DVec3| (!leaves_n_out).then_some(axis);
        let mut sum = 0.0;
        if !leaves_l_out {
            sum += self.arc(l, l_r.cross(l), toward_n(l.cross(n_l)));
        }
        if !leaves_n_out {
            sum += self.arc(n, n_r.cross(n), (!leaves_l_out).then_some(n_l.cross(n)));
        }
        let lobe_horizon = half_circles(r, (!leaves_l_out).then_some(r.cross(l_r)), toward_n(r.cross(n_r)));
        sum += (self.uniform + self.cosine * self.facing) * lobe_horizon;
        (sum / TAU).max(0.0)
    }

    /// The integrals along the part of the circle of normal `g` within a quarter turn of `peak`, its point nearest to r,
    /// and of another direction.
    fn arc(&self, g: DVec3, peak: DVec3, other: Option<DVec3>) -> f64 {
        let Some(peak) = peak.try_normalize() else { return 0.0 };
        let turn = other.map_or(0.0, |other| g.cross(peak).dot(other).atan2(peak.dot(other)));
        let (from, to) = ((turn - FRAC_PI_2).max(-FRAC_PI_2), (turn + FRAC_PI_2).min(FRAC_PI_2));
        let gamma = self.r.dot(g);
        let rho = self.r.cross(g).length();
        let lambertian = self.cosine * self.zenith.dot(g);
        let settled = self.uniform + self.cosine * self.facing;
        let integrand = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            let off_axis = gamma * gamma + (rho * sin) * (rho * sin);
            let log = 0.5 * (-off_axis.min(1.0)).ln_1p();
            let (missing, power) = if off_axis > 0.0 {
                let lower = -(self.m * log).exp_m1();
                let upper = -((self.m + 1.0) * log).exp_m1();
                ((self.uniform * upper + self.cosine * self.facing * lower) / off_axis, 1.0 - lower)
            } else {
                (0.5 * (self.uniform * (self.m + 1.0) + self.cosine * self.facing * self.m), 1.0)
            };
            gamma * missing + if cos > 0.0 { lambertian * power } else { 0.0 }
        };
        let azimuth = |from: f64, to: f64| {
            let cross = gamma * (to - from).sin();
            cross.atan2(from.sin() * to.sin() + gamma * gamma * from.cos() * to.cos())
        };
        // Of the side of the peak that φ = sign·x is on, x from 0 to π/2.
        let side = |from: f64, to: f64, sign: f64| {
            if from >= to {
                return 0.0;
            }
            let middle = self.reach(rho).clamp(from, to);
            let far = if middle < to { settled * azimuth(middle, to) } else { 0.0 };
            far + self.core(from, middle, |phi| integrand(sign * phi))
        };
        side((-to).max(0.0), -from, -1.0) + side(from.max(0.0), to, 1.0)
    }

    /// |φ| beyond which zᵐ is negligible.
    fn reach(&self, rho: f64) -> f64 {
        let cosine = (-NEGLIGIBLE_LN / self.m).exp() / rho.max(f64::MIN_POSITIVE);
        if cosine < 1.0 { ((1.0 - cosine) * (1.0 + cosine)).sqrt().atan2(cosine) } else { 0.0 }
    }

    /// ∫ f over [from, to] in [0, π/2], at whose end a low real power has a branch point, which t² makes smooth.
    fn core(&self, from: f64, to: f64, f: impl Fn(f64) -> f64) -> f64 {
        if from >= to {
            return 0.0;
        }
        let width = to - from;
        if self.m < 24.0 && self.m.fract() != 0.0 {
            panels(0.0, 1.0, 0.5, |t| 2.0 * t * width * f(to - width * t * t))
        } else {
            panels(from, to, 1.6, f)
        }
    }
}

/// The length of the part of a circle of normal `g` within a quarter turn of both directions; without one, half of it.
fn half_circles(g: DVec3, one: Option<DVec3>, other: Option<DVec3>) -> f64 {
    match (one, other) {
        (Some(one), Some(other)) => PI - g.dot(one.cross(other)).atan2(one.dot(other)).abs(),
        (None, None) => TAU,
        _ => PI,
    }
}
