//! Phong's and other lobes as the microfacets of renderers that have nothing else.

use glam::DVec3;

use crate::surface::{Material, ReflectionModel};

/// A specular reflection by Beckmann's microfacets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Gloss {
    /// Root mean square slope α of the microfacets.
    pub(super) alpha: f64,
    /// Share of light reflected at normal incidence, a channel.
    pub(super) reflectance: DVec3,
}

/// Microfacets with a highlight as wide as the material's; none where it reflects no highlights.
///
/// A lobe (n·h)ᵐ of the half-vector is as wide as α = √(2/(m + 2)), and a lobe (ω·r)ᵐ about the mirror direction as one
/// of 4m, as the half-vector turns half as far: derived here from cosᵐθ ≈ exp(−mθ²/2) and D ≈ exp(−θ²/α²).
pub(super) fn gloss(material: &Material) -> Option<Gloss> {
    let of_half_vector = |exponent: f64| (2.0 / (exponent + 2.0)).sqrt();
    let (alpha, share) = match material.model {
        ReflectionModel::Phong {} | ReflectionModel::Lafortune { .. } => (of_half_vector(4.0 * material.exponent), 1.0),
        ReflectionModel::Blinn {} => (of_half_vector(material.exponent), 1.0),
        ReflectionModel::CookTorrance { roughness, reflectance } => (roughness, reflectance),
    };
    (material.specular != DVec3::ZERO).then(|| Gloss { alpha, reflectance: share * material.specular })
}

/// What a target with microfacets says of a material.
pub(super) fn gloss_remark(material: &Material) -> Option<String> {
    let gloss = gloss(material)?;
    Some(format!("its {} highlight is one of microfacets of slope {:.3}, as wide", material.model.name(), gloss.alpha))
}
