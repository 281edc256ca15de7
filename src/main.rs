//! Parse, run, print one error, exit.

use std::process::ExitCode;

use softbox::cli;

fn main() -> ExitCode {
    // A driver's complaints are for who asks for them by RUST_LOG.
    env_logger::Builder::from_env(env_logger::Env::default().default_filter_or("error,wgpu_hal=off")).init();
    let outcome = match cli::parse() {
        Ok(arguments) => cli::run(&arguments),
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
