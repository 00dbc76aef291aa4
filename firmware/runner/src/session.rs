//! One picture on one board: build the program, run it, compare the picture.

use std::fs;
use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Result, ensure};

use crate::board::{Board, EmulatorKind, Output};
use crate::picture::{Picture, Size};
use crate::program::Program;
use crate::quality::Quality;
use crate::record::{Figures, NoPicture, Record};
use crate::toolchain::{self, Compilation, Toolchain};
use crate::{emulator, host, png, rp2040js};

/// One picture on one board.
#[derive(Debug)]
pub(crate) struct Session<'a> {
    pub(crate) board: &'a Board,
    pub(crate) picture: Picture,
    pub(crate) compilation: Compilation,
    /// The file that the board's picture is written to.
    pub(crate) picture_file: Option<PathBuf>,
    pub(crate) timeout: Duration,
}

/// A program that was built.
#[derive(Debug)]
pub(crate) struct BuiltProgram {
    file: PathBuf,
    program: Program,
}

impl BuiltProgram {
    /// A copy of the program in another file, which no other build overwrites.
    pub(crate) fn copied_to(self, file: PathBuf) -> Result<Self, NoPicture> {
        match fs::copy(&self.file, &file) {
            Ok(_) => Ok(Self { file, ..self }),
            Err(error) => Err(NoPicture::Failed(format!("{}: {error}", file.display()))),
        }
    }
}

impl<'a> Session<'a> {
    /// With a program that is compiled for speed, and without a file for its picture.
    pub(crate) fn new(board: &'a Board, picture: Picture, timeout: Duration) -> Self {
        Self { board, picture, compilation: Compilation::FAST, picture_file: None, timeout }
    }
}

impl Session<'_> {
    /// Builds and runs the program, and prints the progress.
    pub(crate) fn run(&self) -> Record {
        self.run_built(self.build())
    }

    /// Builds the program.
    ///
    /// # Errors
    /// The board is skipped if its emulator or compiler is missing, or its panel is too small for the
    /// picture; it fails if the program does not link or holds panics.
    pub(crate) fn build(&self) -> Result<BuiltProgram, NoPicture> {
        let toolchain = self.toolchain().map_err(NoPicture::Skipped)?;
        self.say("building (the first time takes a minute)");
        let build = || {
            let file = toolchain.program(self.board, &self.picture, self.compilation)?;
            let program = Program::read(&file, self.board.program)?;
            program.check()?;
            Ok(BuiltProgram { file, program })
        };
        build().map_err(NoPicture::failed)
    }

    /// Runs a program that [`build`](Self::build) returned.
    pub(crate) fn run_built(&self, program: Result<BuiltProgram, NoPicture>) -> Record {
        let measure = |program: BuiltProgram| self.measure(&program).map_err(NoPicture::failed);
        let record = Record::new(self.board, &self.picture, program.and_then(measure));
        self.say(record.status());
        record
    }

    /// The compiler, if the board can be run here.
    ///
    /// # Errors
    /// The reason why it cannot, and what to install, in one line.
    pub(crate) fn toolchain(&self) -> Result<Toolchain, String> {
        self.board.draws(self.picture.mode)?;
        let size = self.picture.size;
        let fits = |panel: Size| size.width <= panel.width && size.height <= panel.height;
        match self.board.output {
            Output::Panel(panel) if !fits(panel) || !size.width.is_multiple_of(2) => {
                return Err(format!(
                    "its panel shows at most {panel}, and only even widths: choose another --size"
                ));
            }
            Output::Frames(panel) if !fits(panel) => {
                return Err(format!("its panel shows at most {panel}: choose a smaller --size"));
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

    /// Runs the program, and compares its picture with the host's.
    fn measure(&self, BuiltProgram { file, program }: &BuiltProgram) -> Result<Figures> {
        let Self { board, picture, .. } = self;
        self.say("running");
        let (report, bytes) = emulator::run(board, file, picture.size, self.timeout)?;
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

/// The number of pixels that differ between a board's picture and the host's.
fn different_pixels(bytes: &[u8], expected: &[u8], pixel_bytes: usize) -> Result<usize> {
    ensure!(
        bytes.len() == expected.len(),
        "the board's picture has {} bytes, and the host's has {}",
        bytes.len(),
        expected.len()
    );
    Ok(bytes.chunks(pixel_bytes).zip(expected.chunks(pixel_bytes)).filter(|(a, b)| a != b).count())
}
