//! Panels that take the bytes of a frame buffer, each transfer from the first pixel on: LED strips, and
//! panels that DMA feeds.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// A panel whose pixels have this many bits: 8, 16 or 24, with the high byte first; or 1, 2 or 4, with the
/// left pixel in the high bits and lines that begin with a byte.
#[derive(Clone, Copy, Debug)]
pub struct Memory {
    /// Width and height of the panel.
    pub size: Size,
    /// Bits of a pixel.
    pub bits: u32,
}

impl Memory {
    /// The pixels that the panel shows.
    pub fn decode(self, sent: &[Transfer]) -> Panel {
        let Self { size, bits } = self;
        let line = (size.width * bits).div_ceil(8);
        let mut panel = Panel::blank(size);
        for Transfer { bytes, .. } in sent {
            panel.windows += 1;
            assert!(bytes.len() <= (line * size.height) as usize, "{} bytes for {size}", bytes.len());
            for y in 0..size.height {
                for x in 0..size.width {
                    let first = y * line + x * bits / 8;
                    let pixel = first as usize..(first + bits.div_ceil(8)) as usize;
                    let Some(pixel) = bytes.get(pixel) else { continue };
                    let code = pixel.iter().fold(0, |code, byte| code << 8 | u32::from(*byte));
                    let shift = if bits < 8 { 8 - bits - x * bits % 8 } else { 0 };
                    panel.write(Point::new(x as i32, y as i32), (code >> shift) & ((1 << bits) - 1));
                }
            }
        }
        panel
    }
}
