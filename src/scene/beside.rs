//! The files that a scene names: below its folder, and saved beside another scene.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Read};
use std::path::{Component, Path, PathBuf};
use std::sync::Arc;

use super::painted::{is_known, is_own};
use super::save::{SaveError, create_file, replace_file};
use super::{Problem, Scene};
use crate::contents::Contents;
use crate::light::pattern::{Image, Pattern};
use crate::light::photometry::{Distribution, Photometry};
use crate::light::{self, Light};
use crate::surface::{self, Mesh, Surface, Triangle};

/// Files named in a scene that are larger than this are refused before they are read, bytes.
pub const MAX_CONTENTS_BYTES: u64 = 320 << 20;

/// Whether a name is that of a file below the scene's folder.
pub(super) fn is_inside(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// The folder that a file is in.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    }
}

/// A file that a scene names.
struct Named<'s> {
    path: super::Path,
    file: &'s str,
    contents: &'s Contents,
    holds: Holds<'s>,
}

/// What a file holds.
#[derive(PartialEq)]
enum Holds<'s> {
    Pattern(&'s Image),
    Photometry(&'s Arc<Distribution>),
    Mesh(&'s Arc<[Triangle]>),
}

impl Holds<'_> {
    fn noun(&self) -> &'static str {
        match self {
            Self::Pattern(_) => "pattern",
            Self::Photometry(_) => "photometric file",
            Self::Mesh(_) => "mesh",
        }
    }

    /// Bit by bit, but for what is shared.
    fn is_same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Mesh(a), Self::Mesh(b)) => Arc::ptr_eq(a, b) || a == b,
            (Self::Photometry(a), Self::Photometry(b)) => Arc::ptr_eq(a, b) || a == b,
            _ => self == other,
        }
    }
}

/// All files that a scene names, with their places in it.
fn named(scene: &Scene) -> Vec<Named<'_>> {
    let patterns = lists_of_lights(scene).into_iter().flat_map(|(path, lights)| {
        lights.iter().enumerate().filter_map(move |(i, light)| {
            let Pattern { file, image, contents } = pattern_of(light)?;
            Some(Named { path: pattern_path(&path.index(i)), file, contents, holds: Holds::Pattern(image) })
        })
    });
    let photometries = lists_of_lights(scene).into_iter().flat_map(|(path, lights)| {
        lights.iter().enumerate().filter_map(move |(i, light)| {
            let Photometry { file, distribution, contents } = photometry_of(light)?;
            Some(Named {
                path: photometry_path(&path.index(i)),
                file,
                contents,
                holds: Holds::Photometry(distribution),
            })
        })
    });
    let meshes = scene.surfaces.iter().enumerate().filter_map(|(i, surface)| {
        let Mesh { file, triangles, contents } = mesh_of(surface)?;
        Some(Named { path: mesh_path(i), file, contents, holds: Holds::Mesh(triangles) })
    });
    patterns.chain(photometries).chain(meshes).collect()
}

/// The scene's lights and those of each variant, with the path of each list.
fn lists_of_lights(scene: &Scene) -> Vec<(super::Path, &[Light])> {
    let variants = scene.variants.iter().enumerate();
    let lights = variants.map(|(i, variant)| (variant_lights_path(i), variant.lights.as_slice()));
    [(lights_path(), scene.lights.as_slice())].into_iter().chain(lights).collect()
}

/// All patterns of a scene, with their paths.
pub(super) fn patterns_mut(scene: &mut Scene) -> Vec<(super::Path, &mut Pattern)> {
    lights_mut(scene).filter_map(|(path, light)| Some((pattern_path(&path), pattern_mut(light)?))).collect()
}

/// All photometric files of a scene, with their paths.
pub(super) fn photometries_mut(scene: &mut Scene) -> Vec<(super::Path, &mut Photometry)> {
    lights_mut(scene).filter_map(|(path, light)| Some((photometry_path(&path), photometry_mut(light)?))).collect()
}

/// All lights of a scene, with their paths.
fn lights_mut(scene: &mut Scene) -> impl Iterator<Item = (super::Path, &mut Light)> {
    let variants = scene.variants.iter_mut().enumerate();
    let lights = variants.map(|(i, variant)| (variant_lights_path(i), &mut variant.lights));
    let lists = [(lights_path(), &mut scene.lights)].into_iter().chain(lights);
    lists.flat_map(|(path, lights)| lights.iter_mut().enumerate().map(move |(i, light)| (path.index(i), light)))
}

fn lights_path() -> super::Path {
    super::Path::default().key("light")
}

fn variant_lights_path(variant: usize) -> super::Path {
    super::Path::default().key("variant").index(variant).key("light")
}

/// The path of the pattern of the light at `light`.
fn pattern_path(light: &super::Path) -> super::Path {
    light.key("shape").key("textured").key("pattern")
}

/// The path of the photometric file of the light at `light`.
fn photometry_path(light: &super::Path) -> super::Path {
    light.key("shape").key("point").key("ies")
}

