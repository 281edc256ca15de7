//! WGSL: a function for each light.

use super::shader::{Shader, USAGE};
use super::{ExportError, Exported, Job};
use crate::render::Progress;

/// The functions, and the textures that they read.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let Shader { text, tables, remarks, .. } = Shader::new(job, progress)?;
    let usage: String = USAGE.lines().map(|line| format!("// {line}\n")).collect();
    let text = format!("{}//\n{usage}\n{text}", job.header(&remarks, "//"));
    let files = [job.main_file(text)].into_iter().chain(tables.into_iter().map(|table| table.file)).collect();
    Ok(Exported { files, remarks })
}
