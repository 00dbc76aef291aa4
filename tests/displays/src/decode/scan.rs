//! LED panels with a HUB75 connector: two rows of 1-bit colors are clocked into shift registers, latched, and
//! shine while the output is enabled. Brightness is how often a row shines.

use embedded_graphics::geometry::{Point, Size};

use crate::bus::Transfer;
use crate::panel::Panel;

/// A panel of this size, of which an upper and a lower row shine at a time. The bits of the 16-bit words are
/// those of `hub75-framebuffer`.
#[derive(Clone, Copy, Debug)]
pub struct Scan {
    /// Width and height of the panel.
    pub size: Size,
}

const ADDRESS: u16 = 0x1F;
const LATCH: u16 = 1 << 5;
const ENABLE: u16 = 1 << 8;
/// Red of the upper row; green and blue follow, then the lower row.
const COLORS: u32 = 9;

impl Scan {
    /// How often each pixel shines while the last transfer repeats: 8 bits each for red, green and blue.
    pub fn decode(self, sent: &[Transfer]) -> Panel {
        let Size { width, height } = self.size;
        let mut panel = Panel::blank(self.size);
        panel.windows = sent.len();
        let Some(Transfer { bytes, .. }) = sent.last() else { return panel };
        let words: Vec<u16> =
            bytes.chunks_exact(2).map(|word| u16::from_le_bytes([word[0], word[1]])).collect();
        let mut shone = vec![0; (width * height) as usize];
        // The six bits of each column.
        let (mut shifted, mut latched) = (vec![0; width as usize], vec![0; width as usize]);
        let mut has_shone = true;
        // The first round fills the registers; what shines in the second is counted.
        for is_counted in [false, true] {
            for word in &words {
                shifted.rotate_left(1);
                shifted[width as usize - 1] = word >> COLORS & 0x3F;
                if word & ENABLE != 0 && is_counted && !has_shone {
                    has_shone = true;
                    self.shine(u32::from(word & ADDRESS), &latched, &mut shone);
                }
                if word & LATCH != 0 {
                    latched.clone_from(&shifted);
                    has_shone = false;
                }
            }
        }
        for (index, code) in (0..).zip(&shone) {
            panel.write(Point::new(index % width as i32, index / width as i32), *code);
        }
        panel
    }

    /// Counts that an upper row and the lower row with it shine.
    fn shine(self, row: u32, latched: &[u16], shone: &mut [u32]) {
        let Size { width, height } = self.size;
        for (x, bits) in latched.iter().enumerate() {
            for (y, rgb) in [(row, bits & 7), (row + height / 2, bits >> 3)] {
                let levels = [0, 1, 2].map(|channel| u32::from(rgb >> channel & 1) << (16 - channel * 8));
                shone[(y * width) as usize + x] += levels.iter().sum::<u32>();
            }
        }
    }
}
