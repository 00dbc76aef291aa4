//! The results of boards as a table, and remarks on single scenes.

use std::fmt;

use crate::picture::Picture;
use crate::table::{Align, Table, with_commas};

/// The outcome of a board.
#[derive(Debug)]
pub(super) enum TourOutcome {
    /// The program ran; pictures may be wrong.
    Ran {
        /// Size and settings of each picture.
        picture: Picture,
        /// Bytes of flash of the program.
        text_bytes: u64,
        exhibits: Vec<Exhibit>,
    },
    /// The program cannot be run here, for this reason.
    Skipped(String),
    /// The program failed, for this reason.
    Failed(String),
}

/// A scene on a board.
#[derive(Clone, Copy, Debug)]
pub(super) struct Exhibit {
    pub(super) scene: &'static str,
    /// `None`: the board has too little memory for the scene.
    pub(super) drawn: Option<Drawn>,
    /// This computer's digest.
    pub(super) expected: u64,
    /// Bytes of memory for the scene's file, its lists, and the prepared scene; a lower bound if it was not
    /// drawn.
    pub(super) memory_bytes: u64,
}

/// A picture of a board.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drawn {
    pub(super) digest: u64,
    pub(super) stack_bytes: u64,
}

impl Exhibit {
    fn differs(&self) -> bool {
        self.drawn.is_some_and(|drawn| drawn.digest != self.expected)
    }
}

impl TourOutcome {
    fn exhibits(&self) -> &[Exhibit] {
        match self {
            Self::Ran { exhibits, .. } => exhibits,
            Self::Skipped(_) | Self::Failed(_) => &[],
        }
    }

    fn drawn(&self) -> impl Iterator<Item = (&Exhibit, Drawn)> {
        self.exhibits().iter().filter_map(|exhibit| Some((exhibit, exhibit.drawn?)))
    }

    /// Whether the board did not fail. A skipped board, and a scene without enough memory, fail if all are
    /// required.
    pub(super) fn is_accepted(&self, all_required: bool) -> bool {
        match self {
            Self::Ran { exhibits, .. } => {
                let drawn = self.drawn().count();
                let enough = if all_required { exhibits.len() } else { 1 };
                drawn >= enough && !exhibits.iter().any(Exhibit::differs)
            }
            Self::Skipped(_) => !all_required,
            Self::Failed(_) => false,
        }
    }

    /// A line for each scene that differs, and for each scene that the board has too little memory for.
    pub(super) fn remarks(&self) -> impl Iterator<Item = String> {
        let differ = self.drawn().filter(|(exhibit, _)| exhibit.differs()).map(|(exhibit, drawn)| {
            let Exhibit { scene, expected, .. } = exhibit;
            format!(
                "{scene} differs: its digest is {:016x}, and this computer's is {expected:016x}",
                drawn.digest
            )
        });
        let no_room = self.exhibits().iter().filter(|exhibit| exhibit.drawn.is_none());
        let no_room = no_room.map(|exhibit| {
            let needed = with_commas(exhibit.memory_bytes);
            format!("too little memory for {}, which needs {needed} B or more", exhibit.scene)
        });
        differ.chain(no_room)
    }

    fn cells(&self, board: &str, core: &str) -> [String; HEADINGS.len()] {
        let verdict = match self {
            Self::Ran { .. } if self.exhibits().iter().any(Exhibit::differs) => "no",
            Self::Ran { .. } => "yes",
            Self::Skipped(_) => "skipped",
            Self::Failed(_) => "no",
        };
        let most = |bytes: &dyn Fn(&(&Exhibit, Drawn)) -> u64| {
            let most = self.drawn().max_by_key(bytes);
            most.map_or("-".into(), |most| format!("{} B, {}", with_commas(bytes(&most)), most.0.scene))
        };
        let ran = |text: &dyn Fn(&Picture, u64) -> String| match self {
            Self::Ran { picture, text_bytes, .. } => text(picture, *text_bytes),
            Self::Skipped(_) | Self::Failed(_) => "-".into(),
        };
        [
            board.into(),
            core.into(),
            ran(&|picture, _| picture.size.to_string()),
            ran(&|picture, _| picture.number.name().into()),
            ran(&|picture, _| picture.mode.name().into()),
            ran(&|_, text_bytes| with_commas(text_bytes) + " B"),
            most(&|(exhibit, _)| exhibit.memory_bytes),
            most(&|(_, drawn)| drawn.stack_bytes),
            ran(&|_, _| format!("{} of {}", self.drawn().count(), self.exhibits().len())),
            verdict.into(),
        ]
    }
}

