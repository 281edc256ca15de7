//! A light, or one colour of a light whose pattern has three, as constants and a function.

use std::fmt::Write as _;

use glam::DVec3;

use super::constants::{MOST_ELEMENTS, number, structure, vector};
use super::items::{Item, needed};
use super::lobe;
use super::table::Table;
use crate::export::job::{Identifiers, one_line};
use crate::export::{Fate, Job, Remark};
use crate::gpu::lights::{LightData, Responder};
use crate::gpu::types::f32_of;
use crate::light::{Emitter, Light};
use crate::render::MethodChoice;
use crate::shading::Method;

/// A light, or one colour of it.
pub(super) struct Part {
    /// The function's name.
    pub(super) function: String,
    /// The light's tint.
    pub(super) tint: Constant,
    /// What it is, for people.
    pub(super) title: String,
    /// What becomes of the light.
    pub(super) remark: Remark,
    /// How it is shaded.
    pub(super) method: Method,
    /// What its shader looks up.
    pub(super) table: Option<Table>,
    responder: Responder,
    strength: String,
    /// The variable that the shader reads.
    uniform: String,
    /// What is put there.
    constant: Constant,
    vertices: Option<Constant>,
}

/// A constant of the file.
pub(super) struct Constant {
    pub(super) name: String,
    pub(super) value: String,
}

/// Names of a pattern's colours.
const COLORS: [&str; 3] = ["red", "green", "blue"];

/// What is wrong with a light whose numbers f32 cannot hold.
const NOT_FINITE: &str = "has numbers that are too large for 32 bits; move or scale it";

impl Part {
    /// All parts of a light; a line on why there are none.
    pub(super) fn all_of(
        light: &Light,
        job: &Job,
        library: &[Item],
        identifiers: &mut Identifiers,
    ) -> Result<Vec<Self>, String> {
        let parts = light.parts();
        let is_colored = parts.len() > 1;
        let parts = parts.iter().zip(COLORS);
        parts
            .map(|((emitter, weight), color)| {
                let color = Some(color).filter(|_| is_colored);
                Self::new(job, (light, color), (emitter, *weight), library, identifiers)
            })
            .collect()
    }

    fn new(
        job: &Job,
        (light, color): (&Light, Option<&str>),
        (emitter, weight): (&Emitter, DVec3),
        library: &[Item],
        identifiers: &mut Identifiers,
    ) -> Result<Self, String> {
        let method = job.options.method.for_shape(&light.shape);
        let data = LightData::new(emitter, method, DVec3::ZERO);
        let responder = data.responder.for_any_exponent();
        let items = needed(library, &[responder.function]);
        let reads = |name: &str| items.iter().any(|item| item.name == name);
        let function = identifiers.of(&identifier(&light.name, color));
        let mut name = |what: &str| identifiers.of(&format!("{function}_{what}"));
        let [tint_name, constant_name, vertices_name] =
            ["tint", "light", "vertices"].map(|what| name(what).to_uppercase());
        let strength = light.strength();
        let tint = if strength > 0.0 { weight / strength } else { DVec3::ZERO };
        let (uniform, value) = uniform(&items, &data.uniform_at(data.stages() - 1)).ok_or(NOT_FINITE)?;
        Ok(Self {
            tint: Constant { name: tint_name, value: vector(&tint.as_vec3().to_array()).ok_or(NOT_FINITE)? },
            title: title(light, color, method),
            remark: remark(job, light, method),
            table: reads("table_number").then(|| Table::new(name("table"), data.table.numbers())),
            strength: number(f32_of(strength)).ok_or(NOT_FINITE)?,
            constant: Constant { name: constant_name, value },
            vertices: if reads("light_vertex") { Some(array(vertices_name, &data.vertices)?) } else { None },
            function,
            method,
            responder,
            uniform,
        })
    }

    /// Whether one of several lights' arrays is read for it.
    fn has_source(&self) -> bool {
        self.vertices.is_some() || self.table.is_some()
    }

    /// What the function needs.
    pub(super) fn roots(&self) -> [&str; 2] {
        [self.responder.function, self.shading()]
    }

    /// What makes the point that the shader shades.
    fn shading(&self) -> &'static str {
        if matches!(self.method, Method::Chebyshev { .. }) && self.responder.reads_fits() {
            "fitted_shading_of"
        } else {
            "shading_of"
        }
    }

    /// Constants and function.
    fn text(&self, source: Option<usize>) -> String {
        let Self { function, title, tint, constant, uniform, responder, strength, .. } = self;
        let mut text = format!("// {title}\n");
        let table = self.table.as_ref().and_then(Table::constant);
        for Constant { name, value } in [tint, constant].into_iter().chain(&self.vertices).chain(&table) {
            let _ = writeln!(text, "const {name} = {value};");
        }
        let _ = writeln!(text, "\nfn {function}(p: vec3f, n: vec3f, v: vec3f, exponent: f32) -> vec2f {{");
        if let Some(source) = source {
            let _ = writeln!(text, "    source = {source}u;");
        }
        let _ = write!(
            text,
            "    {uniform} = {};\n    let response = {}({}(p, n, v, exponent));\n    \
             return {strength} * vec2f(response.irradiance, response.specular);\n}}\n\n",
            constant.name,
            responder.function,
            self.shading(),
        );
        text
    }
}

