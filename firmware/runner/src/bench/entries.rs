//! The programs that are measured.

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, Result};

use crate::board::{BOARDS, Board};
use crate::picture::{Mode, Number, Size};
use crate::request::Request;
use crate::session::Session;

pub(super) const M4F: &str = "mps2-an386";
const M7: &str = "mps2-an500";
pub(super) const M3: &str = "mps2-an385";
/// A Cortex-M0. A Cortex-M0+ executes the same instructions.
pub(super) const M0: &str = "microbit";
/// Code for a Cortex-M0 with more RAM than a microbit has.
pub(super) const LARGE_M0: &str = "mps2-an385-v6m";
pub(super) const PICO: &str = "pico";
pub(super) const DUAL_PICO: &str = "pico-dual";

/// Size of most pictures.
const QVGA: Size = Size { width: 320, height: 240 };
/// Size of the pictures that compare scenes in fixed point: a quarter, which keeps the bench short.
const QQVGA: Size = Size { width: 160, height: 120 };
/// Size at which a Pico turns [`BAKED`] at ten frames a second.
const SMALL: Size = Size { width: 80, height: 60 };

/// A mesh of 2,120 triangles.
pub(super) const TEAPOT: &str = "show-teapot";
/// The Cornell box with its light in textures.
pub(super) const BAKED: &str = "light-baked";

/// The scenes of `docs/gallery` that are measured.
pub(super) const OF_GALLERY: [&str; 2] = [TEAPOT, BAKED];

/// The scenes that are measured in fixed point beside `classic`.
pub(super) const FIXED_SCENES: [&str; 4] = ["whitted", "flake-91", "table", TEAPOT];

/// A program that is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) board: &'static str,
    pub(super) scene: &'static str,
    number: Number,
    mode: Mode,
    small: bool,
    /// `None`: the board's own size.
    size: Option<Size>,
}

const fn entry(board: &'static str, scene: &'static str, number: Number, mode: Mode) -> Entry {
    Entry { board, scene, number, mode, small: false, size: Some(QVGA) }
}

/// An exact picture by a program without the features that only make it faster.
const fn small(board: &'static str, scene: &'static str, number: Number) -> Entry {
    Entry { small: true, ..entry(board, scene, number, Mode::Exact) }
}

/// `classic` at the board's own size.
const fn own_size(board: &'static str, number: Number, mode: Mode) -> Entry {
    Entry { size: None, ..entry(board, "classic", number, mode) }
}

/// The programs beside those of [`FIXED_SCENES`] and those of all boards.
const ENTRIES: [Entry; 27] = [
    entry(M4F, "classic", Number::F32, Mode::Exact),
    // The same program, which is not built again.
    entry(M7, "classic", Number::F32, Mode::Exact),
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
    own_size(PICO, Number::Fixed, Mode::Exact),
    own_size(PICO, Number::Fixed, Mode::Realtime),
    own_size(DUAL_PICO, Number::Fixed, Mode::Exact),
    own_size(DUAL_PICO, Number::Fixed, Mode::Realtime),
    Entry { size: Some(SMALL), ..entry(DUAL_PICO, BAKED, Number::Fixed, Mode::Exact) },
    small(M4F, "spheres", Number::F32),
    small(M4F, "classic", Number::F32),
    small(M0, "classic", Number::Fixed),
    entry(M4F, "classic", Number::F32, Mode::Preview),
    entry(M4F, "mesh", Number::F32, Mode::Preview),
    entry(M4F, "flake-10", Number::F32, Mode::Preview),
    entry(M4F, "flake-91", Number::F32, Mode::Preview),
    entry(LARGE_M0, "classic", Number::Fixed, Mode::Preview),
];

/// All programs. Those of all boards stand last, because `rayline check` reads the first picture of a scene
/// on a board, which must be the one in the processor's own number system.
pub(super) fn entries() -> Vec<Entry> {
    let mut entries = ENTRIES.to_vec();
    for scene in FIXED_SCENES {
        for board in [M3, LARGE_M0] {
            for mode in [Mode::Exact, Mode::Realtime] {
                entries.push(Entry { size: Some(QQVGA), ..entry(board, scene, Number::Fixed, mode) });
            }
        }
    }
    let own = qemu_boards().map(|board| Entry {
        size: Some(board.size),
        ..entry(board.name, "classic", Number::F32, Mode::Exact)
    });
    for entry in own {
        if !entries.contains(&entry) {
            entries.push(entry);
        }
    }
    entries
}

/// The real boards in QEMU, whose programs compute in any number system.
fn qemu_boards() -> impl Iterator<Item = &'static Board> {
    BOARDS.iter().filter(|board| !board.stands_in && ![PICO, DUAL_PICO].contains(&board.name))
}

impl Entry {
    /// The session that measures the program. `files` are those with the bytes of [`OF_GALLERY`].
    pub(super) fn session(&self, files: &[PathBuf], timeout: Duration) -> Result<Session<'static>> {
        let Self { board, scene, number, mode, small, size } = *self;
        let file = OF_GALLERY.into_iter().zip(files).find(|(name, _)| *name == scene);
        let source = match file {
            Some((_, file)) => file.to_str().context("a path that is not UTF-8")?,
            None => scene,
        };
        let request = Request { size, number, mode, small, ..Request::new(source)? };
        let board = Board::named(board)?;
        Ok(Session::new(board, request.on(board), timeout))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_entry_can_be_measured() {
        for entry in entries().into_iter().filter(|entry| !OF_GALLERY.contains(&entry.scene)) {
            let session = entry.session(&[], Duration::from_secs(1)).unwrap();
            assert_eq!((session.board.name, session.picture.scene.name), (entry.board, entry.scene));
            assert_eq!((session.picture.number, session.picture.mode), (entry.number, entry.mode));
            session.board.draws(entry.mode).unwrap();
        }
    }

    #[test]
    fn no_program_is_measured_twice() {
        let entries = entries();
        for (index, entry) in entries.iter().enumerate() {
            assert!(!entries[..index].contains(entry), "{entry:?}");
        }
    }

    #[test]
    fn every_board_is_measured() {
        for board in BOARDS {
            assert!(entries().iter().any(|entry| entry.board == board.name), "{}", board.name);
        }
    }

    #[test]
    fn the_first_picture_of_a_scene_is_in_the_processors_own_numbers() {
        for (board, number) in [(M4F, Number::F32), (M3, Number::Fixed), (M0, Number::Fixed)] {
            let entries = entries();
            let first =
                entries.iter().find(|entry| (entry.board, entry.scene) == (board, "classic")).unwrap();
            assert_eq!((first.number, first.mode, first.small), (number, Mode::Exact, false));
        }
    }
}
