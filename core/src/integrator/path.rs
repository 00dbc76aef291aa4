//! The rays of one sample, one after the other.

use heapless::Vec;

#[cfg(feature = "path-tracing")]
use super::Integrator;
use super::Trace;
use super::pending_ray::PendingRay;
use super::shaded_hit::{ShadedHit, ShadowRays};
use super::shadow_rays::Blockers;
use crate::color::LinearRgb;
use crate::limits::MAX_BOUNCES;
use crate::material::{MapRoom, PreparedMaterial, Shares};
use crate::math::{Ray, Real};
use crate::prepared::{Departure, Hit, ObjectSet};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::shape::Geometry;
use crate::surface::Surface;
use crate::throughput::Throughput;

/// The stack of rays that wait.
pub(super) type Waiting<R> = Vec<PendingRay<R>, { MAX_BOUNCES as usize }>;

/// The ray at hand, and the light of all rays before it.
#[derive(Clone, Copy, Debug)]
#[repr(C)] // As `PendingRay`.
pub(super) struct Path<R> {
    pub(super) next: PendingRay<R>,
    pub(super) light: LinearRgb<R>,
}

impl<R: Real> Path<R> {
    /// Begins with a camera ray that can meet these objects.
    // Forced, as in the rest of this file: without it, `classic` takes an M4F 1.10 times the instructions.
    #[inline(always)]
    pub(super) fn new(ray: Ray<R>, among: ObjectSet) -> Self {
        let next = PendingRay {
            ray,
            throughput: Throughput::even(R::ONE),
            bounces: 0,
            kind: RayKind::Camera,
            from: Departure::NONE,
            among,
        };
        Self { light: LinearRgb::BLACK, next }
    }

    /// Follows the ray at hand and the waiting ones until none is left, or the budget of rays is spent.
    /// `blockers` are known for the ray at hand only.
    // In a build with groups there are two callers, and one copy of the code is enough.
    #[cfg_attr(not(feature = "hierarchy"), inline(always))]
    pub(super) fn finish<S: Geometry, P: Probe<R>>(
        &mut self,
        trace: &mut Trace<'_, '_, R, S, P>,
        mut blockers: &Blockers,
        waiting: &mut Waiting<R>,
    ) {
        let mut hit = Hit::BLANK;
        while self.spend(trace) {
            let PendingRay { ray, from, among, .. } = &self.next;
            let closest = trace.scene.closest_from(ray, *from, *among);
            let met = trace.scene.write_hit(ray, closest, &mut hit).map(|material| (&hit, material));
            if !self.arrive(trace, met, &mut blockers, waiting) {
                break;
            }
            self.keep_unit();
            // The blockers are valid for the first ray alone.
            blockers = &Blockers::UNKNOWN;
        }
        waiting.clear();
    }

    /// Spends one ray of the budget on the ray at hand; `false` if none is left.
    #[inline(always)]
    pub(super) fn spend<S: Geometry, P: Probe<R>>(&mut self, trace: &mut Trace<'_, '_, R, S, P>) -> bool {
        if !trace.rays.spend() {
            trace.probe.record(Event::Cut(Cut::Rays));
            return false;
        }
        let PendingRay { ray, throughput, bounces, kind, .. } = self.next;
        trace.probe.record(Event::Ray { kind, ray, bounces, throughput: throughput.largest() });
        true
    }

