//! A bus that records what a driver sends, and can fail at any byte.

mod hal_02;
mod hal_async;

use std::cell::RefCell;
use std::convert::Infallible;
use std::rc::Rc;

use embedded_hal::{delay, digital, i2c, spi};

/// Bytes that a driver sent: commands at once, or all data between two commands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Transfer {
    /// Whether the D/C pin was high, or the control byte of I2C announced data.
    pub is_data: bool,
    /// The bytes, without the control byte of I2C.
    pub bytes: Vec<u8>,
}

impl Transfer {
    /// The bytes of transfers, one by one, and whether each is data.
    pub fn each(sent: &[Self]) -> impl Iterator<Item = (bool, u8)> {
        sent.iter().flat_map(|transfer| transfer.bytes.iter().map(|byte| (transfer.is_data, *byte)))
    }
}

/// The error of the bus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unplugged;

#[derive(Debug, Default)]
struct Wires {
    is_data: bool,
    sent: Vec<Transfer>,
    /// The number of bytes that still arrive before one transfer fails.
    bytes_until_failure: Option<usize>,
}

/// All wires between a processor and a panel. Clones are the same wires: give one to each part of a driver.
#[derive(Clone, Debug, Default)]
pub struct Bus(Rc<RefCell<Wires>>);

impl Bus {
    /// Everything that arrived so far.
    pub fn sent(&self) -> Vec<Transfer> {
        self.0.borrow().sent.clone()
    }

    /// The number of bytes that arrived so far.
    pub fn bytes(&self) -> usize {
        self.0.borrow().sent.iter().map(|transfer| transfer.bytes.len()).sum()
    }

    /// Lets one transfer fail after this many more bytes.
    pub fn fail_after(&self, bytes: usize) {
        self.0.borrow_mut().bytes_until_failure = Some(bytes);
    }

    /// Whether a failure that was ordered has not yet occurred.
    pub fn is_failing(&self) -> bool {
        self.0.borrow().bytes_until_failure.is_some()
    }

    /// A pin that says whether the next bytes are commands or data.
    pub fn data_pin(&self) -> DataPin {
        DataPin(self.clone())
    }

    fn send(&self, is_data: bool, bytes: &[u8]) -> Result<(), Unplugged> {
        let mut wires = self.0.borrow_mut();
        let mut arriving = bytes;
        if let Some(left) = wires.bytes_until_failure {
            if left < bytes.len() {
                arriving = &bytes[..left];
                wires.bytes_until_failure = None;
            } else {
                wires.bytes_until_failure = Some(left - bytes.len());
            }
        }
        match wires.sent.last_mut() {
            _ if arriving.is_empty() => {}
            Some(last) if is_data && last.is_data => last.bytes.extend(arriving),
            _ => wires.sent.push(Transfer { is_data, bytes: arriving.to_vec() }),
        }
        if arriving.len() == bytes.len() { Ok(()) } else { Err(Unplugged) }
    }

    fn send_spi(&self, bytes: &[u8]) -> Result<(), Unplugged> {
        let is_data = self.0.borrow().is_data;
        self.send(is_data, bytes)
    }

    fn send_i2c(&self, message: &[u8]) -> Result<(), Unplugged> {
        let [control, bytes @ ..] = message else { panic!("a message without control byte") };
        self.send(*control & 0x40 != 0, bytes)
    }
}

impl spi::Error for Unplugged {
    fn kind(&self) -> spi::ErrorKind {
        spi::ErrorKind::Other
    }
}

impl i2c::Error for Unplugged {
    fn kind(&self) -> i2c::ErrorKind {
        i2c::ErrorKind::Other
    }
}

impl spi::ErrorType for Bus {
    type Error = Unplugged;
}

impl spi::SpiDevice for Bus {
    fn transaction(&mut self, operations: &mut [spi::Operation<'_, u8>]) -> Result<(), Unplugged> {
        for operation in operations {
            match operation {
                spi::Operation::Write(bytes) => self.send_spi(bytes)?,
                spi::Operation::DelayNs(_) => {}
                _ => panic!("the panel cannot be read"),
            }
        }
        Ok(())
    }
}

impl spi::SpiBus for Bus {
    fn write(&mut self, bytes: &[u8]) -> Result<(), Unplugged> {
        self.send_spi(bytes)
    }

    fn flush(&mut self) -> Result<(), Unplugged> {
        Ok(())
    }

    fn read(&mut self, _: &mut [u8]) -> Result<(), Unplugged> {
        panic!("the panel cannot be read")
    }

    fn transfer(&mut self, _: &mut [u8], _: &[u8]) -> Result<(), Unplugged> {
        panic!("the panel cannot be read")
    }

    fn transfer_in_place(&mut self, _: &mut [u8]) -> Result<(), Unplugged> {
        panic!("the panel cannot be read")
    }
}

impl i2c::ErrorType for Bus {
    type Error = Unplugged;
}

impl i2c::I2c for Bus {
    fn transaction(&mut self, _: u8, operations: &mut [i2c::Operation<'_>]) -> Result<(), Unplugged> {
        for operation in operations {
            let i2c::Operation::Write(bytes) = operation else { panic!("the panel cannot be read") };
            self.send_i2c(bytes)?;
        }
        Ok(())
    }
}

/// The D/C pin.
#[derive(Clone, Debug)]
pub struct DataPin(Bus);

impl digital::ErrorType for DataPin {
    type Error = Infallible;
}

impl digital::OutputPin for DataPin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().is_data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().is_data = true;
        Ok(())
    }
}

/// Any other output: reset, or chip select.
#[derive(Clone, Copy, Debug)]
pub struct Pin;

impl digital::ErrorType for Pin {
    type Error = Infallible;
}

impl digital::OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Infallible> {
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// The busy pin of a panel that is never busy.
#[derive(Clone, Copy, Debug)]
pub struct Idle {
    /// The level of the pin.
    pub is_high: bool,
}

impl digital::ErrorType for Idle {
    type Error = Infallible;
}

impl digital::InputPin for Idle {
    fn is_high(&mut self) -> Result<bool, Infallible> {
        Ok(self.is_high)
    }

    fn is_low(&mut self) -> Result<bool, Infallible> {
        Ok(!self.is_high)
    }
}

/// A delay that takes no time.
#[derive(Clone, Copy, Debug)]
pub struct Delay;

impl delay::DelayNs for Delay {
    fn delay_ns(&mut self, _: u32) {}
}
