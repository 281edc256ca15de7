//! Small pictures of scenes, and of presets on a stage.

mod stage;

use super::{Film, MethodChoice, Progress, Settings, Shadows, encode_srgb, expose, pbr_neutral, render};
use crate::light::Shape;
use crate::scene::Scene;
use crate::shading::Method;

/// The picture of a scene as its camera sees it, or of a preset's lights over a floor with a ball, row by row; none when
/// cancelled.
///
/// Textured lights are shaded by their first approximation, and shadows are cast where they have a closed form: a small
/// picture shows no difference, and takes far less time.
pub fn thumbnail(scene: &Scene, size: [u32; 2], samples: u32, progress: &Progress) -> Option<Vec<[u8; 3]>> {
    let staged = stage::staged(scene);
    let is_textured = staged.lights.iter().any(|light| matches!(light.shape, Shape::Textured(_)));
    let choice = if is_textured { MethodChoice::Approx } else { MethodChoice::Method(Method::Exact) };
    let has_shadows = staged.lights.iter().all(|light| matches!(light.shape, Shape::Polygon(_) | Shape::Line(_)));
    let shadows = if has_shadows { Shadows::default() } else { Shadows::None };
    let film = render(&staged, &Settings { size, choice, samples, shadows }, progress)?;
    let is_preset = scene.surfaces.is_empty();
    Some(if is_preset { exposed(&film, stage::exposure(&film)) } else { film.srgb().to_vec() })
}

fn exposed(film: &Film, exposure_ev: f64) -> Vec<[u8; 3]> {
    film.radiance().iter().map(|radiance| encode_srgb(pbr_neutral(expose(*radiance, exposure_ev)))).collect()
}
