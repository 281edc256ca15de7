//! The prims of a stage, from its root to its lights.

use std::collections::BTreeSet;
use std::io;

use glam::{DAffine3, DMat3, DVec3};

use super::Remark;
use super::place::local_transform;
use super::prim::{Layer, Prim, Property, Value, find};
use crate::light::Light;
use crate::scene::keep_apart;

/// Walks over the prims of a layer.
pub(super) struct Reader<'a> {
    layer: &'a Layer,
    /// Gives the bytes of a file beside the layer.
    pub(super) read: &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>,
    /// Metres in one of the stage's units.
    pub(super) metres: f64,
    /// The stage's up direction, in its own frame.
    pub(super) up: DVec3,
    lights: Vec<Light>,
    remarks: Vec<Remark>,
    names: BTreeSet<String>,
}

/// What a prim takes from those above it.
#[derive(Clone, Copy)]
struct Inherited {
    /// From its own frame to the stage's.
    stage_from_prim: DAffine3,
    is_visible: bool,
}

/// What a light needs to know.
pub(super) struct Found<'a> {
    pub(super) prim: &'a Prim,
    /// From its own frame to the stage's, in the stage's units.
    pub(super) stage_from_light: DAffine3,
}

impl<'a> Reader<'a> {
    pub(super) fn new(layer: &'a Layer, read: &'a mut dyn FnMut(&str) -> io::Result<Vec<u8>>) -> Self {
        let value = |name| find(&layer.metadata, name).map(|property| &property.value);
        let metres = value("metersPerUnit").and_then(Value::number).filter(|metres| *metres > 0.0);
        let is_z_up = value("upAxis").and_then(Value::text) == Some("Z");
        let mut reader = Self {
            layer,
            read,
            // What the schema says of stages that do not.
            metres: metres.unwrap_or(0.01),
            up: if is_z_up { DVec3::Z } else { DVec3::Y },
            lights: Vec::new(),
            remarks: Vec::new(),
            names: BTreeSet::new(),
        };
        for layers in layer.metadata.iter().filter(|property| property.name == "subLayers") {
            reader.remark(layers.line, "other layers are not read; flatten the stage to have them, too");
        }
        reader
    }

    /// The lights found, and what is not as it was.
    pub(super) fn finished(self) -> (Vec<Light>, Vec<Remark>) {
        let mut remarks = self.remarks;
        remarks.sort_by_key(|remark| remark.line);
        (self.lights, remarks)
    }

    pub(super) fn remark(&mut self, line: usize, what: impl Into<String>) {
        self.remarks.push(Remark { line, what: what.into() });
    }

    /// A remark about a prim.
    pub(super) fn remark_on(&mut self, prim: &Prim, line: usize, what: &str) {
        let kind = if prim.kind.is_empty() { &prim.specifier } else { &prim.kind };
        self.remark(line, format!("{kind} \"{}\" {what}", prim.name));
    }

    /// From the stage's frame and units to metres, Z up.
    pub(super) fn world_from_stage(&self) -> DAffine3 {
        let turn = if self.up == DVec3::Z { DMat3::IDENTITY } else { y_to_z() };
        DAffine3::from_mat3(self.metres * turn)
    }

    /// All prims of the layer.
    pub(super) fn prims(&mut self) {
        let layer = self.layer;
        let root = Inherited { stage_from_prim: DAffine3::IDENTITY, is_visible: true };
        layer.prims.iter().for_each(|prim| self.prim(prim, root));
    }

    fn prim(&mut self, prim: &Prim, above: Inherited) {
        let is_off = find(&prim.metadata, "active").is_some_and(|active| active.value.number() == Some(0.0));
        if prim.specifier == "class" || is_off {
            return;
        }
        if prim.specifier == "over" {
            self.remark_on(prim, prim.line, "changes what another layer defines, and is not read");
            return;
        }
        for property in &prim.metadata {
            if matches!(property.name.as_str(), "references" | "payload" | "inherits" | "specializes") {
                self.remark_on(prim, property.line, &format!("has {}, which are not followed", property.name));
            }
        }
        let composed;
        let prim = match composed_of(prim) {
            Some(with_variants) => {
                composed = with_variants;
                &composed
            }
            None => prim,
        };
        let (local, notes) = local_transform(prim);
        for (line, note) in notes {
            self.remark_on(prim, line, &note);
        }
        let stage_from_prim = if local.resets { local.transform } else { above.stage_from_prim * local.transform };
        let hides = prim.property("visibility").is_some_and(|property| property.value.text() == Some("invisible"));
        let here = Inherited { stage_from_prim, is_visible: above.is_visible && !hides };
        // What Softbox wrote as a row of balls is one line again.
        let is_row = prim.property("softbox:line:length").is_some();
        if is_light(prim) || is_row {
            self.take(prim, here);
        }
        if is_row {
            return;
        }
        prim.children.iter().for_each(|child| self.prim(child, here));
    }

    fn take(&mut self, prim: &Prim, here: Inherited) {
        let found = Found { prim, stage_from_light: here.stage_from_prim };
        let Some(mut light) = self.light(&found) else { return };
        light.muted = !here.is_visible;
        if light.muted {
            self.remark_on(prim, prim.line, "is invisible, and muted here");
        }
        light.name = self.name(prim);
        keep_apart(&mut light, &self.lights);
        self.lights.push(light);
    }

    /// What the prim is called, once.
    fn name(&mut self, prim: &Prim) -> String {
        let shown = find(&prim.metadata, "displayName").and_then(|property| property.value.text());
        let name = shown.filter(|name| !name.trim().is_empty()).unwrap_or(&prim.name).replace(char::is_control, " ");
        let numbered = (2..).map(|number| format!("{name} {number}"));
        let mut candidates = std::iter::once(name.clone()).chain(numbered);
        candidates.find(|candidate| self.names.insert(candidate.clone())).unwrap_or(name)
    }
}

/// The rotation that takes +Y to +Z.
pub(super) fn y_to_z() -> DMat3 {
    DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y)
}

/// Whether a prim shines.
fn is_light(prim: &Prim) -> bool {
    prim.kind.ends_with("Light") || matches!(prim.kind.as_str(), "DomeLight_1") || has_light_api(prim)
}

/// Whether a prim shines by an API schema.
pub(super) fn has_light_api(prim: &Prim) -> bool {
    ["LightAPI", "MeshLightAPI", "VolumeLightAPI"].iter().any(|schema| prim.has_api(schema))
}

/// A prim with what its chosen variants say; none where it has no variants.
fn composed_of(prim: &Prim) -> Option<Prim> {
    if prim.variant_sets.is_empty() {
        return None;
    }
    let mut composed = prim.clone();
    let chosen = find(&prim.metadata, "variants").map(|property| &property.value);
    let chosen = if let Some(Value::Dictionary(entries)) = chosen { entries.as_slice() } else { &[] };
    for (set, variants) in &prim.variant_sets {
        let choice = chosen.iter().find(|(name, _)| name == set).and_then(|(_, value)| value.text());
        let Some((_, variant)) = variants.iter().find(|(name, _)| Some(name.as_str()) == choice) else { continue };
        // What the prim itself says is stronger.
        let weaker = |properties: &mut Vec<Property>, more: &[Property]| {
            properties.splice(0..0, more.iter().cloned()).for_each(drop)
        };
        weaker(&mut composed.properties, &variant.properties);
        weaker(&mut composed.metadata, &variant.metadata);
        composed.children.extend(variant.children.iter().cloned());
    }
    Some(composed)
}
