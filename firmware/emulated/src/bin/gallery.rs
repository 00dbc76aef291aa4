//! Draws many scenes, one after the other. One source serves all boards: it needs no device of theirs.

#![no_std]
#![no_main]

#[cfg_attr(target_arch = "arm", cortex_m_rt::entry)]
#[cfg_attr(target_arch = "riscv32", riscv_rt::entry)]
fn main() -> ! {
    rayline_emulated::gallery::main()
}
