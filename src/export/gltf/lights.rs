//! Lights: as what `KHR_lights_punctual` has, and as what `EXT_lights_area` may have.

use glam::{DMat3, DQuat, DVec3};
use serde_json::{Value, json};

use super::{Document, color_and_strength, node, placed};
use crate::export::emission::Side;
use crate::export::{ExportError, Fate, Remark};
use crate::light::{Emitter, Light, LineEmitter, Shape};
use crate::render::Progress;
use crate::scene::Scene;
use crate::shading::fit::{Budget, COUNTS, Deviation, Fit, Punctual};

const PUNCTUAL: &str = "KHR_lights_punctual";
const AREA: &str = "EXT_lights_area";

/// The lights of a document.
#[derive(Debug, Default)]
pub(super) struct Lit {
    /// Root nodes of all lights as punctual ones.
    pub(super) punctual: Vec<usize>,
    /// The same with area lights where they can be; none where none can.
    pub(super) area: Option<Vec<usize>>,
    pub(super) remarks: Vec<Remark>,
}

/// Adds the lights of a scene.
pub(super) fn add(
    scene: &Scene,
    budget: Budget,
    progress: &Progress,
    document: &mut Document,
) -> Result<Lit, ExportError> {
    let mut lit = Lit::default();
    let mut area = Vec::new();
    let mut has_area = false;
    for light in &scene.lights {
        let (root, remarks) = punctual(light, budget, progress, document).ok_or(ExportError::Cancelled)?;
        lit.punctual.push(root);
        lit.remarks.extend(remarks);
        let sides = sides(light);
        has_area |= !sides.is_empty();
        area.push(if sides.is_empty() { root } else { area_light(light, &sides, document) });
    }
    lit.area = has_area.then_some(area);
    Ok(lit)
}

/// A light's root node, whose children are the lights that stand for it, and what becomes of it; none when cancelled.
fn punctual(
    light: &Light,
    budget: Budget,
    progress: &Progress,
    document: &mut Document,
) -> Option<(usize, Vec<Remark>)> {
    let mut children = Vec::new();
    let (mut deviation, mut region) = (Deviation::default(), None);
    for (emitter, weight) in light.parts() {
        let fit = Fit::within(&emitter, budget, Some(progress.cancelled()))?;
        let of_part = fit.deviation(Some(progress.cancelled()))?;
        deviation = Deviation { rms: deviation.rms.max(of_part.rms), worst: deviation.worst.max(of_part.worst) };
        region = fit.region();
        for light in fit.lights() {
            let name = format!("{} {}", light_name(light), children.len() + 1);
            children.push(punctual_node(light, weight, &name, document));
        }
    }
    let remarks = remarks(light, children.len(), deviation, region, budget);
    let mut root = placed(DVec3::ZERO, DQuat::IDENTITY);
    root["name"] = json!(light.name);
    if !children.is_empty() {
        root["extras"] = extras(light, children.len(), deviation, region);
        root["children"] = json!(children);
    }
    Some((document.put("nodes", root), remarks))
}

/// The name of its type in glTF.
fn light_name(light: &Punctual) -> &'static str {
    match light {
        Punctual::Point { .. } => "point",
        Punctual::Spot { .. } => "spot",
        Punctual::Directional { .. } => "directional",
    }
}

/// A light of unit strength times `weight`, as a node of its own.
fn punctual_node(light: &Punctual, weight: DVec3, name: &str, document: &mut Document) -> usize {
    let (color, intensity) = color_and_strength(light.strength() * weight);
    let mut of_light = json!({ "type": light_name(light), "color": color, "intensity": intensity });
    let mut node = match *light {
        Punctual::Point { position, .. } => node(position, DQuat::IDENTITY),
        Punctual::Spot { position, axis, cone, .. } => {
            let [inner, outer] = cone.angles();
            of_light["spot"] = json!({ "innerConeAngle": inner, "outerConeAngle": outer });
            node(position, DQuat::from_rotation_arc(DVec3::NEG_Z, axis))
        }
        Punctual::Directional { to_light, .. } => node(DVec3::ZERO, DQuat::from_rotation_arc(DVec3::NEG_Z, -to_light)),
    };
    let index = document.put_light(PUNCTUAL, of_light);
    node["name"] = json!(name);
    node["extensions"] = json!({ PUNCTUAL: { "light": index } });
    document.put("nodes", node)
}

