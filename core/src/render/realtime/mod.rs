//! Realtime quality: few pixels are traced, the rest is interpolated where nothing can lie in between.
//!
//! Every fourth pixel of every fourth line is traced. Between two that differ, the one in the middle is traced too, and
//! so on down to the pixel; between two that do not, light is interpolated, in integers (Akimoto, Mase and Suenaga,
//! "Pixel-Selected Ray Tracing", IEEE CG&A 1991; Whitted, "An Improved Illumination Model for Shaded Display", CACM
//! 1980, refines in the same way below the pixel). Two pixels differ if their colors do, or what they saw: which objects,
//! in which order, which cells of a texture, which lights were in the way. Of that they keep a digest of 14 bits, so
//! a sample takes 8 bytes. What is seen by rays of less than 1/16 does not count, or every faint reflection would be
//! traced; color alone decides there.
//!
//! Two kinds of things lie between the points of the grid and leave no mark on them:
//! - *Thin objects.* Where each object can be seen is known before the first ray, as for exact lines. Cells that an
//!   object less than two cells wide or high can reach are traced in full. This ends at 32 objects, and it does not
//!   know the thin parts of large flat shapes: those may lose a tip.
//! - *Small highlights.* A pixel from which one can be seen at all, at 2⁻²⁴ of its strength, differs from every other.
//!   That is about 1.7 times as wide as what shows of it.
//!
//! A cell needs its four corners, and every other point of its sides; those depend on their own row or column of the
//! picture alone, not on what is found inside. So a band of lines needs nothing of the others: the row of samples that
//! it hands to the one below only saves tracing it again, and lines are the same bytes in any order.
//!
//! Measured at 320×240 against the exact picture in 8-bit sRGB (tests/tests/realtime.rs prints this table):
//!
//! | scene | PSNR | traced pixels | rays a pixel | exact |
//! |---|---|---|---|---|
//! | classic | 59.9 dB | 0.205 | 0.93 | 2.29 |
//! | whitted | 55.4 dB | 0.249 | 1.97 | 4.67 |
//! | flake | 43.4 dB | 0.270 | 1.60 | 4.57 |
//! | prism | 46.3 dB | 0.427 | 2.72 | 5.21 |
//!
//! Of 24 frames around `classic` at 160×120, where everything is smaller, the worst has 40.5 dB; around `prism` 37.7 dB.
//! A grid of eight traces 0.170 of `classic` for 50.7 dB, and loses more small things: 37.6 dB in the worst frame. The
//! threshold matters little: at 1/256 `classic` has 63.0 dB for 0.219, at 1/8 53.4 dB for 0.194.

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
