//! The command line: one file a subcommand, each with its `Args` and a `run`.

mod check;
mod columns;
mod difference;
mod export;
mod figures;
mod files;
mod fit;
mod import;
mod plot;
mod probe;
mod progress;
mod render;
mod report;
mod schema;
mod shadows;
mod sheet;
mod size;
mod verify;

use std::io;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::error::ErrorKind;
use clap::{Parser, Subcommand};

/// How a command ended when nothing went wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Done, or the answer is yes: exit status 0.
    Done,
    /// The answer is no: exit status 1.
    No,
    /// Stopped by Ctrl-C before anything was written: exit status 130.
    Interrupted,
}

impl From<Outcome> for ExitCode {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Done => Self::SUCCESS,
            Outcome::No => Self::from(1),
            Outcome::Interrupted => Self::from(130),
        }
    }
}

/// Design area lights, and see how exact, approximate and point-light shading differ.
///
/// Without a command, opens the editor. Exit status: 0 done, 1 the answer is no, 2 bad use or bad input, 130 stopped
/// by Ctrl-C.
#[derive(Debug, Parser)]
#[command(name = "softbox", version, args_conflicts_with_subcommands = true)]
pub struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
    /// Scene to open in the editor.
    scene: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
enum Command {
    Render(render::Args),
    Difference(difference::Args),
    Plot(plot::Args),
    Probe(probe::Args),
    Report(report::Args),
    Figures(figures::Args),
    Export(export::Args),
    Fit(fit::Args),
    Import(import::Args),
    Sheet(sheet::Args),
    Check(check::Args),
    Verify(verify::Args),
    /// Print the JSON Schema of scene files.
    Schema,
}

/// The arguments of this process, or, when there is nothing to run, how to end: after `--help` and `--version`, or
/// with bad use as an error of one line.
pub fn parse() -> Result<Arguments, anyhow::Result<Outcome>> {
    Arguments::try_parse().map_err(|error| {
        if error.use_stderr() {
            Err(anyhow::Error::msg(one_line(&error)))
        } else {
            error.print().map(|()| Outcome::Done).map_err(Into::into)
        }
    })
}

/// Run what was asked for; without a command, `open_editor` on the scene, if one is named.
pub fn run(
    arguments: &Arguments,
    open_editor: impl FnOnce(Option<&Path>) -> anyhow::Result<Outcome>,
) -> anyhow::Result<Outcome> {
    match &arguments.command {
        Some(Command::Render(args)) => render::run(args),
        Some(Command::Difference(args)) => difference::run(args),
        Some(Command::Plot(args)) => plot::run(args),
        Some(Command::Probe(args)) => probe::run(args),
        Some(Command::Report(args)) => report::run(args),
        Some(Command::Figures(args)) => figures::run(args),
        Some(Command::Export(args)) => export::run(args),
        Some(Command::Fit(args)) => fit::run(args),
        Some(Command::Import(args)) => import::run(args),
        Some(Command::Sheet(args)) => sheet::run(args),
        Some(Command::Check(args)) => check::run(args),
        Some(Command::Verify(args)) => verify::run(args),
        Some(Command::Schema) => schema::run(),
        None => open_editor(arguments.scene.as_deref()),
    }
}

/// Whether an error only says that whoever read our output has stopped reading.
pub fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error
        .chain()
        .filter_map(|cause| cause.downcast_ref::<io::Error>())
        .any(|cause| cause.kind() == io::ErrorKind::BrokenPipe)
}

/// A clap error as one line: its message and tips, without usage.
fn one_line(error: &clap::Error) -> String {
    // What is no command is taken for a scene, and what follows it for a command that goes with none.
    if error.kind() == ErrorKind::ArgumentConflict
        && let Some(scene) = std::env::args().nth(1)
    {
        return format!("`{scene}` is not a command; `softbox --help` lists them");
    }
    let text = error.render().to_string();
    text.split("\n\n")
        .filter(|paragraph| !paragraph.starts_with("Usage:") && !paragraph.starts_with("For more information"))
        .map(|paragraph| paragraph.split_whitespace().collect::<Vec<_>>().join(" "))
        .collect::<Vec<_>>()
        .join("; ")
        .trim_start_matches("error: ")
        .to_owned()
}
