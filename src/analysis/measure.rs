//! Illuminance over a level rectangle, as standards of lighting measure it.

use std::sync::atomic::{AtomicBool, Ordering};

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::light::luminance_of;
use crate::render::{MethodChoice, Reflection, Shadows, prepare};
use crate::scene::Scene;
use crate::shading::ShadingPoint;
use crate::surface::{Material, ReflectionModel};

/// A level rectangle that faces up, its sides along X and Y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    /// The middle.
    pub center: DVec3,
    /// Sides, metres, above 0.
    pub size: DVec2,
}

/// Illuminance at the points of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// Points along X and Y.
    pub grid: [u32; 2],
    /// Of all points, lx.
    pub least: f64,
    /// Of all points, lx.
    pub mean: f64,
    /// Of all points, lx.
    pub greatest: f64,
}

/// The widest spacing of a grid, metres.
const WIDEST: f64 = 10.0;

impl Rectangle {
    /// The corners, counter-clockwise from above, from the one of least x and y.
    pub fn corners(&self) -> [DVec3; 4] {
        [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
            .map(|(x, y)| self.center + DVec3::new(x * self.size.x, y * self.size.y, 0.0))
    }

    /// How many points along X and Y measure it.
    ///
    /// Points are about p = 0.2 m · 5^log₁₀(d/1 m) apart, at most 10 m; d is the longer side, or the shorter one where
    /// that is less than half as long. **Source:** EN 12464-1:2021, 4.4 (grid system).
    pub fn grid(&self) -> [u32; 2] {
        let [longer, shorter] = [self.size.max_element(), self.size.min_element()];
        let d = if longer < 2.0 * shorter { longer } else { shorter };
        let spacing = (0.2 * 5.0_f64.powf(d.log10())).min(WIDEST);
        // The next whole number along d, then the nearest one at the spacing that results.
        let spacing = d / (d / spacing - 1e-9).ceil().max(1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to a small number")]
        let count = |side: f64| (side / spacing).round().clamp(1.0, MOST) as u32;
        self.size.to_array().map(count)
    }

    /// The points of the grid: the middles of equal cells.
    pub fn points(&self) -> Vec<DVec3> {
        let [columns, rows] = self.grid();
        let share = |i: u32, count: u32| (f64::from(i) + 0.5) / f64::from(count) - 0.5;
        let at = |x: u32, y: u32| DVec3::new(share(x, columns) * self.size.x, share(y, rows) * self.size.y, 0.0);
        (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))).map(|(x, y)| self.center + at(x, y)).collect()
    }
}

/// Points along a side, at most.
const MOST: f64 = 200.0;

impl Measured {
    /// Uniformity U₀: the least by the mean; 0 in the dark.
    pub fn uniformity(&self) -> f64 {
        share(self.least, self.mean)
    }

