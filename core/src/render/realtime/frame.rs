//! Drawing in realtime quality, in steps.

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::band::{Band, BandPainter};
use super::{Realtime, RealtimeBuffer};
use crate::math::Real;
use crate::probe::Probe;
use crate::render::{DisplayColor, DrawError, LineError, Progress, Renderer};
use crate::shape::Geometry;

/// A picture that is being drawn in realtime quality: remembers how far it is.
///
/// # Guarantees
/// [`step`](Self::step) performs a bounded amount of work, and a picture drawn in steps has the same bytes as one
/// drawn at once, in any order of lines. A pixel is traced once for one band of lines, and some once more without lights.
#[derive(Debug)]
pub struct RealtimeFrame<'p, 'm, 'b, R: Real, S: Geometry + 'm, C> {
    renderer: &'p Renderer<'p, 'm, R, S>,
    painter: BandPainter<'p, 'm, R, S>,
    quality: Realtime,
    buffer: RealtimeBuffer<'b, C>,
    /// The lines that are not yet on the display.
    lines: Range<u32>,
    /// How many lines were to be drawn.
    total: u32,
    band: Option<Band>,
}

impl<'p, 'm, 'b, R: Real, S: Geometry + 'm, C: DisplayColor> RealtimeFrame<'p, 'm, 'b, R, S, C> {
    pub(super) fn new(
        renderer: &'p Renderer<'p, 'm, R, S>,
        lines: Range<u32>,
        quality: Realtime,
        buffer: RealtimeBuffer<'b, C>,
    ) -> Result<Self, LineError> {
        let lines = renderer.lines_of(lines)?;
        let needed = quality.colors(renderer.width);
        if buffer.colors.len() != needed {
            return Err(LineError::BandLength { given: buffer.colors.len(), needed });
        }
        let needed = quality.samples(renderer.width);
        if buffer.samples.len() != needed {
            return Err(LineError::SampleCount { given: buffer.samples.len(), needed });
        }
        let total = lines.end.saturating_sub(lines.start);
        let painter = BandPainter::new::<C>(renderer, quality, total);
        Ok(Self { renderer, painter, quality, buffer, lines, total, band: None })
    }

    /// Goes on with other lines of the same picture, that may begin and end anywhere. What is known of the whole picture is not found out
    /// again, nor is what lies above them traced once more if they follow those drawn last. Lines that were not yet on the display are not
    /// drawn, and the budget is a new one.
    ///
    /// # Errors
    /// Where the picture has no such lines; then it goes on as before.
    pub fn set_lines(&mut self, lines: Range<u32>) -> Result<(), LineError> {
        self.lines = self.renderer.lines_of(lines)?;
        self.total = self.lines.end.saturating_sub(self.lines.start);
        self.painter.restart(self.total, self.band.take().is_some());
        Ok(())
    }

    /// Traces cells of the grid until `budget_rays` are spent, and at least one; sends each band of lines to the
    /// display as soon as it is complete. A step spends less than `budget_rays` plus
    /// [`Settings::rays_per_pixel`](crate::Settings) for each pixel of a cell and its sides, twice: some
    /// are looked at before they are traced.
    ///
    /// # Errors
    /// The display's own error, with the first line that may not have been drawn. Nothing is lost: the next step
    /// sends that line again.
    pub fn step<D>(&mut self, display: &mut D, budget_rays: u32) -> Result<Progress, DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        self.step_watched(display, budget_rays, &mut ())
    }

    /// As [`step`](Self::step), and tells `probe` what happens. Only pixels that are traced happen.
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
        D: DrawTarget<Color = C>,
    {
        let mut spent: u32 = 0;
        while !self.lines.is_empty() {
            let mut band = match self.band {
                Some(band) => band,
                None => self.painter.begin(&self.lines),
            };
            while band.left < self.renderer.width() {
                let rays = self.painter.draw_cell(&mut band, &mut self.buffer, probe);
                // A cell without rays takes time too.
                spent = spent.saturating_add(rays.max(1));
                if spent >= budget_rays {
                    break;
                }
            }
            self.band = Some(band);
            if band.left < self.renderer.width() {
                break;
            }
            self.send(display, band.top)?;
            if spent >= budget_rays {
                break;
            }
        }
        let left = self.lines.end.saturating_sub(self.lines.start);
        Ok(Progress { lines_done: self.total.saturating_sub(left), lines_total: self.total, rays: spent })
    }

    /// Sends the lines of a complete band that are still to be drawn.
    fn send<D>(&mut self, display: &mut D, top: u32) -> Result<(), DrawError<D::Error>>
    where
        D: DrawTarget<Color = C>,
    {
        let end = (top + self.quality.grid.pixels() as u32).min(self.lines.end);
        let width = usize::from(self.renderer.width);
        let size = Size::new(self.renderer.width(), end.saturating_sub(self.lines.start));
        let area = Rectangle::new(Point::new(0, self.lines.start as i32), size);
        let above = self.lines.start.saturating_sub(top) as usize * width;
        let colors = self.buffer.colors.iter().skip(above).take(size.height as usize * width).copied();
        display
            .fill_contiguous(&area, colors)
            .map_err(|error| DrawError::Display { line: self.lines.start, error })?;
        self.lines.start = end;
        self.band = None;
        Ok(())
    }
}
