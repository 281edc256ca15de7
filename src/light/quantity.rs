//! Photometric quantities in which a light's emission may be stated.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum QuantityKind {
    /// cd·m⁻².
    Luminance,
    /// lm.
    Flux,
    /// cd.
    Intensity,
    /// cd·m⁻¹.
    IntensityPerMetre,
    /// lx, on a surface that faces the light.
    Illuminance,
}

/// A quantity and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    kind: QuantityKind,
    value: f64,
}

impl QuantityKind {
    /// All kinds.
    pub const ALL: [Self; 5] =
        [Self::Luminance, Self::Flux, Self::Intensity, Self::IntensityPerMetre, Self::Illuminance];

    /// The key in scene files.
    pub fn key(self) -> &'static str {
        match self {
            Self::Luminance => "luminance",
            Self::Flux => "flux",
            Self::Intensity => "intensity",
            Self::IntensityPerMetre => "intensity_per_metre",
            Self::Illuminance => "illuminance",
        }
    }

    /// The unit's symbol.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Luminance => "cd/m²",
            Self::Flux => "lm",
            Self::Intensity => "cd",
            Self::IntensityPerMetre => "cd/m",
            Self::Illuminance => "lx",
        }
    }
}

impl Quantity {
    /// `value` of `kind`.
    pub fn new(kind: QuantityKind, value: f64) -> Self {
        Self { kind, value }
    }

    /// Which quantity is stated.
    pub fn kind(self) -> QuantityKind {
        self.kind
    }

    /// Its value.
    pub fn value(self) -> f64 {
        self.value
    }
}
