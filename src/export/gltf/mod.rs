//! glTF 2.0: lights by `KHR_lights_punctual`, surfaces as meshes.
//!
//! Every light but a point and a parallel one is the punctual lights of its fit. Rectangles and disks are also there as
//! lights of the draft `EXT_lights_area`, in a scene of their own, so that nothing is lit twice: the first scene, which
//! viewers show, has the fits only.
//!
//! **Source:** Khronos Group, *glTF 2.0 Specification*; `KHR_lights_punctual`, `KHR_materials_specular` (both ratified);
//! `EXT_lights_area` as drafted by M. Bond, 2025.

mod lights;
mod surfaces;

use glam::{DMat3, DQuat, DVec3};
use serde_json::{Map, Value, json};

use super::origin::PROGRAM;
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, File, Job, Remark};
use crate::render::Progress;
use crate::scene::{Camera, Scene};

/// The nearest that the camera sees, metres: glTF must have one.
const NEAR: f64 = 0.01;

/// The document, and the file of its buffer where there are meshes.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let (scene, mut remarks) = job.chosen_scene()?;
    let mut document = Document::default();
    let shared = [camera(&scene.camera, &mut document)];
    let lit = lights::add(&scene, job.options.punctual, progress, &mut document)?;
    let geometry = surfaces::add(&scene, &mut document);
    remarks.extend(scene_remarks(&scene));
    remarks.extend(lit.remarks);
    remarks.extend(geometry.remarks);
    let with =
        |lights: Vec<usize>| -> Vec<usize> { shared.iter().chain(&geometry.nodes).copied().chain(lights).collect() };
    let mut scenes = vec![json!({ "name": "punctual lights", "nodes": with(lit.punctual) })];
    if let Some(area) = lit.area {
        scenes.push(json!({ "name": "area lights (EXT_lights_area)", "nodes": with(area) }));
    }
    let mut files = Vec::new();
    if !document.buffer.is_empty() {
        let file = File { name: format!("{}-geometry.bin", job.stem), bytes: std::mem::take(&mut document.buffer) };
        document.put("buffers", json!({ "uri": uri(&file.name), "byteLength": file.bytes.len() }));
        files.push(file);
    }
    let text = document.text(job, &scene, scenes, &remarks)?;
    files.insert(0, job.main_file(text));
    Ok(Exported { files, remarks })
}

/// A glTF document as it grows.
#[derive(Debug, Default)]
struct Document {
    /// The arrays of the document, by name.
    arrays: Map<String, Value>,
    /// Extensions that are used, with what they have at the root.
    extensions: Map<String, Value>,
    /// What the accessors are of.
    buffer: Vec<u8>,
}

impl Document {
    /// Adds a thing to an array; its index.
    fn put(&mut self, array: &str, thing: Value) -> usize {
        let array = self.arrays.entry(array).or_insert_with(|| json!([]));
        let index = array.as_array().map_or(0, Vec::len);
        if let Some(array) = array.as_array_mut() {
            array.push(thing);
        }
        index
    }

    /// Adds a light to those of an extension; its index.
    fn put_light(&mut self, extension: &str, light: Value) -> usize {
        let root = self.extensions.entry(extension).or_insert_with(|| json!({ "lights": [] }));
        let lights = root["lights"].as_array_mut();
        lights.map_or(0, |lights| {
            lights.push(light);
            lights.len() - 1
        })
    }

    /// The whole of it, with its scenes.
    fn text(self, job: &Job, scene: &Scene, scenes: Vec<Value>, remarks: &[Remark]) -> Result<String, ExportError> {
        let remarks: Vec<_> = remarks
            .iter()
            .map(|Remark { thing, fate, what }| json!({ "thing": thing, "fate": fate.name(), "what": what }))
            .collect();
        let mut root = self.arrays;
        root.insert(
            "asset".to_owned(),
            json!({
                "version": "2.0",
                "generator": PROGRAM,
                "extras": {
                    "scene": job.scene_name,
                    "exposure_ev": scene.display.exposure_ev,
                    "remarks": remarks,
                },
            }),
        );
        root.insert("scene".to_owned(), json!(0));
        root.insert("scenes".to_owned(), json!(scenes));
        let names: Vec<_> = self.extensions.keys().cloned().collect();
        if !names.is_empty() {
            root.insert("extensionsUsed".to_owned(), json!(names));
        }
        let at_root: Map<_, _> = self.extensions.into_iter().filter(|(_, value)| !value.is_null()).collect();
        if !at_root.is_empty() {
            root.insert("extensions".to_owned(), Value::Object(at_root));
        }
        let wrong = |cause| ExportError::Encode { what: "the document".to_owned(), cause: Box::new(cause) };
        Ok(serde_json::to_string_pretty(&root).map_err(wrong)? + "\n")
    }
}

/// What holds for the scene as a whole.
fn scene_remarks(scene: &Scene) -> Vec<Remark> {
    let mut remarks = vec![Remark::scene(Fate::Changed, "stands Y up, by the rotation of its nodes")];
    remarks.extend(without_variants(scene));
    if scene.display.exposure_ev != 0.0 {
        remarks.push(Remark::scene(
            Fate::Changed,
            format!(
                "its exposure of {} EV stands in asset.extras only; set it in the viewer",
                scene.display.exposure_ev
            ),
        ));
    }
    if !scene.plots.is_empty() {
        remarks.push(Remark::scene(Fate::Changed, "its plots are left out; csv and svg hold them"));
    }
    remarks
}

/// The camera's node.
fn camera(camera: &Camera, document: &mut Document) -> usize {
    let perspective = json!({ "yfov": camera.fov_deg.to_radians(), "znear": NEAR });
    let index = document.put("cameras", json!({ "type": "perspective", "perspective": perspective }));
    let [right, up, back] = camera.axes();
    let mut node = placed(camera.eye, DQuat::from_mat3(&DMat3::from_cols(right, up, back)));
    node["name"] = json!("camera");
    node["camera"] = json!(index);
    document.put("nodes", node)
}

/// From our Z up to glTF's Y up: −90° about X.
fn y_up() -> DQuat {
    DQuat::from_rotation_x(-std::f64::consts::FRAC_PI_2)
}

/// A root node at a place and turn of our world.
fn placed(position: DVec3, turn: DQuat) -> Value {
    node(y_up() * position, y_up() * turn)
}

/// A node at a place and turn within its parent.
fn node(position: DVec3, turn: DQuat) -> Value {
    let mut node = Map::new();
    if position != DVec3::ZERO {
        node.insert("translation".to_owned(), json!(tidy(position.to_array())));
    }
    if turn != DQuat::IDENTITY {
        node.insert("rotation".to_owned(), json!(tidy(turn.normalize().to_array())));
    }
    Value::Object(node)
}

/// Zeros without a sign.
fn tidy<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    numbers.map(|number| number + 0.0)
}

/// A colour of at most 1 and the factor that makes it the other.
fn color_and_strength(rgb: DVec3) -> ([f64; 3], f64) {
    let strength = rgb.max_element();
    let color = if strength > 0.0 { rgb / strength } else { DVec3::ONE };
    (tidy(color.to_array()), strength)
}

/// A file's name as a URI beside the document.
fn uri(name: &str) -> String {
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'_' | b'.' | b'~');
    name.bytes().map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") }).collect()
}

#[cfg(test)]
mod tests;
