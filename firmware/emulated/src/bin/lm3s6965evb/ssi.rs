//! The synchronous serial interface, as an SPI bus.

use core::convert::Infallible;

use embedded_hal::spi::{ErrorType, SpiBus};

use crate::registers::{read, write};

/// Offsets of registers.
const CR0: usize = 0x0;
const CR1: usize = 0x4;
const DATA: usize = 0x8;
const STATUS: usize = 0xC;
const PRESCALE: usize = 0x10;

/// Status bits.
const TRANSMIT_NOT_FULL: u32 = 1 << 1;
const RECEIVE_NOT_EMPTY: u32 = 1 << 2;
const BUSY: u32 = 1 << 4;

/// An SPI bus in mode 3.
#[derive(Debug)]
pub(crate) struct Ssi {
    base: usize,
}

impl Ssi {
    /// Turns the bus on: 8 bits, mode 3, at half of the processor's clock.
    pub(crate) fn new(base: usize) -> Self {
        write(base + CR1, 0);
        write(base + CR0, 0xC7);
        write(base + PRESCALE, 2);
        write(base + CR1, 1 << 1);
        Self { base }
    }

    /// Sends a byte and returns the received one. Each received byte must be read: a full receive buffer
    /// stops the bus.
    fn exchange(&mut self, byte: u8) -> u8 {
        while read(self.base + STATUS) & TRANSMIT_NOT_FULL == 0 {}
        write(self.base + DATA, byte.into());
        while read(self.base + STATUS) & RECEIVE_NOT_EMPTY == 0 {}
        read(self.base + DATA) as u8
    }
}

impl ErrorType for Ssi {
    type Error = Infallible;
}

impl SpiBus for Ssi {
    fn read(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(0);
        }
        Ok(())
    }

    fn write(&mut self, words: &[u8]) -> Result<(), Infallible> {
        for word in words {
            self.exchange(*word);
        }
        Ok(())
    }

    fn transfer(&mut self, received: &mut [u8], words: &[u8]) -> Result<(), Infallible> {
        // The longer slice sets the length: missing bytes are sent as zeros, received bytes without a place
        // are dropped.
        for index in 0..received.len().max(words.len()) {
            let byte = self.exchange(words.get(index).copied().unwrap_or(0));
            if let Some(slot) = received.get_mut(index) {
                *slot = byte;
            }
        }
        Ok(())
    }

    fn transfer_in_place(&mut self, words: &mut [u8]) -> Result<(), Infallible> {
        for word in words {
            *word = self.exchange(*word);
        }
        Ok(())
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        while read(self.base + STATUS) & BUSY != 0 {}
        Ok(())
    }
}