/// The path of a mesh's file.
pub(super) fn mesh_path(surface: usize) -> super::Path {
    super::Path::default().key("surface").index(surface).key("shape").key("mesh").key("file")
}

pub(super) fn pattern_of(light: &Light) -> Option<&Pattern> {
    if let light::Shape::Textured(textured) = &light.shape { Some(&textured.pattern) } else { None }
}

pub(super) fn pattern_mut(light: &mut Light) -> Option<&mut Pattern> {
    if let light::Shape::Textured(textured) = &mut light.shape { Some(&mut textured.pattern) } else { None }
}

fn photometry_of(light: &Light) -> Option<&Photometry> {
    if let light::Shape::Point(point) = &light.shape { point.ies.as_ref() } else { None }
}

fn photometry_mut(light: &mut Light) -> Option<&mut Photometry> {
    if let light::Shape::Point(point) = &mut light.shape { point.ies.as_mut() } else { None }
}

fn mesh_of(surface: &Surface) -> Option<&Mesh> {
    if let surface::Shape::Mesh(mesh) = &surface.shape { Some(mesh) } else { None }
}

pub(super) fn mesh_mut(surface: &mut Surface) -> Option<&mut Mesh> {
    if let surface::Shape::Mesh(mesh) = &mut surface.shape { Some(mesh) } else { None }
}

/// Read what `uses` name, each file once, and put it in its place; what is wrong is returned. Names that leave the
/// scene's folder are not read.
pub(super) fn read_each<'s, T: Clone + 's>(
    uses: impl Iterator<Item = (super::Path, &'s mut T)>,
    file_of: impl Fn(&T) -> &str,
    mut open: impl FnMut(&str) -> Result<T, String>,
) -> Vec<Problem> {
    let mut known: BTreeMap<String, Result<T, String>> = BTreeMap::new();
    let mut problems = Vec::new();
    for (path, place) in uses {
        let file = file_of(place).to_owned();
        if !is_inside(&file) {
            continue;
        }
        match known.entry(file).or_insert_with_key(|file| open(file)) {
            Ok(found) => *place = found.clone(),
            Err(message) => problems.push(Problem::new(path, message.clone())),
        }
    }
    problems
}

/// A file that is taken into a scene from anywhere.
pub(super) struct Imported {
    /// The file's own name, on one line.
    pub(super) own_name: String,
    pub(super) bytes: Vec<u8>,
}

impl Imported {
    /// Read a file; what is wrong is one line.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let own_name = name.replace(char::is_control, " ");
        let bytes =
            read_file(folder_of(path), &name).map_err(|cause| format!("`{own_name}` cannot be read: {cause}"))?;
        Ok(Self { own_name, bytes })
    }

    /// What the file `path` is called in the scene whose file is `scene`, if it has one: below its folder as it is, any
    /// other by its own name in `folder`, numbered where there is another file of that name.
    pub(super) fn name(&self, path: &Path, scene: Option<&Path>, folder: &str) -> String {
        let beside = scene.map(folder_of);
        beside.and_then(|beside| name_below(beside, path)).unwrap_or_else(|| {
            let numbered = (1..).map(|number| format!("{folder}/{}", numbered(Path::new(&self.own_name), number)));
            let is_free = |name: &String| match beside.map(|beside| read_file(beside, name)) {
                None => true,
                Some(Ok(there)) => there == self.bytes,
                Some(Err(error)) => error.kind() == io::ErrorKind::NotFound,
            };
            numbered.into_iter().find(is_free).unwrap_or_default()
        })
    }
}

/// The name of a file below `folder`, as scenes write it.
fn name_below(folder: &Path, path: &Path) -> Option<String> {
    let (folder, path) = (fs::canonicalize(folder).ok()?, fs::canonicalize(path).ok()?);
    let parts: Option<Vec<&str>> = path.strip_prefix(folder).ok()?.iter().map(|part| part.to_str()).collect();
    parts.map(|parts| parts.join("/")).filter(|name| is_inside(name) && !name.contains(char::is_control))
}

/// `leaf.png`, then `leaf-2.png` and so on.
fn numbered(file: &Path, number: u32) -> String {
    if number < 2 {
        return file.to_string_lossy().into_owned();
    }
    let part = |part: Option<&std::ffi::OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, extension) = (part(file.file_stem()), part(file.extension()));
    file.with_file_name(format!("{stem}-{number}")).with_extension(extension).to_string_lossy().into_owned()
}

/// The bytes of a regular file that the file `path` names, in its folder or below it.
///
/// # Errors
///
/// What the system says, or that a link leads out of that folder.
pub fn read_beside(path: &Path, name: &str) -> io::Result<Vec<u8>> {
    if is_inside(name) { read_file(folder_of(path), name) } else { Err(io::Error::other("it is not in the folder")) }
}

