//! `cargo boards --bench`: instructions, flash and RAM on each kind of processor.

mod allowances;
mod committed;
mod desktop;
pub(crate) mod effects;
mod entries;
mod measured;
mod report;
pub(crate) mod sizes;
mod tables;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, ensure};

use crate::board::Board;
use crate::convert;
use crate::record::Record;
use crate::session::Session;
use crate::table::Table;
use crate::toolchain::Toolchain;
use committed::Committed;
use entries::{Entry, M4F, OF_GALLERY, entries};
use measured::{Measured, Measurements};
use report::Page;

/// The use of the figures, besides printing them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    Show,
    /// Writes `firmware/boards.json`.
    Update,
    /// Compares the figures with `firmware/boards.json` and with the allowances.
    Check,
}

/// The options of a bench.
#[derive(Debug)]
pub(crate) struct Bench<'a> {
    pub(crate) action: Action,
    /// The page to write.
    pub(crate) report: Option<&'a Path>,
    /// The boards to measure on; all if this is empty.
    pub(crate) boards: &'a [&'static Board],
    pub(crate) timeout: Duration,
    /// Whether a board that cannot be run here is a failure.
    pub(crate) all_required: bool,
}

impl Bench<'_> {
    /// Measures the programs, and prints the tables; returns whether nothing failed.
    pub(crate) fn run(&self) -> Result<bool> {
        let folder = tempfile::tempdir()?;
        let sessions = self.sessions(folder.path())?;
        let records = measure(&sessions, folder.path())?;
        let measured: Vec<Measured> = records.iter().filter_map(Measured::of).collect();
        let figures = Measurements(&measured);
        for (heading, table) in tables::all(figures) {
            println!("{heading}:\n\n{table}");
        }
        let accepted = records.iter().all(|record| record.is_accepted(self.all_required));
        let complete = accepted && measured.len() == sessions.len();
        let mut holds = accepted;
        match self.action {
            Action::Show => {}
            Action::Update => {
                ensure!(complete, "firmware/boards.json stays as it is: not every program ran, see above");
                Committed::updated(compiler()?, &measured, self.boards.is_empty())?.write()?;
            }
            Action::Check if measured.is_empty() => {}
            Action::Check => {
                holds &= Committed::read()?.check(&compiler()?, &measured);
                for line in allowances::broken(figures) {
                    eprintln!("beyond an allowance (firmware/runner/src/bench/allowances.rs): {line}");
                    holds = false;
                }
            }
        }
        if let Some(file) = self.report {
            ensure!(complete, "{} stays as it is: not every program ran, see above", file.display());
            let page = Page::read(file).with_desktop(desktop::measure()?);
            page.with_boards(figures, &compiler()?).write(file)?;
        }
        Ok(holds)
    }

    /// The programs to measure.
    fn sessions(&self, folder: &Path) -> Result<Vec<Session<'static>>> {
        let is_chosen = |entry: &Entry| {
            self.boards.is_empty() || self.boards.iter().any(|board| board.name == entry.board)
        };
        let entries: Vec<Entry> = entries().into_iter().filter(is_chosen).collect();
        let mut files = Vec::new();
        if entries.iter().any(|entry| OF_GALLERY.contains(&entry.scene)) {
            let sources = OF_GALLERY.map(|scene| gallery().join(scene).with_extension("ron"));
            files = convert::to_bytes(&sources, folder)?;
        }
        entries.iter().map(|entry| entry.session(&files, self.timeout)).collect()
    }
}

/// Writes the part of a page that `firmware/boards.json` holds, without measuring.
pub(crate) fn write_report(file: &Path) -> Result<()> {
    let Committed { compiler, measured } = Committed::read()?;
    Page::read(file).with_boards(Measurements(&measured), &compiler).write(file)
}

/// Builds one program while the one before runs: there is one emulator at a time, and one compiler.
fn measure(sessions: &[Session<'_>], folder: &Path) -> Result<Vec<Record>> {
    let (sender, built) = mpsc::sync_channel(1);
    thread::scope(|scope| {
        scope.spawn(move || {
            for (index, session) in sessions.iter().enumerate() {
                eprintln!("{} of {}: {}", index + 1, sessions.len(), session.picture);
                let program = session.build().and_then(|program| {
                    // The next build overwrites the file.
                    program.copied_to(folder.join(format!("program-{index}")))
                });
                if sender.send((session, program)).is_err() {
                    break;
                }
            }
        });
        Ok(built.into_iter().map(|(session, program)| session.run_built(program)).collect())
    })
}

/// Measures programs, which must all run and draw the right pictures.
fn measure_all(sessions: &[Session<'_>], folder: &Path) -> Result<Vec<Measured>> {
    let measured: Vec<Measured> = measure(sessions, folder)?.iter().filter_map(Measured::of).collect();
    ensure!(measured.len() == sessions.len(), "not every program ran, or a picture differs");
    Ok(measured)
}

/// The mark in the head of each page that a command writes.
const MARK: &str = "A command writes this page";

/// Refuses a file that would be overwritten, and that no command wrote.
pub(crate) fn check_page(file: &Path) -> Result<()> {
    // A device, such as standard output, loses nothing; to read it could wait for ever.
    if file.is_file() {
        let page = fs::read(file).with_context(|| file.display().to_string())?;
        ensure!(
            String::from_utf8_lossy(&page).contains(MARK),
            "{} was not written by `cargo boards`, and would be overwritten: name another file",
            file.display()
        );
    }
    Ok(())
}

/// Prints a table, and writes it as a page of its own.
fn write_page(file: &Path, head: &str, table: &Table) -> Result<()> {
    println!("{table}");
    let page = format!("{head}\nThe compiler is {}.\n\n{table}", compiler()?);
    fs::write(file, page).with_context(|| file.display().to_string())
}

/// The folder of the gallery's scenes.
fn gallery() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/gallery")
}

/// The compiler of the programs, which is the same for all boards.
fn compiler() -> Result<String> {
    Toolchain::find(Board::named(M4F)?.target).map_err(|reason| anyhow!(reason))?.name()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_of_people_are_not_overwritten() {
        let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
        for page in ["benchmarks.md", "effects.md", "sizes.md", "a-new-page.md"] {
            check_page(&docs.join(page)).unwrap();
        }
        let error = check_page(&docs.join("../README.md")).unwrap_err().to_string();
        assert!(error.contains("README.md was not written by `cargo boards`"), "{error}");
    }
}
