//! Controllers of e-paper with planes of one bit a pixel: the UC81xx and the SSD16xx. The glass changes when
//! it is refreshed, not when a plane is written.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// A controller, and the glass on it.
#[derive(Clone, Copy, Debug)]
pub struct Planes {
    /// The family of the controller.
    pub family: Family,
    /// Columns of the controller's memory, a multiple of 8.
    pub columns: u32,
    /// Width and height of the glass.
    pub glass: Size,
    /// Whether rows of the memory are columns of the glass.
    pub is_transposed: bool,
}

/// How commands are numbered, and where data goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Each transmission begins at the first byte of the plane.
    Uc81xx,
    /// Data goes on at an address that stays between commands.
    Ssd16xx,
}

/// A register of the controller, to which bytes of data belong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Register {
    /// The plane that is shown in black and white.
    Plane,
    /// The plane of the old picture, or of the third color.
    OtherPlane,
    /// The colors that the UC81xx shows for bits.
    Polarity,
    EntryMode,
    Columns,
    Rows,
    Column,
    Row,
    /// A register that does not change the glass.
    Other,
}

struct State {
    controller: Planes,
    panel: Panel,
    /// The bits of the plane, by rows of the memory.
    plane: Vec<u8>,
    register: Register,
    data: Vec<u8>,
    /// First and last byte of a row, and first and last row.
    columns: (usize, usize),
    rows: (usize, usize),
    column: usize,
    row: usize,
    /// The bit that is shown as white.
    white: u8,
}

impl Planes {
    /// The pixels that the glass shows: 1 for white.
    pub fn decode(self, sent: &[Transfer]) -> Panel {
        let rows = if self.is_transposed { self.glass.width } else { self.glass.height } as usize;
        let bytes = self.columns as usize / 8;
        let mut state = State {
            controller: self,
            panel: Panel::blank(self.glass),
            plane: vec![0; bytes * rows],
            register: Register::Other,
            data: vec![],
            columns: (0, bytes - 1),
            rows: (0, rows - 1),
            column: 0,
            row: 0,
            white: 1,
        };
        for (is_data, byte) in Transfer::each(sent) {
            if is_data { state.data(byte) } else { state.command(byte) }
        }
        state.panel
    }
}

impl State {
    fn command(&mut self, command: u8) {
        self.data.clear();
        let family = self.controller.family;
        self.register = match (family, command) {
            (Family::Uc81xx, 0x10) | (Family::Ssd16xx, 0x26) => Register::OtherPlane,
            (Family::Uc81xx, 0x13) | (Family::Ssd16xx, 0x24) => Register::Plane,
            (Family::Uc81xx, 0x50) => Register::Polarity,
            (Family::Ssd16xx, 0x11) => Register::EntryMode,
            (Family::Ssd16xx, 0x44) => Register::Columns,
            (Family::Ssd16xx, 0x45) => Register::Rows,
            (Family::Ssd16xx, 0x4E) => Register::Column,
            (Family::Ssd16xx, 0x4F) => Register::Row,
            _ => Register::Other,
        };
        if matches!(self.register, Register::Plane | Register::OtherPlane) {
            self.panel.windows += 1;
            if family == Family::Uc81xx {
                (self.column, self.row) = (0, 0);
            }
        }
        if matches!((family, command), (Family::Uc81xx, 0x12) | (Family::Ssd16xx, 0x20)) {
            self.refresh();
        }
    }

    fn data(&mut self, byte: u8) {
        self.data.push(byte);
        let byte_count = usize::from(byte);
        match (self.register, &self.data[..]) {
            (Register::Plane, _) => {
                let bytes = self.controller.columns as usize / 8;
                self.plane[self.row * bytes + self.column] = byte;
                self.advance();
            }
            (Register::OtherPlane, _) => self.advance(),
            (Register::Polarity, _) => self.white = byte >> 4 & 1,
            (Register::EntryMode, _) => assert_eq!(byte, 3, "the decoder has no other direction"),
            (Register::Columns, [first, _]) => self.columns = (usize::from(*first), byte_count),
            (Register::Rows, [first, high, last, _]) => {
                let number = |low: u8, high: u8| usize::from(high) << 8 | usize::from(low);
                self.rows = (number(*first, *high), number(*last, byte));
            }
            (Register::Column, _) => self.column = byte_count,
            (Register::Row, [low, _]) => self.row = byte_count << 8 | usize::from(*low),
            _ => {}
        }
    }

    /// Goes to the next byte of the window, and after the last one to the first.
    fn advance(&mut self) {
        self.column += 1;
        if self.column > self.columns.1 {
            self.column = self.columns.0;
            self.row = if self.row == self.rows.1 { self.rows.0 } else { self.row + 1 };
        }
    }

    /// Shows the plane.
    fn refresh(&mut self) {
        let Planes { columns, glass, is_transposed, .. } = self.controller;
        for y in 0..glass.height {
            for x in 0..glass.width {
                let (column, row) = if is_transposed { (y, x) } else { (x, y) };
                let byte = self.plane[(row * columns + column) as usize / 8];
                let bit = byte >> (7 - column % 8) & 1;
                self.panel.write(Point::new(x as i32, y as i32), u32::from(bit == self.white));
            }
        }
    }
}
