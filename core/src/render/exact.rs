//! Exact quality: every pixel is traced.

use super::groups::Groups;
use super::line::LinePainter;
use super::painter::{LineBand, Painter, Traced};
use super::region::Region;
use super::{DisplayColor, Renderer};
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

/// Traces every pixel of a band: of as many whole lines as the lent memory holds.
#[derive(Debug)]
pub struct ExactPainter<'b, C>(LineBand<'b, C>);

impl<'b, C> ExactPainter<'b, C> {
    pub(super) fn new(colors: &'b mut [C]) -> Self {
        Self(LineBand::new(colors))
    }
}

impl<'m, R: Real, S: Geometry + 'm, C: DisplayColor> Painter<'m, R, S> for ExactPainter<'_, C> {
    type Color = C;

    fn restart(&mut self, _lines_total: u32) {
        self.0.traced = 0;
    }

    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        region: &Region,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Traced {
        let pixels = self.0.pixels(region);
        let LineBand { colors, traced } = &mut self.0;
        let band = colors.get_mut(..pixels).unwrap_or_default();
        let rays = trace_region(renderer, region, band, traced, budget_rays, probe);
        Traced { rays, is_complete: *traced >= pixels }
    }

    fn band(&self, region: &Region) -> (u32, &[C]) {
        self.0.complete(region)
    }

    fn sent_until(&mut self, _line: u32) {
        self.0.traced = 0;
    }
}

/// Traces the whole lines of a region of the picture that `pixels` hold, of which the first `traced` pixels
/// are done, until all are done or `budget_rays` are spent; at least one pixel, or one group of pixels that
/// are traced side by side. Returns the rays that it spent.
pub(super) fn trace_region<R: Real, S: Geometry, C: DisplayColor>(
    renderer: &Renderer<'_, '_, R, S>,
    region: &Region,
    pixels: &mut [C],
    traced: &mut usize,
    budget_rays: u32,
    probe: &mut impl Probe<R>,
) -> u32 {
    if let Some(mut groups) = Groups::new(renderer, probe) {
        return groups.trace(region, pixels, traced, budget_rays, probe);
    }
    let width = (region.width() as usize).max(1);
    let (mut down, mut x) = (*traced / width, *traced % width);
    let mut spent: u32 = 0;
    while *traced < pixels.len() {
        let end = pixels.len().min(traced.saturating_add(width - x));
        let line = pixels.get_mut(*traced..end).unwrap_or_default();
        let (column, y) = region.pixel(x, down);
        let mut painter = LinePainter::new(renderer, y);
        let (painted, rays) = painter.paint(column, line, budget_rays.saturating_sub(spent), probe);
        *traced = traced.saturating_add(painted);
        spent = spent.saturating_add(rays);
        if painted == 0 || spent >= budget_rays {
            break;
        }
        (down, x) = (down.wrapping_add(1), 0);
    }
    spent
}
