//! Where a preset's lights go when it is dropped into the view.

use glam::{DAffine3, DMat3, DVec3, EulerRot};

use crate::light::{Light, Shape};
use crate::math::frame::facing;
use crate::scene::Scene;

/// A surface is a floor, and not a wall, when its normal is this near to upright (cosine).
const FLOOR: f64 = 0.9;
/// How far from a wall a preset's lights are put, metres.
const FROM_WALL: f64 = 1.2;

/// The lights of a preset dropped at `p`, where the surface's normal is `n`.
///
/// Over a floor they stand as in the preset, as high above it. Before a wall they face it from 1.2 m. Lights infinitely
/// far away stay as they are.
pub fn place(preset: &Scene, p: DVec3, n: DVec3) -> Vec<Light> {
    let Some(center) = center(preset) else { return preset.lights.clone() };
    let by = if n.z > FLOOR {
        DAffine3::from_translation(p - center.with_z(0.0))
    } else {
        let at = p + FROM_WALL * n;
        DAffine3::from_translation(at) * DAffine3::from_mat3(facing(n)) * DAffine3::from_translation(-center)
    };
    let is_floor = n.z > FLOOR;
    preset
        .lights
        .iter()
        .map(|light| {
            if is_far(light) {
                return light.clone();
            }
            let position = rounded(by.transform_point3(light.position), 1e4);
            // A light alone faces the wall however it stands in the preset.
            let rotation_deg = match (is_floor, preset.lights.len()) {
                (true, _) => light.rotation_deg,
                (false, 1) => facing_deg(n),
                (false, _) => degrees(by.matrix3 * light.world_from_light().matrix3),
            };
            Light { position, rotation_deg, ..light.clone() }
        })
        .collect()
}

/// A point and a normal for a drop that meets nothing: the work plane's height over the origin.
pub fn resting(height: f64) -> (DVec3, DVec3) {
    (DVec3::new(0.0, 0.0, height), DVec3::Z)
}

/// [`facing`], as angles about X, Y and Z.
pub(super) fn facing_deg(n: DVec3) -> DVec3 {
    degrees(facing(n))
}

/// R = Rz·Ry·Rx as angles about X, Y and Z, to a thousandth of a degree.
fn degrees(rotation: DMat3) -> DVec3 {
    let (rz, ry, rx) = rotation.to_euler(EulerRot::ZYX);
    rounded(DVec3::new(rx, ry, rz).map(f64::to_degrees), 1e3)
}

fn rounded(v: DVec3, steps: f64) -> DVec3 {
    // Adding zero turns −0 into 0.
    (v * steps).round() / steps + 0.0
}

/// The middle of the lights that stand somewhere.
fn center(preset: &Scene) -> Option<DVec3> {
    let near = || preset.lights.iter().filter(|light| !is_far(light));
    let count = near().count();
    (count > 0).then(|| near().map(|light| light.position).sum::<DVec3>() / count as f64)
}

fn is_far(light: &Light) -> bool {
    matches!(light.shape, Shape::Sky(_) | Shape::Cap(_) | Shape::Directional(_))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::editor::presets::LIGHTS;

    fn preset(title: &str) -> Scene {
        LIGHTS.iter().find(|preset| preset.title() == title).expect("a preset").load().expect("it opens")
    }

    #[test]
    fn over_a_floor_a_light_keeps_its_height_and_rotation() {
        let window = preset("Window");
        let placed = &place(&window, DVec3::new(2.0, -1.0, 0.5), DVec3::Z)[0];
        assert_eq!(placed.position, DVec3::new(2.0, -1.0, 0.5 + window.lights[0].position.z), "above the point");
        assert_eq!(placed.rotation_deg, window.lights[0].rotation_deg, "as it stands");
    }

    #[test]
    fn before_a_wall_a_light_faces_it() {
        for n in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.6, 0.0, -0.8), DVec3::new(-0.48, 0.64, 0.6)] {
            let p = DVec3::new(1.0, 2.0, 1.5);
            let placed = &place(&preset("Softbox"), p, n)[0];
            assert!((placed.position - (p + FROM_WALL * n)).length() < 1e-3, "{n} {}", placed.position);
            let emits = -placed.world_from_light().matrix3.z_axis;
            assert!((emits + n).length() < 1e-4, "it emits along {emits}, against {n}");
        }
    }

    #[test]
    fn a_sky_is_everywhere() {
        let sky = preset("Overcast sky");
        assert_eq!(place(&sky, DVec3::ONE, DVec3::X), sky.lights, "as it is");
    }
}
