//! What an export can be written as.

use std::fmt;
use std::str::FromStr;

/// A format that a scene leaves the program in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Target {
    /// OpenUSD.
    Usda,
    /// Lights by `KHR_lights_punctual`, surfaces as meshes.
    Gltf,
    /// A scene of Mitsuba 3's.
    Mitsuba,
    /// A scene of Radiance's.
    Radiance,
    /// A script for Blender.
    Blender,
    /// Candela of the lights, ANSI/IESNA LM-63-2002.
    Ies,
    /// Functions of the lights.
    Wgsl,
    /// The same in another language.
    Glsl,
    /// The scene, for scripts.
    Json,
    /// The plots' numbers.
    Csv,
    /// The plots.
    Svg,
    /// A picture as the screen shows it.
    Png,
    /// A picture of radiance.
    Exr,
}

impl Target {
    /// All of them, as lists show them.
    pub const ALL: [Self; 13] = [
        Self::Usda,
        Self::Gltf,
        Self::Mitsuba,
        Self::Radiance,
        Self::Blender,
        Self::Ies,
        Self::Wgsl,
        Self::Glsl,
        Self::Json,
        Self::Csv,
        Self::Svg,
        Self::Png,
        Self::Exr,
    ];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Usda => "usda",
            Self::Gltf => "gltf",
            Self::Mitsuba => "mitsuba",
            Self::Radiance => "radiance",
            Self::Blender => "blender",
            Self::Ies => "ies",
            Self::Wgsl => "wgsl",
            Self::Glsl => "glsl",
            Self::Json => "json",
            Self::Csv => "csv",
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// The extension of its main file; no two have the same.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Mitsuba => "xml",
            Self::Radiance => "rad",
            Self::Blender => "py",
            _ => self.name(),
        }
    }

    /// What it is, in a few words.
    pub fn title(self) -> &'static str {
        match self {
            Self::Usda => "OpenUSD: lights, surfaces and materials",
            Self::Gltf => "glTF: fitted punctual lights, and meshes",
            Self::Mitsuba => "Mitsuba 3: a scene, as XML",
            Self::Radiance => "Radiance: a scene",
            Self::Blender => "Blender: a script that builds the scene",
            Self::Ies => "IES (LM-63): the lights as one luminaire from far away",
            Self::Wgsl => "WGSL: shader functions of the lights",
            Self::Glsl => "GLSL: shader functions of the lights",
            Self::Json => "JSON: the scene, for scripts",
            Self::Csv => "CSV: the plots' numbers",
            Self::Svg => "SVG: the plots",
            Self::Png => "PNG: a picture as the screen shows it",
            Self::Exr => "OpenEXR: a picture of radiance, cd/m²",
        }
    }

    /// The target whose files have that extension, in upper or lower case.
    pub fn of_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|target| target.extension().eq_ignore_ascii_case(extension))
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is no target's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not known; use {list}", list = Target::ALL.map(Target::name).join(", "))]
pub struct UnknownTarget(String);

impl FromStr for Target {
    type Err = UnknownTarget;

    fn from_str(name: &str) -> Result<Self, UnknownTarget> {
        Self::ALL.into_iter().find(|target| target.name() == name).ok_or_else(|| UnknownTarget(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn names_and_extensions_lead_back_to_their_target() {
        for target in Target::ALL {
            assert_eq!(target.to_string().parse(), Ok(target), "by its name");
            assert_eq!(Target::of_extension(&target.extension().to_uppercase()), Some(target), "by its extension");
        }
        assert_eq!(Target::ALL.into_iter().collect::<BTreeSet<_>>().len(), Target::ALL.len(), "each once");
        assert!("JSON".parse::<Target>().is_err_and(|error| error.to_string().contains("json, csv")), "the names");
    }
}
