//! Lights as functions in a shading language: the preview's own shaders, of which each file has what its lights need, with
//! the lights' numbers as constants.
//!
//! A light's numbers stand in constants. Its function puts them where the shader reads them, in variables private to an
//! invocation, and calls the shader. Tables too large for constants are textures.

mod constants;
mod items;
mod lobe;
mod part;
mod table;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use self::items::{Item, needed, renamed};
use self::part::Part;
pub(super) use self::table::{GROUP, TableFile};
use super::job::{Chosen, Identifiers};
use super::preflight::without_variants;
use super::{ExportError, Fate, Job, Remark};
use crate::gpu::shader::Module;
use crate::render::{Progress, lobe_of};
use crate::surface::ReflectionModel;

/// Functions of lights, and what is beside them.
pub(super) struct Shader {
    /// In WGSL, without a header.
    pub(super) text: String,
    /// The functions to call, with what is said of each.
    pub(super) functions: Vec<(String, String)>,
    /// Textures that the text reads.
    pub(super) tables: Vec<TableFile>,
    /// What becomes of each thing.
    pub(super) remarks: Vec<Remark>,
}

/// The function of all lights together, and what it gives.
const SUM: &str = "softbox_lights";
const SUM_TYPE: &str = "SoftboxLights";

/// How the functions are used, in lines of ASCII.
pub(super) const USAGE: &str = "\
Each light has a function of its own. It takes a point p (m, in the scene's world: right-handed, Z up), its unit normal n,
the unit direction v to the eye, and the exponent m >= 1 of Phong's lobe, and gives two numbers:
- x, the irradiance E in lx: the integral of L(w) (w.n) dw over the light's directions w with w.n > 0;
- y, the specular part S in cd/m2: the integral of L(w) (m+1)/(2 pi) max(0, w.r)^m dw over the same, r = 2(n.v)n - v.
Both are those of the light's luminance; its tint, linear Rec. 709 of luminance 1, is a constant beside the function.
softbox_lights gives the sums of all lights with their tints. A surface of diffuse reflectance k_d and specular k_s sends
to the eye, in cd/m2: k_d / pi * irradiance + k_s * specular. Nothing here casts shadows.
";

impl Shader {
    /// The functions of a job's lights.
    pub(super) fn new(job: &Job, progress: &Progress) -> Result<Self, ExportError> {
        let Chosen { lights, mut remarks } = job.chosen_lights()?;
        if lights.is_empty() {
            return Err(ExportError::Nothing("has no light to make a function of".to_owned()));
        }
        let library = library();
        let mut identifiers = Identifiers::default();
        // The names of lights' constants end as no others do.
        let taken = library.iter().map(|item| prefixed(&item.name)).filter(|name| name.starts_with("softbox_"));
        for name in taken.chain([SUM.to_owned()]) {
            identifiers.of(&name);
        }
        let mut parts = Vec::new();
        for light in &lights {
            if progress.is_cancelled() {
                return Err(ExportError::Cancelled);
            }
            match Part::all_of(light, job, &library, &mut identifiers) {
                Ok(of_light) => parts.extend(of_light),
                Err(what) => remarks.push(Remark::light(light, Fate::Lost, what)),
            }
        }
        remarks.extend(remarks_on(job, &lights, &parts));
        let tables = TableFile::all_of(job, &parts)?;
        Ok(Self { text: text(job, library, &parts, &tables), functions: functions(&parts), tables, remarks })
    }
}

/// All declarations of the shaders of lights, each once, and those that only stand in exported files.
fn library() -> Vec<Item> {
    let own = items::items(include_str!("shading.wgsl"));
    let mut known: BTreeSet<String> = own.iter().map(|item| item.name.clone()).collect();
    let mut library = own;
    for item in Module::LIGHTS.iter().flat_map(|module| items::items(module.text())) {
        if known.insert(item.name.clone()) {
            library.push(item);
        }
    }
    library
}

