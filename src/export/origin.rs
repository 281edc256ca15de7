//! Who made a file, and of what: every file that leaves the program says so in the way of its format.

use super::job::one_line;

/// What a file was made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin<'a> {
    /// The name of the scene's file, or of whatever else it shows.
    pub scene: &'a str,
}

/// The program, with its version.
pub(super) const PROGRAM: &str = concat!("Softbox ", env!("CARGO_PKG_VERSION"));

impl Origin<'_> {
    /// The program and the scene, on one line.
    pub fn line(self) -> String {
        format!("{PROGRAM}, scene {}", one_line(self.scene))
    }
}
