//! Controllers with address windows: MIPI DCS, as in the ST77xx, ILI9xxx and GC9xxx, and the SSD1351.

use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use crate::bus::Transfer;
use crate::panel::Panel;

/// A controller, and the glass on it.
#[derive(Clone, Copy, Debug)]
pub struct Windows {
    commands: Commands,
    /// Columns and rows of the controller's memory.
    memory: Size,
    /// The part of the memory that is behind glass.
    glass: Rectangle,
    /// Whether the glass shows the memory from right to left.
    is_mirrored: bool,
    /// Whether the glass has blue where the controller supposes red.
    is_bgr: bool,
    /// Whether the glass is dark where the controller supposes light.
    is_negative: bool,
}

/// The codes of commands.
#[derive(Clone, Copy, Debug)]
struct Commands {
    columns: u8,
    rows: u8,
    write: u8,
    /// Bytes of a column or row number.
    address_bytes: usize,
    /// The command that says in which directions the memory is filled.
    directions: u8,
    directions_of: fn(u8) -> Directions,
    /// The command that says how many bytes a pixel has.
    pixel_format: u8,
    /// The commands that show colors as they are, and inverted.
    inversion: (u8, u8),
}

/// In which directions the memory is filled.
#[derive(Clone, Copy, Debug, Default)]
struct Directions {
    /// Whether columns of the window are rows of the memory.
    is_swapped: bool,
    /// Whether a window is filled from top to bottom, then from left to right.
    is_downward: bool,
    is_right_to_left: bool,
    is_bottom_to_top: bool,
    /// Whether blue is the first color.
    is_bgr: bool,
}

const MIPI: Commands = Commands {
    columns: 0x2A,
    rows: 0x2B,
    write: 0x2C,
    address_bytes: 2,
    directions: 0x36,
    directions_of: |byte| Directions {
        is_bottom_to_top: byte & 0x80 != 0,
        is_right_to_left: byte & 0x40 != 0,
        is_swapped: byte & 0x20 != 0,
        is_downward: false,
        is_bgr: byte & 8 != 0,
    },
    pixel_format: 0x3A,
    inversion: (0x20, 0x21),
};

const SSD1351: Commands = Commands {
    columns: 0x15,
    rows: 0x75,
    write: 0x5C,
    address_bytes: 1,
    directions: 0xA0,
    directions_of: |byte| Directions {
        is_downward: byte & 1 != 0,
        is_right_to_left: byte & 2 != 0,
        // The glass hangs upside down: the scan is reversed where the bit is 0.
        is_bottom_to_top: byte & 0x10 == 0,
        is_swapped: false,
        // The glass has the order that drivers choose.
        is_bgr: byte & 4 == 0,
    },
    // No command: the SSD1351 has two bytes for a pixel.
    pixel_format: 0,
    inversion: (0xA6, 0xA7),
};

/// The state of the controller after the bytes that it received.
struct State {
    controller: Windows,
    panel: Panel,
    directions: Directions,
    bytes_per_pixel: usize,
    columns: (usize, usize),
    rows: (usize, usize),
    command: u8,
    /// The bytes of data since the command that are not yet used.
    data: Vec<u8>,
    /// Pixels of the window that were written.
    written: usize,
    /// Whether the controller inverts what it shows.
    is_inverted: bool,
}

impl Windows {
    /// A controller that takes MIPI DCS, with glass over all its memory.
    pub fn mipi(width: u32, height: u32) -> Self {
        Self::new(MIPI, Size::new(width, height))
    }

    /// An SSD1351 with glass of 128 columns and this many rows.
    pub fn ssd1351(rows: u32) -> Self {
        Self::new(SSD1351, Size::new(128, rows))
    }

    fn new(commands: Commands, memory: Size) -> Self {
        let glass = Rectangle::new(Point::zero(), memory);
        Self { commands, memory, glass, is_mirrored: false, is_bgr: false, is_negative: false }
    }

    /// This controller with glass over a part of its memory.
    pub fn behind(self, glass: Rectangle) -> Self {
        Self { glass, ..self }
    }

    /// This controller with glass that shows the memory from right to left.
    pub fn mirrored(self) -> Self {
        Self { is_mirrored: true, ..self }
    }

    /// This controller with glass that has blue where the controller supposes red.
    pub fn bgr(self) -> Self {
        Self { is_bgr: true, ..self }
    }

