//! BBC micro:bit, a Cortex-M0 with 16 KB of RAM.

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
    // The clock runs at 16 MHz: a period of 62.5 ns.
    file::main(SysTick::start(core.SYST, 125))
}
