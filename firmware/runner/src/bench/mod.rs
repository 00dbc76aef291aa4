//! `cargo boards --bench`: what each kind of processor takes, next to what it should take.

mod committed;
mod measured;
mod tables;

use std::time::Duration;

use anyhow::{Result, bail};

use crate::board::BOARDS;
use crate::picture::{Mode, Number, Size};
use crate::request::Request;
use crate::session::Session;
use crate::toolchain::Toolchain;
use committed::Committed;
use measured::Measured;

/// What to do with the measurements, besides showing them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Action {
    Show,
    /// Writes the table that is kept with the source.
    Update,
    /// Compares them with that table.
    Check,
}

/// A program that is measured.
#[derive(Clone, Copy, Debug)]
struct Entry {
    board: &'static str,
    scene: &'static str,
    number: Number,
    mode: Mode,
    small: bool,
    /// `None`: the board's own.
    size: Option<Size>,
}

const fn entry(board: &'static str, scene: &'static str, number: Number, mode: Mode) -> Entry {
    Entry { board, scene, number, mode, small: false, size: Some(SIZE) }
}

/// The same exact picture, by a program without what only makes it faster.
const fn small(board: &'static str, scene: &'static str, number: Number) -> Entry {
    Entry { small: true, ..entry(board, scene, number, Mode::Exact) }
}

/// Frames on a board with a panel.
const fn frames(board: &'static str, mode: Mode) -> Entry {
    Entry { size: None, ..entry(board, "classic", Number::Fixed, mode) }
}

const M4F: &str = "mps2-an386";
const M3: &str = "mps2-an385";
/// It has the instructions of an M0+.
const M0: &str = "microbit";

const PICO: &str = "pico-dual";

const SIZE: Size = Size { width: 320, height: 240 };

const ENTRIES: [Entry; 18] = [
    entry(M4F, "classic", Number::F32, Mode::Exact),
    entry(M3, "classic", Number::Fixed, Mode::Exact),
    entry(M0, "classic", Number::Fixed, Mode::Exact),
    entry(M4F, "classic", Number::F32, Mode::Realtime),
    entry(M3, "classic", Number::Fixed, Mode::Realtime),
    entry(M0, "classic", Number::Fixed, Mode::Realtime),
    entry(M4F, "flake-10", Number::F32, Mode::Exact),
    entry(M4F, "flake-91", Number::F32, Mode::Exact),
    entry(M4F, "flake-820", Number::F32, Mode::Exact),
    entry(M4F, "spheres", Number::F32, Mode::Exact),
    entry(M4F, "torus", Number::F32, Mode::Exact),
    entry(M4F, "csg", Number::F32, Mode::Exact),
    entry(M4F, "mesh", Number::F32, Mode::Exact),
    frames(PICO, Mode::Exact),
    frames(PICO, Mode::Realtime),
    small(M4F, "spheres", Number::F32),
    small(M4F, "classic", Number::F32),
    small(M0, "classic", Number::Fixed),
];

/// Measures all entries and prints the tables; tells whether everything holds.
pub(crate) fn run(action: Action, timeout: Duration, all_required: bool) -> Result<bool> {
    let (mut measured, mut complete, mut accepted) = (Vec::new(), true, true);
    for (index, entry) in ENTRIES.into_iter().enumerate() {
        let session = entry.session(timeout)?;
        eprintln!("{} of {}: {}", index + 1, ENTRIES.len(), session.picture);
        let record = session.run();
        accepted &= record.is_accepted(all_required);
        match Measured::of(&record) {
            Some(figures) => measured.push(figures),
            None => complete = false,
        }
    }
    print!("{}", tables::Tables(&measured));
    match action {
        Action::Show => Ok(accepted),
        Action::Update if !complete || !accepted => bail!("the table is written only if every board ran"),
        Action::Update => {
            Committed { compiler: compiler()?, measured }.write()?;
            Ok(true)
        }
        Action::Check if measured.is_empty() => Ok(accepted),
        Action::Check => Ok(Committed::read()?.check(&compiler()?, &measured) && accepted),
    }
}

impl Entry {
    fn session(&self, timeout: Duration) -> Result<Session<'static>> {
        let Self { board, scene, number, mode, small, size } = *self;
        let request = Request { size, number, mode, small, ..Request::new(scene)? };
        let Some(board) = BOARDS.iter().find(|known| known.name == board) else {
            bail!("there is no board {board}");
        };
        Ok(Session { board, picture: request.on(board), picture_file: None, timeout })
    }
}

/// The compiler that the counts hold for: all boards have the same.
fn compiler() -> Result<String> {
    let Some(board) = BOARDS.iter().find(|board| board.name == M4F) else { bail!("there is no board {M4F}") };
    Toolchain::find(board.target).map_err(anyhow::Error::msg)?.name()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_can_be_measured() {
        for entry in ENTRIES {
            let session = entry.session(Duration::from_secs(1)).unwrap();
            assert_eq!((session.board.name, session.picture.scene.name), (entry.board, entry.scene));
            assert_eq!((session.picture.number, session.picture.mode), (entry.number, entry.mode));
            session.board.draws(entry.mode).unwrap();
        }
    }
}
