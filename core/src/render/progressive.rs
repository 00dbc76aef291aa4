//! Progressive refinement: a picture that is shown early and becomes smooth over several passes (Bergman,
//! Fuchs, Grant and Spach, "Image Rendering by Adaptive Refinement", SIGGRAPH 1986).

use super::painter::{LineBand, Painter, Traced};
use super::pixel_sum::PixelSum;
use super::quality::Sealed;
use super::region::Region;
use super::{DisplayColor, Frame, LineError, Quality, Renderer};
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

/// Memory for exact quality in passes: each pass adds a sample to every pixel and draws all pixels.
///
/// After the last pass the picture has the bytes of one that is drawn at once, in every number system. With
/// [adaptive sampling](crate::Sampling::adaptive), the first pass takes the first samples of all pixels, and
/// further passes only change the pixels whose samples differed. A pixel takes 20 bytes of memory in `f32`
/// and in fixed point.
///
/// ```
/// use embedded_graphics::{mock_display::MockDisplay, pixelcolor::Gray8};
/// use rayline::{DrawError, PixelSum, Progressive, Real, Renderer};
///
/// fn refine<R: Real>(
///     renderer: &Renderer<'_, '_, R>,
///     display: &mut MockDisplay<Gray8>,
/// ) -> Result<(), DrawError<core::convert::Infallible>> {
///     let mut line = [Gray8::new(0); 64];
///     let mut sums = [PixelSum::EMPTY; 64 * 48];
///     let mut frame = renderer.frame(0..48, Progressive::lend(&mut line, &mut sums))?;
///     loop {
///         frame.draw(display)?;
///         if frame.is_refined() {
///             return Ok(());
///         }
///         frame.set_lines(0..48)?;
///     }
/// }
/// ```
#[derive(Debug)]
pub struct Progressive<'b, C, R> {
    line: &'b mut [C],
    sums: &'b mut [PixelSum<R>],
}

impl<'b, C: DisplayColor, R: Real> Progressive<'b, C, R> {
    /// Lends memory for one line of the picture, or for several whole lines that are sent to the display
    /// together, and for one sum for each pixel of the picture, line by line. Sums that are not
    /// [empty](PixelSum::EMPTY) are gone on with: they must be of the same picture.
    pub fn lend(line: &'b mut [C], sums: &'b mut [PixelSum<R>]) -> Self {
        Self { line, sums }
    }
}

impl<C: DisplayColor, R: Real> Sealed for Progressive<'_, C, R> {}

impl<'b, C: DisplayColor, R: Real> Quality<R> for Progressive<'b, C, R> {
    type Color = C;
    type Painter<'m, S: Geometry + 'm> = ProgressivePainter<'b, C, R>;

    fn check<S: Geometry>(&self, renderer: &Renderer<'_, '_, R, S>) -> Result<(), LineError> {
        let needed = (renderer.width() as usize).saturating_mul(renderer.height() as usize);
        if self.sums.len() != needed {
            return Err(LineError::SumCount { given: self.sums.len(), needed });
        }
        renderer.check_line(self.line.len())
    }

    fn painter<'m, S: Geometry + 'm>(self, _: &Renderer<'_, 'm, R, S>) -> ProgressivePainter<'b, C, R> {
        ProgressivePainter { band: LineBand::new(self.line), sums: self.sums }
    }
}

impl<'m, R: Real, S: Geometry + 'm, C: DisplayColor> Frame<'_, 'm, R, S, Progressive<'_, C, R>> {
    /// Whether all pixels that the display shows have all samples that they need, so that another pass would
    /// change nothing.
    pub fn is_refined(&self) -> bool {
        self.sums_shown().all(|sum| sum.is_complete)
    }

    /// How many pixels that the display shows have all samples that they need.
    pub fn pixels_refined(&self) -> usize {
        self.sums_shown().filter(|sum| sum.is_complete).count()
    }

    /// The sums of the pixels that the display shows; of all pixels before anything is drawn.
    fn sums_shown(&self) -> impl Iterator<Item = &PixelSum<R>> {
        let Region { left, right, top, bottom } = self.shown;
        let all = self.painter.sums.chunks(usize::from(self.renderer.width).max(1));
        let lines = all.take(bottom as usize).skip(top as usize);
        lines.flat_map(move |line| line.iter().take(right as usize).skip(left as usize))
    }
}

/// Adds a sample to each pixel of a band: of as many whole lines as the lent memory holds.
#[derive(Debug)]
pub struct ProgressivePainter<'b, C, R> {
    band: LineBand<'b, C>,
    sums: &'b mut [PixelSum<R>],
}

impl<'m, R: Real, S: Geometry + 'm, C: DisplayColor> Painter<'m, R, S> for ProgressivePainter<'_, C, R> {
    type Color = C;

    fn restart(&mut self, _lines_total: u32) {
        self.band.traced = 0;
    }

    fn trace(
        &mut self,
        renderer: &Renderer<'_, 'm, R, S>,
        region: &Region,
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> Traced {
        let (pixels, width) = (self.band.pixels(region), (region.width() as usize).max(1));
        let mut spent: u32 = 0;
        while self.band.traced < pixels && spent < budget_rays.max(1) {
            let (x, y) = region.pixel(self.band.traced % width, self.band.traced / width);
            let place = usize::from(y).saturating_mul(usize::from(renderer.width)).saturating_add(x.into());
            if let Some(sum) = self.sums.get_mut(place)
                && let Some(color) = self.band.colors.get_mut(self.band.traced)
            {
                let before = sum.rays;
                *color = renderer.refine(x, y, sum, probe);
                // A complete pixel takes time, too.
                spent = spent.saturating_add(sum.rays.saturating_sub(before).max(1));
            }
            self.band.traced = self.band.traced.saturating_add(1);
        }
        Traced { rays: spent, is_complete: self.band.traced >= pixels }
    }

    fn band(&self, region: &Region) -> (u32, &[C]) {
        self.band.complete(region)
    }

    fn sent_until(&mut self, _line: u32) {
        self.band.traced = 0;
    }
}