/// What the fit of a light is worth, for programs.
fn extras(light: &Light, count: usize, deviation: Deviation, region: Option<[f64; 2]>) -> Value {
    let mut fit = json!({ "lights": count, "rms_error": deviation.rms, "worst_error": deviation.worst });
    if let Some(region) = region {
        fit["from_to_metres"] = json!(region);
    }
    json!({ "softbox": { "shape": light.shape.name(), "fit": fit } })
}

/// What becomes of a light.
fn remarks(light: &Light, count: usize, deviation: Deviation, region: Option<[f64; 2]>, budget: Budget) -> Vec<Remark> {
    let mut remarks = Vec::new();
    let mut remark = |fate, what: String| remarks.push(Remark::light(light, fate, what));
    match light.shape {
        Shape::Point(_) | Shape::Directional(_) => remark(Fate::Kept, "is the same in glTF".to_owned()),
        _ if count == 0 => remark(Fate::Changed, "shines nowhere, and no light stands for it".to_owned()),
        _ => {
            let where_ = region.map_or("on surfaces of all normals".to_owned(), |[from, to]| {
                format!("from {} m to {} m of its middle", rounded(from), rounded(to))
            });
            let [rms, worst] = [deviation.rms, deviation.worst].map(percent);
            remark(
                Fate::Changed,
                format!(
                    "is {count} punctual light{} fitted to its illuminance {where_}: RMS error {rms} %, worst {worst} % of \
                     the greatest there; highlights are those of points",
                    if count == 1 { "" } else { "s" }
                ),
            );
        }
    }
    if let Budget::Worst(bound) = budget
        && deviation.worst > bound
    {
        remark(
            Fate::Changed,
            format!("no fit of up to {} lights has a worst error of {} % or less", COUNTS.end(), percent(bound)),
        );
    }
    if let Emitter::Line(LineEmitter { falloff, .. }) = light.emitter()
        && falloff != 2.0
    {
        remark(Fate::Changed, format!("falls off as 1/d^{falloff}, which glTF does not have; a falloff of 2 fits"));
    }
    if light.parts().len() > 1 {
        remark(Fate::Changed, "is fitted in red, green and blue, each by lights of its own".to_owned());
    }
    if !sides(light).is_empty() {
        remark(Fate::Kept, format!("is also an area light of the draft {AREA}, in a second scene"));
    }
    if light.only.is_some() {
        remark(Fate::Changed, "lights all surfaces: glTF cannot link lights to some".to_owned());
    }
    remarks
}

/// Three digits that count.
fn rounded(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let unit = 10_f64.powf(2.0 - x.abs().log10().floor());
    (x * unit).round() / unit
}

/// A share in per cent, three digits that count; less than a thousandth is 0.
fn percent(share: f64) -> f64 {
    if share < 1e-5 { 0.0 } else { rounded(100.0 * share) }
}

/// The sides of a light that `EXT_lights_area` holds, and whether they are disks; none of any other light.
fn sides(light: &Light) -> Vec<(Side, &'static str)> {
    let (side, two_sided, kind) = match (&light.shape, light.emitter()) {
        (Shape::Disk(disk), _) => (Some(Side::of_disk(light, disk.radius)), disk.two_sided, "disk"),
        (Shape::Polygon(polygon), Emitter::Polygon(emitter)) => (Side::of_polygon(&emitter), polygon.two_sided, "rect"),
        _ => (None, false, ""),
    };
    side.into_iter().flat_map(|side| side.with_other(two_sided)).map(|side| (side, kind)).collect()
}

/// A light's root node as area lights.
fn area_light(light: &Light, sides: &[(Side, &'static str)], document: &mut Document) -> usize {
    let (color, luminance) = color_and_strength(light.weight());
    let children: Vec<_> = sides
        .iter()
        .map(|(side, kind)| {
            let [width, height] = [side.x, side.y].map(|half| 2.0 * half.length());
            let mut of_light = json!({ "type": kind, "color": color, "intensity": luminance, "size": height });
            if *kind == "rect" {
                of_light["rect"] = json!({ "aspect": width / height });
            }
            let index = document.put_light(AREA, of_light);
            // It shines along −Z, and its picture's X runs to the other side.
            let axes = DMat3::from_cols(-side.x.normalize_or_zero(), side.y.normalize_or_zero(), -side.normal());
            let mut node = node(side.center, DQuat::from_mat3(&axes));
            node["extensions"] = json!({ AREA: { "light": index } });
            document.put("nodes", node)
        })
        .collect();
    let mut root = placed(DVec3::ZERO, DQuat::IDENTITY);
    root["name"] = json!(light.name);
    root["children"] = json!(children);
    document.put("nodes", root)
}
