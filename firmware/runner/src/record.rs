//! The results of boards, as JSON and as a table.

use serde::Serialize;

use crate::board::Board;
use crate::picture::Picture;
use crate::table::{Align, Table, with_commas};
use crate::timing::{Rates, Timing};

/// The reason why there is no picture.
#[derive(Debug)]
pub(crate) enum NoPicture {
    /// The program cannot be run here, for this reason.
    Skipped(String),
    /// The program failed, for this reason.
    Failed(String),
}

/// The figures of a run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Figures {
    pub(crate) instructions: u64,
    pub(crate) digest: u64,
    pub(crate) host_digest: u64,
    pub(crate) pixels_differ: usize,
    pub(crate) text_bytes: u64,
    pub(crate) static_ram_bytes: u64,
    pub(crate) stack_bytes: u64,
    pub(crate) timing: Option<Timing>,
    pub(crate) rays: u64,
    pub(crate) psnr_db: Option<f64>,
}

/// The result of one picture on one board.
#[derive(Debug, Serialize)]
pub(crate) struct Record {
    pub(crate) board: &'static str,
    core: &'static str,
    pub(crate) scene: &'static str,
    pub(crate) width: u16,
    pub(crate) height: u16,
    pub(crate) number: &'static str,
    pub(crate) mode: &'static str,
    /// Whether the program leaves out the features that only make exact pictures faster.
    pub(crate) small: bool,
    pub(crate) rays: Option<u64>,
    /// The picture's PSNR, see [`Quality`](crate::quality::Quality).
    pub(crate) psnr_db: Option<f64>,
    pub(crate) instructions: Option<u64>,
    instructions_per_pixel: Option<f64>,
    digest: Option<String>,
    host_digest: Option<String>,
    pub(crate) text_bytes: Option<u64>,
    pub(crate) static_ram_bytes: Option<u64>,
    pub(crate) stack_bytes: Option<u64>,
    #[serde(flatten)]
    pub(crate) rates: Option<Rates>,
    status: String,
    #[serde(skip)]
    verdict: Verdict,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Right,
    Skipped,
    Failed,
}

impl NoPicture {
    /// The reason that an error states.
    pub(crate) fn failed(error: anyhow::Error) -> Self {
        Self::Failed(format!("{error:#}"))
    }
}

impl Record {
    pub(crate) fn new(board: &Board, picture: &Picture, outcome: Result<Figures, NoPicture>) -> Self {
        let (verdict, status, figures) = match outcome {
            Ok(figures) if figures.pixels_differ > 0 => (
                Verdict::Failed,
                format!("failed: {} pixels differ from the host's", figures.pixels_differ),
                Some(figures),
            ),
            Ok(figures) if figures.digest != figures.host_digest => {
                (Verdict::Failed, "failed: the digest differs from the host's".into(), Some(figures))
            }
            Ok(figures) => (Verdict::Right, "ok".into(), Some(figures)),
            Err(NoPicture::Skipped(reason)) => (Verdict::Skipped, format!("skipped: {reason}"), None),
            Err(NoPicture::Failed(reason)) => (Verdict::Failed, format!("failed: {reason}"), None),
        };
        let pixels = picture.size.pixels() as f64;
        let hexadecimal = |digest: u64| format!("{digest:016x}");
        Self {
            board: board.name,
            core: board.core,
            scene: picture.scene.name,
            width: picture.size.width,
            height: picture.size.height,
            number: picture.number.name(),
            mode: picture.mode.name(),
            small: picture.small,
            rays: figures.map(|figures| figures.rays),
            // To a hundredth.
            psnr_db: figures.and_then(|figures| figures.psnr_db).map(|psnr| (psnr * 100.0).round() / 100.0),
            instructions: figures.map(|figures| figures.instructions),
            // To a tenth.
            instructions_per_pixel: figures
                .map(|figures| (figures.instructions as f64 / pixels * 10.0).round() / 10.0),
            digest: figures.map(|figures| hexadecimal(figures.digest)),
            host_digest: figures.map(|figures| hexadecimal(figures.host_digest)),
            text_bytes: figures.map(|figures| figures.text_bytes),
            static_ram_bytes: figures.map(|figures| figures.static_ram_bytes),
            stack_bytes: figures.map(|figures| figures.stack_bytes),
            rates: figures.and_then(|figures| figures.timing).map(|timing| timing.rates()),
            status,
            verdict,
        }
    }

    /// The outcome, in a line.
    pub(crate) fn status(&self) -> &str {
        &self.status
    }

    /// Whether the program ran, and its picture is the host's.
    pub(crate) fn is_right(&self) -> bool {
        self.verdict == Verdict::Right
    }