impl fmt::Display for TourOutcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Ran { exhibits, .. } => {
                write!(f, "{} of {} scenes drawn, ", self.drawn().count(), exhibits.len())?;
                match exhibits.iter().filter(|exhibit| exhibit.differs()).count() {
                    0 => f.write_str("no digest differs"),
                    count => write!(f, "{count} differ"),
                }
            }
            Self::Skipped(reason) => write!(f, "skipped: {reason}"),
            Self::Failed(reason) => write!(f, "failed: {reason}"),
        }
    }
}

const HEADINGS: [(&str, Align); 10] = [
    ("board", Align::Left),
    ("core", Align::Left),
    ("size", Align::Right),
    ("number", Align::Left),
    ("mode", Align::Left),
    ("flash", Align::Right),
    ("most memory", Align::Right),
    ("deepest stack", Align::Right),
    ("scenes", Align::Right),
    ("digests ok", Align::Left),
];

/// All boards as a table.
pub(super) fn table(outcomes: &[(&str, &str, TourOutcome)]) -> Table {
    let mut table = Table::new(HEADINGS);
    for (board, core, outcome) in outcomes {
        table.push(outcome.cells(board, core));
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::board::BOARDS;
    use crate::request::Request;

    const SAME: Exhibit = Exhibit {
        scene: "ball",
        drawn: Some(Drawn { digest: 0xAB, stack_bytes: 5_000 }),
        expected: 0xAB,
        memory_bytes: 2_000,
    };
    const OTHER: Exhibit = Exhibit {
        scene: "torus",
        drawn: Some(Drawn { digest: 0xAC, stack_bytes: 4_000 }),
        memory_bytes: 3_000,
        ..SAME
    };
    const TOO_LARGE: Exhibit = Exhibit { scene: "teapot", drawn: None, memory_bytes: 160_000, ..SAME };

    fn ran(exhibits: &[Exhibit]) -> TourOutcome {
        let picture = Request::new("classic").unwrap().on(&BOARDS[1]);
        TourOutcome::Ran { picture, text_bytes: 200_000, exhibits: exhibits.to_vec() }
    }

    #[test]
    fn a_picture_that_differs_fails_and_is_named() {
        let outcome = ran(&[SAME, OTHER]);
        assert!(!outcome.is_accepted(false));
        assert_eq!(outcome.to_string(), "2 of 2 scenes drawn, 1 differ");
        let remarks: Vec<String> = outcome.remarks().collect();
        assert_eq!(
            remarks,
            ["torus differs: its digest is 00000000000000ac, and this computer's is 00000000000000ab"]
        );
        assert!(ran(&[SAME]).is_accepted(true));
    }

    #[test]
    fn too_little_memory_fails_only_if_all_are_required_or_nothing_was_drawn() {
        let outcome = ran(&[SAME, TOO_LARGE]);
        assert!(outcome.is_accepted(false));
        assert!(!outcome.is_accepted(true));
        assert!(!ran(&[TOO_LARGE]).is_accepted(false));
        let remarks: Vec<String> = outcome.remarks().collect();
        assert_eq!(remarks, ["too little memory for teapot, which needs 160,000 B or more"]);
    }

    #[test]
    fn the_table_names_the_scenes_that_take_most() {
        let outcomes = [
            ("board", "core", ran(&[SAME, OTHER, TOO_LARGE])),
            ("other", "core", TourOutcome::Skipped("no emulator".into())),
        ];
        let text = table(&outcomes).to_string();
        let lines: Vec<&str> = text.lines().collect();
        let cells: Vec<&str> = lines[2].split('|').map(str::trim).collect();
        assert_eq!(
            cells[3..11],
            ["64x48", "f32", "exact", "200,000 B", "3,000 B, torus", "5,000 B, ball", "2 of 3", "no"]
        );
        assert!(lines[3].ends_with("| skipped    |"), "{}", lines[3]);
    }
}
