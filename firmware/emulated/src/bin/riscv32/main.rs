//! The machine `virt` of QEMU with a 32-bit RISC-V processor, without a floating-point unit.

#![no_std]
#![no_main]

use rayline_emulated::{Minstret, file};
use riscv_rt::entry;

#[entry]
fn main() -> ! {
    file::main(Minstret)
}
