//! Shows that the check for panics can fail, with twins of the program that hold a panic.

use std::path::Path;

use anyhow::{Context, Result, ensure};

use crate::board::Board;
use crate::program::Program;
use crate::request::Request;
use crate::toolchain::{Built, PANIC, Toolchain};

/// The level of optimization for size. At level "z", an assertion of the crate `semihosting` stays in the
/// program.
const SMALL: &str = "s";

/// Builds the program of each board and its twins; returns whether no required board was skipped.
pub(crate) fn prove(boards: &[&Board], request: &Request, all_required: bool) -> Result<bool> {
    let mut complete = true;
    for board in boards {
        match Toolchain::find(board.target) {
            Ok(toolchain) => prove_on(board, request, &toolchain)?,
            Err(reason) => {
                println!("{}: skipped: {reason}", board.name);
                complete = false;
            }
        }
    }
    Ok(complete || !all_required)
}

fn prove_on(board: &Board, request: &Request, toolchain: &Toolchain) -> Result<()> {
    let name = board.name;
    let picture = request.on(board);

    let read = |file: &Path| Program::read(file, board.program);
    // A compiler may keep a panic at one level of optimization that it removes at another one.
    let small = toolchain.program_at(SMALL, board, &picture).and_then(|file| read(&file)?.check());
    small.with_context(|| format!("{name}, opt-level {SMALL:?}"))?;
    read(&toolchain.program(board, &picture)?)?.check().context(name)?;
    if board.program.has_hal {
        println!("{name}: the program links, and no panic can be reached from rendering");
    } else {
        println!("{name}: the program links, and none of its symbols is that of a panic");
        println!("{name}: the same holds at opt-level {SMALL:?}");
        match toolchain.build(board, &picture, &["twin"])? {
            Built::Linked(_) => anyhow::bail!("{name}: a program with a panic links"),
            Built::Refused(reason) => {
                ensure!(reason.contains(PANIC), "{name}: the twin was refused for another reason:\n{reason}");
            }
        }
        println!("{name}: with a panic it does not link, because `{PANIC}` is missing");
    }

    let Built::Linked(file) = toolchain.build(board, &picture, &["twin-linked"])? else {
        anyhow::bail!("{name}: the twin with a common panic handler was not built");
    };
    let panics = read(&file)?.panics;
    ensure!(!panics.is_empty(), "{name}: the panic of the twin was not found");
    println!("{name}: the panic of a twin that links is found: {}", panics.join(", "));
    Ok(())
}
