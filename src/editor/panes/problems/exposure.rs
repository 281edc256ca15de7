//! Whether the picture will be all black or all white.

use glam::DVec3;

use super::Row;
use super::oddities::corners;
use crate::light::luminance_of;
use crate::render::{Lighting, MethodChoice, Reflection};
use crate::scene::Scene;
use crate::shading::{Method, ShadingPoint};
use crate::surface::Surface;

/// Luminance that is white at an exposure of 0 EV, cd/m².
const WHITE: f64 = 100.0;
/// The picture is black where even its brightest surface is below this share of white.
const BLACK: f64 = 0.01;
/// It is burnt out where even a middling surface is this many times white.
const BURNT: f64 = 30.0;
/// Where the exposure that is proposed puts the surface, as a share of white.
const AIM: f64 = 0.5;

/// What is to be said of the exposure: by the luminance of one point of each surface, under point lights, without
/// shadows, which is enough to be a few steps right.
pub(super) fn oddity(scene: &Scene) -> Option<Row> {
    let lighting = Lighting::new(scene, MethodChoice::Method(Method::Point));
    let mut shares: Vec<f64> = scene
        .surfaces
        .iter()
        .filter_map(|surface| {
            let reflection = Reflection::new(scene.material(&surface.material)?);
            let radiance = lighting.outgoing(&reflection, &sample(surface, scene)).radiance;
            Some(luminance_of(radiance) / WHITE * scene.display.exposure_ev.exp2())
        })
        .filter(|share| share.is_finite())
        .collect();
    shares.sort_by(f64::total_cmp);
    let (brightest, middling) = (*shares.last()?, *shares.get(shares.len() / 2)?);
    let steps = |share: f64| (AIM / share).log2().round();
    let text = if brightest <= 0.0 {
        return None;
    } else if brightest < BLACK {
        format!("The picture is almost black: an exposure some {} EV higher would show it", steps(brightest))
    } else if middling > BURNT {
        format!("The picture is almost white: an exposure some {} EV lower would show it", -steps(middling))
    } else {
        return None;
    };
    Some(Row::warning(None, "Exposure", text))
}

/// A point of a surface that the camera is likely to see.
fn sample(surface: &Surface, scene: &Scene) -> ShadingPoint {
    let eye = scene.camera.eye;
    let (p, n) = match corners(surface) {
        Some(corners) => {
            let center = corners.iter().sum::<DVec3>() / 8.0;
            let n = ((eye - center).normalize_or_zero() + DVec3::Z).normalize_or(DVec3::Z);
            (center + 0.5 * corners[0].distance(corners[7]) / 3.0_f64.sqrt() * n, n)
        }
        None => {
            let world = surface.world_from_surface();
            let normal = world.matrix3.z_axis.normalize_or(DVec3::Z);
            let target = scene.camera.target;
            let p = target - (target - world.translation).dot(normal) * normal;
            (p, if (eye - p).dot(normal) < 0.0 { -normal } else { normal })
        }
    };
    ShadingPoint { p, n, v: (eye - p).normalize_or(n) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::first_light;

    #[track_caller]
    fn check(exposure_ev: f64, expected: Option<&str>) {
        let mut scene = first_light();
        scene.display.exposure_ev = exposure_ev;
        let text = oddity(&scene).map(|row| row.text);
        match expected {
            Some(expected) => assert!(text.as_ref().is_some_and(|text| text.contains(expected)), "{text:?}"),
            None => assert_eq!(text, None, "{exposure_ev} EV is right"),
        }
    }

    #[test]
    fn an_exposure_far_off_is_pointed_out() {
        check(first_light().display.exposure_ev, None);
        check(-12.0, Some("almost black"));
        check(14.0, Some("almost white"));
    }
}