    /// Adds the light from where the ray at hand ends, at a hit or at the background, and takes the next ray;
    /// `false` if none is left.
    #[inline(always)]
    pub(super) fn arrive<S: Geometry, P: Probe<R>>(
        &mut self,
        trace: &mut Trace<'_, '_, R, S, P>,
        met: Option<(&Hit<R>, &PreparedMaterial<'_, R>)>,
        shadow_rays: &mut impl ShadowRays<R>,
        waiting: &mut Waiting<R>,
    ) -> bool {
        let PendingRay { ray, throughput, kind, from, .. } = self.next;
        let (scene, is_reflected) = (trace.scene, kind == RayKind::Reflected);
        let Some((hit, mut material)) = met else {
            let color = scene.background.color(ray.direction);
            trace.seen.miss();
            let throughput = scene.dimmed(throughput, from, is_reflected, None);
            trace.probe.record(Event::Miss { ray, color, throughput: throughput.color() });
            self.receive(throughput, color);
            return take(waiting, &mut self.next);
        };
        let throughput = scene.dimmed(throughput, from, is_reflected, Some(hit.t));
        let (mapped, mut room_of_maps);
        let mut normal = hit.surface.shading_normal;
        let mut room = None;
        let still = scene.still(hit.object, &hit.surface, &mut room);
        if !material.maps.is_empty() {
            let uv = |surface: &Surface<R>| scene.uv(hit.object, surface);
            room_of_maps = MapRoom::EMPTY;
            mapped = material.mapped(still, uv, &mut room_of_maps);
            normal = scene.bumped(hit.object, still, ray.direction, material);
            material = &mapped;
        }
        trace.seen.hit(hit);
        let color = material.color.color(still, || scene.uv(hit.object, still));
        // Left out by an attribute: dead code here made the program for an ATmega2560 larger.
        #[cfg(feature = "textures")]
        let color = if scene.is_tinted(hit.object) { scene.tint(hit.object, still) * color } else { color };
        let shaded = ShadedHit::new(&ray, (hit, color), normal, material, trace.probe.is_enabled());
        trace.probe.record(shaded.event(&ray, (kind, throughput), normal));
        shadow_rays.begin_at(hit.object);
        #[cfg(feature = "path-tracing")]
        if trace.limits.integrator == Integrator::PathTracing {
            return self.scatter(trace, &shaded, throughput, shadow_rays);
        }
        #[cfg(not(feature = "looks"))]
        let light = shaded.local_light(trace, shadow_rays);
        #[cfg(feature = "looks")]
        let light = shaded.light_or_tone(trace, shadow_rays);
        #[cfg(feature = "distributed")]
        let light = if trace.scene.has_wide_lights() {
            light + shaded.light_of_areas(trace, self.next.bounces)
        } else {
            light
        };
        self.receive(throughput, light);
        if material.sends_rays() {
            self.branch(trace, &shaded, throughput, waiting)
        } else {
            take(waiting, &mut self.next)
        }
    }

    /// Keeps the direction of a ray that goes on a unit vector: acceleration relies on it. A mirror adds as
    /// much as four times the error of its normal's length, and glass multiplies the error.
    #[inline]
    pub(super) fn keep_unit(&mut self) {
        self.next.ray.direction = self.next.ray.direction.unit_again();
    }

    /// Adds a share of the light from where the ray at hand ends.
    #[inline(always)]
    pub(super) fn receive(&mut self, throughput: Throughput<R>, light: LinearRgb<R>) {
        // All of a camera ray's light reaches the pixel. In floating point a product takes no longer than
        // this test.
        let is_first = R::IS_FIXED_POINT && self.next.kind == RayKind::Camera;
        self.light = if is_first { light } else { self.light + throughput.of(light) };
    }

    /// Takes the reflected ray of a hit next and lets the refracted one wait; `false` if no ray is left.
    #[inline(always)]
    fn branch<S: Geometry, P: Probe<R>>(
        &mut self,
        trace: &mut Trace<'_, '_, R, S, P>,
        shaded: &ShadedHit<'_, R>,
        throughput: Throughput<R>,
        waiting: &mut Waiting<R>,
    ) -> bool {
        let bounces = self.next.bounces;
        let (Shares { mirrored, refracted }, direction) = shaded.shares();
        let reflected = followed(trace, throughput * mirrored, bounces);
        if let Some(direction) = direction
            && let Some(throughput) = followed(trace, throughput * refracted, bounces)
        {
            let direction = shaded.spread_refracted(direction, &trace.numbers, bounces);
            let ray = shaded.leave(trace.scene, direction, throughput, bounces, RayKind::Refracted);
            // There is always a place, as the module explains.
            if waiting.push(ray).is_err() {
                trace.probe.record(Event::Cut(Cut::Bounces));
            }
        }
        match reflected {
            Some(throughput) => {
                let direction = shaded.spread_mirrored(trace.scene, &trace.numbers, bounces);
                self.next = shaded.leave(trace.scene, direction, throughput, bounces, RayKind::Reflected);
                true
            }
            None => take(waiting, &mut self.next),
        }
    }
}

/// The throughput of a ray after `bounces`, or `None` if the ray is not to be followed.
#[inline(always)]
fn followed<R: Real, S: Geometry, P: Probe<R>>(
    trace: &mut Trace<'_, '_, R, S, P>,
    throughput: Throughput<R>,
    bounces: u8,
) -> Option<Throughput<R>> {
    let largest = throughput.largest();
    if !(largest > R::ZERO) {
        return None;
    }
    if bounces >= trace.limits.bounces {
        trace.probe.record(Event::Cut(Cut::Bounces));
        return None;
    }
    if largest < trace.limits.cutoff {
        trace.probe.record(Event::Cut(Cut::Throughput));
        return None;
    }
    Some(throughput)
}

/// Takes the ray that waited last; `false` if there is none. Not by an `Option`, which would be copied byte
/// by byte.
#[inline(always)]
fn take<R: Real>(waiting: &mut Waiting<R>, next: &mut PendingRay<R>) -> bool {
    let Some(last) = waiting.last() else { return false };
    *next = *last;
    waiting.truncate(waiting.len().saturating_sub(1));
    true
}
