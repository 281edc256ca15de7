//! A line by quadrature along it.

use glam::DVec3;

use super::{Kernel, split};
use crate::light::LineEmitter;
use crate::math::quadrature::{Estimate, Tolerance, adaptive};
use crate::shading::point::CONTACT;

/// The error sought, and a budget that reaches points within 1e-30 of the line's length.
const ALONG: Tolerance = Tolerance { relative: 1e-9, absolute: 1e-300, panels: 400 };

/// ∫ I′(ω) weight(ω)/rᶠ ds along a line seen from p, I′ its intensity per metre; 0 for p on the line.
pub fn line_reference(light: &LineEmitter, p: DVec3, kernel: &Kernel) -> Estimate {
    let (start, end) = (light.a - p, light.b - p);
    let Some(axis) = (end - start).try_normalize() else { return Estimate::default() };
    let (a, b) = (start.dot(axis), end.dot(axis));
    let foot = start - a * axis;
    let distance = foot.length();
    if distance < CONTACT && a <= CONTACT && b >= -CONTACT {
        return Estimate::default();
    }
    let place = |s: f64| foot + s * axis;
    let crossings = kernel.horizons().map(|normal| -normal.dot(foot) / normal.dot(axis)).filter(|s| s.is_finite());
    // The direction of least angle to the axis of the kernel, in the plane of p and the line.
    let peak = kernel.axis.dot(axis).atan2(kernel.axis.dot(foot) / distance.max(CONTACT));
    let peaks = kernel.peak_offsets().map(|offset| peak + offset).filter(|angle| angle.abs() < 1.57);
    // Away from the foot, pieces of a constant ratio, so that each sees the integrand's decay.
    let ratios = std::iter::successors(Some(distance.max(CONTACT)), |s| (*s < b.max(-a)).then_some(4.0 * s));
    let away = ratios.flat_map(|s| [-s, s]).chain([0.0]);
    let breaks = split(a, b, crossings.chain(peaks.map(|angle| distance * angle.tan())).chain(away));
    let visible = breaks.windows(2).filter(|ends| kernel.sees(place(0.5 * (ends[0] + ends[1]))));
    let estimate = adaptive(visible.map(|ends| (ends[0], ends[1])), ALONG, |s| {
        let x = place(s);
        let length = x.length();
        kernel.weight(x / length) * (light.intensity_along(x) * length.powf(-light.falloff))
    });
    // The foot is known to the rounding of the ends; near the line that is what limits.
    let reach = start.length().max(end.length());
    let nearest = if a < 0.0 && b > 0.0 { distance } else { start.length().min(end.length()) };
    let of_sine = light.tube.map_or(0.0, |_| reach / distance.max(CONTACT));
    let conditioning = reach / nearest + reach / (b - a) + of_sine;
    Estimate { error: estimate.error + 16.0 * f64::EPSILON * conditioning * estimate.value, ..estimate }
}
