//! A pin of a port that is an output.

use core::convert::Infallible;

use embedded_hal::digital::{ErrorType, OutputPin};

use crate::board::{modify, write};

/// A pin that is an output.
#[derive(Debug)]
pub(crate) struct Output {
    /// The address under which this pin alone is written.
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
        // Bits 2 to 9 of the address say which pins a write concerns.
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
