//! The call graph of a linked program for ARMv6-M (Arm, "ARMv6-M Architecture Reference Manual", A5 and
//! A6.7).
//!
//! Only instructions that leave a function matter. `BL` and `B` hold the address that they go to. `BLX` and
//! `BX` go to the address in a register, which is unknown: the functions below a function that has one are
//! unknown too, and are an error.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, Result, bail};
use object::{Object, ObjectSection, ObjectSymbol, SymbolKind};
use rustc_demangle::demangle;

/// The functions of a program, and the calls between them.
#[derive(Debug, Default)]
pub(crate) struct Calls {
    /// Functions by their addresses.
    functions: BTreeMap<u64, Function>,
}

#[derive(Debug)]
struct Function {
    name: String,
    calls: BTreeSet<u64>,
    /// Whether the function goes to an address in a register.
    is_open: bool,
}

impl Calls {
    /// Reads all functions of a program.
    pub(crate) fn read(elf: &object::File<'_>) -> Result<Self> {
        let mut functions = BTreeMap::new();
        // The symbol `$t` begins instructions, `$d` begins data.
        let mut marks = BTreeMap::new();
        for symbol in elf.symbols() {
            let name = symbol.name()?;
            match name.get(..2) {
                Some("$t") => _ = marks.insert(symbol.address(), true),
                Some("$d") => _ = marks.insert(symbol.address(), false),
                _ => {}
            }
        }
        for symbol in elf.symbols().filter(|symbol| symbol.kind() == SymbolKind::Text && symbol.size() > 0) {
            // The lowest bit of the address marks Thumb code.
            let start = symbol.address() & !1;
            let section = elf.section_by_index(
                symbol.section_index().context("a function has no section: build the program again")?,
            )?;
            let bytes = section
                .data_range(start, symbol.size())?
                .context("a function has no code: build the program again")?;
            let is_code =
                |address: u64| marks.range(..=address).next_back().is_none_or(|(_, is_code)| *is_code);
            let (calls, is_open) = leave(start, bytes, is_code);
            let name = format!("{:#}", demangle(symbol.name()?));
            functions.insert(start, Function { name, calls, is_open });
        }
        Ok(Self { functions })
    }

    /// The names of all functions that can be reached from a function, with its own name.
    pub(crate) fn below(&self, name: &str) -> Result<BTreeSet<&str>> {
        let mut waiting: Vec<u64> = self
            .functions
            .iter()
            .filter(|(_, function)| function.name == name)
            .map(|(start, _)| *start)
            .collect();
        if waiting.is_empty() {
            bail!("the program has no function `{name}`");
        }
        let (mut seen, mut names) = (BTreeSet::new(), BTreeSet::new());
        while let Some(start) = waiting.pop() {
            // Other addresses are branches within a function.
            let Some(function) = self.functions.get(&start).filter(|_| seen.insert(start)) else { continue };
            if function.is_open {
                bail!(
                    "`{}` calls an address in a register: avoid `dyn` and function pointers in it",
                    function.name
                );
            }
            names.insert(function.name.as_str());
            waiting.extend(&function.calls);
        }
        Ok(names)
    }
}

/// The addresses that the code at `start` goes to, and whether it goes to an address in a register.
fn leave(start: u64, bytes: &[u8], is_code: impl Fn(u64) -> bool) -> (BTreeSet<u64>, bool) {
    let halfwords: Vec<u32> =
        bytes.as_chunks().0.iter().map(|bytes| u16::from_le_bytes(*bytes).into()).collect();
    let (mut calls, mut is_open) = (BTreeSet::new(), false);
    for (index, pair) in
        halfwords.windows(2).chain([[*halfwords.last().unwrap_or(&0), 0].as_slice()]).enumerate()
    {
        let address = start + 2 * index as u64;
        let &[first, second] = pair else { continue };
        if !is_code(address) {
            continue;
        }
        let offset = if first >> 11 == 0b11110 && second >> 14 == 0b11 && second & 0x1000 != 0 {
            // BL: the sign S, then J1 and J2, which are inverted if S is 0.
            let (s, j1, j2) = (first >> 10 & 1, second >> 13 & 1, second >> 11 & 1);
            let (i1, i2) = (1 ^ j1 ^ s, 1 ^ j2 ^ s);
            let bits = s << 24 | i1 << 23 | i2 << 22 | (first & 0x3FF) << 12 | (second & 0x7FF) << 1;
            extended(bits, 25)
        } else if first >> 11 == 0b11100 {
            extended((first & 0x7FF) << 1, 12)
        } else {
            // BX and BLX, without BX LR, which returns.
            is_open |= first & 0xFF07 == 0x4700 && first != 0x4770;
            continue;
        };
        calls.insert(address.wrapping_add(4).wrapping_add_signed(offset));
    }
    (calls, is_open)
}

/// A signed number of `count` bits.
fn extended(bits: u32, count: u32) -> i64 {
    i64::from((bits << (32 - count)) as i32 >> (32 - count))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The calls of code at 0x1000.
    fn code(halfwords: &[u16]) -> (Vec<u64>, bool) {
        let bytes: Vec<u8> = halfwords.iter().flat_map(|halfword| halfword.to_le_bytes()).collect();
        let (calls, is_open) = leave(0x1000, &bytes, |address| address < 0x1100);
        (calls.into_iter().collect(), is_open)
    }

    #[test]
    fn branches_are_followed() {
        // Machine code from GNU as.
        assert_eq!(code(&[0xF000, 0xF87E]), (vec![0x1100], false)); // bl 0x1100
        assert_eq!(code(&[0xF7FF, 0xFF7E]), (vec![0xF00], false)); // bl 0xf00
        assert_eq!(code(&[0xE03E]), (vec![0x1080], false)); // b 0x1080
        assert_eq!(code(&[0xBF00, 0xE7FD]), (vec![0x1000], false)); // nop; b 0x1000
    }

    #[test]
    fn registers_are_noticed() {
        assert_eq!(code(&[0x4770]), (vec![], false)); // bx lr
        assert_eq!(code(&[0x4798]), (vec![], true)); // blx r3
        assert_eq!(code(&[0x4718]), (vec![], true)); // bx r3
    }

    #[test]
    fn data_is_not_read_as_code() {
        let mut halfwords = vec![0xBF00; 0x80];
        halfwords.extend([0x4798, 0xE7FD]);
        assert_eq!(code(&halfwords), (vec![], false));
    }

    #[test]
    fn all_functions_below_a_function_are_found() {
        let function = |name: &str, calls: &[u64], is_open| Function {
            name: name.into(),
            calls: calls.iter().copied().collect(),
            is_open,
        };
        let functions = BTreeMap::from([
            (0, function("render", &[4, 2], false)),
            (4, function("square_root", &[0], false)),
            (8, function("hal", &[12], false)),
            (12, function("panic", &[], false)),
            (16, function("open", &[], true)),
        ]);
        let calls = Calls { functions };
        assert_eq!(calls.below("render").unwrap(), BTreeSet::from(["render", "square_root"]));
        assert_eq!(calls.below("hal").unwrap(), BTreeSet::from(["hal", "panic"]));
        assert!(calls.below("open").is_err());
        assert!(calls.below("nothing").is_err());
    }
}
