//! The ST7920: bytes in halves, behind a byte that says whether they are a command. Its graphics memory has
//! 32 rows of 256 pixels: the upper half of the glass is on the left, the lower half on the right.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// The size of the glass.
pub const GLASS: Size = Size::new(128, 64);

/// The pixels that the glass shows: 1 for dark.
pub fn decode(sent: &[Transfer]) -> Panel {
    let mut panel = Panel::blank(GLASS);
    let (mut row, mut byte_column, mut has_row, mut has_data) = (0, 0, false, false);
    for transfer in sent {
        // A message that was cut off is lost.
        let [start, high, low] = transfer.bytes[..] else { continue };
        let byte = high & 0xF0 | low >> 4;
        match start {
            // The address of a row, then the address of 16 columns.
            0xF8 if byte & 0x80 != 0 => {
                if has_row {
                    byte_column = u32::from(byte & 0xF) * 2;
                } else {
                    row = u32::from(byte & 0x3F);
                }
                (has_row, has_data) = (!has_row, false);
            }
            0xF8 => {}
            0xFA => {
                if !has_data {
                    (has_data, panel.windows) = (true, panel.windows + 1);
                }
                for bit in 0..8 {
                    let x = byte_column * 8 + bit;
                    let at = if x < 128 { (x, row) } else { (x - 128, row + 32) };
                    panel.write(Point::new(at.0 as i32, at.1 as i32), u32::from(byte >> (7 - bit) & 1));
                }
                byte_column += 1;
            }
            other => panic!("a message that begins with {other:#x}"),
        }
    }
    panel
}