/// The bytes of a regular file below `folder` that is not too large, whatever links lead to it.
pub(super) fn read_file(folder: &Path, name: &str) -> io::Result<Vec<u8>> {
    let path = fs::canonicalize(folder.join(name))?;
    if !path.starts_with(fs::canonicalize(folder)?) {
        return Err(leaves_folder());
    }
    let metadata = fs::metadata(&path)?;
    if metadata.is_dir() {
        return Err(io::Error::other("it is a directory"));
    }
    if !metadata.is_file() {
        return Err(io::Error::other("it is not a regular file"));
    }
    if metadata.len() > MAX_CONTENTS_BYTES {
        return Err(io::Error::other(format!("it is larger than {} MiB", MAX_CONTENTS_BYTES >> 20)));
    }
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(MAX_CONTENTS_BYTES).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn leaves_folder() -> io::Error {
    io::Error::other("a link leads out of the scene's folder")
}

/// The scene as its text alone gives it.
pub(super) fn unread(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for (_, pattern) in patterns_mut(&mut scene) {
        *pattern = Pattern::unread(std::mem::take(&mut pattern.file));
    }
    for (_, photometry) in photometries_mut(&mut scene) {
        *photometry = Photometry::unread(std::mem::take(&mut photometry.file));
    }
    for mesh in scene.surfaces.iter_mut().filter_map(mesh_mut) {
        *mesh = Mesh::unread(std::mem::take(&mut mesh.file));
    }
    scene
}

/// Files of one name that hold different things.
pub(super) fn ambiguous(scene: &Scene) -> Vec<Problem> {
    let named = named(scene);
    let mut first: BTreeMap<&str, &Named<'_>> = BTreeMap::new();
    let mut problems = Vec::new();
    for file in &named {
        let other = *first.entry(file.file).or_insert(file);
        if !other.holds.is_same(&file.holds) {
            let noun = if matches!(file.holds, Holds::Pattern(_)) { "picture" } else { file.holds.noun() };
            let message =
                format!("`{}` is another {noun} here than in {}; give it its own name", file.file, other.path.entry());
            problems.push(Problem::new(file.path.clone(), message));
        }
    }
    problems
}

/// Rename the file that a light names, `leaf.png` to `leaf-2.png`, while `others` have a different one of its name.
pub fn keep_apart<'a>(light: &mut Light, others: impl IntoIterator<Item = &'a Light>) {
    let others: Vec<&Light> = others.into_iter().collect();
    if let Some(pattern) = pattern_mut(light) {
        let others = || others.iter().filter_map(|other| pattern_of(other));
        let image = &pattern.image;
        pattern.file = free_name(&pattern.file, |file| others().any(|o| o.file == file && o.image != *image));
    }
    if let Some(photometry) = photometry_mut(light) {
        let others = || others.iter().filter_map(|other| photometry_of(other));
        let own = &photometry.distribution;
        photometry.file =
            free_name(&photometry.file, |file| others().any(|o| o.file == file && o.distribution != *own));
    }
}

/// [`keep_apart`] for a surface's mesh.
pub fn keep_mesh_apart(surface: &mut Surface, others: &[Surface]) {
    let Some(mesh) = mesh_mut(surface) else { return };
    let triangles = &mesh.triangles;
    let others = || others.iter().filter_map(mesh_of);
    mesh.file = free_name(&mesh.file, |file| others().any(|other| other.file == file && other.triangles != *triangles));
}

pub(super) fn free_name(file: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let names = (1..).map(|number| numbered(&PathBuf::from(file), number));
    names.into_iter().find(|name| !is_taken(name)).unwrap_or_default()
}

/// Put the files that are not there yet beside the scene's file `path`, and those of its own folder that have changed
/// since the scene was `saved` there.
pub(super) fn write_missing(scene: &Scene, path: &Path, saved: Option<&Scene>) -> Result<(), SaveError> {
    for Named { file, contents, holds, .. } in named(scene) {
        write(file, contents, path, saved).map_err(|cause| SaveError::Beside {
            file: path.to_owned(),
            noun: holds.noun(),
            beside: folder_of(path).join(file),
            cause,
        })?;
    }
    Ok(())
}

fn write(file: &str, contents: &Contents, scene: &Path, saved: Option<&Scene>) -> io::Result<()> {
    let folder = folder_of(scene);
    match read_file(folder, file) {
        Ok(bytes) if bytes == *contents.0 => Ok(()),
        Ok(bytes) if is_own(file, scene) && is_known(file, &bytes, saved) => {
            replace_file(&folder.join(file), &contents.0)
        }
        Ok(_) => Err(io::Error::other("there is another file of that name; rename one of the two")),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            if contents.0.is_empty() {
                return Err(io::Error::other("it has not been read from a file"));
            }
            let path = folder.join(file);
            fs::create_dir_all(folder_of(&path))?;
            if !fs::canonicalize(folder_of(&path))?.starts_with(fs::canonicalize(folder)?) {
                return Err(leaves_folder());
            }
            create_file(&path, &contents.0)
        }
        Err(error) => Err(error),
    }
}
