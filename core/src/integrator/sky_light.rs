//! The light of the sky at a hit: by rays into it, or in closed form.

use super::shaded_hit::ShadedHit;
use super::{AreaLights, Trace};
use crate::color::LinearRgb;
use crate::limits::{AREA_RAYS, MAX_AREA_RAYS};
use crate::math::Real;
use crate::prepared::Among;
use crate::probe::{Cut, Event, Probe};
use crate::sampling::{Dimension, hemisphere};
use crate::shape::Geometry;

impl<R: Real> ShadedHit<'_, R> {
    /// Diffuse light that comes from the sky, at a hit after so many bounces.
    pub(super) fn light_of_sky<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        light: usize,
        bounces: u8,
    ) -> LinearRgb<R> {
        if !(self.material.diffuse > R::ZERO) {
            return LinearRgb::BLACK;
        }
        let closed = match trace.limits.area_lights {
            AreaLights::ClosedForm => {
                let ground = trace.scene.ground(self.hit.surface.point, self.hit.object);
                trace.scene.background.light_on(self.normal, ground)
            }
            AreaLights::Sampled => None,
        };
        if let Some(sky) = closed {
            let left = trace.scene.sky_left(self.hit.surface.point, self.normal, self.hit.object);
            let shown = self.scattered(sky.scaled(left));
            trace.probe.record(Event::Surface { shown });
            return shown;
        }
        let count = if trace.numbers.is_of_one_sample() { MAX_AREA_RAYS } else { AREA_RAYS };
        let share = R::from_f32(1.0 / f32::from(count));
        let mut sum = LinearRgb::BLACK;
        for number in 0..count {
            if !trace.rays.spend() {
                trace.probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let pair = trace.numbers.part(number, count).pair(Dimension::sky(bounces));
            let toward = hemisphere(self.normal, pair);
            let ray = self.hit.spawn(toward, self.departure(toward, false));
            let through = trace.scene.light_through_among(&ray, R::FARTHEST, Among::All);
            trace.count_layers(&through);
            let throughput = through.throughput();
            let sky = trace.scene.background.color(toward).scaled(share);
            let shown = self.scattered(throughput.of(sky));
            trace.probe.record(Event::Light { light, toward, through: throughput.largest(), shown });
            sum = sum + shown;
        }
        sum
    }
}
