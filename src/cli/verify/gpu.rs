//! The preview's shading functions over reference cases.

use super::Question;
use super::cases::{Check, Part};
use super::table::Row;
use crate::gpu::Context;
use crate::gpu::twin::cases::{
    Case, cap_irradiance_case, cap_phong_case, disk_irradiance_case, disk_phong_case, line_irradiance_case,
    line_phong_case, polygon_irradiance_case, polygon_phong_case, sky_irradiance_case, sky_phong_case,
    sphere_irradiance_case, sphere_phong_case,
};
use crate::gpu::twin::{self, Function, Twin, bound};
use crate::light::Emitter;

/// Where the functions run.
#[derive(Debug)]
pub(super) struct Device(Context);

/// A check as the GPU gets it.
struct Asked<'a> {
    id: &'a str,
    model: &'static str,
    function: Function,
    case: Case,
    /// What the function's value is multiplied by to be in the file's normalisation.
    factor: f64,
}

impl Device {
    pub(super) fn new() -> anyhow::Result<Self> {
        Ok(Self(Context::new()?))
    }

    /// The rows of a file; none for lights that the preview does not have.
    pub(super) fn rows(&self, questions: &[Question<'_>]) -> anyhow::Result<Vec<Row>> {
        let asked: Vec<Asked<'_>> = questions.iter().filter_map(|(id, _, check)| ask(id, check)).collect();
        let Some(first) = asked.first() else { return Ok(Vec::new()) };
        // A file has one shape of light and one part of the response.
        let rows: Vec<_> = asked.iter().map(|asked| asked.case.row.clone()).collect();
        let values = Twin::new(&self.0, &first.function).run(&rows)?;
        let mut rows = Vec::new();
        for (asked, value) in asked.iter().zip(values) {
            let (value, expected) = (f64::from(value) * asked.factor, asked.case.expected * asked.factor);
            let bound = bound(asked.case.expected, asked.case.scale) * asked.factor;
            super::row_of(&mut rows, asked.model, "exact (gpu)").judged(asked.id, value, expected, bound);
        }
        Ok(rows)
    }
}

/// The function that answers a check, and its inputs.
fn ask<'a>(id: &'a str, check: &Check) -> Option<Asked<'a>> {
    let (p, n, r, m) = (check.at.p, check.at.n, check.at.mirror(), check.lobe.exponent());
    let mut factor = check.factor;
    let (function, case) = match (&check.light, check.part) {
        (Emitter::Polygon(light), Part::Irradiance) => {
            (twin::POLYGON_IRRADIANCE, polygon_irradiance_case(&light.vertices, p, n))
        }
        (Emitter::Polygon(light), Part::Specular) => {
            (twin::POLYGON_PHONG, polygon_phong_case(&light.vertices, p, n, r, m))
        }
        (Emitter::Line(light), Part::Irradiance) => (twin::LINE_IRRADIANCE, line_irradiance_case(light, p, n)),
        (Emitter::Line(light), Part::Specular) => {
            // The bare integral, as in the file.
            factor = 1.0;
            (twin::LINE_PHONG, line_phong_case(light, p, n, r, m))
        }
        (Emitter::Sphere(light), Part::Irradiance) => (twin::SPHERE_IRRADIANCE, sphere_irradiance_case(light, p, n)),
        (Emitter::Sphere(light), Part::Specular) => (twin::SPHERE_PHONG, sphere_phong_case(light, p, n, r, m)),
        (Emitter::Disk(light), Part::Irradiance) => (twin::DISK_IRRADIANCE, disk_irradiance_case(light, p, n)),
        (Emitter::Disk(light), Part::Specular) => (twin::DISK_PHONG, disk_phong_case(light, p, n, r, m)),
        (Emitter::Cap(light), Part::Irradiance) => (twin::CAP_IRRADIANCE, cap_irradiance_case(light, n)),
        (Emitter::Cap(light), Part::Specular) => (twin::CAP_PHONG, cap_phong_case(light, n, r, m)),
        (Emitter::Sky(light), Part::Irradiance) => (twin::SKY_IRRADIANCE, sky_irradiance_case(light, n)),
        (Emitter::Sky(light), Part::Specular) => (twin::SKY_PHONG, sky_phong_case(light, n, r, m)),
        _ => return None,
    };
    Some(Asked { id, model: check.name, function, case, factor })
}
