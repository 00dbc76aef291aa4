//! The interface between a frame and the tracing of one quality.

use super::region::Region;
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

    /// Drops the current band, because the frame goes on with other lines or columns; so many lines are to
    /// be drawn.
    fn restart(&mut self, lines_total: u32);

    /// Traces the band of lines that holds the first line of `region`, which is not empty, until it is
    /// complete or `budget_rays` are spent. An incomplete band gets one unit of work or more. The band stays
    /// until its lines are [sent](Self::sent_until).
    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        region: &Region,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Traced;

    /// One or more lines of the complete band, from the first line of `region` on: the line after them, and
    /// their pixels in the columns of `region`.
    fn band(&self, region: &Region) -> (u32, &[Self::Color]);

    /// All lines above `line` are on the display. If the current band lies above it, the band is dropped.
    fn sent_until(&mut self, line: u32);
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

    /// Lines of the band at the top of this region of the picture: as many as the memory holds, and fewer at
    /// the bottom.
    fn height(&self, region: &Region) -> u32 {
        let most = self.colors.len() / (region.width() as usize).max(1);
        u32::try_from(most).unwrap_or(u32::MAX).min(region.height())
    }

    /// Pixels of the band at the top of this region of the picture.
    pub(super) fn pixels(&self, region: &Region) -> usize {
        self.height(region) as usize * region.width() as usize
    }

    /// [`Painter::band`].
    pub(super) fn complete(&self, region: &Region) -> (u32, &[C]) {
        let pixels = self.colors.get(..self.pixels(region)).unwrap_or_default();
        (region.top.saturating_add(self.height(region)), pixels)
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
