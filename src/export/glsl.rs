//! GLSL: a function for each light, translated from WGSL by naga.
//!
//! The functions are for GLSL ES 3.00, GLSL 3.30 and later, to be put into a shader that has a version line of its own.

use naga::ShaderStage;
use naga::back::glsl::{Options, PipelineOptions, Version, Writer, WriterFlags};
use naga::valid::{Capabilities, ValidationFlags, Validator};

use super::shader::{GROUP, Shader, TableFile, USAGE};
use super::{ExportError, Exported, Job};
use crate::render::Progress;

/// The shader that naga wants around functions.
pub(super) const MAIN: &str = "\
@fragment
fn main() -> @location(0) vec4f {
    let sum = softbox_lights(vec3f(), vec3f(), vec3f(), 1.0);
    return vec4f(sum.irradiance + sum.specular, 1.0);
}
";

/// The functions, and the textures that they read.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let shader = Shader::new(job, progress)?;
    let usage: String = USAGE.lines().map(|line| format!("// {line}\n")).collect();
    let text = format!("{}//\n{usage}\n{}", job.header(&shader.remarks, "//"), functions(&shader)?);
    let text = text.replace(|c: char| !c.is_ascii(), "?");
    let files = shader.tables.into_iter().map(|table| table.file);
    Ok(Exported { files: [job.main_file(text)].into_iter().chain(files).collect(), remarks: shader.remarks })
}

/// The text but for the header.
fn functions(shader: &Shader) -> Result<String, ExportError> {
    let written = translated(&format!("{}\n{MAIN}", shader.text))
        .map_err(|cause| ExportError::Encode { what: "the functions".to_owned(), cause })?;
    let (library, _) = written.split_once("\nvoid main() {").unwrap_or((&written, ""));
    let is_of_main = |line: &str| line.starts_with("#version") || line.starts_with("layout(location = 0) out");
    let mut text: String = library.lines().filter(|line| !is_of_main(line)).map(|line| format!("{line}\n")).collect();
    for TableFile { name, binding, .. } in &shader.tables {
        text = text.replace(&format!("_group_{GROUP}_binding_{binding}_fs"), name);
    }
    for table in &shader.tables {
        let declaration = format!("uniform highp sampler2D {};", table.name);
        text = text.replace(&declaration, &format!("// {}\n{declaration}", table.title()));
    }
    for (name, title) in &shader.functions {
        // naga puts an underscore behind names that end with a digit.
        let ends_with_digit = name.ends_with(|c: char| c.is_ascii_digit());
        let text_name = if ends_with_digit { format!("{name}_") } else { name.clone() };
        text = text.replace(&format!(" {text_name}("), &format!(" {name}("));
        for ty in ["vec2", "SoftboxLights"] {
            let definition = format!("\n{ty} {name}(vec3");
            text = text.replace(&definition, &format!("\n// {title}{definition}"));
        }
    }
    Ok(text)
}

/// A WGSL module as a fragment shader.
fn translated(wgsl: &str) -> Result<String, Box<dyn std::error::Error + Send + Sync>> {
    let module = naga::front::wgsl::parse_str(wgsl)?;
    let info = Validator::new(ValidationFlags::all(), Capabilities::default()).validate(&module)?;
    let options = Options {
        version: Version::new_gles(300),
        writer_flags: WriterFlags::INCLUDE_UNUSED_ITEMS,
        ..Options::default()
    };
    let pipeline =
        PipelineOptions { shader_stage: ShaderStage::Fragment, entry_point: "main".to_owned(), multiview: None };
    let mut text = String::new();
    let policies = naga::proc::BoundsCheckPolicies::default();
    Writer::new(&mut text, &module, &info, &options, &pipeline, policies)?.write()?;
    Ok(text)
}
