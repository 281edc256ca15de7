//! The specular lobe of a material, prepared once.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::ShadingPoint;
use crate::math::chebyshev::{ChebyshevLobe, Fits};

/// A model of specular reflection: the reflected radiance is k_s·∫ L(ω) ρ(ω) dω over ω·n > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LobeModel {
    /// ρ = (m+1)/(2π)·max(0, ω·r)ᵐ.
    Phong,
    /// ρ = norm·max(0, n·h)ᵐ, h the half-vector.
    Blinn {
        /// See [`Lobe::blinn`].
        norm: f64,
    },
    /// ρ = D·G·F/(4 n·v).
    CookTorrance {
        /// RMS slope s of the microfacets.
        slope: f64,
        /// Fresnel reflectance f at normal incidence.
        reflectance: f64,
    },
    /// ρ = (m+1)/(2π)·max(0, ω·q)ᵐ with q = t·(v − (n·v)n) + c·(n·v)n.
    Lafortune {
        /// t.
        tangential: f64,
        /// c.
        normal: f64,
    },
}

/// A specular lobe, with what methods need to know of it computed once.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobe {
    model: LobeModel,
    exponent: f64,
    fits: Fits,
}

/// Beckmann's distribution is a mirror's at 0; below this slope the lobe is narrower than methods resolve.
const LEAST_SLOPE: f64 = 0.01;

impl Lobe {
    /// Phong's lobe of exponent m, any real ≥ 1.
    pub fn new(exponent: f64) -> Self {
        Self::of_model(LobeModel::Phong, exponent)
    }

    /// Blinn's lobe of exponent m, any real ≥ 1.
    ///
    /// norm = (m+2)/(8π(1 − 2^(−(m+2)/2))), with which ∫ρ dω is 1 for an eye along the normal, and less elsewhere.
    ///
    /// **Source:** [`crate::refs::BLINN_1977`]; the norm is derived here: dω = 4 cos θ_h dω_h, θ_h from 0 to π/4.
    pub fn blinn(exponent: f64) -> Self {
        let order = exponent + 2.0;
        let norm = order / (-8.0 * PI * (-0.5 * order * std::f64::consts::LN_2).exp_m1());
        Self::of_model(LobeModel::Blinn { norm }, exponent)
    }

    /// Cook and Torrance's lobe: Beckmann's distribution of an RMS slope 0…1, the V-grooves' shadowing, and Schlick's
    /// Fresnel term of a reflectance 0…1 at normal incidence.
    ///
    /// **Source:** [`crate::refs::COOK_TORRANCE_1982`], whose F·D·G/π is divided by 4, as later work does, so
    /// that it conserves energy.
    /// **Domain:** slopes below 0.01 are 0.01.
    pub fn cook_torrance(roughness: f64, reflectance: f64) -> Self {
        let slope = roughness.max(LEAST_SLOPE);
        // About the mirror direction D is exp(−tan²θ_h/s²) ≈ exp(−θ²/(4s²)), which is cosᵐ θ for m = 1/(2s²).
        Self::of_model(LobeModel::CookTorrance { slope, reflectance }, 0.5 / (slope * slope))
    }

    /// Lafortune's lobe of exponent m, any real ≥ 1, with C_x = C_y = `tangential` and C_z = `normal`; (−1, 1) is
    /// Phong's.
    ///
    /// **Source:** [`crate::refs::LAFORTUNE_1997`], eq. (6).
    pub fn lafortune(exponent: f64, tangential: f64, normal: f64) -> Self {
        Self::of_model(LobeModel::Lafortune { tangential, normal }, exponent)
    }

    fn of_model(model: LobeModel, exponent: f64) -> Self {
        Self { model, exponent, fits: Fits::default() }
    }

    /// The model, with its parameters.
    pub fn model(&self) -> LobeModel {
        self.model
    }

    /// The exponent m of a cosine lobe; of Cook and Torrance's, that of the cosine lobe that is most like it.
    pub fn exponent(&self) -> f64 {
        self.exponent
    }

