//! Spherical lights, which a point sees as caps: the directions within an angle σ of a centre.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::DVec3;

use super::point::{CONTACT, point_response};
use super::{Method, PhongLobe, Response, ShadingPoint, cluster};
use crate::light::SphereEmitter;
use crate::math::special::{NEGLIGIBLE_LN, circular_segment, panels};

/// Response to a sphere of luminance 1 by a method.
pub fn respond(light: &SphereEmitter, method: Method, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    match method {
        Method::PointCluster(points) => return cluster::sphere_cluster(light, points, at, lobe),
        Method::Point => return sphere_point(light, at, lobe),
        _ => {}
    }
    let irradiance = match method {
        Method::Hermite1 => sphere_irradiance_hermite_1(light, at.p, at.n),
        Method::Hermite2 => sphere_irradiance_hermite_2(light, at.p, at.n),
        _ => sphere_irradiance(light, at.p, at.n),
    };
    Response { irradiance, specular: sphere_phong(light, at.p, at.n, at.mirror(), lobe.exponent()) }
}

/// Irradiance at `p` on a surface of normal `n` from a sphere of luminance 1: [`cap_irradiance`] of its cap.
///
/// A sphere at a distance d wholly above the surface's plane is as a point light: E = π r² cos ω/d².
pub fn sphere_irradiance(light: &SphereEmitter, p: DVec3, n: DVec3) -> f64 {
    away_from_horizon(light, p, n).unwrap_or_else(|| cap_irradiance(&Cap::of_sphere(light, p, n), n))
}

/// [`sphere_irradiance`] by [`cap_irradiance_hermite_1`].
pub fn sphere_irradiance_hermite_1(light: &SphereEmitter, p: DVec3, n: DVec3) -> f64 {
    away_from_horizon(light, p, n).unwrap_or_else(|| cap_irradiance_hermite_1(&Cap::of_sphere(light, p, n), n))
}

/// [`sphere_irradiance`] by [`cap_irradiance_hermite_2`].
pub fn sphere_irradiance_hermite_2(light: &SphereEmitter, p: DVec3, n: DVec3) -> f64 {
    away_from_horizon(light, p, n).unwrap_or_else(|| cap_irradiance_hermite_2(&Cap::of_sphere(light, p, n), n))
}

/// The irradiance of a sphere that the horizon does not cut; none where it does, or may do, and for `p` inside.
fn away_from_horizon(light: &SphereEmitter, p: DVec3, n: DVec3) -> Option<f64> {
    let to_center = light.center - p;
    let height = n.dot(to_center);
    let square = to_center.length_squared();
    if height.abs() <= light.radius || square <= (light.radius * light.radius).max(CONTACT * CONTACT) {
        return None;
    }
    Some(if height > 0.0 { PI * light.radius * light.radius * height / (square * square.sqrt()) } else { 0.0 })
}

/// (m+1)/(2π) ∫ (r·ω)ᵐ dω over a sphere where r·ω > 0 and n·ω > 0: [`cap_phong`] of its cap.
pub fn sphere_phong(light: &SphereEmitter, p: DVec3, n: DVec3, r: DVec3, m: f64) -> f64 {
    cap_phong(&Cap::of_sphere(light, p, n), n, r, m)
}

/// The sphere as one point light at its centre, I = πr²·L.
pub fn sphere_point(light: &SphereEmitter, at: &ShadingPoint, lobe: &PhongLobe) -> Response {
    point_response(light.center - at.p, PI * light.radius * light.radius, at, lobe)
}

/// The directions within σ ≤ π/2 of a centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cap {
    center: DVec3,
    sin: f64,
    cos: f64,
}

impl Cap {
    /// The cap about a unit direction.
    pub fn new(center: DVec3, half_angle: f64) -> Self {
        let (sin, cos) = half_angle.sin_cos();
        Self { center, sin, cos: cos.max(0.0) }
    }

