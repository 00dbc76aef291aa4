//! The program `rayline`: see `rayline --help`.

mod cli;
mod commands;

use std::error::Error;
use std::io;
use std::process::ExitCode;

use clap::Parser;

fn main() -> ExitCode {
    match commands::run(cli::Cli::parse_from(cli::arguments())) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of the output has closed the pipe: that is no failure.
        Err(error) if is_broken_pipe(&*error) => ExitCode::SUCCESS,
        Err(error) => {
            // Names of files may hold control characters: replace them, so that the message stays on one
            // line.
            let message: String = error
                .to_string()
                .chars()
                .map(|character| if character.is_control() { '\u{fffd}' } else { character })
                .collect();
            eprintln!("rayline: {message}");
            ExitCode::FAILURE
        }
    }
}

fn is_broken_pipe(error: &(dyn Error + 'static)) -> bool {
    core::iter::successors(Some(error), |&error| error.source())
        .filter_map(|error| error.downcast_ref::<io::Error>())
        .any(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
