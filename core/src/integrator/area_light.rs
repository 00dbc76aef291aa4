//! The light of lamps with a size at a hit: by rays to several points of each, or in closed form.

use super::shaded_hit::{FacingLight, LampLight, ShadedHit};
use super::{AreaLights, Trace};
use crate::color::LinearRgb;
use crate::light::{AreaLight, LampPoint, SeenLamp};
use crate::limits::{AREA_RAYS, MAX_AREA_RAYS};
use crate::math::{Real, Vec3};
use crate::motion::Moved;
use crate::prepared::{Among, Through};
use crate::probe::{Cut, Event, Probe};
use crate::sampling::Dimension;
use crate::shape::Geometry;

impl<R: Real> ShadedHit<'_, R> {
    /// Diffuse light and highlights of all lamps with a size and of the sky, at a hit after so many bounces.
    pub(super) fn light_of_areas<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        bounces: u8,
    ) -> LinearRgb<R> {
        let mut light = LinearRgb::BLACK;
        #[cfg(feature = "looks")]
        if trace.limits.gooch.is_some() {
            return light;
        }
        if let Some(sky) = trace.scene.sky() {
            light = self.light_of_sky(trace, sky, bounces);
        }
        for area in trace.scene.areas() {
            // Balls and flat lamps do not light themselves.
            if area.object == self.hit.object {
                continue;
            }
            light = light
                + match trace.limits.area_lights {
                    AreaLights::Sampled => self.light_of(area, trace, bounces),
                    AreaLights::ClosedForm => self.closed_light_of(area, trace),
                };
        }
        light
    }

    /// The light of a lamp, by rays to its points. If all of the first rays or none of them reach the lamp,
    /// the place is in full light or in the umbra. If they disagree, in the penumbra, and the pixel has one
    /// sample, more rays follow.
    ///
    /// Rays that are added where the first ones disagree make the penumbra a little narrower (Kirk and Arvo,
    /// "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991). Where a pixel has several samples,
    /// none are added, and the mean of the samples is that of the lamp.
    fn light_of<S: Geometry, P: Probe<R>>(
        &self,
        area: &AreaLight<R>,
        trace: &mut Trace<'_, '_, R, S, P>,
        bounces: u8,
    ) -> LinearRgb<R> {
        let most = if trace.numbers.is_of_one_sample() { MAX_AREA_RAYS } else { AREA_RAYS };
        let moved = trace.scene.moved(area.object);
        let point = self.hit.surface.point;
        let mut sum = LampLight::NONE;
        let (mut reached, mut missed) = (0, 0);
        let mut share = R::from_f32(1.0 / f32::from(AREA_RAYS));
        for number in 0..most {
            if number == AREA_RAYS {
                if reached == 0 || missed == 0 {
                    break;
                }
                let known = R::from_f32(f32::from(AREA_RAYS) / f32::from(MAX_AREA_RAYS));
                (sum.diffuse, sum.specular) = (sum.diffuse.scaled(known), sum.specular.scaled(known));
                share = share * known;
            }
            let pair = trace.numbers.part(number, most).pair(Dimension::lamp(bounces, area.light));
            let point = lamp_point(area, moved.as_ref(), point, pair);
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

    /// The light of a lamp by formulas, and with one ray.
    fn closed_light_of<S: Geometry, P: Probe<R>>(
        &self,
        area: &AreaLight<R>,
        trace: &mut Trace<'_, '_, R, S, P>,
    ) -> LinearRgb<R> {
        let scene = trace.scene;
        let (moved, point) = (scene.moved(area.object), self.hit.surface.point);
        let seen = match &moved {
            None => area.seen_from(point, self.normal),
            Some(moved) => {
                let (point, normal) = (moved.point_back(point), moved.direction_back(self.normal));
                area.seen_from(point, normal).map(|seen| seen.turned(|direction| moved.direction(direction)))
            }
        };
        let Some(SeenLamp { cap, toward, distance, weight, cosine }) = seen else { return LinearRgb::BLACK };
        let Some(facing) = self.facing_from(toward, distance, cosine) else { return LinearRgb::BLACK };
        let mut sum = LampLight::NONE;
        if !trace.rays.spend() {
            trace.probe.record(Event::Cut(Cut::Rays));
            return LinearRgb::BLACK;
        }
        let ray = self.hit.spawn(toward, self.departure(toward, false));
        let mut through = scene.through_but_balls(&ray, distance, area.object);
        let left = scene.left_by_balls(&cap, point, [self.hit.object, area.object]);
        if !(left > R::ZERO) {
            through = Through::Nothing;
        } else if left < R::ONE && !matches!(through, Through::TooManyLayers) {
            through = Through::Some(through.throughput() * left);
        }
        self.receive(trace, &mut sum, (area.light, area.radiance.scaled(weight)), &facing, through);
        self.reflected_light(LinearRgb::BLACK, sum)
    }

    /// A point of a lamp that the surface faces and would show, and its weight.
    fn facing_point(&self, point: LampPoint<R>) -> Option<(FacingLight<R>, R)> {
        let LampPoint { toward, distance, weight } = point;
        Some((self.facing_from(toward, distance, self.normal.dot(toward))?, weight))
    }

    /// Light from a direction, with the cosine that its diffuse light has; `None` if the surface would not
    /// show it.
    pub(super) fn facing_from(&self, toward: Vec3<R>, distance: R, cosine: R) -> Option<FacingLight<R>> {
        if !(cosine > R::ZERO) {
            return None;
        }
        let shines = self.material.specular > R::ZERO;
        let highlight_cosine = if shines { self.highlight_cosine(toward) } else { None };
        if !(self.material.diffuse > R::ZERO) && highlight_cosine.is_none() {
            return None;
        }
        Some(FacingLight { toward, distance, cosine, highlight_cosine, share: None })
    }
}

/// A point of a lamp that a pair of numbers draws, as seen from a point; `None` if the lamp is not seen from
/// there. A lamp that moves is seen where it was described, from where the point then is.
pub(super) fn lamp_point<R: Real>(
    area: &AreaLight<R>,
    moved: Option<&Moved<R>>,
    point: Vec3<R>,
    pair: [u16; 2],
) -> Option<LampPoint<R>> {
    let Some(moved) = moved else { return area.point_seen_from(point, pair) };
    let seen = area.point_seen_from(moved.point_back(point), pair)?;
    Some(LampPoint { toward: moved.direction(seen.toward), ..seen })
}
