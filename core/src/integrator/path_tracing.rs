//! Path tracing: light that surfaces scatter onto other surfaces (Kajiya, "The Rendering Equation", 1986).
//!
//! Whitted's ray tracing follows mirrored and refracted rays; all other light that does not come straight
//! from a lamp is a constant, the ambient light. A path follows scattered light, too:
//!
//! 1. At each hit it finds the light of the lamps: one shadow ray for each lamp, also for one with a size.
//! 2. It goes on in one direction alone, scattered, mirrored or refracted, which a number of the sample
//!    chooses ([`Ways`]). A way is chosen as often as its share of the light says, and its light is divided
//!    by this probability, so that the mean over many samples is the sum of all ways.
//! 3. After [`SURE_BOUNCES`] a path ends by chance, the sooner the less light it would bring, and counts the
//!    more if it goes on (Russian roulette: Arvo and Kirk, "Particle Transport and Image Synthesis", 1990).
//!
//! A scattered ray may find a lamp that a shadow ray found as well. Each then counts by the power heuristic
//! (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering", 1995): by the
//! square of the density with which it is drawn, over the sum of both squares. Shadow rays are good for small
//! lamps, scattered rays for large and close ones. Glossy rays are weighed in the same way, in floating
//! point; the densities of narrow lobes are beyond the range of fixed point, so that there the rays of a lobe
//! alone find lamps for it.
//!
//! Rays to lamps with a size do not pass glass: the light behind it comes by paths that refract, as a
//! caustic. A lamp without a size cannot be met by a path, so its light still goes straight through glass.

use super::Trace;
use super::area_light::lamp_point;
use super::path::Path;
use super::shaded_hit::{LampLight, ShadedHit, ShadowRays};
use crate::color::LinearRgb;
use crate::light::{AreaLight, LampPoint};
use crate::material::Shares;
use crate::math::{Ray, Real, Vec3};
use crate::prepared::{Among, Hit, Through};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::sampling::{Dimension, hemisphere};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// The bounces after which a path may end by chance.
const SURE_BOUNCES: u8 = 3;
/// The largest share of light in fixed point, whose products of shares have 16 digits. A share is above 1
/// where a surface sends light of different colors into several ways.
const MOST_IN_FIXED_POINT: f32 = 1.99;

/// The ways on which a path can go on from a hit. The path ends with the rest of their chances.
struct Ways<R> {
    scattered: Way<R>,
    mirrored: Way<R>,
    refracted: Way<R>,
    /// The direction of the refracted way.
    behind: Option<Vec3<R>>,
    /// The share of light that the surface mirrors.
    mirrored_share: Throughput<R>,
}

/// One way of a path.
struct Way<R> {
    /// The throughput of a ray that goes this way as one of several.
    throughput: Throughput<R>,
    /// The probability that the path goes this way.
    chance: R,
}

