//! The tables of `docs/formats.md` against the importers and the export: each row has a file here, whose
//! outcome is the one that the row tells.

// All of this is test code, but clippy counts only functions with `#[test]` as such.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

mod gltf;
mod nff;
mod obj;
mod povray;
mod table;