    /// Whether the board did not fail. A skipped board fails if all boards are required.
    pub(crate) fn is_accepted(&self, all_required: bool) -> bool {
        match self.verdict {
            Verdict::Right => true,
            Verdict::Skipped => !all_required,
            Verdict::Failed => false,
        }
    }

    /// The time of frames in a line, where the emulator counts cycles.
    pub(crate) fn pace(&self) -> Option<String> {
        self.rates.map(|rates| format!("{}: {rates}", self.board))
    }

    fn cells(&self) -> [String; HEADINGS.len()] {
        let count = |count: Option<u64>| count.map_or("-".into(), with_commas);
        let pixels = f64::from(self.width) * f64::from(self.height);
        let bytes = |bytes: Option<u64>| bytes.map_or("-".into(), |bytes| with_commas(bytes) + " B");
        let verdict = match self.verdict {
            Verdict::Right => "yes",
            Verdict::Skipped => "skipped",
            Verdict::Failed => "no",
        };
        [
            self.board.into(),
            self.core.into(),
            self.scene.into(),
            format!("{}x{}", self.width, self.height),
            self.number.into(),
            self.mode.into(),
            self.psnr_db.map_or("-".into(), |psnr| format!("{psnr:.1} dB")),
            // From the exact count: `instructions_per_pixel` is already rounded.
            count(self.instructions.map(|count| (count as f64 / pixels).round() as u64)),
            bytes(self.text_bytes),
            bytes(self.static_ram_bytes),
            bytes(self.stack_bytes),
            verdict.into(),
        ]
    }
}

const HEADINGS: [(&str, Align); 12] = [
    ("board", Align::Left),
    ("core", Align::Left),
    ("scene", Align::Left),
    ("size", Align::Right),
    ("number", Align::Left),
    ("mode", Align::Left),
    ("PSNR", Align::Right),
    ("instr/pixel", Align::Right),
    ("flash", Align::Right),
    ("RAM", Align::Right),
    ("stack", Align::Right),
    ("digest ok", Align::Left),
];

/// All results as a table.
pub(crate) fn table(records: &[Record]) -> Table {
    let mut table = Table::new(HEADINGS);
    for record in records {
        table.push(record.cells());
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::BOARDS;
    use crate::request::Request;

    fn record(outcome: Result<Figures, NoPicture>) -> Record {
        let board = &BOARDS[0];
        Record::new(board, &Request::new("classic").unwrap().on(board), outcome)
    }

    const FIGURES: Figures = Figures {
        instructions: 8_192_000,
        digest: 0xAB,
        host_digest: 0xAB,
        pixels_differ: 0,
        text_bytes: 20_000,
        static_ram_bytes: 999,
        stack_bytes: 1_000,
        timing: None,
        rays: 20_000,
        psnr_db: Some(41.256),
    };

    #[test]
    fn the_json_has_every_figure() {
        let json = serde_json::to_value(record(Ok(FIGURES))).unwrap();
        let expected = serde_json::json!({
            "board": "lm3s6965evb", "core": "Cortex-M3", "scene": "classic", "width": 128, "height": 64,
            "number": "f32", "mode": "exact", "small": false, "rays": 20_000, "psnr_db": 41.26,
            "instructions": 8_192_000, "instructions_per_pixel": 1000.0,
            "digest": "00000000000000ab", "host_digest": "00000000000000ab",
            "text_bytes": 20_000, "static_ram_bytes": 999, "stack_bytes": 1_000, "status": "ok",
        });
        assert_eq!(json, expected);
    }

    #[test]
    fn a_picture_that_differs_fails() {
        assert!(record(Ok(FIGURES)).is_accepted(true));
        assert!(!record(Ok(Figures { digest: 1, ..FIGURES })).is_accepted(false));
        assert!(!record(Ok(Figures { pixels_differ: 1, ..FIGURES })).is_accepted(false));
        assert!(!record(Err(NoPicture::Failed("no reason".into()))).is_accepted(false));
    }

    #[test]
    fn a_skipped_board_fails_only_if_all_are_required() {
        let skipped = record(Err(NoPicture::Skipped("no emulator".into())));
        assert!(skipped.is_accepted(false));
        assert!(!skipped.is_accepted(true));
        assert_eq!(skipped.status(), "skipped: no emulator");
    }

    #[test]
    fn the_table_has_a_row_for_each_board() {
        let text = table(&[record(Ok(FIGURES)), record(Err(NoPicture::Skipped(String::new())))]).to_string();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[2],
            "| lm3s6965evb | Cortex-M3 | classic | 128x64 | f32    | exact | 41.3 dB |       1,000 | 20,000 \
             B | 999 B | \
             1,000 B | yes       |"
        );
        assert_eq!(lines.len(), 4);
    }
}
