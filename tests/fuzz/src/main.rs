//! Searches for broken promises by hand, and replays what was found.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, Subcommand};
use rayline_fuzz::{Counts, Found, Search, Target, Until, replay};

/// Searches for scenes whose picture changes with acceleration, and for panics.
#[derive(Debug, Parser)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Bytes of scenes, changed at random
    SceneBytes(Options),
    /// Scenes put together from all shapes
    Structured(Options),
    /// Files of all formats, changed at random
    #[cfg(feature = "importers")]
    Importers(Options),
    /// All of these, one after the other; each for an equal part of the time
    All(Options),
    /// Draws the scenes of these files as the names of the files say
    Replay {
        /// Files that a search wrote
        files: Vec<PathBuf>,
    },
}

#[derive(Clone, Debug, clap::Args)]
struct Options {
    /// How long to search
    #[arg(long, default_value_t = 60.0)]
    minutes: f64,
    /// How many executions to make at most
    #[arg(long, default_value_t = u64::MAX)]
    executions: u64,
    /// After how many findings to stop
    #[arg(long, default_value_t = 20)]
    findings: u64,
    /// The seed of the first execution; each of the others is one more
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// A directory of more scenes to change
    #[arg(long)]
    seeds: Vec<PathBuf>,
    /// Where to write findings
    #[arg(long, default_value = "target/fuzz")]
    out: PathBuf,
}

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::SceneBytes(options) => search(&[Target::SceneBytes], &options),
        Command::Structured(options) => search(&[Target::Structured], &options),
        #[cfg(feature = "importers")]
        Command::Importers(options) => search(&[Target::Importers], &options),
        Command::All(options) => search(Target::ALL, &options),
        Command::Replay { files } => replay_all(&files),
    };
    match result {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}

/// Searches with these targets; tells whether everything held.
fn search(targets: &[Target], options: &Options) -> Result<bool, String> {
    let mut holds = true;
    for target in targets {
        let mut search = Search::new(*target, &options.seeds).map_err(|error| error.to_string())?;
        let time = Duration::from_secs_f64(options.minutes.max(0.0) * 60.0 / targets.len() as f64);
        let mut counts = Counts::default();
        // A part after the other, so that somebody who waits sees how far it is.
        while counts.time < time
            && counts.executions < options.executions
            && counts.findings < options.findings
        {
            let until = Until {
                time: (time - counts.time).min(Duration::from_secs(60)),
                executions: options.executions - counts.executions,
                findings: options.findings - counts.findings,
            };
            let seed = options.seed.wrapping_add(counts.executions);
            counts.add(&search.run(seed, until, |found| report(found, options)));
            eprintln!("{} minutes: {} executions", counts.time.as_secs() / 60, counts.executions);
        }
        println!("{}: {counts}", target.name());
        holds &= counts.findings == 0;
    }
    Ok(holds)
}

/// Writes a finding to a file, and prints the command that replays it.
fn report(found: &Found, options: &Options) {
    let (target, seed, finding) = (found.target, found.seed, &found.finding);
    println!("{} of {target}, seed {seed}: {finding} ({})", finding.word(), found.contents);
    match found.write(&options.out) {
        Ok(path) if found.scene.is_some() => {
            println!("    cargo run -p rayline-fuzz -- replay {}", path.display());
        }
        Ok(path) => println!("    cargo run -- check {}", path.display()),
        Err(error) => println!("    cannot write to {}: {error}", options.out.display()),
    }
}

/// Replays these files; tells whether everything held.
fn replay_all(files: &[PathBuf]) -> Result<bool, String> {
    let mut holds = true;
    for file in files {
        let (case, contents, result) = replay(file)?;
        match result {
            Ok(held) => println!("{}: {held:?} as {case} ({contents})", file.display()),
            Err(finding) => {
                holds = false;
                println!("{}: {} as {case}: {finding} ({contents})", file.display(), finding.word());
            }
        }
    }
    Ok(holds)
}
