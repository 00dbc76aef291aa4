//! The pixels of an emulated panel of 16 grays, read from the emulator's screen.

use anyhow::{Context, Result, ensure};

use crate::picture::Size;

/// Side of the square that the emulator shows for a pixel.
const SCALE: usize = 4;

/// The grays of a panel, 0 to 15, line by line.
#[derive(Debug)]
pub(crate) struct Screen {
    width: usize,
    grays: Vec<u8>,
}

impl Screen {
    /// Reads the emulator's PPM.
    ///
    /// # Errors
    /// The screen does not consist of squares of one gray, or has another size than the panel.
    pub(crate) fn parse(ppm: &[u8], panel: Size) -> Result<Self> {
        let (width, height) = (usize::from(panel.width), usize::from(panel.height));
        let header = format!("P6\n{} {}\n255\n", width * SCALE, height * SCALE);
        let pixels = ppm
            .strip_prefix(header.as_bytes())
            .context("the screen has another size than the panel: use a QEMU with this board")?;
        ensure!(
            pixels.len() == 3 * width * height * SCALE * SCALE,
            "the screen is cut off: run the board again"
        );
        let mut grays = vec![None; width * height];
        for (index, pixel) in pixels.chunks_exact(3).enumerate() {
            let (x, y) = (index % (width * SCALE) / SCALE, index / (width * SCALE) / SCALE);
            let [r, g, b] = *pixel else { continue };
            ensure!(r == g && g == b && r % 17 == 0, "pixel ({x}, {y}) is not one of 16 grays: {pixel:?}");
            let shown = grays
                .get_mut(y * width + x)
                .context("the screen has more lines than the panel: run the board again")?;
            ensure!(*shown.get_or_insert(r / 17) == r / 17, "pixel ({x}, {y}) is not a square of one gray");
        }
        let grays =
            grays.into_iter().collect::<Option<_>>().context("the screen is cut off: run the board again")?;
        Ok(Self { width, grays })
    }

    /// The part at the upper left, where the picture was drawn.
    ///
    /// # Errors
    /// A pixel outside of this part is not black.
    pub(crate) fn part(&self, size: Size) -> Result<Vec<u8>> {
        let (width, height) = (usize::from(size.width), usize::from(size.height));
        let mut part = Vec::new();
        for (y, line) in self.grays.chunks_exact(self.width).enumerate() {
            for (x, gray) in line.iter().enumerate() {
                if x < width && y < height {
                    part.push(*gray);
                } else {
                    ensure!(*gray == 0, "pixel ({x}, {y}) beside the picture is not black");
                }
            }
        }
        Ok(part)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PANEL: Size = Size { width: 2, height: 1 };

    /// The PPM of a screen of two pixels.
    fn ppm(left: u8, right: u8) -> Vec<u8> {
        let line = [[left; 3 * SCALE], [right; 3 * SCALE]].concat();
        [&b"P6\n8 4\n255\n"[..], &line.repeat(SCALE)].concat()
    }

    #[test]
    fn squares_are_pixels() {
        let screen = Screen::parse(&ppm(17 * 9, 0), PANEL).unwrap();
        assert_eq!(screen.part(PANEL).unwrap(), [9, 0]);
        assert_eq!(screen.part(Size { width: 1, height: 1 }).unwrap(), [9]);
    }

    #[test]
    fn pixels_beside_the_picture_must_be_black() {
        let screen = Screen::parse(&ppm(0, 17), PANEL).unwrap();
        assert!(screen.part(Size { width: 1, height: 1 }).is_err());
    }

    #[test]
    fn other_screens_are_refused() {
        let mut no_square = ppm(17, 17);
        *no_square.last_mut().unwrap() = 34;
        let mut cut = ppm(17, 17);
        cut.pop();
        for broken in [ppm(1, 17), no_square, cut, b"P6\n4 4\n255\n".to_vec()] {
            assert!(Screen::parse(&broken, PANEL).is_err());
        }
    }
}
