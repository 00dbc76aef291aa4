//! One board: build, run, compare.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, ensure};

use crate::board::{Board, Output};
use crate::picture::Picture;
use crate::program::Program;
use crate::record::{Figures, Outcome, Record};
use crate::toolchain::{self, Toolchain};
use crate::{emulator, host, png};

/// What is to be done with one board.
#[derive(Debug)]
pub(crate) struct Session<'a> {
    pub(crate) board: &'a Board,
    pub(crate) picture: Picture,
    /// Where the board's picture goes.
    pub(crate) picture_file: Option<PathBuf>,
    pub(crate) timeout: Duration,
}

impl Session<'_> {
    /// Does it, and says how it goes.
    pub(crate) fn run(&self) -> Record {
        let outcome = match self.toolchain() {
            Err(reason) => Outcome::Skipped(reason),
            Ok(toolchain) => match self.measure(&toolchain) {
                Ok(figures) => Outcome::Ran(figures),
                Err(error) => Outcome::Failed(format!("{error:#}")),
            },
        };
        let record = Record::new(self.board, &self.picture, outcome);
        self.say(record.status());
        record
    }

    /// The compiler, if everything is there that the board needs; else what is missing, in one line.
    fn toolchain(&self) -> Result<Toolchain, String> {
        let size = self.picture.size;
        if let Output::Panel(panel) = self.board.output
            && (size.width > panel.width || size.height > panel.height || !size.width.is_multiple_of(2))
        {
            return Err(format!("its panel shows at most {panel}, and only even widths"));
        }
        let emulator = self.board.emulator;
        if !toolchain::is_on_path(emulator.command) {
            return Err(format!("no {}: run `apt install {}`", emulator.command, emulator.package));
        }
        Toolchain::find(self.board.target)
    }

    fn measure(&self, toolchain: &Toolchain) -> Result<Figures> {
        let Self { board, picture, .. } = self;
        self.say("building (the first time takes a minute)");
        let file = toolchain.program(board, picture)?;
        let program = Program::read(&file)?;
        ensure!(program.panics.is_empty(), "the program holds panics: {}", program.panics.join(", "));

        self.say("running");
        let (report, bytes) = emulator::run(board, &file, picture.size, self.timeout)?;
        if let Some(file) = &self.picture_file {
            png::write(file, picture.size, board.output, &bytes)?;
        }
        let expected = host::render(picture, board.output)?;
        let figures = Figures {
            instructions: report.instructions,
            digest: report.digest,
            host_digest: host::digest(&expected),
            pixels_differ: different_pixels(&bytes, &expected, picture.size.pixels())?,
            text_bytes: program.text_bytes,
            static_ram_bytes: program.static_ram_bytes,
            stack_bytes: report.stack_bytes,
        };
        Ok(figures)
    }

    fn say(&self, what: impl std::fmt::Display) {
        eprintln!("{}: {what}", self.board.name);
    }
}

/// How many pixels of a board's picture are not those of the host's.
fn different_pixels(bytes: &[u8], expected: &[u8], pixels: usize) -> Result<usize> {
    ensure!(
        bytes.len() == expected.len(),
        "the board's picture has {} bytes, not {}",
        bytes.len(),
        expected.len()
    );
    let pixel_bytes = expected.len() / pixels;
    Ok(bytes.chunks(pixel_bytes).zip(expected.chunks(pixel_bytes)).filter(|(a, b)| a != b).count())
}
