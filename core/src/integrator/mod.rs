//! How much light comes along a ray: Whitted's recursion, without recursion.
//!
//! A hit may ask for two more rays, a mirrored and a refracted one. The mirrored ray is traced next and the
//! refracted one waits on a stack. A waiting ray is always followed by rays of one bounce more, so at most one
//! ray waits per bounce and [`MAX_BOUNCES`] places are enough. The order of rays, and so of additions, is fixed.

mod stream;
mod vertex;

pub(crate) use stream::{Lane, Lanes, Stream, WIDTH};

use core::borrow::Borrow;

use heapless::Vec;

use crate::color::LinearRgb;
use crate::limits::MAX_BOUNCES;
use crate::material::{PreparedMaterial, Shares};
use crate::math::{Ray, Real};
use crate::prepared::candidates::{Departure, ObjectSet};
use crate::prepared::{Hit, PreparedScene};
use crate::probe::{Cut, Event, Probe, RayKind};
use crate::shape::Geometry;
use crate::share::Share;
use crate::surface::Surface;
use vertex::{Shading, Vertex};

/// When rays are no longer followed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds<R> {
    /// Rays of more bounces than this are left out.
    pub(crate) bounces: u8,
    /// Rays that bring a smaller share of their light than this are left out.
    pub(crate) cutoff: R,
}

/// What is known of a camera ray before it is traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sight<'k> {
    /// The objects that it can meet, where the scene has sets of them.
    pub(crate) among: ObjectSet,
    /// What can shade what it meets.
    pub(crate) shades: &'k Shades,
}

impl Sight<'_> {
    /// It can meet these objects, and no more is known.
    pub(crate) const fn among(among: ObjectSet) -> Self {
        Self { among, shades: &Shades::UNKNOWN }
    }
}

/// What can stand between a place of one object and the lights, in a scene that has no more than [`LIGHTS`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shades {
    /// Position of the object.
    pub(crate) receiver: usize,
    pub(crate) among: [ObjectSet; LIGHTS],
}

impl Shades {
    /// Those of no object.
    pub(crate) const UNKNOWN: Self = Self { receiver: usize::MAX, among: [ObjectSet::ALL; LIGHTS] };

    /// What can stand before a light.
    #[inline(always)]
    fn before(&self, light: usize) -> ObjectSet {
        // Where there are more lights, all sets are the same.
        self.among.get(light % LIGHTS).copied().unwrap_or(ObjectSet::ALL)
    }
}

/// Of how many lights [`Shades`] are known.
pub(crate) const LIGHTS: usize = 4;

/// The rays that one pixel may still spend.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayBudget(pub(crate) u32);

impl RayBudget {
    /// Takes one ray, if there is one.
    fn spend(&mut self) -> bool {
        match self.0.checked_sub(1) {
            Some(left) => {
                self.0 = left;
                true
            }
            None => false,
        }
    }
}

/// A ray that is still to be traced.
#[derive(Clone, Copy, Debug)]
// In this order: where a copy takes along what stands beside a field that was just written, processors wait for it to reach memory.
#[repr(C)]
struct PendingRay<R> {
    ray: Ray<R>,
    /// Share of its light that reaches the pixel, in each channel.
    throughput: Share<R>,
    bounces: u8,
    kind: RayKind,
    /// The surface that it leaves; of a camera ray, none.
    from: Departure,
    /// The objects that it can meet, where the scene has sets of them.
    among: ObjectSet,
}

/// The light that comes to the origin of a camera ray from where it points.
#[inline(always)]
pub(crate) fn radiance<R: Real, S: Geometry>(
    scene: &PreparedScene<'_, R, S>,
    ray: Ray<R>,
    sight: Sight<'_>,
    bounds: &Bounds<R>,
    rays: &mut RayBudget,
    probe: &mut impl Probe<R>,
) -> LinearRgb<R> {
    let mut path = Path::new(ray, sight.among);
    path.end(scene, sight.shades, &mut Waiting::new(), bounds, rays, probe);
    path.light
}

/// The rays that wait.
type Waiting<R> = Vec<PendingRay<R>, { MAX_BOUNCES as usize }>;

/// The rays of one pixel but those that wait: those behind, as light, and the one at hand.
#[derive(Clone, Copy, Debug)]
#[repr(C)] // As `PendingRay`.
struct Path<R> {
    next: PendingRay<R>,
    light: LinearRgb<R>,
}

impl<R: Real> Path<R> {
    #[inline(always)]
    fn new(ray: Ray<R>, among: ObjectSet) -> Self {
        let next = PendingRay {
            ray,
            throughput: Share::even(R::ONE),
            bounces: 0,
            kind: RayKind::Camera,
            from: Departure::NONE,
            among,
        };
        Self { light: LinearRgb::BLACK, next }
    }

    /// Whether there is a ray left to be spent; spends it.
    #[inline(always)]
    fn goes_on(&mut self, rays: &mut RayBudget, probe: &mut impl Probe<R>) -> bool {
        if !rays.spend() {
            probe.record(Event::Cut(Cut::Rays));
            return false;
        }
        let PendingRay { ray, throughput, bounces, kind, .. } = self.next;
        probe.record(Event::Ray { kind, ray, bounces, throughput: throughput.largest() });
        true
    }

