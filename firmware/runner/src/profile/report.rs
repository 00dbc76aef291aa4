//! Where instructions go, as tables.

use std::collections::{BTreeSet, HashMap};

use super::source::Place;
use crate::table::{Align, Table};

/// The most rows of each table: the rest is small.
const ROWS: usize = 40;

/// Instructions, and how many of them load or store.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Count {
    instructions: u64,
    memory: u64,
}

impl Count {
    fn add(&mut self, instructions: u64, touches_memory: bool) {
        self.instructions += instructions;
        self.memory += if touches_memory { instructions } else { 0 };
    }
}

/// A function's name and its file.
type Function = (String, String);

/// What was counted so far.
#[derive(Debug, Default)]
pub(super) struct Report {
    total: Count,
    /// What stands in a function itself. The project's functions are charged with what is inlined into them from
    /// other crates, such as the addition of two numbers.
    itself: HashMap<Function, Count>,
    /// The project's functions, with all that is inlined into them.
    whole: HashMap<Function, Count>,
    /// Functions that are called, with all that is inlined into them: together they are everything.
    called: HashMap<Function, Count>,
    /// As `itself`, by line.
    lines: HashMap<(String, u32), Count>,
}

impl Report {
    /// Counts an instruction that was executed so often. The innermost function comes first.
    pub(super) fn add(&mut self, places: &[Place], count: u64, touches_memory: bool) {
        self.total.add(count, touches_memory);
        let function = |place: Option<&Place>| {
            place.map_or(("?".into(), "?".into()), |place| (place.function.clone(), place.file.clone()))
        };
        let innermost = places.iter().find(|place| place.is_own()).or(places.first());
        self.itself.entry(function(innermost)).or_default().add(count, touches_memory);
        self.called.entry(function(places.last())).or_default().add(count, touches_memory);
        if let Some(place) = innermost {
            self.lines.entry((place.file.clone(), place.line)).or_default().add(count, touches_memory);
        }
        // A function that is inlined into itself counts once.
        let own = places.iter().filter(|place| place.is_own());
        for function in own.map(|place| function(Some(place))).collect::<BTreeSet<_>>() {
            self.whole.entry(function).or_default().add(count, touches_memory);
        }
    }

    /// Everything, in instructions per pixel.
    pub(super) fn tables(&self, pixels: usize) -> String {
        let total = self.total;
        let named = |(function, file): &Function| [function.clone(), file.clone()];
        let table = |counts, headings| table(counts, headings, pixels, total.instructions, named);
        format!(
            "{:.1} instructions per pixel, {} of them loads and stores.\n\
             \nInstructions per pixel by function, without what is inlined into it from the project:\n\n{}\
             \nBy function, with all that is inlined into it:\n\n{}\
             \nBy function that is called, with all that is inlined into it:\n\n{}\
             \nBy line:\n\n{}",
            total.instructions as f64 / pixels as f64,
            percent(total.memory, total.instructions),
            table(&self.itself, ["function", "file"]),
            table(&self.whole, ["function", "file"]),
            table(&self.called, ["function", "file"]),
            self::table(&self.lines, ["line"], pixels, total.instructions, |(file, line)| [format!(
                "{file}:{line}"
            )]),
        )
    }
}

/// The rows with the most instructions, in instructions per pixel.
fn table<K: Ord, const NAMES: usize>(
    counts: &HashMap<K, Count>,
    headings: [&str; NAMES],
    pixels: usize,
    total: u64,
    name: impl Fn(&K) -> [String; NAMES],
) -> Table {
    let numbers = ["instr/pixel", "share", "load/store"].map(|heading| (heading, Align::Right));
    let mut table = Table::new(numbers.into_iter().chain(headings.map(|heading| (heading, Align::Left))));
    let mut rows: Vec<(&K, &Count)> = counts.iter().collect();
    rows.sort_by(|(a, few), (b, many)| many.instructions.cmp(&few.instructions).then(a.cmp(b)));
    for (key, count) in rows.into_iter().take(ROWS) {
        let each = format!("{:.1}", count.instructions as f64 / pixels as f64);
        let numbers = [each, percent(count.instructions, total), percent(count.memory, count.instructions)];
        table.push(numbers.into_iter().chain(name(key)));
    }
    table
}

fn percent(part: u64, whole: u64) -> String {
    format!("{:.1} %", part as f64 * 100.0 / whole.max(1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(function: &str, file: &str, line: u32) -> Place {
        Place { function: function.into(), file: file.into(), line }
    }

    #[test]
    fn an_instruction_counts_for_all_functions_that_it_stands_in() {
        let (add, run) = (place("add", "(core/src/ops.rs)", 1), place("run", "core/src/run.rs", 9));
        let dot = place("dot", "core/src/vec3.rs", 5);
        let mut report = Report::default();
        report.add(&[add.clone(), dot.clone(), run.clone()], 30, false);
        report.add(&[dot, run.clone()], 10, true);
        report.add(&[run], 60, false);
        report.add(&[add], 100, false);
        let text = report.tables(10);
        let tables: Vec<Vec<&str>> = text
            .split("\n\n")
            .filter(|part| part.starts_with('|'))
            .map(|table| table.lines().skip(2).filter(|line| line.starts_with('|')).collect())
            .collect();
        assert!(text.starts_with("20.0 instructions per pixel, 5.0 % of them loads and stores.\n"));
        assert_eq!(
            tables[0],
            [
                "|        10.0 | 50.0 % |      0.0 % | add      | (core/src/ops.rs) |",
                "|         6.0 | 30.0 % |      0.0 % | run      | core/src/run.rs   |",
                "|         4.0 | 20.0 % |     25.0 % | dot      | core/src/vec3.rs  |",
            ]
        );
        assert_eq!(
            tables[1],
            [
                "|        10.0 | 50.0 % |     10.0 % | run      | core/src/run.rs  |",
                "|         4.0 | 20.0 % |     25.0 % | dot      | core/src/vec3.rs |",
            ]
        );
        assert_eq!(
            tables[2],
            [
                "|        10.0 | 50.0 % |      0.0 % | add      | (core/src/ops.rs) |",
                "|        10.0 | 50.0 % |     10.0 % | run      | core/src/run.rs   |",
            ]
        );
        assert_eq!(tables[3][1], "|         6.0 | 30.0 % |      0.0 % | core/src/run.rs:9   |");
    }
}
