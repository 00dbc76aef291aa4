//! One board: build, run, compare.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, ensure};

use crate::board::{Board, EmulatorKind, Output};
use crate::picture::{Picture, Size};
use crate::program::Program;
use crate::quality::Quality;
use crate::record::{Figures, Outcome, Record};
use crate::toolchain::{self, Toolchain};
use crate::{emulator, host, png, rp2040js};

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
    pub(crate) fn toolchain(&self) -> Result<Toolchain, String> {
        self.board.draws(self.picture.mode)?;
        let size = self.picture.size;
        let fits = |panel: Size| size.width <= panel.width && size.height <= panel.height;
        match self.board.output {
            Output::Panel(panel) if !fits(panel) || !size.width.is_multiple_of(2) => {
                return Err(format!("its panel shows at most {panel}, and only even widths"));
            }
            Output::Frames(panel) if !fits(panel) => {
                return Err(format!("its panel shows at most {panel}"));
            }
            Output::File | Output::Panel(_) | Output::Frames(_) => {}
        }
        match self.board.emulator {
            EmulatorKind::Qemu { command, package, .. } if !toolchain::is_on_path(command) => {
                return Err(format!("no {command}: run `apt install {package}`"));
            }
            EmulatorKind::Qemu { .. } => {}
            EmulatorKind::Rp2040js { .. } => rp2040js::install()?,
        }
        Toolchain::find(self.board.target)
    }

    fn measure(&self, toolchain: &Toolchain) -> Result<Figures> {
        let Self { board, picture, .. } = self;
        self.say("building (the first time takes a minute)");
        let file = toolchain.program(board, picture)?;
        let program = Program::read(&file, board.program)?;
        program.check()?;

        self.say("running");
        let (report, bytes) = emulator::run(board, &file, picture.size, self.timeout)?;
        if let Some(file) = &self.picture_file {
            png::write(file, picture.size, board.output, &bytes)?;
        }
        let expected = host::render(board, picture)?;
        let quality = Quality::of(picture)?;
        let figures = Figures {
            instructions: report.instructions,
            digest: report.digest.unwrap_or_else(|| host::digest(&bytes)),
            host_digest: host::digest(&expected),
            pixels_differ: different_pixels(&bytes, &expected, board.output.pixel_bytes())?,
            text_bytes: program.text_bytes,
            static_ram_bytes: program.static_ram_bytes,
            stack_bytes: report.stack_bytes,
            timing: report.timing,
            rays: quality.rays,
            psnr_db: quality.psnr_db,
        };
        Ok(figures)
    }

    fn say(&self, what: impl std::fmt::Display) {
        eprintln!("{}: {what}", self.board.name);
    }
}

/// How many pixels of a board's picture are not those of the host's.
fn different_pixels(bytes: &[u8], expected: &[u8], pixel_bytes: usize) -> Result<usize> {
    ensure!(
        bytes.len() == expected.len(),
        "the board's picture has {} bytes, not {}",
        bytes.len(),
        expected.len()
    );
    Ok(bytes.chunks(pixel_bytes).zip(expected.chunks(pixel_bytes)).filter(|(a, b)| a != b).count())
}
