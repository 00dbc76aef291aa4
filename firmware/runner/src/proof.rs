//! Shows that programs with all sets of features hold no panic, and that this check can fail, with twins of
//! the program that hold a panic.

use std::path::Path;

use anyhow::{Context, Result, ensure};

use crate::board::Board;
use crate::gallery;
use crate::picture::{Mode, Picture};
use crate::program::Program;
use crate::request::Request;
use crate::toolchain::{Built, Compilation, LEVELS, PANIC, Toolchain};

/// All features of the core that change pictures, or make them faster.
const ALL: &[&str] =
    &["candidates", "distributed", "hierarchy", "looks", "optics", "path-tracing", "textures"];

/// Builds the program of each board at all levels of optimization, or only at some, and its twins. Returns
/// whether no required board was skipped.
pub(crate) fn prove(
    boards: &[&Board],
    request: &Request,
    levels: &[String],
    all_required: bool,
) -> Result<bool> {
    let mut complete = true;
    for board in boards {
        match Toolchain::find(board.target) {
            Ok(toolchain) => prove_on(board, request, levels, &toolchain)?,
            Err(reason) => {
                println!("{}: skipped: {reason}", board.name);
                complete = false;
            }
        }
    }
    Ok(complete || !all_required)
}

fn prove_on(board: &Board, request: &Request, only: &[String], toolchain: &Toolchain) -> Result<()> {
    let name = board.name;
    let picture = request.on(board);

    let read = |file: &Path| Program::read(file, board.program);
    let is_meant = |level: &&str| only.is_empty() || only.iter().any(|one| one == level);
    let meant: Vec<&'static str> = LEVELS.into_iter().filter(is_meant).collect();
    let levels = meant.join(", ");
    let check = |board: &Board, picture: &Picture, features: &'static [&'static str]| -> Result<()> {
        // A compiler may keep a panic at one level that it removes at another one.
        for &level in &meant {
            eprintln!("{name}: building {} at level {level}", board.program.binary);
            // The core library is at level 3 in all, and is built once.
            let program =
                toolchain.program(board, picture, Compilation { level, features, ..Compilation::FAST });
            let checked = program.and_then(|file| read(&file)?.check());
            checked.with_context(|| format!("{name}, level {level}"))?;
        }
        Ok(())
    };
    if board.program.has_hal {
        check(board, &picture, &[])?;
        println!("{name}: at levels {levels} the program links, and rendering reaches no panic");
    } else {
        if picture.mode == Mode::Exact {
            check(board, &Picture { small: true, ..picture }, &[])?;
        }
        check(board, &picture, &[])?;
        check(board, &picture, ALL)?;
        println!(
            "{name}: at levels {levels}, without features that make it faster, with those that its scene \
             needs, and with all, the program links, and none of its symbols is that of a panic"
        );
        if gallery::can_run(board) {
            check(&gallery::with_program(board, false), &picture, ALL)?;
            println!("{name}: the same holds for the program that draws all shapes, from bytes");
        }
        match toolchain.build(board, &picture, Compilation { features: &["twin"], ..Compilation::FAST })? {
            Built::Linked(_) => anyhow::bail!("{name}: a program with a panic links"),
            Built::Refused(reason) => {
                ensure!(reason.contains(PANIC), "{name}: the twin was refused for another reason:\n{reason}");
            }
        }
        println!("{name}: with a panic it does not link, because `{PANIC}` is missing");
    }

    let twin = Compilation { features: &["twin-linked"], ..Compilation::FAST };
    let Built::Linked(file) = toolchain.build(board, &picture, twin)? else {
        anyhow::bail!("{name}: the twin with a common panic handler was not built");
    };
    let panics = read(&file)?.panics;
    ensure!(!panics.is_empty(), "{name}: the panic of the twin was not found");
    println!("{name}: the panic of a twin that links is found: {}", panics.join(", "));
    Ok(())
}