    /// The cap that a sphere fills as seen from `p`. From inside everything is light, of which a surface sees the half
    /// about its normal `n`.
    ///
    /// **Source:** [`crate::refs::SNYDER_1996`], eq. (7). **Deviation:** p inside the sphere.
    pub fn of_sphere(light: &SphereEmitter, p: DVec3, n: DVec3) -> Self {
        let to_center = light.center - p;
        let distance = to_center.length();
        if distance <= light.radius || distance < CONTACT {
            return Self { center: n, sin: 1.0, cos: 0.0 };
        }
        let sin = light.radius / distance;
        let cos = ((distance - light.radius) * (distance + light.radius)).sqrt() / distance;
        Self { center: to_center / distance, sin, cos }
    }

    /// The unit direction to the cap's centre.
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// 2π(1 − cos σ).
    pub fn solid_angle(&self) -> f64 {
        TAU * self.sin * self.sin / (1.0 + self.cos)
    }
}

/// Irradiance on a surface of normal `n` from a cap of radiance 1.
///
/// E = π sin²σ cos ω where the cap is wholly above the horizon, else (δ − sin δ cos δ) + cos²ω sin δ cos δ + cos ω sin²σ β
///
/// with q² = sin²σ − cos²ω, δ = atan2(q, cos σ), β = atan2(q, −cos σ cos ω): [`crate::refs::SNYDER_1996`], eq. (6)
/// times π in terms that do not cancel for small σ (derived here).
///
/// **Domain:** unit `n`. **Units:** cd·m⁻² → lx. **Accuracy:** 1e-15 of π sin²σ (1e-13 for a sphere that `p` nearly
/// touches), relative 2e-11 for more than a millionth of that (`closed_form::sphere`). **Twin:** `shaders/sphere.wgsl`.
pub fn cap_irradiance(cap: &Cap, n: DVec3) -> f64 {
    let cos_omega = n.dot(cap.center);
    let sin_squared = cap.sin * cap.sin;
    if cos_omega >= cap.sin {
        return PI * sin_squared * cos_omega;
    }
    if cos_omega <= -cap.sin {
        return 0.0;
    }
    let q = ((cap.sin - cos_omega) * (cap.sin + cos_omega)).sqrt();
    let hypotenuse = (q * q + cap.cos * cap.cos).sqrt();
    let (sin_delta, cos_delta) = (q / hypotenuse, cap.cos / hypotenuse);
    let segment = circular_segment(q.atan2(cap.cos), sin_delta, cos_delta);
    let beta = q.atan2(-cap.cos * cos_omega);
    (segment + cos_omega * (cos_omega * sin_delta * cos_delta + sin_squared * beta)).max(0.0)
}

/// [`cap_irradiance`] with one cubic Hermite segment where the horizon cuts the cap.
///
/// **Source:** [`crate::refs::SNYDER_1996`], §2.2. **Method error:** 0.0075, 0.021, 0.033, 0.042, 0.010 of π sin²σ at σ = π/16, π/6, π/4, π/3, π/2
/// (`closed_form::sphere`).
pub fn cap_irradiance_hermite_1(cap: &Cap, n: DVec3) -> f64 {
    let fillet = |sigma: f64, elevation: f64| {
        let from = [cap.sin.powi(3), -cap.cos * cap.sin * cap.sin];
        PI * hermite([-sigma, sigma], from, [0.0, 0.0], -elevation)
    };
    with_fillet(cap, n, fillet)
}

/// [`cap_irradiance`] with two cubic Hermite segments where the horizon cuts the cap.
///
/// **Source:** [`crate::refs::SNYDER_1996`], §2.2. **Method error:** 0.0007, 0.0022, 0.0037, 0.0055, 0.0054 of π sin²σ at the same σ
/// (`closed_form::sphere`).
pub fn cap_irradiance_hermite_2(cap: &Cap, n: DVec3) -> f64 {
    let fillet = |sigma: f64, elevation: f64| {
        let sin_squared = cap.sin * cap.sin;
        let middle = [circular_segment(sigma, cap.sin, cap.cos) / PI, -0.5 * sin_squared];
        PI * if elevation > 0.0 {
            hermite([-sigma, 0.0], [cap.sin * sin_squared, -cap.cos * sin_squared], middle, -elevation)
        } else {
            hermite([0.0, sigma], middle, [0.0, 0.0], -elevation)
        }
    };
    with_fillet(cap, n, fillet)
}

