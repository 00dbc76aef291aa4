//! An output pin of a port.

use core::convert::Infallible;

use embedded_hal::digital::{ErrorType, OutputPin};

use crate::registers::{modify, write};

/// An output pin.
#[derive(Debug)]
pub(crate) struct Output {
    /// The address that writes this pin and no other.
    data: usize,
    mask: u32,
}

impl Output {
    /// Makes pin `number`, 0 to 7, of a port an output.
    pub(crate) fn new(port: usize, number: u32) -> Self {
        let mask = 1 << number;
        // Direction and digital enable.
        modify(port + 0x400, |pins| pins | mask);
        modify(port + 0x51C, |pins| pins | mask);
        // Bits 2 to 9 of the address are the mask of the pins that a write changes.
        Self { data: port + ((mask as usize) << 2), mask }
    }
}

impl ErrorType for Output {
    type Error = Infallible;
}

impl OutputPin for Output {
    fn set_low(&mut self) -> Result<(), Infallible> {
        write(self.data, 0);
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        write(self.data, self.mask);
        Ok(())
    }
}
