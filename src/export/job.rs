//! What is to be exported, and what comes of it.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use super::preflight::{Fate, Remark, lines};
use super::{Origin, Target};
use crate::light::Light;
use crate::render::MethodChoice;
use crate::scene::{Scene, suggestion};
use crate::shading::fit::Budget;

/// What to export.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The name of its file, for headers.
    pub scene_name: &'a str,
    /// The main file's name without its extension; names of files beside it begin so.
    pub stem: &'a str,
    /// What to write.
    pub target: Target,
    /// Names of the lights; all that are not muted where there is no list.
    pub lights: Option<&'a [String]>,
    /// Whether surfaces and their materials go along.
    pub surfaces: bool,
    /// What only some targets look at.
    pub options: Options,
}

/// What only some targets look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How lights are shaded: pictures.
    pub method: MethodChoice,
    /// Width and height in pixels: pictures.
    pub size: [u32; 2],
    /// How many punctual lights stand for a light: glTF.
    pub punctual: Budget,
}

impl Default for Options {
    fn default() -> Self {
        Self { method: MethodChoice::default(), size: [960, 540], punctual: Budget::default() }
    }
}

/// What an export gives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// The files; the first is the main one, which may name the others.
    pub files: Vec<File>,
    /// At least one of each light and surface of the job.
    pub remarks: Vec<Remark>,
}

/// A file to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Its name, without a folder.
    pub name: String,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Why there is no export.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// Stopped early.
    #[error("stopped before it was done")]
    Cancelled,
    /// A light that the scene does not have.
    #[error("has no light `{name}`; {known}")]
    UnknownLight {
        /// The name asked for.
        name: String,
        /// Which may be meant.
        known: String,
    },
    /// There is nothing that this target could hold.
    #[error("{0}")]
    Nothing(String),
    /// Something that should be written cannot be encoded.
    #[error("{what} cannot be written: {cause}")]
    Encode {
        /// What.
        what: String,
        /// Why.
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// The lights of a job, as they are written.
#[derive(Clone, Debug)]
pub(super) struct Chosen {
    /// None is muted; none is linked to surfaces that are left out.
    pub(super) lights: Vec<Light>,
    /// What has become of others, and of these on the way.
    pub(super) remarks: Vec<Remark>,
}

impl Exported {
    /// Where the files go: the main one to `output`, the others into its folder. The main one comes last, as it names
    /// them.
    pub fn placed(&self, output: &Path) -> Vec<(PathBuf, &[u8])> {
        let placed = self.files.iter().enumerate().map(|(i, file)| {
            let path = if i == 0 { output.to_owned() } else { output.with_file_name(&file.name) };
            (path, file.bytes.as_slice())
        });
        placed.rev().collect()
    }

    /// Whether something is not in the files.
    pub fn has_losses(&self) -> bool {
        self.remarks.iter().any(|remark| remark.fate == Fate::Lost)
    }
}

impl Job<'_> {
    /// Who makes the files, and of what.
    pub(super) fn origin(&self) -> Origin<'_> {
        Origin { scene: self.scene_name }
    }

    /// The main file of these bytes.
    pub(super) fn main_file(&self, bytes: impl Into<Vec<u8>>) -> File {
        File { name: format!("{}.{}", self.stem, self.target.extension()), bytes: bytes.into() }
    }

    /// A file beside the main one; `what` is an identifier, unique in the job.
    pub(super) fn file_beside(&self, what: &str, extension: &str, bytes: impl Into<Vec<u8>>) -> File {
        File { name: format!("{}-{what}.{extension}", self.stem), bytes: bytes.into() }
    }

    /// The lights to write: those that are named, or all that are not muted.
    pub(super) fn chosen_lights(&self) -> Result<Chosen, ExportError> {
        let mut chosen = Chosen { lights: Vec::new(), remarks: Vec::new() };
        self.check_names()?;
        for light in &self.scene.lights {
            let is_named = self.lights.is_some_and(|names| names.contains(&light.name));
            if self.lights.is_some() && !is_named {
                continue;
            }
            let mut remark = |what: &str| chosen.remarks.push(Remark::light(light, Fate::Changed, what));
            if light.muted && !is_named {
                remark("is muted and left out; unmute it, or choose it by name");
                continue;
            }
            let mut light = light.clone();
            if light.muted {
                remark("is muted, but written as if it were not, as it was chosen by name");
                light.muted = false;
            }
            if !self.surfaces && light.only.is_some() {
                remark("is linked to surfaces that are left out; it lights everything");
                light.only = None;
            }
            chosen.lights.push(light);
        }
        Ok(chosen)
    }

    /// The scene with the lights and surfaces of the job, and remarks about what is left out.
    pub(super) fn chosen_scene(&self) -> Result<(Scene, Vec<Remark>), ExportError> {
        let Chosen { lights, remarks } = self.chosen_lights()?;
        let mut scene = Scene { lights, ..self.scene.clone() };
        if !self.surfaces {
            scene.surfaces.clear();
        }
        Ok((scene, remarks))
    }

    /// Whether all lights asked for exist.
    fn check_names(&self) -> Result<(), ExportError> {
        let known: Vec<_> = self.scene.lights.iter().map(|light| light.name.as_str()).collect();
        let unknown = self.lights.into_iter().flatten().find(|name| !known.contains(&name.as_str()));
        unknown.map_or(Ok(()), |name| {
            Err(ExportError::UnknownLight { name: name.clone(), known: suggestion(name, known) })
        })
    }

    /// The lines that a file begins with, behind a comment's sign: who wrote it, of what, and what became of each thing.
    pub(super) fn header(&self, remarks: &[Remark], comment: &str) -> String {
        let lines = [self.origin().line()].into_iter().chain(lines(remarks).into_iter().map(|line| one_line(&line)));
        lines.map(|line| format!("{comment} {line}\n")).collect()
    }
}

