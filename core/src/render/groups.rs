//! One line of the picture, group after group of pixels that are traced side by side.

use super::{DisplayColor, Light16, Quantizer, Renderer, Settings};
use crate::integrator::{RayBudget, Stream, WIDTH};
use crate::math::Real;
use crate::probe::Probe;
use crate::sampler::sample_position;
use crate::shape::Geometry;

/// Renders lines in groups of pixels.
pub(super) struct Groups<'r, 'p, 'm, R: Real, S: Geometry + 'm> {
    renderer: &'r Renderer<'p, 'm, R, S>,
    stream: Stream<'p, 'm, R, S>,
}

impl<'r, 'p, 'm, R: Real, S: Geometry + 'm> Groups<'r, 'p, 'm, R, S> {
    /// `None` where nothing would be gained, or the probe would mind.
    #[inline(always)]
    pub(super) fn new(renderer: &'r Renderer<'p, 'm, R, S>, probe: &impl Probe<R>) -> Option<Self> {
        if probe.minds_order() || renderer.settings.samples_per_pixel > 1 {
            return None;
        }
        Some(Self { renderer, stream: Stream::new(renderer.scene)? })
    }

    /// Renders line `y`.
    pub(super) fn line<C: DisplayColor>(&self, y: u16, line: &mut [C], probe: &mut impl Probe<R>) {
        let Renderer { settings, viewport, bounds, .. } = self.renderer;
        let Settings { seed, rays_per_pixel, .. } = *settings;
        let mut first: u16 = 0;
        for group in line.chunks_mut(WIDTH) {
            let columns = first..first.saturating_add(group.len() as u16);
            let rays = columns.clone().map(|x| {
                let (right, down) = sample_position(x, y, 0, 1, seed);
                viewport.ray((x, right), (y, down))
            });
            self.stream.radiance(rays, bounds, RayBudget(rays_per_pixel), probe, |index, light| {
                if let Some(pixel) = group.get_mut(index) {
                    let quantizer = Quantizer::new(settings, first.saturating_add(index as u16), y);
                    *pixel = C::from_light(Light16::new(light), &quantizer);
                }
            });
            first = columns.end;
        }
    }
}
