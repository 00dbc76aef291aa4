//! The figures in `firmware/boards.json`, which later versions are compared with.

use std::fmt::Write;
use std::fs;

use anyhow::{Context, Result, ensure};
use serde::{Deserialize, Serialize};

use super::measured::Measured;

/// The file of the figures.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../boards.json");

/// Percent by which a figure may rise or fall.
const TOLERANCE: u64 = 2;

/// The figures, and the compiler that they hold for.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Committed {
    pub(super) compiler: String,
    pub(super) measured: Vec<Measured>,
}

/// The figures that have changed by more than [`TOLERANCE`], a line each.
#[derive(Debug, Default, PartialEq)]
struct Comparison {
    risen: String,
    fallen: String,
}

impl Committed {
    pub(super) fn read() -> Result<Self> {
        let text = fs::read_to_string(FILE).context("firmware/boards.json")?;
        serde_json::from_str(&text).context("firmware/boards.json")
    }

    /// New figures, in place of all those in the file or, if only some boards were measured, of those
    /// programs.
    pub(super) fn updated(compiler: String, measured: &[Measured], is_whole: bool) -> Result<Self> {
        if is_whole {
            return Ok(Self { compiler, measured: measured.to_vec() });
        }
        let mut committed = Self::read()?;
        ensure!(
            compiler == committed.compiler,
            "firmware/boards.json holds for {}, and this is {compiler}: measure all boards",
            committed.compiler
        );
        for figures in measured {
            match committed.measured.iter_mut().find(|known| known.name() == figures.name()) {
                Some(known) => known.clone_from(figures),
                None => committed.measured.push(figures.clone()),
            }
        }
        Ok(committed)
    }

    pub(super) fn write(&self) -> Result<()> {
        fs::write(FILE, serde_json::to_string_pretty(self)? + "\n").context("firmware/boards.json")
    }

    /// Compares new figures with these, and prints the changes; returns whether none has risen.
    pub(super) fn check(&self, compiler: &str, now: &[Measured]) -> bool {
        if compiler != self.compiler {
            eprintln!(
                "not compared: firmware/boards.json holds for {}, and this is {compiler}; measure both \
                 versions with one \
                 compiler",
                self.compiler
            );
            return true;
        }
        let Comparison { risen, fallen } = self.compare(now);
        if !risen.is_empty() {
            eprintln!(
                "more than firmware/boards.json allows; to accept it, run `cargo boards --bench \
                 --update`:\n{risen}"
            );
        }
        if !fallen.is_empty() {
            eprintln!(
                "better than firmware/boards.json; to keep it, run `cargo boards --bench --update`:\n{fallen}"
            );
        }
        risen.is_empty()
    }

    /// The figures that have risen and fallen.
    fn compare(&self, now: &[Measured]) -> Comparison {
        let mut comparison = Comparison::default();
        for now in now {
            let name = now.name();
            let Some(before) = self.measured.iter().find(|before| before.name() == name) else {
                _ = writeln!(comparison.risen, "  {name}: not in firmware/boards.json");
                continue;
            };
            let counts = [
                ("instructions", before.instructions, now.instructions),
                ("bytes of flash", before.text_bytes, now.text_bytes),
            ];
            let cycles = before.cycles.zip(now.cycles).map(|(before, now)| ("cycles a frame", before, now));
            for (what, before, now) in counts.into_iter().chain(cycles) {
                let list = match now * 100 {
                    risen if risen > before * (100 + TOLERANCE) => &mut comparison.risen,
                    fallen if fallen < before * (100 - TOLERANCE) => &mut comparison.fallen,
                    _ => continue,
                };
                let change = (now as f64 / before as f64 - 1.0) * 100.0;
                _ = writeln!(list, "  {name}: {now} {what}, {change:+.1} % of {before}");
            }
        }
        comparison
    }
}

#[cfg(test)]
mod tests {
    use super::super::measured::tests::measured;
    use super::*;

    fn committed() -> Committed {
        let measured = vec![measured("microbit", "classic", "fixed", "exact", 10_000)];
        Committed { compiler: "rustc 1.96.0".into(), measured }
    }

    fn now(instructions: u64, text_bytes: u64) -> Vec<Measured> {
        vec![Measured { text_bytes, ..measured("microbit", "classic", "fixed", "exact", instructions) }]
    }

    #[test]
    fn two_percent_are_free() {
        for (instructions, bytes) in [(10_000, 40_000), (10_200, 40_800), (9_800, 39_200)] {
            assert_eq!(committed().compare(&now(instructions, bytes)), Comparison::default());
        }
    }

    #[test]
    fn a_rise_fails() {
        for (instructions, bytes) in [(10_201, 40_000), (10_000, 40_801)] {
            let now = now(instructions, bytes);
            assert!(!committed().check("rustc 1.96.0", &now));
            assert!(committed().compare(&now).risen.contains("microbit classic 10x10 fixed exact: "));
        }
        let with = |cycles| Measured { cycles: Some(cycles), ..now(10_000, 40_000).remove(0) };
        let committed_cycles = Committed { measured: vec![with(1_000)], ..committed() };
        assert!(committed_cycles.check("rustc 1.96.0", &[with(1_020)]));
        assert!(!committed_cycles.check("rustc 1.96.0", &[with(1_021)]));
        let unknown = [measured("microbit", "classic", "fixed", "realtime", 1)];
        assert!(!committed().check("rustc 1.96.0", &unknown));
    }

    #[test]
    fn a_fall_is_printed() {
        let comparison = committed().compare(&now(9_000, 40_000));
        assert_eq!(
            comparison.fallen,
            "  microbit classic 10x10 fixed exact: 9000 instructions, -10.0 % of 10000\n"
        );
        assert!(committed().check("rustc 1.96.0", &now(9_000, 40_000)));
    }

    #[test]
    fn another_compiler_is_not_compared() {
        assert!(committed().check("rustc 1.97.0", &now(20_000, 40_000)));
    }

    #[test]
    fn the_table_with_the_source_can_be_read() {
        assert!(!Committed::read().unwrap().measured.is_empty());
    }
}
