//! Lights as one luminaire, in a frame of its own.

use glam::{DMat3, DVec3};

use crate::light::photometry::Distribution;
use crate::light::{Emitter, Extent, FarField, Light, Point, Shape, luminance_of};
use crate::math::frame::rotation_from_deg;
use crate::shading::textured::{cosine, quadrature};
use crate::shading::{Method, PhongLobe, ShadingPoint, respond};

/// What quadrature over patterns is to reach here: a tenth of what the smallest error asked about needs.
const SOUGHT: quadrature::Sought<'static> =
    quadrature::Sought { relative: 1e-4, absolute: 1e-6, parts: 1 << 16, cancel: None };

/// Lights as one luminaire. Its frame is turned as its lights are, if all are turned alike, and as the world otherwise.
pub(super) struct Luminaire {
    parts: Vec<(FarField, f64)>,
    /// The only light.
    only: Option<Light>,
    world_from_luminaire: DMat3,
    /// Rotation of its frame, R = Rz·Ry·Rx, degrees.
    pub(super) rotation_deg: DVec3,
    /// The photometric centre, in the world: the middle of the flux, about which no other point law is as good.
    pub(super) center: DVec3,
    /// lm.
    pub(super) flux: f64,
    /// The box about it in its own frame, about its centre.
    extent: Extent,
}

impl Luminaire {
    /// None of lights that give nothing.
    pub(super) fn new(lights: &[Light]) -> Option<Self> {
        let parts = lights.iter().flat_map(Light::parts);
        let parts = parts.filter_map(|(emitter, weight)| Some((FarField::of(&emitter)?, luminance_of(weight))));
        let parts: Vec<_> = parts.filter(|(far, weight)| far.flux * weight > 0.0).collect();
        let flux: f64 = parts.iter().map(|(far, weight)| weight * far.flux).sum();
        let center = parts.iter().map(|(far, weight)| weight * far.flux * far.center).sum::<DVec3>() / flux;
        let rotation_deg = common_rotation(lights);
        let world_from_luminaire = rotation_from_deg(rotation_deg);
        let extents = parts.iter().map(|(far, _)| far.extent(world_from_luminaire.transpose(), center));
        let extent = extents.reduce(Extent::joined)?;
        let only = if let [light] = lights { Some(light.clone()) } else { None };
        Some(Self { parts, only, world_from_luminaire, rotation_deg, center, flux, extent })
    }

    /// Candela in a unit direction of the luminaire's frame.
    pub(super) fn intensity(&self, direction: DVec3) -> f64 {
        let direction = self.world_from_luminaire * direction;
        self.parts.iter().map(|(far, weight)| weight * far.intensity(direction)).sum()
    }

    /// The exact illuminance, lx, at a distance in a unit direction of its frame, of a surface that faces the centre.
    pub(super) fn illuminance(&self, direction: DVec3, distance: f64) -> f64 {
        let w = self.world_from_luminaire * direction;
        let at = ShadingPoint { p: self.center + distance * w, n: -w, v: -w };
        let lobe = PhongLobe::new(1.0);
        let of_part = |emitter: &Emitter| match emitter {
            Emitter::Textured(light) => {
                quadrature::integrate(light, &*light.pattern, at.p, &cosine(at.n), SOUGHT).value
            }
            _ => respond(emitter, Method::Exact, &at, &lobe).irradiance,
        };
        self.parts.iter().map(|(far, weight)| weight * of_part(far.emitter())).sum()
    }

    /// From the centre to what is farthest of it, metres.
    pub(super) fn radius(&self) -> f64 {
        self.parts.iter().map(|(far, _)| far.reach(self.center)).fold(0.0, f64::max)
    }

    /// The table that it is the light of, if it is a point with one.
    pub(super) fn table(&self) -> Option<&Distribution> {
        match &self.only.as_ref()?.shape {
            Shape::Point(Point { ies: Some(photometry) }) => Some(&photometry.distribution),
            _ => None,
        }
    }

    /// Width, length and height of the luminous opening, metres: along Y (C = 90), X (C = 0) and Z, negative where it is
    /// round in that direction.
    ///
    /// **Source:** [`crate::refs::LM_63`], the table of luminous openings.
    pub(super) fn opening(&self) -> [f64; 3] {
        let DVec3 { x, y, z } = self.extent.size();
        match self.only.as_ref().map(|light| &light.shape) {
            Some(Shape::Sphere(_)) => [-y, -x, -z],
            Some(Shape::Disk(_)) => [-y, -x, 0.0],
            Some(Shape::Line(line)) if line.tube_radius().is_some() => [-y, x, -z],
            _ => [y, x, z],
        }
    }

    /// From the photometric centre to the middle of the opening, in its frame.
    pub(super) fn middle_of_opening(&self) -> DVec3 {
        self.extent.min.midpoint(self.extent.max)
    }
}

/// The rotation that all lights have that one can see to be turned; none where they differ.
fn common_rotation(lights: &[Light]) -> DVec3 {
    let is_turned = |light: &&Light| !matches!(light.shape, Shape::Sphere(_) | Shape::Point(Point { ies: None }));
    let mut rotations = lights.iter().filter(is_turned).map(|light| light.rotation_deg);
    let first = rotations.next().unwrap_or_default();
    if rotations.all(|rotation| rotation == first) { first } else { DVec3::ZERO }
}
