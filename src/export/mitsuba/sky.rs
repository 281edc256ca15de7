//! Lights infinitely far away as Mitsuba's one map of the surroundings.

use std::f64::consts::{PI, TAU};

use glam::{DMat4, DVec3, DVec4};

use crate::light::{Emitter, Light};

/// Columns and rows: an even number of rows, so that no row lies on the horizon.
pub(super) const MAP_SIZE: [u32; 2] = [512, 256];

/// Each texel is the mean of so many directions across it, squared.
const SUBDIVISION: u32 = 4;

/// Radiance from all around, cd/m², row by row: the first row is the zenith and the last one the nadir, whose middles
/// are exactly there, and the columns run from +Y by +X.
///
/// Mitsuba takes values between the middles of texels as linear.
pub(super) fn map(lights: &[&Light]) -> Vec<DVec3> {
    let emitters: Vec<_> = lights.iter().map(|light| (light.emitter(), light.weight())).collect();
    let [columns, rows] = MAP_SIZE;
    let texels = (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
    let parts = SUBDIVISION * SUBDIVISION;
    let offset = |part: u32| (f64::from(part) + 0.5) / f64::from(SUBDIVISION) - 0.5;
    let value = |(row, column): (u32, u32)| {
        let sum: DVec3 = (0..parts)
            .map(|part| {
                let down = f64::from(row) + offset(part / SUBDIVISION);
                let theta = (PI * down / f64::from(rows - 1)).clamp(0.0, PI);
                let phi = TAU * (f64::from(column) + 0.5 + offset(part % SUBDIVISION)) / f64::from(columns);
                let direction = DVec3::new(theta.sin() * phi.sin(), theta.sin() * phi.cos(), theta.cos());
                emitters.iter().map(|(emitter, weight)| weight * luminance(emitter, direction)).sum::<DVec3>()
            })
            .sum();
        sum / f64::from(parts)
    };
    texels.map(value).collect()
}

/// Takes the map's own frame, where up is +Y, to the world.
pub(super) fn world_from_map() -> DMat4 {
    DMat4::from_cols(DVec4::X, DVec4::Z, DVec4::NEG_Y, DVec4::W)
}

/// Of a unit direction; 0 of lights that are not infinitely far away.
fn luminance(emitter: &Emitter, direction: DVec3) -> f64 {
    match emitter {
        Emitter::Sky(sky) => sky.radiance(direction),
        Emitter::Cap(cap) => {
            let angle = cap.to_center.cross(direction).length().atan2(cap.to_center.dot(direction));
            if angle <= cap.half_angle { 1.0 } else { 0.0 }
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Shape, Sky};

    #[test]
    fn a_tilted_sky_lights_a_plane_that_faces_it_as_it_should() {
        let sky = Sky { uniform: 0.5, cosine: 0.5 };
        let light = Light { rotation_deg: DVec3::new(50.0, 0.0, 0.0), ..Light::new("sky", Shape::Sky(sky)) };
        let zenith = light.world_from_light().matrix3.z_axis;
        let texels = map(&[&light]);
        let [columns, rows] = MAP_SIZE;
        let mut sum = 0.0;
        for (i, texel) in (0..).zip(&texels) {
            let theta = PI * f64::from(i / columns) / f64::from(rows - 1);
            let phi = TAU * (f64::from(i % columns) + 0.5) / f64::from(columns);
            let direction = DVec3::new(theta.sin() * phi.sin(), theta.sin() * phi.cos(), theta.cos());
            let solid_angle = theta.sin() * PI / f64::from(rows - 1) * TAU / f64::from(columns);
            sum += texel.y * zenith.dot(direction).max(0.0) * solid_angle;
        }
        let exact = light.weight().y * sky.place(&light.world_from_light()).illuminance();
        assert!((sum / exact - 1.0).abs() < 2e-4, "{sum} instead of {exact} lx");
    }
}
