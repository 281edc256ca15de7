//! Directions drawn from a specular lobe.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::sampling::Frame;
use crate::shading::{Lobe, LobeModel, ShadingPoint};

/// A material's lobe at a point.
pub(super) struct Reflected<'a> {
    lobe: &'a Lobe,
    n: DVec3,
    /// The point as the lobe sees it.
    v: DVec3,
    r: DVec3,
    /// About the mirror direction for a power of a cosine, else about the normal.
    frame: Frame,
}

impl<'a> Reflected<'a> {
    pub(super) fn new(lobe: &'a Lobe, at: &ShadingPoint) -> Self {
        let (seen, _) = lobe.seen(at);
        let r = seen.mirror();
        let frame = Frame::about(if lobe.is_cosine() { r } else { at.n });
        Self { lobe, n: at.n, v: seen.v, r, frame }
    }

    /// ρ but for a factor that is the same in all directions, 1/sr.
    pub(super) fn weight(&self, w: DVec3) -> f64 {
        self.lobe.density(self.n, self.r, w)
    }

    /// The solid angle that most of it is in, sr.
    pub(super) fn solid_angle(&self) -> f64 {
        TAU / (self.lobe.cosine_exponent() + 1.0)
    }

    /// A direction, not always above the surface, from a point of the unit disk: with the density of the cosine's power
    /// about r, or mirrored in a half-vector of the lobe's distribution.
    pub(super) fn sample(&self, disk: DVec2) -> DVec3 {
        let h = match self.lobe.model() {
            LobeModel::Phong | LobeModel::Lafortune { .. } => return self.frame.by_power(disk, self.lobe.exponent()),
            LobeModel::Blinn { .. } => self.frame.by_power(disk, self.lobe.exponent()),
            LobeModel::CookTorrance { slope, .. } => self.frame.by_slope(disk, slope),
        };
        2.0 * self.v.dot(h) * h - self.v
    }

    /// The density of [`Self::sample`], 1/sr. Of half-vectors it is dω_h/dω = 1/(4 v·h) times theirs.
    pub(super) fn density(&self, w: DVec3) -> f64 {
        let power = |cosine: f64, m: f64| (m + 1.0) / TAU * cosine.max(0.0).powf(m);
        let h = (self.v + w).normalize_or_zero();
        let (cos_h, cos_half) = (self.n.dot(h), self.v.dot(h));
        let half = |density: f64| if cos_h > 0.0 && cos_half > 0.0 { density / (4.0 * cos_half) } else { 0.0 };
        match self.lobe.model() {
            LobeModel::Phong | LobeModel::Lafortune { .. } => power(self.r.dot(w), self.lobe.exponent()),
            LobeModel::Blinn { .. } => half(power(cos_h, self.lobe.exponent())),
            LobeModel::CookTorrance { slope, .. } => {
                let square = cos_h * cos_h;
                let slope_square = slope * slope;
                let exponent = (square - 1.0) / (square * slope_square);
                half(exponent.exp() / (PI * slope_square * square * cos_h))
            }
        }
    }
}
