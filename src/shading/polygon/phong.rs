//! The Phong lobe over a polygon, exactly.

use std::f64::consts::PI;
use std::sync::LazyLock;

use glam::DVec3;

use super::area::{EdgeSum, area_integral};
use super::edges;
use crate::math::quadrature::GaussLegendre;
use crate::math::spherical::{Edge, HorizonClip, azimuth_between};

/// (m+1)/(2π) ∫ (ω·r)ᵐ dω over the polygon's directions from p with ω·r > 0 and ω·n > 0; luminance 1.
///
/// I = (1/2π) |Σ ∫ (1 − z^(m+1)) dψ| over the edges of the polygon clipped by both horizons and over its pieces of the
/// horizons, z = ω·r, ψ the azimuth about r.
///
/// **Source:** Stokes' theorem applied to [`SNYDER_1996`](crate::refs::SNYDER_1996), eq. 9, for real m, derived here: the
/// one-form (1 − z^(m+1)) dψ has no singularity at r, and its derivative is (m+1) zᵐ dω.
/// **Method:** integer exponents to 200 by the boundary series of his eq. 25; others by quadrature along each arc; where
/// the sum cancels, because the light is tiny or a sliver as seen from p, by quadrature over its area.
/// **Domain:** unit r and n, real m ≥ 1, any planar simple polygon, either way round; two-sided.
/// **Units:** 1 per cd·m⁻².
/// **Accuracy:** 2e-12 of the scale within 1e-6 of the light, 4e-14 elsewhere (`closed_form::polygon`).
/// **Twin:** `shaders/polygon.wgsl`.
pub fn polygon_phong(vertices: &[DVec3], p: DVec3, n: DVec3, r: DVec3, m: f64) -> f64 {
    let mut above_surface = HorizonClip::new(n);
    let clipped = edges(vertices, p).flat_map(move |edge| {
        let [above, horizon] = above_surface.clip(edge);
        [above.map(|edge| (edge, None)), horizon.map(|edge| (edge, Some(n)))]
    });
    contour(vertices, p, r, m, clipped.flatten())
}

/// As [`polygon_phong`] over ω·r > 0 alone, which is [`SNYDER_1996`](crate::refs::SNYDER_1996), eq. 9, as printed: it
/// counts light from below the surface.
pub fn polygon_phong_lobe_only(vertices: &[DVec3], p: DVec3, r: DVec3, m: f64) -> f64 {
    contour(vertices, p, r, m, edges(vertices, p).map(|edge| (edge, None)))
}

/// An edge, and the normal of its plane through p where that is known beforehand but for its sign.
type KnownEdge = (Edge, Option<DVec3>);

/// The greatest exponent for which the series, whose cost grows with it, is cheaper than quadrature.
const SERIES_LIMIT: f64 = 200.0;

/// The contour integral over closed loops of edges, which are clipped to the horizon of r here.
fn contour(vertices: &[DVec3], p: DVec3, r: DVec3, m: f64, loops: impl Iterator<Item = KnownEdge> + Clone) -> f64 {
    let mut above_lobe = HorizonClip::new(r);
    let clipped = loops.map(move |(edge, normal)| (above_lobe.clip(edge), normal));
    let in_series = m <= SERIES_LIMIT && m.fract() == 0.0;
    let along = |edge, normal| match Arc::new(edge, normal, r) {
        Some(arc) if in_series => arc.series(m),
        Some(arc) => arc.quadrature(m),
        None => 0.0,
    };
    let terms = clipped.clone().flat_map(|([above, horizon], normal)| {
        [above.map(|edge| along(edge, normal)), horizon.map(|(a, b)| azimuth_between(r, a, b))].into_iter().flatten()
    });
    let sum: EdgeSum = terms.collect();
    // The area's rule has no nodes to spare for the branch point of a broken power.
    let accuracy = if has_branch_point(m) { 10.0 } else { 1.0 };
    if sum.cancels(vertices, p, m + 1.0, accuracy) {
        let resolution = m.sqrt().recip().min(0.3);
        let loops = clipped.flat_map(|(edges, _)| edges).flatten();
        (m + 1.0) / (2.0 * PI) * area_integral(loops, resolution, &|direction| direction.dot(r).max(0.0).powf(m)).abs()
    } else {
        sum.value.abs() / (2.0 * PI)
    }
}

/// A great-circle arc, in terms of its relation to the lobe's axis r.
///
/// Along it z = ρ cos φ and dψ = γ dφ/(γ² + ρ² sin² φ), φ the angle from the point nearest to r.
#[derive(Clone, Copy, Debug)]
struct Arc {
    /// r·Γ, Γ the unit normal of the arc's plane: the signed sine of the distance from r to the great circle.
    gamma: f64,
    /// √(1 − γ²): z at the great circle's nearest point to r.
    rho: f64,
    /// φ at the start.
    phi: f64,
    /// Angle subtended.
    theta: f64,
}

/// Where z^(m+1) is less than e^-CUT it is nothing beside 1.
const CUT: f64 = 40.0;

