//! Tables of this computer: times of pictures, and their arithmetic.

use anyhow::Result;

use crate::toolchain;

/// Pictures of each kind that are timed.
const RUNS: &str = "21";

/// Measures this computer. It must have nothing else to do meanwhile.
pub(super) fn measure() -> Result<String> {
    eprintln!("the desktop: building (the first time takes a few minutes)");
    let rayline = toolchain::build_here("rayline")?;
    eprintln!("the desktop: running (about three minutes)");
    let times = toolchain::output_of(rayline.as_os_str(), &["bench", "--runs", RUNS])?;
    eprintln!("the desktop: counting arithmetic (the first time takes some minutes)");
    let arguments = ["test", "--quiet", "--manifest-path", toolchain::MAIN_WORKSPACE, "-p", "rayline-tests"];
    let filter = ["--test", "all", "operations", "--", "--nocapture"];
    let counts = toolchain::output_of(&toolchain::installed_cargo(), &[&arguments[..], &filter].concat())?;
    Ok(page(&times, &counts))
}

/// The text of both outputs.
fn page(times: &str, counts: &str) -> String {
    let table: Vec<&str> = counts.lines().filter(|line| line.starts_with('|')).collect();
    format!(
        "`rayline bench --runs {RUNS}` printed these tables. Times depend on the machine, and on what else \
         it does.\n\n\
         {}\n\n\
         Arithmetic of a pixel, in any number system, as `cargo test -p rayline-tests operations -- \
         --nocapture` \
         counts it:\n\n\
         {}\n",
        times.trim(),
        table.join("\n")
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_table_of_a_tests_output_is_taken() {
        let text = page("| a |\n", "running 1 test\n| b |\n| c |\ntest result: ok\n");
        assert!(text.contains("\n\n| a |\n\nArithmetic") && text.ends_with(":\n\n| b |\n| c |\n"), "{text}");
    }
}
