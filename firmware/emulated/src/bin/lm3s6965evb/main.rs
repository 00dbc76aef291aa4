//! Stellaris LM3S6965EVB, a Cortex-M3 with 64 KB of RAM: the picture goes to its OLED panel, in 16 grays.

#![no_std]
#![no_main]

mod board;
mod gpio;
mod ssi;

use cortex_m::{Peripherals, asm};
use cortex_m_rt::entry;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::pixelcolor::Gray4;
use embedded_graphics::prelude::GrayColor;
use embedded_graphics::primitives::Rectangle;
use rayline_emulated::picture::{Memory, WIDTH};
use rayline_emulated::{Fault, InstructionCounter, SysTick, program, report};
use rayline_ssd0323::Ssd0323;

#[entry]
fn main() -> ! {
    static mut MEMORY: Memory = Memory::new();
    static mut LINE: [Gray4; WIDTH] = [Gray4::BLACK; WIDTH];
    // SAFETY: nothing else in this program uses a peripheral of the core.
    #[allow(unsafe_code)]
    let core = unsafe { Peripherals::steal() };
    board::set_clock();
    // The clock runs at 25 MHz: a period of 40 ns.
    let counter = SysTick::start(core.SYST, 80);
    match show(MEMORY, LINE, &counter) {
        // The picture stays on the panel, where the host looks at it.
        Ok(()) => loop {
            asm::wfi();
        },
        Err(fault) => report::fail(fault),
    }
}

fn show(
    memory: &mut Memory,
    line: &mut [Gray4; WIDTH],
    counter: &impl InstructionCounter,
) -> Result<(), Fault> {
    let (bus, data_command) = board::panel();
    let mut panel = Ssd0323::new(bus, data_command).map_err(|_| Fault::Output)?;
    panel.clear(Gray4::BLACK).map_err(|_| Fault::Output)?;
    let figures = program::run(memory, line, counter, |y, line| {
        let area = Rectangle::new(Point::new(0, y as i32), Size::new(WIDTH as u32, 1));
        panel.fill_contiguous(&area, line.iter().copied()).map_err(|_| Fault::Output)
    })?;
    figures.tell()
}
