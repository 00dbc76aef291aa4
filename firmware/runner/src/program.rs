//! The linked program: its sizes, and its panics.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use object::elf::{SHF_ALLOC, SHT_NOBITS};
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags};

use crate::board::ProgramSource;
use crate::calls::Calls;

/// Parts of the names of functions that panics call.
const PANICS: [&str; 8] = [
    "core::panicking",
    "panic_fmt",
    "panic_const",
    "panic_bounds_check",
    "slice_index_fail",
    "unwrap_failed",
    "expect_failed",
    "len_mismatch_fail",
];

/// The sections of statics in RAM, and of code that is copied to RAM.
const STATICS: [&str; 6] = [".data", ".data.code", ".sdata", ".bss", ".sbss", ".uninit"];

/// The function that traces lines, in programs with a HAL.
const RENDERING: &str = "pico::tracer::step";

/// Sizes of a program, and its panics.
#[derive(Debug)]
pub(crate) struct Program {
    /// Bytes of flash: code, constants, and the first values of statics.
    pub(crate) text_bytes: u64,
    /// Bytes of RAM for statics.
    pub(crate) static_ram_bytes: u64,
    /// Functions of panics. In a program with a HAL, only those that can be reached from rendering.
    pub(crate) panics: Vec<String>,
}

impl Program {
    /// Reads a linked program.
    pub(crate) fn read(file: &Path, source: ProgramSource) -> Result<Self> {
        let bytes = fs::read(file).with_context(|| file.display().to_string())?;
        let elf = object::File::parse(&*bytes)?;
        let (mut text_bytes, mut static_ram_bytes) = (0, 0);
        for section in elf.sections() {
            let SectionFlags::Elf { sh_type, sh_flags, .. } = section.flags() else { continue };
            if sh_flags.0 & SHF_ALLOC.0 == 0 {
                continue;
            }
            if sh_type != SHT_NOBITS {
                text_bytes += section.size();
            }
            if STATICS.contains(&section.name()?) {
                static_ram_bytes += section.size();
            }
        }
        let is_panic = |name: &String| PANICS.iter().any(|panic| name.contains(panic));
        let panics = if source.has_hal {
            Calls::read(&elf)?.below(RENDERING)?.into_iter().map(String::from).filter(is_panic).collect()
        } else {
            // `#` leaves out the hashes of names.
            let names =
                elf.symbols().map(|symbol| Ok(format!("{:#}", rustc_demangle::demangle(symbol.name()?))));
            let names: Vec<String> = names.collect::<Result<_>>()?;
            names.into_iter().filter(is_panic).collect()
        };
        Ok(Self { text_bytes, static_ram_bytes, panics })
    }

    /// Checks that the program holds no panic.
    ///
    /// # Errors
    /// The program's panics.
    pub(crate) fn check(&self) -> Result<()> {
        ensure!(
            self.panics.is_empty(),
            "the program can panic, remove the code that calls {}",
            self.panics.join(", ")
        );
        Ok(())
    }
}
