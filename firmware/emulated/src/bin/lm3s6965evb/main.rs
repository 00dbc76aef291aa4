//! Stellaris LM3S6965EVB, a Cortex-M3 with 64 KB of RAM: draws the picture on its OLED panel, in 16 grays.

#![no_std]
#![no_main]

mod board;
mod gpio;
mod registers;
mod ssi;

use cortex_m::asm;
use cortex_m_rt::entry;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::GrayColor;
use rayline_emulated::picture::{Buffer, Memory};
use rayline_emulated::{Counter, Fault, program, report};
use rayline_ssd0323::Ssd0323;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut BUFFER: Buffer<Gray4> = Buffer::new(Gray4::BLACK);
    board::set_clock();
    match show(MEMORY, BUFFER, Counter::start()) {
        // The picture stays on the panel, where the host reads it.
        Ok(()) => loop {
            asm::wfi();
        },
        Err(fault) => report::fail(fault),
    }
}

/// Draws the picture on the panel, and reports the figures.
fn show(memory: &mut Memory, buffer: &mut Buffer<Gray4>, counter: Counter) -> Result<(), Fault> {
    let (bus, data_command) = board::panel();
    let mut panel = Ssd0323::new(bus, data_command).map_err(|_| Fault::Output)?;
    panel.clear(Gray4::BLACK).map_err(|_| Fault::Output)?;
    program::run(memory, buffer, counter, &mut panel)?.report()
}
