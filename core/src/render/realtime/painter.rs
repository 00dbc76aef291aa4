//! Realtime quality as a frame uses it: a painter of bands.

use super::band::{Band, BandPainter};
use super::buffer::RealtimeBuffer;
use super::quality::Edges;
use crate::math::Real;
use crate::probe::Probe;
use crate::render::painter::{Painter, Traced};
use crate::render::quality::Sealed;
use crate::render::region::Region;
use crate::render::{DisplayColor, LineError, Quality, Renderer};
use crate::shape::Geometry;

impl<C: DisplayColor> Sealed for RealtimeBuffer<'_, C> {}

impl<'b, C: DisplayColor, R: Real> Quality<R> for RealtimeBuffer<'b, C> {
    type Color = C;
    type Painter<'m, S: Geometry + 'm> = RealtimePainter<'m, 'b, R, S, C>;

    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError> {
        let needed = self.quality.colors(renderer.width);
        if self.colors.len() < needed {
            return Err(LineError::BandLength { given: self.colors.len(), needed });
        }
        let needed = self.quality.samples(renderer.width);
        if self.samples.len() < needed {
            return Err(LineError::SampleCount { given: self.samples.len(), needed });
        }
        if !cfg!(feature = "distributed") && self.quality.edges == Edges::Smooth {
            return Err(LineError::WithoutDistributed);
        }
        Ok(())
    }

    #[inline]
    fn painter<'m, S: Geometry + 'm>(
        self,
        renderer: &Renderer<'_, 'm, R, S>,
    ) -> RealtimePainter<'m, 'b, R, S, C> {
        RealtimePainter { bands: BandPainter::new::<C>(renderer, self.quality), band: None, buffer: self }
    }
}

/// Draws bands of lines in realtime quality. A pixel is traced once for one band, and some pixels once more
/// without lights.
#[derive(Debug)]
pub struct RealtimePainter<'m, 'b, R: Real, S: Geometry + 'm, C> {
    bands: BandPainter<'m, R, S>,
    /// The band that is being drawn, or that is complete and not yet on the display.
    band: Option<Band<R>>,
    buffer: RealtimeBuffer<'b, C>,
}

impl<R: Real, S: Geometry, C> RealtimePainter<'_, '_, R, S, C> {
    /// The line after a band.
    fn bottom(&self, band: &Band<R>) -> u32 {
        band.top.saturating_add(self.buffer.quality.grid.pixels() as u32)
    }
}

impl<'m, R: Real, S: Geometry + 'm, C: DisplayColor> Painter<'m, R, S> for RealtimePainter<'m, '_, R, S, C> {
    type Color = C;

    fn restart(&mut self, lines_total: u32) {
        let is_unfinished = self.band.take().is_some();
        self.bands.restart(lines_total, is_unfinished);
    }

    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        region: &Region,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Traced {
        let mut band = match self.band {
            Some(band) => band,
            None => self.bands.begin(renderer, region),
        };
        let mut spent: u32 = 0;
        while !band.is_complete() {
            let rays = self.bands.draw_cell(renderer, &mut band, &mut self.buffer, probe);
            // A cell without rays takes time too.
            spent = spent.saturating_add(rays.max(1));
            if spent >= budget_rays {
                break;
            }
        }
        self.band = Some(band);
        Traced { rays: spent, is_complete: band.is_complete() }
    }

    fn band(&self, region: &Region) -> (u32, &[C]) {
        let Some(band) = &self.band else { return (region.bottom, &[]) };
        // The band may have pixels to the left of the region. Each line is then sent by itself.
        let beside = region.left.saturating_sub(band.first);
        let below = if beside == 0 { self.bottom(band) } else { region.top.saturating_add(1) };
        let end = below.min(region.bottom);
        let pixels = |lines: u32| lines as usize * band.width();
        let first = pixels(region.top.saturating_sub(band.top)) + beside as usize;
        let last = pixels(end.saturating_sub(band.top));
        (end, self.buffer.colors.get(first..last).unwrap_or_default())
    }

    fn sent_until(&mut self, line: u32) {
        if self.band.as_ref().is_some_and(|band| line >= self.bottom(band)) {
            self.band = None;
        }
    }
}