/// The exact irradiance of a cap away from the horizon, and `fillet(σ, elevation of the centre)` where it is cut.
fn with_fillet(cap: &Cap, n: DVec3, fillet: impl Fn(f64, f64) -> f64) -> f64 {
    let cos_omega = n.dot(cap.center);
    if cos_omega >= cap.sin {
        PI * cap.sin * cap.sin * cos_omega
    } else if cos_omega <= -cap.sin {
        0.0
    } else {
        let sin_omega = n.cross(cap.center).length();
        fillet(cap.sin.atan2(cap.cos), cos_omega.atan2(sin_omega)).max(0.0)
    }
}

/// The cubic with given [value, slope] at the ends of an interval, at x.
fn hermite([x_0, x_1]: [f64; 2], [f_0, slope_0]: [f64; 2], [f_1, slope_1]: [f64; 2], x: f64) -> f64 {
    let width = x_1 - x_0;
    let y = (x - x_0) / width;
    let (g_0, g_1, rise) = (width * slope_0, width * slope_1, f_1 - f_0);
    (((g_0 + g_1 - 2.0 * rise) * y + 3.0 * rise - g_1 - 2.0 * g_0) * y + g_0) * y + f_0
}

/// (m+1)/(2π) ∫ (r·ω)ᵐ dω over a cap where r·ω > 0 and n·ω > 0.
///
/// By Stokes' theorem in polar coordinates (z, ψ) about r, for any constant c: I = (1/2π) ∮ (c − zᵐ⁺¹) dψ over the boundary
/// of that region, plus 1 − c where r is inside it. c = 1 removes the singularity of dψ for r near the boundary; far from it
/// c = z₀ᵐ⁺¹, z₀ in the middle, removes the cancellation. Three kinds of arc occur: of the cap's circle, of n's
/// horizon, and of r's horizon, where the integrand is c. A circle that no horizon cuts is integrated by the midpoint
/// rule, which converges geometrically there (`Boundary::circle_nodes`). Otherwise parts where zᵐ⁺¹ is negligible are c Δψ; the rest takes 24
/// Gauss–Legendre nodes in panels of at most 1.6.
///
/// **Source:** [`crate::refs::SNYDER_1996`], §3.2, with eq. (9); this form, which serves odd, even and real m and both
/// horizons, derived here. **Domain:** unit `n`, `r`; any real m ≥ 1.
/// **Accuracy:** 1e-15 of the smaller of 1 and (m+1)/(2π)·Ω for caps and 5e-14 for spheres, relative 1e-10 for more than
/// a millionth of that (`closed_form::sphere`). **Twin:** `shaders/sphere.wgsl`.
pub fn cap_phong(cap: &Cap, n: DVec3, r: DVec3, m: f64) -> f64 {
    let about_n = cap.cos == 0.0 && cap.center == n;
    Boundary::new(cap, r, m).integral((!about_n).then_some(n))
}

/// [`cap_phong`] over r·ω > 0 only, the domain of [`crate::refs::SNYDER_1996`], eq. (24).
pub fn cap_phong_lobe_only(cap: &Cap, r: DVec3, m: f64) -> f64 {
    Boundary::new(cap, r, m).integral(None)
}

/// A cap this much of whose σ's sine is above the horizon counts as wholly above: circle and horizon, if both are great
/// circles within 1e-7 of each other, have no crossings that could be found.
const WHOLE: f64 = 1.0 - 4e-15;

/// Widest panel of 24 nodes, in radians: the integrands' poles are at least ln 2 from the real line, for a remainder of 1e-16.
const PANEL: f64 = 1.6;

/// ln of how much greater the integrand may be off the real line in the bound of the midpoint rule.
const CIRCLE_GROWTH: f64 = 20.0;

/// Most nodes on half of a circle; beyond, panels about the peak need no more.
const CIRCLE_NODES: f64 = 32.0;

/// The constant c of [`cap_phong`].
#[derive(Clone, Copy, Debug)]
enum Offset {
    /// c = 1.
    One,
    /// c = z₀ᵐ⁺¹, z₀ = cos σ cos ω; holds c.
    Middle(f64),
    /// c = 0.
    Zero,
}

