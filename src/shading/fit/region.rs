//! Where a fit is held to the exact illuminance.

use std::f64::consts::{FRAC_PI_2, SQRT_2, TAU};
use std::sync::atomic::Ordering;

use glam::DVec3;

use super::Punctual;
use crate::light::Emitter;
use crate::shading::cluster::cap_directions;
use crate::shading::disk::disk_irradiance;
use crate::shading::line::line_irradiance;
use crate::shading::polygon::polygon_irradiance;
use crate::shading::sky::sky_irradiance;
use crate::shading::sphere::{Cap, cap_irradiance, sphere_irradiance};
use crate::shading::textured::cosine;
use crate::shading::textured::quadrature::{Sought, integrate};

/// A sample of the region about a canonical light.
pub(super) struct Sampling {
    /// Directions of a hemisphere.
    directions: u32,
    /// From the light's middle, in units of its size.
    distances: &'static [f64],
}

impl Sampling {
    /// What a fit is made for.
    pub(super) const FIT: Self = Self { directions: 48, distances: &[0.875, 1.2, 1.8, 3.0, 8.0] };

    /// What it is judged by: other directions, and other distances between the same ends.
    pub(super) const JUDGE: Self = Self { directions: 97, distances: &[0.875, 1.0, 1.5, 2.4, 5.0, 8.0] };
}

/// The nearest and the farthest distance, in units of the light's size.
pub const REACH: [f64; 2] = [0.875, 8.0];

/// Numbers that say what light does to a receiver.
pub(super) const PARTS: usize = 3;

/// What light does somewhere, as a share of the greatest illuminance at that distance.
#[derive(Clone, Debug)]
pub(super) enum Receiver {
    /// At a place, all that surfaces there receive: E = n·light, as long as no surface's horizon cuts the light.
    Place { p: DVec3, light: DVec3, greatest: f64 },
    /// On surfaces anywhere of a normal.
    Facing { n: DVec3, illuminance: f64, greatest: f64 },
}

/// The receivers of a canonical light; none when cancelled.
pub(super) fn receivers(emitter: &Emitter, sampling: &Sampling, sought: Sought<'_>) -> Option<Vec<Receiver>> {
    if matches!(emitter, Emitter::Cap(_) | Emitter::Sky(_)) {
        return Some(normals(emitter, 2 * sampling.directions));
    }
    let directions = directions(emitter, sampling.directions);
    let distances = if matches!(emitter, Emitter::Point(_)) { &[1.0] } else { sampling.distances };
    let mut receivers = Vec::with_capacity(directions.len() * distances.len());
    for distance in distances {
        let mut lights = Vec::with_capacity(directions.len());
        for direction in &directions {
            if sought.cancel.is_some_and(|cancel| cancel.load(Ordering::Relaxed)) {
                return None;
            }
            lights.push(light_at(emitter, *distance * *direction, sought));
        }
        let greatest = lights.iter().map(|light| light.length()).fold(0.0, f64::max);
        receivers.extend(directions.iter().zip(lights).map(|(direction, light)| Receiver::Place {
            p: *distance * *direction,
            light,
            greatest,
        }));
    }
    Some(receivers)
}

/// Surfaces of all normals under what fills directions.
fn normals(emitter: &Emitter, directions: u32) -> Vec<Receiver> {
    let half = hemisphere(directions);
    let normals = half.iter().copied().chain(half.iter().map(|n| -*n));
    let lit: Vec<_> = normals.map(|n| (n, irradiance(emitter, DVec3::ZERO, n, Sought::PICTURE))).collect();
    let greatest = lit.iter().map(|(_, illuminance)| *illuminance).fold(0.0, f64::max);
    lit.into_iter().map(|(n, illuminance)| Receiver::Facing { n, illuminance, greatest }).collect()
}

/// Directions from a light's middle in which it shines, spread evenly.
fn directions(emitter: &Emitter, count: u32) -> Vec<DVec3> {
    let front = hemisphere(count);
    let is_one_sided = match emitter {
        Emitter::Polygon(light) => !light.two_sided,
        Emitter::Disk(light) => !light.two_sided,
        Emitter::Textured(light) => !light.two_sided,
        _ => false,
    };
    let back: Vec<_> = front.iter().filter(|_| !is_one_sided).map(|direction| -*direction).collect();
    [front, back].concat()
}

fn hemisphere(count: u32) -> Vec<DVec3> {
    cap_directions(&Cap::new(DVec3::Z, FRAC_PI_2), count).collect()
}

