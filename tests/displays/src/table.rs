//! The part of `docs/displays.md` that tells what was tested.

use std::path::PathBuf;
use std::{fs, io};

use crate::entry::Entry;
use crate::trial::Trial;

/// Between these lines of the page stands what is generated.
const BEGIN: &str = "<!-- written by tests/displays -->\n";
const END: &str = "<!-- until here -->\n";

/// Where the page is.
fn path() -> PathBuf {
    concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/displays.md").into()
}

/// The page as it is, and as it should be.
///
/// # Errors
/// If the page cannot be read, or has no place for the table.
pub fn page(entries: &[Entry]) -> io::Result<(String, String)> {
    let page = fs::read_to_string(path())?;
    let (before, rest) = page.split_once(BEGIN).ok_or(io::ErrorKind::InvalidData)?;
    let (_, after) = rest.split_once(END).ok_or(io::ErrorKind::InvalidData)?;
    let new = format!("{before}{BEGIN}{}{END}{after}", table(entries));
    Ok((page, new))
}

/// Writes the table to the page.
///
/// # Errors
/// If the page cannot be read or written, or has no place for the table.
pub fn write(entries: &[Entry]) -> io::Result<()> {
    fs::write(path(), page(entries)?.1)
}

/// The table, a row for each panel, and below it what to watch for.
pub fn table(entries: &[Entry]) -> String {
    let mut text = String::from("\n| crate | version | panel | orientations | lines | windows |\n");
    text += "| --- | --- | --- | --: | --: | --: |\n";
    for entry in entries {
        let mut first = format!("{} | {}", entry.name, version(entry.name));
        let mut rest = &entry.trials[..];
        while let Some(trial) = rest.first() {
            let same = rest.iter().take_while(|other| other.panel == trial.panel).count();
            let (trials, others) = rest.split_at(same);
            rest = others;
            let windows = windows(trials);
            text += &format!("| {first} | {} | {same} | {} | {windows} |\n", trial.panel, entry.glue);
            first = " | ".into();
        }
    }
    text += "\n";
    for Entry { name, note, .. } in entries.iter().filter(|entry| !entry.note.is_empty()) {
        text += &wrapped(&format!("- `{name}`: {note}."));
    }
    text + "\n"
}

/// How many windows a picture takes in these orientations.
fn windows(trials: &[Trial]) -> String {
    let mut counts: Vec<String> = vec![];
    for trial in trials {
        let count = trial.windows();
        let text = if count == trial.size().height as usize { "1 a line".into() } else { count.to_string() };
        if !counts.contains(&text) {
            counts.push(text);
        }
    }
    counts.join(" or ")
}

/// The version of a crate in this crate's `Cargo.lock`.
fn version(name: &str) -> &'static str {
    let lock = include_str!("../Cargo.lock");
    let package = lock.split_once(&format!("name = \"{name}\"\nversion = \""));
    let version = package.and_then(|(_, rest)| rest.split_once('"'));
    version.map_or_else(|| panic!("{name} is not in Cargo.lock"), |(version, _)| version)
}

/// An item of a list, in lines of at most 110 columns.
fn wrapped(item: &str) -> String {
    let (mut text, mut columns) = (String::new(), 0);
    for word in item.split(' ') {
        let length = word.chars().count();
        if columns > 0 && columns + 1 + length > 110 {
            text += "\n ";
            columns = 1;
        }
        if columns > 0 {
            text += " ";
            columns += 1;
        }
        text += word;
        columns += length;
    }
    text + "\n"
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_page_has_this_table() {
        let (page, new) = super::page(&crate::drivers::all()).expect("docs/displays.md with its two marks");
        let command = "cargo run --manifest-path tests/displays/Cargo.toml -- --write";
        assert!(page == new, "docs/displays.md is not up to date; run `{command}`. It then has\n{new}");
    }
}
