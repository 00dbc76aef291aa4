//! The program from outside: what it writes, what it says, and how it fails.

// All of it is test code; clippy counts only what is inside of `#[test]`.
#![allow(clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

mod bench;
mod errors;
mod measurements;
mod pictures;
mod reports;
