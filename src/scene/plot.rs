//! Plots that belong to a scene.

use glam::DVec3;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One plot: a quantity at a probe while the probe is moved along a range.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    /// Unique among the plots of a scene.
    pub name: String,
    /// What moves.
    pub kind: PlotKind,
    /// What is plotted.
    #[serde(default)]
    pub quantity: PlotQuantity,
    /// Where the probe is, metres.
    #[serde(default)]
    #[schemars(with = "[f64; 3]")]
    pub position: DVec3,
    /// The probe's normal.
    #[serde(default = "up")]
    #[schemars(with = "[f64; 3]")]
    pub normal: DVec3,
    /// Where the probe is seen from: a direction. Along the normal where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<[f64; 3]>")]
    pub view: Option<DVec3>,
    /// `tilt` and `view`: the axis turned about. `line` and `distance`: the direction moved along.
    #[serde(default = "along_y")]
    #[schemars(with = "[f64; 3]")]
    pub axis: DVec3,
    /// First and last abscissa: degrees for `tilt` and `view`, metres for `line` and `distance`.
    pub range: [f64; 2],
    /// The probe's material; the scene's first where it is not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
    /// Divide every curve by the greatest exact value.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub normalise: bool,
}

/// What moves along a plot's abscissa.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PlotKind {
    /// The probe's normal turns about `axis`; abscissa in degrees from `normal`.
    Tilt,
    /// The eye turns about `axis`; abscissa in degrees from `normal`.
    View,
    /// The probe moves along `axis`; abscissa in metres from `position`.
    Line,
    /// The probe moves along `axis`, on a logarithmic abscissa in metres from `position`.
    Distance,
}

/// What a plot shows, as luminance with the lights' tints left out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PlotQuantity {
    /// E, lx.
    #[default]
    Irradiance,
    /// The specular part of L_out for k_s = 1, cd/m².
    Specular,
    /// L_out of the probe's material, cd/m².
    Radiance,
}

fn up() -> DVec3 {
    DVec3::Z
}

fn along_y() -> DVec3 {
    DVec3::Y
}