impl Arc {
    fn new((a, b): Edge, normal: Option<DVec3>, r: DVec3) -> Option<Self> {
        let cross = a.cross(b - a);
        let sine = cross.length();
        (sine > 0.0).then(|| {
            // The cross product loses its direction when the edge passes close by.
            let normal = normal.map_or(cross / sine, |n| n * cross.dot(n).signum());
            Self {
                gamma: r.dot(normal),
                rho: r.cross(normal).length(),
                phi: r.dot(a.cross(normal)).atan2(r.dot(a)),
                theta: sine.atan2(a.dot(b)),
            }
        })
    }

    /// ∫ (1 − z^(m+1)) dψ for integer m.
    ///
    /// With sₖ = ∫ zᵏ dφ it is γ(s₀ + s₂ + … + s₍ₘ₋₁₎) for odd m, and σ + γ(s₁ + s₃ + … + s₍ₘ₋₁₎) for even m, σ the solid
    /// angle of the arc and r. k sₖ = [ρ sin φ zᵏ⁻¹] + (k − 1) ρ² sₖ₋₂.
    fn series(&self, m: f64) -> f64 {
        let (sin_from, cos_from) = self.phi.sin_cos();
        let (sin_to, cos_to) = (self.phi + self.theta).sin_cos();
        let (z_from, z_to, rho_squared) = (self.rho * cos_from, self.rho * cos_to, self.rho * self.rho);
        let even = m % 2.0 == 0.0;
        let mut k = if even { 1.0 } else { 0.0 };
        let mut moment = if even {
            2.0 * self.rho * (self.phi + 0.5 * self.theta).cos() * (0.5 * self.theta).sin()
        } else {
            self.theta
        };
        let mut edge_from = self.rho * sin_from * if even { z_from * z_from } else { z_from };
        let mut edge_to = self.rho * sin_to * if even { z_to * z_to } else { z_to };
        let mut sum = moment;
        while k + 2.0 < m {
            k += 2.0;
            moment = (edge_to - edge_from + (k - 1.0) * rho_squared * moment) / k;
            edge_from *= z_from * z_from;
            edge_to *= z_to * z_to;
            sum += moment;
        }
        self.gamma * sum + if even { self.solid_angle() } else { 0.0 }
    }

    /// The signed solid angle of the triangle of r and the arc, ∫ (1 − z) dψ.
    fn solid_angle(&self) -> f64 {
        let (from, to) = (self.phi, self.phi + self.theta);
        let (s_from, s_to) = (self.rho * from.sin(), self.rho * to.sin());
        let shaded = (self.gamma * (s_to - s_from)).atan2(self.gamma * self.gamma + s_from * s_to);
        self.azimuth(from, to) - shaded
    }

    /// ∫ (1 − z^(m+1)) dψ for real m, by quadrature where z^(m+1) counts and in closed form elsewhere.
    fn quadrature(&self, m: f64) -> f64 {
        let (from, to) = (self.phi, self.phi + self.theta);
        let reach = self.reach(m);
        let (lo, hi) = (from.max(-reach), to.min(reach));
        if lo < hi {
            self.azimuth(from, lo) + self.core(m, lo, hi) + self.azimuth(hi, to)
        } else {
            self.azimuth(from, to)
        }
    }

    /// |φ| beyond which z^(m+1) is negligible; 0 when it is everywhere.
    fn reach(&self, m: f64) -> f64 {
        let cosine = (-CUT / (m + 1.0)).exp() / self.rho;
        if cosine < 1.0 { ((1.0 - cosine) * (1.0 + cosine)).sqrt().atan2(cosine) } else { 0.0 }
    }

    /// The change of ψ from φ = `from` to φ = `to`, less than a half turn away.
    fn azimuth(&self, from: f64, to: f64) -> f64 {
        let (sin_from, cos_from) = from.sin_cos();
        let (sin_to, cos_to) = to.sin_cos();
        let cross = self.gamma * (to - from).sin();
        cross.atan2(sin_from * sin_to + self.gamma * self.gamma * cos_from * cos_to)
    }

    /// ∫ (1 − z^(m+1)) dψ over [lo, hi] by Gauss–Legendre quadrature: γ(1 − z^(m+1))/(1 − z²) is smooth in φ.
    ///
    /// Only where z nears 0 has a broken power m a branch point, which matters for low powers: φ = lo + width t²(3 − 2t)
    /// then makes both ends smooth.
    fn core(&self, m: f64, lo: f64, hi: f64) -> f64 {
        let half_power = 0.5 * (m + 1.0);
        let density = |phi: f64| {
            let sine = phi.sin();
            let off_axis = (self.gamma * self.gamma + self.rho * self.rho * sine * sine).min(1.0);
            if off_axis > 0.0 { -(half_power * (-off_axis).ln_1p()).exp_m1() / off_axis } else { half_power }
        };
        let integral = if has_branch_point(m) {
            let width = hi - lo;
            width * RULE.integrate(0.0, 1.0, |t| 6.0 * t * (1.0 - t) * density(lo + width * t * t * (3.0 - 2.0 * t)))
        } else {
            RULE.integrate(lo, hi, density)
        };
        self.gamma * integral
    }
}

/// Whether the branch point of zᵐ at 0 costs digits.
fn has_branch_point(m: f64) -> bool {
    m < 16.0 && m.fract() != 0.0
}

static RULE: LazyLock<GaussLegendre> = LazyLock::new(|| GaussLegendre::new(48));
