//! The places in the source that an instruction comes from.

use std::path::{Path, PathBuf};

use addr2line::{Context, LookupResult, gimli};
use anyhow::Result;
use object::{Object, ObjectSection, SymbolMap, SymbolMapName};
use rustc_demangle::demangle;

type Reader<'e> = gimli::EndianSlice<'e, gimli::LittleEndian>;

/// A place in a function.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Place {
    /// The function's name, without its module and generic arguments.
    pub(super) function: String,
    /// The function's file, in parentheses if it belongs to another crate.
    pub(super) file: String,
    pub(super) line: u32,
}

impl Place {
    /// Whether the file is the project's, not that of another crate.
    pub(super) fn is_own(&self) -> bool {
        !self.file.starts_with('(')
    }
}

/// The line tables of a program, and its functions.
pub(super) struct LineTables<'e> {
    context: Context<Reader<'e>>,
    functions: SymbolMap<SymbolMapName<'e>>,
    /// The folder of the project's files.
    root: PathBuf,
}

impl<'e> LineTables<'e> {
    pub(super) fn read(elf: &object::File<'e>) -> Result<Self> {
        let section = |id: gimli::SectionId| -> Result<Reader<'e>, gimli::Error> {
            let data = elf.section_by_name(id.name()).and_then(|section| section.data().ok());
            Ok(gimli::EndianSlice::new(data.unwrap_or_default(), gimli::LittleEndian))
        };
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
        let context = Context::from_dwarf(gimli::Dwarf::load(section)?)?;
        Ok(Self { context, functions: elf.symbol_map(), root })
    }

    /// The places of an instruction: the innermost function first, then the function that it is inlined into,
    /// and so on. Functions without line tables, such as those in assembly, give one place without a line.
    pub(super) fn places(&self, address: u64) -> Result<Vec<Place>> {
        let frames = self.context.find_frames(address);
        let mut frames = match frames {
            LookupResult::Output(frames) => frames?,
            // These programs have no split debug information.
            LookupResult::Load { .. } => return Ok(Vec::new()),
        };
        let mut places = Vec::new();
        while let Some(frame) = frames.next()? {
            let function = match &frame.function {
                Some(function) => short(&format!("{:#}", demangle(&function.raw_name()?))),
                None => "?".into(),
            };
            let (file, line) = frame.location.map_or((None, None), |location| (location.file, location.line));
            places.push(Place {
                function,
                file: file.map_or("(?)".into(), |file| self.file(file)),
                line: line.unwrap_or(0),
            });
        }
        if places.is_empty() {
            places.extend(self.function(address));
        }
        Ok(places)
    }

    /// The function at an address, from the symbol table. A function of the core has the file of its module.
    fn function(&self, address: u64) -> Option<Place> {
        // The lowest bit of a function's address marks Thumb code.
        let name = format!("{:#}", demangle(self.functions.containing(address | 1)?.name()));
        let module = name.strip_prefix("rayline::").and_then(|path| Some(path.rsplit_once("::")?.0));
        let file = module
            .map(|module| format!("core/src/{}.rs", module.replace("::", "/")))
            .filter(|file| self.root.join(file).is_file());
        Some(Place { function: short(&name), file: file.unwrap_or("(?)".into()), line: 0 })
    }

    /// A file's path, relative to the folder of the project or of its crate.
    fn file(&self, file: &str) -> String {
        let path = Path::new(file);
        if let Ok(path) = path.strip_prefix(&self.root) {
            return path.display().to_string();
        }
        let parts: Vec<_> = path.components().map(|part| part.as_os_str().to_string_lossy()).collect();
        let start = parts.iter().rposition(|part| part == "src").unwrap_or(0).saturating_sub(1);
        format!("({})", parts.get(start..).unwrap_or_default().join("/"))
    }
}

/// A function's name without its path and without angle brackets.
fn short(name: &str) -> String {
    let mut depth = 0u32;
    let mut plain = String::new();
    for character in name.replace("->", "").chars() {
        match character {
            '<' => depth += 1,
            '>' => depth = depth.saturating_sub(1),
            _ if depth == 0 => plain.push(character),
            _ => {}
        }
    }
    let name = plain.rsplit("::").find(|part| !part.is_empty());
    name.unwrap_or("?").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_shortened() {
        let names = [
            ("radiance", "radiance"),
            ("rayline::integrator::radiance", "radiance"),
            ("fill<u32, fn() -> u8>", "fill"),
            ("<rayline::Frame<R, S> as rayline::Look>::trace", "trace"),
            ("rayline::prepared::queries::<impl rayline::PreparedScene<R,S>>::closest_hit", "closest_hit"),
            ("rayline_emulated::file::render::<C>", "render"),
            ("{closure#0}<f32>", "{closure#0}"),
        ];
        for (name, expected) in names {
            assert_eq!(short(name), expected);
        }
    }
}
