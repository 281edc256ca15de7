//! The GPU of a build that has none.

use super::Question;
use super::table::Row;

/// A device, which there is none of.
#[derive(Debug)]
pub(super) enum Device {}

impl Device {
    pub(super) fn new() -> anyhow::Result<Self> {
        anyhow::bail!("this build has no GPU preview")
    }

    pub(super) fn rows(&self, _questions: &[Question<'_>]) -> anyhow::Result<Vec<Row>> {
        match *self {}
    }
}
