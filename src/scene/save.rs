//! From a scene to a scene file.

use std::fmt::Write as _;
use std::fs;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use serde::Serialize;
use tempfile::{Builder, NamedTempFile};
use toml::ser::ValueSerializer;

use super::{Camera, Display, FORMAT, Plot, Problem, Scene, Variant, beside, load, merge, validate};
use crate::light::{Light, Tint};
use crate::surface::{Material, ReflectionModel, Surface};

/// Why a scene could not be saved. What stood in the file before still stands there.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The file could not be written.
    #[error("{}: cannot be saved: {cause}", file.display())]
    Write {
        /// The file.
        file: PathBuf,
        /// Why.
        cause: io::Error,
    },
    /// The scene could not be loaded again.
    #[error("{}: not saved, as it could not be opened again: {}", file.display(), problems[0])]
    Invalid {
        /// The file.
        file: PathBuf,
        /// What is wrong with the scene; at least one.
        problems: Vec<Problem>,
    },
    /// A file that it names could not be put beside it.
    #[error("{}: not saved, as its {noun} {} cannot be: {cause}", file.display(), beside.display())]
    Beside {
        /// The scene's file.
        file: PathBuf,
        /// What the other is to the scene.
        noun: &'static str,
        /// The other file.
        beside: PathBuf,
        /// Why.
        cause: io::Error,
    },
}

/// Save a scene in a file; if there is one, with the comments and the form of what did not change ([`merge()`]).
///
/// After a crash at any moment, the file is the old one or the new one: the text goes to a new file in the same folder,
/// and to the disk, before that takes the name. A symbolic link is followed, and an existing file's permissions are kept.
pub fn save(scene: &Scene, path: impl AsRef<Path>) -> Result<(), SaveError> {
    save_as(scene, &path, &path)
}

/// [`save`], but with the comments and the form of the file `source`, from which the scene was loaded.
///
/// Patterns and meshes go along: where the new folder has no file of one's name, it is written there. Another file of that
/// name is not replaced; then nothing is saved.
pub fn save_as(scene: &Scene, path: impl AsRef<Path>, source: impl AsRef<Path>) -> Result<(), SaveError> {
    save_over(scene, path, source, None)
}

/// [`save_as`] for a scene that was loaded from or saved to `path` before, as `saved`: painted patterns replace what
/// they were then ([`super::with_painted_files`]).
pub fn save_over(
    scene: &Scene,
    path: impl AsRef<Path>,
    source: impl AsRef<Path>,
    saved: Option<&Scene>,
) -> Result<(), SaveError> {
    let path = path.as_ref();
    let painted = super::with_painted_files(scene, path, saved)
        .map_err(|cause| SaveError::Write { file: path.to_owned(), cause: io::Error::other(cause) })?;
    let scene = painted.as_ref().unwrap_or(scene);
    let problems = validate(scene);
    if !problems.is_empty() {
        return Err(SaveError::Invalid { file: path.to_owned(), problems });
    }
    beside::write_missing(scene, path, saved)?;
    let old = load::read(source.as_ref()).ok().and_then(|bytes| String::from_utf8(bytes).ok());
    let text = old.map_or_else(|| to_toml(scene), |old| merge(&old, scene));
    replace_file(path, text.as_bytes()).map_err(|cause| SaveError::Write { file: path.to_owned(), cause })
}

/// The text of a scene's file.
///
/// Equal scenes give equal texts. Defaults are left out; `[camera]` and `[display]` stand in a preset only if they
/// differ from theirs.
pub fn to_toml(scene: &Scene) -> String {
    let Scene { name, tags, camera, display, materials, surfaces, lights, plots, variants, active_variant } = scene;
    let mut out = Table::default();
    out.key("format", &FORMAT);
    out.key_unless(name.is_empty(), "name", name);
    out.key_unless(tags.is_empty(), "tags", tags);
    if let Some(active) = active_variant {
        out.key("active_variant", active);
    }
    let is_preset = surfaces.is_empty();
    if !is_preset || *camera != Camera::default() {
        write_camera(&mut out, camera);
    }
    if !is_preset || *display != Display::default() {
        write_display(&mut out, display);
    }
    materials.iter().for_each(|material| write_material(&mut out, material));
    surfaces.iter().for_each(|surface| write_surface(&mut out, surface));
    lights.iter().for_each(|light| write_light(&mut out, "[[light]]", light));
    plots.iter().for_each(|plot| write_plot(&mut out, plot));
    variants.iter().for_each(|variant| write_variant(&mut out, variant));
    out.0
}