    /// Adds this share of light from where the ray at hand ends; all of it reaches the eye by the camera ray, before which nothing was there.
    #[inline(always)]
    fn receive(&mut self, throughput: Share<R>, light: LinearRgb<R>) {
        let is_first = R::IS_FIXED_POINT && self.next.kind == RayKind::Camera;
        self.light = if is_first { light } else { self.light + throughput.of(light) };
    }

    /// Follows the ray at hand, and those that wait, to their end: all of them, or as far as rays are left.
    // Where groups call it as well, one copy is enough.
    #[cfg_attr(not(feature = "hierarchy"), inline(always))]
    fn end<S: Geometry>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        mut shades: &Shades,
        waiting: &mut Waiting<R>,
        bounds: &Bounds<R>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) {
        // Counted here, and told at the end.
        let mut left = *rays;
        while self.goes_on(&mut left, probe) {
            // Those are of a camera ray: of what it leads to, nothing is known.
            let mut shades = core::mem::replace(&mut shades, &Shades::UNKNOWN);
            let find = |next: &PendingRay<R>| scene.closest_hit_from(&next.ray, next.from, next.among);
            if !self.follow(scene, find, &mut shades, waiting, bounds, &mut left, probe) {
                break;
            }
        }
        *rays = left;
        waiting.clear();
    }

    /// Adds the light from where the ray at hand ends, which `find` tells, and goes on to the next ray; `false` where there is none.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "in a struct they would be stored and loaded for each ray")]
    fn follow<'s, S: Geometry, H: Borrow<Hit<R>>>(
        &mut self,
        scene: &PreparedScene<'_, R, S>,
        find: impl FnOnce(&PendingRay<R>) -> Option<(H, &'s PreparedMaterial<'s, R>)>,
        shading: &mut impl Shading<R>,
        waiting: &mut Waiting<R>,
        bounds: &Bounds<R>,
        rays: &mut RayBudget,
        probe: &mut impl Probe<R>,
    ) -> bool {
        let PendingRay { ray, throughput, bounces, kind, from, .. } = self.next;
        let Some((hit, mut material)) = find(&self.next) else {
            let color = scene.background.color(ray.direction);
            let throughput = scene.dimmed(throughput, from, kind == RayKind::Reflected, None);
            probe.record(Event::Miss { ray, color, throughput: throughput.color() });
            self.receive(throughput, color);
            return take(waiting, &mut self.next);
        };
        let hit = hit.borrow();
        let throughput = scene.dimmed(throughput, from, kind == RayKind::Reflected, Some(hit.t));
        let mapped;
        let mut normal = hit.surface.shading_normal;
        if !material.maps.is_empty() {
            let uv = |surface: &Surface<R>| scene.uv(hit.object, surface);
            mapped = material.mapped(&hit.surface, uv);
            normal = material.maps.bumped(&hit.surface, ray.direction, uv);
            material = &mapped;
        }
        let vertex = Vertex::new(scene, &ray, hit, normal, material, (kind, throughput), probe);
        shading.begin_at(vertex.hit.object);
        let light = vertex.local_light(scene, shading, rays, probe);
        self.receive(throughput, light);

        if !material.sends_rays() {
            return take(waiting, &mut self.next);
        }
        // What is left of the throughput for a ray with this share of it; 0 where it is not to be followed.
        let mut followed = |share: Share<R>| {
            if R::IS_FIXED_POINT && !(share.largest() > R::ZERO) {
                return None;
            }
            let throughput = throughput * share;
            let largest = throughput.largest();
            if !(largest > R::ZERO) {
                return None;
            }
            if bounces >= bounds.bounces {
                probe.record(Event::Cut(Cut::Bounces));
                return None;
            }
            if largest < bounds.cutoff {
                probe.record(Event::Cut(Cut::Throughput));
                return None;
            }
            Some(throughput)
        };
        let (Shares { mirrored, refracted }, direction) = vertex.shares();
        let mirrors = followed(mirrored);
        if let Some(direction) = direction
            && let Some(throughput) = followed(refracted)
            // There is always room, as shown above.
            && waiting.push(vertex.leave(scene, direction, throughput, bounces, RayKind::Refracted)).is_err()
        {
            probe.record(Event::Cut(Cut::Bounces));
        }
        if let Some(mirrors) = mirrors {
            self.next = vertex.leave(scene, vertex.mirrored, mirrors, bounces, RayKind::Reflected);
            return true;
        }
        take(waiting, &mut self.next)
    }
}

/// Takes the last ray that waits, if there is one. Without an `Option` of it, which would be copied byte by byte.
#[inline(always)]
fn take<R: Real>(waiting: &mut Waiting<R>, next: &mut PendingRay<R>) -> bool {
    let Some(last) = waiting.last() else { return false };
    *next = *last;
    waiting.truncate(waiting.len().saturating_sub(1));
    true
}
