//! Counting instructions.

/// Counts the instructions that the processor has executed.
pub trait InstructionCounter {
    /// Instructions since some moment.
    fn now(&self) -> u64;
}

/// The counter of retired instructions that every RISC-V processor has.
#[cfg(target_arch = "riscv32")]
#[derive(Clone, Copy, Debug)]
pub struct Minstret;

#[cfg(target_arch = "riscv32")]
impl InstructionCounter for Minstret {
    fn now(&self) -> u64 {
        riscv::register::minstret::read64()
    }
}
