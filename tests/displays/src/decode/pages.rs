//! Controllers with pages: bytes that are columns of eight pixels, as in the SSD1306 and SH1106.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// A controller, and the glass on it.
#[derive(Clone, Copy, Debug)]
pub struct Pages {
    /// Columns of the controller's memory.
    pub columns: u32,
    /// The column of the memory at which the glass begins.
    pub first_column: u32,
    /// Width and height of the glass, which has all rows of the memory that are in use.
    pub glass: Size,
    /// Whether data goes on in the next page, as in the SSD1306, or stays in its page.
    pub goes_on: bool,
}

/// The state of the controller after the bytes that it received.
struct State {
    controller: Pages,
    panel: Panel,
    is_left_to_right: bool,
    is_top_to_bottom: bool,
    columns: (u32, u32),
    pages: (u32, u32),
    column: u32,
    page: u32,
    /// Whether data came since the last address.
    has_data: bool,
}

impl Pages {
    /// The pixels that the glass shows: 1 for one that shines.
    pub fn decode(self, sent: &[Transfer]) -> Panel {
        let mut state = State {
            controller: self,
            panel: Panel::blank(self.glass),
            is_left_to_right: false,
            is_top_to_bottom: false,
            columns: (0, self.columns - 1),
            pages: (0, self.glass.height / 8 - 1),
            column: 0,
            page: 0,
            has_data: false,
        };
        for transfer in sent {
            if transfer.is_data {
                for byte in &transfer.bytes {
                    state.data(*byte);
                }
            } else {
                state.commands(&transfer.bytes);
            }
        }
        state.panel
    }
}

impl State {
    /// Commands with their arguments. A command whose arguments were cut off is lost.
    fn commands(&mut self, bytes: &[u8]) {
        let mut rest = bytes;
        while let [command, arguments @ ..] = rest {
            let count = match command {
                0x21 | 0x22 | 0xA3 => 2,
                0x20 | 0x81 | 0x8D | 0xA8 | 0xA9 | 0xAD | 0xD3 | 0xD5 | 0xD9 | 0xDA | 0xDB => 1,
                _ => 0,
            };
            let Some((arguments, after)) = arguments.split_at_checked(count) else { return };
            self.command(*command, arguments);
            rest = after;
        }
    }

    fn command(&mut self, command: u8, arguments: &[u8]) {
        let low = u32::from(command & 0xF);
        match (command, arguments) {
            (0x00..=0x0F, _) => self.column = self.column & !0xF | low,
            (0x10..=0x1F, _) => self.column = self.column & 0xF | low << 4,
            (0xB0..=0xBF, _) => self.page = low,
            (0x21, [first, last]) => {
                self.columns = (u32::from(*first), u32::from(*last));
                self.column = self.columns.0;
            }
            (0x22, [first, last]) => {
                // The SSD1306 counts 8 pages, and takes the lower bits.
                self.pages = (u32::from(first & 7), u32::from(last & 7));
                self.page = self.pages.0;
            }
            (0x20, [mode]) => assert_eq!(*mode, 0, "the decoder has no other mode than horizontal"),
            (0xA0 | 0xA1, _) => self.is_left_to_right = command == 0xA1,
            (0xC0..=0xCF, _) => self.is_top_to_bottom = command & 8 != 0,
            (0xA7, _) => panic!("the driver inverts the panel"),
            _ => return,
        }
        self.has_data = false;
    }

    /// Eight pixels of a column, the upper one in the lowest bit.
    fn data(&mut self, byte: u8) {
        if !self.has_data {
            self.panel.windows += 1;
            self.has_data = true;
        }
        let Pages { columns, first_column, glass, goes_on } = self.controller;
        assert!(self.column < columns, "column {} of {columns}", self.column);
        let x = if self.is_left_to_right { self.column } else { columns - 1 - self.column };
        let x = x.wrapping_sub(first_column);
        assert!(x < glass.width, "column {} is not behind glass", self.column);
        for bit in 0..8 {
            let row = self.page * 8 + bit;
            assert!(row < glass.height, "row {row} of {}", glass.height);
            let y = if self.is_top_to_bottom { row } else { glass.height - 1 - row };
            self.panel.write(Point::new(x as i32, y as i32), u32::from(byte >> bit & 1));
        }
        self.column += 1;
        if goes_on && self.column > self.columns.1 {
            self.column = self.columns.0;
            self.page = if self.page == self.pages.1 { self.pages.0 } else { self.page + 1 };
        }
    }
}
