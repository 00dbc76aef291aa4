//! Drawing in steps.

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::groups::Groups;
use super::painter::LinePainter;
use super::{DisplayColor, DrawError, LineError, Renderer};
use crate::math::Real;
use crate::shape::Geometry;

/// A picture that is being drawn: remembers how far it is.
///
/// # Guarantees
/// [`step`](Self::step) performs a bounded amount of work, and a picture drawn in steps has the same bytes as
/// one drawn at once.
#[derive(Debug)]
pub struct Frame<'p, 'm, 'b, R: Real, S: Geometry + 'm, C> {
    renderer: Renderer<'p, 'm, R, S>,
    buffer: &'b mut [C],
    /// The lines that are not yet on the display; the buffer begins with the first.
    lines: Range<u32>,
    /// Pixels of the buffer that are traced.
    traced: usize,
    /// How many lines were to be drawn.
    total: u32,
}

/// How far a [`Frame`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Lines that are on the display.
    pub lines_done: u32,
    /// Lines that there are to draw.
    pub lines_total: u32,
    /// Rays that this step spent; in realtime quality, 1 for a cell that takes none.
    pub rays: u32,
}

impl Progress {
    /// Whether everything is on the display.
    pub fn is_done(&self) -> bool {
        self.lines_done >= self.lines_total
    }
}

impl<'p, 'm, 'b, R: Real, S: Geometry + 'm, C: DisplayColor> Frame<'p, 'm, 'b, R, S, C> {
    pub(super) fn new(
        renderer: Renderer<'p, 'm, R, S>,
        lines: Range<u32>,
        buffer: &'b mut [C],
    ) -> Result<Self, LineError> {
        let lines = renderer.lines_of(lines)?;
        renderer.whole_lines(buffer.len())?;
        Ok(Self { renderer, total: lines.end.saturating_sub(lines.start), buffer, lines, traced: 0 })
    }

    /// Goes on with other lines of the same picture, that may begin and end anywhere. Lines that were not yet on the display are not drawn.
    ///
    /// # Errors
    /// Where the picture has no such lines; then it goes on as before.
    pub fn set_lines(&mut self, lines: Range<u32>) -> Result<(), LineError> {
        self.lines = self.renderer.lines_of(lines)?;
        self.total = self.lines.end.saturating_sub(self.lines.start);
        self.traced = 0;
        Ok(())
    }

    /// Traces pixels until `budget_rays` are spent, and at least one; sends each buffer to the display as soon
    /// as it is full. A step spends less than `budget_rays` plus
    /// [`Settings::rays_per_pixel`](super::Settings::rays_per_pixel): of a scene with a hierarchy, in floating point, plus that for each
    /// pixel of a square of [`LINES_AT_ONCE`](crate::limits::LINES_AT_ONCE) lines.
    ///
    /// # Errors
    /// The display's own error, with the first line that may not have been drawn. Nothing is lost: the next
    /// step sends that line again.
    pub fn step<D>(&mut self, display: &mut D, budget_rays: u32) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        let mut spent: u32 = 0;
        while !self.lines.is_empty() {
            spent = spent.saturating_add(self.trace(budget_rays.saturating_sub(spent)));
            if self.traced < self.band_pixels() {
                break;
            }
            self.send(display)?;
            if spent >= budget_rays {
                break;
            }
        }
        Ok(self.progress(spent))
    }

    /// Pixels of the lines that the buffer holds now: fewer at the bottom of the picture.
    fn band_pixels(&self) -> usize {
        let left =
            u64::from(self.lines.end.saturating_sub(self.lines.start)) * u64::from(self.renderer.width);
        usize::try_from(left).map_or(self.buffer.len(), |left| left.min(self.buffer.len()))
    }

    /// Traces pixels into the buffer until it is full or the rays are spent; tells how many were.
    fn trace(&mut self, budget_rays: u32) -> u32 {
        let band = self.band_pixels();
        if let (Some(mut groups), Some(lines)) =
            (Groups::new(&self.renderer, &()), self.buffer.get_mut(..band))
        {
            return groups.trace(self.lines.start as u16, lines, &mut self.traced, budget_rays, &mut ());
        }
        let width = usize::from(self.renderer.width);
        let first = self.traced.checked_div(width).unwrap_or(0);
        let mut y = self.lines.start.saturating_add(first as u32) as u16;
        let mut x = self.traced.checked_rem(width).unwrap_or(0);
        let mut spent: u32 = 0;
        while self.traced < band {
            let line = self.traced..band.min(self.traced.saturating_add(width.saturating_sub(x)));
            let pixels = self.buffer.get_mut(line).unwrap_or_default();
            let mut painter = LinePainter::new(&self.renderer, y);
            let (painted, rays) = painter.paint(x as u16, pixels, budget_rays.saturating_sub(spent), &mut ());
            self.traced = self.traced.saturating_add(painted);
            spent = spent.saturating_add(rays);
            if painted == 0 || spent >= budget_rays {
                break;
            }
            (x, y) = (0, y.wrapping_add(1));
        }
        spent
    }

    /// Sends the full buffer to the display.
    fn send<D>(&mut self, display: &mut D) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        let pixels = self.band_pixels();
        let width = usize::from(self.renderer.width);
        let height = pixels.checked_div(width).unwrap_or(0) as u32;
        let area =
            Rectangle::new(Point::new(0, self.lines.start as i32), Size::new(self.renderer.width(), height));
        let colors = self.buffer.iter().take(pixels).copied();
        display
            .fill_contiguous(&area, colors)
            .map_err(|error| DrawError::Display { line: self.lines.start, error })?;
        self.lines.start = self.lines.start.saturating_add(height);
        self.traced = 0;
        Ok(())
    }

    fn progress(&self, rays: u32) -> Progress {
        let left = self.lines.end.saturating_sub(self.lines.start);
        Progress { lines_done: self.total.saturating_sub(left), lines_total: self.total, rays }
    }
}
