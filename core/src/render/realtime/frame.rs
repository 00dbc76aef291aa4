//! Drawing in realtime quality, in steps.

use core::ops::Range;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{Point, Size};
use embedded_graphics::primitives::Rectangle;

use super::budget::{Budget, Detail};
use super::cell::{Cell, Look, Place};
use super::seen::Seen;
use super::strip::{Strip, thin_objects};
use super::{Realtime, RealtimeBuffer, Sample};
use crate::integrator::Sight;
use crate::math::Real;
use crate::prepared::candidates::ObjectSet;
use crate::probe::Probe;
use crate::render::{DisplayColor, Dither, DrawError, Light16, LineError, Progress, Quantizer, Renderer};
use crate::shape::Geometry;

/// A picture that is being drawn in realtime quality: remembers how far it is.
///
/// # Guarantees
/// [`step`](Self::step) performs a bounded amount of work, and a picture drawn in steps has the same bytes as one
/// drawn at once, in any order of lines. No pixel is traced twice for one band of lines.
#[derive(Debug)]
pub struct RealtimeFrame<'p, 'm, 'b, R: Real, S: Geometry + 'm, C> {
    renderer: Renderer<'p, 'm, R, S>,
    quality: Realtime,
    buffer: RealtimeBuffer<'b, C>,
    /// The lines that are not yet on the display.
    lines: Range<u32>,
    /// How many lines were to be drawn.
    total: u32,
    /// Objects that could hide between the points of the grid.
    thin: ObjectSet,
    band: Option<Band>,
    /// The line of the picture that the lent row of samples holds.
    row: Option<u32>,
    cell: Cell,
    budget: Budget,
}

/// The lines between two rows of the grid.
#[derive(Clone, Copy, Debug)]
struct Band {
    top: u32,
    /// Left column of the next cell.
    left: u32,
    /// Whether the lent row of samples holds the upper row of the grid from there on.
    has_top: bool,
    strip: Option<Strip>,
}