/// Constants and functions of all parts.
pub(super) fn texts(parts: &[Part]) -> String {
    parts.iter().enumerate().map(|(i, part)| part.text(source(parts, i))).collect()
}

/// What tells a part's arrays from those of others; none where there are no others.
fn source(parts: &[Part], index: usize) -> Option<usize> {
    let is_one_of_many = parts.iter().filter(|part| part.has_source()).count() > 1;
    (is_one_of_many && parts[index].has_source()).then_some(index)
}

/// What the shaders read arrays and tables with.
pub(super) fn accessors(parts: &[Part]) -> Vec<Item> {
    let accessor = |name: &str, signature: &str, value: &dyn Fn(&Part) -> Option<String>| {
        let mut text = format!("fn {name}{signature} {{\n");
        let mut values: Vec<_> =
            (0..).zip(parts).filter_map(|(i, part)| Some((source(parts, i), value(part)?))).collect();
        let last = values.pop()?.1;
        for (source, value) in &values {
            let source = source.unwrap_or_default();
            let _ = writeln!(text, "    if source == {source}u {{\n        return {value};\n    }}");
        }
        let _ = writeln!(text, "    return {last};\n}}");
        Some(Item { name: name.to_owned(), text })
    };
    let vertex = |part: &Part| Some(format!("{}[i]", part.vertices.as_ref()?.name));
    [
        accessor("light_vertex", "(i: u32) -> vec4f", &vertex),
        accessor("table_number", "(i: u32) -> f32", &|part| Some(part.table.as_ref()?.number())),
        accessor("table_length", "() -> u32", &|part| Some(part.table.as_ref()?.length())),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The uniform among the declarations, and its value.
fn uniform(items: &[Item], bytes: &[u8]) -> Option<(String, String)> {
    let (item, ty) = items.iter().find_map(|item| {
        let (_, declaration) = item.text.split_once("var<uniform> ")?;
        Some((item, declaration.split_once(": ")?.1.trim_end().trim_end_matches(';')))
    })?;
    let declaration = items.iter().find(|item| item.name == ty)?;
    Some((item.name.clone(), structure(declaration, bytes)?))
}

fn array(name: String, vertices: &[[f32; 4]]) -> Result<Constant, String> {
    let count = vertices.len();
    if count > MOST_ELEMENTS {
        return Err(format!("has {count} points, and an array of WGSL's has at most {MOST_ELEMENTS}; take fewer"));
    }
    let vectors: Option<Vec<_>> = vertices.iter().map(|vertex| vector(vertex)).collect();
    let vectors = vectors.ok_or(NOT_FINITE)?.join(",\n    ");
    Ok(Constant { name, value: format!("array<vec4f, {count}>(\n    {vectors},\n)") })
}

/// What a function of a light is called.
fn identifier(light: &str, color: Option<&str>) -> String {
    let words = light.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| !word.is_empty());
    let words: Vec<_> = std::iter::once("softbox").chain(words).chain(color).collect();
    words.join("_").to_lowercase()
}

fn title(light: &Light, color: Option<&str>, method: Method) -> String {
    let (name, shape) = (one_line(&light.name), light.shape.name());
    let color = color.map(|color| format!(", {color}")).unwrap_or_default();
    let kind = light.shape.strength_kind();
    format!("Light \"{name}\"{color}: {shape}, {} {}, by method {method}.", light.strength(), kind.unit())
}

/// What becomes of a light.
fn remark(job: &Job, light: &Light, method: Method) -> Remark {
    let shape = light.shape.name();
    match (job.options.method, method) {
        (_, Method::Reference) => {
            let what = "is written by exact, as reference is a search that shaders do not do";
            Remark::light(light, Fate::Changed, what)
        }
        (MethodChoice::Method(asked), method) if asked != method => {
            Remark::light(light, Fate::Changed, format!("is written by {method}, as a {shape} has no {asked}"))
        }
        (_, Method::Chebyshev { .. }) => {
            let exponents: Vec<_> = lobe::exponents(job.scene).iter().map(f64::to_string).collect();
            let what = format!(
                "by {method}, with fits of the exponents {}; of others the nearest is taken",
                exponents.join(", ")
            );
            Remark::light(light, Fate::Kept, what)
        }
        _ => Remark::light(light, Fate::Kept, format!("by {method}")),
    }
}
