//! What the program tells the emulator's host: a line for each figure, its name and 16 hexadecimal digits.
//!
//! Nothing is formatted by `core::fmt`, which holds panics.

use semihosting::io::{self, Write};
use semihosting::process;

use crate::Fault;

/// What the program has found out.
#[derive(Clone, Copy, Debug)]
pub struct Figures {
    /// Digest of the picture.
    pub digest: u64,
    /// Instructions that rendering it took.
    pub instructions: u64,
    /// Bytes of stack that were used.
    pub stack_bytes: u32,
}

impl Figures {
    /// Tells them.
    ///
    /// # Errors
    /// Where the host does not listen.
    pub fn tell(&self) -> Result<(), Fault> {
        number(b"digest ", self.digest)?;
        number(b"instructions ", self.instructions)?;
        number(b"stack_bytes ", self.stack_bytes.into())?;
        say(b"done\n")
    }
}

/// Ends the program with what went wrong.
pub fn fail(fault: Fault) -> ! {
    // The exit code tells as much, where the host does not listen.
    let _ = say(b"fault ").and_then(|()| say(fault.message().as_bytes())).and_then(|()| say(b"\n"));
    process::exit(1)
}

/// Tells a figure.
pub(crate) fn number(name: &[u8], value: u64) -> Result<(), Fault> {
    say(name)?;
    let mut line = *b"0000000000000000\n";
    for (digit, place) in line.iter_mut().zip((0..16).rev()) {
        let nibble = (value >> (4 * place)) as u8 & 0xF;
        *digit = nibble + if nibble < 10 { b'0' } else { b'a' - 10 };
    }
    say(&line)
}

/// Tells a line, or part of one.
pub(crate) fn say(bytes: &[u8]) -> Result<(), Fault> {
    let mut output = io::stdout().map_err(|_| Fault::Host)?;
    match output.write(bytes) {
        Ok(written) if written == bytes.len() => Ok(()),
        _ => Err(Fault::Host),
    }
}
