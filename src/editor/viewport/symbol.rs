//! Symbols of lights infinitely far away: the directions that the light comes from, as seen from its origin.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DMat3, DVec3};

use super::projection::Projection;
use crate::light::{Cap, Light, Shape};
use crate::math::frame;

/// Radius of the sphere of directions on screen, points.
const RADIUS: f64 = 46.0;
/// Pieces of a full circle.
const PIECES: u32 = 48;
/// Spokes of a cap.
const SPOKES: u32 = 4;

/// A sphere of directions about a light's origin, of constant size on screen.
#[derive(Clone, Copy, Debug)]
pub struct Symbol {
    center: DVec3,
    radius: f64,
    axes: DMat3,
}

impl Symbol {
    /// The sphere of directions about a light.
    pub fn new(light: &Light, projection: &Projection) -> Self {
        Self {
            center: light.position,
            radius: RADIUS * projection.metres_per_point(light.position),
            axes: frame::rotation_from_deg(light.rotation_deg),
        }
    }

    /// The point in the direction `theta` from the light's +Z, turned by `phi` from its +X.
    pub fn point(&self, theta: f64, phi: f64) -> DVec3 {
        let ((sin_theta, cos_theta), (sin_phi, cos_phi)) = (theta.sin_cos(), phi.sin_cos());
        self.center + self.radius * (self.axes * DVec3::new(sin_theta * cos_phi, sin_theta * sin_phi, cos_theta))
    }

    /// Where the middle of the light is.
    pub fn tip(&self) -> DVec3 {
        self.point(0.0, 0.0)
    }

    /// The lines of the symbol: a cone to a cap's rim, a dome for a sky; none for other lights.
    pub fn lines(&self, shape: &Shape) -> Vec<[DVec3; 2]> {
        match shape {
            Shape::Cap(Cap { half_angle_deg }) => {
                let theta = half_angle_deg.to_radians();
                let spokes = (0..SPOKES).map(|i| [self.center, self.point(theta, share(i, SPOKES) * TAU)]);
                spokes.chain(self.circle(theta)).collect()
            }
            Shape::Sky(_) => {
                self.circle(FRAC_PI_2).chain(self.arch(0.0)).chain(self.arch(FRAC_PI_2)).collect::<Vec<_>>()
            }
            _ => Vec::new(),
        }
    }

    /// The directions at `theta` from the axis.
    fn circle(&self, theta: f64) -> impl Iterator<Item = [DVec3; 2]> {
        (0..PIECES).map(move |i| [i, i + 1].map(|i| self.point(theta, share(i, PIECES) * TAU)))
    }

    /// From the horizon through the tip to the horizon.
    fn arch(&self, phi: f64) -> impl Iterator<Item = [DVec3; 2]> {
        let pieces = PIECES / 2;
        (0..pieces).map(move |i| [i, i + 1].map(|i| self.point(share(i, pieces) * PI - FRAC_PI_2, phi)))
    }
}

fn share(i: u32, of: u32) -> f64 {
    f64::from(i) / f64::from(of)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::Sky;
    use crate::math::angle::angle_between;
    use crate::scene::Camera;
    use egui::{Rect, pos2};

    fn symbol(shape: Shape, distance: f64) -> (Symbol, Light, Projection) {
        let camera = Camera { eye: DVec3::new(0.0, -distance, 0.0), target: DVec3::ZERO, fov_deg: 40.0 };
        let projection = Projection::new(&camera, Rect::from_min_max(pos2(0.0, 0.0), pos2(800.0, 600.0)));
        let light = Light::new("far", shape);
        (Symbol::new(&light, &projection), light, projection)
    }

    #[test]
    fn a_symbol_keeps_its_size_on_screen() {
        for distance in [2.0, 50.0] {
            let (symbol, _, projection) = symbol(Shape::Sky(Sky::OVERCAST), distance);
            let [center, tip] = [symbol.center, symbol.tip()].map(|p| projection.project(p).expect("in sight"));
            assert!((f64::from(center.distance(tip)) - RADIUS).abs() < 0.1, "{center:?} to {tip:?}");
        }
    }

    #[test]
    fn the_rim_of_a_cap_is_seen_at_its_half_angle_and_that_of_a_sky_at_the_horizon() {
        for (shape, angle_deg) in [(Shape::Cap(Cap { half_angle_deg: 25.0 }), 25.0), (Shape::Sky(Sky::OVERCAST), 90.0)]
        {
            let (symbol, light, _) = symbol(shape, 5.0);
            let ends = symbol.lines(&light.shape).into_iter().flatten();
            let angles = ends.filter(|p| *p != symbol.center).map(|p| angle_between(p - symbol.center, DVec3::Z));
            let widest = angles.fold(0.0, f64::max).to_degrees();
            assert!((widest - angle_deg).abs() < 1e-6, "{widest} of {angle_deg}");
        }
    }
}
