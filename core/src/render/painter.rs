//! The interface between a frame and the tracing of one quality.

use core::ops::Range;

use super::{DisplayColor, Renderer};
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

/// Traces bands of lines in one quality. A [`Frame`](super::Frame) sends each complete band to the display.
///
/// The trait is public because [`Quality`](super::Quality) names it, but no other crate can name it.
pub trait Painter<'m, R: Real, S: Geometry + 'm> {
    /// The color of the display's pixels.
    type Color: DisplayColor;

    /// Drops the current band, because the frame goes on with other lines; so many are to be drawn.
    fn restart(&mut self, lines_total: u32);

    /// Traces the band of lines that holds the first of `lines`, until it is complete or `budget_rays` are
    /// spent. An incomplete band gets one unit of work or more. The band stays until
    /// [`next_band`](Self::next_band).
    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        lines: &Range<u32>,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Traced;

    /// The complete band: the line after it, and its pixels from the first of `lines` on.
    fn band(&self, renderer: &Renderer<'_, 'm, R, S>, lines: &Range<u32>) -> (u32, &[Self::Color]);

    /// Drops the current band, because it is on the display.
    fn next_band(&mut self);
}

/// Memory for a band of whole lines, and how many of its pixels are traced.
#[derive(Debug)]
pub(super) struct LineBand<'b, C> {
    pub(super) colors: &'b mut [C],
    pub(super) traced: usize,
}

impl<'b, C> LineBand<'b, C> {
    pub(super) fn new(colors: &'b mut [C]) -> Self {
        Self { colors, traced: 0 }
    }

    /// Pixels of the band that begins with these lines: fewer than the memory holds at the bottom of the
    /// picture.
    pub(super) fn pixels(&self, lines: &Range<u32>, width: u16) -> usize {
        let left = u64::from(lines.end.saturating_sub(lines.start)) * u64::from(width);
        usize::try_from(left).map_or(self.colors.len(), |left| left.min(self.colors.len()))
    }

    /// [`Painter::band`].
    pub(super) fn complete(&self, lines: &Range<u32>, width: u16) -> (u32, &[C]) {
        let pixels = self.pixels(lines, width);
        let height = pixels.checked_div(usize::from(width)).unwrap_or(0) as u32;
        (lines.start.saturating_add(height), self.colors.get(..pixels).unwrap_or_default())
    }
}

/// The result of one call of [`Painter::trace`].
#[derive(Clone, Copy, Debug)]
pub struct Traced {
    /// The rays that it spent.
    pub rays: u32,
    /// Whether the band is complete.
    pub is_complete: bool,
}
