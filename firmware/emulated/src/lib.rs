//! The program that every emulated board runs: it renders a built-in scene and reports the digest of its pixels, the
//! instructions that rendering took, and the stack that was used.
//!
//! A board is a folder in `src/bin` with its memory layout and a `main` that says how to count instructions and
//! where the picture goes. Scene, size, number system and mode are chosen when the program is built, see `build.rs`.
//!
//! A second program, [`gallery`], is one for all boards and all scenes.
//!
//! Everything that the program says goes through [`report`]; it holds no panic, and a linker that finds one
//! refuses it, see `panic`.

#![no_std]

pub mod file;
mod fpu;
#[cfg(feature = "gallery")]
pub mod gallery;
mod instructions;
mod meter;
mod panic;
pub mod picture;
pub mod program;
pub mod report;
mod stack;
#[cfg(target_arch = "arm")]
mod systick;

pub use instructions::InstructionCounter;
#[cfg(target_arch = "riscv32")]
pub use instructions::Minstret;
pub use program::Fault;
#[cfg(target_arch = "arm")]
pub use systick::SysTick;
