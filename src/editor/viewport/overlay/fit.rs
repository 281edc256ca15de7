//! The punctual lights that are fitted to a light.

use egui::{Color32, Painter, Stroke};
use glam::DVec3;

use super::line;
use crate::editor::viewport::projection::Projection;
use crate::light::Light;
use crate::shading::fit::{Cone, Fit, Punctual};

/// Length of a cone's sides, and of a ray of parallel light, points.
const LENGTH: f64 = 26.0;
/// Radius of the strongest light's mark, points.
const MARK: f64 = 5.0;
/// Radius of the weakest one's, points.
const LEAST_MARK: f64 = 1.5;
/// Sides of a cone that are drawn.
const SIDES: u32 = 4;

/// Draw the fit of so many lights: a dot a light, its area in proportion to the light's strength, of a spot with the
/// sides of its cone; of parallel light a ray to `light`'s place.
pub fn paint_fit(light: &Light, count: u32, color: Color32, projection: &Projection, painter: &Painter) {
    let stroke = Stroke::new(1.0, color.gamma_multiply(0.8));
    for (emitter, _) in light.parts() {
        let Some(fit) = Fit::new(&emitter, count, None) else { continue };
        let strongest = fit.lights().iter().map(Punctual::strength).fold(f64::MIN_POSITIVE, f64::max);
        for punctual in fit.lights() {
            let length = LENGTH * projection.metres_per_point(punctual.position().unwrap_or(light.position));
            let mark = match *punctual {
                Punctual::Point { position, .. } => position,
                Punctual::Spot { position, axis, cone, .. } => {
                    for side in cone_sides(axis, cone) {
                        line(position, position + length * side, stroke, projection, painter);
                    }
                    position
                }
                Punctual::Directional { to_light, .. } => {
                    let from = light.position + 2.0 * length * to_light;
                    line(from, light.position, stroke, projection, painter);
                    from
                }
            };
            let radius = (MARK * (punctual.strength() / strongest).sqrt()).max(LEAST_MARK);
            if let Some(at) = projection.project(mark) {
                painter.circle_filled(at, points(radius), color);
            }
        }
    }
}

/// Unit directions along the outer edge of a cone.
fn cone_sides(axis: DVec3, cone: Cone) -> impl Iterator<Item = DVec3> {
    let (u, v) = axis.any_orthonormal_pair();
    let (sin, cos) = cone.angles()[1].sin_cos();
    (0..SIDES).map(move |side| {
        let (across, up) = (std::f64::consts::TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
        cos * axis + sin * (up * u + across * v)
    })
}

#[expect(clippy::cast_possible_truncation, reason = "a place on the screen")]
fn points(x: f64) -> f32 {
    x as f32
}