impl<R: Real> Path<R> {
    /// Adds the light that leaves a hit along the ray at hand, and goes on in one direction; `false` if the
    /// path ends here.
    pub(super) fn scatter<S: Geometry, P: Probe<R>>(
        &mut self,
        trace: &mut Trace<'_, '_, R, S, P>,
        shaded: &ShadedHit<'_, R>,
        throughput: Throughput<R>,
        shadow_rays: &mut impl ShadowRays<R>,
    ) -> bool {
        let bounces = self.next.bounces;
        let emitted = shaded.emission().scaled(share_of_ray(trace, &self.next.ray, shaded.hit));
        trace.probe.record(Event::Surface { shown: emitted });
        let ways = Ways::new(trace, shaded, throughput, bounces);
        let light = shaded.lamp_light(emitted, trace, shadow_rays);
        self.receive(throughput, light + shaded.light_of_sized_lamps(trace, &ways, bounces));
        let [scattered, mirrored, refracted] = [&ways.scattered, &ways.mirrored, &ways.refracted];
        let [high, low] = trace.numbers.pair(Dimension::way(bounces));
        let number = R::from_fraction(high) + R::from_fraction(low) * R::from_fraction(1);
        let (kind, way, direction, density) = if number < scattered.chance {
            let direction = hemisphere(shaded.normal, trace.numbers.pair(Dimension::scattered(bounces)));
            (RayKind::Scattered, scattered, direction, Some(scattered.chance * shaded.normal.dot(direction)))
        } else if number < scattered.chance + mirrored.chance {
            let direction = shaded.spread_mirrored(trace.scene, &trace.numbers, bounces);
            let density = shaded.gloss_density(trace.scene, direction);
            (RayKind::Reflected, mirrored, direction, density.map(|density| density * mirrored.chance))
        } else if let Some(behind) = ways.behind
            && number < scattered.chance + mirrored.chance + refracted.chance
        {
            let direction = shaded.spread_refracted(behind, &trace.numbers, bounces);
            (RayKind::Refracted, refracted, direction, None)
        } else {
            return false;
        };
        // Where the normal to shade with is bent, a scattered ray may point into the body, which is dark.
        if kind == RayKind::Scattered && shaded.is_behind(direction) {
            return false;
        }
        trace.drawn = density;
        self.next = shaded.leave(trace.scene, direction, way.alone(), bounces, kind);
        true
    }
}

impl<R: Real> Ways<R> {
    /// The ways from a hit, for a path with this throughput.
    fn new<S: Geometry, P: Probe<R>>(
        trace: &mut Trace<'_, '_, R, S, P>,
        shaded: &ShadedHit<'_, R>,
        throughput: Throughput<R>,
        bounces: u8,
    ) -> Self {
        let (Shares { mirrored: mirrored_share, refracted }, behind) = shaded.shares();
        let refracted = if behind.is_some() { refracted } else { Throughput::even(R::ZERO) };
        let throughputs = [shaded.scattering(), mirrored_share, refracted].map(|share| throughput * share);
        let largest = throughputs.map(Throughput::largest);
        let [scattered, mirrored, refracted] = largest;
        let sum = scattered + mirrored + refracted;
        let mut chances = [R::ZERO; 3];
        if bounces >= trace.limits.bounces {
            if sum > R::ZERO {
                trace.probe.record(Event::Cut(Cut::Bounces));
            }
        } else if sum > R::ZERO {
            let whole = if bounces < SURE_BOUNCES { sum } else { sum.larger(R::ONE) };
            chances = largest.map(|way| way / whole);
        }
        let ([scattered, mirrored, refracted], [of_scattered, of_mirrored, of_refracted]) =
            (throughputs, chances);
        Self {
            scattered: Way { throughput: scattered, chance: of_scattered },
            mirrored: Way { throughput: mirrored, chance: of_mirrored },
            refracted: Way { throughput: refracted, chance: of_refracted },
            behind,
            mirrored_share,
        }
    }
}

impl<R: Real> Way<R> {
    /// The throughput of a ray that goes this way alone, and stands for those that would go the other ways.
    fn alone(&self) -> Throughput<R> {
        let LinearRgb { r, g, b } = self.throughput.color();
        let whole = |share: R| {
            let share = share / self.chance;
            if R::IS_FIXED_POINT { share.smaller(R::from_f32(MOST_IN_FIXED_POINT)) } else { share }
        };
        Throughput::colored(LinearRgb::new(whole(r), whole(g), whole(b)))
    }
}

