//! The panel: its commands, and drawing on it.

use core::ops::Range;

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Dimensions, OriginDimensions, Point, Size};
use embedded_graphics::pixelcolor::{Gray4, GrayColor};
use embedded_graphics::primitives::Rectangle;
use embedded_hal::digital::OutputPin;
use embedded_hal::spi::SpiBus;

use crate::{Error, Setup};

/// Width of the panel in pixels.
pub const WIDTH: u32 = 128;
/// Height of the panel in pixels.
pub const HEIGHT: u32 = 64;

/// Bytes of one line.
const LINE_BYTES: usize = WIDTH as usize / 2;

const SET_COLUMNS: u8 = 0x15;
const SET_ROWS: u8 = 0x75;
const SET_CONTRAST: u8 = 0x81;
const SET_MAP: u8 = 0xA0;
const SET_FIRST_ROW: u8 = 0xA1;
const SET_OFFSET: u8 = 0xA2;
const SET_ROWS_IN_USE: u8 = 0xA8;
const FULL_CURRENT: u8 = 0x86;
const SHOW_MEMORY: u8 = 0xA4;
const TURN_OFF: u8 = 0xAE;
const TURN_ON: u8 = 0xAF;

/// The highest contrast.
const MAX_CONTRAST: u8 = 0x7F;

/// A panel on its own bus, or on a bus that selects it.
#[derive(Debug)]
pub struct Ssd0323<S, P> {
    bus: S,
    /// Low for commands, high for data.
    data_command: P,
}

impl<S: SpiBus, P: OutputPin> Ssd0323<S, P> {
    /// Sets up a panel that is connected as in [`Setup::PLAIN`]. Reset the panel first. The panel keeps the
    /// picture in its memory, which at first holds any pixels: clear the panel.
    ///
    /// # Errors
    /// An error of the bus or of the pin.
    pub fn new(bus: S, data_command: P) -> Result<Self, Error<S::Error, P::Error>> {
        Self::with_setup(bus, data_command, Setup::PLAIN)
    }

    /// Sets up a panel. Reset the panel first. The panel keeps the picture in its memory, which at first
    /// holds any pixels: clear the panel.
    ///
    /// # Errors
    /// An error of the bus or of the pin.
    pub fn with_setup(bus: S, data_command: P, setup: Setup) -> Result<Self, Error<S::Error, P::Error>> {
        let mut panel = Self { bus, data_command };
        let commands: [&[u8]; 9] = [
            &[TURN_OFF],
            &[SET_MAP, setup.map()],
            &[SET_FIRST_ROW, setup.first_row],
            &[SET_OFFSET, setup.offset],
            &[SHOW_MEMORY],
            &[SET_ROWS_IN_USE, HEIGHT as u8 - 1],
            &[SET_CONTRAST, setup.contrast.min(MAX_CONTRAST)],
            &[FULL_CURRENT],
            &[TURN_ON],
        ];
        for command in commands {
            panel.command(command)?;
        }
        Ok(panel)
    }

    /// Sets the brightness, from 0 to 127; more is taken for 127.
    ///
    /// # Errors
    /// An error of the bus or of the pin.
    pub fn set_contrast(&mut self, contrast: u8) -> Result<(), Error<S::Error, P::Error>> {
        self.command(&[SET_CONTRAST, contrast.min(MAX_CONTRAST)])
    }

    /// Turns the light on or off. The memory keeps the picture, and can be drawn in.
    ///
    /// # Errors
    /// An error of the bus or of the pin.
    pub fn set_on(&mut self, is_on: bool) -> Result<(), Error<S::Error, P::Error>> {
        self.command(&[if is_on { TURN_ON } else { TURN_OFF }])
    }

    /// Returns bus and pin.
    pub fn release(self) -> (S, P) {
        (self.bus, self.data_command)
    }

    fn command(&mut self, bytes: &[u8]) -> Result<(), Error<S::Error, P::Error>> {
        self.data_command.set_low().map_err(Error::Pin)?;
        self.send(bytes)
    }

    /// Opens a window, which the data that follows fills line by line.
    ///
    /// The window must lie inside the panel, and must begin and end between pairs of pixels.
    fn open(&mut self, columns: Range<i32>, rows: Range<i32>) -> Result<(), Error<S::Error, P::Error>> {
        self.command(&[SET_COLUMNS, (columns.start / 2) as u8, (columns.end / 2 - 1) as u8])?;
        self.command(&[SET_ROWS, rows.start as u8, (rows.end - 1) as u8])?;
        self.data_command.set_high().map_err(Error::Pin)
    }

