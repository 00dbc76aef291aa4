//! Realtime quality: few pixels are traced, the rest is interpolated where nothing can lie in between.

mod budget;
mod cell;
mod frame;
mod sample;
mod seen;
mod stadium;
mod strip;

pub use frame::RealtimeFrame;
pub use sample::Sample;

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;

use super::{DisplayColor, DrawError, LineError, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// How much realtime quality may differ from the exact picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Realtime {
    /// How far apart the pixels are that are always traced.
    pub grid: Grid,
    /// Neighbors on the grid may differ by this much, in units of 1/65536 of full light and plus a sixteenth of
    /// their own, without a look at what lies between them.
    pub threshold: u16,
    /// The most rays for a frame; `u32::MAX`: as many as it takes. Where bands of lines take more than their share,
    /// those below are drawn more coarsely, so that the frame is done in time; but the pixels of the grid are
    /// always traced. Then what a line looks like depends on those that the same frame has drawn before.
    pub budget_rays: u32,
}

/// The distance of the pixels that are always traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grid {
    /// Every second pixel of every second line.
    Two,
    /// Every fourth pixel of every fourth line.
    Four,
    /// Every eighth pixel of every eighth line.
    Eight,
}

impl Grid {
    /// The distance in pixels.
    pub const fn pixels(self) -> usize {
        match self {
            Self::Two => 2,
            Self::Four => 4,
            Self::Eight => 8,
        }
    }
}

impl Default for Realtime {
    fn default() -> Self {
        Self::new()
    }
}

impl Realtime {
    /// What measured best: a grid of four pixels and a threshold of 1/32.
    pub const fn new() -> Self {
        Self { grid: Grid::Four, threshold: 2048, budget_rays: u32::MAX }
    }

    /// How many colors to lend for a picture of this width: a band of lines.
    pub const fn colors(&self, width: u16) -> usize {
        width as usize * self.grid.pixels()
    }

    /// How many samples to lend for a picture of this width: every other point of one line.
    pub const fn samples(&self, width: u16) -> usize {
        if width == 0 {
            return 0;
        }
        (width as usize).div_ceil(self.grid.pixels()) * self.grid.pixels() / 2 + 1
    }
}

/// The memory that realtime quality is drawn in.
#[derive(Debug)]
pub struct RealtimeBuffer<'b, C> {
    /// A band of lines: [`Realtime::colors`].
    pub colors: &'b mut [C],
    /// What is known of one line: [`Realtime::samples`].
    pub samples: &'b mut [Sample],
}

impl<'p, 'm, R: Real, S: Geometry + 'm> Renderer<'p, 'm, R, S> {
    /// As [`draw`](Self::draw), in realtime quality: one `fill_contiguous` per band of lines.
    ///
    /// # Errors
    /// A buffer of the wrong length, before the first pixel; or the display's own error.
    pub fn draw_realtime<D>(
        &self,
        quality: Realtime,
        display: &mut D,
        buffer: RealtimeBuffer<'_, D::Color>,
    ) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget,
        D::Color: DisplayColor,
    {
        let mut frame = self.realtime_frame(0..self.height(), quality, buffer)?;
        while !frame.step(display, u32::MAX)?.is_done() {}
        Ok(())
    }

    /// As [`frame`](Self::frame), in realtime quality. The lines may begin and end anywhere.
    ///
    /// # Errors
    /// Where a buffer has the wrong length, or the picture has no such lines.
    pub fn realtime_frame<'b, C: DisplayColor>(
        &self,
        lines: Range<u32>,
        quality: Realtime,
        buffer: RealtimeBuffer<'b, C>,
    ) -> Result<RealtimeFrame<'p, 'm, 'b, R, S, C>, LineError> {
        RealtimeFrame::new(*self, lines, quality, buffer)
    }
}