// Every struct below is taken apart whole, so that a new field cannot be forgotten.

fn write_camera(out: &mut Table, camera: &Camera) {
    let Camera { eye, target, fov_deg } = camera;
    out.header("[camera]");
    out.key("eye", eye);
    out.key("target", target);
    out.key("fov_deg", fov_deg);
}

fn write_display(out: &mut Table, display: &Display) {
    let Display { exposure_ev } = display;
    out.header("[display]");
    out.key("exposure_ev", exposure_ev);
}

fn write_material(out: &mut Table, material: &Material) {
    let Material { name, diffuse, specular, model, exponent } = material;
    out.header("[[material]]");
    out.key("name", name);
    out.key("diffuse", diffuse);
    out.key("specular", specular);
    out.key_unless(*model == ReflectionModel::default(), "model", model);
    out.key("exponent", exponent);
}

fn write_surface(out: &mut Table, surface: &Surface) {
    let Surface { name, material, position, rotation_deg, scale, shape } = surface;
    out.header("[[surface]]");
    out.key("name", name);
    out.key("material", material);
    out.key_unless(*position == Default::default(), "position", position);
    out.key_unless(*rotation_deg == Default::default(), "rotation_deg", rotation_deg);
    out.key_unless(*scale == glam::DVec3::ONE, "scale", scale);
    out.key("shape", shape);
}

fn write_variant(out: &mut Table, variant: &Variant) {
    let Variant { name, lights } = variant;
    out.header("[[variant]]");
    out.key("name", name);
    lights.iter().for_each(|light| write_light(out, "[[variant.light]]", light));
}

fn write_light(out: &mut Table, header: &str, light: &Light) {
    let Light { name, position, rotation_deg, tint, quantity, muted, group, only, shape } = light;
    out.header(header);
    out.key("name", name);
    out.key_unless(*position == Default::default(), "position", position);
    out.key_unless(*rotation_deg == Default::default(), "rotation_deg", rotation_deg);
    match tint {
        Tint::Color(color) => out.key_unless(*tint == Tint::default(), "color", color),
        Tint::TemperatureK(kelvin) => out.key("temperature_k", kelvin),
    }
    out.key(quantity.kind().key(), &quantity.value());
    out.key_unless(!muted, "muted", muted);
    if let Some(group) = group {
        out.key("group", group);
    }
    if let Some(only) = only {
        out.key("only", only);
    }
    out.key("shape", shape);
}

fn write_plot(out: &mut Table, plot: &Plot) {
    let Plot { name, kind, quantity, position, normal, view, axis, range, material, normalise } = plot;
    out.header("[[plot]]");
    out.key("name", name);
    out.key("kind", kind);
    out.key("quantity", quantity);
    out.key("position", position);
    out.key("normal", normal);
    if let Some(view) = view {
        out.key("view", view);
    }
    out.key("axis", axis);
    out.key("range", range);
    if let Some(material) = material {
        out.key("material", material);
    }
    out.key_unless(!normalise, "normalise", normalise);
}

/// A TOML document as it is written.
#[derive(Default)]
struct Table(String);

impl Table {
    /// Start a table, an empty line before it.
    fn header(&mut self, header: &str) {
        self.0.push('\n');
        self.0.push_str(header);
        self.0.push('\n');
    }

    /// A key and its value on one line.
    fn key(&mut self, key: &str, value: &impl Serialize) {
        write!(self.0, "{key} = ").expect("a String takes all text");
        value.serialize(ValueSerializer::new(&mut self.0)).expect("scenes hold only what TOML can say");
        self.0.push('\n');
    }

