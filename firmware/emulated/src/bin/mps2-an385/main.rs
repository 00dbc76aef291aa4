//! Arm MPS2 with a Cortex-M3 (AN385).

#![no_std]
#![no_main]

use cortex_m::Peripherals;
use cortex_m_rt::entry;
use rayline_emulated::{SysTick, file};

#[entry]
fn main() -> ! {
    // SAFETY: nothing else in this program uses a peripheral of the core.
    #[allow(unsafe_code)]
    let core = unsafe { Peripherals::steal() };
    // The clock runs at 25 MHz: a period of 40 ns.
    file::main(SysTick::start(core.SYST, 80))
}
