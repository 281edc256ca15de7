//! What the values of a scene must fulfil beyond the structure of its file.

use super::{Problem, Scene};

/// All that is wrong with a scene.
pub fn validate(scene: &Scene) -> Vec<Problem> {
    let _ = scene;
    Vec::new()
}