    /// The exponent of the cosine lobe about the mirror direction that falls off as this one does about its peak.
    ///
    /// The half-vector turns half as fast as ω, so Blinn's cosᵐ(θ/2) ≈ exp(−mθ²/8) is that of m/4.
    pub fn cosine_exponent(&self) -> f64 {
        match self.model {
            LobeModel::Blinn { .. } => 0.25 * self.exponent,
            _ => self.exponent,
        }
    }

    /// The fit of cosᵐ that the method `chebyshev` uses, made when it is first asked for and then kept.
    pub fn chebyshev(&self, degree: u32, levels: u32) -> &ChebyshevLobe {
        self.fits.get(self.exponent.max(1.0), degree, levels)
    }

    /// (m+1)/(2π), which makes a cosine lobe's integral over its hemisphere 1 ([`crate::refs::SNYDER_1996`], eq. 10).
    pub fn normalisation(&self) -> f64 {
        (self.exponent + 1.0) / TAU
    }

    /// Whether this is a power of a cosine about an axis, which the closed forms need.
    pub fn is_cosine(&self) -> bool {
        matches!(self.model, LobeModel::Phong | LobeModel::Lafortune { .. })
    }

    /// The point as a lobe sees it whose axis is the mirror direction, and the factor of its specular response.
    ///
    /// Lafortune's lobe at `at` is |q|ᵐ times Phong's at a point that is seen from where q is mirrored to.
    pub fn seen(&self, at: &ShadingPoint) -> (ShadingPoint, f64) {
        let LobeModel::Lafortune { tangential, normal } = self.model else { return (*at, 1.0) };
        let along_normal = at.n.dot(at.v) * at.n;
        let q = tangential * (at.v - along_normal) + normal * along_normal;
        let length = q.length();
        let axis = q.try_normalize().unwrap_or(at.n);
        (ShadingPoint { v: 2.0 * at.n.dot(axis) * at.n - axis, ..*at }, length.powf(self.exponent))
    }

    /// ρ in the unit direction `w` above the surface of normal `n`, seen from where `r` is mirrored to; 1/sr.
    ///
    /// Of Lafortune's lobe, that of the point that [`Self::seen`] gives, without its factor.
    pub fn density(&self, n: DVec3, r: DVec3, w: DVec3) -> f64 {
        match self.model {
            LobeModel::Phong | LobeModel::Lafortune { .. } => {
                let cosine = r.dot(w);
                if cosine > 0.0 { self.normalisation() * cosine.powf(self.exponent) } else { 0.0 }
            }
            LobeModel::Blinn { norm } => {
                let cosine = n.dot(half_vector(n, r, w));
                if cosine > 0.0 { norm * cosine.powf(self.exponent) } else { 0.0 }
            }
            LobeModel::CookTorrance { slope, reflectance } => cook_torrance(slope, reflectance, n, r, w),
        }
    }
}

/// (v + ω)/|v + ω|, v the mirror image of r.
fn half_vector(n: DVec3, r: DVec3, w: DVec3) -> DVec3 {
    (2.0 * n.dot(r) * n - r + w).normalize_or_zero()
}

/// D·G·F/(4 n·v).
///
/// D = exp(−tan²θ_h/s²)/(πs²cos⁴θ_h), G = min(1, 2(n·h)(n·v)/(v·h), 2(n·h)(n·ω)/(v·h)), F = f + (1−f)(1 − v·h)⁵.
fn cook_torrance(slope: f64, reflectance: f64, n: DVec3, r: DVec3, w: DVec3) -> f64 {
    let h = half_vector(n, r, w);
    let (cos_h, cos_v, cos_w, cos_half) = (n.dot(h), n.dot(r), n.dot(w), w.dot(h));
    if cos_h <= 0.0 || cos_v <= 0.0 || cos_w <= 0.0 || cos_half <= 0.0 {
        return 0.0;
    }
    let square = cos_h * cos_h;
    let slope_square = slope * slope;
    let distribution = ((square - 1.0) / (square * slope_square)).exp() / (PI * slope_square * square * square);
    // G/(n·v), which stays finite at a grazing eye.
    let groove = 2.0 * cos_h / cos_half;
    let shadowing = cos_v.recip().min(groove).min(groove * cos_w / cos_v);
    let fresnel = reflectance + (1.0 - reflectance) * (1.0 - cos_half).max(0.0).powi(5);
    0.25 * distribution * shadowing * fresnel
}
