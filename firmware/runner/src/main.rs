//! `cargo boards`: builds the program of each board, runs it in the board's emulator, and compares its
//! picture with this computer's.

mod arguments;
mod bench;
mod board;
mod calls;
mod convert;
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
use std::process::ExitCode;

use anyhow::{Context, Result, anyhow, bail, ensure};
use clap::Parser;

use crate::arguments::Arguments;
use crate::bench::{Action, Bench};
use crate::board::{BOARDS, Board};
use crate::picture::Mode;
use crate::record::Record;
use crate::request::Request;
use crate::session::Session;

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("cargo boards: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// Does what the arguments say; returns whether nothing failed.
fn run(arguments: &Arguments) -> Result<bool> {
    let pages = [&arguments.report, &arguments.effects, &arguments.sizes];
    pages.into_iter().flatten().try_for_each(|file| bench::check_page(file))?;
    if arguments.bench {
        return bench(arguments);
    }
    if let Some(file) = &arguments.report {
        ensure!(arguments.boards.is_empty(), "--report writes the tables of all boards: leave out the names");
        bench::write_report(file)?;
        return Ok(true);
    }
    if let Some(file) = &arguments.effects {
        return bench::effects::run(file, arguments.timeout()).map(|()| true);
    }
    if let Some(file) = &arguments.sizes {
        return bench::sizes::run(file, arguments.timeout()).map(|()| true);
    }
    let request = request(arguments)?;
    if let Some(name) = &arguments.profile {
        return profile(Board::named(name)?, &request, arguments);
    }
    let boards = chosen(arguments)?;
    if !arguments.boards.is_empty() {
        // A board that was named is not skipped: it fails.
        boards.iter().try_for_each(|board| ensure_draws(board, arguments.mode))?;
    }
    if let Some(folder) = &arguments.gallery {
        return gallery::run(&boards, folder, &request, arguments.timeout(), arguments.all_required);
    }
    if arguments.prove_no_panic {
        return proof::prove(&boards, &request, &arguments.levels, arguments.all_required);
    }
    render(&boards, &request, arguments)
}

/// The picture that the arguments describe.
fn request(arguments: &Arguments) -> Result<Request> {
    let Arguments { size, bounces, number, mode, small, closed_form, .. } = *arguments;
    ensure!(
        !small || mode == Mode::Exact,
        "--small is for exact pictures: use --mode exact, or leave out --small"
    );
    Ok(Request { size, bounces, number, mode, small, closed_form, ..Request::new(&arguments.scene)? })
}

/// Measures all programs of the bench.
fn bench(arguments: &Arguments) -> Result<bool> {
    let action = match (arguments.update, arguments.check) {
        (true, _) => Action::Update,
        (_, true) => Action::Check,
        _ => Action::Show,
    };
    let boards: Vec<&Board> =
        arguments.boards.iter().map(|name| Board::named(name)).collect::<Result<_>>()?;
    let report = arguments.report.as_deref();
    if report.is_some() && !boards.is_empty() {
        bail!("--bench --report measures all boards: leave out their names");
    }
    let (timeout, all_required) = (arguments.timeout(), arguments.all_required);
    Bench { action, report, boards: &boards, timeout, all_required }.run()
}

/// Profiles one board.
fn profile(board: &'static Board, request: &Request, arguments: &Arguments) -> Result<bool> {
    ensure_draws(board, arguments.mode)?;
    let size = arguments.size.or(Some(profile::SIZE));
    profile::run(board, Request { size, ..*request }.on(board), arguments.timeout())?;
    Ok(true)
}

/// Renders the picture on all boards, and prints the results.
fn render(boards: &[&'static Board], request: &Request, arguments: &Arguments) -> Result<bool> {
    if arguments.boards.is_empty() {
        for board in boards {
            eprintln!("{:<12}  {:<10}  {}", board.name, board.core, board.description);
        }
        eprintln!();
    }
    let mut records = Vec::new();
    for board in boards {
        let session = Session {
            picture_file: arguments.picture.as_ref().map(|file| png::file_for(file, board, boards.len())),
            ..Session::new(board, request.on(board), arguments.timeout())
        };
        records.push(session.run());
    }
    print!("{}", record::table(&records));
    for pace in records.iter().filter_map(Record::pace) {
        println!("{pace}");
    }
    if let Some(file) = &arguments.json {
        let json = serde_json::to_string_pretty(&records)? + "\n";
        fs::write(file, json).with_context(|| file.display().to_string())?;
    }
    Ok(records.iter().all(|record| record.is_accepted(arguments.all_required)))
}

/// The boards that were named, in the order of the names. Without a name, all real boards, and for the
/// gallery all boards whose program can read scenes.
fn chosen(arguments: &Arguments) -> Result<Vec<&'static Board>> {
    match (&*arguments.boards, &arguments.gallery) {
        ([], None) => Ok(BOARDS.iter().filter(|board| !board.stands_in).collect()),
        ([], Some(_)) => Ok(BOARDS.iter().filter(|board| gallery::can_run(board)).collect()),
        (names, _) => names.iter().map(|name| Board::named(name)).collect(),
    }
}

fn ensure_draws(board: &Board, mode: Mode) -> Result<()> {
    board.draws(mode).map_err(|reason| anyhow!("{}: {reason}", board.name))
}