/// The light vector at a place, whose product with a normal is the illuminance on that surface.
///
/// From the illuminance of three surfaces at right angles to each other, each 54.7° off the direction to the light's
/// middle: from [`REACH`] on the light fills no more than 34.9° about that, and no horizon cuts it.
fn light_at(emitter: &Emitter, p: DVec3, sought: Sought<'_>) -> DVec3 {
    let toward = -p.normalize_or_zero();
    let (u, v) = toward.any_orthonormal_pair();
    let third = |k: u32| {
        let (sin, cos) = (TAU * f64::from(k) / 3.0).sin_cos();
        let n = (toward + SQRT_2 * (cos * u + sin * v)).normalize_or_zero();
        irradiance(emitter, p, n, sought) * n
    };
    third(0) + third(1) + third(2)
}

/// Exact irradiance of a canonical light on its lit side.
fn irradiance(emitter: &Emitter, p: DVec3, n: DVec3, sought: Sought<'_>) -> f64 {
    match emitter {
        Emitter::Polygon(light) => polygon_irradiance(&light.vertices, p, n),
        Emitter::Disk(light) => disk_irradiance(light, p, n),
        Emitter::Textured(light) => integrate(light, &*light.pattern, p, &cosine(n), sought).value,
        Emitter::Line(light) => line_irradiance(light, p, n),
        Emitter::Sphere(light) => sphere_irradiance(light, p, n),
        Emitter::Cap(light) => cap_irradiance(&Cap::new(light.to_center, light.half_angle), n),
        Emitter::Sky(light) => sky_irradiance(light, n),
        Emitter::Point(light) => light.intensity(p - light.position) * n.dot(light.position - p) / p.length().powi(3),
        Emitter::Directional(_) => 0.0,
    }
}

impl Receiver {
    /// What a punctual light does here, as a share of the greatest.
    pub(super) fn share(&self, light: &Punctual) -> [f64; PARTS] {
        match self {
            Self::Place { p, greatest, .. } => (light_vector(light, *p) / *greatest).to_array(),
            Self::Facing { n, greatest, .. } => {
                [light_vector(light, DVec3::ZERO).dot(*n).max(0.0) / greatest, 0.0, 0.0]
            }
        }
    }

    /// The exact light, as a share of the greatest.
    pub(super) fn exact(&self) -> [f64; PARTS] {
        match self {
            Self::Place { light, greatest, .. } => (*light / *greatest).to_array(),
            Self::Facing { illuminance, greatest, .. } => [illuminance / greatest, 0.0, 0.0],
        }
    }

    /// Whether there is light to be a share of.
    pub(super) fn is_lit(&self) -> bool {
        match self {
            Self::Place { greatest, .. } | Self::Facing { greatest, .. } => *greatest > 0.0,
        }
    }
}

/// The light vector of a punctual light: I·share·w/d².
fn light_vector(light: &Punctual, p: DVec3) -> DVec3 {
    let (position, intensity) = match *light {
        Punctual::Point { position, intensity } => (position, intensity),
        Punctual::Spot { position, intensity, axis, cone } => {
            (position, intensity * cone.share((p - position).normalize_or_zero().dot(axis)))
        }
        Punctual::Directional { to_light, illuminance } => return illuminance * to_light,
    };
    let to_light = position - p;
    intensity * to_light / to_light.length().powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{DiskEmitter, SphereEmitter};

    #[test]
    fn the_light_vector_has_the_illuminance_of_every_surface_that_sees_the_whole_light() {
        let light = Emitter::Disk(DiskEmitter { center: DVec3::ZERO, normal: DVec3::Z, radius: 0.5, two_sided: false });
        for p in [DVec3::new(0.3, -0.4, 0.8), DVec3::new(2.0, 1.0, 0.3), DVec3::new(0.0, 0.0, 0.875)] {
            let vector = light_at(&light, p, Sought::default());
            for aside in [DVec3::ZERO, 0.5 * DVec3::X, -0.5 * DVec3::Y] {
                let n = (aside - p.normalize()).normalize();
                let expected = irradiance(&light, p, n, Sought::default());
                assert!((vector.dot(n) - expected).abs() < 1e-12, "{} at {p} for {expected}", vector.dot(n));
            }
        }
    }

    #[test]
    fn a_spheres_light_vector_is_a_points() {
        let sphere = Emitter::Sphere(SphereEmitter { center: DVec3::ZERO, radius: 0.5 });
        let p = DVec3::new(0.4, -0.7, 0.9);
        let intensity = 0.25 * std::f64::consts::PI;
        let point = light_vector(&Punctual::Point { position: DVec3::ZERO, intensity }, p);
        assert!((light_at(&sphere, p, Sought::default()) - point).length() < 1e-12, "{point}");
    }
}
