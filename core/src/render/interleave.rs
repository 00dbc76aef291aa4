//! Orders that draw a part of the lines in each frame.

use core::ops::Range;

/// Draws every second band of lines, or every fourth, in each frame, and the others in the frames after it.
/// A picture that moves changes earlier on the display.
///
/// ```
/// use rayline::Interleave;
/// // Every second line of a picture of five.
/// let order = Interleave { lines: 1, every: 2 };
/// assert!(order.bands(5, 0).eq([0..1, 2..3, 4..5]));
/// assert!(order.bands(5, 1).eq([1..2, 3..4]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interleave {
    /// Lines of a band: 1, or in realtime quality [`Grid::pixels`](crate::Grid::pixels). 0 counts as 1.
    pub lines: u32,
    /// The number of frames that draw all bands. 0 counts as 1.
    pub every: u32,
}

impl Interleave {
    /// The lines to draw in frame number `frame` of a picture of this height, for
    /// [`Renderer::frame`](crate::Renderer::frame) or [`Frame::set_lines`](crate::Frame::set_lines).
    pub fn bands(self, height: u32, frame: u32) -> impl Iterator<Item = Range<u32>> {
        let (lines, every) = (self.lines.max(1), self.every.max(1));
        let first = frame.checked_rem(every).unwrap_or(0);
        let starts = core::iter::successors(lines.checked_mul(first), move |start| {
            lines.checked_mul(every).and_then(|step| start.checked_add(step))
        });
        starts
            .take_while(move |start| *start < height)
            .map(move |start| start..start.saturating_add(lines).min(height))
    }
}
