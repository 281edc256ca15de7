//! Other states of the lights of a scene.

use super::Scene;
use crate::light::Light;

/// A named state of the lights. What a scene shows are its own lights; switching to a variant replaces them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variant {
    /// Unique among the variants of a scene.
    pub name: String,
    /// In file order.
    pub lights: Vec<Light>,
}

impl Scene {
    /// The variant of that name.
    pub fn variant(&self, name: &str) -> Option<&Variant> {
        self.variants.iter().find(|variant| variant.name == name)
    }

    /// The lights of the scene, then those of its variants.
    pub fn all_lights(&self) -> impl Iterator<Item = &Light> {
        self.lights.iter().chain(self.variants.iter().flat_map(|variant| &variant.lights))
    }

    /// [`Self::all_lights`], to change them.
    pub fn all_lights_mut(&mut self) -> impl Iterator<Item = &mut Light> {
        self.lights.iter_mut().chain(self.variants.iter_mut().flat_map(|variant| &mut variant.lights))
    }

    /// Whether its lights are not, or not any more, those of the active variant.
    pub fn differs_from_variant(&self) -> bool {
        let active = self.active_variant.as_ref().and_then(|name| self.variant(name));
        active.is_none_or(|variant| variant.lights != self.lights)
    }
}
