//! OpenUSD: lights as UsdLux (25.05: intensity is luminance in nits), surfaces as UsdGeom, materials as UsdPreviewSurface.
//!
//! The stage is in metres, Z up. Lights have no scale and `normalize` is off, so that the luminance is what is written
//! whatever reads it.

mod lights;
mod surfaces;
mod text;

use std::collections::BTreeMap;

use super::facets::PLANE_REACH;
use super::job::{Chosen, Identifiers, one_line};
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::render::Progress;
use crate::scene::{Camera, Scene};
use text::{Text, pair, quoted, triple};

/// The stage's default prim, which holds everything.
const ROOT: &str = "/World";

/// The stage, with textures beside it.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let mut stage = Stage {
        job,
        text: Text::default(),
        files: Vec::new(),
        file_names: Identifiers::default(),
        remarks: Vec::new(),
        paths: BTreeMap::new(),
    };
    stage.text.open("Xform", "World", &[]);
    if job.surfaces {
        stage.materials();
        stage.surfaces();
        stage.camera(&job.scene.camera);
    }
    if job.lights.is_none() && !job.scene.variants.is_empty() {
        stage.variants(progress)?;
    } else {
        stage.remarks.extend(without_variants(job.scene));
        stage.text.open("Scope", "Lights", &[]);
        stage.lights(job, progress)?;
        stage.text.close();
    }
    stage.text.close();
    Ok(stage.finished())
}

/// A stage as it is written.
struct Stage<'a> {
    job: &'a Job<'a>,
    text: Text,
    files: Vec<File>,
    file_names: Identifiers,
    remarks: Vec<Remark>,
    /// Paths of surfaces and materials, by [`Named`].
    paths: BTreeMap<Named, String>,
}

/// What has a path in the stage.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Named {
    Surface(String),
    Material(String),
}

impl Stage<'_> {
    fn remark(&mut self, remark: Remark) {
        self.remarks.push(remark);
    }

    /// The path of a surface or material that is written.
    fn path(&self, named: &Named) -> Option<&str> {
        self.paths.get(named).map(String::as_str)
    }

    /// Puts a file beside the stage, once; gives its name.
    fn put(&mut self, name: &str, extension: &str, bytes: Vec<u8>) -> String {
        let same = |file: &&File| file.bytes == bytes && file.name.ends_with(extension);
        if let Some(file) = self.files.iter().find(same) {
            return file.name.clone();
        }
        let file = self.job.file_beside(&self.file_names.of(name), extension, bytes);
        self.files.push(file.clone());
        file.name
    }

    /// The lights of a job, which is the stage's or has the lights of a variant.
    fn lights(&mut self, job: &Job, progress: &Progress) -> Result<(), ExportError> {
        let Chosen { lights, remarks } = job.chosen_lights()?;
        self.remarks.extend(remarks);
        let mut names = Identifiers::default();
        for light in &lights {
            if progress.is_cancelled() {
                return Err(ExportError::Cancelled);
            }
            self.light(light, &mut names)?;
        }
        Ok(())
    }

    /// The states of the lights as a variant set, of which the one that the scene shows is chosen.
    fn variants(&mut self, progress: &Progress) -> Result<(), ExportError> {
        let scene = self.job.scene;
        let shown = scene.active_variant.as_deref().filter(|_| !scene.differs_from_variant());
        let mut names = Identifiers::default();
        let chosen = names.of(shown.unwrap_or("as_shown"));
        let others = scene.variants.iter().filter(|variant| shown != Some(&variant.name));
        let others: Vec<_> = others.map(|variant| (names.of(&variant.name), variant)).collect();
        let what = format!("its variants are the variant set \"lights\" of {ROOT}/Lights; \"{chosen}\" is chosen");
        self.remark(Remark::scene(Fate::Kept, what));
        self.text.open_with_variants("Scope", "Lights", ["lights", &chosen]);
        self.text.open_variant(&chosen);
        self.lights(self.job, progress)?;
        self.text.close();
        for (name, variant) in others {
            let start = self.remarks.len();
            self.text.open_variant(&name);
            let scene = Scene { lights: variant.lights.clone(), ..scene.clone() };
            self.lights(&Job { scene: &scene, ..*self.job }, progress)?;
            self.text.close();
            for remark in &mut self.remarks[start..] {
                remark.thing += &format!(" of variant {}", quoted(&variant.name));
            }
        }
        self.text.close();
        self.text.close();
        Ok(())
    }

    fn materials(&mut self) {
        let Scene { materials, .. } = self.job.scene;
        self.text.open("Scope", "Materials", &[]);
        let mut names = Identifiers::default();
        for material in materials {
            let name = names.of(&material.name);
            let path = format!("{ROOT}/Materials/{name}");
            surfaces::material(&mut self.text, material, &name, &path);
            self.paths.insert(Named::Material(material.name.clone()), path);
        }
        self.text.close();
    }

    fn surfaces(&mut self) {
        self.text.open("Scope", "Surfaces", &[]);
        let mut names = Identifiers::default();
        for surface in &self.job.scene.surfaces {
            let name = names.of(&surface.name);
            self.paths.insert(Named::Surface(surface.name.clone()), format!("{ROOT}/Surfaces/{name}"));
            let material = self.path(&Named::Material(surface.material.clone())).map(str::to_owned);
            let notes = surfaces::surface(&mut self.text, surface, &name, material.as_deref());
            let gloss = self.job.scene.material(&surface.material).and_then(super::gloss::gloss_remark);
            let notes: Vec<String> = notes.into_iter().chain(gloss).collect();
            let fate = if notes.is_empty() { Fate::Kept } else { Fate::Changed };
            let what = if notes.is_empty() { "as it is".to_owned() } else { notes.join("; ") };
            self.remark(Remark::surface(surface, fate, what));
        }
        self.text.close();
    }

    /// The camera of a picture 16 wide and 9 high, on a film of 24 mm across.
    fn camera(&mut self, camera: &Camera) {
        const HEIGHT: f64 = 24.0;
        let focal = 0.5 * HEIGHT / (0.5 * camera.fov_deg.to_radians()).tan();
        self.text.open("Camera", "Camera", &[]);
        self.text.attribute("float2", "clippingRange", &pair([0.01, 10.0 * PLANE_REACH]));
        self.text.attribute("float", "focalLength", &text::number(focal));
        self.text.attribute("float", "horizontalAperture", &text::number(HEIGHT * 16.0 / 9.0));
        self.text.attribute("float", "verticalAperture", &text::number(HEIGHT));
        let row = |v: glam::DVec3, w: f64| format!("({}, {})", triple(v).trim_matches(['(', ')']), w);
        let [right, up, back] = camera.axes();
        let rows = [row(right, 0.0), row(up, 0.0), row(back, 0.0), row(camera.eye, 1.0)];
        self.text.attribute("matrix4d", "xformOp:transform", &format!("( {} )", rows.join(", ")));
        self.text.attribute("uniform token[]", "xformOpOrder", "[\"xformOp:transform\"]");
        self.text.close();
    }

    /// The stage's text behind its header, and the files beside it.
    fn finished(self) -> Exported {
        let Self { job, text, files, remarks, .. } = self;
        let name = quoted(&one_line(&job.scene.name));
        let header = format!(
            "#usda 1.0\n(\n    defaultPrim = \"World\"\n    doc = {name}\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n"
        );
        let comments = job.header(&remarks, "#");
        let main = job.main_file(format!("{header}\n{comments}\n{}", text.finished()));
        Exported { files: [main].into_iter().chain(files).collect(), remarks }
    }
}
