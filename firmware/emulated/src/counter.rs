//! The counter of executed instructions: each kind of processor has its own.

#[cfg(target_arch = "riscv32")]
pub use crate::minstret::Minstret as Counter;
#[cfg(target_arch = "arm")]
pub use crate::systick::SysTick as Counter;
