//! Scenes and lights that come with the program.

use crate::scene::{self, LoadError, Scene};

/// A scene or light preset built into the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// The file's name without its extension.
    stem: &'static str,
    text: &'static str,
}

/// Light presets, in menu order.
pub const LIGHTS: &[Preset] = &[];

/// Example scenes, in menu order.
pub const SCENES: &[Preset] = &[];

impl Preset {
    /// Its name in menus: the file's, with spaces.
    pub fn title(&self) -> String {
        let mut title = self.stem.replace(['-', '_'], " ");
        if let Some(first) = title.get_mut(..1) {
            first.make_ascii_uppercase();
        }
        title
    }

    /// The scene it holds.
    pub fn load(&self) -> Result<Scene, LoadError> {
        scene::parse(self.text, format!("{}.toml", self.stem))
    }
}
