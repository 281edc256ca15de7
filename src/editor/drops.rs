//! Files dropped on the window: scenes are opened, presets and UsdLux lights inserted, pictures become lights or patterns,
//! IES files point lights, meshes surfaces.

use std::path::{Path, PathBuf};

use super::app::App;
use super::files::Then;
use super::session::{Item, Session};
use crate::light::Shape;
use crate::scene;

/// What a file is, by the end of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Scene,
    Picture,
    Photometry,
    Mesh,
    Stage,
    Other,
}

impl Kind {
    fn of(path: &Path) -> Self {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        match extension.as_str() {
            "toml" => Self::Scene,
            "png" | "jpg" | "jpeg" | "exr" | "hdr" => Self::Picture,
            "ies" => Self::Photometry,
            "obj" => Self::Mesh,
            "usda" => Self::Stage,
            _ => Self::Other,
        }
    }
}

/// What the files held over the window would do when they are let go.
pub(super) fn hint(ctx: &egui::Context) -> Option<&'static str> {
    let file = ctx.input(|input| input.raw.hovered_files.first().cloned())?;
    Some(match file.path.as_deref().map(Kind::of) {
        Some(Kind::Scene) => "Drop to open this scene, or to insert its lights if it is a preset",
        Some(Kind::Picture) => "Drop on a textured light to replace its pattern, elsewhere for a new light",
        Some(Kind::Photometry) => "Drop on a point light to give it these candela, elsewhere for a new light",
        Some(Kind::Mesh) => "Drop to add this mesh",
        Some(Kind::Stage) => "Drop to insert the lights of this stage",
        Some(Kind::Other) => {
            "Softbox does not open this: scenes and presets (.toml), pictures, IES files, meshes (.obj), stages (.usda)"
        }
        None => "Drop to open",
    })
}

impl App {
    /// Take the files that were dropped on the window in this frame.
    pub(super) fn take_drops(&mut self, ctx: &egui::Context) {
        let dropped: Vec<PathBuf> =
            ctx.input(|input| input.raw.dropped_files.iter().map(|file| file.path().to_path_buf()).collect());
        for path in dropped {
            match Kind::of(&path) {
                Kind::Scene => self.drop_scene(ctx, path),
                Kind::Picture => {
                    let light = light_under_pointer(&self.session, |shape| matches!(shape, Shape::Textured(_)));
                    self.use_pattern(&path, light.as_deref());
                }
                Kind::Photometry => {
                    let light = light_under_pointer(&self.session, |shape| matches!(shape, Shape::Point(_)));
                    self.use_photometry(&path, light.as_deref());
                }
                Kind::Mesh => self.use_mesh(&path, None),
                Kind::Stage => self.insert_stage(&path),
                Kind::Other => {
                    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
                    self.session.failed(format!(
                        "“{name}” is nothing that Softbox opens: drop scenes or presets (.toml), pictures (.png, .jpg, \
                         .exr, .hdr), IES files (.ies), meshes (.obj) or stages (.usda)"
                    ));
                }
            }
        }
    }

    /// Open a scene; of a preset, insert the lights.
    fn drop_scene(&mut self, ctx: &egui::Context, path: PathBuf) {
        match scene::load(&path) {
            Ok(scene) if scene.surfaces.is_empty() && !scene.lights.is_empty() => self.insert_file(&path),
            // What cannot be opened says so when it is.
            _ => self.leave(ctx, Then::Open(path)),
        }
    }
}

/// The light under the pointer, by name, if it has such a shape.
fn light_under_pointer(session: &Session, has: impl Fn(&Shape) -> bool) -> Option<String> {
    let Some(Item::Light(index)) = session.under_pointer else { return None };
    let light = session.scene().lights.get(index)?;
    has(&light.shape).then(|| light.name.clone())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_known_by_the_end_of_their_name_whatever_its_case() {
        let kind = |name| Kind::of(Path::new(name));
        assert_eq!([kind("a.toml"), kind("b.TOML")], [Kind::Scene; 2], "scenes");
        assert_eq!([kind("a.PNG"), kind("b.jpeg"), kind("c.exr")], [Kind::Picture; 3], "pictures");
        assert_eq!([kind("chair.Obj"), kind("set.usda")], [Kind::Mesh, Kind::Stage], "meshes and stages");
        assert_eq!(kind("SPOT.IES"), Kind::Photometry, "IES files");
        assert_eq!([kind("a.pdf"), kind("toml"), kind("")], [Kind::Other; 3], "anything else");
    }
}
