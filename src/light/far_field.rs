//! A light seen from far away: its intensities, its flux, its middle and its extent.

use std::f64::consts::PI;

use glam::{DMat3, DVec3};

use super::{Emitter, TexturedEmitter};

/// A light at unit strength as a point that has its intensities: what it tends to from far away.
#[derive(Clone, Debug, PartialEq)]
pub struct FarField {
    emitter: Emitter,
    /// Luminous flux, lm.
    pub flux: f64,
    /// The middle of its flux.
    pub center: DVec3,
}

/// Corners of the box about a light, in some frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// The least coordinates.
    pub min: DVec3,
    /// The greatest.
    pub max: DVec3,
}

impl FarField {
    /// None of a light that is infinitely far away, or that does not fall off as 1/d².
    pub fn of(emitter: &Emitter) -> Option<Self> {
        let sides = |two_sided: bool| if two_sided { 2.0 } else { 1.0 };
        let (flux, center) = match emitter {
            Emitter::Polygon(light) => (PI * light.vector_area().length() * sides(light.two_sided), light.centroid()),
            Emitter::Disk(light) => (PI * light.area() * sides(light.two_sided), light.center),
            Emitter::Textured(light) => {
                (PI * light.area() * light.pattern.mean() * sides(light.two_sided), textured_center(light))
            }
            Emitter::Line(light) if light.falloff == 2.0 => {
                let per_metre = light.tube.map_or(4.0 * PI, |radius| 2.0 * PI * PI * radius);
                (per_metre * light.length(), light.middle())
            }
            Emitter::Sphere(light) => (4.0 * PI * PI * light.radius * light.radius, light.center),
            Emitter::Point(light) => {
                (light.web.as_ref().map_or(4.0 * PI, |web| web.distribution.flux_per_peak()), light.position)
            }
            Emitter::Line(_) | Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Directional(_) => return None,
        };
        Some(Self { emitter: emitter.clone(), flux, center })
    }

    /// The intensity in a unit direction away from the light, cd.
    ///
    /// What is flat emits L·A·cos, a line I′·length, a tube 2rL·length·sin ψ, ψ from its axis, a sphere L·πr².
    pub fn intensity(&self, direction: DVec3) -> f64 {
        let flat = |area: f64, normal: DVec3, two_sided: bool| {
            let cosine = direction.dot(normal);
            area * if two_sided { cosine.abs() } else { cosine.max(0.0) }
        };
        match &self.emitter {
            Emitter::Polygon(light) => flat(light.vector_area().length(), light.normal, light.two_sided),
            Emitter::Disk(light) => flat(light.area(), light.normal, light.two_sided),
            Emitter::Textured(light) => flat(light.area() * light.pattern.mean(), light.normal, light.two_sided),
            Emitter::Line(light) => light.length() * light.intensity_along(direction),
            Emitter::Sphere(light) => PI * light.radius * light.radius,
            Emitter::Point(light) => light.intensity(direction),
            Emitter::Cap(_) | Emitter::Sky(_) | Emitter::Directional(_) => 0.0,
        }
    }

    /// The light at unit strength.
    pub fn emitter(&self) -> &Emitter {
        &self.emitter
    }

    /// The distance from a point to what is farthest of the light.
    pub fn reach(&self, from: DVec3) -> f64 {
        let farthest = |points: &[DVec3]| points.iter().map(|p| p.distance(from)).fold(0.0, f64::max);
        match &self.emitter {
            Emitter::Polygon(light) => farthest(&light.vertices),
            Emitter::Textured(light) => farthest(&light.corners()),
            Emitter::Disk(light) => farthest(&[light.center]) + light.radius,
            Emitter::Line(light) => farthest(&[light.a, light.b]) + light.tube.unwrap_or(0.0),
            Emitter::Sphere(light) => farthest(&[light.center]) + light.radius,
            _ => farthest(&[self.center]),
        }
    }

    /// The box about the light in a frame about `origin`.
    pub fn extent(&self, frame_from_world: DMat3, origin: DVec3) -> Extent {
        let place = |p: DVec3| frame_from_world * (p - origin);
        let about = |center: DVec3, half: DVec3| Extent { min: place(center) - half, max: place(center) + half };
        let around = |points: &[DVec3]| {
            let of = |fold: fn(DVec3, DVec3) -> DVec3| points.iter().copied().map(place).reduce(fold);
            Extent { min: of(DVec3::min).unwrap_or_default(), max: of(DVec3::max).unwrap_or_default() }
        };
        match &self.emitter {
            Emitter::Polygon(light) => around(&light.vertices),
            Emitter::Textured(light) => around(&light.corners()),
            // A circle reaches r·√(1 − nᵢ²) along the axis i.
            Emitter::Disk(light) => {
                let n = frame_from_world * light.normal;
                about(light.center, light.radius * (DVec3::ONE - n * n).max(DVec3::ZERO).map(f64::sqrt))
            }
            Emitter::Line(light) => {
                let axis = frame_from_world * (light.b - light.a).normalize_or_zero();
                let half = light.tube.unwrap_or(0.0) * (DVec3::ONE - axis * axis).max(DVec3::ZERO).map(f64::sqrt);
                let Extent { min, max } = around(&[light.a, light.b]);
                Extent { min: min - half, max: max + half }
            }
            Emitter::Sphere(light) => about(light.center, DVec3::splat(light.radius)),
            _ => about(self.center, DVec3::ZERO),
        }
    }
}

impl Extent {
    /// The box about both.
    pub fn joined(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Its sides.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }
}

/// The middle of a textured light's flux.
fn textured_center(light: &TexturedEmitter) -> DVec3 {
    let [columns, rows] = light.pattern.size().map(f64::from);
    let (mut sum, mut u, mut v) = (0.0, 0.0, 0.0);
    for (i, texel) in light.pattern.texels().iter().enumerate() {
        let (texel, width) = (f64::from(*texel), light.pattern.width());
        sum += texel;
        u += texel * ((i % width) as f64 + 0.5);
        v += texel * ((i / width) as f64 + 0.5);
    }
    if sum > 0.0 { light.point(u / (sum * columns), v / (sum * rows)) } else { light.point(0.5, 0.5) }
}