/// The boundary of the part of a cap that a lobe sees, in the frame with z along r and the cap's centre at y = 0.
struct Boundary {
    sin_sigma: f64,
    cos_sigma: f64,
    sin_omega: f64,
    cos_omega: f64,
    x_axis: DVec3,
    y_axis: DVec3,
    r: DVec3,
    power: f64,
    offset: Offset,
    /// zᵐ⁺¹ is negligible where z is below this.
    z_cut: f64,
}

impl Boundary {
    fn new(cap: &Cap, r: DVec3, m: f64) -> Self {
        let across = r.cross(cap.center);
        let (sin_omega, cos_omega) = (across.length(), r.dot(cap.center));
        let y_axis = if sin_omega > 0.0 { across / sin_omega } else { r.any_orthonormal_vector() };
        let power = m + 1.0;
        let middle = cap.cos * cos_omega;
        let far = cap.sin < 0.5 * sin_omega;
        let offset = if !far && cos_omega > -cap.sin {
            Offset::One
        } else if cos_omega > cap.sin {
            Offset::Middle(middle.powf(power))
        } else {
            Offset::Zero
        };
        let highest = if sin_omega > cap.sin || cos_omega < 0.0 { middle + cap.sin * sin_omega } else { 1.0 };
        Self {
            sin_sigma: cap.sin,
            cos_sigma: cap.cos,
            sin_omega,
            cos_omega,
            x_axis: y_axis.cross(r),
            y_axis,
            r,
            power,
            offset,
            z_cut: highest * (-NEGLIGIBLE_LN / power).exp(),
        }
    }

    /// I over the cap above r's horizon, and n's where given.
    fn integral(&self, n: Option<DVec3>) -> f64 {
        if self.cos_omega <= -self.sin_sigma {
            return 0.0;
        }
        let boundary = match n.map(|n| DVec3::new(n.dot(self.x_axis), n.dot(self.y_axis), n.dot(self.r))) {
            None => self.whole(),
            Some(n) => {
                let elevation = n.x * self.sin_omega + n.z * self.cos_omega;
                let opposite = n.x == 0.0 && n.y == 0.0 && n.z < 0.0;
                if elevation <= -self.sin_sigma || opposite {
                    return 0.0;
                }
                if elevation >= self.sin_sigma * WHOLE {
                    self.whole()
                } else {
                    self.circle(n, elevation) + self.horizon(n, elevation) + self.lobe_horizon(Some(n))
                }
            }
        };
        (boundary / TAU).max(0.0)
    }

    /// The boundary where n's horizon cuts nothing off.
    fn whole(&self) -> f64 {
        if self.cos_omega >= self.sin_sigma
            && let Some(nodes) = self.circle_nodes()
        {
            return self.whole_circle(nodes);
        }
        2.0 * self.circle_piece(0.0, self.highest_phi()) + self.lobe_horizon(None)
    }

    /// How many nodes on half of the whole circle [`Self::whole_circle`] needs; none where panels need fewer.
    ///
    /// The integrand has a period of 2π and is analytic up to iη of the real line, where it is eᵍ times as great, so
    /// that the midpoint rule with N nodes on either half leaves no more than e^(g − 2Nη) of it. z = A + B cos φ gives
    /// g ≤ (m+1)·B/(A+B)·(cosh η − 1), and for c < 1 there is a pole where cosh η = (1 − A)/B; a low
    /// real power has a branch point where z = 0, at cosh η = A/B.
    fn circle_nodes(&self) -> Option<f64> {
        let (slope, middle) = (self.sin_sigma * self.sin_omega, self.cos_sigma * self.cos_omega);
        let steepness = self.power * slope / (middle + slope).max(f64::MIN_POSITIVE);
        let reach = (1.0 + CIRCLE_GROWTH / steepness.max(1e-6)).acosh();
        let at_height = |distance: f64| (distance / slope.max(f64::MIN_POSITIVE)).max(1.0).acosh();
        let mut pole = match self.offset {
            Offset::One => f64::INFINITY,
            _ => at_height(1.0 - middle),
        };
        if self.power.fract() != 0.0 && self.power <= 24.0 {
            pole = pole.min(at_height(middle));
        }
        let nodes = (0.5 * (NEGLIGIBLE_LN + CIRCLE_GROWTH) / reach.min(pole)).ceil();
        (nodes <= CIRCLE_NODES).then_some(nodes.max(4.0))
    }

