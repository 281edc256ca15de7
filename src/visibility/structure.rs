//! Names of the structures that find objects.

use std::fmt;
use std::str::FromStr;

/// How the objects that may lie on a ray or in a light's shadow are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Structure {
    /// All of them are tested.
    Every,
    /// A grid of this many voxels along each axis.
    Grid(u32),
    /// For each linear light, a cylinder about it of this many sections; for all else a hierarchy.
    LightBuffer(u32),
    /// A hierarchy of bounding volumes.
    #[default]
    Hierarchy,
}

/// What finds the objects on rays, and what those that may cast a shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Structures {
    /// For the rays of a picture.
    pub rays: Structure,
    /// For shadows.
    pub shadows: Structure,
}

/// A name that no structure has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no structure; write every, grid, light-buffer or hierarchy, with a number such as grid-20 or \
     light-buffer-72, or one for rays and one for shadows as grid-20/light-buffer-72"
)]
pub struct UnknownStructure(String);

/// Voxels along an axis, where a name does not say.
const VOXELS: u32 = 25;
const MOST_VOXELS: u32 = 256;

/// Sections of a light buffer, where a name does not say.
const SECTIONS: u32 = 360;
const MOST_SECTIONS: u32 = 36_000;

impl fmt::Display for Structure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Every => f.pad("every"),
            Self::Grid(voxels) => f.pad(&format!("grid-{voxels}")),
            Self::LightBuffer(sections) => f.pad(&format!("light-buffer-{sections}")),
            Self::Hierarchy => f.pad("hierarchy"),
        }
    }
}

impl FromStr for Structure {
    type Err = UnknownStructure;

    fn from_str(name: &str) -> Result<Self, UnknownStructure> {
        let unknown = || UnknownStructure(name.to_owned());
        let number = |text: &str, most: u32| {
            let number = text.strip_prefix('-').and_then(|digits| digits.parse().ok());
            number.filter(|number| (1..=most).contains(number)).ok_or_else(unknown)
        };
        match name {
            "every" => Ok(Self::Every),
            "hierarchy" => Ok(Self::Hierarchy),
            "grid" => Ok(Self::Grid(VOXELS)),
            "light-buffer" => Ok(Self::LightBuffer(SECTIONS)),
            _ => match (name.strip_prefix("grid"), name.strip_prefix("light-buffer")) {
                (Some(voxels), _) => number(voxels, MOST_VOXELS).map(Self::Grid),
                (_, Some(sections)) => number(sections, MOST_SECTIONS).map(Self::LightBuffer),
                (None, None) => Err(unknown()),
            },
        }
    }
}

impl From<Structure> for Structures {
    fn from(structure: Structure) -> Self {
        Self { rays: structure, shadows: structure }
    }
}

impl fmt::Display for Structures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.rays == self.shadows { self.rays.fmt(f) } else { f.pad(&format!("{}/{}", self.rays, self.shadows)) }
    }
}

impl FromStr for Structures {
    type Err = UnknownStructure;

    fn from_str(name: &str) -> Result<Self, UnknownStructure> {
        let Some((rays, shadows)) = name.split_once('/') else { return name.parse::<Structure>().map(Self::from) };
        match (rays.parse(), shadows.parse()) {
            (Ok(rays), Ok(shadows)) => Ok(Self { rays, shadows }),
            _ => Err(UnknownStructure(name.to_owned())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_read_back_and_nothing_else_is() {
        for name in ["every", "hierarchy", "grid-1", "grid-256", "light-buffer-720", "grid-5/light-buffer-24"] {
            let read: Result<Structures, _> = name.parse();
            assert_eq!(read.map(|structures| structures.to_string()), Ok(name.to_owned()), "{name} as itself");
        }
        for (name, whole) in [("grid", "grid-25"), ("light-buffer", "light-buffer-360"), ("every/every", "every")] {
            let read: Result<Structures, _> = name.parse();
            assert_eq!(read.map(|structures| structures.to_string()), Ok(whole.to_owned()), "{name} in full");
        }
        for name in ["", "bvh", "grid-", "grid-0", "grid-257", "grid20", "grid--1", "light-buffer-x", "every/", "a/b/c"]
        {
            assert_eq!(name.parse::<Structures>(), Err(UnknownStructure(name.to_owned())), "`{name}`");
        }
    }
}
