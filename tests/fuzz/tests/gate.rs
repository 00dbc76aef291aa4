//! The searches of this package, for a minute: `RAYLINE_FUZZ_SECONDS` makes it longer or shorter.
//!
//! The seeds are always the same, so each execution can be repeated; a faster machine goes further.

// This is test code: where something is wrong, it panics.
#![allow(clippy::unwrap_used, clippy::panic)]

use std::io::Write;
use std::time::Duration;

use rayline_fuzz::{Case, Choices, Counts, Search, Target, Until};

/// Searches for this part of the time, and tells how many executions held.
fn search(target: Target, share: f64) -> Counts {
    let seconds = std::env::var("RAYLINE_FUZZ_SECONDS").ok().and_then(|seconds| seconds.parse().ok());
    let time = Duration::from_secs_f64(seconds.unwrap_or(60.0) * share);
    let mut findings = String::new();
    let until = Until { time, executions: u64::MAX, findings: 3 };
    let counts = Search::new(target, &[]).unwrap().run(0, until, |found| {
        let directory = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("fuzz");
        let path = found.write(&directory).unwrap();
        findings += &format!("seed {}: {}\n    {}\n", found.seed, found.finding, path.display());
    });
    // Unlike what `eprintln!` prints, this is shown without `--nocapture` too.
    std::io::stderr().write_all(format!("fuzz {}: {counts}\n", target.name()).as_bytes()).unwrap();
    assert!(counts.executions > 0);
    let command = "cargo run -p rayline-fuzz -- replay FILE";
    assert!(findings.is_empty(), "{}: replay each with `{command}`\n{findings}", target.name());
    counts
}

#[test]
fn scenes_put_together_hold() {
    let counts = search(Target::Structured, 0.5);
    assert!(counts.refused * 2 < counts.executions, "too many scenes are refused: {counts}");
}

#[test]
fn bytes_of_scenes_hold() {
    let counts = search(Target::SceneBytes, 0.25);
    assert!(counts.unreadable * 10 < counts.executions * 9, "too many bytes are no scene: {counts}");
}

#[cfg(feature = "importers")]
#[test]
fn importers_hold() {
    let counts = search(Target::Importers, 0.25);
    assert!(counts.unreadable * 10 < counts.executions * 9, "too many files are no scene: {counts}");
}

#[test]
fn every_case_can_be_read_from_its_name() {
    for seed in 0..1000 {
        let case = Case::choose(&mut Choices::from_seed(seed));
        assert_eq!(format!("a1-01-{case}").parse(), Ok(case));
    }
    for name in ["", "f32", "f32-1", "f32-axb", "d-16x10", "f32-1x2-g4"] {
        assert!(name.parse::<Case>().is_err(), "{name}");
    }
}
