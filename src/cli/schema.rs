//! `softbox schema`: the scene format for editors and validators.

use std::io::Write;

use super::Outcome;
use crate::scene;

/// Print the JSON Schema of scene files.
pub(super) fn run() -> anyhow::Result<Outcome> {
    writeln!(std::io::stdout(), "{:#}", scene::schema())?;
    Ok(Outcome::Done)
}
