//! What can be taken from the library: lights and scenes that come with the program, and the user's own presets.

pub mod drop;
mod place;
pub mod thumbnails;

pub use place::{place, resting};

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use super::commands::LightKind;
use super::presets::{self, Preset};
use super::session::{Item, Session};
use crate::scene::{self, LoadError, Scene};

/// Where a scene comes from.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// It comes with the program.
    Shipped(Preset),
    /// A file, as it was at that time.
    File(PathBuf, Option<SystemTime>),
}

/// Which shelf an entry stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shelf {
    /// Lights that come with the program.
    Lights,
    /// Scenes that come with the program.
    Scenes,
    /// The user's own presets.
    Own,
}

/// Something in the library.
#[derive(Clone, Debug)]
pub struct Entry {
    /// Where its scene comes from.
    pub source: Source,
    /// Which shelf it stands on.
    pub shelf: Shelf,
    /// What it is called.
    pub title: String,
    /// What it is, in a line.
    pub about: String,
    /// Words to find it by.
    pub tags: Vec<String>,
    /// What its first light is; none of a scene.
    pub kind: Option<LightKind>,
}

impl Source {
    /// A file as it is now.
    pub fn file(path: &Path) -> Self {
        let time = fs::metadata(path).and_then(|metadata| metadata.modified()).ok();
        Self::File(path.to_owned(), time)
    }

    /// The scene itself.
    pub fn load(&self) -> Result<Scene, LoadError> {
        match self {
            Self::Shipped(preset) => preset.load(),
            Self::File(path, _) => scene::load(path),
        }
    }
}

impl Entry {
    fn new(source: Source, shelf: Shelf, scene: &Scene) -> Self {
        let title = match &source {
            Source::Shipped(preset) => preset.title(),
            Source::File(path, _) if scene.name.is_empty() => {
                path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
            }
            Source::File(..) => scene.name.clone(),
        };
        let first = scene.lights.first().filter(|_| shelf != Shelf::Scenes);
        let kind = first.map(|light| LightKind::of(&light.shape));
        Self { source, shelf, title, about: about(scene), tags: scene.tags.clone(), kind }
    }

    /// Whether each word of `query` is part of its title, of what it is, or of a tag.
    pub fn matches(&self, query: &str) -> bool {
        let text = format!("{} {} {}", self.title, self.about, self.tags.join(" ")).to_lowercase();
        query.to_lowercase().split_whitespace().all(|word| text.contains(word))
    }
}

/// What comes with the program.
pub fn shipped() -> Vec<Entry> {
    let of = |presets: &'static [Preset], shelf| {
        presets.iter().filter_map(move |preset| {
            let scene = preset.load().ok()?;
            Some(Entry::new(Source::Shipped(*preset), shelf, &scene))
        })
    };
    of(presets::LIGHTS, Shelf::Lights).chain(of(presets::SCENES, Shelf::Scenes)).collect()
}

/// The user's presets in a folder, by title; what cannot be opened is left out.
pub fn own(folder: &Path) -> Vec<Entry> {
    let files = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let scenes = files.filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let mut entries: Vec<Entry> = scenes
        .filter_map(|path| {
            let scene = scene::load(&path).ok()?;
            let shelf = if scene.surfaces.is_empty() { Shelf::Own } else { Shelf::Scenes };
            Some(Entry::new(Source::file(&path), shelf, &scene))
        })
        .collect();
    entries.sort_by_key(|entry| entry.title.to_lowercase());
    entries
}

/// A scene's name, and its light or how many there are.
fn about(scene: &Scene) -> String {
    let what = match scene.lights.as_slice() {
        [light] => {
            let quantity = light.quantity;
            format!("{} light of {} {}", light.shape.name(), brief(quantity.value()), quantity.kind().unit())
        }
        lights => format!("{} lights", lights.len()),
    };
    if scene.name.is_empty() { what } else { format!("{}: {what}", scene.name) }
}

