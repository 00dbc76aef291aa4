//! The two questions that rays ask of a scene: what is hit first, and how much light comes through.

use super::candidates::{Ball, Candidates, Departure, ObjectSet};
use super::objects::PreparedObject;
use super::{Hit, PreparedScene};
use crate::color::LinearRgb;
use crate::hierarchy::{Hierarchy, WIDE, Wedge};
use crate::light::Source;
use crate::limits::MAX_SHADOW_LAYERS;
use crate::material::{PreparedMaterial, PreparedOptics};
use crate::math::{Aabb, FourRays, Interval, Ray, Real, Vec3, choose};
use crate::shape::{Form, Geometry, Hull, Intersect, Rim, Silhouette, Tip};
use crate::share::Share;
use crate::surface::Surface;

/// The space that an object is inside of.
pub(crate) enum Enclosure<R> {
    Ball { center: Vec3<R>, radius: R },
    Box(Aabb<R>),
    Everywhere,
}

/// How much of a light comes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Through<S> {
    /// Nothing is in the way.
    All,
    /// Nothing comes through.
    Nothing,
    /// This share.
    Some(S),
    /// Nothing, because more than [`MAX_SHADOW_LAYERS`] transparent surfaces lie in between.
    TooManyLayers,
}

impl<S> Through<S> {
    fn map<T>(self, map: impl FnOnce(S) -> T) -> Through<T> {
        match self {
            Self::All => Through::All,
            Self::Nothing => Through::Nothing,
            Self::Some(share) => Through::Some(map(share)),
            Self::TooManyLayers => Through::TooManyLayers,
        }
    }
}

impl<R: Real> Through<Share<R>> {
    /// The share that comes through of this one.
    #[inline(always)]
    pub(crate) fn times(&self, share: R) -> Share<R> {
        match self {
            Self::All => Share::even(share),
            Self::Nothing | Self::TooManyLayers => Share::even(R::ZERO),
            Self::Some(through) => *through * share,
        }
    }
}

/// How far away a ray meets an object first, and the object's position; [`NOTHING`]: none. Half the size of an `Option`, which takes
/// 1 % longer.
pub(crate) type Closest<R> = (R, u32);

/// In place of a position.
pub(crate) const NOTHING: u32 = u32::MAX;

/// A hit, and the material of the object.
pub(crate) type HitOn<'m, R> = (Hit<R>, &'m PreparedMaterial<'m, R>);

