//! A panel with an ST7789 controller, for the example `mipidsi`.

use std::cell::RefCell;
use std::convert::Infallible;

use embedded_graphics::pixelcolor::{Rgb565, raw::RawU16};
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{Rectangle, rectangle};
use embedded_graphics_simulator::SimulatorDisplay;
use embedded_hal::delay::DelayNs;
use embedded_hal::digital::{self, OutputPin};
use embedded_hal::spi::{self, Operation, SpiDevice};

/// A panel that has the controller's commands for a window, and for the pixels in it.
#[derive(Debug)]
pub struct MockPanel(RefCell<Controller>);

#[derive(Debug)]
struct Controller {
    screen: SimulatorDisplay<Rgb565>,
    is_data: bool,
    command: u8,
    /// The bytes since the last command, or since the last pixel.
    data: Vec<u8>,
    columns: [i32; 2],
    rows: [i32; 2],
    /// Where the next pixels go.
    places: rectangle::Points,
}

impl MockPanel {
    /// A panel of this size.
    pub fn new(size: Size) -> Self {
        let places = Rectangle::zero().points();
        let (columns, rows) = ([0, 0], [0, 0]);
        let screen = SimulatorDisplay::new(size);
        let controller =
            Controller { screen, is_data: false, command: 0, data: vec![], columns, rows, places };
        Self(RefCell::new(controller))
    }

    /// The pixels that the panel shows.
    pub fn screen(&self) -> SimulatorDisplay<Rgb565> {
        self.0.borrow().screen.clone()
    }
}

impl Controller {
    /// Takes a byte from the bus (Sitronix, "ST7789V", chapter 9).
    fn receive(&mut self, byte: u8) -> Result<(), Infallible> {
        const COLUMNS: u8 = 0x2a;
        const ROWS: u8 = 0x2b;
        const WRITE: u8 = 0x2c;
        if self.is_data {
            self.data.push(byte);
        } else {
            self.command = byte;
            self.data.clear();
        }
        let range = |a, b, c, d| [u16::from_be_bytes([a, b]), u16::from_be_bytes([c, d])].map(i32::from);
        match (self.command, self.data.as_slice()) {
            (COLUMNS, &[a, b, c, d]) => self.columns = range(a, b, c, d),
            (ROWS, &[a, b, c, d]) => self.rows = range(a, b, c, d),
            (WRITE, []) => {
                let ([left, right], [top, bottom]) = (self.columns, self.rows);
                self.places =
                    Rectangle::with_corners(Point::new(left, top), Point::new(right, bottom)).points();
            }
            (WRITE, &[high, low]) => {
                self.data.clear();
                let color = Rgb565::from(RawU16::new(u16::from_be_bytes([high, low])));
                let pixel = self.places.next().map(|place| Pixel(place, color));
                return self.screen.draw_iter(pixel);
            }
            _ => {}
        }
        Ok(())
    }
}

/// The bus that ends at a panel.
#[derive(Debug)]
pub struct MockBus<'p>(pub &'p MockPanel);

impl spi::ErrorType for MockBus<'_> {
    type Error = Infallible;
}

impl SpiDevice for MockBus<'_> {
    fn transaction(&mut self, operations: &mut [Operation<u8>]) -> Result<(), Infallible> {
        let mut controller = self.0.0.borrow_mut();
        for operation in operations {
            if let Operation::Write(bytes) = operation {
                bytes.iter().try_for_each(|byte| controller.receive(*byte))?;
            }
        }
        Ok(())
    }
}

/// The panel's pin D/C: high for data, low for commands.
#[derive(Debug)]
pub struct MockPin<'p>(pub &'p MockPanel);

impl digital::ErrorType for MockPin<'_> {
    type Error = Infallible;
}

impl OutputPin for MockPin<'_> {
    fn set_low(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().is_data = false;
        Ok(())
    }

    fn set_high(&mut self) -> Result<(), Infallible> {
        self.0.0.borrow_mut().is_data = true;
        Ok(())
    }
}

/// A delay that takes no time.
#[derive(Debug)]
pub struct MockDelay;

impl DelayNs for MockDelay {
    fn delay_ns(&mut self, _nanoseconds: u32) {}
}
