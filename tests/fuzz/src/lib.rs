//! A search for scenes that break a promise of `rayline`:
//!
//! - the exact picture has the same bytes with and without all that only makes it faster;
//! - every pixel is finite, no pixel takes more rays than it may, and nothing panics or hangs;
//! - a picture in realtime quality has the same bytes in any bands and steps, and keeps its budgets;
//! - an importer reads any file or says why it cannot.
//!
//! [`Target`] lists where scenes come from. Each execution is a pure function of its seed: it makes a
//! scene and a [`Case`], draws the scene with this crate's `rayline` and with the package `rayline-plain`,
//! which holds the same sources without acceleration, and compares light of 16 bits a channel
//! ([`Bench::check`]).
//!
//! The test `gate` searches for a minute. By hand, `cargo run -p rayline-fuzz -- all --minutes 60`
//! searches for an hour, makes each finding smaller, writes it to a file, and prints the command that
//! replays it.

mod case;
mod check;
mod choices;
#[cfg(feature = "importers")]
mod importers;
mod minimize;
mod mutate;
mod pictures;
mod replay;
mod scene_bytes;
mod search;
mod structured;

pub use case::{Case, Number, Portions};
pub use check::{Bench, Finding, Held};
pub use choices::Choices;
pub use pictures::Light;
pub use replay::replay;
pub use search::{Counts, Found, Search, Target, Until};