    /// ∫ (c − zᵐ⁺¹) dψ over the whole circle by the midpoint rule, by symmetry on half of it.
    fn whole_circle(&self, nodes: f64) -> f64 {
        let step = (PI / nodes).cos();
        let (mut before, mut cos) = ((0.5 * PI / nodes).cos(), (0.5 * PI / nodes).cos());
        let mut sum = 0.0;
        let mut i = 0.0;
        while i < nodes {
            sum += self.circle_integrand((1.0 - cos) * (1.0 + cos), cos);
            (before, cos) = (cos, 2.0 * step * cos - before);
            i += 1.0;
        }
        sum * TAU / nodes
    }

    /// (c − zᵐ⁺¹) dψ/dφ on the circle from sin²φ and cos φ.
    fn circle_integrand(&self, sin_squared: f64, cos: f64) -> f64 {
        let x = self.sin_omega * self.cos_sigma - self.cos_omega * self.sin_sigma * cos;
        let rho_squared = x * x + self.sin_sigma * self.sin_sigma * sin_squared;
        let turning = self.sin_sigma * (self.sin_sigma * self.cos_omega - self.cos_sigma * self.sin_omega * cos);
        let above_middle = self.sin_sigma * self.sin_omega * cos;
        self.weight(rho_squared, above_middle) * turning / rho_squared.max(f64::MIN_POSITIVE)
    }

    /// c.
    fn constant(&self) -> f64 {
        match self.offset {
            Offset::One => 1.0,
            Offset::Middle(power) => power,
            Offset::Zero => 0.0,
        }
    }

    /// c − zᵐ⁺¹ from ρ² = 1 − z² and z − cos σ cos ω.
    fn weight(&self, rho_squared: f64, above_middle: f64) -> f64 {
        let middle = self.cos_sigma * self.cos_omega;
        match self.offset {
            Offset::One => -(0.5 * self.power * (-rho_squared.min(1.0)).ln_1p()).exp_m1(),
            Offset::Middle(power) => -power * (self.power * (above_middle / middle).max(-1.0).ln_1p()).exp_m1(),
            Offset::Zero => -(middle + above_middle).max(0.0).powf(self.power),
        }
    }

    /// The half-angle of the part of the cap's circle above r's horizon, from its highest point.
    fn highest_phi(&self) -> f64 {
        cut_half_angle(self.sin_sigma, self.cos_sigma, self.cos_omega)
    }

    /// The arcs of the cap's circle above both horizons.
    fn circle(&self, n: DVec3, elevation: f64) -> f64 {
        let end = self.highest_phi();
        let half = cut_half_angle(self.sin_sigma, self.cos_sigma, elevation);
        // n's tangential components at the cap's centre: towards r, and along the circle's direction there.
        let toward_r = n.z * self.sin_omega - n.x * self.cos_omega;
        let middle = n.y.atan2(toward_r);
        let mut sum = 0.0;
        for middle in [middle, -middle] {
            for turn in [-TAU, 0.0, TAU] {
                sum += self.circle_piece((middle + turn - half).max(0.0), (middle + turn + half).min(end));
            }
        }
        sum
    }

