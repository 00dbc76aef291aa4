//! A chain of MAX7219, each with a matrix of 8x8 LEDs.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// The pixels of matrices that stand beside each other, from the one whose bytes are sent first.
pub fn decode(matrices: u32, sent: &[Transfer]) -> Panel {
    let mut panel = Panel::blank(Size::new(matrices * 8, 8));
    for Transfer { bytes, .. } in sent {
        // A message that was cut off is lost.
        if bytes.len() != 2 * matrices as usize {
            continue;
        }
        for (matrix, message) in (0..).zip(bytes.chunks_exact(2)) {
            let row = message[0] & 0xF;
            if !(1..=8).contains(&row) {
                continue;
            }
            panel.windows += 1;
            for bit in 0..8 {
                let at = Point::new(matrix * 8 + bit, i32::from(row) - 1);
                panel.write(at, u32::from(message[1] >> (7 - bit) & 1));
            }
        }
    }
    panel
}
