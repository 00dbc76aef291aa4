//! The program from outside: what it writes, what it says, and how it fails.

mod bench;
mod errors;
mod pictures;
mod reports;