/// A text without line breaks or other control characters.
pub(super) fn one_line(text: &str) -> String {
    text.replace(|c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}'), " ")
}

/// A number that comes back to the last bit, the shortest one; zero without a sign.
pub(super) fn number(value: f64) -> String {
    format!("{}", value + 0.0)
}

/// Names that are taken, where things need identifiers of their own.
#[derive(Debug, Default)]
pub(super) struct Identifiers(BTreeSet<String>);

impl Identifiers {
    /// A new identifier like `name`: ASCII letters, digits and underscores, no digit first; numbered where it is taken,
    /// whatever the case of its letters.
    pub(super) fn of(&mut self, name: &str) -> String {
        let mut identifier: String = name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
        if !identifier.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            identifier.insert(0, '_');
        }
        let numbered = (2..).map(|number| format!("{identifier}_{number}"));
        let mut candidates = std::iter::once(identifier.clone()).chain(numbered);
        candidates.find(|candidate| self.0.insert(candidate.to_ascii_lowercase())).unwrap_or(identifier)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Point, Shape};

    fn scene() -> Scene {
        let mut scene = crate::scene::first_light();
        let light = |name: &str| Light::new(name, Shape::Point(Point::default()));
        let linked = Light { only: Some(vec!["ball".to_owned()]), ..light("linked") };
        scene.lights = vec![light("on"), Light { muted: true, ..light("muted") }, linked];
        scene
    }

    #[track_caller]
    fn check(names: Option<&[&str]>, surfaces: bool, lights: &[&str], remarks: usize) {
        let scene = scene();
        let names: Option<Vec<String>> = names.map(|names| names.iter().map(|name| (*name).to_owned()).collect());
        let job = Job {
            scene: &scene,
            scene_name: "first-light.toml",
            stem: "out",
            target: Target::Json,
            lights: names.as_deref(),
            surfaces,
            options: Options::default(),
        };
        let chosen = job.chosen_lights().expect("they exist");
        let found: Vec<_> = chosen.lights.iter().map(|light| light.name.as_str()).collect();
        assert_eq!((found.as_slice(), chosen.remarks.len()), (lights, remarks), "{:?}", chosen.remarks);
        assert!(chosen.lights.iter().all(|light| !light.muted), "a light is muted");
        assert!(surfaces || chosen.lights.iter().all(|light| light.only.is_none()), "a light is linked to nothing");
    }

    #[test]
    fn the_lights_are_those_named_or_all_that_shine() {
        check(None, true, &["on", "linked"], 1);
        check(None, false, &["on", "linked"], 2);
        check(Some(&["muted", "on"]), true, &["on", "muted"], 1);
        check(Some(&[]), true, &[], 0);
    }

    #[test]
    fn identifiers_differ_even_where_case_does_not_count() {
        let mut identifiers = Identifiers::default();
        let found = ["key light", "Key_Light", "2 m", "ß", ""].map(|name| identifiers.of(name));
        assert_eq!(found, ["key_light", "Key_Light_2", "_2_m", "_", "__2"], "identifiers");
    }

    #[test]
    fn numbers_come_back_and_zero_has_no_sign() {
        for value in [0.1 + 0.2, 1e-7, -2.5, 1e21] {
            assert_eq!(number(value).parse(), Ok(value), "{value}");
        }
        assert_eq!(number(-0.0), "0", "zero");
    }
}
