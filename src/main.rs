//! Parse, run, print one error, exit.

use std::process::ExitCode;

use softbox::cli;

fn main() -> ExitCode {
    env_logger::init();
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