impl<'p, 'm, 'b, R: Real, S: Geometry + 'm, C: DisplayColor> RealtimeFrame<'p, 'm, 'b, R, S, C> {
    pub(super) fn new(
        renderer: Renderer<'p, 'm, R, S>,
        lines: Range<u32>,
        quality: Realtime,
        buffer: RealtimeBuffer<'b, C>,
    ) -> Result<Self, LineError> {
        let (width, height) = (renderer.width(), renderer.height());
        if lines.end > height {
            return Err(LineError::NoSuchLine { line: lines.end.wrapping_sub(1), height });
        }
        let needed = quality.colors(renderer.width);
        if buffer.colors.len() != needed {
            return Err(LineError::BandLength { given: buffer.colors.len(), needed });
        }
        let needed = quality.samples(renderer.width);
        if buffer.samples.len() != needed {
            return Err(LineError::SampleCount { given: buffer.samples.len(), needed });
        }
        let lines = if width == 0 || lines.is_empty() { 0..0 } else { lines };
        // What is as wide and high as two cells covers a point of the grid wherever it is.
        let thin = thin_objects(&renderer, quality.grid.pixels() as u16 * 2);
        Ok(Self {
            renderer,
            quality,
            buffer,
            total: lines.end.saturating_sub(lines.start),
            lines,
            thin,
            band: None,
            row: None,
            cell: Cell::BLANK,
            budget: Budget::new(quality.budget_rays),
        })
    }

    /// Traces cells of the grid until `budget_rays` are spent, and at least one; sends each band of lines to the
    /// display as soon as it is complete. A step spends less than `budget_rays` plus
    /// [`Settings::rays_per_pixel`](crate::Settings) for each pixel of a cell and its sides.
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
                None => self.begin(),
            };
            while band.left < self.renderer.width() {
                let rays = self.draw_cell(&mut band, probe);
                self.budget.spend(rays);
                spent = spent.saturating_add(rays);
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

    /// The band that holds the next line.
    fn begin(&mut self) -> Band {
        let side = self.quality.grid.pixels();
        let top = self.lines.start & !(side as u32 - 1);
        let bottom = (top + side as u32).min(self.renderer.height().saturating_sub(1));
        self.budget.share(side as u32, self.lines.end.saturating_sub(self.lines.start));
        let strip = Strip::new(&self.renderer, top as u16, bottom as u16);
        Band { top, left: 0, has_top: self.row == Some(top), strip }
    }

    /// Draws the next cell of a band into the buffer; tells how many rays that took.
    fn draw_cell(&mut self, band: &mut Band, probe: &mut impl Probe<R>) -> u32 {
        let side = self.quality.grid.pixels();
        let place = Place {
            left: band.left,
            top: band.top,
            last_x: self.renderer.width().saturating_sub(1),
            last_y: self.renderer.height().saturating_sub(1),
            side,
        };
        let among = band.strip.map(|strip| strip.between(place.x(0), place.x(side)));
        let mut look = Tracer {
            renderer: &self.renderer,
            among,
            threshold: self.quality.threshold,
            detail: self.budget.detail(),
            probe,
            rays: 0,
        };
        let first = band.left as usize / 2;

        // The side above: known from the band before, or looked at.
        if band.has_top {
            for (x, sample) in (0..=side).step_by(2).zip(self.buffer.samples.iter().skip(first)) {
                self.cell.set(x, 0, *sample);
            }
        } else {
            if band.left == 0 {
                let corner = look.trace(place.x(0), place.y(0));
                self.cell.set(0, 0, corner);
            }
            self.cell.look_at_row(&place, 0, &mut look);
        }
        // The side on the left: known from the cell before, or looked at.
        if band.left == 0 {
            let corner = if place.y(side) == place.y(0) {
                self.cell.get(0, 0)
            } else {
                look.trace(place.x(0), place.y(side))
            };
            self.cell.set(0, side, corner);
            self.cell.look_at_column(&place, 0, &mut look);
        }
        self.cell.look_at_bottom(&place, &mut look);
        self.cell.look_at_column(&place, side, &mut look);
        let mut smooth = self.cell.refine(&place, &mut look);
        if look.detail != Detail::Grid && among.is_some_and(|among| among.intersects(self.thin)) {
            self.cell.trace_all(&place, &mut look);
            smooth = false;
        }

        let rays = look.rays;
        for (x, sample) in (0..=side).step_by(2).zip(self.buffer.samples.iter_mut().skip(first)) {
            // The last point is the first of the next cell, which still needs what stands there.
            if x < side || !band.has_top || place.left + side as u32 > place.last_x {
                *sample = self.cell.get(x, side);
            }
        }
        self.paint(&place, smooth);
        self.cell.advance(side);
        band.left += side as u32;
        if band.left >= self.renderer.width() {
            self.row = Some(band.top + side as u32);
        }
        rays
    }

    /// Turns the light of a cell into the display's colors. A smooth one has nothing that its corners have not.
    fn paint(&mut self, place: &Place, smooth: bool) {
        let settings = &self.renderer.settings;
        let width = usize::from(self.renderer.width);
        let all =
            (smooth && settings.dither == Dither::None).then(|| self.cell.uniform(place.side)).flatten();
        let all = all.map(|sample| C::from_light(sample.light(), &Quantizer::new(settings, 0, 0)));
        for y in 0..place.side {
            let line = self.buffer.colors.iter_mut().skip(y * width).take(width).skip(place.left as usize);
            for (x, pixel) in (0..place.side).zip(line) {
                *pixel = all.unwrap_or_else(|| {
                    let quantizer = Quantizer::new(settings, place.x(x), place.y(y));
                    C::from_light(self.cell.get(x, y).light(), &quantizer)
                });
            }
        }
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

/// Traces pixels among the objects that a cell can show.
struct Tracer<'r, 'p, 'm, 'w, R: Real, S: Geometry + 'm, P> {
    renderer: &'r Renderer<'p, 'm, R, S>,
    among: Option<ObjectSet>,
    threshold: u16,
    detail: Detail,
    probe: &'w mut P,
    rays: u32,
}

impl<R: Real, S: Geometry, P: Probe<R>> Look for Tracer<'_, '_, '_, '_, R, S, P> {
    // Called from many places: one copy is enough.
    #[inline(never)]
    fn trace(&mut self, x: u16, y: u16) -> Sample {
        let mut seen = Seen::new(self.renderer.scene, self.probe);
        let (light, rays) =
            self.renderer.light_at(x, y, Sight { among: self.among, shades: None }, &mut seen);
        self.rays = self.rays.saturating_add(rays);
        seen.sample(Light16::new(light))
    }

    #[inline]
    fn differ(&self, a: Sample, b: Sample) -> bool {
        match self.detail {
            Detail::Full => a.differs(b, self.threshold),
            Detail::Coarse => a.differs_in_color(b, self.threshold.saturating_mul(4)),
            Detail::Grid => false,
        }
    }
}
