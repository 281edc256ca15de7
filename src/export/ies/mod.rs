//! IES files, ANSI/IESNA LM-63-2002: the lights of a job as one luminaire, seen from far away.
//!
//! [`luminaire`] is what is measured, [`web`] its intensities on a table, [`field`] the distance from which they hold,
//! and [`text`] the file. The reader is [`crate::light::photometry::lm63`].

mod field;
mod luminaire;
#[cfg(test)]
mod tests;
mod text;
mod web;

use self::field::Field;
use self::luminaire::Luminaire;
use self::web::Web;
use super::job::Chosen;
use super::preflight::without_variants;
use super::{ExportError, Exported, Fate, Job, Remark};
use crate::light::{Light, Shape, Tint, pattern::Image};
use crate::render::Progress;

/// The lights as one luminaire; surfaces are no part of it.
pub(super) fn write(job: &Job, progress: &Progress) -> Result<Exported, ExportError> {
    let job = &Job { surfaces: false, ..*job };
    let Chosen { lights, mut remarks } = job.chosen_lights()?;
    let (held, lost): (Vec<_>, Vec<_>) = lights.into_iter().partition(|light| what_is_lost(light).is_none());
    remarks.extend(lost.iter().filter_map(|light| Some(Remark::light(light, Fate::Lost, what_is_lost(light)?))));
    let Some(luminaire) = Luminaire::new(&held) else {
        let why = remarks.iter().rfind(|remark| remark.fate == Fate::Lost);
        let why = why.map_or(String::new(), |Remark { thing, what, .. }| format!(": {thing} {what}"));
        return Err(ExportError::Nothing(format!("no light that an IES file can hold{why}")));
    };
    let web = Web::of(&luminaire);
    let field = Field::of(&luminaire, &web, progress).ok_or(ExportError::Cancelled)?;
    remarks.extend(held.iter().map(|light| Remark::light(light, Fate::Changed, becomes(light, &luminaire, &field))));
    remarks.extend(held.iter().filter_map(|light| Some(Remark::light(light, Fate::Changed, uncoloured(light)?))));
    remarks.extend(placing(&luminaire, &held, job));
    remarks.extend(without_variants(job.scene));
    let file = text::file(job, &held, &luminaire, &web, &field, &remarks);
    Ok(Exported { files: vec![job.main_file(file)], remarks })
}

/// Why a light has no candela at all.
fn what_is_lost(light: &Light) -> Option<&'static str> {
    match &light.shape {
        Shape::Cap(_) | Shape::Sky(_) | Shape::Directional(_) => {
            Some("is infinitely far away and has no candela; leave it out, or put a light in its place")
        }
        Shape::Line(line) if line.falloff != 2.0 => {
            Some("does not fall off as 1/d² and has no candela; set its falloff to 2")
        }
        _ => None,
    }
}

/// What becomes of a light that is held.
fn becomes(light: &Light, luminaire: &Luminaire, field: &Field) -> String {
    let flux = light.in_quantity(crate::light::QuantityKind::Flux).unwrap_or(0.0);
    let kept = format!("its candela and its {} lm are kept", text::short(flux));
    match light.shape {
        Shape::Point(_) if luminaire.radius() == 0.0 => format!("{kept}, exactly at any distance"),
        _ => format!("{kept}; it acts from one point: {}", field.in_words()),
    }
}

/// What becomes of a light's colour.
fn uncoloured(light: &Light) -> Option<&'static str> {
    let is_coloured_pattern =
        matches!(&light.shape, Shape::Textured(textured) if matches!(textured.pattern.image, Image::Color(_)));
    let is_coloured = is_coloured_pattern || light.tint.rgb() != Tint::default().rgb();
    is_coloured.then_some("its colour is left out, as IES files have none; set it where the file is used")
}

/// Where the file is to be put, and what it does not hold.
fn placing(luminaire: &Luminaire, lights: &[Light], job: &Job<'_>) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let [x, y, z] = luminaire.center.to_array().map(text::short);
    let [rx, ry, rz] = luminaire.rotation_deg.to_array().map(text::short);
    let place = format!(
        "put the file at ({x}, {y}, {z}) m, turned by ({rx}, {ry}, {rz})° about X, then Y, then Z; nadir is then −Z, and \
         the plane C = 0 on the side of +X"
    );
    remarks.push(Remark::scene(Fate::Changed, place));
    if lights.len() > 1 {
        let what = format!("its {} lights are one luminaire; export one at a time to place them apart", lights.len());
        remarks.push(Remark::scene(Fate::Changed, what));
    }
    if !job.scene.surfaces.is_empty() {
        remarks.push(Remark::scene(Fate::Changed, "its surfaces are left out, as IES files hold light only"));
    }
    remarks
}
