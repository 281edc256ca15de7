//! From a scene file to a scene.

use std::fs;
use std::io::{self, Read};

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::file::File;
use super::problem::{LoadError, Path, Place, Problem, Segment};
use super::{FORMAT, Scene, beside, mesh, pattern, photometry, schema, structure, validate};

/// Scene files larger than this are refused before they are read, bytes.
pub const MAX_FILE_BYTES: u64 = 16 << 20;

/// Problems beyond this number are only counted.
const MAX_PROBLEMS: usize = 100;

/// Load a scene or a light preset, and the files that it names.
pub fn load(path: impl AsRef<std::path::Path>) -> Result<Scene, LoadError> {
    let path = path.as_ref();
    let bytes = read(path).map_err(|cause| LoadError::Read { file: path.to_owned(), cause })?;
    match std::str::from_utf8(&bytes) {
        Ok(text) => parse_with(text, path, |name| beside::read_file(beside::folder_of(path), name)),
        Err(error) => {
            let valid = String::from_utf8_lossy(&bytes[..error.valid_up_to()]);
            let problem = Problem {
                place: Some(Place::of_offset(&valid, valid.len())),
                ..Problem::new(Path::default(), "is not text in UTF-8; save the file as UTF-8")
            };
            Err(LoadError::Invalid { file: path.to_owned(), problems: vec![problem] })
        }
    }
}

/// Read a scene or a light preset from the text of a file; `file` is only named in errors. The text stands alone: there
/// are no files beside it.
pub fn parse(text: &str, file: impl AsRef<std::path::Path>) -> Result<Scene, LoadError> {
    parse_with(text, file, |_| Err(io::Error::other("there are no files beside this text")))
}

/// [`parse`] for a text that names files: `read` gives the bytes of the file of a name.
pub fn parse_with(
    text: &str,
    file: impl AsRef<std::path::Path>,
    mut read: impl FnMut(&str) -> io::Result<Vec<u8>>,
) -> Result<Scene, LoadError> {
    let check = |scene: &mut Scene| {
        let patterns = pattern::read_all(scene, &mut read);
        let photometries = photometry::read_all(scene, &mut read);
        let meshes = mesh::read_all(&mut scene.surfaces, &mut read);
        [validate(scene), patterns, photometries, meshes].concat()
    };
    parse_text(text, check).map_err(|problems| LoadError::Invalid { file: file.as_ref().to_owned(), problems })
}

/// Read the text of a scene without the files that it names.
pub(super) fn parse_unread(text: &str) -> Result<Scene, Vec<Problem>> {
    parse_text(text, |scene| validate(scene))
}

/// The bytes of a regular file that is not too large.
pub(super) fn read(path: &std::path::Path) -> io::Result<Vec<u8>> {
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(io::Error::other("it is a directory; name a scene file in it"));
    }
    if metadata.len() > MAX_FILE_BYTES {
        return Err(too_large());
    }
    // What has no honest size, such as a pipe, is cut off one byte past the limit, where it cannot be a scene.
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES { Err(too_large()) } else { Ok(bytes) }
}

fn too_large() -> io::Error {
    io::Error::other(format!("it is larger than {} MiB; no scene file is", MAX_FILE_BYTES >> 20))
}

/// Syntax, then structure, then contradictions, then values: what fails at one stage is not looked at by the next.
fn parse_text(text: &str, check: impl FnOnce(&mut Scene) -> Vec<Problem>) -> Result<Scene, Vec<Problem>> {
    let document = DeTable::parse(text).map_err(|error| vec![syntax_problem(text, &error)])?;
    if let Some(problem) = other_format(&document) {
        return Err(locate(vec![problem], &document, text));
    }
    let problems = structure::check(&document, &schema());
    if !problems.is_empty() {
        return Err(place(problems, text));
    }
    let file = File::deserialize(Deserializer::from(document.clone())).map_err(|error| {
        // The schema has accepted it, so that this is not met; but an error is told, not hidden.
        place(vec![(start(&error), Problem::new(Path::default(), error.message()))], text)
    })?;
    let mut scene = file.into_scene().map_err(|problems| locate(problems, &document, text))?;
    let problems = check(&mut scene);
    if problems.is_empty() { Ok(scene) } else { Err(locate(problems, &document, text)) }
}

/// What the TOML parser says.
fn syntax_problem(text: &str, error: &toml::de::Error) -> Problem {
    let place = Some(Place::of_offset(text, start(error)));
    Problem { place, ..Problem::new(Path::default(), format!("is not TOML: {}", error.message())) }
}

/// The problem of a file in another format. Whatever else such a file says is then not to be judged.
fn other_format(document: &Spanned<DeTable<'_>>) -> Option<Problem> {
    let format = document.get_ref().get("format")?.get_ref().as_integer()?;
    let is_ours = u32::from_str_radix(format.as_str(), format.radix()) == Ok(FORMAT);
    let message = format!("is {format}, which this Softbox cannot read; it reads {FORMAT}");
    (!is_ours).then(|| Problem::new(Path::default().key("format"), message))
}

/// Where in the text an error of the TOML parser is.
fn start(error: &toml::de::Error) -> usize {
    error.span().map_or(0, |span| span.start)
}

/// Find each problem's path in the document.
fn locate(problems: Vec<Problem>, document: &Spanned<DeTable<'_>>, text: &str) -> Vec<Problem> {
    place(problems.into_iter().map(|problem| (offset_of(&problem.path, document), problem)).collect(), text)
}

/// Turn offsets into places, in the order of the text.
fn place(mut problems: Vec<(usize, Problem)>, text: &str) -> Vec<Problem> {
    problems.sort_by_key(|(offset, _)| *offset);
    let rest = problems.len().saturating_sub(MAX_PROBLEMS);
    problems.truncate(MAX_PROBLEMS);
    let mut placed: Vec<_> = problems
        .into_iter()
        .map(|(offset, problem)| Problem { place: Some(Place::of_offset(text, offset)), ..problem })
        .collect();
    if rest > 0 {
        placed.push(Problem::new(Path::default(), format!("and {rest} problems more")));
    }
    placed
}

/// Where the value at `path` starts; where it is left out, where the innermost table or array around it starts.
fn offset_of(path: &Path, document: &Spanned<DeTable<'_>>) -> usize {
    let Some((Segment::Key(first), rest)) = path.segments().split_first() else { return document.span().start };
    let Some(mut value) = document.get_ref().get(first.as_str()) else { return document.span().start };
    for segment in rest {
        let inner = match (segment, value.get_ref()) {
            (Segment::Key(key), DeValue::Table(table)) => table.get(key.as_str()),
            (Segment::Index(index), DeValue::Array(array)) => array.get(*index),
            _ => None,
        };
        match inner {
            Some(inner) => value = inner,
            None => break,
        }
    }
    value.span().start
}