    /// Diversity U_d: the least by the greatest; 0 in the dark.
    pub fn diversity(&self) -> f64 {
        share(self.least, self.greatest)
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}

/// The illuminance over a rectangle of a scene; none when cancelled.
pub fn measure(
    scene: &Scene,
    rectangle: &Rectangle,
    choice: MethodChoice,
    shadows: Shadows,
    cancel: &AtomicBool,
) -> Option<Measured> {
    let (_, lighting) = prepare(scene, choice, shadows);
    let matte = Reflection::new(&Material {
        name: String::new(),
        diffuse: DVec3::ONE,
        specular: DVec3::ZERO,
        model: ReflectionModel::default(),
        exponent: 1.0,
    });
    let illuminance = |p: &DVec3| {
        let at = ShadingPoint { p: *p, n: DVec3::Z, v: DVec3::Z };
        (!cancel.load(Ordering::Relaxed)).then(|| luminance_of(lighting.outgoing(&matte, &at).irradiance))
    };
    let values: Option<Vec<f64>> = rectangle.points().par_iter().map(illuminance).collect();
    let values = values?;
    Some(Measured {
        grid: rectangle.grid(),
        least: values.iter().copied().fold(f64::INFINITY, f64::min),
        mean: values.iter().sum::<f64>() / values.len() as f64,
        greatest: values.iter().copied().fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Light, Point, Quantity, QuantityKind, Shape};
    use crate::shading::Method;
    use crate::surface::{self, Surface};

    fn under_a_lamp(surfaces: Vec<Surface>) -> Scene {
        let mut light = Light::new("lamp", Shape::Point(Point::default()));
        light.position = DVec3::new(0.0, 0.0, 2.0);
        light.quantity = Quantity::new(QuantityKind::Intensity, 400.0);
        Scene { lights: vec![light], surfaces, ..Scene::default() }
    }

    fn measured(scene: &Scene, rectangle: &Rectangle) -> Measured {
        let choice = MethodChoice::Method(Method::Exact);
        measure(scene, rectangle, choice, Shadows::default(), &AtomicBool::new(false)).expect("nobody cancels")
    }

    #[test]
    fn a_grid_has_the_standards_spacing() {
        // d/p is 3.8, 5, 6.2, 8.1, 10, 13.2, 16.2, 20.
        for (length, count) in [(0.4, 4), (1.0, 5), (2.0, 7), (5.0, 9), (10.0, 10), (25.0, 14), (50.0, 17), (100.0, 20)]
        {
            let square = Rectangle { center: DVec3::ZERO, size: DVec2::splat(length) };
            assert_eq!(square.grid(), [count; 2], "{length} m");
        }
        let long = Rectangle { center: DVec3::ZERO, size: DVec2::new(10.0, 2.0) };
        assert_eq!(long.grid(), [35, 7], "the shorter side counts");
    }

    #[test]
    fn under_a_point_light_least_mean_and_greatest_follow_the_inverse_square() {
        let rectangle = Rectangle { center: DVec3::ZERO, size: DVec2::new(2.0, 1.4) };
        let found = measured(&under_a_lamp(Vec::new()), &rectangle);
        let illuminance = |p: &DVec3| 400.0 * 2.0 / p.distance(DVec3::new(0.0, 0.0, 2.0)).powi(3);
        let values: Vec<f64> = rectangle.points().iter().map(illuminance).collect();
        assert_eq!(values.len(), 35, "7 by 5 points");
        let mean = values.iter().sum::<f64>() / 35.0;
        assert!((found.mean / mean - 1.0).abs() < 1e-12, "mean {} is not {mean}", found.mean);
        assert!((found.greatest / 100.0 - 1.0).abs() < 1e-12, "{found:?} right under the lamp");
        assert!((found.uniformity() - found.least / mean).abs() < 1e-12, "{found:?}");
        assert!((found.diversity() - found.least / found.greatest).abs() < 1e-12, "{found:?}");
    }

    #[test]
    fn a_rectangle_counts_at_its_height_with_shadows_and_a_cancelled_one_not() {
        let plate = Surface {
            name: "plate".to_owned(),
            material: String::new(),
            position: DVec3::new(0.0, 0.0, 1.0),
            rotation_deg: DVec3::ZERO,
            scale: DVec3::ONE,
            shape: surface::Shape::Square { size: DVec2::ONE },
        };
        let scene = under_a_lamp(vec![plate]);
        let rectangle = |height| Rectangle { center: DVec3::new(0.0, 0.0, height), size: DVec2::splat(0.5) };
        let dark = measured(&scene, &rectangle(0.0));
        assert_eq!((dark.greatest, dark.uniformity(), dark.diversity()), (0.0, 0.0, 0.0), "under the plate");
        let lit = measured(&scene, &rectangle(1.2));
        assert!(lit.least > 500.0 && lit.uniformity() > 0.8, "above it: {lit:?}");
        let choice = MethodChoice::Method(Method::Exact);
        let cancelled = measure(&scene, &rectangle(0.0), choice, Shadows::None, &AtomicBool::new(true));
        assert_eq!(cancelled, None, "cancelled");
    }

    #[test]
    fn corners_go_round_the_middle() {
        let rectangle = Rectangle { center: DVec3::new(1.0, 2.0, 0.5), size: DVec2::new(2.0, 4.0) };
        let corners = rectangle.corners();
        assert_eq!(corners[0], DVec3::new(0.0, 0.0, 0.5), "the first");
        assert_eq!(corners[2], DVec3::new(2.0, 4.0, 0.5), "opposite");
        assert_eq!(corners.iter().sum::<DVec3>() / 4.0, rectangle.center, "about the middle");
    }
}
