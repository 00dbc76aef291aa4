//! How much light gets through between two points.

use super::candidates::BoundingBall;
use super::closest::NO_OBJECT;
use super::{Among, Departure, ObjectSet, PreparedScene};
use crate::color::LinearRgb;
use crate::light::Source;
use crate::limits::MAX_SHADOW_LAYERS;
use crate::material::{MapRoom, PreparedOptics};
use crate::math::{Interval, Ray, Real, Vec3};
use crate::shape::Geometry;
use crate::throughput::Throughput;

/// How much light gets through between a point and a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Through<S> {
    /// All of it: nothing is in the way.
    All,
    /// None of it: something opaque is in the way.
    Nothing,
    /// A share of it: only transparent surfaces are in the way.
    Some(S),
    /// None of it: more than [`MAX_SHADOW_LAYERS`] layers are in the way. A layer is one surface that lets
    /// light through: a glass ball has two, where the ray goes in and where it comes out.
    TooManyLayers,
}

impl<R: Real> Through<Throughput<R>> {
    /// The share of the light that gets through.
    #[inline]
    pub(crate) fn throughput(self) -> Throughput<R> {
        match self {
            Self::All => Throughput::even(R::ONE),
            Self::Nothing | Self::TooManyLayers => Throughput::even(R::ZERO),
            Self::Some(share) => share,
        }
    }
}

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    /// The share of light that gets through from a light at `distance` along `ray`.
    ///
    /// Each surface in between multiplies the light by its transmittance and its transmission color, and each
    /// body by what it absorbs on the way. What lies behind the light has no effect.
    pub fn light_through(&self, ray: &Ray<R>, distance: R) -> Through<LinearRgb<R>> {
        match self.light_through_among(ray, distance, Among::All) {
            Through::All => Through::All,
            Through::Nothing => Through::Nothing,
            Through::Some(share) => Through::Some(share.color()),
            Through::TooManyLayers => Through::TooManyLayers,
        }
    }

    /// [`light_through`](Self::light_through) for a ray that can only meet `among`.
    // Forced, as in the rest of this file: without it, a flake of 91 balls takes an M4F 1.04 times the
    // instructions, and `whitted` an M3 1.02 times.
    #[inline(always)]
    pub(crate) fn light_through_among(
        &self,
        ray: &Ray<R>,
        distance: R,
        among: Among<'_>,
    ) -> Through<Throughput<R>> {
        match among {
            Among::Few(set) => self.light_through_few(ray, distance, set),
            // A list holds all objects that the ray can meet, so testing all objects gives the same answer.
            Among::All | Among::Listed(_) => self.light_through_all(ray, distance),
        }
    }

    /// [`light_through`](Self::light_through) for one of several neighboring rays to a light. The object that
    /// blocked the `last` of them is tested first, because it often blocks the next one too (Haines and
    /// Greenberg, "The Light Buffer", IEEE CG&A 1986).
    #[inline(always)]
    pub(crate) fn light_through_after(
        &self,
        ray: &Ray<R>,
        distance: R,
        among: Among<'_>,
        last: &mut u32,
    ) -> Through<Throughput<R>> {
        // Most often nothing, or something opaque, is in the way: then the order of the tests does not
        // matter.
        let range = Interval { min: R::ZERO, max: distance };
        let mut is_clear = true;
        let mut blocks = |index: usize| match self.is_opaque_in_the_way(index, ray, range) {
            Some(is_opaque) => {
                is_clear = false;
                is_opaque
            }
            None => false,
        };
        if blocks(*last as usize) {
            return Through::Nothing;
        }
        let mut blocks_last = |index: usize| {
            let is_blocked = blocks(index);
            if is_blocked {
                *last = index as u32;
            }
            is_blocked
        };
        let is_blocked = match (among, self.hierarchy()) {
            (Among::Few(mut set), _) => set.any(blocks_last),
            (Among::Listed(list), _) => list.iter().any(|index| blocks_last(usize::from(*index))),
            (Among::All, Some(hierarchy)) => hierarchy.any(ray, range.max, blocks_last),
            (Among::All, None) => (0..self.objects.len()).any(blocks_last),
        };
        match (is_blocked, is_clear) {
            (true, _) => Through::Nothing,
            (false, true) => Through::All,
            (false, false) => {
                // Surfaces at the same distance count in the order of the scene; a list may be unordered.
                let next = |range| self.closest(ray, range, Among::All);
                self.light_through_layers(ray, range, None, next(range), next)
            }
        }
    }

    /// [`light_through`](Self::light_through) for a ray that can meet any object.
    #[inline(never)]
    fn light_through_all(&self, ray: &Ray<R>, distance: R) -> Through<Throughput<R>> {
        self.light_through_after(ray, distance, Among::All, &mut { NO_OBJECT })
    }

    /// [`light_through`](Self::light_through) for a ray that can only meet the objects of a set.
    #[inline(never)]
    fn light_through_few(&self, ray: &Ray<R>, distance: R, set: ObjectSet) -> Through<Throughput<R>> {
        let range = Interval { min: R::ZERO, max: distance };
        // The objects that the ray meets, or that a part of it may meet though the whole ray does not.
        let (mut reachable, mut met) = (ObjectSet::NONE, None);
        for index in set {
            let Some(object) = self.objects.get(index) else { continue };
            match self.intersect(object, ray, range) {
                Some(t) => {
                    if !(object.material.transmittance > R::ZERO) {
                        return Through::Nothing;
                    }
                    met = Some((t, index));
                }
                None if object.form().is_missed_by_parts() => continue,
                None => {}
            }
            reachable = reachable.with(index);
        }
        let Some((_, index)) = met else { return Through::All };
        if reachable != ObjectSet::NONE.with(index) {
            let next = |range| self.closest(ray, range, Among::Few(reachable));
            return self.light_through_layers(ray, range, None, next(range), next);
        }
        // Most often one glass object is in the way, of which the first hit is known already.
        let Some(object) = self.objects.get(index) else { return Through::All };
        let next = |range| Some((self.intersect(object, ray, range)?, index));
        self.light_through_layers(ray, range, object.form().most_hits(), met, next)
    }

    /// The objects among `those` that can be in the way from a surface to a light in the unit direction
    /// `toward`; all objects, where the scene has no sets of candidates.
    #[inline(always)]
    pub(crate) fn between(
        &self,
        (from, magnitude): (Departure, R),
        light: usize,
        toward: Vec3<R>,
        those: ObjectSet,
    ) -> Among<'static> {
        let Some(candidates) = self.candidates() else { return Among::All };
        Among::Few(if candidates.are_near(magnitude) {
            candidates.not_passed_by(candidates.between(from, light).common(those), light, toward)
        } else {
            // The ray may begin farther beside the surface than the sets allow for.
            candidates.all()
        })
    }

    /// The objects that can be in the way between any point of an object and a light; unknown ones where the
    /// scene has no sets.
    pub(crate) fn may_shade(&self, receiver: usize, light: usize) -> ObjectSet {
        self.candidates().map_or(ObjectSet::UNKNOWN, |candidates| {
            candidates.between(Departure { object: receiver, outward: true }, light)
        })
    }

    /// Center and radius of a ball around an object: every shadow ray that meets the object meets the ball,
    /// also if it is moved by as much as shadow rays to this light are moved by rounding.
    pub(crate) fn ball_of_shadow(
        &self,
        object: usize,
        light: &Source<R>,
    ) -> Option<(Vec3<R::Setup>, R::Setup)> {
        let (candidates, ball) =
            (self.candidates()?, self.objects.get(object).and_then(BoundingBall::around)?);
        Some((ball.center, ball.radius + candidates.shadow_ray_deviation(light)))
    }

    /// Whether an object may have a highlight of a light at a place where rays are mirrored into this
    /// direction.
    #[inline(always)]
    pub(crate) fn may_have_highlight(&self, object: usize, light: usize, mirrored: Vec3<R>) -> bool {
        self.candidates().is_none_or(|candidates| candidates.may_have_highlight(object, light, mirrored))
    }

    /// Whether the object that a ray meets here is opaque; `None` if the ray does not meet it.
    #[inline(always)]
    fn is_opaque_in_the_way(&self, index: usize, ray: &Ray<R>, range: Interval<R>) -> Option<bool> {
        let object = self.objects.get(index)?;
        self.intersect(object, ray, range)?;
        Some(!(object.material.transmittance > R::ZERO))
    }

    /// The light that gets through layers: the layer `first`, and the layers that `next` finds in the rest of
    /// the ray. There are at most `most` layers, if this number is known. The shares of the layers are
    /// multiplied in the order along the ray, so that rounding does not depend on how the layers are found.
    fn light_through_layers(
        &self,
        ray: &Ray<R>,
        mut range: Interval<R>,
        most: Option<u8>,
        first: Option<(R, usize)>,
        next: impl Fn(Interval<R>) -> Option<(R, usize)>,
    ) -> Through<Throughput<R>> {
        let (mut through, mut layer) = (Throughput::even(R::ONE), first);
        for met in 1..=MAX_SHADOW_LAYERS {
            let Some((t, index)) = layer else { return Through::Some(through) };
            through = self.behind(through, index, ray, Interval { max: t, ..range });
            if most == Some(met) {
                return Through::Some(through);
            }
            range.min = t;
            layer = next(range);
        }
        if layer.is_none() { Through::Some(through) } else { Through::TooManyLayers }
    }

    /// The share of `light` that is left behind a surface of an object. The ray meets the surface at the end
    /// of `part`, and the surface before it at the beginning.
    #[inline(always)]
    fn behind(&self, light: Throughput<R>, object: usize, ray: &Ray<R>, part: Interval<R>) -> Throughput<R> {
        let Some(prepared) = self.objects.get(object) else {
            return Throughput::even(R::ZERO);
        };
        let material = prepared.material;
        let (optics, is_mapped) = (material.optics(), !material.maps.is_empty());
        // Most surfaces let the same share through at each place and from both sides.
        let needs_surface = is_mapped || optics.is_some_and(PreparedOptics::absorbs);
        let surface = needs_surface.then(|| self.surface(prepared, ray, part.max));
        let (mapped, mut room_of_maps);
        let at = match &surface {
            Some(surface) if is_mapped => {
                let mut room = None;
                let still = self.still(object, surface, &mut room);
                room_of_maps = MapRoom::EMPTY;
                mapped = material.mapped(still, |surface| self.uv(object, surface), &mut room_of_maps);
                &mapped
            }
            _ => material,
        };
        let light = light * at.transmittance;
        let Some(optics) = at.optics() else { return light };
        let light = light * optics.transmission_color();
        // Since the surface before, the light crossed the medium on the side that the ray comes from.
        surface
            .and_then(|surface| {
                let comes_from_front = !(surface.normal.dot(ray.direction) > R::ZERO);
                optics.left_after(comes_from_front, Some(part.max - part.min))
            })
            .map_or(light, |left| light * left)
    }
}
