//! A scene as JSON, for scripts: the tables and keys of a scene file, in their order.
//!
//! What a scene file says under `light[2].shape` stands here under `scene.light[2].shape`. The scene's own JSON Schema,
//! of `softbox schema`, describes what is under `scene`.

use std::fmt::Write as _;

use toml_edit::{DocumentMut, Item, Value};

use super::job::Identifiers;
use super::origin::PROGRAM;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::light::{Point, Shape, pattern::Pattern, photometry::Photometry};
use crate::render::Progress;
use crate::scene::{Scene, pattern_file, to_toml};
use crate::surface;

/// The scene with the chosen lights; the pictures and meshes that it names are files beside it.
pub(super) fn write(job: &Job, _progress: &Progress) -> Result<Exported, ExportError> {
    let (mut scene, mut remarks) = job.chosen_scene()?;
    let mut beside = Beside { job, names: Identifiers::default(), files: Vec::new() };
    if job.lights.is_some() && !scene.variants.is_empty() {
        remarks.push(Remark::scene(Fate::Changed, "its variants are left out, as lights were chosen"));
        (scene.variants, scene.active_variant) = (Vec::new(), None);
    }
    beside.take(&mut scene)?;
    remarks.extend(scene.lights.iter().map(|light| Remark::light(light, Fate::Kept, "as it is")));
    remarks.extend(scene.surfaces.iter().map(|surface| Remark::surface(surface, Fate::Kept, "as it is")));
    let text = document(job, &scene, &remarks)?;
    let files = [job.main_file(text)].into_iter().chain(beside.files).collect();
    Ok(Exported { files, remarks })
}

/// Files beside the main one.
struct Beside<'a> {
    job: &'a Job<'a>,
    names: Identifiers,
    files: Vec<File>,
}

impl Beside<'_> {
    /// Puts the files that a scene names beside it, under new names.
    fn take(&mut self, scene: &mut Scene) -> Result<(), ExportError> {
        let mut known: Vec<(Pattern, String)> = Vec::new();
        for light in scene.all_lights_mut() {
            let Shape::Textured(textured) = &mut light.shape else { continue };
            let pattern = &mut textured.pattern;
            let same = known.iter().find(|(old, _)| old == pattern);
            let name = match same {
                Some((_, name)) => name.clone(),
                None => {
                    let (contents, extension) = pattern_file(pattern).map_err(|cause| ExportError::Encode {
                        what: format!("the pattern {}", pattern.file),
                        cause: Box::new(cause),
                    })?;
                    let name = self.put(&pattern.file, &extension, contents.0.to_vec());
                    known.push((pattern.clone(), name.clone()));
                    name
                }
            };
            pattern.file = name;
        }
        self.take_photometries(scene);
        let mut known: Vec<(String, String)> = Vec::new();
        for surface in &mut scene.surfaces {
            let surface::Shape::Mesh(mesh) = &mut surface.shape else { continue };
            let same = known.iter().find(|(old, _)| *old == mesh.file);
            let name = same.map(|(_, name)| name.clone());
            let name = name.unwrap_or_else(|| {
                let name = self.put(&mesh.file, "obj", mesh.contents.0.to_vec());
                known.push((mesh.file.clone(), name.clone()));
                name
            });
            mesh.file = name;
        }
        Ok(())
    }

    fn take_photometries(&mut self, scene: &mut Scene) {
        let mut known: Vec<(Photometry, String)> = Vec::new();
        for light in scene.all_lights_mut() {
            let Shape::Point(Point { ies: Some(photometry) }) = &mut light.shape else { continue };
            let same = known.iter().find(|(old, _)| old == photometry).map(|(_, name)| name.clone());
            let name = same.unwrap_or_else(|| {
                let name = self.put(&photometry.file, "ies", photometry.contents.0.to_vec());
                known.push((photometry.clone(), name.clone()));
                name
            });
            photometry.file = name;
        }
    }

    /// A new file like `old`; its name.
    fn put(&mut self, old: &str, extension: &str, bytes: Vec<u8>) -> String {
        let stem = std::path::Path::new(old).file_stem().unwrap_or_default().to_string_lossy();
        let file = self.job.file_beside(&self.names.of(&stem), extension, bytes);
        let name = file.name.clone();
        self.files.push(file);
        name
    }
}

/// The text of the main file.
fn document(job: &Job, scene: &Scene, remarks: &[Remark]) -> Result<String, ExportError> {
    let wrong =
        |cause: toml_edit::TomlError| ExportError::Encode { what: "the scene".to_owned(), cause: Box::new(cause) };
    let toml: DocumentMut = to_toml(scene).parse().map_err(wrong)?;
    let remarks: Vec<String> = remarks
        .iter()
        .map(|Remark { thing, fate, what }| {
            format!("\n    {{\"thing\": {}, \"fate\": \"{fate}\", \"what\": {}}}", quoted(thing), quoted(what))
        })
        .collect();
    let mut text = String::new();
    let _ = writeln!(text, "{{\n  \"generator\": \"{PROGRAM}\",");
    let _ = writeln!(text, "  \"file\": {},", quoted(job.scene_name));
    let _ = writeln!(text, "  \"remarks\": [{}\n  ],", remarks.join(","));
    let _ = writeln!(text, "  \"scene\": {}\n}}", item(toml.as_item(), 1));
    Ok(text)
}

/// An item of a document as JSON, each key of a table on a line of its own.
fn item(of: &Item, depth: usize) -> String {
    let indent = "  ".repeat(depth + 1);
    let end = "  ".repeat(depth);
    let lines = |lines: Vec<String>, [open, close]: [char; 2]| match lines.as_slice() {
        [] => format!("{open}{close}"),
        _ => format!("{open}\n{}\n{end}{close}", lines.join(",\n")),
    };
    match of {
        Item::None => "null".to_owned(),
        Item::Value(of) => value(of),
        Item::Table(table) => {
            let entry = |(key, of): (&str, &Item)| format!("{indent}{}: {}", quoted(key), item(of, depth + 1));
            lines(table.iter().map(entry).collect(), ['{', '}'])
        }
        Item::ArrayOfTables(tables) => {
            let entry = |table: &toml_edit::Table| format!("{indent}{}", item(&Item::Table(table.clone()), depth + 1));
            lines(tables.iter().map(entry).collect(), ['[', ']'])
        }
    }
}

/// A value of a document as JSON, on one line.
fn value(of: &Value) -> String {
    match of {
        Value::String(text) => quoted(text.value()),
        Value::Integer(number) => number.value().to_string(),
        Value::Float(number) => format!("{:?}", number.value()),
        Value::Boolean(truth) => truth.value().to_string(),
        Value::Datetime(time) => quoted(&time.value().to_string()),
        Value::Array(values) => format!("[{}]", values.iter().map(value).collect::<Vec<_>>().join(", ")),
        Value::InlineTable(table) => {
            let entry = |(key, of): (&str, &Value)| format!("{}: {}", quoted(key), value(of));
            format!("{{{}}}", table.iter().map(entry).collect::<Vec<_>>().join(", "))
        }
    }
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}
