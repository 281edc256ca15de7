//! A polygon by nested quadrature in longitude and latitude about an axis in its plane.

use std::f64::consts::FRAC_PI_2;

use glam::DVec3;

use super::{Kernel, split};
use crate::light::PolygonEmitter;
use crate::math::quadrature::{Estimate, adaptive, adaptive_graded};

/// ∫ weight(ω) dω over a polygon of luminance 1 seen from p.
///
/// With y across the polygon and x along its longest edge, both from the foot of p, β = atan(y/h) and
/// φ = atan(x/√(h² + y²)) are longitude and latitude, dω = cos φ dφ dβ: a row of the polygon is an arc of constant β.
pub fn polygon_reference(light: &PolygonEmitter, p: DVec3, kernel: &Kernel) -> Estimate {
    let Some(view) = View::new(light, p) else { return Estimate::default() };
    let corners = view.corners.iter().map(|corner| view.longitude(corner.1));
    let (lo, hi) = corners.clone().fold((FRAC_PI_2, -FRAC_PI_2), |(lo, hi), beta| (lo.min(beta), hi.max(beta)));
    let crossings = kernel.horizons().flat_map(|normal| view.crossings(normal));
    let (peak, spread) = view.longitude_of_peak(kernel.axis);
    let peaks = kernel.peak_offsets().map(|offset| peak + spread * offset);
    // Where the two horizons meet.
    let both = kernel.horizon.map(|normal| normal.cross(kernel.axis));
    let meeting = both.into_iter().flat_map(|at| [view.longitude_of_peak(at).0, view.longitude_of_peak(-at).0]);
    let breaks = split(lo, hi, corners.chain(crossings).chain(peaks).chain(meeting));
    let estimate = adaptive_graded(&breaks, kernel.outer(), |beta| view.row(beta, kernel));
    // What the rounding of the inputs about p may do: to the width seen, to the height, and to the size.
    let conditioning = (hi - lo).max(f64::MIN_POSITIVE).recip() + view.reach / view.height + view.reach / view.size;
    Estimate { error: estimate.error + 8.0 * f64::EPSILON * conditioning * estimate.value, ..estimate }
}

/// A polygon in the coordinates of its own plane about the foot of p.
struct View {
    /// (x, y) of the corners.
    corners: Vec<(f64, f64)>,
    height: f64,
    /// Unit directions of x, y, and from p to the plane.
    axes: [DVec3; 3],
    /// Distance of the farthest corner, and length of the longest edge.
    reach: f64,
    size: f64,
}

impl View {
    /// `None` where the polygon does not shine: from behind, in its plane, or when it is no polygon.
    fn new(light: &PolygonEmitter, p: DVec3) -> Option<Self> {
        let seen: Vec<DVec3> = light.vertices.iter().map(|v| v - p).collect();
        let next = seen.iter().cycle().skip(1);
        let edge = seen.iter().zip(next).map(|(a, b)| b - a).max_by(|a, b| a.length().total_cmp(&b.length()))?;
        let along = edge.try_normalize()?;
        let reach = seen.iter().map(|v| v.length()).fold(0.0, f64::max);
        // The corner nearest to p gives the height with the least rounding.
        let nearest = seen.iter().copied().min_by(|a, b| a.length().total_cmp(&b.length()))?;
        let height = light.normal.dot(nearest);
        let lit = height < 0.0 || light.two_sided;
        if !lit || height.abs() <= 1e-14 * reach {
            return None;
        }
        let ahead = light.normal * height.signum();
        let across = ahead.cross(along);
        let corners = seen.iter().map(|v| (v.dot(along), v.dot(across))).collect();
        Some(Self { corners, height: height.abs(), axes: [along, across, ahead], reach, size: edge.length() })
    }

    fn longitude(&self, y: f64) -> f64 {
        y.atan2(self.height)
    }

    fn edges(&self) -> impl Iterator<Item = ((f64, f64), (f64, f64))> {
        let next = self.corners.iter().cycle().skip(1);
        self.corners.iter().copied().zip(next.copied())
    }

    /// Longitudes at which the horizon of `normal` meets the edges.
    fn crossings(&self, normal: DVec3) -> impl Iterator<Item = f64> {
        let [along, across, ahead] = self.axes;
        let above = move |(x, y): (f64, f64)| normal.dot(x * along + y * across + self.height * ahead);
        self.edges().filter_map(move |(a, b)| {
            let (above_a, above_b) = (above(a), above(b));
            ((above_a > 0.0) != (above_b > 0.0))
                .then(|| self.longitude(a.1 + above_a / (above_a - above_b) * (b.1 - a.1)))
        })
    }

    /// The longitude of a direction, and how much wider an angle about it looks in longitude.
    fn longitude_of_peak(&self, axis: DVec3) -> (f64, f64) {
        let [_, across, ahead] = self.axes;
        let (y, z) = (axis.dot(across), axis.dot(ahead));
        (y.atan2(z), y.hypot(z).max(0.05).recip())
    }

    /// ∫ weight cos φ dφ over what the polygon covers of the meridian at longitude β.
    fn row(&self, beta: f64, kernel: &Kernel) -> Estimate {
        let (sine, cosine) = beta.sin_cos();
        let (y, distance) = (self.height * sine / cosine, self.height / cosine);
        let mut ends: Vec<f64> = self
            .edges()
            .filter(|(a, b)| (a.1 > y) != (b.1 > y))
            .map(|(a, b)| (a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0)).atan2(distance))
            .collect();
        ends.sort_by(f64::total_cmp);
        let [along, across, ahead] = self.axes;
        let outward = sine * across + cosine * ahead;
        let direction = |phi: f64| phi.cos() * outward + phi.sin() * along;
        let nearest_to = |normal: DVec3| normal.dot(along).atan2(normal.dot(outward));
        let peak = nearest_to(kernel.axis);
        let mut sum = Estimate::default();
        for ends in ends.chunks_exact(2) {
            // Each horizon leaves a half circle about the meridian's nearest point to its normal.
            let horizon_ends = kernel.horizons().map(nearest_to).flat_map(|at| [at - FRAC_PI_2, at + FRAC_PI_2]);
            let breaks = split(ends[0], ends[1], horizon_ends.chain(kernel.peak_offsets().map(|offset| peak + offset)));
            let visible = breaks.windows(2).filter(|ends| kernel.sees(direction(0.5 * (ends[0] + ends[1]))));
            sum = sum
                + adaptive(visible.map(|ends| (ends[0], ends[1])), kernel.inner(), |phi| {
                    kernel.weight(direction(phi)) * phi.cos()
                });
        }
        sum
    }
}