impl<'m, R: Real, S: Geometry + 'm> PreparedScene<'m, R, S> {
    #[inline(always)]
    pub(crate) fn material(&self, object: usize) -> Option<&'m PreparedMaterial<'m, R>> {
        self.objects.get(object).map(|object| object.material)
    }

    /// Whether a ray that leaves an object may meet it again.
    pub(crate) fn is_met_again(&self, from: Departure) -> bool {
        self.objects.get(from.object).is_none_or(|object| object.shape.form().is_met_again(from.outward))
    }

    /// What each object is inside of, if the scene has sets of candidates.
    pub(crate) fn enclosures(&self) -> Option<impl Iterator<Item = Enclosure<R>>> {
        self.candidates()?;
        Some(self.objects.iter().map(|object| match object.shape.form() {
            Form::Ball { center, radius } => Enclosure::Ball { center, radius },
            _ => object.shape.bounds().map_or(Enclosure::Everywhere, Enclosure::Box),
        }))
    }

    /// The plane that an object lies in: its unit normal, and its distance from the origin along that.
    pub(crate) fn plane_of(&self, object: usize) -> Option<(Vec3<R::Setup>, R::Setup)> {
        match self.form(object)? {
            Form::Flat { normal, distance } => Some((normal.to_setup(), distance.to_setup())),
            _ => None,
        }
    }

    /// What is known of an object beforehand.
    pub(crate) fn form(&self, object: usize) -> Option<Form<R>> {
        self.objects.get(object).map(|object| object.shape.form())
    }

    /// The normal of an object to shade with, a step away from a surface of it.
    pub(crate) fn normal_beside(&self, object: usize, surface: &Surface<R>, step: Vec3<R>) -> Vec3<R> {
        let object = self.objects.get(object);
        object.map_or(surface.shading_normal, |object| object.shape.normal_beside(surface, step))
    }

    /// A ball that no ray from a hit near enough, toward a light, misses where it meets the object.
    pub(crate) fn ball_of_shadow(
        &self,
        object: usize,
        light: &Source<R>,
    ) -> Option<(Vec3<R::Setup>, R::Setup)> {
        let (candidates, ball) = (self.candidates()?, self.objects.get(object).and_then(Ball::around)?);
        Some((ball.center, ball.radius + candidates.beside(light)))
    }

    /// What can stand between an object and a light; everything, where there are no sets.
    pub(crate) fn may_shade(&self, receiver: usize, light: usize) -> ObjectSet {
        self.candidates().map_or(ObjectSet::ALL, |candidates| {
            candidates.between(Departure { object: receiver, outward: true }, light)
        })
    }

    /// The objects for which that is so; `None`, where the scene has no sets.
    pub(crate) fn objects_where(&self, is_so: impl Fn(usize) -> bool) -> Option<ObjectSet> {
        let all = self.candidates()?.all();
        Some(all.filter(|object| is_so(*object)).fold(ObjectSet::NONE, ObjectSet::with))
    }

    /// Whether that is so for one of the objects.
    pub(crate) fn any_object(&self, is_so: impl FnMut(usize) -> bool) -> bool {
        (0..self.objects.len()).any(is_so)
    }

    /// Calls `test` for these objects, or where there is no set, for all that may reach between two planes, until it says `true`. Returns
    /// whether it did.
    pub(crate) fn any_between(
        &self,
        wedge: &Wedge<R>,
        among: Option<ObjectSet>,
        test: impl FnMut(usize) -> bool,
    ) -> bool {
        self.any_of(among, test, |hierarchy, test| hierarchy.any_between(wedge, test))
    }

    /// The same for all that may come near to a ray before it ends at `max`: as near as `beside` says of where it ends.
    pub(crate) fn any_beside(
        &self,
        (ray, max): (&Ray<R>, R),
        beside: impl FnOnce(R) -> R,
        among: Option<ObjectSet>,
        test: impl FnMut(usize) -> bool,
    ) -> bool {
        self.any_of(among, test, |hierarchy, test| {
            let max = max.smaller(hierarchy.farthest_from(ray.origin));
            hierarchy.any_beside(ray, max, beside(max), test)
        })
    }

    /// Calls `test` for these objects, or where there is no set, for those that a hierarchy finds, or for all.
    fn any_of<T: FnMut(usize) -> bool>(
        &self,
        among: Option<ObjectSet>,
        test: T,
        find: impl FnOnce(&Hierarchy<'m, R, WIDE>, T) -> bool,
    ) -> bool {
        match (among, self.hierarchy()) {
            (Some(some), _) => some.into_iter().any(test),
            (None, Some(hierarchy)) => find(hierarchy, test),
            (None, None) => self.any_object(test),
        }
    }

    /// The hulls of an object.
    pub(crate) fn hulls(&self, object: usize) -> impl Iterator<Item = Hull<R>> {
        let shape = self.objects.get(object).map(|object| &object.shape);
        (0..).map_while(move |part| shape?.hull(part))
    }

    /// Where an object tapers off.
    pub(crate) fn tips(&self, object: usize) -> impl Iterator<Item = Tip<R>> {
        let shape = self.objects.get(object).map(|object| &object.shape);
        (0..).map_while(move |number| shape?.tip(number))
    }

    /// Visits the lines where objects of many parts may end as they are seen.
    pub(crate) fn each_rim(&self, mut visit: impl FnMut(Rim<R>)) {
        for object in self.objects {
            object.shape.each_rim(&mut visit);
        }
    }

    /// Where on an object a surface is.
    #[inline(never)]
    pub(crate) fn uv(&self, object: usize, surface: &Surface<R>) -> [R; 2] {
        self.objects.get(object).map_or([R::ZERO; 2], |object| object.shape.uv(surface, self.scale))
    }

    /// The first object that a ray meets inside `range`: of several at the same distance, the lowest in
    /// [`Scene::objects`](crate::Scene::objects).
    pub fn closest_hit(&self, ray: &Ray<R>, range: Interval<R>) -> Option<Hit<R>> {
        self.hit(ray, self.closest_object(ray, range, None)).map(|(hit, _)| hit)
    }

    /// As [`closest_hit`](Self::closest_hit) ahead of the origin: for a camera ray that can meet none but the objects
    /// `among`, or for one that leaves a surface.
    #[inline(always)]
    pub(crate) fn closest_hit_from(
        &self,
        ray: &Ray<R>,
        from: Departure,
        among: ObjectSet,
    ) -> Option<HitOn<'m, R>> {
        self.hit(ray, self.closest_from(ray, from, among))
    }

    /// Distance and position of that.
    #[inline(always)]
    pub(crate) fn closest_from(&self, ray: &Ray<R>, from: Departure, among: ObjectSet) -> Option<(R, usize)> {
        let mut closest = match self.candidates() {
            Some(_) => {
                // A ray that leaves a surface misses most of what is about it.
                let misses_most = from.outward;
                let is_missed = |shape: &_| misses_most && is_missed(ray, shape);
                self.closest_among(ray, Interval::AHEAD, among, is_missed)
            }
            None => self.closest_object(&apart(ray), Interval::AHEAD, None),
        };
        if closest.is_none() && self.comes_out_again(from) {
            // A ray inside a ball always comes out of it. Should rounding ever lose it, look everywhere.
            closest = self.closest_of_all(&apart(ray));
        }
        closest
    }

    /// What is left of a ray's throughput where it has gone this far from a surface, or for ever: its material tells what absorbs
    /// behind a surface, and before it, and what is mirrored may fade with distance.
    #[inline(always)]
    pub(crate) fn dimmed(
        &self,
        throughput: Share<R>,
        from: Departure,
        is_mirrored: bool,
        length: Option<R>,
    ) -> Share<R> {
        if !cfg!(feature = "optics") {
            return throughput;
        }
        match self.material(from.object).and_then(PreparedMaterial::optics) {
            Some(optics) => optics.dimmed(throughput, from.outward, is_mirrored, length),
            None => throughput,
        }
    }

    /// All objects.
    pub(crate) fn all(&self) -> ObjectSet {
        self.candidates().map_or(ObjectSet::ALL, Candidates::all)
    }

    /// The objects that a ray can meet that leaves a surface.
    pub(crate) fn leaving(&self, from: Departure) -> ObjectSet {
        self.candidates().map_or(ObjectSet::ALL, |candidates| candidates.leaving(from))
    }

    fn comes_out_again(&self, from: Departure) -> bool {
        self.candidates().is_some_and(|candidates| candidates.comes_out_again(from))
    }

    #[cold]
    fn closest_of_all(&self, ray: &Ray<R>) -> Option<(R, usize)> {
        let all = self.candidates().map(Candidates::all);
        self.closest_object(ray, Interval::AHEAD, all)
    }

    /// As [`closest_from`](Self::closest_from), for a ray that can meet none but these objects, which are given from the lowest position up.
    #[inline(always)]
    pub(crate) fn closest_in(&self, ray: &Ray<R>, list: &[u16]) -> Option<(R, usize)> {
        let positions = list.iter().map(|object| usize::from(*object));
        self.closest_among(ray, Interval::AHEAD, positions, |_| false)
    }

    /// The same of four rays, for processors that compute four numbers at once; [`hit`](Self::hit) tells the rest.
    #[inline(always)]
    pub(crate) fn closest_of_four(&self, rays: &FourRays<R>, list: &[u16]) -> [Closest<R>; 4] {
        let (mut distances, mut closest) = ([R::FARTHEST; 4], [NOTHING; 4]);
        for index in list {
            let Some(object) = self.objects.get(usize::from(*index)) else { continue };
            let (met, t) = object.shape.intersect_four(rays, &distances);
            if met != 0 {
                distances = choose(met, t, distances);
                closest = choose(met, [u32::from(*index); 4], closest);
            }
        }
        let [a, b, c, d] = distances;
        let [e, f, g, h] = closest;
        [(a, e), (b, f), (c, g), (d, h)]
    }

    /// The same of one ray.
    #[inline(always)]
    pub(crate) fn closest_of_one(&self, ray: &Ray<R>, list: &[u16]) -> Closest<R> {
        self.closest_in(ray, list).map_or((R::FARTHEST, NOTHING), |(t, object)| (t, object as u32))
    }

    /// What a ray meets first, of which distance and position are known.
    #[inline(always)]
    pub(crate) fn hit(&self, ray: &Ray<R>, closest: Option<(R, usize)>) -> Option<HitOn<'m, R>> {
        let (t, index) = closest?;
        let object = self.objects.get(index)?;
        Some((Hit { t, object: index, surface: object.shape.surface(ray, t) }, object.material))
    }

    /// As [`hit`](Self::hit), into `hit`; the material of the object.
    #[inline(always)]
    pub(crate) fn meet_at(
        &self,
        ray: &Ray<R>,
        closest: Option<(R, usize)>,
        hit: &mut Hit<R>,
    ) -> Option<&'m PreparedMaterial<'m, R>> {
        let (t, index) = closest?;
        let object = self.objects.get(index)?;
        (hit.t, hit.object) = (t, index);
        hit.surface = object.shape.surface(ray, t);
        Some(object.material)
    }

    /// Distance and position of the first object that a ray meets, of all or of some.
    #[inline(never)]
    fn closest_object(
        &self,
        ray: &Ray<R>,
        range: Interval<R>,
        among: Option<ObjectSet>,
    ) -> Option<(R, usize)> {
        match (among, self.hierarchy()) {
            (Some(among), _) => self.closest_among(ray, range, among, |_| false),
            (None, Some(hierarchy)) => self.closest_in_hierarchy(hierarchy, ray, range),
            (None, None) => self.closest_among(ray, range, 0..self.objects.len(), |_| false),
        }
    }

    /// The same among the objects of these positions but those that are missed.
    #[inline(always)]
    fn closest_among(
        &self,
        ray: &Ray<R>,
        mut range: Interval<R>,
        among: impl IntoIterator<Item = usize>,
        is_missed: impl Fn(&S::Prepared<'m, R>) -> bool,
    ) -> Option<(R, usize)> {
        let mut closest = None;
        for index in among {
            let Some(object) = self.objects.get(index) else { continue };
            if !is_missed(&object.shape)
                && let Some(t) = object.shape.intersect(ray, range)
            {
                range.max = t;
                closest = Some((t, index));
            }
        }
        closest
    }

    /// As [`closest_object`](Self::closest_object). Boxes are met in another order than objects stand in the scene.
    #[inline(never)]
    fn closest_in_hierarchy(
        &self,
        hierarchy: &Hierarchy<'m, R, WIDE>,
        ray: &Ray<R>,
        range: Interval<R>,
    ) -> Option<(R, usize)> {
        let mut closest: Option<(R, usize)> = None;
        hierarchy.walk(ray, range.max, |index| {
            // An object that stands before the closest one wins if it is as near.
            let max = match closest {
                Some((t, other)) if other < index => t,
                _ => range.max,
            };
            if let Some(object) = self.objects.get(index)
                && let Some(t) = object.shape.intersect(ray, Interval { max, ..range })
                && closest.is_none_or(|(nearest, _)| t <= nearest)
            {
                closest = Some((t, index));
            }
            closest.map_or(range.max, |(t, _)| t)
        });
        closest
    }

    /// The sets of candidates, if there can be some: without the feature, the compiler sees that there are none and drops their code.
    #[inline(always)]
    fn candidates(&self) -> Option<&Candidates<'m, R>> {
        if cfg!(feature = "candidates") { self.candidates.as_ref() } else { None }
    }

    /// The hierarchy, if there can be one: without the feature, the compiler sees that there is none and drops its code.
    #[inline(always)]
    pub(crate) fn hierarchy(&self) -> Option<&Hierarchy<'m, R, WIDE>> {
        if cfg!(feature = "hierarchy") { self.hierarchy.as_ref() } else { None }
    }

    /// How much comes through from a light at `distance` along `ray`.
    ///
    /// Each surface in between scales the light by its transmittance and its color; what lies behind the light does not.
    pub fn light_through(&self, ray: &Ray<R>, distance: R) -> Through<LinearRgb<R>> {
        self.light_through_among(ray, distance, None).map(Share::color)
    }

    /// What can be in the way from a surface into the unit direction `toward` a light of the scene, if it is `among` these objects;
    /// `None`: anything.
    #[inline(always)]
    pub(crate) fn in_the_way(
        &self,
        from: Departure,
        magnitude: R,
        light: usize,
        toward: Vec3<R>,
        among: ObjectSet,
    ) -> Option<ObjectSet> {
        let candidates = self.candidates()?;
        let between = candidates.between(from, light);
        Some(if candidates.are_near(magnitude) {
            candidates.not_passed_by(between.common(among), light, toward)
        } else {
            between
        })
    }

    /// Whether an object whose highlights follow Phong's law may show one of a light, where a ray is mirrored into this direction.
    #[inline(always)]
    pub(crate) fn may_glint(&self, object: usize, light: usize, mirrored: Vec3<R>) -> bool {
        self.candidates().is_none_or(|candidates| candidates.may_glint(object, light, mirrored))
    }

    /// As [`light_through`](Self::light_through), for a ray that can meet none but these objects.
    #[inline(never)]
    pub(crate) fn light_through_among(
        &self,
        ray: &Ray<R>,
        distance: R,
        among: Option<ObjectSet>,
    ) -> Through<Share<R>> {
        // Most often nothing, or something opaque, is in the way: any order of the objects tells.
        let range = Interval { min: R::ZERO, max: distance };
        match (among, self.hierarchy()) {
            (Some(some), _) => self.light_through_few(ray, range, some),
            (None, Some(hierarchy)) => {
                self.light_through_hierarchy(hierarchy, ray, distance, &mut { NOTHING })
            }
            (None, None) => {
                let mut clear = true;
                let blocked = (0..self.objects.len()).any(|index| self.blocks(index, ray, range, &mut clear));
                self.light_left(blocked, clear, ray, range)
            }
        }
    }

    /// The same for a ray that can meet none but a few objects. Those are not asked again that no part of it meets.
    #[inline(always)]
    fn light_through_few(&self, ray: &Ray<R>, range: Interval<R>, among: ObjectSet) -> Through<Share<R>> {
        let (mut again, mut met) = (ObjectSet::NONE, None);
        for index in among {
            let Some(PreparedObject { shape, material }) = self.objects.get(index) else { continue };
            match shape.intersect(ray, range) {
                Some(t) => {
                    if !(material.transmittance > R::ZERO) {
                        return Through::Nothing;
                    }
                    met = Some((t, index));
                }
                None if shape.form().is_missed_by_parts() => continue,
                None => {}
            }
            again = again.with(index);
        }
        match met {
            None => Through::All,
            Some((t, index)) if again == ObjectSet::NONE.with(index) => {
                self.light_through_one(ray, range, t, index)
            }
            Some(_) => self.light_through_layers(ray, range, Some(again)),
        }
    }

    /// The same for a ray that meets one object alone, first there: as [`light_through_layers`](Self::light_through_layers).
    fn light_through_one(
        &self,
        ray: &Ray<R>,
        mut range: Interval<R>,
        mut t: R,
        index: usize,
    ) -> Through<Share<R>> {
        let mut through = Share::even(R::ONE);
        let Some(PreparedObject { shape, .. }) = self.objects.get(index) else { return Through::All };
        let most = shape.form().most_hits().unwrap_or(MAX_SHADOW_LAYERS + 1);
        for layer in 1..=most {
            if layer > MAX_SHADOW_LAYERS {
                return Through::TooManyLayers;
            }
            through = self.let_through(through, index, ray, Interval { max: t, ..range });
            if layer == most {
                break;
            }
            range.min = t;
            match shape.intersect(ray, range) {
                Some(next) => t = next,
                None => break,
            }
        }
        Through::Some(through)
    }

    /// The same for a ray that can meet anything, where there is a hierarchy. The object that was `last` in the way to a light is asked
    /// first: it may well be in the way of the next ray (Haines and Greenberg, "The Light Buffer", IEEE CG&A 1986).
    #[inline(never)]
    pub(crate) fn light_through_hierarchy(
        &self,
        hierarchy: &Hierarchy<'m, R, WIDE>,
        ray: &Ray<R>,
        distance: R,
        last: &mut u32,
    ) -> Through<Share<R>> {
        let range = Interval { min: R::ZERO, max: distance };
        let mut clear = true;
        let mut blocks = |index: usize| self.blocks(index, ray, range, &mut clear);
        let blocked = blocks(*last as usize)
            || hierarchy.any(ray, range.max, |index| {
                let blocks = blocks(index);
                if blocks {
                    *last = index as u32;
                }
                blocks
            });
        self.light_left(blocked, clear, ray, range)
    }

    /// Whether a ray meets an object that lets nothing through; where it meets any, the way is not `clear`.
    #[inline(always)]
    fn blocks(&self, index: usize, ray: &Ray<R>, range: Interval<R>, clear: &mut bool) -> bool {
        if !self.meets(index, ray, range) {
            return false;
        }
        *clear = false;
        !(self.transmittance(index) > R::ZERO)
    }

    /// How much comes through where something opaque blocks the way, or else the way is clear, or else transparent surfaces are in it.
    #[inline(always)]
    fn light_left(&self, blocked: bool, clear: bool, ray: &Ray<R>, range: Interval<R>) -> Through<Share<R>> {
        match (blocked, clear) {
            (true, _) => Through::Nothing,
            (false, true) => Through::All,
            (false, false) => self.light_through_layers(ray, range, None),
        }
    }

    /// How much comes through transparent surfaces, which are multiplied in the order of the ray: one order, the same rounding. A shape
    /// with an inside is met twice.
    fn light_through_layers(
        &self,
        ray: &Ray<R>,
        mut range: Interval<R>,
        among: Option<ObjectSet>,
    ) -> Through<Share<R>> {
        let mut through = Share::even(R::ONE);
        for _ in 0..MAX_SHADOW_LAYERS {
            let Some((t, index)) = self.closest_object(ray, range, among) else {
                return Through::Some(through);
            };
            through = self.let_through(through, index, ray, Interval { max: t, ..range });
            range.min = t;
        }
        match self.closest_object(ray, range, among) {
            None => Through::Some(through),
            Some(_) => Through::TooManyLayers,
        }
    }

    /// The same for a ray that can meet none but the objects in a list, in which what is in the way comes first from then on.
    #[inline(always)]
    pub(crate) fn light_through_list(
        &self,
        ray: &Ray<R>,
        distance: R,
        list: &mut [u16],
    ) -> Through<Share<R>> {
        let range = Interval { min: R::ZERO, max: distance };
        let met = list.iter().position(|object| self.meets(usize::from(*object), ray, range));
        let Some(place) = met else { return Through::All };
        let Some((first, rest)) = list.split_first_mut() else { return Through::All };
        if let Some(other) = place.checked_sub(1).and_then(|place| rest.get_mut(place)) {
            core::mem::swap(first, other);
        }
        if self.transmittance(usize::from(*first)) > R::ZERO {
            return self.light_through_among(ray, distance, None);
        }
        Through::Nothing
    }

    #[inline(always)]
    fn meets(&self, object: usize, ray: &Ray<R>, range: Interval<R>) -> bool {
        self.objects.get(object).is_some_and(|object| object.shape.intersect(ray, range).is_some())
    }

    /// What is left of light behind an object that a ray meets at the end of this part of it, which begins at the one before.
    #[inline(always)]
    fn let_through(&self, light: Share<R>, object: usize, ray: &Ray<R>, part: Interval<R>) -> Share<R> {
        let Some(PreparedObject { shape, material }) = self.objects.get(object) else {
            return Share::even(R::ZERO);
        };
        let (optics, is_mapped) = (material.optics(), !material.maps.is_empty());
        // Most surfaces let the same through everywhere, and either way.
        let is_asked = is_mapped || optics.is_some_and(PreparedOptics::absorbs);
        let surface = is_asked.then(|| shape.surface(ray, part.max));
        let transmittance = match &surface {
            Some(surface) if is_mapped => {
                material.mapped(surface, |surface| self.uv(object, surface)).transmittance
            }
            _ => material.transmittance,
        };
        let light = light * transmittance;
        let Some(optics) = optics else { return light };
        let light = light * optics.transmission_color();
        // The side that the ray comes from tells what light went through since the surface before.
        surface
            .and_then(|surface| {
                let comes_from_front = !(surface.normal.dot(ray.direction) > R::ZERO);
                optics.left_after(comes_from_front, Some(part.max - part.min))
            })
            .map_or(light, |left| light * left)
    }

    /// The most that an object lets through.
    fn transmittance(&self, object: usize) -> R {
        self.material(object).map_or(R::ZERO, |material| material.transmittance)
    }
}

/// Whether a ray surely misses a shape, where that can be told faster than by meeting it.
#[inline(always)]
fn is_missed<R: Real>(ray: &Ray<R>, shape: &impl Intersect<R>) -> bool {
    matches!(shape.form(), Form::Ball { center, radius } if R::misses_ball(ray, center, radius))
}

/// The same ray, coordinate by coordinate, which a call may have by reference while the other stays in registers.
#[inline(always)]
fn apart<R: Real>(ray: &Ray<R>) -> Ray<R> {
    let Ray { origin: Vec3 { x, y, z }, direction: Vec3 { x: dx, y: dy, z: dz } } = *ray;
    Ray { origin: Vec3 { x, y, z }, direction: Vec3 { x: dx, y: dy, z: dz } }
}