/// A number with as many digits as a glance takes in.
fn brief(value: f64) -> String {
    let text = if value.abs() < 100.0 { format!("{value:.1}") } else { format!("{value:.0}") };
    text.strip_suffix(".0").map_or_else(|| text.clone(), str::to_owned)
}

/// A preset of the selected lights, about the vertical axis, so that it is inserted where it is wanted.
pub fn preset_of_selection(session: &Session, name: &str, tags: &[String]) -> Scene {
    let chosen = session.selection.items().iter().filter_map(|item| match item {
        Item::Light(index) => session.scene().lights.get(*index).cloned(),
        _ => None,
    });
    let mut lights: Vec<_> = chosen.collect();
    let middle = lights.iter().map(|light| light.position).sum::<glam::DVec3>() / lights.len().max(1) as f64;
    for light in &mut lights {
        light.position.x -= middle.x;
        light.position.y -= middle.y;
        light.muted = false;
        // The surfaces that it is linked to stay behind.
        light.only = None;
    }
    Scene { name: name.to_owned(), tags: tags.to_vec(), lights, ..Scene::default() }
}

/// Write a preset called after its name in `folder`; the file. There must not be another of that name.
pub fn write_preset(preset: &Scene, folder: &Path) -> Result<PathBuf, String> {
    let words = preset.name.to_lowercase();
    let stem: Vec<&str> = words.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
    if stem.is_empty() {
        return Err("A preset needs a name of letters or digits".to_owned());
    }
    let path = folder.join(stem.join("-")).with_extension("toml");
    if path.exists() {
        return Err(format!("There is a preset “{}” already: choose another name", preset.name));
    }
    fs::create_dir_all(folder).map_err(|error: io::Error| format!("{}: {error}", folder.display()))?;
    scene::save(preset, &path).map_err(|error| error.to_string())?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_has_what_a_professional_would_look_for() {
        let entries = shipped();
        let find = |query: &str| entries.iter().filter(|entry| entry.matches(query)).count();
        for query in
            ["studio", "softbox", "daylight", "window", "office", "warm", "sign", "portrait", "comparison", "night"]
        {
            assert!(find(query) >= 2, "{query} finds {}", find(query));
        }
        assert_eq!(find("studio rim"), 1, "all words count");
        assert_eq!(find("no such light"), 0, "nothing");
        let lights = entries.iter().filter(|entry| entry.shelf == Shelf::Lights).count();
        let scenes = entries.iter().filter(|entry| entry.shelf == Shelf::Scenes).count();
        assert!(lights >= 24 && scenes >= 16, "{lights} lights, {scenes} scenes");
    }

    #[test]
    fn a_saved_selection_is_in_the_library_and_stands_about_the_axis() {
        let folder = tempfile::tempdir().expect("a folder");
        let mut session = Session::new(scene::first_light(), None);
        session.selection.set([Item::Light(0), Item::Surface(0)]);
        session.link_lights(&[0], Some(&[]));
        let preset = preset_of_selection(&session, "My window", &["mine".to_owned()]);
        assert_eq!(preset.lights.len(), 1, "lights only");
        assert_eq!(preset.lights[0].only, None, "linked to nothing that it leaves");
        let p = preset.lights[0].position;
        assert!(
            p.truncate().length() < 1e-12 && p.z == session.scene().lights[0].position.z,
            "about the axis, as high"
        );
        let path = write_preset(&preset, folder.path()).expect("written");
        assert!(path.ends_with("my-window.toml"), "{}", path.display());
        let entries = own(folder.path());
        assert_eq!(entries.len(), 1, "one preset");
        assert!(entries[0].matches("mine window"), "by tag and name");
        assert!(write_preset(&preset, folder.path()).is_err(), "never in the place of another");
        assert!(write_preset(&Scene { name: "…".to_owned(), ..preset }, folder.path()).is_err(), "nameless");
    }
}
