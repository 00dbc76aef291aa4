//! Tests of the program: its files, its output and its errors.

// All of this is test code, but clippy counts only functions with `#[test]` as such.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

mod bench;
mod errors;
mod exports;
mod exposure;
#[cfg(unix)]
mod files;
mod films;
mod measurements;
mod pictures;
mod reports;
