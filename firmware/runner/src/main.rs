//! `cargo boards`: builds the program for each board, runs it in the board's emulator, and checks it against
//! this computer.

mod bench;
mod board;
mod calls;
mod emulator;
mod gallery;
mod host;
mod picture;
mod png;
mod profile;
mod program;
mod proof;
mod qemu;
mod qmp;
mod quality;
mod record;
mod request;
mod rp2040js;
mod screen;
mod session;
mod table;
mod timing;
mod toolchain;

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

use anyhow::{Context, Result, anyhow, ensure};
use clap::Parser;
use clap::builder::PossibleValuesParser;

use crate::board::{BOARDS, Board};
use crate::picture::{Mode, Number, Size};
use crate::request::Request;

/// Renders a scene on emulated boards, and checks picture, panics and sizes against this computer.
///
/// Without a name, all boards are run for which there is a compiler and an emulator.
#[derive(Debug, Parser)]
#[command(name = "cargo boards", bin_name = "cargo boards")]
struct Arguments {
    /// Boards to run.
    #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(BOARDS.iter().map(|board| board.name)))]
    boards: Vec<String>,

    /// The scene to render: the name of a built-in one, or a .rayline file that `rayline convert` wrote.
    #[arg(long, default_value = "classic")]
    scene: String,

    /// Size of the picture, such as 320x240; by default as large as the board can render in a second or so.
    #[arg(long, value_name = "WxH")]
    size: Option<Size>,

    /// How often light may be mirrored or refracted; by default as often as the scene is meant to be seen.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(..=i64::from(rayline::limits::MAX_BOUNCES)))]
    bounces: Option<u8>,

    /// The number system to compute in; the Pico's program always computes in fixed point.
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    number: Number,

    /// How to draw.
    #[arg(long, value_name = "MODE", default_value = "exact")]
    mode: Mode,

    /// Leaves out of the program what only makes exact pictures faster: the same picture, with less flash and
    /// stack.
    #[arg(long)]
    small: bool,

    /// Writes the board's picture; with several boards, the name of each is added to the file's.
    #[arg(long, value_name = "FILE.png")]
    picture: Option<PathBuf>,

    /// Writes what was measured: sizes, instructions, rays, and the PSNR of the picture in 8-bit sRGB, of a
    /// realtime one against the exact one in the same number system, of an exact one in fixed point against
    /// f64.
    #[arg(long, value_name = "FILE.json")]
    json: Option<PathBuf>,

    /// Fails if a board cannot be run here.
    #[arg(long)]
    all_required: bool,

    /// How long an emulator may take; with --gallery, for one scene.
    #[arg(long, value_name = "SECONDS", default_value = "120", value_parser = clap::value_parser!(u64).range(1..))]
    timeout: u64,

    /// Shows instead that the check for panics can fail: that a program with a panic does not link, and that
    /// its panic is found if it does.
    #[arg(long, conflicts_with_all = ["picture", "json"])]
    prove_no_panic: bool,

    /// Shows which functions a board's instructions go to, and which lines, for this scene, number and mode,
    /// and on the Pico their cycles; the picture has 80x60 pixels if no --size is given.
    #[arg(long, value_name = "NAME", conflicts_with_all = ["boards", "picture", "json", "prove_no_panic"], value_parser = PossibleValuesParser::new(BOARDS.iter().map(|board| board.name)))]
    profile: Option<String>,

    /// Draws instead all .ron scenes of a folder, docs/gallery if none is given, in one run of one program
    /// that reads their bytes; compares the digests of their pictures, 24x18 if no --size is given. With
    /// --all-required it fails as well if a board has no room for a scene.
    #[arg(long, value_name = "DIR", num_args = 0..=1, require_equals = true, default_missing_value = "docs/gallery", conflicts_with_all = ["scene", "picture", "json", "prove_no_panic", "profile", "bench"])]
    gallery: Option<PathBuf>,

    /// Measures what each kind of processor takes, and prints the tables with the targets.
    #[arg(long, conflicts_with_all = ["boards", "scene", "size", "bounces", "number", "mode", "small", "picture", "json", "prove_no_panic", "profile"])]
    bench: bool,

    /// Writes what `--bench` measured to firmware/boards.json.
    #[arg(long, requires = "bench")]
    update: bool,

    /// Fails if instructions or flash have risen by more than 2 % over firmware/boards.json. That holds for
    /// one compiler, which it names; with another, nothing is compared.
    #[arg(long, requires = "bench", conflicts_with = "update")]
    check: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match run(&arguments) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("cargo boards: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Runs all boards; tells whether none failed.
fn run(arguments: &Arguments) -> Result<bool> {
    let timeout = Duration::from_secs(arguments.timeout);
    if arguments.bench {
        let action = match (arguments.update, arguments.check) {
            (true, _) => bench::Action::Update,
            (_, true) => bench::Action::Check,
            _ => bench::Action::Show,
        };
        return bench::run(action, timeout, arguments.all_required);
    }
    ensure!(
        !arguments.small || arguments.mode == Mode::Exact,
        "--small is for exact pictures: realtime quality needs to know where objects are seen"
    );
    let boards = chosen(arguments);
    let Arguments { size, bounces, number, mode, small, .. } = *arguments;
    let request = Request { size, bounces, number, mode, small, ..Request::new(&arguments.scene)? };
    if !arguments.boards.is_empty() {
        // Asked for by name, it is no board to skip.
        for board in &boards {
            board.draws(mode).map_err(|reason| anyhow!("{}: {reason}", board.name))?;
        }
    }
    if let Some(board) = arguments.profile.as_ref().and_then(|name| find(name)) {
        board.draws(mode).map_err(|reason| anyhow!("{}: {reason}", board.name))?;
        let picture = Request { size: size.or(Some(profile::SIZE)), ..request }.on(board);
        profile::run(board, picture, timeout)?;
        return Ok(true);
    }
    if let Some(folder) = &arguments.gallery {
        return gallery::run(&boards, folder, &request, timeout, arguments.all_required);
    }
    if arguments.prove_no_panic {
        return proof::prove(&boards, &request, arguments.all_required);
    }
    if arguments.boards.is_empty() {
        for board in &boards {
            eprintln!("{:<12}  {:<10}  {}", board.name, board.core, board.description);
        }
        eprintln!();
    }
    let mut records = Vec::new();
    for board in &boards {
        let session = session::Session {
            board,
            picture: request.on(board),
            picture_file: arguments.picture.as_ref().map(|file| png::file_for(file, board, boards.len())),
            timeout,
        };
        records.push(session.run());
    }
    print!("{}", record::table(&records));
    for pace in records.iter().filter_map(record::Record::pace) {
        println!("{pace}");
    }
    if let Some(file) = &arguments.json {
        let json = serde_json::to_string_pretty(&records)? + "\n";
        fs::write(file, json).with_context(|| file.display().to_string())?;
    }
    Ok(records.iter().all(|record| record.is_accepted(arguments.all_required)))
}

/// The boards that were named, in the order of the names; if there is none, all that there are, and for the
/// gallery all that can read scenes.
fn chosen(arguments: &Arguments) -> Vec<&'static Board> {
    match (&*arguments.boards, &arguments.gallery) {
        ([], None) => BOARDS.iter().filter(|board| !board.stands_in).collect(),
        ([], Some(_)) => BOARDS.iter().filter(|board| gallery::can_run(board)).collect(),
        (names, _) => names.iter().filter_map(|name| find(name)).collect(),
    }
}

fn find(name: &str) -> Option<&'static Board> {
    BOARDS.iter().find(|board| board.name == name)
}
