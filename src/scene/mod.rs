//! The document: what a scene file holds, how it is loaded, checked, saved and edited.

mod beside;
mod camera;
mod file;
mod history;
mod load;
mod merge;
mod mesh;
mod nearest;
mod obj;
mod painted;
mod pattern;
mod photometry;
mod plot;
mod problem;
mod save;
mod schema;
mod structure;
mod validate;
mod variant;

pub use beside::{MAX_CONTENTS_BYTES, keep_apart, keep_mesh_apart, read_beside};
pub use camera::{Camera, Display};
pub use history::{History, MOST_HISTORY_BYTES};
pub use load::{MAX_FILE_BYTES, load, parse, parse_with};
pub use merge::merge;
pub use mesh::{MOST_TRIANGLES, import_mesh};
pub use nearest::suggestion;
pub use painted::{painted_pattern, pattern_file, with_painted_files};
pub use pattern::{MAX_PATTERN_SIZE, import_pattern, pattern_of_bytes};
pub use photometry::{import_photometry, photometry_of_bytes};
pub use plot::{Plot, PlotKind, PlotQuantity};
pub use problem::{LoadError, Path, Place, Problem, Segment};
pub use save::{SaveError, replace_file, replace_files, save, save_as, save_over, to_toml};
pub use schema::schema;
pub use validate::validate;
pub use variant::Variant;

use crate::light::Light;
use crate::surface::{Material, Surface};

/// The number of the scene format that this program reads and writes.
pub const FORMAT: u32 = 1;

/// A scene, or a light preset: a scene with lights and nothing else.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// What people call it.
    pub name: String,
    /// Words to find it by in a library, such as `studio`.
    pub tags: Vec<String>,
    /// From where it is seen.
    pub camera: Camera,
    /// How its radiance becomes a picture.
    pub display: Display,
    /// Materials, in file order.
    pub materials: Vec<Material>,
    /// Surfaces, in file order.
    pub surfaces: Vec<Surface>,
    /// Lights, in file order.
    pub lights: Vec<Light>,
    /// Plots, in file order.
    pub plots: Vec<Plot>,
    /// Other states of the lights, in file order.
    pub variants: Vec<Variant>,
    /// The variant that the lights came from, and with which changes to them are stored.
    pub active_variant: Option<String>,
}

impl Scene {
    /// The material of that name.
    pub fn material(&self, name: &str) -> Option<&Material> {
        self.materials.iter().find(|material| material.name == name)
    }
}

/// The scene that the program opens when it is not given one: a ball and a box under a window.
pub fn first_light() -> Scene {
    let text = include_str!("../../presets/scenes/first-light.toml");
    parse(text, "first-light.toml").expect("a test opens every preset")
}