    /// This controller with glass that is dark where the controller supposes light.
    pub fn negative(self) -> Self {
        Self { is_negative: true, ..self }
    }

    /// The pixels that the glass shows.
    pub fn decode(self, sent: &[Transfer]) -> Panel {
        let mut state = State {
            controller: self,
            panel: Panel::blank(self.glass.size),
            directions: Directions::default(),
            bytes_per_pixel: 2,
            columns: (0, 0),
            rows: (0, 0),
            command: 0,
            data: vec![],
            written: 0,
            is_inverted: false,
        };
        for (is_data, byte) in Transfer::each(sent) {
            if is_data { state.data(byte) } else { state.command(byte) }
        }
        state.panel
    }
}

impl State {
    fn command(&mut self, command: u8) {
        self.command = command;
        self.data.clear();
        let Commands { write, inversion, .. } = self.controller.commands;
        if command == write {
            self.written = 0;
            self.panel.windows += 1;
        } else if command == inversion.0 || command == inversion.1 {
            self.is_inverted = command == inversion.1;
        }
    }

    fn data(&mut self, byte: u8) {
        let Commands { columns, rows, write, address_bytes, directions, directions_of, pixel_format, .. } =
            self.controller.commands;
        self.data.push(byte);
        let command = self.command;
        if command == write {
            if self.data.len() == self.bytes_per_pixel {
                let code = self.code();
                self.data.clear();
                self.pixel(code);
            }
        } else if (command == columns || command == rows) && self.data.len() == 2 * address_bytes {
            let number = |bytes: &[u8]| bytes.iter().fold(0, |sum, byte| sum << 8 | usize::from(*byte));
            let (first, last) = self.data.split_at(address_bytes);
            let range = (number(first), number(last));
            assert!(range.0 <= range.1, "a window from {} to {}", range.0, range.1);
            if command == columns { self.columns = range } else { self.rows = range }
        } else if command == directions {
            self.directions = directions_of(byte);
        } else if command == pixel_format {
            // The lower three bits count for the interface to the processor.
            self.bytes_per_pixel = match byte & 7 {
                5 => 2,
                6 => 3,
                other => panic!("pixel format {other}"),
            };
        }
    }

    /// Writes the next pixel of the window.
    fn pixel(&mut self, code: u32) {
        let (width, height) = (self.columns.1 - self.columns.0 + 1, self.rows.1 - self.rows.0 + 1);
        assert!(self.written < width * height, "more pixels than the window has");
        let (column, row) = if self.directions.is_downward {
            (self.written / height, self.written % height)
        } else {
            (self.written % width, self.written / width)
        };
        self.written += 1;
        let (mut x, mut y) = (self.columns.0 + column, self.rows.0 + row);
        if self.directions.is_swapped {
            (x, y) = (y, x);
        }
        let Size { width, height } = self.controller.memory;
        let (width, height) = (width as usize, height as usize);
        assert!(x < width && y < height, "({x}, {y}) is not in the memory of {width}x{height}");
        if self.directions.is_right_to_left != self.controller.is_mirrored {
            x = width - 1 - x;
        }
        if self.directions.is_bottom_to_top {
            y = height - 1 - y;
        }
        let at = Point::new(x as i32, y as i32);
        let Rectangle { top_left, .. } = self.controller.glass;
        assert!(self.controller.glass.contains(at), "{at} is not behind glass");
        self.panel.write(at - top_left, code);
    }

    /// The code of the pixel in `data`, as the glass shows it: bits of red, green and blue.
    fn code(&self) -> u32 {
        // The lower two bits of three bytes do not count.
        let (bits, mut channels) = match self.data[..] {
            [high, low] => ([5, 6, 5], [high >> 3, (high & 7) << 3 | low >> 5, low & 0x1F]),
            _ => ([6; 3], [self.data[0] >> 2, self.data[1] >> 2, self.data[2] >> 2]),
        };
        if self.directions.is_bgr != self.controller.is_bgr {
            channels.reverse();
        }
        if self.is_inverted != self.controller.is_negative {
            channels = [0, 1, 2].map(|channel| channels[channel] ^ ((1 << bits[channel]) - 1));
        }
        bits.iter().zip(channels).fold(0, |code, (bits, channel)| code << bits | u32::from(channel))
    }
}
