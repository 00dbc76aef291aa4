//! Stellaris LM3S6965EVB, a Cortex-M3 with 64 KB of RAM: the picture goes to its OLED panel, in 16 grays.

#![no_std]
#![no_main]

mod board;
mod gpio;
mod ssi;

use cortex_m::{Peripherals, asm};
use cortex_m_rt::entry;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::GrayColor;
use rayline_emulated::picture::{Buffer, Memory};
use rayline_emulated::{Fault, InstructionCounter, SysTick, program, report};
use rayline_ssd0323::Ssd0323;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut BUFFER: Buffer<Gray4> = Buffer::new(Gray4::BLACK);
    // SAFETY: nothing else in this program uses a peripheral of the core.
    #[allow(unsafe_code)]
    let core = unsafe { Peripherals::steal() };
    board::set_clock();
    // The clock runs at 25 MHz: a period of 40 ns.
    let counter = SysTick::start(core.SYST, 80);
    match show(MEMORY, BUFFER, &counter) {
        // The picture stays on the panel, where the host looks at it.
        Ok(()) => loop {
            asm::wfi();
        },
        Err(fault) => report::fail(fault),
    }
}

fn show(
    memory: &mut Memory,
    buffer: &mut Buffer<Gray4>,
    counter: &impl InstructionCounter,
) -> Result<(), Fault> {
    let (bus, data_command) = board::panel();
    let mut panel = Ssd0323::new(bus, data_command).map_err(|_| Fault::Output)?;
    panel.clear(Gray4::BLACK).map_err(|_| Fault::Output)?;
    program::run(memory, buffer, counter, &mut panel)?.tell()
}
