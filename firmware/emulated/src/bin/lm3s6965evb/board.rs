//! How the board is wired (Texas Instruments, "Stellaris LM3S6965 Microcontroller Data Sheet"; "LM3S6965
//! Evaluation Board User's Manual"): the panel on SSI0, its data/command pin on PC7, all under `system control`.

use crate::gpio::Output;
use crate::ssi::Ssi;

/// Base address of system control, and registers in it.
const SYSTEM_CONTROL: usize = 0x400F_E000;
const RCC: usize = 0x060;
const RCGC1: usize = 0x104;
const RCGC2: usize = 0x108;

/// The clock is 200 MHz divided by one more than this.
const SYSDIV: u32 = 7;

const GPIO_A: usize = 0x4000_4000;
const GPIO_C: usize = 0x4000_6000;
const SSI_0: usize = 0x4000_8000;

/// SSI0's clock, transmit and receive pins on port A. Chip select is left to the board.
const SSI_PINS: u32 = 1 << 2 | 1 << 3 | 1 << 5;

/// Sets the clock to 25 MHz.
pub(crate) fn set_clock() {
    modify(SYSTEM_CONTROL + RCC, |rcc| rcc & !(0xF << 23) | SYSDIV << 23 | 1 << 22);
}

/// Turns on what the panel hangs on: its bus, and its data/command pin.
pub(crate) fn panel() -> (Ssi, Output) {
    modify(SYSTEM_CONTROL + RCGC1, |clocks| clocks | 1 << 4);
    modify(SYSTEM_CONTROL + RCGC2, |clocks| clocks | 1 << 2 | 1);
    // Alternate function and digital enable of the bus's pins.
    modify(GPIO_A + 0x420, |pins| pins | SSI_PINS);
    modify(GPIO_A + 0x51C, |pins| pins | SSI_PINS);
    (Ssi::new(SSI_0), Output::new(GPIO_C, 7))
}

/// Reads a register.
pub(crate) fn read(address: usize) -> u32 {
    // SAFETY: only registers of peripherals that this program owns are read, at their own addresses.
    #[allow(unsafe_code)]
    unsafe {
        (address as *const u32).read_volatile()
    }
}

/// Writes a register.
pub(crate) fn write(address: usize, value: u32) {
    // SAFETY: as above.
    #[allow(unsafe_code)]
    unsafe {
        (address as *mut u32).write_volatile(value);
    }
}

/// Reads a register and writes it.
pub(crate) fn modify(address: usize, change: impl FnOnce(u32) -> u32) {
    write(address, change(read(address)));
}