    /// Sends bytes, and waits until the bus has sent them: the pin must not change before.
    fn send(&mut self, bytes: &[u8]) -> Result<(), Error<S::Error, P::Error>> {
        self.bus.write(bytes).map_err(Error::Bus)?;
        self.bus.flush().map_err(Error::Bus)
    }
}

impl<S, P> OriginDimensions for Ssd0323<S, P> {
    fn size(&self) -> Size {
        Size::new(WIDTH, HEIGHT)
    }
}

impl<S: SpiBus, P: OutputPin> DrawTarget for Ssd0323<S, P> {
    type Color = Gray4;
    type Error = Error<S::Error, P::Error>;

    /// Draws pixels that come in pairs, the left one first. It opens a window for each pair that is not right
    /// of the previous pair.
    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Pixel<Gray4>>,
    {
        let bounds = self.bounding_box();
        let mut waiting: Option<Pixel<Gray4>> = None;
        let mut open_at = None;
        for pixel in pixels.into_iter().filter(|Pixel(point, _)| bounds.contains(*point)) {
            let Some(Pixel(left, left_color)) = waiting.take() else {
                if pixel.0.x % 2 != 0 {
                    return Err(Error::Unpaired { pixel: pixel.0 });
                }
                waiting = Some(pixel);
                continue;
            };
            if pixel.0 != left + Point::new(1, 0) {
                return Err(Error::Unpaired { pixel: left });
            }
            if open_at != Some(left) {
                self.open(left.x..WIDTH as i32, left.y..left.y + 1)?;
            }
            self.send(&[upper_half(left_color) | lower_half(pixel.1)])?;
            open_at = Some(left + Point::new(2, 0));
        }
        match waiting {
            Some(Pixel(pixel, _)) => Err(Error::Unpaired { pixel }),
            None => Ok(()),
        }
    }

    /// Draws the visible part of an area: one window, and one burst for each line.
    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), Self::Error>
    where
        I: IntoIterator<Item = Gray4>,
    {
        let (columns, rows) = visible(area);
        if columns.is_empty() || rows.is_empty() {
            return Ok(());
        }
        for (edge, inside) in [(columns.start, columns.start), (columns.end, columns.end - 1)] {
            if edge % 2 != 0 {
                return Err(Error::Unpaired { pixel: Point::new(inside, rows.start) });
            }
        }
        self.open(columns.clone(), rows.clone())?;
        let mut colors = colors.into_iter();
        for y in area.rows().take_while(|y| *y < rows.end) {
            let mut burst = [0; LINE_BYTES];
            let mut pixels = 0;
            // Skip the colors of pixels that are not visible.
            for (x, color) in area.columns().zip(&mut colors) {
                if !(rows.contains(&y) && columns.contains(&x)) {
                    continue;
                }
                if let Some(byte) = burst.get_mut(pixels / 2) {
                    *byte |= if x % 2 == 0 { upper_half(color) } else { lower_half(color) };
                }
                pixels += 1;
            }
            if let Some((burst @ [_, ..], _)) = burst.split_at_checked(pixels / 2) {
                self.send(burst)?;
            }
            if pixels % 2 != 0 {
                // The colors end in the middle of a pair.
                return Err(Error::Unpaired { pixel: Point::new(columns.start + pixels as i32 - 1, y) });
            }
        }
        Ok(())
    }

    fn fill_solid(&mut self, area: &Rectangle, color: Gray4) -> Result<(), Self::Error> {
        // Draw only the visible part: an area may have billions of pixels.
        let (columns, rows) = visible(area);
        let size = Size::new(columns.len() as u32, rows.len() as u32);
        let visible = Rectangle::new(Point::new(columns.start, rows.start), size);
        self.fill_contiguous(&visible, core::iter::repeat(color))
    }
}

/// Columns and rows of an area that lie on the panel. `Rectangle::intersection` overflows for large areas.
fn visible(area: &Rectangle) -> (Range<i32>, Range<i32>) {
    let clip = |range: Range<i32>, end: u32| range.start.max(0)..range.end.min(end as i32);
    (clip(area.columns(), WIDTH), clip(area.rows(), HEIGHT))
}

/// A left pixel's bits in the byte of its pair.
fn upper_half(color: Gray4) -> u8 {
    color.luma() << 4
}

/// A right pixel's bits in the byte of its pair.
fn lower_half(color: Gray4) -> u8 {
    color.luma()
}