    fn key_unless(&mut self, is_default: bool, key: &str, value: &impl Serialize) {
        if !is_default {
            self.key(key, value);
        }
    }
}

/// Put `bytes` in the place of the file `path`, all or nothing; what is not a regular file is left alone.
///
/// # Errors
///
/// What the system says; the old file is then as it was.
pub fn replace_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    Staged::new(path, bytes)?.put()
}

/// [`replace_file`] for several files: all or none. Each is on the disk under another name before the first takes its own.
///
/// # Errors
///
/// What the system says, and of which file; all old files are then as they were.
pub fn replace_files(files: &[(PathBuf, &[u8])]) -> Result<(), (PathBuf, io::Error)> {
    let staged: Vec<_> = files
        .iter()
        .map(|(path, bytes)| Staged::with_old(path, bytes).map_err(|error| (path.clone(), error)))
        .collect::<Result<_, _>>()?;
    let mut done: Vec<(PathBuf, Option<Vec<u8>>)> = Vec::new();
    for ((staged, old), (name, _)) in staged.into_iter().zip(files) {
        let path = staged.path.clone();
        if let Err(error) = staged.put() {
            // What cannot be undone either is not worse than what is told.
            for (path, old) in done {
                let _ = old.map_or_else(|| fs::remove_file(&path), |old| replace_file(&path, &old));
            }
            return Err((name.clone(), error));
        }
        done.push((path, old));
    }
    Ok(())
}

/// A file that is on the disk, but not yet under its name.
struct Staged {
    new: NamedTempFile,
    path: PathBuf,
}

impl Staged {
    /// Put the bytes beside the file `path`, ready to take its place.
    fn new(path: &Path, bytes: &[u8]) -> io::Result<Self> {
        let path = follow_links(path)?;
        let old = match fs::metadata(&path) {
            Ok(old) if old.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(old) if !old.is_file() => return Err(io::Error::other("it is not a regular file")),
            Ok(old) if old.permissions().readonly() => return Err(io::Error::other("the file is read-only")),
            Ok(old) => Some(old),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        let new = temporary_file(beside::folder_of(&path), bytes)?;
        if let Some(old) = old {
            new.as_file().set_permissions(old.permissions())?;
        }
        new.as_file().sync_all()?;
        Ok(Self { new, path })
    }

    /// [`Self::new`], and what stands in its place now.
    fn with_old(path: &Path, bytes: &[u8]) -> io::Result<(Self, Option<Vec<u8>>)> {
        let staged = Self::new(path, bytes)?;
        match fs::read(&staged.path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok((staged, None)),
            old => Ok((staged, Some(old?))),
        }
    }

    /// Give it its name.
    fn put(self) -> io::Result<()> {
        self.new.persist(&self.path).map_err(|error| error.error)?;
        sync_folder(beside::folder_of(&self.path))
    }
}

/// Make the file `path` of `bytes`, all or nothing; never in the place of another.
pub(super) fn create_file(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = beside::folder_of(path);
    let new = temporary_file(folder, bytes)?;
    new.as_file().sync_all()?;
    new.persist_noclobber(path).map_err(|error| error.error)?;
    sync_folder(folder)
}

fn temporary_file(folder: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".softbox-").suffix(".tmp");
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666)); // less the umask, as any new file
    let mut new = builder.tempfile_in(folder)?;
    new.write_all(bytes)?;
    Ok(new)
}

/// The file that `path` stands for when all symbolic links are followed; it need not exist.
fn follow_links(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const MAX_LINKS: usize = 40;
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        if !path.is_symlink() {
            return Ok(path);
        }
        let target = fs::read_link(&path)?;
        path = path.parent().unwrap_or(Path::new("")).join(target);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Bring a renaming in `folder` to the disk.
fn sync_folder(folder: &Path) -> io::Result<()> {
    if cfg!(unix) { fs::File::open(folder)?.sync_all() } else { Ok(()) }
}
