//! From a scene file to a scene.

use std::fs;
use std::io::{self, Read};

use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue, Deserializer};

use super::file::File;
use super::problem::{LoadError, Path, Place, Problem, Segment};
use super::{Scene, structure, validate};

/// Scene files larger than this are refused before they are read, bytes.
pub const MAX_FILE_BYTES: u64 = 16 << 20;

/// Load a scene or a light preset.
pub fn load(path: impl AsRef<std::path::Path>) -> Result<Scene, LoadError> {
    let path = path.as_ref();
    let bytes = read(path).map_err(|source| LoadError::Read { file: path.to_owned(), source })?;
    match std::str::from_utf8(&bytes) {
        Ok(text) => parse(text, path),
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

/// Read a scene or a light preset from the text of a file; `file` is only named in errors.
pub fn parse(text: &str, file: impl AsRef<std::path::Path>) -> Result<Scene, LoadError> {
    parse_text(text).map_err(|problems| LoadError::Invalid { file: file.as_ref().to_owned(), problems })
}

/// The bytes of a regular file that is not too large.
fn read(path: &std::path::Path) -> io::Result<Vec<u8>> {
    let metadata = fs::metadata(path)?;
    if metadata.is_dir() {
        return Err(io::Error::other("it is a directory; name a scene file in it"));
    }
    if metadata.len() > MAX_FILE_BYTES {
        return Err(too_large(metadata.len()));
    }
    // What has no honest size, such as a pipe, is cut off one byte past the limit, where it cannot be a scene.
    let mut bytes = Vec::new();
    fs::File::open(path)?.take(MAX_FILE_BYTES + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MAX_FILE_BYTES { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

fn too_large(bytes: u64) -> io::Error {
    let [size, limit] = [bytes, MAX_FILE_BYTES].map(|bytes| bytes.div_ceil(1 << 20));
    io::Error::other(format!("it has {size} MiB or more; a scene file has at most {limit} MiB"))
}

/// Syntax, then structure, then contradictions, then values: what fails at one stage is not looked at by the next.
fn parse_text(text: &str) -> Result<Scene, Vec<Problem>> {
    let document = DeTable::parse(text).map_err(|error| vec![syntax_problem(text, &error)])?;
    let place = |problems| place_all(problems, &document, text);
    let problems = structure::check(&document);
    if !problems.is_empty() {
        return Err(place(problems));
    }
    let file = File::deserialize(Deserializer::from(document.clone())).map_err(|error| {
        // The schema has accepted it, so that this is not met; but an error is told, not hidden.
        vec![Problem {
            place: error.span().map(|span| Place::of_offset(text, span.start)),
            ..Problem::new(Path::default(), error.message())
        }]
    })?;
    let scene = file.into_scene().map_err(&place)?;
    let problems = validate(&scene);
    if problems.is_empty() { Ok(scene) } else { Err(place(problems)) }
}

/// What the TOML parser says.
fn syntax_problem(text: &str, error: &toml::de::Error) -> Problem {
    let place = Place::of_offset(text, error.span().map_or(0, |span| span.start));
    let message = format!("is not TOML: {}", error.message());
    Problem { place: Some(place), ..Problem::new(Path::default(), message) }
}

/// Give each problem the place of its path in the text, and sort by place.
fn place_all(mut problems: Vec<Problem>, document: &Spanned<DeTable<'_>>, text: &str) -> Vec<Problem> {
    for problem in &mut problems {
        problem.place = Some(Place::of_offset(text, offset_of(&problem.path, document)));
    }
    problems.sort_by_key(|problem| problem.place.map(|place| (place.line, place.column)));
    problems
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
