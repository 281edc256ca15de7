//! What is seen of a light, by rays.

use crate::light::Emitter;
use crate::shading::{Lobe, ShadingPoint};
use crate::visibility::Objects;

/// The shares of the diffuse and of the specular response that are seen; none where all of the light is.
pub(super) fn visible_shares(
    _objects: &Objects,
    _emitter: &Emitter,
    _at: &ShadingPoint,
    _lobe: &Lobe,
) -> Option<[f64; 2]> {
    None
}
