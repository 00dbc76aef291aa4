//! Counts instructions with the counter of retired instructions that every RISC-V processor has.

/// The counter of retired instructions.
#[derive(Clone, Copy, Debug)]
pub struct Minstret;

impl Minstret {
    /// The counter runs from reset on: there is nothing to start.
    pub fn start() -> Self {
        Self
    }

    /// The number of instructions since reset.
    pub(crate) fn now(self) -> u64 {
        riscv::register::minstret::read64()
    }
}
