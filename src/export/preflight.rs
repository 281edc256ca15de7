//! What becomes of each thing in an export.
//!
//! An export's remarks come from its writer, so that what is said and what is written cannot disagree: looking before
//! writing is to export and not to write the files.

use std::fmt;

use super::job::one_line;
use crate::light::Light;
use crate::scene::Scene;
use crate::surface::Surface;

/// What becomes of a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Fate {
    /// The target holds all of it.
    Kept,
    /// It arrives, but not quite as it is.
    Changed,
    /// It is not in the file; nothing is written unless that is allowed.
    Lost,
}

/// What becomes of one thing, and why.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Which thing: `light "window"`, `surface "floor"`, `scene`.
    pub thing: String,
    /// What becomes of it.
    pub fate: Fate,
    /// One line: what happens, and what could be done about it.
    pub what: String,
}

impl Fate {
    /// The word in lists.
    pub fn name(self) -> &'static str {
        match self {
            Self::Kept => "kept",
            Self::Changed => "changed",
            Self::Lost => "lost",
        }
    }
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl Remark {
    /// A remark about a light.
    pub fn light(light: &Light, fate: Fate, what: impl Into<String>) -> Self {
        Self { thing: format!("light \"{}\"", one_line(&light.name)), fate, what: what.into() }
    }

    /// A remark about a surface.
    pub fn surface(surface: &Surface, fate: Fate, what: impl Into<String>) -> Self {
        Self { thing: format!("surface \"{}\"", one_line(&surface.name)), fate, what: what.into() }
    }

    /// A remark about the scene as a whole.
    pub fn scene(fate: Fate, what: impl Into<String>) -> Self {
        Self { thing: "scene".to_owned(), fate, what: what.into() }
    }
}

/// What a target that holds one state of the lights says of a scene's variants.
pub(super) fn without_variants(scene: &Scene) -> Option<Remark> {
    let what = "its variants are left out; switch to one and export it on its own";
    (!scene.variants.is_empty()).then(|| Remark::scene(Fate::Changed, what))
}

/// Remarks as aligned lines: fate, thing, what.
pub fn lines(remarks: &[Remark]) -> Vec<String> {
    let width = remarks.iter().map(|remark| remark.thing.chars().count()).max().unwrap_or(0);
    remarks.iter().map(|Remark { thing, fate, what }| format!("{fate:<7}  {thing:<width$}  {what}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn remarks_stand_in_columns_whatever_the_names() {
        let remark = |thing: &str, fate| Remark { thing: thing.to_owned(), fate, what: "what".to_owned() };
        let lines = lines(&[remark("light \"größer\"", Fate::Kept), remark("scene", Fate::Changed)]);
        assert_eq!(lines, ["kept     light \"größer\"  what", "changed  scene           what"], "aligned");
    }
}
