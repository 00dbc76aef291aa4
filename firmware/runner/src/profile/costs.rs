//! Instructions and cycles by folder, function and line, as tables.

use std::collections::{BTreeSet, HashMap};
use std::path::Path;

use super::line_tables::Place;
use super::trace::Executed;
use crate::table::{Align, Table};

/// The most rows of a table.
const ROWS: usize = 40;

/// Executed instructions, those of them that load or store, and their cycles, which are 0 if the emulator
/// counts none.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Count {
    instructions: u64,
    memory: u64,
    cycles: u64,
}

impl Count {
    fn add(&mut self, executed: Executed, touches_memory: bool) {
        self.instructions += executed.times;
        self.memory += if touches_memory { executed.times } else { 0 };
        self.cycles += executed.cycles;
    }

    /// The cost that orders rows and that shares are computed from: cycles if they are known.
    fn cost(&self) -> u64 {
        if self.cycles > 0 { self.cycles } else { self.instructions }
    }
}

/// A function's name and its file.
type Function = (String, String);

/// The counts of a program.
#[derive(Debug, Default)]
pub(super) struct Costs {
    total: Count,
    /// Functions without the project's functions that are inlined into them. Functions of other crates, such
    /// as the addition of two numbers, count for the project's function that they are inlined into.
    itself: HashMap<Function, Count>,
    /// The project's functions, with all functions that are inlined into them.
    whole: HashMap<Function, Count>,
    /// Functions that are called, with all functions that are inlined into them. They add up to the total.
    called: HashMap<Function, Count>,
    /// The counts of `itself`, by line.
    lines: HashMap<(String, u32), Count>,
    /// The counts of `itself`, by the folder of the function's file.
    folders: HashMap<String, Count>,
}

impl Costs {
    /// Counts an instruction. `places` begins with the innermost function.
    pub(super) fn add(&mut self, places: &[Place], executed: Executed, touches_memory: bool) {
        self.total.add(executed, touches_memory);
        let function = |place: Option<&Place>| {
            place.map_or(("?".into(), "(?)".into()), |place| (place.function.clone(), place.file.clone()))
        };
        let innermost = places.iter().find(|place| place.is_own()).or(places.first());
        self.itself.entry(function(innermost)).or_default().add(executed, touches_memory);
        self.called.entry(function(places.last())).or_default().add(executed, touches_memory);
        self.folders.entry(folder(innermost)).or_default().add(executed, touches_memory);
        if let Some(place) = innermost {
            self.lines.entry((place.file.clone(), place.line)).or_default().add(executed, touches_memory);
        }
        // Count a function that is inlined into itself once.
        let own = places.iter().filter(|place| place.is_own());
        for function in own.map(|place| function(Some(place))).collect::<BTreeSet<_>>() {
            self.whole.entry(function).or_default().add(executed, touches_memory);
        }
    }

    /// All tables, with counts per pixel.
    pub(super) fn tables(&self, pixels: usize) -> String {
        let total = self.total;
        let named = |(function, file): &Function| [function.clone(), file.clone()];
        let table = |counts, headings| table(counts, headings, pixels, total, named);
        let cycles = match total.cycles {
            0 => String::new(),
            cycles => format!(" They take {:.1} cycles.", cycles as f64 / pixels as f64),
        };
        format!(
            "{:.1} instructions per pixel, {} of them loads and stores.{cycles}\n\
             \nBy folder of the function's file:\n\n{}\
             \nBy function, without the project's functions that are inlined into it:\n\n{}\
             \nBy function, with all functions that are inlined into it:\n\n{}\
             \nBy function that is called, with all functions that are inlined into it:\n\n{}\
             \nBy line:\n\n{}",
            total.instructions as f64 / pixels as f64,
            percent(total.memory, total.instructions),
            self::table(&self.folders, ["folder"], pixels, total, |folder| [folder.clone()]),
            table(&self.itself, ["function", "file"]),
            table(&self.whole, ["function", "file"]),
            table(&self.called, ["function", "file"]),
            self::table(&self.lines, ["line"], pixels, total, |(file, line)| [format!("{file}:{line}")]),
        )
    }
}

