//! A sphere, a cap and a sky by nested quadrature over the directions that meet them.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::{Kernel, split};
use crate::light::{SkyEmitter, SphereEmitter};
use crate::math::quadrature::{Estimate, adaptive, adaptive_graded};

/// ∫ weight(ω) dω over a sphere of luminance 1 seen from p; from inside, over every direction.
pub fn sphere_reference(light: &SphereEmitter, p: DVec3, kernel: &Kernel) -> Estimate {
    let to_center = light.center - p;
    let tangent_squared = to_center.length_squared() - light.radius * light.radius;
    let half_angle = if tangent_squared > 0.0 { light.radius.atan2(tangent_squared.sqrt()) } else { PI };
    cap_reference(to_center.try_normalize().unwrap_or(DVec3::Z), half_angle, kernel)
}

/// ∫ weight(ω) dω over the directions within `half_angle` of the unit `center`.
pub fn cap_reference(center: DVec3, half_angle: f64, kernel: &Kernel) -> Estimate {
    rings(center, half_angle, kernel, |_| 1.0)
}

/// ∫ weight(ω) L(ω) dω over a sky of unit luminance.
pub fn sky_reference(light: &SkyEmitter, kernel: &Kernel) -> Estimate {
    rings(light.zenith, FRAC_PI_2, kernel, |theta| light.uniform + light.cosine * theta.cos())
}

/// ∫ weight dω over a cap whose radiance depends on the angle from its centre.
fn rings(center: DVec3, half_angle: f64, kernel: &Kernel, radiance: impl Fn(f64) -> f64) -> Estimate {
    let cap = Cap::new(center);
    // Rings touch a horizon at these polar angles, and meet both at the last.
    let touching = kernel.horizons().flat_map(|normal| {
        let (_, latitude) = cap.place_of(normal);
        [latitude.abs(), PI - latitude.abs()]
    });
    let both = kernel.horizon.map(|normal| cap.polar(normal.cross(kernel.axis)));
    let corners = both.into_iter().flat_map(|angle| [angle, PI - angle]);
    let peak = cap.polar(kernel.axis);
    let peaks = kernel.peak_offsets().map(|offset| peak + offset);
    let breaks = split(0.0, half_angle, touching.chain(corners).chain(peaks));
    let estimate = adaptive_graded(&breaks, kernel.outer(), |theta| cap.ring(theta, kernel) * radiance(theta));
    Estimate { error: estimate.error + 16.0 * f64::EPSILON * estimate.value, ..estimate }
}

/// Polar coordinates about a cap's centre.
struct Cap {
    center: DVec3,
    u: DVec3,
    v: DVec3,
}

impl Cap {
    fn new(center: DVec3) -> Self {
        let (u, v) = center.any_orthonormal_pair();
        Self { center, u, v }
    }

    /// Angle of a direction from the centre.
    fn polar(&self, direction: DVec3) -> f64 {
        self.center.cross(direction).length().atan2(self.center.dot(direction))
    }

    /// Azimuth of a direction, and its angle above the plane across the centre.
    fn place_of(&self, direction: DVec3) -> (f64, f64) {
        (direction.dot(self.v).atan2(direction.dot(self.u)), FRAC_PI_2 - self.polar(direction))
    }

    /// sin θ ∫ weight dα over the ring at the polar angle θ.
    fn ring(&self, theta: f64, kernel: &Kernel) -> Estimate {
        let (sine, cosine) = theta.sin_cos();
        let direction = |alpha: f64| cosine * self.center + sine * (alpha.cos() * self.u + alpha.sin() * self.v);
        let horizon_ends = kernel.horizons().flat_map(|normal| {
            // On the ring normal·ω = c + s cos(α − azimuth).
            let (azimuth, _) = self.place_of(normal);
            let (c, s) = (cosine * normal.dot(self.center), sine * self.center.cross(normal).length());
            let half_width = if s > c.abs() { ((s - c) * (s + c)).sqrt().atan2(-c) } else { PI };
            [azimuth - half_width, azimuth + half_width]
        });
        let (azimuth, _) = self.place_of(kernel.axis);
        let spread = sine.max(1e-3).recip();
        let peaks = kernel.peak_offsets().map(|offset| azimuth + (offset * spread).clamp(-PI, PI));
        let around = |alpha: f64| {
            if alpha > PI {
                alpha - 2.0 * PI
            } else if alpha < -PI {
                alpha + 2.0 * PI
            } else {
                alpha
            }
        };
        let breaks = split(-PI, PI, horizon_ends.chain(peaks).map(around));
        let visible = breaks.windows(2).filter(|ends| kernel.sees(direction(0.5 * (ends[0] + ends[1]))));
        let ring =
            adaptive(visible.map(|ends| (ends[0], ends[1])), kernel.inner(), |alpha| kernel.weight(direction(alpha)));
        ring * sine
    }
}
