//! The scene format as serde and schemars see it, and its translation to and from [`Scene`].

use glam::DVec3;
use schemars::{JsonSchema, Schema};
use serde::Deserialize;
use serde_json::json;

use super::problem::Path;
use super::{Camera, Display, FORMAT, Plot, Problem, Scene, Variant};
use crate::light::{Light, Quantity, QuantityKind, Shape, Tint};
use crate::surface::{Material, Surface};

/// A Softbox scene, or a light preset: a scene with lights and nothing else.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Softbox scene")]
pub(super) struct File {
    /// The number of the format.
    #[schemars(extend("const" = FORMAT))]
    #[expect(dead_code, reason = "checked before the rest is read")]
    pub(super) format: u32,
    /// What people call the scene.
    #[serde(default)]
    pub(super) name: String,
    /// Words to find it by in a library, such as "studio".
    #[serde(default)]
    pub(super) tags: Vec<String>,
    /// The name of the variant that the lights came from.
    #[serde(default)]
    #[schemars(with = "String")]
    pub(super) active_variant: Option<String>,
    /// From where it is seen.
    #[serde(default)]
    pub(super) camera: Camera,
    /// How its radiance becomes a picture.
    #[serde(default)]
    pub(super) display: Display,
    /// Materials.
    #[serde(default)]
    pub(super) material: Vec<Material>,
    /// Surfaces.
    #[serde(default)]
    pub(super) surface: Vec<Surface>,
    /// Lights.
    #[serde(default)]
    pub(super) light: Vec<LightEntry>,
    /// Plots.
    #[serde(default)]
    pub(super) plot: Vec<Plot>,
    /// Other states of the lights, to switch between.
    #[serde(default)]
    pub(super) variant: Vec<VariantEntry>,
}

/// A named state of the lights.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Variant")]
pub(super) struct VariantEntry {
    /// Unique among the variants of a scene.
    name: String,
    /// Its lights.
    #[serde(default)]
    light: Vec<LightEntry>,
}

/// A light. It states exactly one quantity, and a color or a temperature but not both.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Light", transform = one_quantity_at_most_one_tint)]
pub(super) struct LightEntry {
    /// Unique among the lights of a scene.
    name: String,
    /// Origin of the light's own frame, metres.
    #[serde(default)]
    #[schemars(with = "[f64; 3]")]
    position: DVec3,
    /// Rotation of the light's own frame, R = Rz·Ry·Rx, degrees; unrotated, it emits along −Z.
    #[serde(default)]
    #[schemars(with = "[f64; 3]")]
    rotation_deg: DVec3,
    /// Tint, linear Rec. 709 RGB; its luminance does not matter.
    #[schemars(with = "[f64; 3]")]
    #[serde(default)]
    color: Option<DVec3>,
    /// Tint as the temperature of a black body, kelvin.
    #[serde(default)]
    #[schemars(with = "f64")]
    temperature_k: Option<f64>,
    /// In cd/m²: polygon, disk, textured (of a texel of value 1), sphere, cap, sky.
    #[serde(default)]
    #[schemars(with = "f64")]
    luminance: Option<f64>,
    /// In lm: polygon, disk, textured, line, sphere, point.
    #[serde(default)]
    #[schemars(with = "f64")]
    flux: Option<f64>,
    /// In cd: point.
    #[serde(default)]
    #[schemars(with = "f64")]
    intensity: Option<f64>,
    /// In cd/m: line.
    #[serde(default)]
    #[schemars(with = "f64")]
    intensity_per_metre: Option<f64>,
    /// In lx, on a surface that faces the light: cap, directional.
    #[serde(default)]
    #[schemars(with = "f64")]
    illuminance: Option<f64>,
    /// A muted light contributes nothing.
    #[serde(default)]
    muted: bool,
    /// The group that it is listed in.
    #[serde(default)]
    #[schemars(with = "String")]
    group: Option<String>,
    /// Names of the surfaces that it lights; all of them where this is left out.
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    only: Option<Vec<String>>,
    /// Shape, in the light's own frame.
    shape: Shape,
}

