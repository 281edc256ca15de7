//! `softbox check`: are these files right?

use std::io::Write;
use std::path::PathBuf;

use super::Outcome;
use crate::scene::{self, LoadError};

/// Check scene files and light presets.
///
/// Prints every problem with its file, line, column and path. Exit status: 0 all files are right, 1 a file is wrong,
/// 2 a file cannot be read.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Scene files.
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Check each file; what cannot be read ends the run.
pub(super) fn run(args: &Args) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome::Done;
    for file in &args.files {
        match scene::load(file) {
            Ok(_) => {}
            Err(problems @ LoadError::Invalid { .. }) => {
                writeln!(std::io::stdout(), "{problems}")?;
                outcome = Outcome::No;
            }
            Err(unreadable @ LoadError::Read { .. }) => return Err(unreadable.into()),
        }
    }
    Ok(outcome)
}
