//! Programs for emulated boards. They render with the core, and report digests of pixels, instructions and
//! stack to the emulator's host, which compares them with its own pictures: `cargo boards`.
//!
//! - [`file`] draws one picture into a file of the host: the program `picture`.
//! - `gallery` draws many scenes, which it reads from a file of the host: the program `gallery`.
//! - `src/bin/lm3s6965evb` draws one picture on that board's OLED panel.
//!
//! `build.rs` writes scene, size, number system and mode as Rust when a program is built, and links it for
//! the memory of a board: a folder in `boards`.
//!
//! The programs hold no panic: one that does is not linked, see `panic`.

#![no_std]

mod counter;
mod fault;
pub mod file;
mod fpu;
#[cfg(feature = "gallery")]
pub mod gallery;
mod meter;
#[cfg(target_arch = "riscv32")]
mod minstret;
mod panic;
pub mod picture;
pub mod program;
pub mod report;
mod stack;
#[cfg(target_arch = "arm")]
mod systick;

pub use counter::Counter;
pub use fault::Fault;
