//! The report to the emulator's host: a line for each figure, with its name and 16 hexadecimal digits.
//!
//! `core::fmt` holds panics, so the digits are made here.

use semihosting::io::{self, Write};
use semihosting::process;

use crate::Fault;

/// The figures of one picture.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Digest of the picture.
    pub digest: u64,
    /// Instructions that rendered it.
    pub instructions: u64,
    /// Bytes of stack that were used.
    pub stack_bytes: u32,
}

impl Figures {
    /// Writes the figures into the report, and ends it.
    ///
    /// # Errors
    /// [`Fault::Host`] if the host does not accept them.
    pub fn report(&self) -> Result<(), Fault> {
        number(b"digest ", self.digest)?;
        number(b"instructions ", self.instructions)?;
        number(b"stack_bytes ", self.stack_bytes.into())?;
        text(b"done\n")
    }
}

/// Reports a fault, and ends the program.
pub fn fail(fault: Fault) -> ! {
    // The exit code also says that the program failed, if the host does not accept the text.
    let _ = text(b"fault ").and_then(|()| text(fault.message().as_bytes())).and_then(|()| text(b"\n"));
    process::exit(1)
}

/// Writes a figure into the report.
pub(crate) fn number(name: &[u8], value: u64) -> Result<(), Fault> {
    text(name)?;
    let mut line = *b"0000000000000000\n";
    for (digit, place) in line.iter_mut().zip((0..16).rev()) {
        let nibble = (value >> (4 * place)) as u8 & 0xF;
        *digit = nibble + if nibble < 10 { b'0' } else { b'a' - 10 };
    }
    text(&line)
}

/// Writes a line, or a part of one, into the report.
pub(crate) fn text(bytes: &[u8]) -> Result<(), Fault> {
    let mut output = io::stdout().map_err(|_| Fault::Host)?;
    match output.write(bytes) {
        Ok(written) if written == bytes.len() => Ok(()),
        _ => Err(Fault::Host),
    }
}
