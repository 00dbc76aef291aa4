//! One line of the picture, pixel after pixel.

use super::line_candidates::LineCandidates;
use super::{DisplayColor, Dither, Light16, Quantizer, Renderer};
use crate::integrator::Sight;
use crate::math::Real;
use crate::probe::Probe;
use crate::shape::Geometry;

/// Renders the pixels of one line, from left to right.
pub(super) struct LinePainter<'r, 'p, 'm, R: Real, S: Geometry + 'm, C> {
    renderer: &'r Renderer<'p, 'm, R, S>,
    y: u16,
    candidates: Option<LineCandidates<'r>>,
    /// The display's color of a pixel that sees nothing, where all such pixels have the same.
    background: Option<C>,
}

impl<'r, 'p, 'm, R: Real, S: Geometry + 'm, C: DisplayColor> LinePainter<'r, 'p, 'm, R, S, C> {
    pub(super) fn new(renderer: &'r Renderer<'p, 'm, R, S>, y: u16) -> Self {
        let settings = &renderer.settings;
        let candidates = LineCandidates::new(&renderer.outlines, y);
        let background = match renderer.scene.background.solid() {
            Some(color) if settings.dither == Dither::None && settings.samples_per_pixel == 1 => {
                Some(C::from_light(Light16::new(color), &Quantizer::new(settings, 0, y)))
            }
            _ => None,
        };
        Self { renderer, y, candidates, background }
    }

    /// Pixel `x` in the display's color, and the rays that it took. `x` must not decrease.
    #[inline(always)]
    pub(super) fn pixel(&mut self, x: u16, probe: &mut impl Probe<R>) -> (C, u32) {
        let unknown = Sight::UNKNOWN;
        let sight = self.candidates.as_mut().map_or(unknown, |candidates| candidates.at(x));
        if let (Some(among), Some(background)) = (sight.among, self.background)
            && among.is_empty()
            && !probe.is_watching()
        {
            return (background, 1);
        }
        let (light, rays) = self.renderer.light_at(x, self.y, sight, probe);
        (C::from_light(Light16::new(light), &Quantizer::new(&self.renderer.settings, x, self.y)), rays)
    }
}
