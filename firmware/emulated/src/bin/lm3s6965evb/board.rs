//! The board's wiring (Texas Instruments, "Stellaris LM3S6965 Microcontroller Data Sheet"; "LM3S6965
//! Evaluation Board User's Manual"): the panel is on SSI0, its data/command pin is PC7, and `system control`
//! holds the clocks of both.

use crate::gpio::Output;
use crate::registers::modify;
use crate::ssi::Ssi;

/// Base address of system control, and offsets of registers in it.
const SYSTEM_CONTROL: usize = 0x400F_E000;
const RCC: usize = 0x060;
const RCGC1: usize = 0x104;
const RCGC2: usize = 0x108;

/// The divisor of the 200 MHz clock, minus one.
const SYSDIV: u32 = 7;

/// Base addresses of peripherals.
const GPIO_A: usize = 0x4000_4000;
const GPIO_C: usize = 0x4000_6000;
const SSI_0: usize = 0x4000_8000;

/// SSI0's clock, transmit and receive pins on port A. The board drives chip select.
const SSI_PINS: u32 = 1 << 2 | 1 << 3 | 1 << 5;

/// Sets the clock to 25 MHz, the frequency that `build.rs` gives the counter of instructions.
pub(crate) fn set_clock() {
    modify(SYSTEM_CONTROL + RCC, |rcc| rcc & !(0xF << 23) | SYSDIV << 23 | 1 << 22);
}

/// Turns on the panel's bus and its data/command pin.
pub(crate) fn panel() -> (Ssi, Output) {
    modify(SYSTEM_CONTROL + RCGC1, |clocks| clocks | 1 << 4);
    modify(SYSTEM_CONTROL + RCGC2, |clocks| clocks | 1 << 2 | 1);
    // Alternate function and digital enable of the bus's pins.
    modify(GPIO_A + 0x420, |pins| pins | SSI_PINS);
    modify(GPIO_A + 0x51C, |pins| pins | SSI_PINS);
    (Ssi::new(SSI_0), Output::new(GPIO_C, 7))
}
