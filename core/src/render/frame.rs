//! A picture that is being drawn, step by step.

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::Dimensions;

use super::painter::Painter;
use super::region::Region;
use super::{DrawError, LineError, Quality, Renderer};
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

/// A picture that is being drawn in one [`Quality`], and how far it is.
///
/// # Guarantees
/// [`step`](Self::step) performs a bounded amount of work. A picture that is drawn in steps, in any order
/// of lines, has the same bytes as one that is drawn at once, unless a budget of rays makes realtime quality
/// coarser.
#[derive(Debug)]
pub struct Frame<'r, 'm, R: Real, S: Geometry + 'm, Q: Quality<R>> {
    pub(super) renderer: &'r Renderer<'r, 'm, R, S>,
    /// The lines that are not yet on the display.
    lines: Range<u32>,
    /// How many lines were to be drawn.
    total: u32,
    /// The part of the picture that the display showed at the last step; the whole picture before the first.
    pub(super) shown: Region,
    pub(super) painter: Q::Painter<'m, S>,
}

/// How far a [`Frame`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Progress {
    /// Lines that are on the display.
    pub lines_done: u32,
    /// Lines that there are to draw.
    pub lines_total: u32,
    /// The work of this step in rays. A cell, a pixel or a pixel of a preview that takes no ray counts as 1.
    pub rays: u32,
}

impl Progress {
    /// Whether everything is on the display.
    pub fn is_done(&self) -> bool {
        self.lines_done >= self.lines_total
    }
}

impl<'r, 'm, R: Real, S: Geometry + 'm, Q: Quality<R>> Frame<'r, 'm, R, S, Q> {
    /// Of these lines, which the picture has, in memory that was checked.
    #[inline]
    pub(super) fn new(renderer: &'r Renderer<'r, 'm, R, S>, lines: Range<u32>, quality: Q) -> Self {
        let total = lines.end.saturating_sub(lines.start);
        let shown = renderer.whole();
        let mut frame = Self { renderer, lines, total, shown, painter: quality.painter(renderer) };
        frame.painter.restart(total);
        frame
    }

    /// Goes on with other lines of the same picture, which may begin and end anywhere. Lines that were not
    /// yet on the display are not drawn.
    ///
    /// In realtime quality, the frame keeps the data of the whole picture. If the new lines follow the lines
    /// drawn last, the frame also keeps the row of samples above the new lines. The frame's budget of rays
    /// begins anew.
    ///
    /// # Errors
    /// If the picture has no such lines. The frame is then as before.
    pub fn set_lines(&mut self, lines: Range<u32>) -> Result<(), LineError> {
        self.lines = self.renderer.lines_of(lines)?;
        self.total = self.lines.end.saturating_sub(self.lines.start);
        self.painter.restart(self.total);
        Ok(())
    }

    /// Draws all lines that are left.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn draw<D>(&mut self, display: &mut D) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color = Q::Color>,
    {
        while !self.step(display, u32::MAX)?.is_done() {}
        Ok(())
    }

    /// Traces until `budget_rays` are spent, and at least one pixel; in realtime quality, at least one cell
    /// of the grid. Sends each band of lines to the display as soon as it is complete.
    ///
    /// A step spends less than `budget_rays` plus
    /// [`Settings::rays_per_pixel`](super::Settings::rays_per_pixel) for each pixel of the last piece of
    /// work. In exact quality this is one pixel; in a scene with a hierarchy, in floating point, a group of
    /// as many pixels as a square of [`LINES_AT_ONCE`](crate::limits::LINES_AT_ONCE) lines has. In realtime
    /// quality it is a cell with its sides, and each pixel counts twice, because some are traced once more
    /// without lights. Contours take up to 4 rays more for each sample of a pixel.
    ///
    /// # Errors
    /// The display's own error, with the first line that may not have been drawn. Nothing is lost: the next
    /// step sends that line again.
    pub fn step<D>(&mut self, display: &mut D, budget_rays: u32) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = Q::Color>,
    {
        self.step_watched(display, budget_rays, &mut ())
    }

    /// As [`step`](Self::step), with a probe that records what happens. Realtime quality records only the
    /// pixels that it traces.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn step_watched<D>(
        &mut self,
        display: &mut D,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = Q::Color>,
    {
        let (mut spent, mut is_spent) = (0u32, false);
        while let Some(region) = self.next_region(display).filter(|_| !is_spent) {
            let left = budget_rays.saturating_sub(spent);
            let traced = self.painter.trace(self.renderer, &region, left, probe);
            spent = spent.saturating_add(traced.rays);
            if !traced.is_complete {
                break;
            }
            self.send(display, &region)?;
            is_spent = spent >= budget_rays;
        }
        let left = self.lines.end.saturating_sub(self.lines.start);
        Ok(Progress { lines_done: self.total.saturating_sub(left), lines_total: self.total, rays: spent })
    }

    /// The pixels that this display shows of the lines that are left; `None` if it shows none.
    fn next_region(&mut self, display: &impl Dimensions) -> Option<Region> {
        let shown = self.renderer.whole().shown_in(&display.bounding_box());
        let (top, bottom) = (shown.top.max(self.lines.start), shown.bottom.min(self.lines.end));
        let region = Region { top, bottom, ..shown };
        if shown != self.shown {
            self.shown = shown;
            self.painter.restart(region.height());
        }
        if region.is_empty() {
            self.lines.start = self.lines.end;
            return None;
        }
        Some(region)
    }

    /// Sends complete lines to the display.
    fn send<D>(&mut self, display: &mut D, region: &Region) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color = Q::Color>,
    {
        let (end, colors) = self.painter.band(region);
        let sent = Region { bottom: end, ..*region };
        display
            .fill_contiguous(&sent.area(), colors.iter().copied())
            .map_err(|error| DrawError::Display { line: region.top, error })?;
        self.lines.start = end;
        self.painter.sent_until(end);
        Ok(())
    }
}
