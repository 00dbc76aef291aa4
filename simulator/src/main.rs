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
        // Whoever reads the output has seen enough.
        Err(error) if is_broken_pipe(&*error) => ExitCode::SUCCESS,
        Err(error) => {
            // One line, whatever the names of files hold.
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
    error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
