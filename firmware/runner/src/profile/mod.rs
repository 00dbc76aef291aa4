//! `cargo boards --profile`: the folders, functions and lines that the instructions of a board's program go
//! to.
//!
//! QEMU logs every instruction that it executes; the profile has those between the two functions that start
//! and stop the program's own count. rp2040js counts instructions and cycles of whole frames. The program's
//! line tables attribute instructions to functions, with inlined ones. Line tables change no instruction, so
//! the total is the count of `cargo boards`.

mod costs;
mod line_tables;
mod memory_access;

mod trace;

use std::fs;
use std::time::Duration;

use anyhow::{Context, Result, anyhow};
use object::{Object, ObjectSection};

use crate::board::{Board, EmulatorKind};
use crate::picture::{Picture, Size};
use crate::session::Session;
use crate::{emulator, qemu};
use costs::Costs;
use line_tables::LineTables;
use memory_access::touches_memory;

use trace::{Marks, Trace};

/// Default size of the picture. It is small, because QEMU logs a line of text for every instruction.
pub(crate) const SIZE: Size = Size { width: 80, height: 60 };

/// Builds a board's program with line tables, traces it, and prints the profile.
pub(crate) fn run(board: &'static Board, picture: Picture, timeout: Duration) -> Result<()> {
    let session = Session::new(board, picture, timeout);
    let toolchain = session.toolchain().map_err(|reason| anyhow!("{}: {reason}", board.name))?;
    eprintln!("{}: building {picture} with line tables (the first time takes a minute)", board.name);
    let file = toolchain.program_with_lines(board, &picture)?;
    let bytes = fs::read(&file).with_context(|| file.display().to_string())?;
    let elf = object::File::parse(&*bytes)?;

    eprintln!("{}: running, one instruction at a time", board.name);
    let trace = match board.emulator {
        EmulatorKind::Qemu { command, machine, .. } => {
            Trace::of_qemu(qemu::command(command, machine, &file), &Marks::find(&elf)?, timeout)?
        }
        EmulatorKind::Rp2040js { frames } => {
            Trace::of_frames(&emulator::profile(board, &file, timeout)?, frames)?
        }
    };

    let source = LineTables::read(&elf)?;
    let code: Vec<(u64, &[u8])> =
        elf.sections().filter_map(|section| Some((section.address(), section.data().ok()?))).collect();
    let mut report = Costs::default();
    for (address, executed) in trace.counts() {
        let instruction = code.iter().find_map(|(start, data)| {
            let offset = usize::try_from(address.checked_sub(*start)?).ok()?;
            data.get(offset..offset + 4).or(data.get(offset..offset + 2))
        });
        let touches_memory =
            instruction.is_some_and(|instruction| touches_memory(elf.architecture(), instruction));
        report.add(&source.places(address)?, executed, touches_memory);
    }
    print!("{}", report.tables(picture.size.pixels()));
    Ok(())
}
