//! Scenes and lights that come with the program.

use std::io;

use crate::scene::{self, LoadError, Scene};

/// A scene or light preset built into the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Preset {
    /// The file's name without its extension.
    stem: &'static str,
    text: &'static str,
}

/// Light presets, in menu order.
pub const LIGHTS: &[Preset] = &[
    Preset { stem: "window", text: include_str!("../../presets/lights/window.toml") },
    Preset { stem: "softbox", text: include_str!("../../presets/lights/softbox.toml") },
    Preset { stem: "strip-softbox", text: include_str!("../../presets/lights/strip-softbox.toml") },
    Preset { stem: "octabox", text: include_str!("../../presets/lights/octabox.toml") },
    Preset { stem: "diffusion-frame", text: include_str!("../../presets/lights/diffusion-frame.toml") },
    Preset { stem: "beauty-dish", text: include_str!("../../presets/lights/beauty-dish.toml") },
    Preset { stem: "ring-light", text: include_str!("../../presets/lights/ring-light.toml") },
    Preset { stem: "panel", text: include_str!("../../presets/lights/panel.toml") },
    Preset { stem: "troffer", text: include_str!("../../presets/lights/troffer.toml") },
    Preset { stem: "fluorescent-tube", text: include_str!("../../presets/lights/fluorescent-tube.toml") },
    Preset { stem: "tube-t5", text: include_str!("../../presets/lights/tube-t5.toml") },
    Preset { stem: "neon-tube", text: include_str!("../../presets/lights/neon-tube.toml") },
    Preset { stem: "led-strip", text: include_str!("../../presets/lights/led-strip.toml") },
    Preset { stem: "letter-e", text: include_str!("../../presets/lights/letter-e.toml") },
    Preset { stem: "globe", text: include_str!("../../presets/lights/globe.toml") },
    Preset { stem: "paper-lantern", text: include_str!("../../presets/lights/paper-lantern.toml") },
    Preset { stem: "desk-lamp", text: include_str!("../../presets/lights/desk-lamp.toml") },
    Preset { stem: "bulb", text: include_str!("../../presets/lights/bulb.toml") },
    Preset { stem: "candle", text: include_str!("../../presets/lights/candle.toml") },
    Preset { stem: "monitor", text: include_str!("../../presets/lights/monitor.toml") },
    Preset { stem: "sun", text: include_str!("../../presets/lights/sun.toml") },
    Preset { stem: "low-sun", text: include_str!("../../presets/lights/low-sun.toml") },
    Preset { stem: "downlight", text: include_str!("../../presets/lights/downlight.toml") },
    Preset { stem: "street-lantern", text: include_str!("../../presets/lights/street-lantern.toml") },
    Preset { stem: "porthole", text: include_str!("../../presets/lights/porthole.toml") },
    Preset { stem: "lattice-window", text: include_str!("../../presets/lights/lattice-window.toml") },
    Preset { stem: "stained-glass", text: include_str!("../../presets/lights/stained-glass.toml") },
    Preset { stem: "leaf-gobo", text: include_str!("../../presets/lights/leaf-gobo.toml") },
    Preset { stem: "overcast-sky", text: include_str!("../../presets/lights/overcast-sky.toml") },
    Preset { stem: "blue-sky", text: include_str!("../../presets/lights/blue-sky.toml") },
    Preset { stem: "hazy-sun", text: include_str!("../../presets/lights/hazy-sun.toml") },
    Preset { stem: "full-moon", text: include_str!("../../presets/lights/full-moon.toml") },
];

/// Example scenes, in menu order.
pub const SCENES: &[Preset] = &[
    Preset { stem: "first-light", text: include_str!("../../presets/scenes/first-light.toml") },
    Preset { stem: "window-and-strip", text: include_str!("../../presets/scenes/window-and-strip.toml") },
    Preset { stem: "product-table", text: include_str!("../../presets/scenes/product-table.toml") },
    Preset { stem: "portrait", text: include_str!("../../presets/scenes/portrait.toml") },
    Preset { stem: "gallery", text: include_str!("../../presets/scenes/gallery.toml") },
    Preset { stem: "corridor", text: include_str!("../../presets/scenes/corridor.toml") },
    Preset { stem: "night-street", text: include_str!("../../presets/scenes/night-street.toml") },
    Preset { stem: "letter", text: include_str!("../../presets/scenes/letter.toml") },
    Preset { stem: "three-spheres", text: include_str!("../../presets/scenes/three-spheres.toml") },
    Preset { stem: "line-falloff", text: include_str!("../../presets/scenes/line-falloff.toml") },
    Preset { stem: "patio", text: include_str!("../../presets/scenes/patio.toml") },
    Preset { stem: "leaf-shade", text: include_str!("../../presets/scenes/leaf-shade.toml") },
    Preset { stem: "chapel", text: include_str!("../../presets/scenes/chapel.toml") },
    Preset { stem: "sail", text: include_str!("../../presets/scenes/sail.toml") },
    Preset { stem: "vase", text: include_str!("../../presets/scenes/vase.toml") },
    Preset { stem: "sphereflake", text: include_str!("../../presets/scenes/sphereflake.toml") },
    Preset { stem: "tetrahedron", text: include_str!("../../presets/scenes/tetrahedron.toml") },
    Preset { stem: "reflections", text: include_str!("../../presets/scenes/reflections.toml") },
];

/// The files that the presets name.
const FILES: &[(&str, &[u8])] = &[
    ("textures/lattice.png", include_bytes!("../../presets/scenes/textures/lattice.png")),
    ("textures/leaves.png", include_bytes!("../../presets/scenes/textures/leaves.png")),
    ("textures/stained-glass.png", include_bytes!("../../presets/scenes/textures/stained-glass.png")),
    ("meshes/vase.obj", include_bytes!("../../presets/scenes/meshes/vase.obj")),
];

/// The contents of a file.
fn read_file(name: &str) -> io::Result<Vec<u8>> {
    let entry = FILES.iter().find(|(file, _)| *file == name);
    entry.map(|(_, bytes)| bytes.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
}

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
        scene::parse_with(self.text, format!("{}.toml", self.stem), read_file)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every file of the folder is in the menu, and every entry of the menu opens.
    #[track_caller]
    fn check(presets: &[Preset], folder: &str) {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("presets").join(folder);
        let mut files: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        files.sort();
        let mut stems: Vec<_> = presets.iter().map(|preset| preset.stem).collect();
        stems.sort_unstable();
        let of_files: Vec<_> =
            files.iter().filter(|file| file.is_file()).filter_map(|file| file.file_stem()?.to_str()).collect();
        assert_eq!(stems, of_files, "the menu has the folder's files");
        for preset in presets {
            let built_in = preset.load().unwrap_or_else(|error| panic!("{error}"));
            let file = scene::load(folder.join(format!("{}.toml", preset.stem))).expect("the file opens");
            assert_eq!(built_in, file, "{} with its files", preset.stem);
        }
    }

    #[test]
    fn the_menus_have_every_shipped_file() {
        check(SCENES, "scenes");
        check(LIGHTS, "lights");
    }
}