/// The folder of a place in the project; one name for all other crates.
fn folder(place: Option<&Place>) -> String {
    let own = place.filter(|place| place.is_own());
    let folder = own.and_then(|place| Path::new(&place.file).parent());
    folder.map_or("(other crates)".into(), |folder| folder.display().to_string())
}

/// The rows with the highest costs, per pixel.
fn table<K: Ord, const NAMES: usize>(
    counts: &HashMap<K, Count>,
    headings: [&str; NAMES],
    pixels: usize,
    total: Count,
    name: impl Fn(&K) -> [String; NAMES],
) -> Table {
    let has_cycles = total.cycles > 0;
    let cycles = has_cycles.then_some("cycles/pixel");
    let numbers = cycles.into_iter().chain(["instr/pixel", "share", "load/store"]);
    let numbers = numbers.map(|heading| (heading, Align::Right));
    let mut table = Table::new(numbers.chain(headings.map(|heading| (heading, Align::Left))));
    let mut rows: Vec<(&K, &Count)> = counts.iter().collect();
    rows.sort_by(|(a, few), (b, many)| many.cost().cmp(&few.cost()).then(a.cmp(b)));
    for (key, count) in rows.into_iter().take(ROWS) {
        let each = |number: u64| format!("{:.1}", number as f64 / pixels as f64);
        let cycles = has_cycles.then(|| each(count.cycles));
        let share = percent(count.cost(), total.cost());
        let numbers = [each(count.instructions), share, percent(count.memory, count.instructions)];
        table.push(cycles.into_iter().chain(numbers).chain(name(key)));
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

    fn times(times: u64) -> Executed {
        Executed { times, cycles: 0 }
    }

    #[test]
    fn an_instruction_counts_for_all_functions_that_it_stands_in() {
        let (add, run) = (place("add", "(core/src/ops.rs)", 1), place("run", "core/src/run.rs", 9));
        let dot = place("dot", "core/src/vec3.rs", 5);
        let mut report = Costs::default();
        report.add(&[add.clone(), dot.clone(), run.clone()], times(30), false);
        report.add(&[dot, run.clone()], times(10), true);
        report.add(&[run], times(60), false);
        report.add(&[add], times(100), false);
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
                "|        10.0 | 50.0 % |      0.0 % | (other crates) |",
                "|        10.0 | 50.0 % |     10.0 % | core/src       |",
            ]
        );
        assert_eq!(
            tables[1],
            [
                "|        10.0 | 50.0 % |      0.0 % | add      | (core/src/ops.rs) |",
                "|         6.0 | 30.0 % |      0.0 % | run      | core/src/run.rs   |",
                "|         4.0 | 20.0 % |     25.0 % | dot      | core/src/vec3.rs  |",
            ]
        );
        assert_eq!(
            tables[2],
            [
                "|        10.0 | 50.0 % |     10.0 % | run      | core/src/run.rs  |",
                "|         4.0 | 20.0 % |     25.0 % | dot      | core/src/vec3.rs |",
            ]
        );
        assert_eq!(
            tables[3],
            [
                "|        10.0 | 50.0 % |      0.0 % | add      | (core/src/ops.rs) |",
                "|        10.0 | 50.0 % |     10.0 % | run      | core/src/run.rs   |",
            ]
        );
        assert_eq!(tables[4][1], "|         6.0 | 30.0 % |      0.0 % | core/src/run.rs:9   |");
    }

    #[test]
    fn where_cycles_are_known_they_rank() {
        let mut report = Costs::default();
        report.add(&[place("sums", "core/src/sums.rs", 1)], Executed { times: 30, cycles: 30 }, false);
        report.add(&[place("calls", "core/src/calls.rs", 1)], Executed { times: 20, cycles: 60 }, true);
        let text = report.tables(10);
        let of_calls =
            "|          6.0 |         2.0 | 66.7 % |    100.0 % | calls    | core/src/calls.rs |\n";
        let of_sums = "|          3.0 |         3.0 | 33.3 % |      0.0 % | sums     | core/src/sums.rs  |\n";
        assert!(text.starts_with(
            "5.0 instructions per pixel, 40.0 % of them loads and stores. They take 9.0 cycles.\n"
        ));
        assert!(text.contains(&format!("{of_calls}{of_sums}")), "{text}");
    }
}