impl<R: Real> ShadedHit<'_, R> {
    /// Diffuse light, highlights and gloss of all lamps with a size, by one ray for each, less what the next
    /// ray of the path is better at finding.
    fn light_of_sized_lamps<S: Geometry, P: Probe<R>>(
        &self,
        trace: &mut Trace<'_, '_, R, S, P>,
        ways: &Ways<R>,
        bounces: u8,
    ) -> LinearRgb<R> {
        let mut light = LinearRgb::BLACK;
        for area in trace.scene.areas() {
            // Balls and flat lamps do not light themselves.
            if area.object == self.hit.object {
                continue;
            }
            let moved = trace.scene.moved(area.object);
            let pair = trace.numbers.pair(Dimension::lamp(bounces, area.light));
            let Some(point) = lamp_point(area, moved.as_ref(), self.hit.surface.point, pair) else {
                continue;
            };
            let cosine = self.normal.dot(point.toward);
            if !(cosine > R::ZERO) {
                continue;
            }
            let Some(shown) = self.light_of_point(trace, (area, &point), cosine, ways) else { continue };
            if !trace.rays.spend() {
                trace.probe.record(Event::Cut(Cut::Rays));
                break;
            }
            let ray = self.hit.spawn(point.toward, self.departure(point.toward, false));
            let is_free =
                matches!(trace.scene.light_through_among(&ray, point.distance, Among::All), Through::All);
            let (through, shown) = if is_free { (R::ONE, shown) } else { (R::ZERO, LinearRgb::BLACK) };
            if !is_free {
                trace.seen.shadow(area.light);
            }
            trace.probe.record(Event::Light { light: area.light, toward: point.toward, through, shown });
            light = light + shown;
        }
        light
    }

    /// The light of one point of a lamp if nothing is in the way; `None` if the surface would not show it.
    fn light_of_point<S: Geometry, P: Probe<R>>(
        &self,
        trace: &Trace<'_, '_, R, S, P>,
        (area, point): (&AreaLight<R>, &LampPoint<R>),
        cosine: R,
        ways: &Ways<R>,
    ) -> Option<LinearRgb<R>> {
        let color = area.radiance.scaled(point.weight);
        let mut light = None;
        if let Some(facing) = self.facing_from(point.toward, point.distance, cosine) {
            let mut sum = LampLight::NONE;
            sum.add(&facing, self.material, color, Throughput::even(R::ONE));
            sum.diffuse = sum.diffuse.scaled(share_of_lamp(ways.scattered.chance * cosine, point.weight));
            light = Some(self.reflected_light(LinearRgb::BLACK, sum));
        }
        if let Some(density) = self.gloss_density(trace.scene, point.toward) {
            let share = density * share_of_lamp(density * ways.mirrored.chance, point.weight);
            light = Some(light.unwrap_or(LinearRgb::BLACK) + ways.mirrored_share.of(color.scaled(share)));
        }
        light
    }
}

/// The share of a lamp's light at the end of a ray that the ray brings; shadow rays bring the rest.
fn share_of_ray<R: Real, S: Geometry, P: Probe<R>>(
    trace: &Trace<'_, '_, R, S, P>,
    ray: &Ray<R>,
    hit: &Hit<R>,
) -> R {
    let Some(density) = trace.drawn else { return R::ONE };
    let Some(area) = trace.scene.areas().iter().find(|area| area.object == hit.object) else { return R::ONE };
    let moved = trace.scene.moved(area.object);
    let [from, to] = [ray.origin, hit.surface.point]
        .map(|point| moved.as_ref().map_or(point, |moved| moved.point_back(point)));
    area.weight_between(from, to).map_or(R::ONE, |weight| R::ONE - share_of_lamp(density, weight))
}

/// The share of a lamp's light that shadow rays bring, by the power heuristic. `density` is π times the
/// density of the other ray's direction. `weight` is the weight of the lamp's point, the inverse of π times
/// the density of that point.
fn share_of_lamp<R: Real>(density: R, weight: R) -> R {
    let ratio = density * weight;
    // Without the square of a number above 1, which may be beyond the range of fixed point.
    if ratio > R::ONE {
        let inverse = R::ONE / ratio;
        let square = inverse * inverse;
        square / (R::ONE + square)
    } else {
        R::ONE / (R::ONE + ratio * ratio)
    }
}
