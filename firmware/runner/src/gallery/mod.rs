//! `cargo boards --gallery`: draws all scenes of a folder on each board with one program, and compares the
//! digest of each picture with this computer's.

mod results;
mod scenes;

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};
use embedded_graphics::pixelcolor::Rgb888;
use embedded_graphics::prelude::RgbColor;
use rayline_build_support::BOUNCES_OF_FILES;

use crate::board::{Board, EmulatorKind, Output, ProgramSource};
use crate::emulator::Emulator;
use crate::host;
use crate::picture::{Mode, Picture, Size};
use crate::program::Program;
use crate::request::Request;
use crate::session::Session;
use crate::toolchain::{Compilation, Toolchain};
use results::{Drawn, Exhibit, TourOutcome, table};
use scenes::Scenes;

/// Default size of the pictures.
const SIZE: Size = Size { width: 24, height: 18 };

/// Boards with 256 KB of flash and little RAM. A program with all shapes fits only without the features that
/// make exact pictures faster.
const LITTLE: [&str; 2] = ["lm3s6965evb", "microbit"];

/// Time between two messages of progress.
const PACE: Duration = Duration::from_secs(5);

/// Draws all scenes of a folder on all boards; returns whether all digests are this computer's.
pub(crate) fn run(
    boards: &[&Board],
    folder: &Path,
    request: &Request,
    timeout: Duration,
    all_required: bool,
) -> Result<bool> {
    for board in boards {
        ensure!(can_run(board), "{}: its program cannot read scenes: leave this board out", board.name);
    }
    let scenes = Scenes::read(folder)?;
    let mut outcomes = Vec::new();
    let mut expected = Vec::new();
    for board in boards {
        let small = request.small || LITTLE.contains(&board.name);
        let picture = Picture {
            size: request.size.unwrap_or(SIZE),
            bounces: request.bounces.unwrap_or(BOUNCES_OF_FILES),
            small,
            ..request.on(board)
        };
        let board = with_program(board, small);
        if expected.is_empty() {
            expected = scenes.digests(&picture)?;
        }
        let tour = Tour { board: &board, picture, scenes: &scenes, expected: &expected, timeout };
        outcomes.push((board.name, board.core, tour.run()));
    }
    println!();
    print!("{}", table(&outcomes));
    for (name, _, outcome) in &outcomes {
        outcome.remarks().for_each(|remark| println!("{name}: {remark}"));
    }
    Ok(outcomes.iter().all(|(_, _, outcome)| outcome.is_accepted(all_required)))
}

/// Whether the board's program can read scenes: in QEMU it reads files of this computer.
pub(crate) fn can_run(board: &Board) -> bool {
    matches!(board.emulator, EmulatorKind::Qemu { .. })
}

/// The board with the program that draws any scene, and has no display.
pub(crate) fn with_program(board: &Board, small: bool) -> Board {
    let features: &'static [&'static str] =
        if small { &["gallery"] } else { &["gallery", "candidates", "hierarchy"] };
    let program = ProgramSource { binary: "gallery", features, ..board.program };
    Board { program, output: Output::File, ..*board }
}

impl Scenes {
    /// The digests of this computer's pictures.
    fn digests(&self, picture: &Picture) -> Result<Vec<u64>> {
        let digest = |scene| {
            let bytes = host::bytes_of_frame(&Picture { scene, ..*picture }, 0, Rgb888::BLACK);
            Ok(host::digest(&bytes.with_context(|| scene.name)?))
        };
        self.sources.iter().copied().map(digest).collect()
    }
}

/// All scenes on one board.
#[derive(Debug)]
struct Tour<'a> {
    board: &'a Board,
    /// Size and settings of each picture; its scene is not used.
    picture: Picture,
    scenes: &'a Scenes,
    /// This computer's digests.
    expected: &'a [u64],
    timeout: Duration,
}

impl Tour<'_> {
    /// Draws the scenes, and prints the progress.
    fn run(&self) -> TourOutcome {
        let Self { board, picture, timeout, .. } = *self;
        let session = Session::new(board, picture, timeout);
        let outcome = match session.toolchain() {
            _ if picture.small && picture.mode != Mode::Exact => TourOutcome::Skipped(
                "its flash is too small for all shapes and realtime quality: use --mode exact".into(),
            ),
            Err(reason) => TourOutcome::Skipped(reason),
            Ok(toolchain) => {
                self.draw(&toolchain).unwrap_or_else(|error| TourOutcome::Failed(format!("{error:#}")))
            }
        };
        self.say(&outcome);
        outcome
    }

    fn draw(&self, toolchain: &Toolchain) -> Result<TourOutcome> {
        self.say(&"building (the first time takes a minute)");
        let file = toolchain.program(self.board, &self.picture, Compilation::FAST)?;
        let program = Program::read(&file, self.board.program)?;
        program.check()?;

        self.say(&"running");
        let count = self.scenes.sources.len();
        let mut said = Instant::now();
        let mut exhibits = Vec::new();
        let files = [("scenes", &*self.scenes.file)];
        let mut emulator = Emulator::start(self.board, &file, &files, self.timeout)?;
        let numbers = emulator.next_report().context("numbers")?.digest;
        ensure!(
            numbers == Some(host::digest_of_numbers(self.picture.number)),
            "its arithmetic differs from this computer's: compare the crate rayline-arithmetic-digest on both"
        );
        for (scene, expected) in self.scenes.sources.iter().zip(self.expected) {
            if said.elapsed() >= PACE {
                self.say(&format_args!("{} of {count} scenes are drawn", exhibits.len()));
                said = Instant::now();
            }
            let report = emulator.next_report().context(scene.name)?;
            exhibits.push(Exhibit {
                scene: scene.name,
                drawn: report.digest.map(|digest| Drawn { digest, stack_bytes: report.stack_bytes }),
                expected: *expected,
                memory_bytes: report.memory_bytes,
            });
        }
        emulator.finish()?;
        Ok(TourOutcome::Ran { picture: self.picture, text_bytes: program.text_bytes, exhibits })
    }

    fn say(&self, what: &dyn std::fmt::Display) {
        eprintln!("{}: {what}", self.board.name);
    }
}