    /// ∫ (c − zᵐ⁺¹) dψ over the circle from φ = `from` to `to` in [0, π], φ from its highest point.
    fn circle_piece(&self, from: f64, to: f64) -> f64 {
        let slope = self.sin_sigma * self.sin_omega;
        let middle = self.cos_sigma * self.cos_omega;
        let cut = cut_angle(self.z_cut - middle, slope);
        let (low, across) = (self.sin_omega * self.cos_sigma, self.cos_omega * self.sin_sigma);
        let psi = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            -(self.sin_sigma * sin).atan2(low - across * cos)
        };
        let integrand = |phi: f64| {
            let (sin, cos) = phi.sin_cos();
            self.circle_integrand(sin * sin, cos)
        };
        self.piece(from, to, cut, psi, integrand)
    }

    /// The arc of n's horizon within the cap and above r's horizon, the region on its left.
    fn horizon(&self, n: DVec3, elevation: f64) -> f64 {
        let amplitude = n.x.hypot(n.y);
        if amplitude == 0.0 {
            // The horizons are one: if n = r, it counts as r's.
            return 0.0;
        }
        // τ runs from the highest point, so that z = amplitude·cos τ; the cap's part is about the centre's foot.
        let ahead = amplitude * self.cos_omega - n.x * n.z / amplitude * self.sin_omega;
        let aside = n.y / amplitude * self.sin_omega;
        let middle = aside.atan2(ahead);
        let half = ((self.sin_sigma - elevation) * (self.sin_sigma + elevation)).sqrt().atan2(self.cos_sigma);
        let cut = cut_angle(self.z_cut, amplitude);
        let z_middle = self.cos_sigma * self.cos_omega;
        let psi = |tau: f64| {
            let (sin, cos) = tau.sin_cos();
            sin.atan2(n.z * cos)
        };
        let integrand = |tau: f64| {
            let (sin, cos) = tau.sin_cos();
            let rho_squared = sin * sin + n.z * n.z * cos * cos;
            self.weight(rho_squared, amplitude * cos - z_middle) * n.z / rho_squared.max(f64::MIN_POSITIVE)
        };
        let mut sum = 0.0;
        for turn in [-TAU, 0.0, TAU] {
            let (from, to) = ((middle + turn - half).max(-FRAC_PI_2), (middle + turn + half).min(FRAC_PI_2));
            if from < to {
                sum += self.piece((-to).max(0.0), -from, cut, psi, integrand);
                sum += self.piece(from.max(0.0), to, cut, psi, integrand);
            }
        }
        sum
    }

    /// ∫ (c − zᵐ⁺¹) dψ from `from` to `to` ≥ 0, zᵐ⁺¹ being negligible beyond `cut`.
    fn piece(&self, from: f64, to: f64, cut: f64, psi: impl Fn(f64) -> f64, integrand: impl Fn(f64) -> f64) -> f64 {
        if from >= to {
            return 0.0;
        }
        let middle = cut.clamp(from, to);
        let width = middle - from;
        let core = if width <= 0.0 {
            0.0
        } else if self.power.fract() == 0.0 || self.power > 24.0 {
            panels(from, middle, PANEL, integrand)
        } else {
            // Quadratic grading makes the end, which may lie on r's horizon, smooth for low real m.
            panels(0.0, 1.0, 0.5 * PANEL / width, |u| 2.0 * u * width * integrand(middle - width * u * u))
        };
        let rest = if middle < to { self.constant() * (psi(to) - psi(middle)) } else { 0.0 };
        core + rest
    }

    /// c Δψ over the arc of r's horizon within the cap and above n's horizon.
    fn lobe_horizon(&self, n: Option<DVec3>) -> f64 {
        if self.cos_omega >= self.sin_sigma {
            return 0.0;
        }
        let q = ((self.sin_sigma - self.cos_omega) * (self.sin_sigma + self.cos_omega)).sqrt();
        let half = q.atan2(self.cos_sigma);
        let Some(n) = n.filter(|n| n.x.hypot(n.y) > 0.0) else { return 2.0 * half * self.constant() };
        let middle = n.y.atan2(n.x);
        let arc = |turn: f64| {
            let (from, to) = ((middle + turn - FRAC_PI_2).max(-half), (middle + turn + FRAC_PI_2).min(half));
            (to - from).max(0.0)
        };
        self.constant() * (arc(-TAU) + arc(0.0) + arc(TAU))
    }
}

/// The half-angle of the part of a cap's circle above a horizon at which its centre's elevation has the given sine.
fn cut_half_angle(sin_sigma: f64, cos_sigma: f64, elevation: f64) -> f64 {
    if elevation >= sin_sigma {
        PI
    } else if elevation <= -sin_sigma {
        0.0
    } else {
        ((sin_sigma - elevation) * (sin_sigma + elevation)).sqrt().atan2(-cos_sigma * elevation)
    }
}

/// The angle whose cosine is `height`/`slope`, 0 and π beyond.
fn cut_angle(height: f64, slope: f64) -> f64 {
    if height >= slope {
        0.0
    } else if height <= -slope {
        PI
    } else {
        ((slope - height) * (slope + height)).sqrt().atan2(height)
    }
}
