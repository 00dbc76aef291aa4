//! The command line.

use std::path::PathBuf;
use std::time::Duration;

use clap::Parser;
use clap::builder::{PossibleValuesParser, RangedI64ValueParser, RangedU64ValueParser};
use rayline::limits::MAX_BOUNCES;

use crate::board::BOARDS;
use crate::picture::{Mode, Number, Size};
use crate::toolchain::LEVELS;

/// Renders a scene on emulated boards, and compares the pictures with this computer's, byte for byte
///
/// Without a name, it runs all boards that have a compiler and an emulator here.
#[derive(Debug, Parser)]
#[command(name = "cargo boards", bin_name = "cargo boards", max_term_width = 100)]
pub(crate) struct Arguments {
    /// Boards to run
    #[arg(value_name = "NAME", value_parser = board_names())]
    pub(crate) boards: Vec<String>,

    /// Scene to render: the name of a built-in one, or a .rayline file that `rayline convert` wrote
    #[arg(long, default_value = "classic")]
    pub(crate) scene: String,

    /// Size of the picture, such as 320x240 [default: what the board renders in about a second]
    #[arg(long, value_name = "WxH")]
    pub(crate) size: Option<Size>,

    /// How often a ray may be mirrored or refracted [default: the scene's own]
    #[arg(long, value_name = "N", value_parser = bounces())]
    pub(crate) bounces: Option<u8>,

    /// Number system; the Pico's program always computes in fixed point
    #[arg(long, value_name = "TYPE", default_value = "f32")]
    pub(crate) number: Number,

    /// Quality of the picture
    #[arg(long, value_name = "MODE", default_value = "exact")]
    pub(crate) mode: Mode,

    /// Leave out the features that only make exact pictures faster: less flash and stack, the same picture
    #[arg(long)]
    pub(crate) small: bool,

    /// Light lamps with a size by formulas, not by rays
    #[arg(long)]
    pub(crate) closed_form: bool,

    /// Write the board's picture; of several boards, each file has the board's name added
    #[arg(long, value_name = "FILE.png")]
    pub(crate) picture: Option<PathBuf>,

    /// Write the results: sizes, instructions, rays, and PSNR in 8-bit sRGB
    ///
    /// PSNR is that of a realtime picture against the exact one in the same number system, and that of an
    /// exact picture in fixed point against f64.
    #[arg(long, value_name = "FILE.json")]
    pub(crate) json: Option<PathBuf>,

    /// Fail if a board cannot be run here
    #[arg(long)]
    pub(crate) all_required: bool,

    /// Time limit of an emulator; with --gallery, of one scene
    #[arg(long, value_name = "SECONDS", default_value = "120", value_parser = seconds())]
    timeout: u64,

    /// Show that programs of all sets of features hold no panic, and that this check can fail: a program with
    /// a panic does not link, or its panic is found
    #[arg(long, conflicts_with_all = ["picture", "json"])]
    pub(crate) prove_no_panic: bool,

    /// With --prove-no-panic: only at these levels of optimization
    #[arg(
        long,
        value_name = "LEVEL",
        value_delimiter = ',',
        requires = "prove_no_panic",
        value_parser = PossibleValuesParser::new(LEVELS)
    )]
    pub(crate) levels: Vec<String>,

    /// Show the folders, functions and lines that a board's instructions go to
    ///
    /// On the Pico it also shows their cycles. The default size is 80x60.
    #[arg(
        long,
        value_name = "NAME",
        conflicts_with_all = ["boards", "picture", "json", "prove_no_panic"],
        value_parser = board_names()
    )]
    pub(crate) profile: Option<String>,

    /// Draw all .ron scenes of a folder [default folder: docs/gallery] with one program, which reads them
    ///
    /// Compares the digests of the pictures with this computer's. The default size is 24x18. All pixels take
    /// one sample, whatever a scene's settings say. With --all-required it also fails if a board has too
    /// little memory for a scene.
    #[arg(
        long,
        value_name = "DIR",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "docs/gallery",
        conflicts_with_all = ["scene", "picture", "json", "prove_no_panic", "profile", "bench"]
    )]
    pub(crate) gallery: Option<PathBuf>,

    /// Measure each kind of processor, and print the tables; with names, on these boards only
    #[arg(
        long,
        conflicts_with_all = OF_PICTURES
    )]
    pub(crate) bench: bool,

    /// Write what --bench measured to firmware/boards.json
    #[arg(long, requires = "bench")]
    pub(crate) update: bool,

    /// Fail if instructions or flash have risen by more than 2 % over firmware/boards.json, or beyond an
    /// allowance
    ///
    /// firmware/boards.json holds for one compiler, which it names. With another one, only the allowances are
    /// checked.
    #[arg(long, requires = "bench", conflicts_with = "update")]
    pub(crate) check: bool,

    /// Measure what distributed ray tracing costs, and write a page: docs/effects.md
    #[arg(
        long,
        value_name = "FILE.md",
        conflicts_with_all = OF_PICTURES,
        conflicts_with_all = ["boards", "gallery", "bench", "report"]
    )]
    pub(crate) effects: Option<PathBuf>,

    /// Measure flash and stack by features and levels of optimization, and write a page: docs/sizes.md
    #[arg(
        long,
        value_name = "FILE.md",
        conflicts_with_all = OF_PICTURES,
        conflicts_with_all = ["boards", "gallery", "bench", "report", "effects"]
    )]
    pub(crate) sizes: Option<PathBuf>,

    /// Write the tables as a page: docs/benchmarks.md
    ///
    /// With --bench the page has what was measured, and the desktop is measured as well. Without, its boards
    /// are those of firmware/boards.json, and its desktop stays as it is.
    #[arg(
        long,
        value_name = "FILE.md",
        conflicts_with_all = OF_PICTURES,
        conflicts_with = "gallery"
    )]
    pub(crate) report: Option<PathBuf>,
}

impl Arguments {
    /// Time limit of an emulator.
    pub(crate) fn timeout(&self) -> Duration {
        Duration::from_secs(self.timeout)
    }
}

/// The arguments of commands that draw one picture.
const OF_PICTURES: [&str; 11] = [
    "scene",
    "size",
    "bounces",
    "number",
    "mode",
    "small",
    "closed_form",
    "picture",
    "json",
    "prove_no_panic",
    "profile",
];

/// The time limits of an emulator, in seconds.
fn seconds() -> RangedU64ValueParser<u64> {
    clap::value_parser!(u64).range(1..)
}

/// The names of all boards.
fn board_names() -> PossibleValuesParser {
    PossibleValuesParser::new(BOARDS.iter().map(|board| board.name))
}

/// The numbers of bounces that the core supports.
fn bounces() -> RangedI64ValueParser<u8> {
    clap::value_parser!(u8).range(..=i64::from(MAX_BOUNCES))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_report_is_written_with_and_without_measuring() {
        let parse = |line: &str| Arguments::try_parse_from(line.split(' '));
        assert!(!parse("boards --report page.md").unwrap().bench);
        assert!(parse("boards --bench --report page.md --update").unwrap().bench);
        assert_eq!(parse("boards --bench microbit").unwrap().boards, ["microbit"]);
        assert!(parse("boards --report page.md --scene flake").is_err());
        assert!(parse("boards --update").is_err());
    }
}
