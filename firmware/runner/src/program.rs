//! The linked program: its sizes, and whether it holds a panic.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};
use object::elf::{SHF_ALLOC, SHT_NOBITS};
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags};

/// Parts of the names of functions that every panic goes through.
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

/// Statics in RAM.
const STATICS: [&str; 5] = [".data", ".sdata", ".bss", ".sbss", ".uninit"];

/// What a program takes, and what must not be in it.
#[derive(Debug)]
pub(crate) struct Program {
    /// Bytes of flash: code, constants, and the first values of statics.
    pub(crate) text_bytes: u64,
    /// Bytes of RAM for statics.
    pub(crate) static_ram_bytes: u64,
    /// Functions of panics.
    pub(crate) panics: Vec<String>,
}

impl Program {
    /// Reads a linked program.
    pub(crate) fn read(file: &Path) -> Result<Self> {
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
        let mut panics = Vec::new();
        for symbol in elf.symbols() {
            // `#` leaves out the hashes that names carry.
            let name = format!("{:#}", rustc_demangle::demangle(symbol.name()?));
            if PANICS.iter().any(|panic| name.contains(panic)) {
                panics.push(name);
            }
        }
        Ok(Self { text_bytes, static_ram_bytes, panics })
    }
}
