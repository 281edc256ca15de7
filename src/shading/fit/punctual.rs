//! Punctual lights as other programs know them.

use glam::DVec3;

use crate::shading::point::{direction_response, falloff_response};
use crate::shading::{Lobe, Response, ShadingPoint};

/// A light without size, as glTF's `KHR_lights_punctual` and most renderers have it; 1/d² where it has a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Punctual {
    /// The same in all directions.
    Point {
        /// Where it is.
        position: DVec3,
        /// cd.
        intensity: f64,
    },
    /// Within a cone.
    Spot {
        /// Where it is.
        position: DVec3,
        /// cd along the axis.
        intensity: f64,
        /// Unit direction of the cone's middle.
        axis: DVec3,
        /// How it falls off towards the cone's edge.
        cone: Cone,
    },
    /// Parallel.
    Directional {
        /// Unit direction against the light.
        to_light: DVec3,
        /// lx on a surface that faces it.
        illuminance: f64,
    },
}

/// A spot's cone: full within the inner angle, nothing outside of the outer one.
///
/// In between the intensity is that along the axis times ((cos θ − cos outer)/(cos inner − cos outer))², the formula that
/// `KHR_lights_punctual` recommends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// Of the inner angle.
    pub cos_inner: f64,
    /// Of the outer angle: at least 0, and less than the other.
    pub cos_outer: f64,
}

impl Cone {
    /// The least difference of the cosines: glTF's formula takes less than 0.001 for that.
    pub const LEAST_EDGE: f64 = 0.02;

    /// Scale and offset of the cosine, whose sum, held to 0…1 and squared, is the share of the intensity along the axis.
    pub fn ramp(&self) -> [f64; 2] {
        let scale = (self.cos_inner - self.cos_outer).max(Self::LEAST_EDGE).recip();
        [scale, -self.cos_outer * scale]
    }

    /// The share of the intensity along the axis in a direction whose angle from it has that cosine.
    pub fn share(&self, cosine: f64) -> f64 {
        let [scale, offset] = self.ramp();
        (cosine * scale + offset).clamp(0.0, 1.0).powi(2)
    }

    /// Inner and outer angle, radians.
    pub fn angles(&self) -> [f64; 2] {
        [self.cos_inner, self.cos_outer].map(|cos: f64| ((1.0 - cos) * (1.0 + cos)).max(0.0).sqrt().atan2(cos))
    }
}

impl Punctual {
    /// Intensity, or illuminance where it is directional.
    pub fn strength(&self) -> f64 {
        match *self {
            Self::Point { intensity, .. } | Self::Spot { intensity, .. } => intensity,
            Self::Directional { illuminance, .. } => illuminance,
        }
    }

    /// Where it is; none where it is directional.
    pub fn position(&self) -> Option<DVec3> {
        match *self {
            Self::Point { position, .. } | Self::Spot { position, .. } => Some(position),
            Self::Directional { .. } => None,
        }
    }

    /// E = I·share·max(0, n·w)/d², or E·max(0, n·w), and the specular part likewise.
    pub fn respond(&self, at: &ShadingPoint, lobe: &Lobe) -> Response {
        let (n, r) = (at.n, at.mirror());
        match *self {
            Self::Point { position, intensity } => falloff_response(position - at.p, intensity, 2.0, n, r, lobe),
            Self::Spot { position, intensity, axis, cone } => {
                let to_light = position - at.p;
                let share = cone.share(-to_light.normalize_or_zero().dot(axis));
                falloff_response(to_light, share * intensity, 2.0, n, r, lobe)
            }
            Self::Directional { to_light, illuminance } => direction_response(to_light, illuminance, n, r, lobe),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_is_full_inside_and_dark_outside_and_halfway_a_quarter() {
        let cone = Cone { cos_inner: 0.8, cos_outer: 0.2 };
        let shares = [1.0, 0.8, 0.5, 0.2, 0.0, -1.0].map(|cosine| cone.share(cosine));
        let expected = [1.0, 1.0, 0.25, 0.0, 0.0, 0.0];
        let off = shares.iter().zip(expected).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(off < 1e-15, "{shares:?}");
        let [inner, outer] = cone.angles();
        assert!((inner.cos() - 0.8).abs() < 1e-15 && (outer.cos() - 0.2).abs() < 1e-15, "{inner}, {outer}");
    }
}
