//! Orders that draw a part of the pixels of each line in each frame.

use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Point;

use super::line::LinePainter;
use super::region::Region;
use super::{DisplayColor, DrawError, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// Draws other pixels in each frame, evenly spread: a picture that moves changes earlier everywhere.
///
/// The display must keep the pixels of the frames before, and take single pixels. For displays that take
/// whole lines there is [`Interleave`](super::Interleave).
///
/// ```
/// use rayline::Pattern;
/// // The upper left corner of the first frame of a checkerboard, and of the second.
/// let pixels = |frame| [0u16, 1].map(|y| [0u16, 1, 2, 3].map(|x| Pattern::Checkerboard.draws(x, y, frame)));
/// assert_eq!(pixels(0), [[true, false, true, false], [false, true, false, true]]);
/// assert_eq!(pixels(1), [[false, true, false, true], [true, false, true, false]]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pattern {
    /// The black squares of a checkerboard, then the white ones: the picture is complete after two frames.
    Checkerboard,
    /// One pixel of each square of two by two, diagonal after diagonal: complete after four frames.
    Square,
}

impl Pattern {
    /// The number of frames that draw all pixels.
    pub const fn frames(self) -> u32 {
        match self {
            Self::Checkerboard => 2,
            Self::Square => 4,
        }
    }

    /// Whether frame number `frame` draws pixel (x, y).
    pub fn draws(self, x: u16, y: u16, frame: u32) -> bool {
        let (first, step) = self.columns(y, frame);
        x & (step - 1) == first
    }

    /// The first column that a frame draws on a line, and the distance of its columns. A first column that
    /// is not less than the distance means that the frame draws nothing on this line.
    fn columns(self, y: u16, frame: u32) -> (u16, u16) {
        let (frame, y) = ((frame & 3) as u16, y & 1);
        match self {
            Self::Checkerboard => ((y + frame) & 1, 2),
            Self::Square => {
                // Upper left, lower right, upper right, lower left.
                let (column, line) = ((frame ^ frame >> 1) & 1, frame & 1);
                if y == line { (column, 2) } else { (u16::MAX, 2) }
            }
        }
    }
}

impl<R: Real, S: Geometry> Renderer<'_, '_, R, S> {
    /// Draws the pixels of one frame of a pattern that the display shows, without a buffer: one `draw_iter`
    /// for each line.
    ///
    /// # Errors
    /// The display's own error, with the line.
    pub fn draw_pattern<D>(
        &self,
        pattern: Pattern,
        frame: u32,
        display: &mut D,
    ) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        D::Color: DisplayColor,
    {
        let region = self.whole().shown_in(&display.bounding_box());
        if region.is_empty() {
            return Ok(());
        }
        let Region { left, right, top, bottom } = region;
        for y in top as u16..bottom as u16 {
            let (first, step) = pattern.columns(y, frame);
            if first >= step {
                continue;
            }
            let mut painter = LinePainter::new(self, y);
            let pixels = (first..right as u16)
                .step_by(usize::from(step))
                .skip_while(|x| u32::from(*x) < left)
                .map(|x| Pixel(Point::new(i32::from(x), i32::from(y)), painter.pixel(x)));
            display.draw_iter(pixels).map_err(|error| DrawError::Display { line: u32::from(y), error })?;
        }
        Ok(())
    }
}
