//! The traits of embedded-hal 0.2, which older drivers take.

use std::convert::Infallible;

use embedded_hal_02::blocking::{delay, i2c, spi};
use embedded_hal_02::digital::v2::{InputPin, OutputPin};

use super::{Bus, DataPin, Delay, Idle, Pin, Unplugged};

impl spi::Write<u8> for Bus {
    type Error = Unplugged;

    fn write(&mut self, bytes: &[u8]) -> Result<(), Unplugged> {
        self.send_spi(bytes)
    }
}

impl spi::Transfer<u8> for Bus {
    type Error = Unplugged;

    fn transfer<'w>(&mut self, bytes: &'w mut [u8]) -> Result<&'w [u8], Unplugged> {
        self.send_spi(bytes)?;
        // Nothing is connected to the wire that would answer.
        bytes.fill(0xFF);
        Ok(bytes)
    }
}

impl i2c::Write for Bus {
    type Error = Unplugged;

    fn write(&mut self, _: u8, bytes: &[u8]) -> Result<(), Unplugged> {
        self.send_i2c(bytes)
    }
}

impl OutputPin for DataPin {
    type Error = Infallible;

    fn set_low(&mut self) -> Result<(), Infallible> {
        embedded_hal::digital::OutputPin::set_low(self)
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        embedded_hal::digital::OutputPin::set_high(self)
    }
}

impl OutputPin for Pin {
    type Error = Infallible;

    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

impl InputPin for Idle {
    type Error = Infallible;

    fn is_high(&self) -> Result<bool, Infallible> {
        Ok(self.is_high)
    }

    fn is_low(&self) -> Result<bool, Infallible> {
        Ok(!self.is_high)
    }
}

impl<T> delay::DelayMs<T> for Delay {
    fn delay_ms(&mut self, _: T) {}
}

impl<T> delay::DelayUs<T> for Delay {
    fn delay_us(&mut self, _: T) {}
}
