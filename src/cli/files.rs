//! Files named on the command line.

use std::borrow::Cow;
use std::path::Path;

use anyhow::{Context, bail};

use crate::scene::{self, Scene};
use crate::surface::Material;

/// The scene of a file; of several problems, the first, and how to see the others.
pub(super) fn load(path: &Path) -> anyhow::Result<Scene> {
    scene::load(path).map_err(|error| {
        let text = error.to_string();
        let mut problems = text.lines();
        let first = problems.next().unwrap_or_default();
        match problems.count() {
            0 => anyhow::Error::msg(first.to_owned()),
            more => anyhow::anyhow!("{first} (and {more} more, which `softbox check` lists)"),
        }
    })
}

/// The material of that name, or the scene's first.
pub(super) fn material<'a>(scene: &'a Scene, path: &Path, name: Option<&str>) -> anyhow::Result<&'a Material> {
    let names = || scene.materials.iter().map(|material| material.name.as_str()).collect::<Vec<_>>().join(", ");
    match name {
        _ if scene.materials.is_empty() => bail!("{}: has no material for the points", path.display()),
        Some(name) => scene
            .material(name)
            .with_context(|| format!("{}: has no material `{name}`; it has {}", path.display(), names())),
        None => Ok(&scene.materials[0]),
    }
}

/// The name of a file, without its folder.
pub(super) fn name(path: &Path) -> Cow<'_, str> {
    path.file_name().unwrap_or_default().to_string_lossy()
}

/// The format that an output's extension names.
pub(super) fn format<F: Copy>(path: &Path, formats: &[(&str, F)]) -> anyhow::Result<F> {
    let extension = path.extension().and_then(|extension| extension.to_str()).map(str::to_ascii_lowercase);
    let named = formats.iter().find(|(name, _)| extension.as_deref() == Some(*name));
    let Some((_, format)) = named else {
        let names: Vec<_> = formats.iter().map(|(name, _)| format!(".{name}")).collect();
        let (last, others) = names.split_last().map_or(("", &[][..]), |(last, others)| (last.as_str(), others));
        let or = if others.is_empty() { "" } else { " or " };
        bail!("{}: the name of the output must end in {}{or}{last}", path.display(), others.join(", "));
    };
    Ok(*format)
}

/// Fail now, rather than after the work, where an output cannot be written.
pub(super) fn check_writable(path: &Path) -> anyhow::Result<()> {
    if path.exists() && !path.is_file() {
        bail!("{}: cannot be written: it is not a regular file", path.display());
    }
    // A file without a name, which is gone when closed.
    tempfile::tempfile_in(folder(path)).map(drop).with_context(|| format!("{}: cannot be written", path.display()))
}

/// Write an output whole, or not at all.
pub(super) fn write(path: &Path, bytes: &[u8]) -> anyhow::Result<()> {
    scene::replace_file(path, bytes).with_context(|| format!("{}: cannot be written", path.display()))
}

fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| *folder != Path::new("")).unwrap_or(Path::new("."))
}
