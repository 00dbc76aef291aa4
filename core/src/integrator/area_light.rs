//! The light of lamps with a size at a hit: rays to several points of each.

use super::Trace;
use super::shaded_hit::{FacingLight, LampLight, ShadedHit};
use crate::color::LinearRgb;
use crate::light::{AreaLight, LampPoint};
use crate::math::Real;
use crate::prepared::Among;
use crate::probe::{Cut, Event, Probe};
use crate::sampling::Dimension;
use crate::shape::Geometry;

/// The rays toward each lamp. If all of them or none reach it, it is in full light or in the umbra.
const FIRST: u16 = 4;
/// The rays toward each lamp if the first ones disagree and the pixel has one sample: in the penumbra.
///
/// Rays that are added where the first ones disagree make the penumbra a little narrower (Kirk and Arvo,
/// "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991). Where a pixel has several samples,
/// none are added, and the mean of the samples is that of the lamp.
const MOST: u16 = 16;

impl<R: Real> ShadedHit<'_, R> {
    /// Diffuse light and highlights of all lamps with a size, at a hit after so many bounces.
    pub(super) fn light_of_areas<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        bounces: u8,
    ) -> LinearRgb<R> {
        let mut light = LinearRgb::BLACK;
        for area in trace.scene.areas() {
            // Balls and flat lamps do not light themselves.
            if area.object != self.hit.object {
                light = light + self.light_of(area, trace, bounces);
            }
        }
        light
    }

    fn light_of<S: Geometry, P: Probe<R>>(
        &self,
        area: &AreaLight<R>,
        trace: &mut Trace<'_, '_, R, S, P>,
        bounces: u8,
    ) -> LinearRgb<R> {
        let most = if trace.numbers.is_of_one_sample() { MOST } else { FIRST };
        // A lamp that moves is seen where it was described, from where the surface then is.
        let moved = trace.scene.moved(area.object);
        let point = self.hit.surface.point;
        let seen_from = moved.as_ref().map_or(point, |moved| moved.point_back(point));
        let mut sum = LampLight::NONE;
        let (mut reached, mut missed) = (0, 0);
        let mut share = R::from_f32(1.0 / f32::from(FIRST));
        for number in 0..most {
            if number == FIRST {
                if reached == 0 || missed == 0 {
                    break;
                }
                let known = R::from_f32(f32::from(FIRST) / f32::from(MOST));
                (sum.diffuse, sum.specular) = (sum.diffuse.scaled(known), sum.specular.scaled(known));
                share = share * known;
            }
            let pair = trace.numbers.part(number, most).pair(Dimension::lamp(bounces, area.light));
            let point = area.point_seen_from(seen_from, pair);
            let point = point.map(|point| match &moved {
                Some(moved) => LampPoint { toward: moved.direction(point.toward), ..point },
                None => point,
            });
            let Some((facing, weight)) = point.and_then(|point| self.facing_point(point)) else {
                missed += 1;
                continue;
            };
            if !trace.rays.spend() {
                trace.probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let ray = self.hit.spawn(facing.toward, self.departure(facing.toward, false));
            let through = trace.scene.light_through_among(&ray, facing.distance, Among::All);
            let color = area.radiance.scaled(weight * share);
            let through = self.receive(trace, &mut sum, (area.light, color), &facing, through);
            if through.largest() < R::ONE {
                missed += 1;
            }
            if through.largest() > R::ZERO {
                reached += 1;
            }
        }
        self.reflected_light(LinearRgb::BLACK, sum)
    }

    /// A point of a lamp that the surface faces and would show, and its weight.
    fn facing_point(&self, point: LampPoint<R>) -> Option<(FacingLight<R>, R)> {
        let LampPoint { toward, distance, weight } = point;
        let cosine = self.normal.dot(toward);
        if !(cosine > R::ZERO) {
            return None;
        }
        let shines = self.material.specular > R::ZERO;
        let highlight_cosine = if shines { self.highlight_cosine(toward) } else { None };
        if !(self.material.diffuse > R::ZERO) && highlight_cosine.is_none() {
            return None;
        }
        Some((FacingLight { toward, distance, cosine, highlight_cosine, share: None }, weight))
    }
}
