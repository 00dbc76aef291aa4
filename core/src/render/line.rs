//! One line of the picture in exact quality, pixel after pixel.

#[cfg(feature = "looks")]
use super::contours::LineInk;
use super::line_candidates::LineCandidates;
use super::pixel::{Aim, Pixel};
use super::{DisplayColor, Dither, Light16, Quantizer, Renderer};
use crate::camera::RayRow;
use crate::color::LinearRgb;
use crate::integrator::Sight;
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

impl<R: Real, S: Geometry> Renderer<'_, '_, R, S> {
    /// The light of a pixel in a display's colors.
    #[inline]
    pub(super) fn color<C: DisplayColor>(&self, light: LinearRgb<R>, x: u16, y: u16) -> C {
        let light = Light16::new(light);
        #[cfg(feature = "looks")]
        let light = self.inked(light, self.ink(x, y));
        C::from_light(light, &Quantizer::new(&self.settings, x, y))
    }
}

/// Renders the pixels of one line in a display's colors, from left to right.
pub(super) struct LinePainter<'r, 'm, R: Real, S: Geometry + 'm, C> {
    renderer: &'r Renderer<'r, 'm, R, S>,
    y: u16,
    /// The rays through the centers of the pixels.
    row: RayRow<R>,
    candidates: Option<LineCandidates<'r>>,
    /// The color of a pixel that sees no object, if all such pixels have the same.
    background: Option<C>,
    /// The contours of the line, if there are any.
    #[cfg(feature = "looks")]
    ink: Option<LineInk<'r, R>>,
}

impl<'r, 'm, R: Real, S: Geometry + 'm, C: DisplayColor> LinePainter<'r, 'm, R, S, C> {
    pub(super) fn new(renderer: &'r Renderer<'r, 'm, R, S>, y: u16) -> Self {
        let settings = &renderer.settings;
        let candidates = LineCandidates::new(&renderer.outlines, y);
        let background = match renderer.scene.background.solid() {
            Some(color) if settings.dither == Dither::None && settings.sampling.samples == 1 => {
                Some(C::from_light(Light16::new(renderer.toned(color)), &Quantizer::new(settings, 0, y)))
            }
            _ => None,
        };
        #[cfg(feature = "looks")]
        let ink = LineInk::new(renderer, y);
        // Ink may lie beside objects.
        #[cfg(feature = "looks")]
        let background = background.filter(|_| ink.is_none());
        Self {
            renderer,
            y,
            row: renderer.row(y, Aim::Area),
            candidates,
            background,
            #[cfg(feature = "looks")]
            ink,
        }
    }

    /// Renders pixels from column `x` on, until all are done or `budget_rays` are spent, and at least one.
    /// Returns how many pixels it rendered, and the rays that they took. `x` must not decrease.
    // Forced, as in `groups`, `pixel` and `outlines`: without it, `classic` takes an M4F 1.03 times the
    // instructions, and an M0 1.02 times.
    #[inline(always)]
    pub(super) fn paint(
        &mut self,
        mut x: u16,
        pixels: &mut [C],
        budget_rays: u32,
        probe: &mut impl Probe<R>,
    ) -> (usize, u32) {
        let (mut painted, mut spent) = (0, 0u32);
        while let Some(rest) = pixels.get_mut(painted..)
            && let Some(first) = rest.first_mut()
        {
            let mut run = 1;
            match self.color_until(x, probe) {
                Some((color, until)) => {
                    let left = budget_rays.saturating_sub(spent).min(u32::from(until.saturating_sub(x)));
                    run = rest.len().min(left.max(1) as usize);
                    rest.iter_mut().take(run).for_each(|pixel| *pixel = color);
                    spent = spent.saturating_add(run as u32);
                }
                None => {
                    let (color, rays) = self.trace(x, probe);
                    *first = color;
                    spent = spent.saturating_add(rays);
                }
            }
            painted += run;
            x = x.wrapping_add(run as u16);
            if spent >= budget_rays {
                break;
            }
        }
        (painted, spent)
    }

    /// The color of the pixels from `x` to another column, if no object can be seen there; each takes a ray.
    #[inline(always)]
    fn color_until(&mut self, x: u16, probe: &impl Probe<R>) -> Option<(C, u16)> {
        let until = self.candidates.as_mut()?.nothing_until(x)?;
        self.background.filter(|_| !probe.is_enabled()).map(|color| (color, until))
    }

    /// Pixel `x` in the display's color. `x` must not decrease.
    pub(super) fn pixel(&mut self, x: u16) -> C {
        self.color_until(x, &()).map_or_else(|| self.trace(x, &mut ()).0, |(color, _)| color)
    }

    /// The color of pixel `x`, and the rays that it took. [`color_until`](Self::color_until) was called for
    /// `x` before.
    #[inline(always)]
    fn trace(&mut self, x: u16, probe: &mut impl Probe<R>) -> (C, u32) {
        let sight = match &mut self.candidates {
            Some(candidates) => candidates.sight(x),
            None => Sight::among(self.renderer.scene.all()),
        };
        let pixel = Pixel { x, y: self.y, row: self.row, aim: Aim::Area };
        let (light, rays) = self.renderer.light_at(pixel, sight, probe);
        #[cfg(feature = "looks")]
        if let Some(line) = &mut self.ink {
            let ink = line.ink(self.renderer, x);
            let light = self.renderer.inked(Light16::new(light), ink);
            let quantizer = Quantizer::new(&self.renderer.settings, x, self.y);
            return (C::from_light(light, &quantizer), rays.saturating_add(ink.rays));
        }
        (self.renderer.color(light, x, self.y), rays)
    }
}
