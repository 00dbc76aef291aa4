//! The asynchronous traits of embedded-hal.

use embedded_hal::spi::Operation;
use embedded_hal_async::{delay, spi};

use super::{Bus, Delay, Unplugged};

impl spi::SpiDevice for Bus {
    async fn transaction(&mut self, operations: &mut [Operation<'_, u8>]) -> Result<(), Unplugged> {
        embedded_hal::spi::SpiDevice::transaction(self, operations)
    }
}

impl delay::DelayNs for Delay {
    async fn delay_ns(&mut self, _: u32) {}
}
