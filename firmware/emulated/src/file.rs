//! The main program of boards without a display: the picture goes to a file of the host, as RGB565.

use embedded_graphics::pixelcolor::Rgb565;
use embedded_graphics::pixelcolor::raw::ToBytes;
use embedded_graphics::prelude::RgbColor;
use semihosting::fd::{AsFd, BorrowedFd};
use semihosting::fs::File;
use semihosting::{process, sys};

use crate::picture::{Memory, WIDTH};
use crate::{Fault, InstructionCounter, program, report};

/// Renders the picture into the file `picture` and tells what it took.
pub fn main(counter: impl InstructionCounter) -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut LINE: [Rgb565; WIDTH] = [Rgb565::BLACK; WIDTH];
    let (memory, line) = (&raw mut MEMORY, &raw mut LINE);
    // SAFETY: nothing else can name the two, and a function that does not return is not called again; no interrupt
    // calls it.
    #[allow(unsafe_code)]
    let (memory, line) = unsafe { (&mut *memory, &mut *line) };
    match render(memory, line, &counter) {
        Ok(()) => process::exit(0),
        Err(fault) => report::fail(fault),
    }
}

fn render(
    memory: &mut Memory,
    line: &mut [Rgb565; WIDTH],
    counter: &impl InstructionCounter,
) -> Result<(), Fault> {
    let file = File::create(c"picture").map_err(|_| Fault::Output)?;
    // Borrowed once: borrowing asserts that the file is open, and here the compiler sees that it is.
    let file = file.as_fd();
    program::run(memory, line, counter, |_, line| write(file, line))?.tell()
}

/// Writes a line, in pieces for which the stack has room.
fn write(file: BorrowedFd<'_>, line: &[Rgb565; WIDTH]) -> Result<(), Fault> {
    for piece in line.chunks(32) {
        let mut bytes = [0; 64];
        for (pair, color) in bytes.chunks_exact_mut(2).zip(piece) {
            if let [low, high] = pair {
                [*low, *high] = color.to_le_bytes();
            }
        }
        let (bytes, _) = bytes.split_at_checked(2 * piece.len()).ok_or(Fault::Output)?;
        match sys::write(file, bytes) {
            Ok(written) if written == bytes.len() => {}
            _ => return Err(Fault::Output),
        }
    }
    Ok(())
}
