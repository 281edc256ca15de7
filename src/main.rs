//! Parse, run, print one error, exit.

use std::path::Path;
use std::process::ExitCode;

use softbox::cli::{self, Outcome};

fn main() -> ExitCode {
    // A driver's complaints are for who asks for them by RUST_LOG.
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error,wgpu_hal=off")).init();
    let outcome = match cli::parse() {
        Ok(arguments) => cli::run(&arguments, open_editor),
        Err(answer) => answer,
    };
    match outcome {
        Ok(outcome) => outcome.into(),
        Err(error) if cli::is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("softbox: {error:#}");
            ExitCode::from(2)
        }
    }
}

/// Open the editor on a scene, or on a new one.
#[cfg(feature = "gui")]
fn open_editor(scene: Option<&Path>) -> anyhow::Result<Outcome> {
    softbox::editor::run(scene.map(Path::to_owned))?;
    Ok(Outcome::Done)
}

/// Say that there is no editor to open.
#[cfg(not(feature = "gui"))]
fn open_editor(_scene: Option<&Path>) -> anyhow::Result<Outcome> {
    anyhow::bail!("this build has no editor; `softbox --help` lists what it can do")
}