/// The whole text, in the order in which people read.
fn text(job: &Job, mut library: Vec<Item>, parts: &[Part], tables: &[TableFile]) -> String {
    let made = [part::accessors(parts), lobe::fits(job.scene, parts)].concat();
    library.retain(|item| !made.iter().any(|made| made.name == item.name));
    library.extend(made);
    let roots: Vec<&str> = parts.iter().flat_map(Part::roots).chain(["plus_tinted"]).collect();
    let kept = needed(&library, &roots);
    let fields: BTreeSet<&str> = kept.iter().flat_map(|item| item.fields_of("lobes")).collect();
    let mut text: String = tables.iter().map(TableFile::declaration).collect();
    text.push_str(&part::texts(parts));
    text.push_str(&sum(parts));
    text.push_str("\n// The rest is what these functions are made of.\n");
    for item in &kept {
        let declaration = if item.name == "Lobe" { item.with_fields(&fields) } else { private(&item.text) };
        let _ = write!(text, "\n{declaration}");
    }
    let names: BTreeSet<&str> = library.iter().map(|item| item.name.as_str()).collect();
    renamed(&text, |word| names.contains(word).then(|| prefixed(word)))
}

/// A declaration whose uniform, if it is one, is a variable that functions set.
fn private(text: &str) -> String {
    match text.split_once("@group(1) @binding(0) var<uniform>") {
        Some((comment, rest)) => format!("{comment}var<private>{rest}"),
        None => text.to_owned(),
    }
}

/// A name that other shaders are not likely to have.
fn prefixed(name: &str) -> String {
    match name.chars().find(|c| c.is_ascii_alphabetic()) {
        Some(first) if first.is_ascii_lowercase() => format!("softbox_{name}"),
        _ if name.len() > 1 && !name.contains(|c: char| c.is_ascii_lowercase()) => format!("SOFTBOX_{name}"),
        _ => format!("Softbox{name}"),
    }
}

/// The function of all lights together.
fn sum(parts: &[Part]) -> String {
    let mut text = format!(
        "// All of them, with their tints: irradiance in lx, specular part in cd/m².\n\
         struct {SUM_TYPE} {{\n    irradiance: vec3f,\n    specular: vec3f,\n}}\n\n\
         fn {SUM}(p: vec3f, n: vec3f, v: vec3f, exponent: f32) -> {SUM_TYPE} {{\n    \
         var sum = {SUM_TYPE}(vec3f(0.0), vec3f(0.0));\n"
    );
    for Part { function, tint, .. } in parts {
        let _ = writeln!(text, "    sum = plus_tinted(sum, {function}(p, n, v, exponent), {});", tint.name);
    }
    text.push_str("    return sum;\n}\n");
    text
}

fn functions(parts: &[Part]) -> Vec<(String, String)> {
    let sum = (SUM.to_owned(), "All of them, with their tints.".to_owned());
    parts.iter().map(|part| (part.function.clone(), part.title.clone())).chain([sum]).collect()
}

/// What becomes of what is not in the functions, and of the lights that are.
fn remarks_on(job: &Job, lights: &[crate::light::Light], parts: &[Part]) -> Vec<Remark> {
    let mut remarks: Vec<Remark> = parts.iter().map(|part| part.remark.clone()).collect();
    // A light of three parts has one remark.
    remarks.dedup();
    let linked = lights.iter().filter(|light| light.only.is_some());
    remarks.extend(linked.map(|light| {
        let what =
            format!("is linked to surfaces; {SUM} has it at every point: call the lights' own functions instead");
        Remark::light(light, Fate::Changed, what)
    }));
    if job.surfaces {
        let what = "is not in the file: who calls the functions has the point and its normal, and casts shadows";
        remarks.extend(job.scene.surfaces.iter().map(|surface| Remark::surface(surface, Fate::Changed, what)));
        let other = job.scene.materials.iter().filter(|material| !matches!(material.model, ReflectionModel::Phong {}));
        remarks.extend(other.map(|material| Remark {
            thing: format!("material \"{}\"", super::job::one_line(&material.name)),
            fate: Fate::Changed,
            what: format!(
                "its lobe is {}, and the functions have Phong's: {} is as wide",
                material.model.name(),
                super::job::number(lobe_of(material).cosine_exponent())
            ),
        }));
    }
    remarks.extend(without_variants(job.scene));
    remarks
}