/// What serde's types cannot say of a light: which keys exclude each other.
fn one_quantity_at_most_one_tint(schema: &mut Schema) {
    let one_of: Vec<_> = QuantityKind::ALL.iter().map(|kind| json!({ "required": [kind.key()] })).collect();
    schema.insert("oneOf".to_owned(), one_of.into());
    schema.insert("not".to_owned(), json!({ "required": ["color", "temperature_k"] }));
}

impl File {
    /// The scene that the file states, or what is contradictory in it.
    pub(super) fn into_scene(self) -> Result<Scene, Vec<Problem>> {
        let mut problems = Vec::new();
        let root = Path::default();
        let lights = lights_of(self.light, &root, &mut problems);
        let mut variants = Vec::new();
        for (i, entry) in self.variant.into_iter().enumerate() {
            let lights = lights_of(entry.light, &root.key("variant").index(i), &mut problems);
            variants.push(Variant { name: entry.name, lights });
        }
        if !problems.is_empty() {
            return Err(problems);
        }
        Ok(Scene {
            name: self.name,
            tags: self.tags,
            camera: self.camera,
            display: self.display,
            materials: self.material,
            surfaces: self.surface,
            lights,
            plots: self.plot,
            variants,
            active_variant: self.active_variant,
        })
    }
}

/// The lights of the table at `path`; what is contradictory in them is added to `problems`.
fn lights_of(entries: Vec<LightEntry>, path: &Path, problems: &mut Vec<Problem>) -> Vec<Light> {
    let path = path.key("light");
    let lights = entries.into_iter().enumerate().map(|(i, entry)| entry.into_light(&path.index(i)));
    lights.filter_map(|light| light.map_err(|problem| problems.push(problem)).ok()).collect()
}

impl LightEntry {
    fn into_light(self, path: &Path) -> Result<Light, Problem> {
        let tint = match (self.color, self.temperature_k) {
            (None, None) => Tint::default(),
            (Some(color), None) => Tint::Color(color),
            (None, Some(kelvin)) => Tint::TemperatureK(kelvin),
            (Some(_), Some(_)) => {
                let message = "stands beside `color`; keep one of the two";
                return Err(Problem::new(path.key("temperature_k"), message));
            }
        };
        Ok(Light {
            quantity: self.quantity(path)?,
            name: self.name,
            position: self.position,
            rotation_deg: self.rotation_deg,
            tint,
            muted: self.muted,
            group: self.group,
            only: self.only,
            shape: self.shape,
        })
    }

    /// The one quantity that the entry states.
    fn quantity(&self, path: &Path) -> Result<Quantity, Problem> {
        let stated = |kind| match kind {
            QuantityKind::Luminance => self.luminance,
            QuantityKind::Flux => self.flux,
            QuantityKind::Intensity => self.intensity,
            QuantityKind::IntensityPerMetre => self.intensity_per_metre,
            QuantityKind::Illuminance => self.illuminance,
        };
        let mut quantities = QuantityKind::ALL.into_iter().filter_map(|kind| Some(Quantity::new(kind, stated(kind)?)));
        match (quantities.next(), quantities.next()) {
            (Some(quantity), None) => Ok(quantity),
            (Some(first), Some(second)) => {
                let message = format!("stands beside `{}`; keep one of the two", first.kind().key());
                Err(Problem::new(path.key(second.kind().key()), message))
            }
            (None, _) => {
                let keys: Vec<_> = self.shape.quantity_kinds().iter().map(|kind| format!("`{}`", kind.key())).collect();
                let message =
                    format!("does not say how bright it is; a `{}` takes {}", self.shape.name(), keys.join(" or "));
                Err(Problem::new(path.clone(), message))
            }
        }
    }
}
