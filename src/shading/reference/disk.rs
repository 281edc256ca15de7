//! A disk by nested quadrature over the directions that meet it.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{Kernel, split};
use crate::light::DiskEmitter;
use crate::math::quadrature::{Estimate, adaptive, adaptive_graded};

/// ∫ weight(ω) dω over a disk of luminance 1 seen from p; a one-sided disk is dark from behind.
///
/// The outer integral turns the plane through p and the chords that lie across the line to the disk's centre, the
/// inner one runs along the chord, both in angles.
pub fn disk_reference(light: &DiskEmitter, p: DVec3, kernel: &Kernel) -> Estimate {
    let to_center = light.center - p;
    let height = light.normal.dot(to_center);
    if height == 0.0 || (height > 0.0 && !light.two_sided) {
        return Estimate::default();
    }
    let fan = Fan::new(light, to_center, height);
    let estimate = adaptive_graded(&fan.breaks(kernel), kernel.outer(), |angle| fan.row(angle, kernel));
    // The height above the disk's plane is known to the rounding of its terms.
    let rounding = 16.0 * f64::EPSILON * (1.0 + to_center.length() / height.abs());
    Estimate { error: estimate.error + rounding * estimate.value, ..estimate }
}

/// The diameter of a disk nearest to and farthest from p, and the plane through it and p.
struct Fan {
    /// Vectors to the diameter's near and far end.
    near: DVec3,
    far: DVec3,
    /// Unit vectors: to the near end, across it towards the far end, and along the chords.
    axes: [DVec3; 3],
    /// Angle of the diameter.
    opening: f64,
    radius: f64,
}

impl Fan {
    fn new(light: &DiskEmitter, to_center: DVec3, height: f64) -> Self {
        let lateral = to_center - height * light.normal;
        // Twice, because what is left near the axis has lost its direction.
        let lateral = lateral - lateral.dot(light.normal) * light.normal;
        let outward = lateral.try_normalize().filter(|v| v.dot(light.normal).abs() < 1e-8);
        let outward = outward.unwrap_or_else(|| light.normal.any_orthonormal_vector());
        let (near, far) = (to_center - light.radius * outward, to_center + light.radius * outward);
        let along = light.normal.cross(outward);
        let first = near.normalize();
        let across = along.cross(first);
        let across = if across.dot(far) < 0.0 { -across } else { across };
        // near × far is 2·radius·height along the chords: from the vectors it would cancel for a disk seen edge on.
        let opening = (2.0 * light.radius * height.abs()).atan2(near.dot(far));
        Self { near, far, axes: [first, across, along], opening, radius: light.radius }
    }

    /// Angles at which a horizon meets the rim, or both meet, or the lobe peaks.
    fn breaks(&self, kernel: &Kernel) -> Vec<f64> {
        let [first, across, along] = self.axes;
        let angle_of = |v: DVec3| across.dot(v).atan2(first.dot(v));
        let center = self.near.midpoint(self.far);
        let outward = 0.5 * (self.far - self.near);
        let rim = kernel.horizons().flat_map(|normal| {
            // On the rim normal·x = c + s cos(t − t₀).
            let (c, x, y) = (normal.dot(center), normal.dot(outward), self.radius * normal.dot(along));
            let half = ((x.hypot(y) - c) * (x.hypot(y) + c)).max(0.0).sqrt().atan2(-c);
            [y.atan2(x) - half, y.atan2(x) + half].map(|t| center + t.cos() * outward)
        });
        let both = kernel.horizon.map(|normal| normal.cross(kernel.axis));
        let points = rim.chain(both.into_iter().flat_map(|both| [both, -both])).map(angle_of);
        let peaks = kernel.peak_offsets().map(|offset| angle_of(kernel.axis) + offset);
        split(0.0, self.opening, points.chain(peaks))
    }

    /// ∫ weight cos φ dφ along the chord at an angle from the near end.
    fn row(&self, angle: f64, kernel: &Kernel) -> Estimate {
        let [first, across, along] = self.axes;
        let (sine, cosine) = angle.sin_cos();
        let (from_near, to_far) = (self.near.length() * sine, self.far.length() * (self.opening - angle).sin());
        let sum = from_near + to_far;
        // The chord divides the diameter as from_near : to_far.
        let distance = self.near.length() * self.far.length() * self.opening.sin() / sum;
        let half_chord = 2.0 * self.radius * (from_near * to_far).max(0.0).sqrt() / sum;
        let end = half_chord.atan2(distance);
        let outward = cosine * first + sine * across;
        let nearest_to = |normal: DVec3| normal.dot(along).atan2(normal.dot(outward));
        let peak = nearest_to(kernel.axis);
        let horizon_ends = kernel.horizons().map(nearest_to).flat_map(|at| [at - FRAC_PI_2, at + FRAC_PI_2]);
        let breaks = split(-end, end, horizon_ends.chain(kernel.peak_offsets().map(|offset| peak + offset)));
        let direction = |phi: f64| phi.cos() * outward + phi.sin() * along;
        let visible = breaks.windows(2).filter(|ends| kernel.sees(direction(0.5 * (ends[0] + ends[1]))));
        adaptive(visible.map(|ends| (ends[0], ends[1])), kernel.inner(), |phi| {
            kernel.weight(direction(phi)) * phi.cos()
        })
    }
}
